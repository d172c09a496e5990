"""Gestures as plain values, in present-day coordinates, and hit tests for them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.interaction.projection import PaneProjection

REACH = 8.0  # css pixels within which a press hits something
SUBDIVISIONS = 8  # per segment, for panes in which straight lines look bent

ToPixels = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Press:
    """A button goes down.

    Parameters
    ----------
    point : tuple (x, z)
        On the present-day section, in its units; NaN where a restored pane shows nothing.
    pixel : tuple (px, pz)
        In css pixels of the pane's plot area.
    projection : PaneProjection
        How the pane shows the present-day section.
    button : int
        0 is the main button, or a finger.
    modifiers : frozenset of {"ctrl", "meta", "shift", "alt"}
    reach : float
        Distance within which something counts as hit, in css pixels; larger for a finger.
    """

    point: tuple[float, float]
    pixel: tuple[float, float]
    projection: PaneProjection
    button: int = 0
    modifiers: frozenset[str] = frozenset()
    reach: float = REACH


@dataclass(frozen=True, eq=False)
class Move:
    """The pointer moves; see `Press`."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    projection: PaneProjection
    modifiers: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class Release:
    """A button goes up; see `Press`. ``cancelled`` revokes the press, as when a second finger comes down."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    projection: PaneProjection
    modifiers: frozenset[str] = frozenset()
    cancelled: bool = False


@dataclass(frozen=True, eq=False)
class DoubleClick:
    """The second of two clicks, after its press and release; see `Press`."""

    point: tuple[float, float]
    pixel: tuple[float, float]
    projection: PaneProjection
    modifiers: frozenset[str] = frozenset()
    reach: float = REACH


@dataclass(frozen=True, eq=False)
class Key:
    """A key goes down, by the name that browsers give it ("a", "Enter", "ArrowLeft", " ")."""

    name: str
    projection: PaneProjection
    modifiers: frozenset[str] = frozenset()


Gesture = Press | Move | Release | DoubleClick | Key


def vertex_under(event: Press | DoubleClick, points: ArrayLike, to_pixels: ToPixels) -> tuple[int, float] | None:
    """Index of the nearest point and its distance in css pixels; None if no point is within reach."""
    distances = np.hypot(*(_pixels(points, to_pixels) - event.pixel).T)
    nearest = int(np.argmin(distances)) if len(distances) else 0
    return (nearest, float(distances[nearest])) if len(distances) and distances[nearest] <= event.reach else None


def line_under(
    event: Press | DoubleClick, points: ArrayLike, to_pixels: ToPixels
) -> tuple[int, tuple[float, float], float] | None:
    """Nearest point on a line, if it is within reach of a press.

    Returns
    -------
    vertex : int
        Index of the vertex that follows the point.
    point : (x, z)
    distance : float
        In css pixels.
    """
    line = np.asarray(points, float)
    if len(line) < 2:
        return None
    parameters = np.linspace(0, len(line) - 1, SUBDIVISIONS * (len(line) - 1) + 1)
    pixels = _pixels(_interpolated(line, parameters), to_pixels)
    start, arm = pixels[:-1], np.diff(pixels, axis=0)
    lengths = np.where((arm**2).sum(axis=1) > 0, (arm**2).sum(axis=1), 1.0)
    share = np.clip(((event.pixel - start) * arm).sum(axis=1) / lengths, 0, 1)
    distances = np.hypot(*(start + share[:, None] * arm - event.pixel).T)
    nearest = int(np.argmin(distances))
    if not distances[nearest] <= event.reach:
        return None
    parameter = parameters[nearest] + share[nearest] / SUBDIVISIONS
    x, z = _interpolated(line, np.array([parameter]))[0]
    return min(int(parameter) + 1, len(line) - 1), (float(x), float(z)), float(distances[nearest])


def _interpolated(points: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """Points of a line at fractional vertex indices."""
    index = np.arange(len(points))
    return np.column_stack([np.interp(parameters, index, points[:, 0]), np.interp(parameters, index, points[:, 1])])


def _pixels(points: ArrayLike, to_pixels: ToPixels) -> np.ndarray:
    """Pixels of points; those that the pane does not show are put very far away."""
    pixels = np.asarray(to_pixels(np.reshape(np.asarray(points, float), (-1, 2))), float)
    return np.where(np.isfinite(pixels).all(axis=1, keepdims=True), pixels, 1e12)
