"""Layers of rock between horizons and faults, and vertical columns through them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.point_location import concatenate_ranges
from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import fault_lines
from seiswidgets.geology.segments import HorizonSegment, horizon_segments, nearest_fault_ahead

WATER = -1  # layer of what lies above the youngest top, and of holes
BESIDE = 1e-3  # of a sample: distance of a point on either side of a horizon, and of an end beyond a line it meets
MISSING = 0.1  # of a column's height: what lies below it is taken for more of the same
SPECK = 1e-6  # of the rock's area: a smaller face is rounding


@dataclass(frozen=True, eq=False)
class Layers:
    """Rock divided by the tops of layers and by faults.

    Attributes
    ----------
    domain : RestorationDomain
    tops : dict of int to list of LineString
        The lines of each layer's top, drawn on to faults, other tops and the border, by the index of the layer.
    faults : list of LineString
    count : int
        Number of layers.
    youngest : int
        Index of the youngest layer that is left: rock above its top was eroded, and put back.
    """

    domain: RestorationDomain
    tops: Mapping[int, Sequence[LineString]]
    faults: Sequence[LineString]
    count: int
    youngest: int = WATER

    @property
    def lines(self) -> list[LineString]:
        """All tops and faults."""
        return [*(line for lines in self.tops.values() for line in lines), *self.faults]

    @cached_property
    def _linework(self) -> shapely.Geometry:
        lines = [_overshooting(line, self.domain) for line in self.lines]
        inside = shapely.intersection(lines, self.domain.outline) if lines else []
        return shapely.union_all([self.domain.outline.boundary, *inside])

    @cached_property
    def faces(self) -> np.ndarray:
        """The areas between the lines, as shapely polygons."""
        faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(self._linework)))
        shapely.prepare(self.domain.outline)
        inside = shapely.contains(self.domain.outline, shapely.point_on_surface(faces))
        return faces[inside & (shapely.area(faces) > SPECK * self.domain.outline.area)]

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(self.faces)

    def _face_at(self, points: np.ndarray) -> np.ndarray:
        """Index of the face that holds each point, -1 where there is none; shape (n,)."""
        found = np.full(len(points), -1)
        at, face = self._tree.query(shapely.points(points), predicate="within")
        found[at] = face
        return found

    @cached_property
    def layer_of_face(self) -> np.ndarray:
        """Index of the layer of each face; `WATER` above the youngest top.

        A face below a top belongs to its layer, to the oldest one if there are several; one that only lies above tops,
        to the layer before the youngest of them. A face that touches none takes the layer above it.
        """
        below, above = np.full(len(self.faces), -1), np.full(len(self.faces), self.count)
        for index, lines in self.tops.items():
            ends = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in map(_points, lines)])
            ends = ends[np.abs(ends[:, 1, 0] - ends[:, 0, 0]) > 0]
            middle, probe = ends.mean(axis=1), np.array([0, BESIDE * self.domain.sample])
            under, over = self._face_at(middle + probe), self._face_at(middle - probe)
            np.maximum.at(below, under[under >= 0], index)
            np.minimum.at(above, over[over >= 0], index)
        layer = np.asarray(np.where(below >= 0, below, above - 1))
        layer = self._completed(layer, (below < 0) & (above == self.count))
        return np.maximum(layer, self.youngest)

    def _completed(self, layer: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        """Give faces that touch no top the layer of the known face next above; the oldest if there is none."""
        layer = layer.copy()
        for face in np.flatnonzero(unknown):
            x, z = shapely.point_on_surface(self.faces[face]).coords[0]
            ray = LineString([(x, z), (x, self.domain.outline.bounds[1])])
            met = [other for other in self._tree.query(ray, predicate="intersects") if not unknown[other]]
            bottoms = [self.faces[other].intersection(ray).bounds[3] for other in met]
            layer[face] = layer[met[int(np.argmax(bottoms))]] if met else self.count - 1
        return layer

    def layer_at(self, points: np.ndarray) -> np.ndarray:
        """Index of the layer that holds each point, `WATER` outside the rock; shape (n,)."""
        return np.append(self.layer_of_face, WATER)[self._face_at(points)]

    def columns(self, x: np.ndarray, z: np.ndarray | None = None, parts: int = 1) -> "Columns":
        """Vertical columns through the rock; at a sloping side, that at the corner above or below it stands for others.

        Parameters
        ----------
        x : array, shape (n,)
        z : array, shape (n,), optional
            A depth in each column to include among its nodes.
        parts : int
            Number of equal parts that each stretch of a layer is divided into.
        """
        x = np.clip(x, *self._top_corners)
        column, depth, layer = self._stretches(x)
        if z is not None:
            first = np.searchsorted(column, np.arange(len(x)))
            last = np.append(first[1:], len(column)) - 1
            z = np.clip(z, depth[first, 0], depth[last, 1])
            inside = (z[column] > depth[:, 0]) & (z[column] < depth[:, 1])
            halves = np.where(inside[:, None], np.column_stack([depth[:, 0], z[column]]), depth)
            rest = np.column_stack([z[column], depth[:, 1]])[inside]
            column = np.append(column, column[inside])
            depth, layer = np.vstack([halves, rest]), np.append(layer, layer[inside])
            order = np.lexsort([depth[:, 0], column])
            column, depth, layer = column[order], depth[order], layer[order]
        share = np.arange(parts + 1) / parts
        nodes = depth[:, :1] + (depth[:, 1:] - depth[:, :1]) * share
        depth = np.stack([nodes[:, :-1], nodes[:, 1:]], axis=-1).reshape(-1, 2)
        return _padded(np.repeat(column, parts), depth, np.repeat(layer, parts), x, z)

    @cached_property
    def _top_corners(self) -> tuple[float, float]:
        """Positions of the upper left and the upper right corner of the rock: beyond them, its sides slope."""
        points = shapely.get_coordinates(self.domain.outline)
        low, high = points.min(axis=0), points.max(axis=0)
        x, z = ((points - low) / (high - low)).T
        inset = 1e-9 * (high[0] - low[0])  # a column along the border lies just inside
        left, right = points[np.argmin(x + z), 0] + inset, points[np.argmin(1 - x + z), 0] - inset
        return float(left), float(right)

    def _stretches(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Column, depths of both ends, and layer of each stretch between two crossings, downwards in each column."""
        column, depth = _crossings(self._linework, x)
        pairs = np.flatnonzero((column[1:] == column[:-1]) & (depth[1:] > depth[:-1]))
        column, depth = column[pairs], np.column_stack([depth[pairs], depth[pairs + 1]])
        layer = self.layer_at(np.column_stack([x[column], depth.mean(axis=1)]))
        return column, depth, layer


def _points(line: LineString) -> np.ndarray:
    return np.asarray(shapely.get_coordinates(line))


def _crossings(linework: shapely.Geometry, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Columns and depths at which vertical lines cross a linework, sorted by column, then depth."""
    points, line = shapely.get_coordinates(shapely.get_parts(linework), return_index=True)
    joined = line[1:] == line[:-1]
    ends = np.stack([points[:-1][joined], points[1:][joined]], axis=1)
    ends = np.take_along_axis(ends, np.argsort(ends[:, :, :1], axis=1), axis=1)
    order = np.argsort(x, kind="stable")
    first, last = (np.searchsorted(x[order], ends[:, k, 0]) for k in (0, 1))
    segment, index = concatenate_ranges(first, last - first)
    column = order[index]
    (x0, z0), (x1, z1) = ends[segment, 0].T, ends[segment, 1].T
    depth = z0 + (z1 - z0) * (x[column] - x0) / (x1 - x0)
    order = np.lexsort([depth, column])
    return column[order], depth[order]


@dataclass(frozen=True, eq=False)
class Columns:
    """Vertical columns of rock.

    Attributes
    ----------
    x : array, shape (n,)
    nodes : array, shape (n, k, 2)
        Depths of the upper and lower end of each stretch, downwards; the last ones have no thickness.
    layer : array, shape (n, k)
        Index of the layer of each stretch, `WATER` outside the rock.
    at : array of int, shape (n,)
        Index of the stretch whose lower end is the depth that was asked for; -1 for the top of the column.
    """

    x: np.ndarray
    nodes: np.ndarray
    layer: np.ndarray
    at: np.ndarray

    def down_to(self, depth: float) -> "Columns":
        """The columns continued by the rock at their bottom to one depth; a stretch more in each."""
        last = np.maximum(self.layer.shape[1] - 1 - np.argmax((self.thickness > 0)[:, ::-1], axis=1), 0)[:, None]
        bottom = np.take_along_axis(self.nodes[..., 1], last, axis=1)
        rest = np.stack([bottom, np.maximum(bottom, depth)], axis=-1)
        layer = np.take_along_axis(self.layer, last, axis=1)
        return Columns(self.x, np.concatenate([self.nodes, rest], axis=1), np.hstack([self.layer, layer]), self.at)

    @property
    def is_whole(self) -> np.ndarray:
        """True for columns of `down_to` that are little longer than the rock in them, shape (n,)."""
        return np.asarray(self.thickness[:, -1] <= MISSING * (self.nodes[:, -1, 1] - self.surface))

    @property
    def thickness(self) -> np.ndarray:
        """Thickness of each stretch, shape (n, k)."""
        return np.asarray(self.nodes[..., 1] - self.nodes[..., 0])

    @property
    def surface(self) -> np.ndarray:
        """Depth of the highest rock of each column, its bottom where there is none; shape (n,)."""
        first = np.argmax((self.layer >= 0) & (self.thickness > 0), axis=1)
        return np.asarray(np.take_along_axis(self.nodes[..., 0], first[:, None], axis=1)[:, 0])


def _padded(column: np.ndarray, depth: np.ndarray, layer: np.ndarray, x: np.ndarray, z: np.ndarray | None) -> Columns:
    count = len(x)
    counts = np.bincount(column, minlength=count)
    position = np.arange(len(column)) - np.repeat(np.cumsum(counts) - counts, counts)
    last = np.cumsum(counts) - 1
    nodes = np.repeat(depth[last, 1][:, None, None], max(counts.max(), 1), axis=1).repeat(2, axis=2)
    nodes[column, position] = depth
    layers = np.full(nodes.shape[:2], WATER)
    layers[column, position] = layer
    at = np.full(count, -1)
    if z is not None:
        reached = (nodes[..., 1] <= z[:, None] + 1e-12 * np.abs(z[:, None])) & (nodes[..., 1] > nodes[..., 0])
        at = np.where(reached.any(axis=1), reached.shape[1] - 1 - np.argmax(reached[:, ::-1], axis=1), -1)
    return Columns(x, nodes, layers, at)


def layers_of(
    domain: RestorationDomain,
    pieces: Mapping[int, Sequence[LineString]],
    faults: Sequence[LineString],
    count: int,
    youngest: int = WATER,
) -> Layers:
    """Divide the rock into layers.

    A free end of a top is drawn on: straight ahead to a fault or another top that lies near, otherwise level to the
    first fault, top or border in its way.

    Parameters
    ----------
    domain : RestorationDomain
    pieces : dict of int to list of LineString
        The top of each layer, by its index from young to old.
    faults : list of LineString
    count : int
        Number of layers.
    youngest : int
        See `Layers`.
    """
    faults = _joined_faults(faults, domain)
    segments = {layer: horizon_segments(lines, faults, domain.cell) for layer, lines in pieces.items()}
    tops = {}
    for layer, parts in segments.items():
        others = [part.line for other, own in segments.items() if other != layer for part in own]
        walls = [*faults, *others, *_border_lines(domain)]
        lines = [domain.on_border(domain.simplify(_drawn_on(part, walls, domain))) for part in parts]
        tops[layer] = [line for line in lines if line.intersects(domain.outline)]
    faults = [part for line in faults for part in _inside(line, domain)]
    return Layers(domain, {layer: lines for layer, lines in tops.items() if lines}, faults, count, youngest)


def _joined_faults(faults: Sequence[LineString], domain: RestorationDomain) -> list[LineString]:
    """Simplified faults that meet what they nearly meet; as they are if one of them cannot be used so."""
    try:
        lines = fault_lines({str(index): _points(line) for index, line in enumerate(faults)}, domain)
    except PickError:
        return [domain.simplify(line) for line in faults]
    return [domain.simplify(line) for line in lines.values()]


def _overshooting(line: LineString, domain: RestorationDomain) -> LineString:
    """A line made longer by a thousandth of a sample at both ends, so that rounding leaves no gap where it ends."""
    points = _points(line).copy()
    for which, inner in ((0, 1), (-1, -2)):
        arm = points[which] - points[inner]
        points[which] += BESIDE * domain.sample * arm / np.hypot(*arm)
    return LineString(points)


def _border_lines(domain: RestorationDomain) -> list[LineString]:
    return [LineString(ring) for part in shapely.get_parts(domain.outline) for ring in (part.exterior, *part.interiors)]


def _inside(line: LineString, domain: RestorationDomain) -> list[LineString]:
    parts = shapely.get_parts(line.intersection(domain.outline))
    return [part for part in parts if part.geom_type == "LineString" and part.length > domain.sample]


def _drawn_on(segment: HorizonSegment, walls: Sequence[LineString], domain: RestorationDomain) -> LineString:
    """The line of a segment, with its free ends drawn on to the first line in their way."""
    points = _points(segment.line)
    width = 2 * (domain.outline.bounds[2] - domain.outline.bounds[0])
    for which in (0, -1):
        if segment.ends[which] is not None or len(points) < 2:
            continue
        end = nearest_fault_ahead(segment.line, which, walls, domain.cell)
        target = np.array(end.point) if end else _level(points, which, walls, width)
        if target is not None and np.hypot(*(target - points[which])) > 0:
            points = np.insert(points, 0 if which == 0 else len(points), target, axis=0)
    return LineString(points)


def _level(points: np.ndarray, which: int, walls: Sequence[LineString], width: float) -> np.ndarray | None:
    """The first point of a wall at the depth of a line's end, beyond it."""
    tip = points[which]
    outwards = np.sign(tip[0] - points[-1 - which, 0]) or (-1.0 if which == 0 else 1.0)
    ray = LineString([tip + [1e-6 * outwards, 0], tip + [outwards * width, 0]])
    met = [part for wall in walls for part in shapely.get_parts(ray.intersection(wall)) if not part.is_empty]
    if not met:
        return None
    return np.array(min((shapely.Point(part.coords[0]) for part in met), key=shapely.Point(tip).distance).coords[0])
