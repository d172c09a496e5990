"""Known answers: synthetic sections whose true restoration is known in closed form.

Level beds are deposited, folded, then cut by faults, whose blocks slip. Each of these deformations is a value with
``applied(points)``, forward in time, and ``undone(points)``, backward; restoring a section undoes them in turn.
All sections are in metres and take the keywords of `Survey` besides their own. Dips and tilts are in degrees.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import shapely
from scipy.ndimage import gaussian_filter
from scipy.optimize import brentq

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section

BEDS = np.arange(-8000.0, 16000.0)  # the same beds for one seed, whatever happens to them later
WAVELENGTH = 75.0  # m, of the Ricker wavelet's peak
SPACING = 25.0  # m, between the points of a horizon

Depths = tuple[float, ...]


def _check(name, value, low, high, unit=""):
    if not low <= value <= high:
        raise SettingError(f"{name} must be from {low:g} to {high:g}{unit}, but is {value:g}")


@dataclass(frozen=True)
class Survey:
    """Size and spacing of a section (m), seed of its beds and noise, and the noise's share of the signal's RMS."""

    width: float = 4000.0
    depth: float = 2000.0
    dx: float = 12.5
    dz: float = 5.0
    seed: int = 0
    noise: float = 0.05

    def __post_init__(self):
        limits = {"width": (500, 2e4), "depth": (500, 5e3), "dx": (1, 100), "dz": (1, 100), "noise": (0, 10)}
        for name, (low, high) in limits.items():
            _check(name, getattr(self, name), low, high)
        for size, step in (("width", self.dx), ("depth", self.dz)):
            object.__setattr__(self, size, step * round(getattr(self, size) / step))

    def grid(self) -> np.ndarray:
        """Position of every sample, shape (nz, nx, 2)."""
        nx, nz = round(self.width / self.dx) + 1, round(self.depth / self.dz) + 1
        return np.stack(np.meshgrid(self.dx * np.arange(nx), self.dz * np.arange(nz)), axis=-1)

    def margin(self, points) -> np.ndarray:
        """Distance to the nearest border, negative outside the section; shape (n,)."""
        x, z = points.T
        return np.min([x, self.width - x, z, self.depth - z], axis=0)

    def snapped(self, points) -> np.ndarray:
        """Points with rounding errors taken off, so that ends at the border lie on it and never outside."""
        return np.clip(np.round(points, 9), 0, (self.width, self.depth))


@dataclass(frozen=True)
class RigidMotion:
    """A turn by ``angle`` (radians, from x towards z: clockwise on the screen) about ``centre``, then a shift."""

    angle: float = 0.0
    centre: tuple[float, float] = (0.0, 0.0)
    shift: tuple[float, float] = (0.0, 0.0)

    def applied(self, points):
        return (points - np.array(self.centre)) @ _turn(self.angle) + self.centre + self.shift

    def undone(self, points):
        return (points - np.array(self.centre) - self.shift) @ _turn(-self.angle) + self.centre


def _turn(angle):
    """Matrix that turns rows (x, z) from x towards z."""
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


@dataclass(frozen=True)
class ShearFold:
    """A fold by vertical shear: z grows by ``height(x)``."""

    height: Callable

    def applied(self, points):
        return points + np.column_stack([np.zeros(len(points)), self.height(points[:, 0])])

    def undone(self, points):
        return points - np.column_stack([np.zeros(len(points)), self.height(points[:, 0])])


@dataclass(frozen=True)
class BlindSlip:
    """Slip of one side (1 hanging wall, -1 footwall) of a fault that dies out: the displacement about a crack.

    With zeta = t + i n along and across the fault in units of its half length, the displacement down dip is
    slip/2 |Im(zeta - sqrt(zeta^2 - 1))|: elliptic on the fault, 0 ahead of its tips, harmonic elsewhere. Very near
    the tips, within about slip^2 / (4 length) of them, it maps more than one point onto one.
    """

    fault: "Straight"
    slip: float
    side: int

    def _displacement(self, t, n):
        """Displacement along t and its derivative, in half lengths."""
        zeta = t + 1j * n
        root = np.sqrt(zeta - 1) * np.sqrt(zeta + 1)  # two roots: this branch makes zeta - root decay
        size, inner = self.side * self.slip / (2 * self.fault.half_length), (zeta - root).imag
        with np.errstate(divide="ignore", invalid="ignore"):
            return size * abs(inner), size * np.sign(inner) * (1 - zeta / root).imag

    def applied(self, points):
        t, n = self.fault.local(points) / self.fault.half_length
        return points + np.outer(self._displacement(t, n)[0] * self.fault.half_length, self.fault.direction)

    def undone(self, points):
        moved, n = self.fault.local(points) / self.fault.half_length
        reach = self.slip / (2 * self.fault.half_length)
        low, t, high = moved - reach, moved, moved + reach
        for _ in range(60):  # Newton's steps, or halving where one leaves the bracket, as it does near the tips
            displacement, slope = self._displacement(t, n)
            excess = t + displacement - moved
            if (abs(excess) < 1e-13).all():
                break
            low, high = np.where(excess < 0, t, low), np.where(excess > 0, t, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = t - excess / (1 + slope)
            t = np.where((step >= low) & (step <= high), step, (low + high) / 2)
        return points + np.outer((t - moved) * self.fault.half_length, self.fault.direction)


@dataclass(frozen=True)
class Straight:
    """A fault along a line through ``point``, across the whole section or, with a half length, dying out at tips."""

    point: tuple[float, float]
    dip: float  # degrees to the right; above 90 it dips to the left
    half_length: float | None = None

    @property
    def direction(self):
        """Unit vector down dip."""
        return np.array([np.cos(np.deg2rad(self.dip)), np.sin(np.deg2rad(self.dip))])

    def local(self, points):
        """Distances of points along (down) and across (to the right) the fault; shape (2, n)."""
        along = self.direction
        return np.array([along, [along[1], -along[0]]]) @ (points - np.array(self.point)).T

    def side(self, points):
        """Distance to the right of the fault; shape (n,)."""
        return self.local(points)[1]

    def drawn(self, survey):
        """The fault's two ends."""
        if self.half_length is None:
            ends = np.array([-self.point[1], survey.depth - self.point[1]]) / self.direction[1]
        else:
            ends = np.array([-self.half_length, self.half_length])
        return np.array(self.point) + np.outer(ends, self.direction)


@dataclass(frozen=True)
class Circular:
    """A fault along a circle, concave upwards, that has the given dip (degrees, to the right) at ``point``."""

    point: tuple[float, float]
    dip: float
    radius: float

    @property
    def centre(self):
        dip = np.deg2rad(self.dip)
        return self.point[0] + self.radius * np.sin(dip), self.point[1] - self.radius * np.cos(dip)

    def side(self, points):
        """Distance into the hanging wall, which is inside the circle; shape (n,)."""
        return self.radius - np.hypot(*(points - np.array(self.centre)).T)

    def drawn(self, survey):
        """Points at most a hundredth of the radius apart, from the top down to the bottom or the right border."""
        x, z = self.centre
        top, bottom = np.arccos(np.clip([-z / self.radius, (survey.depth - z) / self.radius], -1, 1))
        last = max(bottom, np.arcsin(np.clip((x - survey.width) / self.radius, -1, 1)))
        dips = np.linspace(top, last, int(100 * (top - last)) + 2)
        return np.column_stack([x - self.radius * np.sin(dips), z + self.radius * np.cos(dips)])


@dataclass(frozen=True)
class History:
    """What happened to level beds: a fold, then slip along faults, ordered from left to right, that do not meet.

    There is one slip for each side: left of the first fault, between it and the second, and so on.
    """

    fold: RigidMotion | ShearFold = RigidMotion()
    faults: tuple[Straight | Circular, ...] = ()
    slips: tuple[RigidMotion | BlindSlip, ...] = (RigidMotion(),)
    blind: bool = False

    def side(self, points):
        """How many faults each point is to the right of; shape (n,)."""
        return sum((fault.side(points) > 0 for fault in self.faults), np.zeros(len(points), int))

    def block(self, points):
        """The fault block that each point lies in, from 0 at the left; always 0 if no fault cuts a block off."""
        points = np.asarray(points, float)
        return np.zeros(len(points), int) if self.blind else self.side(points)

    def to_unfaulted(self, points):
        """Where points of today's section lay before the faults slipped; shape (n, 2)."""
        points = np.array(points, float)
        side = self.side(points)
        for number, slip in enumerate(self.slips):
            points[side == number] = slip.undone(points[side == number])
        return points

    def to_restored(self, points):
        """Where points of today's section were deposited; shape (n, 2)."""
        return self.fold.undone(self.to_unfaulted(points))

    def bed(self, depth, side):
        """Today's place of the bed deposited at a depth, as a function of the deposited x; valid on one side only."""
        return lambda x: self.slips[side].applied(self.fold.applied(np.column_stack([x, np.full(np.shape(x), depth)])))

    def margin(self, points, side, survey):
        """Distance into a block, to the nearest fault or border; negative outside."""
        left = [fault.side(points) for fault in self.faults[max(side - 1, 0) : side]]
        right = [-fault.side(points) for fault in self.faults[side : side + 1]]
        return np.min([survey.margin(points), *left, *right], axis=0)


@dataclass(frozen=True, eq=False)
class Synthetic:
    """A section, what an interpreter would draw on it, and its true restoration.

    Parameters
    ----------
    section : Section
        Amplitudes of `trace` at each sample's deposited depth, and noise.
    interpretation : Interpretation
        Its faults F1, F2, ... from left to right, and its horizons H1, H2, ... in the order of their depths, with
        their pieces from left to right.
    trace : array, shape (n, 2)
        Rows ``(depth, amplitude)`` of the beds as they were deposited.
    fixed : (x, z) or None
        A point well inside block 0, the one to hold; None where no fault cuts a block off.
    block, to_unfaulted, to_restored : functions of points, shape (n, 2)
        The fault block of each point, and its place before the faults slipped (block 0 held) and before the folding
        or tilting too. Points on a fault take either side.
    """

    section: Section
    interpretation: Interpretation
    trace: np.ndarray = field(repr=False)
    fixed: tuple[float, float] | None
    block: Callable = field(repr=False)
    to_unfaulted: Callable = field(repr=False)
    to_restored: Callable = field(repr=False)


def planar_fault(
    dip: float = 60.0, throw: float = 150.0, horizons: Depths = (600.0, 1000.0, 1400.0), **survey: float
) -> Synthetic:
    """A straight normal fault from top to bottom; its hanging wall slid down dip by a throw (m)."""
    _check("dip", dip, 20, 90, " degrees")
    survey = Survey(**survey)
    fault = Straight((0.45 * survey.width, survey.depth / 2), dip)
    slip = RigidMotion(shift=throw / fault.direction[1] * fault.direction)
    return _synthetic("planar fault", survey, horizons, History(faults=(fault,), slips=(RigidMotion(), slip)))


def listric_fault(
    turn: float = 0.1,
    radius: float = 3500.0,
    dip: float = 65.0,
    horizons: Depths = (300.0, 600.0, 900.0),
    **survey: float,
) -> Synthetic:
    """A circular fault, with a dip at its top; its hanging wall turned about the circle's centre by radians."""
    _check("turn", turn, 0, 0.4, " radians")
    _check("dip", dip, 20, 85, " degrees")
    survey = Survey(**survey)
    fault = Circular((survey.width / 4, 0.0), dip, radius)
    return _synthetic("listric fault", survey, horizons, _turned_wall(fault, turn))


def faulted_fold(
    throw: float = 150.0, amplitude: float = 200.0, horizons: Depths = (750.0, 1050.0, 1400.0), **survey: float
) -> Synthetic:
    """A gentle dome cut by a gently curved normal fault, as in the paper's fig. 2; amplitude and throw in m."""
    survey = Survey(**survey)
    fault = Circular((0.58 * survey.width, survey.depth / 2), 60.0, 4.0 * survey.depth)
    dome = ShearFold(lambda x: -amplitude * np.exp(-(((x / survey.width - 0.45) / 0.19) ** 2)))
    turn = throw / np.sin(np.deg2rad(fault.dip)) / fault.radius
    return _synthetic("faulted fold", survey, horizons, _turned_wall(fault, turn, dome))


def graben(
    throw: float = 120.0,
    dip: float = 60.0,
    floor: float = 600.0,
    horizons: Depths = (600.0, 1000.0, 1400.0),
    **survey: float,
) -> Synthetic:
    """Two straight faults dipping towards each other; the block between slid down both by a throw (m).

    It is ``floor`` m wide at the bottom. The left block is held, so the right one moves sideways, by twice the heave.
    """
    _check("dip", dip, 20, 89, " degrees")
    _check("floor", floor, 10, 1e4, " m")
    survey = Survey(**survey)
    left, right = (Straight((survey.width / 2 + s * floor / 2, survey.depth), 90 + s * (90 - dip)) for s in (-1, 1))
    sunk = throw / left.direction[1] * left.direction
    aside = sunk - throw / right.direction[1] * right.direction
    slips = RigidMotion(), RigidMotion(shift=sunk), RigidMotion(shift=aside)
    return _synthetic("graben", survey, horizons, History(faults=(left, right), slips=slips))


def domino(
    faults: int = 5,
    turn: float = 8.0,
    dip: float = 60.0,
    spacing: float = 500.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **survey: float,
) -> Synthetic:
    """Parallel straight faults, ``spacing`` m apart, between blocks that turned together by an angle (degrees).

    Neighbours slid so far that the centres of the blocks kept their depth. The dip is today's; the section is as wide
    as the faults need, unless a width is given. Unfaulting leaves the beds straight, but tilted by the turn.
    """
    _check("faults", faults, 1, 15)
    _check("turn", turn, 0, 15, " degrees")
    _check("dip", dip, 30, 90, " degrees")
    _check("spacing", spacing, 100, 1e4, " m")
    apart, angle, down = spacing / np.sin(np.deg2rad(dip)), np.deg2rad(turn), np.deg2rad(dip)
    depth = survey.get("depth", Survey.depth)
    survey = Survey(**{"width": max(2000.0, (faults - 1) * apart + depth / np.tan(down) + 600), **survey})
    middle = survey.width / 2 + apart * (np.arange(faults) - (faults - 1) / 2)
    lines = tuple(Straight((x, survey.depth / 2), dip) for x in middle)
    slip = apart * np.sin(angle) / np.sin(down + angle) * lines[0].direction
    tilt = RigidMotion(-angle, centre=(middle[0] - apart / 2, survey.depth / 2))
    slips = tuple(RigidMotion(shift=number * slip) for number in range(faults + 1))
    return _synthetic("domino", survey, horizons, History(tilt, lines, slips))


def tilt(dip: float = 10.0, horizons: Depths = (750.0, 1000.0, 1250.0), **survey: float) -> Synthetic:
    """Beds turned rigidly about the section's centre, to dip to the right (to the left if negative)."""
    _check("dip", dip, -45, 45, " degrees")
    survey = Survey(**survey)
    turned = RigidMotion(np.deg2rad(dip), centre=(survey.width / 2, survey.depth / 2))
    return _synthetic("tilt", survey, horizons, History(turned))


def sine_fold(
    dip: float = 30.0, wavelength: float = 2000.0, horizons: Depths = (750.0, 1000.0, 1250.0), **survey: float
) -> Synthetic:
    """Sine folds by vertical shear; dip (degrees) is the steepest of their limbs, the wavelength in m."""
    _check("dip", dip, 0, 75, " degrees")
    _check("wavelength", wavelength, 100, 1e5, " m")
    wavenumber = 2 * np.pi / wavelength
    amplitude = np.tan(np.deg2rad(dip)) / wavenumber
    fold = ShearFold(lambda x: amplitude * np.sin(wavenumber * x))
    return _synthetic("sine fold", Survey(**survey), horizons, History(fold))


def blind_fault(
    slip: float = 60.0,
    dip: float = 60.0,
    length: float = 900.0,
    horizons: Depths = (800.0, 1000.0, 1200.0),
    **survey: float,
) -> Synthetic:
    """A straight normal fault in the middle that dies out at both tips; slip (m) is the largest, at its centre.

    The slip is elliptic along the fault, and the rock around bends as about a crack: see `BlindSlip`.
    """
    _check("dip", dip, 20, 160, " degrees")
    _check("length", length, 100, 1e4, " m")
    _check("slip", slip, 0, 0.25 * length, " m, a quarter of the length")
    survey = Survey(**survey)
    fault = Straight((survey.width / 2, survey.depth / 2), dip, length / 2)
    slips = BlindSlip(fault, slip, -1), BlindSlip(fault, slip, 1)
    return _synthetic("blind fault", survey, horizons, History(faults=(fault,), slips=slips, blind=True))


def _turned_wall(fault, turn, fold=RigidMotion()):
    """The hanging wall of a circular fault, turned about the circle's centre."""
    return History(fold, (fault,), (RigidMotion(), RigidMotion(-turn, fault.centre)))


def _synthetic(name, survey, depths, history):
    rng = np.random.default_rng(survey.seed)
    trace = _trace(rng, depths)
    faults = _drawn_faults(history, survey)
    sides = range(len(history.slips))
    horizons = [
        Horizon(*(_piece(history, survey, faults, depth, side) for side in sides), name=f"H{number}")
        for number, depth in enumerate(depths, 1)
    ]
    return Synthetic(
        Section(_amplitude(rng, survey, history, trace), survey.dx, survey.dz, name=name),
        Interpretation(faults, horizons),
        trace,
        _held(history, survey),
        history.block,
        history.to_unfaulted,
        history.to_restored,
    )


def _amplitude(rng, survey, history, trace):
    grid = survey.grid()
    deposited = history.to_restored(grid.reshape(-1, 2))[:, 1].reshape(grid.shape[:2])
    noise = gaussian_filter(rng.standard_normal(deposited.shape), (1.5, 2))
    noise *= survey.noise * trace[:, 1].std() / noise.std()
    return (np.interp(deposited, *trace.T) + noise).astype(np.float32)


def _trace(rng, depths):
    """Random beds, in packages quieter and louder, with a strong reflector at each horizon; the trace's RMS is 1."""
    tops = BEDS[0] + np.cumsum(rng.gamma(2.0, 12.0, size=2000))
    loudness = np.interp(tops, BEDS[::150], rng.gamma(1.0, 0.5, size=len(BEDS[::150])))
    coefficients = rng.standard_normal(len(tops)) * (0.3 + loudness)
    depths = np.asarray(depths)
    nearest = abs(tops[:, None] - depths).min(axis=1, initial=np.inf)
    coefficients[nearest < WAVELENGTH / 2] = 0  # so that a horizon's peak is its own
    tops, coefficients = np.append(tops, depths), np.append(coefficients, np.full(len(depths), 2.5))
    reflectivity = np.histogram(tops, bins=np.append(BEDS, BEDS[-1] + 1) - 0.5, weights=coefficients)[0]
    phase = (np.pi * np.arange(-2 * WAVELENGTH, 2 * WAVELENGTH + 1) / WAVELENGTH) ** 2
    amplitude = np.convolve(reflectivity, (1 - 2 * phase) * np.exp(-phase), mode="same")
    trace = np.column_stack([BEDS, amplitude / amplitude.std()])
    trace.setflags(write=False)
    return trace


def _drawn_faults(history, survey):
    drawn = [fault.drawn(survey) for fault in history.faults]
    for number, line in enumerate(drawn, 1):
        ends = survey.margin(line[[0, -1]])
        if survey.margin(line).min() < -1e-6 or (ends.max() > 1e-6 and not history.blind):
            rule = "end inside the section" if history.blind else "run from the top of the section to its border"
            raise SettingError(
                f"fault F{number} must {rule}, "
                f"but the section is {survey.width:g} m x {survey.depth:g} m and the fault goes from "
                f"x={line[0, 0]:.0f}, z={line[0, 1]:.0f} to x={line[-1, 0]:.0f}, z={line[-1, 1]:.0f}; "
                "make the section larger, or the fault steeper, shorter or of a larger radius"
            )
    return [Fault(survey.snapped(line), name=f"F{number}") for number, line in enumerate(drawn, 1)]


def _held(history, survey):
    """A point halfway down and halfway across block 0, if there is another block."""
    if history.blind or not history.faults:
        return None
    row = np.column_stack([np.linspace(0, survey.width, 1000), np.full(1000, survey.depth / 2)])
    return float(row[history.side(row) == 0, 0].mean()), survey.depth / 2


def _piece(history, survey, faults, depth, side):
    """A horizon's piece on one side: where its bed, level when deposited, lies inside the block today."""
    bed = history.bed(depth, side)

    def margin(x):
        return history.margin(bed(x), side, survey)

    reach = survey.width + survey.depth
    x = np.arange(-reach, survey.width + reach, 10.0)
    ends = np.flatnonzero(np.diff(margin(x) >= 0))
    if len(ends) == 2:
        first, last = (brentq(lambda x: margin(np.array([x]))[0], x[end], x[end + 1], xtol=1e-11) for end in ends)
        piece = survey.snapped(bed(np.linspace(first, last, int((last - first) / SPACING) + 2)))
        met = [(fault, piece[0]) for fault in faults[max(side - 1, 0) : side]]
        met += [(fault, piece[-1]) for fault in faults[side : side + 1]]
        # 0.2 m is more than a circular fault's sagitta
        if all(shapely.LineString(fault.points).distance(shapely.Point(end)) < 0.2 for fault, end in met):
            return piece
    raise SettingError(
        f"the horizon at {depth:g} m must have one piece in each block, from fault to fault inside the section, "
        f"but block {side} has none; choose another depth or a larger section, or deform it less"
    )
