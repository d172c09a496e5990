"""The view of a pane: a window of a section, zoomed, panned and stretched to the pane's pixels, and its axes."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

FEWEST = 4  # traces and samples across the window at the closest zoom
FARTHEST = 2.0  # times the section, in the direction that fills the pane more, at the farthest zoom
TICK_DISTANCE_X, TICK_DISTANCE_Z = 95, 45  # approximate, in css pixels

Window = tuple[float, float, float, float]
WHOLE: Window = None  # type: ignore[assignment] # a request for the whole, which Viewport replaces by a window


@dataclass(frozen=True)
class Axis:
    """An axis of a pane.

    Attributes
    ----------
    title : str
        The quantity and its unit: "Distance (m)".
    ticks : tuple of float
        Round positions in the window, in the section's unit.
    pixels : tuple of float
        The same positions in css pixels from the left or from the top.
    labels : tuple of str
    """

    title: str
    ticks: tuple[float, ...]
    pixels: tuple[float, ...]
    labels: tuple[str, ...]


@dataclass(frozen=True)
class Viewport:
    """The part of a section that a pane shows, and the size of the pane.

    Pixels are css pixels of the plot area, (right, down) from its upper left corner. On a high-resolution screen the
    backing store has more pixels than that. A viewport is a value: its methods return a new one.

    Parameters
    ----------
    section : Section
    width, height : float
        Size of the plot area in css pixels.
    pixel_ratio : float
        Device pixels per css pixel.
    window : tuple (x_min, x_max, z_min, z_max), optional
        Part of the section shown, in the section's units; the whole frame if left out.
    frame : tuple (x_min, x_max, z_min, z_max), optional
        Window of a fitted view; the whole section if left out. Panes whose sections differ in extent share one.

    Raises
    ------
    SettingError
        If a size is not above 0, or if the window or the frame is empty.
    """

    section: Section
    width: float = 900.0
    height: float = 600.0
    pixel_ratio: float = 1.0
    window: Window = WHOLE
    frame: Window | None = None

    def __post_init__(self) -> None:
        for name in ("width", "height", "pixel_ratio"):
            object.__setattr__(self, name, _above_zero(name, getattr(self, name)))
        if self.frame is not None:
            object.__setattr__(self, "frame", checked_window("frame", self.frame))
        window = self.whole if self.window is WHOLE else checked_window("window", self.window)
        object.__setattr__(self, "window", window)

    @property
    def covered(self) -> Window:
        """The window that the section covers, to the outer edges of its cells."""
        x_min, x_max, z_min, z_max = self.section.extent
        x, z = self.section.dx / 2, self.section.dz / 2
        return x_min - x, x_max + x, z_min - z, z_max + z

    @property
    def whole(self) -> Window:
        """The window of a fitted view: the frame, or what the section covers."""
        return self.covered if self.frame is None else self.frame

    @property
    def is_fitted(self) -> bool:
        """True if the window is exactly the whole."""
        return self.window == self.whole

    @property
    def exaggeration(self) -> float:
        """Vertical exaggeration of the rock as drawn; 1 is true proportions."""
        x_scale, z_scale = self.size / (_spans(self.window) * self.section.metres)
        return float(z_scale / x_scale)

    @property
    def size(self) -> np.ndarray:
        """Width and height in css pixels, shape (2,)."""
        return np.array([self.width, self.height])

    @property
    def backing(self) -> tuple[int, int]:
        """Width and height of the backing store, in device pixels."""
        return max(1, round(self.width * self.pixel_ratio)), max(1, round(self.height * self.pixel_ratio))

    @property
    def pixel(self) -> np.ndarray:
        """Width and height of a css pixel in the section's units, shape (2,)."""
        return _spans(self.window) / self.size

    @property
    def picture(self) -> tuple[float, float, float, float]:
        """Left, top, width and height of the whole section's picture, in css pixels."""
        (left, top), (right, bottom) = self.to_pixels(_corners(self.covered))
        return float(left), float(top), float(right - left), float(bottom - top)

    def to_pixels(self, points: ArrayLike) -> np.ndarray:
        """Convert points on the section to css pixels; both have shape (n, 2) or (2,)."""
        return (np.asarray(points, float) - _corners(self.window)[0]) / self.pixel

    def to_section(self, pixels: ArrayLike) -> np.ndarray:
        """Convert css pixels to points on the section; both have shape (n, 2) or (2,)."""
        return _corners(self.window)[0] + np.asarray(pixels, float) * self.pixel

    def to_backing(self, points: ArrayLike) -> np.ndarray:
        """Convert points on the section to pixels of the backing store, in the same shape."""
        return self.to_pixels(points) * (self.backing / self.size)

    def from_backing(self, pixels: ArrayLike) -> np.ndarray:
        """Convert pixels of the backing store to points on the section, in the same shape."""
        return self.to_section(np.asarray(pixels, float) / (self.backing / self.size))

    def fitted(self) -> "Viewport":
        """View of the whole, filling the pane."""
        return replace(self, window=WHOLE)

    def with_frame(self, frame: Window | None) -> "Viewport":
        """View with another frame: a fitted view stays fitted, any other keeps its window."""
        return replace(self, frame=frame, window=WHOLE if self.is_fitted else self.window)

    def with_section(self, section: Section) -> "Viewport":
        """View of another section: a fitted view stays fitted, any other keeps its window if the units are equal."""
        same = (section.x_unit, section.z_unit) == (self.section.x_unit, self.section.z_unit)
        return replace(self, section=section, window=self.window if same and not self.is_fitted else WHOLE)

    def zoomed(self, factor: float, at: ArrayLike | None = None) -> "Viewport":
        """Zoom in by a factor (out if below 1) about a css pixel, by default the centre.

        The window keeps a few samples across, does not reach far beyond the section, and always touches it.
        """
        factor = _above_zero("factor", factor)
        spans = _spans(self.window)
        closest = (spans / (FEWEST * np.array([self.section.dx, self.section.dz]))).min()
        farthest = (spans / (FARTHEST * _spans(self.whole))).min()
        factor = np.clip(factor, min(1.0, farthest), max(1.0, closest))
        centre = self.to_section(self.size / 2 if at is None else at)
        corners = centre + (_corners(self.window) - centre) / factor
        low, high = _corners(self.whole)
        return self._with_corners(corners + np.maximum(0, low - corners[1]) - np.maximum(0, corners[0] - high))

    def panned(self, dx: float, dz: float) -> "Viewport":
        """View with the picture moved right and down by css pixels; its middle stays on the section."""
        corners = _corners(self.window)
        (low, high), middle = _corners(self.whole), corners.mean(axis=0)
        moved = np.clip(middle - np.array([dx, dz]) * self.pixel, np.minimum(low, middle), np.maximum(high, middle))
        return self._with_corners(corners + moved - middle)

    def exaggerated(self, value: float) -> "Viewport":
        """View with another vertical exaggeration, in which 1 is true proportions; the range of x stays.

        If the pane becomes taller than the section, the section is centred in it.
        """
        value = _above_zero("exaggeration", value)
        (x_min, z_min), (x_max, z_max) = _corners(self.window)
        reach = (z_max - z_min) * self.exaggeration / value
        low, high = self.whole[2:]
        middle = (low + high) / 2 if reach >= high - low else (z_min + z_max) / 2
        stretched = self._with_corners(np.array([[x_min, middle - reach / 2], [x_max, middle + reach / 2]]))
        return stretched.zoomed(min(1.0, reach / (FEWEST * self.section.dz)))

    def resized(self, width: float, height: float, pixel_ratio: float | None = None) -> "Viewport":
        """View in a pane of another size: a fitted one stays fitted, others keep their exaggeration and range of x."""
        ratio = self.pixel_ratio if pixel_ratio is None else pixel_ratio
        view = replace(self, width=width, height=height, pixel_ratio=ratio)
        if self.is_fitted:
            return view
        (x_min, z_min), (x_max, z_max) = _corners(self.window)
        middle, reach = (z_min + z_max) / 2, (z_max - z_min) * view.exaggeration / self.exaggeration
        return view._with_corners(np.array([[x_min, middle - reach / 2], [x_max, middle + reach / 2]]))

    def ticks(self) -> tuple[Axis, Axis]:
        """Axes of x and z, with round ticks inside the window."""
        x_min, x_max, z_min, z_max = self.window
        z_title = f"{'Two-way time' if self.section.is_time else 'Depth'} ({self.section.z_unit})"
        return (
            _axis(f"Distance ({self.section.x_unit})", x_min, x_max, self.width, TICK_DISTANCE_X),
            _axis(z_title, z_min, z_max, self.height, TICK_DISTANCE_Z),
        )

    def _with_corners(self, corners: np.ndarray) -> "Viewport":
        return replace(self, window=tuple(corners.T.ravel().tolist()))


def checked_window(name: str, window: Iterable[float]) -> Window:
    """Validate a window and return it as a tuple of floats; SettingError if it is empty or not finite."""
    try:
        x_min, x_max, z_min, z_max = (float(value) for value in window)
    except (TypeError, ValueError):
        x_min = x_max = z_min = z_max = np.nan
    if not (-np.inf < x_min < x_max < np.inf and -np.inf < z_min < z_max < np.inf):
        raise SettingError(f"{name} must be (x_min, x_max, z_min, z_max), each minimum first, but is {window!r}")
    return x_min, x_max, z_min, z_max


def _axis(title: str, low: float, high: float, length: float, tick_distance: float) -> Axis:
    step, decimals = _step((high - low) * tick_distance / length, (high - low) / 2)
    ticks = np.round(np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step, decimals) + 0.0
    ticks = ticks[(ticks >= low) & (ticks <= high)]
    pixels = (ticks - low) * length / (high - low)
    return Axis(title, tuple(ticks.tolist()), tuple(pixels.tolist()), tuple(f"{tick:.{decimals}f}" for tick in ticks))


def _step(least: float, most: float) -> tuple[float, int]:
    """Smallest of 1, 2, 5, 10, ... that is >= ``least``, or else the largest <= ``most``; and its decimals."""
    exponents = range(int(np.floor(np.log10(min(least, most)))) - 1, int(np.floor(np.log10(least))) + 2)
    steps = [(float(f"{digit}e{exponent}"), max(0, -exponent)) for exponent in exponents for digit in (1, 2, 5)]
    enough = next(step for step in steps if step[0] >= least)
    return enough if enough[0] <= most else max(step for step in steps if step[0] <= most)


def _corners(window: Window) -> np.ndarray:
    """Upper left and lower right corner, as rows of points."""
    return np.reshape(window, (2, 2)).T


def _spans(window: Window) -> np.ndarray:
    return np.diff(_corners(window), axis=0)[0]


def _above_zero(name: str, value: float) -> float:
    try:
        checked = float(value)
    except (TypeError, ValueError):
        checked = np.nan
    if not 0 < checked < np.inf:
        raise SettingError(f"{name} must be a finite number above 0, but is {value!r}")
    return checked
