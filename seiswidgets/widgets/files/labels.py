"""Labels of the panel's fields, which error messages show in place of keywords, and counts of picks."""

from seiswidgets.errors import Text
from seiswidgets.geology.picks import Interpretation
from seiswidgets.io.session.session import Session

LABELS = {  # by keyword
    "along": "x comes from",
    "byte_order": "byte order",
    "calibration": "calibration",
    "crop": "crop",
    "crossline": "crossline",
    "dx": "traces apart",
    "dz": "samples apart",
    "format": "format",
    "header_bytes": "other header bytes",
    "inline": "inline",
    "line": "seismic line",
    "offset": "offset",
    "revision": "revision",
    "sample_format": "sample format",
    "traces": "traces",
    "velocity": "velocity",
    "x_unit": "unit of x",
    "z0": "first sample at",
    "z_unit": "unit of z",
    "z_up": "z increases upwards",
}
QUOTED = {keyword: f"“{label}”" for keyword, label in LABELS.items()}


def in_labels(text: str) -> str:
    """Render a message with “traces apart” in place of the keyword dx, and so on."""
    return text.rendered(QUOTED) if isinstance(text, Text) else text


def counted(picks: Interpretation | Session) -> str:
    """Number of faults and horizons, in words."""
    faults, horizons = len(picks.faults), len(picks.horizons)
    return f"{faults} fault{'s' * (faults != 1)} and {horizons} horizon{'s' * (horizons != 1)}"
