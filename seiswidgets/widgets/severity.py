"""The looks of findings: each severity has a colour, an icon and a word, so that none stands alone."""

from dataclasses import dataclass
from html import escape

from seiswidgets.geology.findings import COLOURS

GOOD = "good"
LABEL = (
    '<span style="display: inline-flex; flex: none; align-items: center; gap: 4px; padding: 0 8px; border-radius: 9px; '
    "background: {fill}; color: {ink}; font-size: 12px; font-weight: 600; min-height: 18px; line-height: 18px; "
    'white-space: nowrap; vertical-align: middle">{icon}{text}</span>'
)
ICON = (
    '<svg role="img" aria-label="{severity}" viewBox="0 0 16 16" width="12" height="12" fill="none" '
    'stroke="currentColor" stroke-width="1.8" stroke-linecap="round" stroke-linejoin="round"><path d="{path}"/></svg>'
)
REMARK = (
    '<div role="note" style="display: flex; align-items: flex-start; gap: 6px; margin: 4px 0; line-height: 1.4; '
    'white-space: normal; color: var(--jp-ui-font-color1, #212121)">{label}<span>{text}</span></div>'
)


@dataclass(frozen=True)
class Look:
    """The look of a severity.

    Attributes
    ----------
    colours : tuple of str
        Fill and ink of its labels.
    path : str
        SVG path of its icon, in a square of 16 units.
    role : str
        ARIA role of a live message; "alert" interrupts a screen reader.
    """

    colours: tuple[str, str]
    path: str
    role: str = "status"


ROUND, TRIANGLE = "M8 1.5a6.5 6.5 0 1 0 .01 0Z", "M8 1.8L15 14H1Z"
OCTAGON = "M5.2 1.5h5.6l3.7 3.7v5.6l-3.7 3.7H5.2L1.5 10.8V5.2Z"
LOOKS = {
    GOOD: Look(("#2e7d32", "white"), f"{ROUND}M5 8.2l2.2 2.2L11 6"),
    "note": Look(COLOURS["note"], f"{ROUND}M8 7.5v3.5M8 4.9v.1"),
    "warning": Look(COLOURS["warning"], f"{TRIANGLE}M8 6.2v3.6M8 11.9v.1"),
    "problem": Look(
        COLOURS["problem"],
        f"{OCTAGON}M5.7 5.7l4.6 4.6M10.3 5.7l-4.6 4.6",
        "alert",
    ),
}


def label(severity: str, text: str = "") -> str:
    """HTML of a small coloured label: the icon of a severity, and a few words."""
    look = LOOKS[severity]
    fill, ink = look.colours
    icon = ICON.format(severity=severity, path=look.path)
    return LABEL.format(fill=fill, ink=ink, icon=icon, text=escape(text))


def remark(severity: str, text: str, title: str = "") -> str:
    """HTML of a finding: its label, and the text beside it."""
    return REMARK.format(label=label(severity, title), text=escape(text))
