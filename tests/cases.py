"""Random restorations: beds folded by vertical shear, then cut by up to four faults, one after the other.

Each slip is the true one (rigid along planes and circles, the displacement about a crack where a fault dies out), and
carries the faults before it along; so all cut-offs of a case can be brought together at once.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString
from shapely.ops import split, substring

import seiswidgets as sw
from seiswidgets.geology.kinematics import BlindSlip, Circular, RigidMotion, Straight

WIDTH, DEPTH = 4000.0, 2000.0
SECTION = sw.Section(np.zeros((201, 161), np.float32), 25.0, 10.0)
BOX = shapely.box(0, 0, WIDTH, DEPTH)
SPACING = 150.0  # makes 500 to 1,000 vertices
STEP = 25.0  # between the points of a line while it is deformed
DRAWN = 0.5  # how closely an interpreter's line follows it
FEW = 2  # horizons at least, where there are
REACH = 1.0  # a line that ends this close to another ends at it


def random_case(seed):
    """The section, its faults, its horizons (the longest first) and a point to hold, or None."""
    rng = np.random.default_rng(seed)
    count = rng.integers(1, 5)
    while True:
        slips = sorted((_random_slip(rng) for _ in range(rng.integers(1, count + 1))), key=lambda slip: not slip.blind)
        beds = _folded_beds(rng)
        faults, _ = _slipped(slips, [])
        if len(faults) != count or not _well_apart(faults):
            continue
        faults, beds = _slipped(slips, beds)
        if horizons := _picked(faults, beds):
            fixed = _held(rng, faults)
            faults = [sw.Fault(line.coords, name=f"F{number}") for number, line in enumerate(faults, 1)]
            return SECTION, faults, horizons, fixed


@dataclass(frozen=True)
class Slip:
    """Slip of what lies to the right of a fault; all of it seen in a mirror if ``mirrored``."""

    fault: Straight | Circular
    motion: RigidMotion | None  # none: the fault dies out
    size: float
    mirrored: bool

    @property
    def blind(self):
        return self.motion is None

    def line(self):
        return _mapped(LineString(self._points()), self._seen)

    def _points(self):
        if isinstance(self.fault, Circular):
            dips = np.radians(np.arange(120, -120, -0.5))
            return self.fault.centre + self.fault.radius * np.column_stack([-np.sin(dips), np.cos(dips)])
        reach = self.fault.half_length or 3 * WIDTH
        return np.array(self.fault.point) + np.outer(np.linspace(-reach, reach, 41), self.fault.direction)

    def _seen(self, points):
        return (WIDTH, 0) + points * (-1, 1) if self.mirrored else points

    def applied(self, line):
        """A line that the fault does not cross, after the slip."""
        return _mapped(line, lambda points: self._seen(self._moved(self._seen(points))))

    def _moved(self, points):
        if self.blind:
            inner = points.copy()  # an end on the fault belongs to the side from which the line comes
            inner[[0, -1]] += 1e-6 * (points[[1, -2]] - points[[0, -1]])
            right = self.fault.side(inner) > 0
            moved = (BlindSlip(self.fault, self.size, side).apply(inner) for side in (1, -1))
            return np.where(right[:, None], *moved)
        middle = points[len(points) // 2 - 1 : len(points) // 2 + 1].mean(axis=0, keepdims=True)
        return self.motion.apply(points) if self.fault.side(middle)[0] > 0 else points


def _mapped(line, function):
    return LineString(function(shapely.get_coordinates(line)))


def _random_slip(rng):
    kind = rng.choice(["planar", "listric", "blind", "dying"])
    dip, x, throw = rng.uniform(45, 80), rng.uniform(0.15, 0.85) * WIDTH, rng.uniform(0.02, 0.25) * DEPTH
    steep = np.sin(np.deg2rad(dip))
    size = throw / steep * rng.choice([1, 1, 1, -1])  # the last: a reverse fault
    mirrored = bool(rng.integers(2))
    if kind == "planar":
        fault = Straight((x, DEPTH / 2), dip)
        return Slip(fault, RigidMotion(shift=tuple(size * fault.direction)), size, mirrored)
    if kind == "listric":
        fault = Circular((x, 0.0), dip, rng.uniform(2500, 6000))
        return Slip(fault, RigidMotion(-size / fault.radius, fault.centre), size, mirrored)
    depth, half = (rng.uniform(0.4, 0.6), rng.uniform(0.15, 0.4)) if kind == "blind" else (0.0, rng.uniform(0.4, 0.85))
    fault = Straight((x, depth * DEPTH), dip, half * DEPTH / steep)
    limit = fault.half_length / 2  # more, and the displacement about the crack is no longer one to one
    return Slip(fault, None, np.clip(size, -limit, limit), mirrored)


def _folded_beds(rng):
    dip, wavelength, phase = np.deg2rad(rng.uniform(0, 60)), rng.uniform(800, 2500), rng.uniform(0, 2 * np.pi)
    x = np.arange(-WIDTH / 2, 1.5 * WIDTH + STEP, STEP)
    fold = np.tan(dip) * wavelength / (2 * np.pi) * np.sin(2 * np.pi * x / wavelength + phase)
    depths = np.arange(-1.5 * DEPTH, 2.5 * DEPTH, rng.uniform(300, 450))
    return [[LineString(np.column_stack([x, depth + fold]))] for depth in depths]


def _slipped(slips, beds):
    """Faults and beds after all slips, what of them lies in the section: lists of lines, and for each bed of pieces."""
    faults = []
    for slip in slips:
        line = slip.line()
        faults, *beds = ([slip.applied(part) for part in _parted(lines, line)] for lines in (faults, *beds))
        faults.append(line)
    faults, *beds = ([part.simplify(DRAWN) for line in lines for part in _clipped(line)] for lines in (faults, *beds))
    return faults, beds


def _parted(lines, fault):
    parts = (part for line in lines for part in split(line, fault).geoms)
    return [part.segmentize(STEP) for part in parts if part.length > REACH]


def _clipped(line):
    return [part for part in shapely.get_parts(line.intersection(BOX)) if part.length > REACH]


def _well_apart(faults):
    """True if faults are long enough, and meet or keep their distance."""
    if min(fault.length for fault in faults) < 4 * SPACING:
        return False
    for fault in faults:
        others = [other for other in faults if other is not fault]
        if any(fault.intersection(other.buffer(SPACING)).length > 3 * SPACING for other in others):
            return False
        for end in shapely.points([fault.coords[0], fault.coords[-1]]):
            distance = min(end.distance(other) for other in (BOX.exterior, *others))
            if REACH < distance < SPACING:
                return False
    return True


def _picked(faults, beds):
    """Horizons that together tell the slip of each fault; none if these beds do not."""
    found = [(pieces, met) for bed in beds if (pieces := _paired(bed, faults)) and (met := _met(pieces, faults))]
    found.sort(key=lambda bed: (-len(bed[1]), -sum(piece.length for piece in bed[0])))
    missing, chosen = set(range(len(faults))), []
    for pieces, met in found:
        if met & missing or (met and len(chosen) < FEW):
            chosen.append(sw.Horizon(*(piece.coords for piece in pieces), name=f"H{len(chosen) + 1}"))
            missing -= met
    return [] if missing else chosen


def _paired(pieces, faults):
    """The pieces of a bed, those that reach a fault with no partner on its other side shortened.

    None if the bed meets a fault twice, or itself.
    """
    for _ in range(4):
        ends = _ends(pieces, faults)
        if len(set(ends.values())) < len(ends) or not all(piece.is_simple for piece in pieces):
            return []
        alone = {end for end, (fault, side) in ends.items() if (fault, -side) not in ends.values()}
        if not alone:
            return pieces
        pieces = [
            substring(piece, 0.4 * ((n, 0) in alone), 1 - 0.4 * ((n, -1) in alone), normalized=True)
            for n, piece in enumerate(pieces)
        ]
        pieces = [piece for piece in pieces if piece.length > 2 * SPACING]
    return []


def _met(pieces, faults):
    return {fault for fault, _ in _ends(pieces, faults).values()}


def _ends(pieces, faults):
    """The fault, and the side of it, at each end (piece, 0 or -1) that lies on one."""
    found = {}
    for number, piece in enumerate(pieces):
        for place in (0, -1):
            end, inner = (piece.interpolate(way if place == 0 else 1 - way, normalized=True) for way in (0, 0.05))
            near = [index for index, fault in enumerate(faults) if fault.distance(end) < REACH]
            if near:
                found[number, place] = near[0], _side(faults[near[0]], end, inner)
    return found


def _side(fault, end, inner):
    way = fault.project(end)
    (x0, z0), (x1, z1) = (fault.interpolate(max(way + step, 0)).coords[0] for step in (-1, 1))
    return 1 if (x1 - x0) * (inner.y - end.y) > (z1 - z0) * (inner.x - end.x) else -1


def _held(rng, faults):
    """A point in a block without a fault that ends inside it; None half of the time, and where there is none such."""
    lines = shapely.union_all([BOX.exterior, *(_drawn_on(fault) for fault in faults)])
    blocks = [block for block in shapely.polygonize([lines]).geoms if block.area > 0.02 * BOX.area]
    whole = [block for block in blocks if not any(block.buffer(-5 * REACH).intersects(fault) for fault in faults)]
    if len(blocks) < 2 or not whole or rng.integers(2):
        return None
    return rng.choice([block.representative_point().coords[0] for block in whole])


def _drawn_on(line):
    points = shapely.get_coordinates(line)
    for place, inner in ((0, 1), (-1, -2)):
        arm = points[place] - points[inner]
        points[place] += 2 * REACH * arm / np.hypot(*arm)
    return LineString(points)
