"""Colours that figures and the screen share."""

AREA_RATIO = "RdBu_r"  # red is compression, blue dilatation; told apart by the colour-blind too
