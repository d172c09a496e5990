"""Two traces along a fault, one of each wall: the amplitudes of the beds where they reach the fault.

Each bed is followed away from the fault along its dip, past the smeared image next to the fault, and its amplitude is
averaged over some traces. What a slip does to the match of the two walls is then a shift of two one-dimensional traces.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import ArrayLike
from scipy.ndimage import map_coordinates
from scipy.spatial import cKDTree
from shapely import LineString

from seiswidgets.core.bed_slopes import bed_slopes
from seiswidgets.core.resampling import resample
from seiswidgets.core.warping import TracePair
from seiswidgets.errors import Keyword, PickError
from seiswidgets.geology import validation
from seiswidgets.geology.picks import Fault
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.transfer import carried_fault

HANGING, FOOT = 0, 1  # indices of the walls
FINE = 0.5  # of a sample: distance of the traces' points along the fault
BEYOND = 25  # samples by which a fault that ends inside the section is continued straight
LEAST_SAMPLES = 8
KEPT = 16  # faults
LEAST_CONTRAST = 1e-6  # of the section's largest amplitude
SCALE, WINDOW = (1.5, 1.5), 4.0  # samples and traces of the gradient; traces of the average of slopes
SAMPLES = (5.0, 15.0)  # least and largest window of that average along z


@dataclass(frozen=True, eq=False)
class FaultTraces:
    """The two walls of a fault as traces along it.

    Attributes
    ----------
    name : str
    section : Section
    line : LineString
        The fault's smooth curve from its upper end, continued where it ends inside the section; in metres of rock.
    length : float
        Length of the fault itself, in metres.
    s : array, shape (n,)
        Arc lengths from the fault's upper end, in metres, equally spaced; outside 0 to the length it is continued.
    walls : array, shape (2, n)
        Mean amplitude of each bed where it reaches the fault, in the hanging wall and in the footwall, less the mean of
        the wall and over its standard deviation; NaN where there are no data.
    columns, rows : arrays, shape (2, k, n)
        The positions that these amplitudes were read at, in samples of the section.
    """

    name: str
    section: Section
    line: LineString
    length: float
    s: np.ndarray
    walls: np.ndarray
    columns: np.ndarray
    rows: np.ndarray

    @property
    def step(self) -> float:
        """Distance between two points, in metres."""
        return float(self.s[1] - self.s[0])

    @property
    def within(self) -> np.ndarray:
        """True for points of the fault itself, shape (n,)."""
        return np.asarray((self.s >= -1e-6 * self.length) & (self.s <= (1 + 1e-6) * self.length))

    @cached_property
    def pair(self) -> TracePair:
        """Both traces, for warping."""
        return TracePair(self.walls[HANGING], self.walls[FOOT], self.step)

    @cached_property
    def spectra(self) -> np.ndarray:
        """Autocorrelation of each wall, from lag 0 on, shape (2, n)."""
        filled = np.nan_to_num(self.walls)
        size = 2 * filled.shape[1]
        power = np.abs(np.fft.rfft(filled, size)) ** 2
        sums = np.fft.irfft(power, size)[:, : filled.shape[1]]
        return np.asarray(sums / np.maximum(sums[:, :1], np.finfo(float).tiny))

    @cached_property
    def independence(self) -> float:
        """Length of fault that holds one independent sample, in metres (Bartlett's formula)."""
        products = np.prod(self.spectra, axis=0)[1 : len(self.s) // 4]
        return float(self.step * max(1.0, 1 + 2 * products.sum()))

    @cached_property
    def wavelength(self) -> float:
        """Dominant wavelength along the fault, in metres: four times the lag at which the walls decorrelate."""
        negative = np.mean(self.spectra, axis=0) < 0
        return float(4 * self.step * (np.argmax(negative) if negative.any() else len(self.s) // 8))

    def read(self, wall: int, arcs: np.ndarray) -> np.ndarray:
        """Amplitudes of a wall at some arc lengths, NaN where there are none."""
        return np.interp(arcs, self.s, self.walls[wall], left=np.nan, right=np.nan)

    def points(self, arcs: np.ndarray) -> np.ndarray:
        """Points of the fault at arc lengths, in the section's units, shape (k, 2); straight on beyond its ends."""
        at = np.asarray(arcs) - self.s[0]
        inside = np.clip(at, 0, self.line.length)
        ends = shapely.get_coordinates(self.line)[[0, 1, -2, -1]]
        first, last = (arm / np.hypot(*arm) for arm in (ends[1] - ends[0], ends[3] - ends[2]))
        beyond = np.where((at < 0)[:, None], first, last) * (at - inside)[:, None]
        return self.section.from_rock(shapely.get_coordinates(self.line.interpolate(inside)) + beyond)

    def into_hanging_wall(self, points: np.ndarray) -> np.ndarray:
        """Unit vectors into the hanging wall at points along the fault in this order, wherever it lies; in metres."""
        along, ends = np.gradient(points, axis=0), shapely.get_coordinates(self.line)[[0, -1]]
        across = along[:, ::-1] * [1, -1] * (1 if ends[1, 0] >= ends[0, 0] else -1)
        return np.asarray(across / np.maximum(np.hypot(*across.T), np.finfo(float).tiny)[:, None])

    def offsets(self, s: ArrayLike, profile: SlipProfile) -> np.ndarray:
        """Heave and throw of a slip at some positions, shape (k, 2), in the units of x and z, positive if normal."""
        s = np.atleast_1d(np.asarray(s, float))
        slip = profile.at(s)
        (left, _), (right, _) = self.points(self.s[[0, -1]])
        arms = self.points(s + slip / 2) - self.points(s - slip / 2)
        return np.asarray(arms * [1 if right >= left else -1, 1])

    def bed(self, wall: int, arc: float) -> np.ndarray | None:
        """Points of the bed that reaches the fault at an arc length, from there outwards, in the section's units.

        None where it has no data.
        """
        nearest = int(np.argmin(np.abs(self.s - arc)))
        if not np.isfinite(self.walls[wall, nearest]):
            return None
        index = np.column_stack([self.columns[wall, :, nearest], self.rows[wall, :, nearest]])
        origin, cell = (self.section.x0, self.section.z0), (self.section.dx, self.section.dz)
        return np.vstack([self.points(np.array([arc])), origin + index * cell])

    def arcs(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Arc lengths of the nearest points of the fault, and the distance to them; points in metres of rock."""
        at = shapely.points(points)
        return shapely.line_locate_point(self.line, at) + self.s[0], shapely.distance(self.line, at)


def fault_traces(section: Section, fault: Fault, gap: int = 2, width: int = 8) -> FaultTraces:
    """Read the two walls of a fault; those of the last few faults are kept with the section.

    Parameters
    ----------
    section : Section
    fault : Fault
    gap, width : int
        Traces that are left out next to the fault, where its image is smeared, and traces that are averaged.

    Raises
    ------
    PickError
        If the fault lies outside the section, has too few samples with data beside it, or no contrast.
    SettingError
        If ``gap`` is less than 0, or ``width`` less than 1.
    """
    key = "fault traces", fault.name, fault.points.tobytes(), gap, width
    if key not in section.derived:
        gap, width = validation.whole_number("gap", gap, least=0), validation.whole_number("width", width, least=1)
        read = _read(section, fault, gap, width)
        for old in list(section.derived)[: 1 - KEPT]:
            del section.derived[old]
        section.derived[key] = read
    traces: FaultTraces = section.derived[key]
    return traces


def _read(section: Section, fault: Fault, gap: int, width: int) -> FaultTraces:
    line, first, length = _continued(section, fault)
    s = np.arange(first, first + line.length, FINE * section.dz * float(section.metres[1]))
    points = section.from_rock(shapely.get_coordinates(line.interpolate(s - first)))
    at = (points - (section.x0, section.z0)) / (section.dx, section.dz)
    columns, rows, amplitudes = _walls(section.amplitude, at, gap, width)
    within = (s >= 0) & (s <= length)
    known = np.isfinite(amplitudes) & within
    if known.all(axis=0).sum() * FINE < LEAST_SAMPLES:
        raise PickError(
            f"only {int(known.all(axis=0).sum() * FINE)} samples beside fault {fault.name!r} have data on both sides; "
            f"at least {LEAST_SAMPLES} are needed to compare them: reduce ",
            Keyword("gap"),
            " or ",
            Keyword("width"),
            ", or choose a longer fault",
            kind="short",
            pick=fault.name,
        )
    means, deviations = (_of_walls(function, amplitudes, known) for function in (np.mean, np.std))
    if deviations.min() <= LEAST_CONTRAST * np.nanmax(np.abs(section.amplitude)):
        raise PickError(
            f"beside fault {fault.name!r} all amplitudes are alike, so there is nothing to match; choose another "
            "fault, or match horizons across it",
            kind="no contrast",
            pick=fault.name,
        )
    return FaultTraces(fault.name, section, line, length, s, (amplitudes - means) / deviations, columns, rows)


def _of_walls(function: Callable[[np.ndarray], float], amplitudes: np.ndarray, known: np.ndarray) -> np.ndarray:
    return np.array([[function(wall[there])] for wall, there in zip(amplitudes, known, strict=True)])


def _continued(section: Section, fault: Fault) -> tuple[LineString, float, float]:
    """The curve of a fault, continued where it ends inside the section; its first arc length; the fault's length."""
    curve = LineString(carried_fault(section, (), fault))
    points = shapely.get_coordinates(curve)
    if (points[-1, 1], points[-1, 0]) < (points[0, 1], points[0, 0]):
        points = points[::-1]
    cell = np.array([section.dx, section.dz]) * section.metres
    low, high = section.to_rock(np.reshape(section.extent, (2, 2)).T)
    first, ends = 0.0, []
    for which, far in ((0, min(LEAST_SAMPLES, len(points) - 1)), (-1, -1 - min(LEAST_SAMPLES, len(points) - 1))):
        arm = points[which] - points[far]
        inside = ((points[which] > low + 2 * cell) & (points[which] < high - 2 * cell)).all()
        reach = BEYOND * cell[1] if inside else 0.0
        ends.append(points[which] + reach * arm / np.hypot(*arm))
        first -= reach * (which == 0)
    parts = [ends[:1], points, ends[1:]] if first < 0 else [points, ends[1:]]
    line = shapely.remove_repeated_points(LineString(np.concatenate(parts)))
    return line, first, float(curve.length)


def _walls(amplitude: np.ndarray, at: np.ndarray, gap: int, width: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Columns and rows that beds are read at beside the points of a fault, shape (2, width, n), and mean amplitudes."""
    low = np.maximum(np.floor(at.min(axis=0)) - (gap + width + 2 * WINDOW, 2 * SAMPLES[1]), 0).astype(int)
    high = np.ceil(at.max(axis=0)).astype(int) + (gap + width + 2 * int(WINDOW), 2 * int(SAMPLES[1]))
    crop = amplitude[low[1] : high[1] + 1, low[0] : high[0] + 1].astype(float)
    at = at - low
    known, filled = np.isfinite(crop), np.nan_to_num(crop)
    distance = _signed_distance(at, crop.shape)
    window = (_window(filled), WINDOW)
    outwards = np.where(np.gradient(at[:, 1]) >= 0, 1.0, -1.0) * (1 if at[-1, 0] >= at[0, 0] else -1)
    columns, rows = np.empty((2, 2, width, len(at)))
    for wall, side in ((HANGING, 1), (FOOT, -1)):
        own = known & (side * distance >= gap + 1)  # the gradient beside the gap would see the other wall
        slopes = bed_slopes(filled, own.astype(float), SCALE, window)
        column, row = at.T
        for trace in range(1, gap + width):
            step = side * outwards
            row = row + step * map_coordinates(slopes, (row, column + step / 2), order=1, mode="nearest")
            column = column + step
            if trace >= gap:
                columns[wall, trace - gap], rows[wall, trace - gap] = column, row
    read = resample(crop, columns, rows, order=3)
    beside = map_coordinates(distance, (rows, columns), order=1, mode="nearest")
    read[np.abs(beside) < gap / 2] = np.nan
    read[(beside < 0) != np.array([False, True])[:, None, None]] = np.nan
    count = np.isfinite(read).sum(axis=1)
    mean = np.where(2 * count >= width, np.nan_to_num(read).sum(axis=1) / np.maximum(count, 1), np.nan)
    return columns + low[0], rows + low[1], mean


def _signed_distance(at: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Distance of each sample from a line, in samples and traces, positive in the hanging wall."""
    rows, columns = np.indices(shape)
    grid = np.column_stack([columns.ravel(), rows.ravel()])
    distance, nearest = cKDTree(at).query(grid)
    along, arm = np.gradient(at, axis=0)[nearest], grid - at[nearest]
    across = along[:, 1] * arm[:, 0] - along[:, 0] * arm[:, 1]
    side = np.sign(across) * (1 if at[-1, 0] >= at[0, 0] else -1)
    return np.asarray((side * distance).reshape(shape))


def _window(amplitude: np.ndarray) -> float:
    """Height of the window that slopes are averaged in: about one wavelength, in samples."""
    power = np.abs(np.fft.rfft(amplitude - amplitude.mean(), 2 * len(amplitude), axis=0)) ** 2
    autocorrelation = np.fft.irfft(power.sum(axis=1))[: len(amplitude)]
    return float(np.clip(4 * np.argmax(autocorrelation < 0), *SAMPLES))
