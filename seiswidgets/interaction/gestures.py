"""What a hand does, as plain values, and what lies under it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

REACH = 8.0  # css pixels: how near a press must be to take hold of something
FINE = 8  # stretches of a segment, in a pane where straight lines look bent

ToPixels = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Press:
    """A button goes down.

    Parameters
    ----------
    point : tuple (x, z)
        On the original section, in its units; NaN where a restored pane shows nothing.
    pixel : tuple (px, pz)
        In css pixels of the pane's plot area.
    button : int
        0 is the main one, or a finger.
    modifiers : frozenset of {"ctrl", "meta", "shift", "alt"}
    reach : float
        How near to something counts as on it, in css pixels; more for a finger.
    """

    point: tuple[float, float]
    pixel: tuple[float, float]
    button: int = 0
    modifiers: frozenset = frozenset()
    reach: float = REACH


@dataclass(frozen=True)
class Move:
    """The pointer is elsewhere; see `Press`."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    modifiers: frozenset = frozenset()


@dataclass(frozen=True)
class Release:
    """A button goes up; see `Press`. If ``cancelled``, the press was none, as when a second finger comes down."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    modifiers: frozenset = frozenset()
    cancelled: bool = False


@dataclass(frozen=True)
class DoubleClick:
    """The second click of two, after its press and release; see `Press`."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    modifiers: frozenset = frozenset()
    reach: float = REACH


@dataclass(frozen=True)
class Key:
    """A key goes down, by the name that browsers give it ("a", "Enter", "ArrowLeft", " ")."""

    name: str
    modifiers: frozenset = frozenset()


Gesture = Press | Move | Release | DoubleClick | Key


def vertex_under(event: Press, points, to_pixels: ToPixels) -> tuple[int, float] | None:
    """The nearest of some points and its distance in pixels; None if none is within reach."""
    away = np.hypot(*(_pixels(points, to_pixels) - event.pixel).T)
    nearest = int(np.argmin(away)) if len(away) else 0
    return (nearest, float(away[nearest])) if len(away) and away[nearest] <= event.reach else None


def line_under(event: Press, points, to_pixels: ToPixels) -> tuple[int, tuple[float, float], float] | None:
    """The place of a line nearest to a press, if it is within reach.

    Returns
    -------
    vertex : int
        The one that follows.
    point : (x, z)
    distance : float
        In css pixels.
    """
    points = np.asarray(points, float)
    if len(points) < 2:
        return None
    ways = np.linspace(0, len(points) - 1, FINE * (len(points) - 1) + 1)
    pixels = _pixels(_along(points, ways), to_pixels)
    start, arm = pixels[:-1], np.diff(pixels, axis=0)
    lengths = np.where((arm**2).sum(axis=1) > 0, (arm**2).sum(axis=1), 1.0)
    share = np.clip(((event.pixel - start) * arm).sum(axis=1) / lengths, 0, 1)
    away = np.hypot(*(start + share[:, None] * arm - event.pixel).T)
    nearest = int(np.argmin(away))
    if not away[nearest] <= event.reach:
        return None
    way = ways[nearest] + share[nearest] / FINE
    x, z = _along(points, np.array([way]))[0]
    return min(int(way) + 1, len(points) - 1), (float(x), float(z)), float(away[nearest])


def _along(points, ways):
    number = np.arange(len(points))
    return np.column_stack([np.interp(ways, number, points[:, 0]), np.interp(ways, number, points[:, 1])])


def _pixels(points, to_pixels):
    """Pixels of points, those that are not shown infinitely far off."""
    pixels = np.asarray(to_pixels(np.reshape(np.asarray(points, float), (-1, 2))), float)
    return np.where(np.isfinite(pixels).all(axis=1, keepdims=True), pixels, 1e12)
