"""The map between the present-day section and a pane: lines go both ways, and break where they jump at a fault."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import ArrayLike

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Point
from seiswidgets.interaction.viewport import Viewport

SAMPLE_DISTANCE = 2.0  # css pixels between the points at which a line is mapped
MOST_SAMPLES = 4000  # per line
OFFSET = 0.02  # css pixels that a line is moved off a fault, so that it belongs to one side
BESIDE = 0.5  # css pixels that a point may lie above or below the rock
JUMP = 3.0  # a step that grows by more than this factor crosses a fault
TOLERANCE = 0.1  # traces and samples that a simplified line may be off

Line = tuple[ArrayLike, int]  # its points, shape (n, 2), and the side that it goes with; see `side_of`
Map = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class PaneProjection:
    """The map between the present-day section and a pane.

    Parameters
    ----------
    view : Viewport
        View of the pane.
    restoration : Restoration, optional
        Restoration whose result the pane shows; left out for a pane of the present-day section itself.
    """

    view: Viewport
    restoration: Restoration | None = None

    def to_pixels(self, points: ArrayLike) -> np.ndarray:
        """Convert present-day points to css pixels in the pane, shape (n, 2); NaN where the pane has no such point."""
        return self.view.to_pixels(self.to_pane(points))

    def to_pane(self, points: ArrayLike) -> np.ndarray:
        """Map present-day points to the pane's section, shape (n, 2); NaN where it has no such point."""
        rows = np.reshape(np.asarray(points, float), (-1, 2))
        return rows if self.restoration is None else self.restoration.to_restored(rows)

    def to_original(self, point: ArrayLike) -> Point:
        """Map a point of the pane's section to the present-day section; NaN if it has no such point."""
        rows = np.reshape(np.asarray(point, float), (1, 2))
        x, z = (rows if self.restoration is None else self.restoration.to_original(rows))[0].tolist()
        return x, z

    def vertices(self, lines: Sequence[Line]) -> list[np.ndarray]:
        """Positions of the vertices of present-day lines in the pane's section, each of shape (n, 2).

        The ends of a horizon go with the rock between them, a fault with the rock on one side, and a body with the rock
        around it.

        Parameters
        ----------
        lines : sequence of (points, side)
            Points of shape (n, 2), and their side as by `side_of`.
        """
        return _mapped_together(self.to_pane, self._moved_off_faults(lines), self.view.pixel)

    def vertex_pixels(self, points: ArrayLike, side: int = 0) -> np.ndarray:
        """Css pixels in the pane of the vertices of one present-day line, shape (n, 2)."""
        return self.view.to_pixels(self.vertices([(points, side)])[0])

    def lines(self, lines: Sequence[Line]) -> list[np.ndarray]:
        """Present-day lines as the pane shows them, with a row of NaN where a line is interrupted.

        Parameters
        ----------
        lines : sequence of (points, side)
            As for ``vertices``.
        """
        if self.restoration is None:
            return [np.asarray(points, float) for points, _ in lines]
        return [_with_gaps(runs) for runs in _mapped(self._moved_off_faults(lines), self.to_pane, self.view)]

    def path(self, start: Point, end: Point) -> list[np.ndarray]:
        """Stretches on the present-day section that make a straight line in the pane from one point to another.

        There are several if the line crosses faults. The first begins at ``start``, the last ends at ``end``.
        """
        ends = np.array([start, end], float)
        pane_ends = self.to_pane(ends)
        if self.restoration is None or not np.isfinite(pane_ends).all():
            return [ends]
        (runs,) = _mapped([pane_ends], self.restoration.to_original, self.view)
        if not runs:
            return [ends]
        runs[0][0], runs[-1][-1] = ends
        return runs

    def moved(self, points: ArrayLike, side: int, shift: ArrayLike) -> np.ndarray:
        """Present-day points of a line that is moved by a shift in css pixels of the pane, shape (n, 2).

        In a restored pane, the part that stays in one block: what crosses a fault there, or leaves the rock, is cut
        off. Empty if the pane does not show the line.

        Parameters
        ----------
        points, side
            Present-day line, as for ``vertices``.
        """
        rows, shift = np.asarray(points, float), np.multiply(shift, self.view.pixel)
        if self.restoration is None:
            return rows + shift
        pane = self.vertices([(rows, side)])[0]
        if not np.isfinite(pane).all():
            return np.empty((0, 2))
        dense, at = _densified(pane + shift, self.view.pixel)
        back = self.restoration.to_original(dense)
        starts = [0, *_breaks(dense, back, self.view.section), len(at)]
        runs = [slice(*ends) for ends in pairwise(starts) if np.isfinite(back[slice(*ends)]).all()]
        run = max(runs, key=lambda run: run.stop - run.start, default=slice(0))
        kept = at[run] % 1 == 0
        kept[:1] = kept[-1:] = True
        return np.asarray(back[run][kept])

    def _moved_off_faults(self, lines: Sequence[Line]) -> list[np.ndarray]:
        if self.restoration is None:
            return [np.asarray(points, float) for points, _ in lines]
        return [moved_off_fault(points, self.view.pixel, side) for points, side in lines]


def side_of(kind: str, points: ArrayLike) -> int:
    """The side of a pick whose rock it moves with: 1 or -1 for a fault or the border of a body, 0 for a horizon."""
    if kind != BODY:
        return int(kind == FAULT)
    (x, z), (next_x, next_z) = (np.roll(np.asarray(points, float), shift, axis=0).T for shift in (0, -1))
    return 1 if np.sum(x * next_z - next_x * z) < 0 else -1


def moved_off_fault(points: ArrayLike, pixel: np.ndarray, side: int) -> np.ndarray:
    """Move a line off the faults by a fraction of a pixel: its ends inwards, and unless it has no side, sideways."""
    line = np.array(points, float)
    if len(line) < 2:
        return line
    along = np.gradient(line / pixel, axis=0)
    along[~along.any(axis=1)] = 1.0  # between two equal points
    offset = OFFSET * along / np.hypot(*along.T)[:, None]
    line += side * pixel * offset[:, ::-1] * [-1, 1]
    line[0] += 2 * pixel * offset[0]
    line[-1] -= 2 * pixel * offset[-1]
    return line


def _mapped(lines: Sequence[np.ndarray], point_map: Map, view: Viewport) -> list[list[np.ndarray]]:
    """Map lines, each to one or more runs, which are simplified."""
    dense = [_densified(line, view.pixel)[0] for line in lines]
    mapped = _mapped_together(point_map, dense, view.pixel)
    return [_runs(before, after, view.section) for before, after in zip(dense, mapped, strict=True)]


def _mapped_together(point_map: Map, lines: Sequence[np.ndarray], pixel: np.ndarray) -> list[np.ndarray]:
    """Map the points of lines together; those just above or below the rock go with it, as on a border."""
    if not lines:
        return []
    points = np.concatenate(lines)
    mapped = point_map(points)
    for nudge in (BESIDE, -BESIDE):
        lost = np.isnan(mapped).any(axis=1)
        if lost.any():
            mapped = np.array(mapped)
            mapped[lost] = point_map(points[lost] + [0, nudge * pixel[1]])
    return np.split(mapped, np.cumsum([len(line) for line in lines])[:-1])


def _runs(before: np.ndarray, after: np.ndarray, section: Section) -> list[np.ndarray]:
    """Split a mapped line where it jumps at a fault, and simplify the runs."""
    breaks = _breaks(before, after, section)
    cell = np.array([section.dx, section.dz])
    pairs = zip(np.split(before, breaks), np.split(after, breaks), strict=True)
    known = ((np.isfinite(run).all(axis=1), start, run) for start, run in pairs)
    return [_simplified(start[rows], run[rows], cell) for rows, start, run in known if rows.sum() > 1]


def _breaks(before: np.ndarray, after: np.ndarray, section: Section) -> np.ndarray:
    """Indices of the points of a mapped line before which it jumps, or is unknown on one side."""
    lengths = [np.hypot(*(np.diff(points, axis=0) * section.metres).T) for points in (before, after)]
    step_before, step_after = np.nan_to_num(lengths, nan=np.inf)
    return np.flatnonzero(~(step_after <= JUMP * step_before)) + 1


def _with_gaps(runs: Sequence[np.ndarray]) -> np.ndarray:
    gap = np.full((1, 2), np.nan)
    return np.concatenate([rows for run in runs for rows in (run, gap)]) if runs else np.empty((0, 2))


def _densified(line: np.ndarray, pixel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Add points to a line, so that neighbours lie about ``SAMPLE_DISTANCE`` apart; return their indices, too."""
    lengths = np.hypot(*(np.diff(line, axis=0) / pixel).T) / SAMPLE_DISTANCE
    share = min(1.0, MOST_SAMPLES / max(1.0, lengths.sum()))
    counts = np.maximum(1, np.ceil(lengths * share)).astype(int)
    parameters = [index + np.arange(1, count + 1) / count for index, count in enumerate(counts)]
    indices = np.arange(len(line))
    at = np.concatenate([[0.0], *parameters])
    return np.column_stack([np.interp(at, indices, line[:, 0]), np.interp(at, indices, line[:, 1])]), at


def _simplified(before: np.ndarray, after: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Points of a line that matter after mapping, or before: the browser shows it at any moment between."""
    kept = [_significant(points / cell) for points in (before, after)]
    return np.asarray(after[np.union1d(*kept)])


def _significant(points: np.ndarray) -> np.ndarray:
    """Indices of the points that a simplified line keeps."""
    numbered = shapely.linestrings(np.column_stack([points, np.arange(len(points))]))
    simple = shapely.simplify(numbered, TOLERANCE, preserve_topology=False)
    return shapely.get_coordinates(simple, include_z=True)[:, 2].astype(int)
