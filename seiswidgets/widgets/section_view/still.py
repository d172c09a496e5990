"""A still picture of panes, for readers of a notebook that has no kernel."""

from base64 import b64encode
from collections.abc import Sequence
from io import BytesIO

import numpy as np
from PIL import Image, ImageDraw

from seiswidgets.interaction.colour import resampled
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.severity import LOOKS

SIZE = 460, 320  # pixels of a section
LEFT, TOP, BOTTOM, GAP = 56, 22, 34, 14
INK, PAPER = "#212121", "white"


def still(panes: Sequence[tuple[str, SectionPane]]) -> str:
    """A PNG in base 64 of some panes side by side, under their titles.

    It is drawn without matplotlib, whose loading would hold up the app's first paint.
    """
    width = LEFT + SIZE[0] + GAP
    sheet = Image.new("RGB", (width * len(panes), TOP + SIZE[1] + BOTTOM), PAPER)
    for number, (title, pane) in enumerate(panes):
        sheet.paste(_drawn(title, pane), (number * width, 0))
    file = BytesIO()
    sheet.save(file, "PNG", compress_level=4)
    return b64encode(file.getvalue()).decode()


def _drawn(title, pane):
    """A pane with its axes and lines."""
    view = pane.view.fitted().resized(*SIZE, 1.0)
    picture = Image.new("RGB", (LEFT + SIZE[0] + GAP, TOP + SIZE[1] + BOTTOM), PAPER)
    draw = ImageDraw.Draw(picture)
    picture.paste(_section(pane, view), (LEFT, TOP))
    for stroke in pane.layer.strokes:
        for run in _runs(stroke["points"]):
            draw.line((view.to_pixels(run) + (LEFT, TOP)).ravel().tolist(), fill=stroke["colour"], width=2)
    draw.rectangle((LEFT, TOP, LEFT + SIZE[0], TOP + SIZE[1]), outline=INK)
    draw.text((LEFT, 4), title, fill=INK)
    if pane.badge.severity:
        _draw_badge(draw, pane.badge)
    x, z = view.ticks()
    for place, label in zip(x.pixels, x.labels, strict=True):
        draw.text((LEFT + place, TOP + SIZE[1] + 3), label, fill=INK, anchor="ma")
    for place, label in zip(z.pixels, z.labels, strict=True):
        draw.text((LEFT - 5, TOP + place), label, fill=INK, anchor="rm")
    draw.text((LEFT + SIZE[0] / 2, TOP + SIZE[1] + 17), f"{x.title}; {z.title} downwards", fill=INK, anchor="ma")
    return picture


def _draw_badge(draw, badge):
    """Draw a pane's coloured frame, and its label above the upper right corner."""
    fill, ink = LOOKS[badge.severity].colours
    right, text = LEFT + SIZE[0], f"{badge.severity}: {badge.text}"
    draw.rectangle((LEFT, TOP, right, TOP + SIZE[1]), outline=fill, width=3)
    draw.rectangle((right - draw.textlength(text) - 12, 2, right, TOP), fill=fill)
    draw.text((right - 6, 11), text, fill=ink, anchor="rm")


def _section(pane, view):
    """The section on the whole of the plot area."""
    image = Image.new("RGBA", SIZE, PAPER)
    section, colouring = pane.section, pane.colouring
    left, top, *size = (round(length) for length in view.picture)
    size = max(1, size[0]), max(1, size[1])
    few = tuple(np.minimum(size, section.shape[::-1]).tolist())
    levels = colouring.levels(resampled(section.amplitude, few))
    painted = Image.fromarray(colouring.palette[levels]).resize(size)
    image.paste(painted, (left, top), painted)
    return image.convert("RGB")


def _runs(points):
    """The stretches of a line between its breaks."""
    run = []
    for point in [*points, None]:
        if point is not None:
            run.append(point)
        elif len(run) > 1:
            yield np.array(run)
            run = []
        else:
            run = []
