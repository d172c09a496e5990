"""Window, proportions and annotations shared by the figures of a section."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

NO_DATA = "#f1ece1"  # colour where there are no data
WIDTH = 9.0  # inches of a figure: a notebook's width
EXAGGERATIONS = (1, 1.5, 2, 3, 4, 5, 8, 10, 15, 20, 30, 50, 100)
TALLEST = 0.5  # height over width that the exaggeration is chosen for
PLAIN_TEXT: dict[str, Any] = {"parse_math": False}  # names are data: a $ in one does not begin a formula
FOOTNOTE: dict[str, Any] = {"fontsize": 7.5, "color": "0.35", "ha": "left", **PLAIN_TEXT}

Window = tuple[float, float, float, float]


@dataclass(frozen=True)
class PlotFrame:
    """The visible part of a section, ``(x_min, x_max, z_min, z_max)``, and its vertical exaggeration."""

    section: Section
    window: Window
    exaggeration: float

    @property
    def aspect(self) -> float:
        """Length of a unit of z divided by that of a unit of x, on the screen."""
        x, z = self.section.metres
        return float(self.exaggeration * z / x)

    @property
    def height_over_width(self) -> float:
        """Height divided by width, on the screen."""
        x_min, x_max, z_min, z_max = self.window
        return self.aspect * (z_max - z_min) / (x_max - x_min)

    def visible(self, points: np.ndarray) -> np.ndarray:
        """Select the points that lie in the window, shape (n, 2)."""
        x_min, x_max, z_min, z_max = self.window
        x, z = points.T
        return points[(x >= x_min) & (x <= x_max) & (z >= z_min) & (z <= z_max)]

    def new_axes(self) -> Axes:
        """Make a figure for one Axes."""
        size = WIDTH, max(2.5, 0.88 * WIDTH * self.height_over_width + 1.0)
        return plt.subplots(figsize=size, layout="constrained")[1]

    def apply_to(self, ax: Axes, title: str) -> None:
        """Give an Axes the frame's limits, proportions and units, and a title."""
        x_min, x_max, z_min, z_max = self.window
        z_name = "Two-way time" if self.section.is_time else "Depth"
        ax.set(xlim=(x_min, x_max), ylim=(z_max, z_min), aspect=self.aspect, facecolor=NO_DATA)
        ax.set(xlabel=f"Distance ({self.section.x_unit})", ylabel=f"{z_name} ({self.section.z_unit})")
        ax.set_title(title, loc="left", fontsize="medium", **PLAIN_TEXT)

    @property
    def footnote(self) -> str:
        """Vertical exaggeration, and credit for the data."""
        text = "true proportions" if self.exaggeration == 1 else f"vertical exaggeration {self.exaggeration:.3g}×"
        velocity = f" at {self.section.velocity:g} m/s" if self.section.is_time else ""
        return text + velocity + (f"   |   data: {self.section.credit}" if self.section.credit else "")

    def add_footnote(self, ax: Axes) -> None:
        """Write the footnote below the label of x."""
        below = ("axes fraction", ax.xaxis.label)
        ax.annotate(self.footnote, (0, 0), (0, -4), below, "offset points", va="top", **FOOTNOTE)

    def add_footnote_below(self, figure: Figure) -> None:
        """Write the footnote below a whole figure."""
        figure.supxlabel(self.footnote, x=0.01, **FOOTNOTE)


def plot_frame(
    section: Section, shown: Sequence[Section], exaggeration: float | None, window: Window | None
) -> PlotFrame:
    """The frame of a window, or else of all that some sections cover, with an exaggeration that suits the original."""
    if window is not None:
        window = _checked_window(window)
    if exaggeration is None:
        true = PlotFrame(section, window or edges(section), 1.0).height_over_width
        exaggeration = max((value for value in EXAGGERATIONS if value * true <= TALLEST), default=1)
    elif not (np.isfinite(exaggeration) and exaggeration > 0):
        raise SettingError(f"exaggeration must be above 0, or 1 for true proportions, but is {exaggeration!r}")
    if window is None:
        x_min, x_max, z_min, z_max = np.transpose([edges(one) for one in shown])
        window = x_min.min(), x_max.max(), z_min.min(), z_max.max()
    return PlotFrame(section, window, exaggeration)


def edges(section: Section) -> Window:
    """The outer edges of a section's cells."""
    x_min, x_max, z_min, z_max = section.extent
    return x_min - section.dx / 2, x_max + section.dx / 2, z_min - section.dz / 2, z_max + section.dz / 2


def _checked_window(window: Sequence[float]) -> Window:
    values = [float(value) for value in window]
    if len(values) != 4 or not (values[0] < values[1] and values[2] < values[3]):
        raise SettingError(f"window must be (x_min, x_max, z_min, z_max), each minimum first, but is {window!r}")
    x_min, x_max, z_min, z_max = values
    return x_min, x_max, z_min, z_max
