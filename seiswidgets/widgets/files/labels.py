"""What the panel says: errors with the labels of its fields in the place of a function's keywords, and counts."""

import re

from seiswidgets.geology.picks import Interpretation
from seiswidgets.io.session.session import Session

LABELS = {
    "along": "x comes from",
    "crossline": "crossline",
    "dx": "traces apart",
    "dz": "samples apart",
    "format": "format",
    "header_bytes": "other header bytes",
    "inline": "inline",
    "line": "seismic line",
    "traces": "traces",
    "velocity": "velocity",
    "x_unit": "unit of x",
    "z0": "first sample at",
    "z_unit": "unit of z",
    "z_up": "z grows upwards",
}
KEYWORD = re.compile(
    rf"(?<![\w./-])(?:({'|'.join(LABELS)})=(?:True\b|(?=[\s,.;:){{\d\x22]|$))|(dx|dz|x_unit|z0|z_unit)(?= must be ))"
)
VALUE = re.compile(r'[{\d"]')  # stands behind a keyword


def in_labels(text: str) -> str:
    """A message with “traces apart” where it says dx=, or what dx must be, and so on."""
    return KEYWORD.sub(
        lambda match: f"“{LABELS[match[1] or match[2]]}”" + " " * bool(VALUE.match(text, match.end())), text
    )


def counted(picks: Interpretation | Session) -> str:
    """How many faults and horizons there are."""
    faults, horizons = len(picks.faults), len(picks.horizons)
    return f"{faults} fault{'s' * (faults != 1)} and {horizons} horizon{'s' * (horizons != 1)}"
