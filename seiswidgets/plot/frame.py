"""What a picture shows of a section: its window, its proportions, and what is said beside it."""

from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

OUTSIDE = "#f1ece1"  # where there are no data
WIDTH = 9.0  # inches of a figure: a notebook's width
EXAGGERATIONS = (1, 1.5, 2, 3, 4, 5, 8, 10, 15, 20, 30, 50, 100)
TALLEST = 0.5  # height over width that the exaggeration is chosen for
AS_IT_IS = {"parse_math": False}  # names are data: a $ in one begins no formula
FOOTNOTE = {"fontsize": 7.5, "color": "0.35", "ha": "left", **AS_IT_IS}

Window = tuple[float, float, float, float]


@dataclass(frozen=True)
class PlotFrame:
    """The part of a section that is shown, ``(x_min, x_max, z_min, z_max)``, and its vertical exaggeration."""

    section: Section
    window: Window
    exaggeration: float

    @property
    def aspect(self):
        """Length of a unit of z over that of a unit of x, on the screen."""
        x, z = self.section.metres
        return self.exaggeration * z / x

    @property
    def shape(self):
        """Height over width on the screen."""
        x_min, x_max, z_min, z_max = self.window
        return self.aspect * (z_max - z_min) / (x_max - x_min)

    def seen(self, points):
        """Those of some points that lie in the window."""
        x_min, x_max, z_min, z_max = self.window
        x, z = points.T
        return points[(x >= x_min) & (x <= x_max) & (z >= z_min) & (z <= z_max)]

    def axes(self):
        """The Axes of a figure of its own."""
        size = WIDTH, max(2.5, 0.88 * WIDTH * self.shape + 1.0)
        return plt.subplots(figsize=size, layout="constrained")[1]

    def put_on(self, ax, title):
        """Give an Axes the frame's limits, proportions and units, and a title."""
        x_min, x_max, z_min, z_max = self.window
        kind = "Two-way time" if self.section.is_time else "Depth"
        ax.set(xlim=(x_min, x_max), ylim=(z_max, z_min), aspect=self.aspect, facecolor=OUTSIDE)
        ax.set(xlabel=f"Distance ({self.section.x_unit})", ylabel=f"{kind} ({self.section.z_unit})")
        ax.set_title(title, loc="left", fontsize="medium", **AS_IT_IS)

    def footnote(self):
        """Vertical exaggeration, and whom the data are owed to."""
        text = "true proportions" if self.exaggeration == 1 else f"vertical exaggeration {self.exaggeration:.3g}×"
        at = f" at {self.section.velocity:g} m/s" if self.section.is_time else ""
        return text + at + (f"   |   data: {self.section.credit}" if self.section.credit else "")

    def put_footnote(self, ax):
        """Write the footnote under the label of x."""
        below = ("axes fraction", ax.xaxis.label)
        ax.annotate(self.footnote(), (0, 0), (0, -4), below, "offset points", va="top", **FOOTNOTE)

    def put_footnote_below(self, figure):
        """Write the footnote under a whole figure."""
        figure.supxlabel(self.footnote(), x=0.01, **FOOTNOTE)


def framed(section: Section, shown: Sequence[Section], exaggeration: float | None, window: Window | None) -> PlotFrame:
    """The frame that holds all of some sections, or a window, with an exaggeration that suits the original's part."""
    if window is not None:
        window = _checked_window(window)
    if exaggeration is None:
        true = PlotFrame(section, window or edges(section), 1.0).shape
        exaggeration = max((e for e in EXAGGERATIONS if e * true <= TALLEST), default=1)
    elif not (np.isfinite(exaggeration) and exaggeration > 0):
        raise SettingError(f"exaggeration must be above 0, and 1 for true proportions, but is {exaggeration!r}")
    if window is None:
        x_min, x_max, z_min, z_max = np.transpose([edges(one) for one in shown])
        window = x_min.min(), x_max.max(), z_min.min(), z_max.max()
    return PlotFrame(section, window, exaggeration)


def edges(section: Section) -> Window:
    """The outer edges of a section's cells."""
    x_min, x_max, z_min, z_max = section.extent
    return x_min - section.dx / 2, x_max + section.dx / 2, z_min - section.dz / 2, z_max + section.dz / 2


def _checked_window(window):
    values = tuple(float(value) for value in window)
    if len(values) != 4 or not (values[0] < values[1] and values[2] < values[3]):
        raise SettingError(f"window must be (x_min, x_max, z_min, z_max), each minimum first, but is {window!r}")
    return values
