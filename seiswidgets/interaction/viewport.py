"""What a pane shows: a window of a section on so many pixels, zoomed, panned and stretched, and its axes."""

from dataclasses import dataclass, replace

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

FEWEST = 4  # traces and samples across the window: no closer than that
FARTHEST = 2.0  # times the section, in the direction that is filled more: no farther than that
APART_X, APART_Z = 95, 45  # css pixels between ticks, about

Window = tuple[float, float, float, float]


@dataclass(frozen=True)
class Axis:
    """An axis of a pane.

    Attributes
    ----------
    title : str
        What is measured along it, and the unit: "Distance (m)".
    ticks : tuple of float
        Round positions in the window, in the section's unit.
    pixels : tuple of float
        The same in css pixels from the left or from the top.
    labels : tuple of str
    """

    title: str
    ticks: tuple[float, ...]
    pixels: tuple[float, ...]
    labels: tuple[str, ...]


@dataclass(frozen=True)
class Viewport:
    """The part of a section that a pane shows, and on how many pixels.

    Pixels are css pixels of the plot area, from its upper left corner, (right, down); those of the backing store are
    more of the same where the screen has a higher resolution. A view is a value: its methods return a new one.

    Parameters
    ----------
    section : Section
    width, height : float
        Of the plot area, in css pixels.
    pixel_ratio : float
        Device pixels in one css pixel.
    window : tuple (x_min, x_max, z_min, z_max), optional
        In the section's units; all of the frame if left out.
    frame : tuple (x_min, x_max, z_min, z_max), optional
        What a fitted view shows; the whole section if left out. Panes whose sections differ in extent share one.

    Raises
    ------
    SettingError
        If a size is not above 0, or the window or the frame is empty.
    """

    section: Section
    width: float = 900.0
    height: float = 600.0
    pixel_ratio: float = 1.0
    window: Window | None = None
    frame: Window | None = None

    def __post_init__(self):
        for name in ("width", "height", "pixel_ratio"):
            object.__setattr__(self, name, _above_zero(name, getattr(self, name)))
        if self.frame is not None:
            object.__setattr__(self, "frame", checked_window("frame", self.frame))
        window = self.whole if self.window is None else checked_window("window", self.window)
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
        """Whether the window is the whole and no more."""
        return self.window == self.whole

    @property
    def exaggeration(self) -> float:
        """How much taller rock is drawn than it is, compared with its width; 1 is true proportions."""
        x_scale, z_scale = self.size / (_spans(self.window) * self.section.metres)
        return float(z_scale / x_scale)

    @property
    def size(self) -> np.ndarray:
        """Width and height in css pixels, shape (2,)."""
        return np.array([self.width, self.height])

    @property
    def backing(self) -> tuple[int, int]:
        """Width and height of the backing store, in device pixels."""
        return tuple(max(1, round(length * self.pixel_ratio)) for length in (self.width, self.height))

    @property
    def pixel(self) -> np.ndarray:
        """How far a css pixel reaches on the section, along x and along z; shape (2,)."""
        return _spans(self.window) / self.size

    @property
    def picture(self) -> tuple[float, float, float, float]:
        """Where the picture of the whole section lies: left, top, width and height, in css pixels."""
        (left, top), (right, bottom) = self.to_pixels(_corners(self.covered))
        return float(left), float(top), float(right - left), float(bottom - top)

    def to_pixels(self, points) -> np.ndarray:
        """Css pixels of points on the section, of the same shape, (n, 2) or (2,)."""
        return (np.asarray(points, float) - _corners(self.window)[0]) / self.pixel

    def to_section(self, pixels) -> np.ndarray:
        """Points on the section at css pixels, of the same shape, (n, 2) or (2,)."""
        return _corners(self.window)[0] + np.asarray(pixels, float) * self.pixel

    def to_backing(self, points) -> np.ndarray:
        """Device pixels, on the backing store, of points on the section; of the same shape."""
        return self.to_pixels(points) * (self.backing / self.size)

    def from_backing(self, pixels) -> np.ndarray:
        """Points on the section at device pixels of the backing store; of the same shape."""
        return self.to_section(np.asarray(pixels, float) / (self.backing / self.size))

    def fitted(self) -> "Viewport":
        """The whole, filling the pane."""
        return replace(self, window=None)

    def framed(self, frame: Window | None) -> "Viewport":
        """With another frame: a fitted view stays fitted, any other shows what it showed."""
        return replace(self, frame=frame, window=None if self.is_fitted else self.window)

    def of(self, section: Section) -> "Viewport":
        """Of another section: a fitted view stays fitted, any other shows the same window if the units are the same."""
        same = (section.x_unit, section.z_unit) == (self.section.x_unit, self.section.z_unit)
        return replace(self, section=section, window=self.window if same and not self.is_fitted else None)

    def zoomed(self, factor: float, at=None) -> "Viewport":
        """Closer by a factor (farther if below 1), the point under a css pixel staying there; by default the centre.

        The window keeps a few samples across, does not go far beyond the section, and always touches it.
        """
        factor = _above_zero("factor", factor)
        spans = _spans(self.window)
        closest = (spans / (FEWEST * np.array([self.section.dx, self.section.dz]))).min()
        farthest = (spans / (FARTHEST * _spans(self.whole))).min()
        factor = np.clip(factor, min(1.0, farthest), max(1.0, closest))
        held = self.to_section(self.size / 2 if at is None else at)
        corners = held + (_corners(self.window) - held) / factor
        low, high = _corners(self.whole)
        return self._with(corners + np.maximum(0, low - corners[1]) - np.maximum(0, corners[0] - high))

    def panned(self, dx: float, dz: float) -> "Viewport":
        """The picture moved right and down by css pixels; its middle stays on the section."""
        corners = _corners(self.window)
        (low, high), middle = _corners(self.whole), corners.mean(axis=0)
        moved = np.clip(middle - np.array([dx, dz]) * self.pixel, np.minimum(low, middle), np.maximum(high, middle))
        return self._with(corners + moved - middle)

    def exaggerated(self, value: float) -> "Viewport":
        """With a vertical exaggeration, what is shown of x staying as it is; 1 is true proportions.

        Where the pane is higher than the section then is, the section lies in its middle.
        """
        value = _above_zero("exaggeration", value)
        (x_min, z_min), (x_max, z_max) = _corners(self.window)
        reach = (z_max - z_min) * self.exaggeration / value
        low, high = self.whole[2:]
        middle = (low + high) / 2 if reach >= high - low else (z_min + z_max) / 2
        stretched = self._with(np.array([[x_min, middle - reach / 2], [x_max, middle + reach / 2]]))
        return stretched.zoomed(min(1.0, reach / (FEWEST * self.section.dz)))

    def resized(self, width: float, height: float, pixel_ratio: float | None = None) -> "Viewport":
        """On another number of pixels: a fitted view stays fitted, any other keeps its exaggeration and its x."""
        ratio = self.pixel_ratio if pixel_ratio is None else pixel_ratio
        view = replace(self, width=width, height=height, pixel_ratio=ratio)
        if self.is_fitted:
            return view
        (x_min, z_min), (x_max, z_max) = _corners(self.window)
        middle, reach = (z_min + z_max) / 2, (z_max - z_min) * view.exaggeration / self.exaggeration
        return view._with(np.array([[x_min, middle - reach / 2], [x_max, middle + reach / 2]]))

    def ticks(self) -> tuple[Axis, Axis]:
        """The axes of x and of z, with round ticks inside the window."""
        x_min, x_max, z_min, z_max = self.window
        z_title = f"{'Two-way time' if self.section.is_time else 'Depth'} ({self.section.z_unit})"
        return (
            _axis(f"Distance ({self.section.x_unit})", x_min, x_max, self.width, APART_X),
            _axis(z_title, z_min, z_max, self.height, APART_Z),
        )

    def _with(self, corners):
        return replace(self, window=tuple(corners.T.ravel().tolist()))


def checked_window(name: str, window) -> Window:
    """A window as a tuple of floats; SettingError if it is not finite or empty."""
    try:
        x_min, x_max, z_min, z_max = checked = tuple(float(value) for value in window)
    except (TypeError, ValueError):
        checked = x_min, x_max, z_min, z_max = (np.nan,) * 4
    if not (np.isfinite(checked).all() and x_min < x_max and z_min < z_max):
        raise SettingError(f"{name} must be (x_min, x_max, z_min, z_max), each minimum first, but is {window!r}")
    return checked


def _axis(title, low, high, length, apart):
    step, decimals = _step((high - low) * apart / length, (high - low) / 2)
    ticks = np.round(np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step, decimals) + 0.0
    ticks = ticks[(ticks >= low) & (ticks <= high)]
    pixels = (ticks - low) * length / (high - low)
    return Axis(title, tuple(ticks.tolist()), tuple(pixels.tolist()), tuple(f"{tick:.{decimals}f}" for tick in ticks))


def _step(wanted, most):
    """The first of 1, 2, 5, 10, ... that is no less than what is wanted, but at most so much; and its decimals."""
    exponents = range(int(np.floor(np.log10(min(wanted, most)))) - 1, int(np.floor(np.log10(wanted))) + 2)
    steps = [(float(f"{digit}e{exponent}"), max(0, -exponent)) for exponent in exponents for digit in (1, 2, 5)]
    enough = next(step for step in steps if step[0] >= wanted)
    return enough if enough[0] <= most else max(step for step in steps if step[0] <= most)


def _corners(window):
    """Upper left and lower right, as rows of points."""
    return np.reshape(window, (2, 2)).T


def _spans(window):
    return np.diff(_corners(window), axis=0)[0]


def _above_zero(name, value):
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not (np.isfinite(number) and number > 0):
        raise SettingError(f"{name} must be a finite number above 0, but is {value!r}")
    return number
