"""What the app shows as a picture, for readers without a kernel."""

from base64 import b64encode
from io import BytesIO

from matplotlib.figure import Figure

from seiswidgets import plot
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration


def snapshot(restoration: Restoration, interpretation: Interpretation) -> str:
    """A PNG of the section and, if it is restored, of that beside it, with their picks; in base 64."""
    sections = [plot.section] + [plot.restoration] * bool(restoration.stages)
    figure = Figure(figsize=(7 * len(sections), 4.2), layout="constrained")
    for draw, ax in zip(sections, figure.subplots(1, len(sections), squeeze=False)[0], strict=True):
        draw(restoration.original if draw is plot.section else restoration, interpretation, ax)
    file = BytesIO()
    figure.savefig(file, format="png", dpi=80)
    return b64encode(file.getvalue()).decode()
