"""Errors in the words of the panel: where they name a keyword of a function, the label of its field."""

import re

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
KEYWORD = re.compile(rf"(?<![\w./-])({'|'.join(LABELS)})=(True\b|(?=[\s,.;:)]|$)|(?={{))")


def in_labels(text: str) -> str:
    """A message with “traces apart” where it says dx=, and so on."""
    return KEYWORD.sub(lambda match: f"“{LABELS[match[1]]}”" + " " * text.startswith("{", match.end()), text)
