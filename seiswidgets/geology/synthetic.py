"""Known answers: synthetic sections whose true restoration is known in closed form.

Level beds are deposited, folded, then cut by faults, whose blocks slip: see `History`. All sections are in metres and
take the keywords of `Survey` besides their own. Dips and tilts are in degrees.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Unpack

import numpy as np
import shapely
from numpy.typing import ArrayLike
from scipy.ndimage import gaussian_filter

from seiswidgets.errors import SettingError
from seiswidgets.geology.kinematics import (
    STILL,
    BlindSlip,
    Circular,
    Deformation,
    History,
    RigidMotion,
    ShearFold,
    Straight,
    Survey,
    SurveyKeywords,
    check_range,
    sign_change,
)
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section

BEDS = np.arange(-8000.0, 16000.0)  # one seed makes the same beds, however they are deformed
WAVELENGTH = 75.0  # m, of the Ricker wavelet's peak
SPACING = 25.0  # m, between the points of a horizon

Depths = tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Synthetic:
    """A section, its interpretation, and its true restoration.

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
        The fault block of each point, and its position before the faults slipped (block 0 held), and before the folding
        or tilting. Points on a fault take either side.
    """

    section: Section
    interpretation: Interpretation
    trace: np.ndarray = field(repr=False)
    fixed: tuple[float, float] | None
    block: Callable[[ArrayLike], np.ndarray] = field(repr=False)
    to_unfaulted: Callable[[ArrayLike], np.ndarray] = field(repr=False)
    to_restored: Callable[[ArrayLike], np.ndarray] = field(repr=False)


def planar_fault(
    dip: float = 60.0,
    throw: float = 150.0,
    horizons: Depths = (600.0, 1000.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A straight normal fault from top to bottom; its hanging wall slid down dip by a throw (m)."""
    check_range("dip", dip, 20, 90, " degrees")
    survey = Survey(**keywords)
    fault = Straight((0.45 * survey.width, survey.depth / 2), dip)
    slip = RigidMotion(shift=throw / fault.direction[1] * fault.direction)
    return _synthetic("planar fault", survey, horizons, History(faults=(fault,), slips=(STILL, slip)))


def listric_fault(
    turn: float = 0.1,
    radius: float = 3500.0,
    dip: float = 65.0,
    horizons: Depths = (300.0, 600.0, 900.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A circular fault, with a dip at its top; its hanging wall turned about the circle's centre by radians."""
    check_range("turn", turn, 0, 0.4, " radians")
    check_range("dip", dip, 20, 85, " degrees")
    survey = Survey(**keywords)
    fault = Circular((survey.width / 4, 0.0), dip, radius)
    return _synthetic("listric fault", survey, horizons, _turned_wall(fault, turn))


def faulted_fold(
    throw: float = 150.0,
    amplitude: float = 200.0,
    horizons: Depths = (750.0, 1050.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A gentle dome cut by a gently curved normal fault, as in the paper's fig. 2; amplitude and throw in m."""
    survey = Survey(**keywords)
    fault = Circular((0.58 * survey.width, survey.depth / 2), 60.0, 4.0 * survey.depth)
    dome = ShearFold(lambda x: -amplitude * np.exp(-(((x / survey.width - 0.45) / 0.19) ** 2)))
    turn = throw / np.sin(np.deg2rad(fault.dip)) / fault.radius
    return _synthetic("faulted fold", survey, horizons, _turned_wall(fault, turn, dome))


def graben(
    throw: float = 120.0,
    dip: float = 60.0,
    floor: float = 600.0,
    horizons: Depths = (600.0, 1000.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Two straight faults dipping towards each other; the block between slid down both by a throw (m).

    It is ``floor`` m wide at the bottom. The left block is held, so the right one moves sideways, by twice the heave.
    """
    check_range("dip", dip, 20, 89, " degrees")
    check_range("floor", floor, 10, 1e4, " m")
    survey = Survey(**keywords)
    left, right = (Straight((survey.width / 2 + s * floor / 2, survey.depth), 90 + s * (90 - dip)) for s in (-1, 1))
    sunk = throw / left.direction[1] * left.direction
    aside = sunk - throw / right.direction[1] * right.direction
    slips = STILL, RigidMotion(shift=sunk), RigidMotion(shift=aside)
    return _synthetic("graben", survey, horizons, History(faults=(left, right), slips=slips))


def domino(
    faults: int = 5,
    turn: float = 8.0,
    dip: float = 60.0,
    spacing: float = 500.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Parallel straight faults, ``spacing`` m apart, between blocks that turned together by an angle (degrees).

    Neighbours slid so far that the centres of the blocks kept their depth. The dip is the present-day one; the section
    is as wide as the faults need, unless a width is given. Unfaulting leaves the beds straight, but tilted by the turn.
    """
    check_range("faults", faults, 1, 15)
    check_range("turn", turn, 0, 15, " degrees")
    check_range("dip", dip, 30, 90, " degrees")
    check_range("spacing", spacing, 100, 1e4, " m")
    apart, angle, down = spacing / np.sin(np.deg2rad(dip)), np.deg2rad(turn), np.deg2rad(dip)
    depth = keywords.get("depth", Survey.depth)
    keywords.setdefault("width", max(2000.0, (faults - 1) * apart + depth / np.tan(down) + 600))
    survey = Survey(**keywords)
    middle = survey.width / 2 + apart * (np.arange(faults) - (faults - 1) / 2)
    lines = tuple(Straight((x, survey.depth / 2), dip) for x in middle)
    slip = apart * np.sin(angle) / np.sin(down + angle) * lines[0].direction
    tilt = RigidMotion(-angle, centre=(middle[0] - apart / 2, survey.depth / 2))
    slips = tuple(RigidMotion(shift=block * slip) for block in range(faults + 1))
    return _synthetic("domino", survey, horizons, History(tilt, lines, slips))


def tilt(
    dip: float = 10.0, horizons: Depths = (750.0, 1000.0, 1250.0), **keywords: Unpack[SurveyKeywords]
) -> Synthetic:
    """Beds turned rigidly about the section's centre, to dip to the right (to the left if negative)."""
    check_range("dip", dip, -45, 45, " degrees")
    survey = Survey(**keywords)
    turned = RigidMotion(np.deg2rad(dip), centre=(survey.width / 2, survey.depth / 2))
    return _synthetic("tilt", survey, horizons, History(turned))


def sine_fold(
    dip: float = 30.0,
    wavelength: float = 2000.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Sine folds by vertical shear; dip (degrees) is the steepest of their limbs, the wavelength in m."""
    check_range("dip", dip, 0, 75, " degrees")
    check_range("wavelength", wavelength, 100, 1e5, " m")
    wavenumber = 2 * np.pi / wavelength
    amplitude = np.tan(np.deg2rad(dip)) / wavenumber
    fold = ShearFold(lambda x: amplitude * np.sin(wavenumber * x))
    return _synthetic("sine fold", Survey(**keywords), horizons, History(fold))


def blind_fault(
    slip: float = 40.0,
    dip: float = 60.0,
    length: float = 500.0,
    horizons: Depths = (850.0, 1000.0, 1150.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A straight normal fault in the middle that dies out at both tips; slip (m) is the largest, at its centre.

    The slip is elliptic along the fault, and the rock around bends as about a crack: see `BlindSlip`.
    """
    check_range("dip", dip, 20, 160, " degrees")
    check_range("length", length, 100, 1e4, " m")
    check_range("slip", slip, 0, 0.25 * length, " m, a quarter of the length")
    survey = Survey(**keywords)
    fault = Straight((survey.width / 2, survey.depth / 2), dip, length / 2)
    slips = BlindSlip(fault, slip, -1), BlindSlip(fault, slip, 1)
    return _synthetic("blind fault", survey, horizons, History(faults=(fault,), slips=slips, blind=True))


def _turned_wall(fault: Circular, turn: float, fold: Deformation = STILL) -> History:
    """Turn the hanging wall of a circular fault about the circle's centre."""
    return History(fold, (fault,), (STILL, RigidMotion(-turn, fault.centre)))


def _synthetic(name: str, survey: Survey, depths: Depths, history: History) -> Synthetic:
    rng = np.random.default_rng(survey.seed)
    trace = _trace(rng, depths)
    faults = _drawn_faults(history, survey)
    sides = range(len(history.slips))
    horizons = [
        Horizon(*(_piece(history, survey, faults, depth, side) for side in sides), name=f"H{index}")
        for index, depth in enumerate(depths, 1)
    ]
    section = Section(_amplitude(rng, survey, history, trace), survey.dx, survey.dz, name=name)
    answer = history.block, history.to_unfaulted, history.to_restored
    return Synthetic(section, Interpretation(faults, horizons), trace, _held(history, survey), *answer)


def _amplitude(rng: np.random.Generator, survey: Survey, history: History, trace: np.ndarray) -> np.ndarray:
    grid = survey.grid()
    deposited = history.to_restored(grid.reshape(-1, 2))[:, 1].reshape(grid.shape[:2])
    noise = gaussian_filter(rng.standard_normal(deposited.shape), (1.5, 2))
    noise *= survey.noise * trace[:, 1].std() / noise.std()
    return (np.interp(deposited, *trace.T) + noise).astype(np.float32)


def _trace(rng: np.random.Generator, depths: Depths) -> np.ndarray:
    """Random beds, in packages quieter and louder, with a strong reflector at each horizon; the trace's RMS is 1."""
    tops = BEDS[0] + np.cumsum(rng.gamma(2.0, 12.0, size=2000))
    loudness = np.interp(tops, BEDS[::150], rng.gamma(1.0, 0.5, size=len(BEDS[::150])))
    coefficients = rng.standard_normal(len(tops)) * (0.3 + loudness)
    nearest = abs(tops[:, None] - np.asarray(depths)).min(axis=1, initial=np.inf)
    coefficients[nearest < WAVELENGTH / 2] = 0  # so that a horizon's peak is its own
    tops, coefficients = np.append(tops, depths), np.append(coefficients, np.full(len(depths), 2.5))
    reflectivity = np.histogram(tops, bins=np.append(BEDS, BEDS[-1] + 1) - 0.5, weights=coefficients)[0]
    phase = (np.pi * np.arange(-2 * WAVELENGTH, 2 * WAVELENGTH + 1) / WAVELENGTH) ** 2
    amplitude = np.convolve(reflectivity, (1 - 2 * phase) * np.exp(-phase), mode="same")
    trace = np.column_stack([BEDS, amplitude / amplitude.std()])
    trace.setflags(write=False)
    return trace


def _drawn_faults(history: History, survey: Survey) -> list[Fault]:
    lines = [fault.polyline(survey) for fault in history.faults]
    for index, line in enumerate(lines, 1):
        ends = survey.margin(line[[0, -1]])
        if survey.margin(line).min() < -1e-6 or (ends.max() > 1e-6 and not history.blind):
            rule = "end inside the section" if history.blind else "run from the top of the section to its border"
            raise SettingError(
                f"fault F{index} must {rule}, "
                f"but the section is {survey.width:g} m x {survey.depth:g} m and the fault goes from "
                f"x={line[0, 0]:.0f}, z={line[0, 1]:.0f} to x={line[-1, 0]:.0f}, z={line[-1, 1]:.0f}; "
                "make the section larger, or the fault steeper, shorter or of a larger radius",
                pick=f"F{index}",
            )
    return [Fault(survey.snap(line), name=f"F{index}") for index, line in enumerate(lines, 1)]


def _held(history: History, survey: Survey) -> tuple[float, float] | None:
    """A point halfway down and halfway across block 0, if there is another block."""
    if history.blind or not history.faults:
        return None
    row = np.column_stack([np.linspace(0, survey.width, 1000), np.full(1000, survey.depth / 2)])
    return float(row[history.side(row) == 0, 0].mean()), survey.depth / 2


def _piece(history: History, survey: Survey, faults: Sequence[Fault], depth: float, side: int) -> np.ndarray:
    """The piece of a horizon on one side: the part of the present-day bed that lies inside the block."""
    bed = history.bed(depth, side)

    def margin(x: np.ndarray) -> np.ndarray:
        return history.margin(bed(x), side, survey)

    reach = survey.width + survey.depth
    x = np.arange(-reach, survey.width + reach, 10.0)
    ends = np.flatnonzero(np.diff(margin(x) >= 0))
    if len(ends) == 2:
        first, last = (sign_change(margin, *x[end : end + 2]) for end in ends)
        piece = survey.snap(bed(np.linspace(first, last, int((last - first) / SPACING) + 2)))
        meetings = [(fault, piece[0]) for fault in faults[max(side - 1, 0) : side]]
        meetings += [(fault, piece[-1]) for fault in faults[side : side + 1]]
        # 0.2 m is more than a circular fault's sagitta
        if all(shapely.LineString(fault.points).distance(shapely.Point(end)) < 0.2 for fault, end in meetings):
            return piece
    raise SettingError(
        f"the horizon at {depth:g} m must have one piece in each block, from fault to fault inside the section, "
        f"but block {side} has none; choose another depth or a larger section, or deform it less"
    )
