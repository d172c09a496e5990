"""Decompaction: what lies below expands as its cover is taken away, column by column.

Each column of rock keeps its thickness of grains while its pores open by Athy's law. Porosity remembers the deepest
burial: rock that was eroded or uplifted does not expand beyond what it had there.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import barycentric_coefficients
from seiswidgets.core.solver import Progress
from seiswidgets.geology.closed_form import ClosedForm
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.layers import WATER, Columns, Layers
from seiswidgets.geology.lithology import PER_KM, pore_thickness, thickness_at
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.report import Observations
from seiswidgets.geology.stage import DECOMPACT, STRIP, UNERODE, Stage
from seiswidgets.geology.stratigraphy import Stratigraphy

PARTS = 4  # that each stretch of a column is divided into
NEAR = 10.0  # samples: a line that keeps to the border for longer runs along it
INWARDS = 1e-3  # of a stretch: its porosity is read inside it


@dataclass(frozen=True, eq=False)
class BurialMemory:
    """The deepest burial of the rock, as far as it is known.

    Attributes
    ----------
    stages : sequence of Stage
        Those so far.
    sea_floor : array, shape (k, 2)
        The present-day sea floor, from which burial is measured before the first step that changes it.
    """

    stages: Sequence[Stage]
    sea_floor: np.ndarray

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Depth of burial that the porosity at points after all stages stands for, in metres; shape (n,)."""
        for index in reversed(range(len(self.stages))):
            stage = self.stages[index]
            if stage.burial is not None:
                burial = interpolated(stage, stage.burial, points)
                return np.fmax(burial, self._before(index, points)) if stage.kind == UNERODE else burial
            if stage.kind != STRIP:  # which leaves every point where it is
                points = stage.map.inverse(points)
        return np.asarray(points[:, 1] - np.interp(points[:, 0], *self.sea_floor.T))

    def _before(self, index: int, points: np.ndarray) -> np.ndarray:
        """The same before rock was put back; NaN for that rock."""
        there = shapely.intersects_xy(self.stages[index].domain.outline, points)
        found = np.full(len(points), np.nan)
        found[there] = BurialMemory(self.stages[:index], self.sea_floor)(points[there])
        return found


def interpolated(stage: Stage, values: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Values at a stage's vertices, at points after it; NaN outside."""
    triangles = stage.map.target_finder(points)
    corners = stage.mesh.triangles[triangles]
    x0, z0, bx, bz, cx, cz = barycentric_coefficients(stage.vertices[corners]).T
    x, z = points[:, 0] - x0, points[:, 1] - z0
    b, c = bx * x + bz * z, cx * x + cz * z
    found = (1 - b - c) * values[corners[:, 0]] + b * values[corners[:, 1]] + c * values[corners[:, 2]]
    return np.where(triangles >= 0, found, np.nan)


@dataclass(frozen=True, eq=False)
class ColumnCompaction:
    """Porosity along columns, and how they expand.

    Attributes
    ----------
    columns : Columns
    burial : array, shape (n, k, 2)
        Depth of burial that the porosity stands for at both ends of each stretch, in metres.
    stratigraphy : Stratigraphy
    """

    columns: Columns
    burial: np.ndarray
    stratigraphy: Stratigraphy

    @classmethod
    def of(cls, columns: Columns, memory: BurialMemory, stratigraphy: Stratigraphy) -> "ColumnCompaction":
        """Read the porosity of columns from what is remembered.

        Where nothing is, as below the rock, burial grows with depth from what is known above.
        """
        depth = columns.nodes - columns.surface[:, None, None]
        rock = (columns.layer != WATER) & (columns.thickness > 0)
        inside = columns.nodes + INWARDS * columns.thickness[..., None] * [1, -1]
        points = np.stack([np.broadcast_to(columns.x[:, None, None], inside.shape), inside], axis=-1)[rock]
        ends = memory(points.reshape(-1, 2)).reshape(-1, 2)
        middle, half = ends.mean(axis=1), np.diff(ends, axis=1)[:, 0] / (2 - 4 * INWARDS)
        burial = np.full(depth.shape, np.nan)
        burial[rock] = np.column_stack([middle - half, middle + half])
        shift = (burial - depth)[..., 1]
        for index in range(shift.shape[1]):  # from the stretch above, downwards
            above = shift[:, index - 1] if index else np.zeros(len(shift))
            shift[:, index] = np.where(np.isnan(shift[:, index]), above, shift[:, index])
        burial = np.where(np.isnan(burial), depth + shift[..., None], burial)
        return cls(columns, np.maximum(burial, 0), stratigraphy)

    def _constants(self, stretch: int) -> tuple[np.ndarray, np.ndarray]:
        """phi0 and c (per metre) of one stretch of each column."""
        rocks = [layer.rock for layer in self.stratigraphy.layers]
        phi0, c = np.array([(rock.phi0, rock.c * PER_KM) for rock in rocks] + [(0.0, 0.0)]).T
        return phi0[self.columns.layer[:, stretch]], c[self.columns.layer[:, stretch]]

    def pores(self) -> np.ndarray:
        """Thickness of the pores of each stretch, shape (n, k)."""
        constants = [self._constants(index) for index in range(self.columns.layer.shape[1])]
        phi0, c = np.stack(constants, axis=-1)
        return pore_thickness(phi0, c, self.burial[..., 0], self.burial[..., 1], self.columns.thickness)

    def expanded(self) -> tuple[np.ndarray, np.ndarray]:
        """Thickness of each stretch after expanding, and depth of its lower end below the top of the column.

        Returns
        -------
        thickness, depth : array, shape (n, k)
        """
        solid = self.columns.thickness - self.pores()
        thickness, depth = self.columns.thickness.copy(), np.zeros_like(solid)
        below = np.zeros(len(solid))
        for index in range(solid.shape[1]):
            rock = self.columns.layer[:, index] != WATER
            free = thickness_at(*self._constants(index), solid[:, index], below)
            deeper = below + free / 2 > self.burial[:, index].mean(axis=1)  # than ever: it was never so loose
            thickness[:, index] = np.where(rock & ~deeper, free, thickness[:, index])
            below = below + np.where(rock | (below > 0), thickness[:, index], 0.0)
            depth[:, index] = below
        return thickness, depth


def decompact_stage(
    domain: RestorationDomain,
    layers: Layers,
    stratigraphy: Stratigraphy,
    memory: BurialMemory,
    notes: Sequence[Finding] = (),
    progress: Progress | None = None,
) -> Stage:
    """Let rock expand to the porosity of its present depth below the top; the bottom of the section stays.

    Where a little rock is missing at the bottom of a column, what lies there now counts as going on down; where much is
    missing, as at the end of a section whose blocks have moved away, the nearest whole column stands for it.

    Parameters
    ----------
    domain : RestorationDomain
    layers : Layers
    stratigraphy : Stratigraphy
    memory : BurialMemory
        Before the step.
    notes : list of Finding
    progress : callable, optional
    """
    began = time.perf_counter()
    tops = {(HORIZON, _name(stratigraphy, index)): _off_border(lines, domain) for index, lines in layers.tops.items()}
    mesh = domain.mesh(tops | {(FAULT, ""): layers.faults})
    x, z = mesh.vertices.T
    columns = layers.columns(x, z, PARTS).down_to(domain.outline.bounds[3])
    compaction = ColumnCompaction.of(columns, memory, stratigraphy)
    thickness, depth = compaction.expanded()
    growth = np.cumsum(thickness - columns.thickness, axis=1)
    rise, grown = _at_or_above(growth, columns.at), _growth_of_column(columns, growth)
    burial = np.minimum(_at_or_above(depth, columns.at), _at_or_above(compaction.burial[..., 1], columns.at))
    vertices = np.column_stack([x, z - (grown - rise)])
    observe = partial(_observe, mesh, vertices, layers, stratigraphy, memory, burial)
    return ClosedForm(DECOMPACT, tuple(stratigraphy.tops), domain, progress).stage(
        mesh, vertices, observe, notes, began, burial
    )


def _off_border(lines: Sequence[LineString], domain: RestorationDomain) -> list[LineString]:
    """The parts of lines that do not run along the border, which a mesh follows anyway."""
    border = domain.outline.boundary.buffer(domain.sample)
    parts: list[LineString] = []
    for line in lines:
        runs_along = line.intersection(border).length > NEAR * domain.sample
        parts += shapely.get_parts(line.difference(border)).tolist() if runs_along else [line]
    return [part for part in parts if part.length > domain.sample]


def _name(stratigraphy: Stratigraphy, index: int) -> str:
    return stratigraphy.layers[index].top or ""


def _growth_of_column(columns: Columns, growth: np.ndarray) -> np.ndarray:
    """Growth of the rock in each column and of what is missing below it, shape (n,); ``growth`` is cumulative."""
    x, whole = columns.x, np.flatnonzero(columns.is_whole)
    grown = growth[:, -1].copy()
    if not len(whole):
        return grown
    order = whole[np.argsort(x[whole])]
    for index in np.flatnonzero(~columns.is_whole):
        nearest = order[np.argmin(np.abs(x[order] - x[index]))]
        above = np.interp(columns.nodes[index, -1, 0], columns.nodes[nearest, :, 1], growth[nearest])
        grown[index] = growth[index, -2] + growth[nearest, -1] - above
    return grown


def _at_or_above(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """The value at the lower end of each column's stretch, 0 at the top of the column."""
    return np.where(at >= 0, np.take_along_axis(values, np.maximum(at, 0)[:, None], axis=1)[:, 0], 0.0)


def _observe(
    mesh: Mesh,
    vertices: np.ndarray,
    layers: Layers,
    stratigraphy: Stratigraphy,
    memory: BurialMemory,
    after: np.ndarray,
) -> Observations:
    """Porosity and area of each layer before and after."""
    before = memory(mesh.vertices)
    index = layers.layer_at(mesh.vertices[mesh.triangles].mean(axis=1))
    moved = Mesh(vertices, mesh.triangles).areas
    details = []
    for number, layer in enumerate(stratigraphy.layers):
        own = (index == number) & np.isfinite(before[mesh.triangles]).all(axis=1)
        if own.any():
            old, new = (
                np.average(layer.rock.porosity(burial[mesh.triangles[own]].mean(axis=1)), weights=mesh.areas[own])
                for burial in (before, after)
            )
            change = moved[own].sum() / mesh.areas[own].sum() - 1
            text = f"{layer.rock.name or 'rock'}, porosity {old:.1%} before, {new:.1%} after; area {change:+.1%}"
            details.append((f"layer below {layer.name}", text))
    return Observations(details=tuple(details))
