"""The verdict on a restoration: a few words on how far its result can be trusted."""

from dataclasses import dataclass

from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import achievements
from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.messages import in_the_app
from seiswidgets.widgets.severity import GOOD

TITLES = {
    "unsettled": "not settled",
    "cut-off": "cut-offs apart",
    "contact": "fault sides apart",
    "overlap": "rock on rock",
    "fold": "folds about a fault's tip",
    "gap": "gaps between blocks",
    "growth": "offset grows downwards",
    "fault end": "fault end",
    "bed length": "bed length changed",
    "datum": "off its datum",
    "crossing": "horizons cross",
    "beyond": "the rest turns",
}
INCOMPLETE = {"undetermined", "one-sided"}  # kinds of findings about drawings in progress


@dataclass(frozen=True)
class Verdict:
    """The verdict on a restoration.

    Attributes
    ----------
    severity : {"good", "warning", "problem"}
    title : str
        A few words, such as "not settled".
    text : str
        One sentence: that of the worst finding if there is a warning or a problem.
    rest : str
        Reference to the other findings; "" if there are none.
    findings : tuple of Finding
        All of them, worst first.
    """

    severity: str
    title: str
    text: str
    rest: str = ""
    findings: tuple[Finding, ...] = ()

    @classmethod
    def of(cls, restoration: Restoration) -> "Verdict":
        """Judge a restoration by its findings."""
        findings = restoration.findings
        grave = [finding for finding in findings if finding.severity != "note"]
        if not grave:
            text = "; ".join(achievements([stage.report for stage in restoration.stages]))
            return cls(GOOD, "Settled", text and f"{text[0].upper()}{text[1:]}.", _notes(len(findings)), findings)
        worst = grave[0]
        title = f"check: {title_of(worst)}" if worst.severity == "warning" else title_of(worst)
        rest = f"and {len(grave) - 1} more (see Report)" if grave[1:] else ""
        return cls(worst.severity, title, in_the_app(worst.text), rest, findings)

    @property
    def is_incomplete(self) -> bool:
        """True if nothing is wrong except that some picks need another line before they can constrain.

        Until then a horizon is short, too.
        """
        grave = {finding.kind for finding in self.findings if finding.severity != "note"}
        return bool(grave & INCOMPLETE) and grave <= INCOMPLETE | {"beyond"}

    @property
    def is_good(self) -> bool:
        """True if there is neither a warning nor a problem."""
        return self.severity == GOOD

    def __str__(self) -> str:
        joint = ". " if self.is_good else ": "
        return joint.join(filter(None, (self.title, f"{self.text} {self.rest}".strip())))


def title_of(finding: Finding) -> str:
    """Name a finding in two or three words."""
    return TITLES.get(finding.kind, finding.kind)


def _notes(count: int) -> str:
    return f"{count} note{'s' if count > 1 else ''} (see Report)" if count else ""
