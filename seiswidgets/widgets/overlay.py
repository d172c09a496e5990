"""Lines on top of a section's picture."""

from dataclasses import dataclass

import numpy as np
from ipycanvas import Canvas

from seiswidgets.widgets.view import View

HALO = "rgba(255, 255, 255, 0.75)"
HALO_WIDTH = 1.5  # css pixels on either side
FAR = 20_000  # device pixels beyond which nothing is drawn


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line on a section, with a pale rim so that it stands out from any colours.

    Parameters
    ----------
    points : array, shape (n, 2)
        In the section's units; the line is interrupted where they are NaN.
    colour : str
        As CSS has it.
    width : float
        In css pixels.
    dots : bool
        Whether the vertices are shown.
    dash : tuple of float
        Lengths of dashes and gaps, in css pixels.
    """

    points: np.ndarray
    colour: str = "#d7191c"
    width: float = 2.0
    dots: bool = False
    dash: tuple[float, ...] = ()


def draw_strokes(canvas: Canvas, strokes: list[Stroke], view: View) -> None:
    """Draw lines on a canvas of the view's backing store."""
    for stroke in strokes:
        pixels = np.reshape(view.to_backing(np.reshape(stroke.points, (-1, 2))), (-1, 2))
        canvas.set_line_dash([length * view.pixel_ratio for length in stroke.dash])
        for colour, rim in ((HALO, HALO_WIDTH), (stroke.colour, 0)):
            canvas.stroke_style = canvas.fill_style = colour
            canvas.line_width = (stroke.width + 2 * rim) * view.pixel_ratio
            _draw(canvas, pixels, stroke, (stroke.width + 1 + rim) * view.pixel_ratio)


def _draw(canvas, pixels, stroke, radius):
    for run in _runs(pixels):
        if len(run) > 1:
            canvas.stroke_lines(run)
        if stroke.dots:
            canvas.fill_circles(*run.T, radius)


def _runs(pixels):
    """The stretches between points that cannot be drawn: a browser that is sent a NaN draws nothing any more."""
    good = (np.abs(np.nan_to_num(pixels, nan=np.inf)) < FAR).all(axis=1)
    ends = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]])))
    return [pixels[first:last] for first, last in ends.reshape(-1, 2)]
