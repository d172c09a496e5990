"""How a pane sees the section of today: lines go from it to the pane and back, and break where they jump at a fault."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from seiswidgets.geology.restoration import Restoration
from seiswidgets.interaction.viewport import Viewport

APART = 2.0  # css pixels between the places at which a line is carried
MOST = 4000  # places of one line
OFF = 0.02  # css pixels that a line is moved off a fault, to belong to one of its sides
JUMP = 3.0  # times as far apart after as before: the two places lie on either side of a fault
COARSE = 0.1  # of a trace and a sample: how far a carried line may be from where it belongs


@dataclass(frozen=True, eq=False)
class PaneProjection:
    """What a pane shows of the original section.

    Parameters
    ----------
    view : Viewport
        Of the pane.
    restoration : Restoration, optional
        That the pane shows the result of; left out for a pane of the original itself.
    """

    view: Viewport
    restoration: Restoration | None = None

    def to_pixels(self, points) -> np.ndarray:
        """Css pixels in the pane of points of the original, NaN where they are not shown; shape (n, 2)."""
        return self.view.to_pixels(self.to_pane(points))

    def to_pane(self, points) -> np.ndarray:
        """Where points of the original lie in the pane's section, NaN where nowhere; shape (n, 2)."""
        points = np.reshape(np.asarray(points, float), (-1, 2))
        return points if self.restoration is None else self.restoration.to_restored(points)

    def to_original(self, point) -> tuple[float, float]:
        """Where a point of the pane's section lies in the original, NaN where nowhere."""
        if self.restoration is None:
            return tuple(map(float, point))
        return tuple(self.restoration.to_original([point])[0].tolist())

    def vertices(self, lines) -> list[np.ndarray]:
        """Where the vertices of lines of the original are seen in the pane, each of shape (n, 2); lines as `shown`.

        The ends of a horizon go with what lies between them, and a fault with one side of itself.
        """
        clear = [_clear(line, self.view.pixel, is_fault) for line, is_fault in lines]
        return _together(self.to_pane, clear if self.restoration else [line for line, _ in lines])

    def vertex_pixels(self, line, is_fault: bool = False) -> np.ndarray:
        """Css pixels in the pane of the vertices of one line, shape (n, 2)."""
        return self.view.to_pixels(self.vertices([(line, is_fault)])[0])

    def shown(self, lines) -> list[np.ndarray]:
        """Lines of the original as they are seen in the pane, with a row of NaN where one is interrupted.

        Parameters
        ----------
        lines : list of (points, is_fault)
            Points of shape (n, 2), and whether they are a fault's.
        """
        if self.restoration is None:
            return [np.asarray(line, float) for line, _ in lines]
        clear = [_clear(line, self.view.pixel, is_fault) for line, is_fault in lines]
        return [_with_gaps(runs) for runs in _carried(clear, self.to_pane, self.view)]

    def path(self, start, end) -> list[np.ndarray]:
        """The stretches of the original that make a straight line in the pane from one of its points to another.

        More than one where the line crosses a fault; their outer ends are the two points.
        """
        ends = np.array([start, end], float)
        seen = self.to_pane(ends)
        if self.restoration is None or not np.isfinite(seen).all():
            return [ends]
        (runs,) = _carried([seen], self.restoration.to_original, self.view)
        if not runs:
            return [ends]
        runs[0][0], runs[-1][-1] = ends
        return runs


def _clear(line, pixel, is_fault):
    """A line moved off the faults by a fraction of a pixel: inwards at its ends, and a fault sideways."""
    line = np.array(line, float)
    if len(line) < 2:
        return line
    along = np.gradient(line / pixel, axis=0)
    along[~along.any(axis=1)] = 1.0  # at a point that is doubled
    off = OFF * along / np.hypot(*along.T)[:, None]
    if is_fault:
        line += pixel * off[:, ::-1] * [-1, 1]
    line[0] += 2 * pixel * off[0]
    line[-1] -= 2 * pixel * off[-1]
    return line


def _carried(lines, carry: Callable, view: Viewport) -> list[list[np.ndarray]]:
    """Lines carried along, each in stretches without the points that they can do without."""
    dense = [_dense(line, view.pixel) for line in lines]
    return [_runs(*both, view.section) for both in zip(dense, _together(carry, dense), strict=True)]


def _together(carry, lines):
    """Lines carried along, all in one call."""
    lengths = [len(line) for line in lines]
    return np.split(carry(np.concatenate([np.empty((0, 2)), *lines])), np.cumsum(lengths)[:-1]) if lines else []


def _runs(before, after, section):
    """The stretches of a line that was carried along."""
    steps = (np.hypot(*(np.diff(points, axis=0) * section.metres).T) for points in (before, after))
    short, long = (np.nan_to_num(step, nan=np.inf) for step in steps)
    breaks = np.flatnonzero(~(long <= JUMP * short)) + 1
    runs = (run[np.isfinite(run).all(axis=1)] for run in np.split(after, breaks))
    return [_simplified(run, np.array([section.dx, section.dz])) for run in runs if len(run) > 1]


def _with_gaps(runs):
    return np.concatenate([row for run in runs for row in (run, [[np.nan, np.nan]])]) if runs else np.empty((0, 2))


def _dense(line, pixel):
    """A line with points about a pixel apart, those of its own among them."""
    line = np.asarray(line, float)
    lengths = np.hypot(*(np.diff(line, axis=0) / pixel).T) / APART
    share = min(1.0, MOST / max(1.0, lengths.sum()))
    counts = np.maximum(1, np.ceil(lengths * share)).astype(int)
    ways = np.concatenate([[0.0], *(number + np.arange(1, count + 1) / count for number, count in enumerate(counts))])
    number = np.arange(len(line))
    return np.column_stack([np.interp(ways, number, line[:, 0]), np.interp(ways, number, line[:, 1])])


def _simplified(run, cell):
    return np.array(shapely.LineString(run / cell).simplify(COARSE, preserve_topology=False).coords) * cell
