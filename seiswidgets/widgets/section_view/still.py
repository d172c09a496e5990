"""A still picture of panes, for notebooks that are read without a kernel."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from io import BytesIO

import numpy as np
from PIL import Image, ImageDraw

from seiswidgets.interaction.colour import resampled
from seiswidgets.interaction.overlay import stroke_points
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.section_view.badge import PaneBadge
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.severity import LOOKS

SIZE = 460, 320  # pixels of a plot area
LEFT, TOP, BOTTOM, GAP = 56, 22, 34, 14
INK, PAPER = "#212121", "white"


def still(panes: Sequence[tuple[str, SectionPane]]) -> str:
    """PNG in base 64 of panes side by side, under their titles.

    It is drawn without matplotlib, which would take long to load before the app first appears.
    """
    width = LEFT + SIZE[0] + GAP
    sheet = Image.new("RGB", (width * len(panes), TOP + SIZE[1] + BOTTOM), PAPER)
    for column, (title, pane) in enumerate(panes):
        sheet.paste(_picture(title, pane), (column * width, 0))
    file = BytesIO()
    sheet.save(file, "PNG", compress_level=4)
    return b64encode(file.getvalue()).decode()


def _picture(title: str, pane: SectionPane) -> Image.Image:
    """Draw a pane with its axes and lines."""
    view = pane.view.fitted().resized(*SIZE, 1.0)
    picture = Image.new("RGB", (LEFT + SIZE[0] + GAP, TOP + SIZE[1] + BOTTOM), PAPER)
    draw = ImageDraw.Draw(picture)
    picture.paste(_section(pane, view), (LEFT, TOP))
    for stroke in pane.layer.strokes:
        for run in _runs(stroke_points(stroke)) if stroke["joined"] else ():
            draw.line((view.to_pixels(run) + (LEFT, TOP)).ravel().tolist(), fill=stroke["colour"], width=2)
    draw.rectangle((LEFT, TOP, LEFT + SIZE[0], TOP + SIZE[1]), outline=INK)
    draw.text((LEFT, 4), title, fill=INK)
    if pane.badge.severity:
        _draw_badge(draw, pane.badge)
    x, z = view.ticks()
    for pixel, label in zip(x.pixels, x.labels, strict=True):
        draw.text((LEFT + pixel, TOP + SIZE[1] + 3), label, fill=INK, anchor="ma")
    for pixel, label in zip(z.pixels, z.labels, strict=True):
        draw.text((LEFT - 5, TOP + pixel), label, fill=INK, anchor="rm")
    draw.text((LEFT + SIZE[0] / 2, TOP + SIZE[1] + 17), f"{x.title}; {z.title} downwards", fill=INK, anchor="ma")
    return picture


def _draw_badge(draw: ImageDraw.ImageDraw, badge: PaneBadge) -> None:
    """Draw a pane's coloured frame, and its label above the upper right corner."""
    fill, ink = LOOKS[badge.severity].colours
    right, text = LEFT + SIZE[0], f"{badge.severity}: {badge.text}"
    draw.rectangle((LEFT, TOP, right, TOP + SIZE[1]), outline=fill, width=3)
    draw.rectangle((right - draw.textlength(text) - 12, 2, right, TOP), fill=fill)
    draw.text((right - 6, 11), text, fill=ink, anchor="rm")


def _section(pane: SectionPane, view: Viewport) -> Image.Image:
    """Draw the section, filling the plot area."""
    image = Image.new("RGBA", SIZE, PAPER)
    section, colouring = pane.section, pane.colouring
    left, top, width, height = (round(length) for length in view.picture)
    size = max(1, width), max(1, height)
    columns, rows = min(size[0], section.shape[1]), min(size[1], section.shape[0])
    levels = colouring.levels(resampled(section.amplitude, (columns, rows)))
    painted = Image.fromarray(colouring.palette[levels]).resize(size)
    image.paste(painted, (left, top), painted)
    return image.convert("RGB")


def _runs(points: np.ndarray) -> Iterator[np.ndarray]:
    """Split a line where it is interrupted."""
    known = np.isfinite(points).all(axis=1)
    for run in np.split(np.arange(len(points)), np.flatnonzero(~known)):
        kept = points[run[known[run]]]
        if len(kept) > 1:
            yield kept
