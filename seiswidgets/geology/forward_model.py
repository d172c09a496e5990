"""From a known history of deformation to a section with picks, and its true restoration."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.typing import ArrayLike
from scipy.ndimage import gaussian_filter

from seiswidgets.errors import SettingError
from seiswidgets.geology.kinematics import History, Survey, sign_change
from seiswidgets.geology.parallel_flow import ThrustSequence
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section

BEDS = np.arange(-8000.0, 16000.0)  # one seed makes the same beds, however they are deformed
WAVELENGTH = 75.0  # m, of the Ricker wavelet's peak
SPACING = 25.0  # m, between the points of a horizon

Depths = tuple[float, ...]
KnownHistory = History | ThrustSequence


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


def make_synthetic(name: str, survey: Survey, depths: Depths, history: KnownHistory) -> Synthetic:
    """Deposit beds, deform them by a history, and pick faults and horizons."""
    rng = np.random.default_rng(survey.seed)
    trace = beds_trace(rng, depths)
    faults = [Fault(survey.snap(line), name=f"F{index}") for index, line in enumerate(history.lines(survey), 1)]
    horizons = [
        Horizon(*_pieces(history, survey, faults, depth), name=f"H{index}") for index, depth in enumerate(depths, 1)
    ]
    deposited = history.to_restored(survey.grid().reshape(-1, 2))[:, 1]
    section = Section(noisy_amplitude(rng, survey, deposited, trace), survey.dx, survey.dz, name=name)
    answer = history.block, history.to_unfaulted, history.to_restored
    return Synthetic(section, Interpretation(faults, horizons), trace, _held(history, survey), *answer)


def noisy_amplitude(rng: np.random.Generator, survey: Survey, deposited: np.ndarray, trace: np.ndarray) -> np.ndarray:
    """Amplitudes of samples that were deposited at some depths, and noise; shape (nz, nx)."""
    deposited = deposited.reshape(survey.grid().shape[:2])
    noise = gaussian_filter(rng.standard_normal(deposited.shape), (1.5, 2))
    noise *= survey.noise * trace[:, 1].std() / noise.std()
    return (np.interp(deposited, *trace.T) + noise).astype(np.float32)


def beds_trace(rng: np.random.Generator, depths: Depths) -> np.ndarray:
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


def _held(history: KnownHistory, survey: Survey) -> tuple[float, float] | None:
    """The point of block 0 that is farthest from its faults and the borders, if there is another block."""
    if history.blind or not history.faults:
        return None
    points = survey.grid()[::4, ::4].reshape(-1, 2)
    x, z = points[np.argmax(history.margin(points, 0, survey))]
    return float(x), float(z)


def _pieces(history: KnownHistory, survey: Survey, faults: Sequence[Fault], depth: float) -> list[np.ndarray]:
    """The pieces of a horizon from left to right, each from fault to fault."""
    blocks = history.blocks_at(depth)
    pieces = []
    for block in blocks:
        piece = _piece(history, survey, depth, block)
        meetings = [(faults[block - 1], 0)] if block - 1 in blocks else []
        meetings += [(faults[block], -1)] if block + 1 in blocks else []
        # 0.2 m is more than a circular fault's sagitta
        if piece is None or any(
            shapely.LineString(fault.points).distance(shapely.Point(piece[end])) > 0.2 for fault, end in meetings
        ):
            raise SettingError(
                f"the horizon at {depth:g} m must have one piece in each block, from fault to fault inside the "
                f"section, but block {block} has none; choose another depth or a larger section, or deform it less"
            )
        pieces.append(piece)
    return pieces


def _piece(history: KnownHistory, survey: Survey, depth: float, block: int) -> np.ndarray | None:
    """The part of a present-day bed that lies inside a block; None unless it is one."""
    bed = history.bed(depth, block)

    def margin(x: np.ndarray) -> np.ndarray:
        return history.margin(bed(x), block, survey)

    reach = survey.width + survey.depth
    x = np.arange(-reach, survey.width + reach, 10.0)
    ends = np.flatnonzero(np.diff(margin(x) >= 0))
    if len(ends) != 2:
        return None
    first, last = (sign_change(margin, *x[end : end + 2]) for end in ends)
    return survey.snap(bed(np.linspace(first, last, int((last - first) / SPACING) + 2)))
