"""Findings: observations about a restoration that are worth showing to the user without raising an error."""

from collections.abc import Iterable
from dataclasses import dataclass

SEVERITIES = ("note", "warning", "problem")
COLOURS = {"note": ("#546e7a", "white"), "warning": ("#ffb300", "#212121"), "problem": ("#d32f2f", "white")}
"""Fill of each severity's label and ink on it: readable (WCAG AA) on light and dark pages alike."""


@dataclass(frozen=True)
class Finding:
    """An observation about a restoration.

    Attributes
    ----------
    severity : {"note", "warning", "problem"}
        A note informs, a warning asks for a look, and a problem means that the result should not be trusted as it is.
    kind : str
        A short key, such as ``"unsettled"``, ``"cut-off"``, ``"contact"``, ``"overlap"``, ``"fault end"``,
        ``"bed length"`` or ``"datum"``.
    text : str
        One sentence for the user: what was found, where, and what to do about it.
    pick : str, optional
        Name of the fault or horizon concerned.
    where : (x, z), optional
        Position in the section's units, before the step that was observed; ``Restoration.findings`` gives it in the
        present-day section.
    """

    severity: str
    kind: str
    text: str
    pick: str | None = None
    where: tuple[float, float] | None = None

    def __post_init__(self):
        if self.severity not in SEVERITIES:
            raise ValueError(f"severity must be one of {SEVERITIES}, but is {self.severity!r}")


def worst_first(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Sort findings by severity, problems first; findings of one severity keep their order."""
    return tuple(sorted(findings, key=lambda finding: -SEVERITIES.index(finding.severity)))
