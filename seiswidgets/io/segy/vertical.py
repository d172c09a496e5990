"""Sample interval and start of SEG-Y traces, checked for contradictions and for plausibility."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError, Keyword, Text
from seiswidgets.geology.findings import Finding
from seiswidgets.io.segy.traces import TraceHeaders

INTERVALS = (0.01, 32.767)  # ms or m; beyond it the standard's signed number of thousandths is negative
LONGEST = 200_000  # ms or m: length of a trace
STARTS = (-10_000, 20_000)  # ms or m
HIGHEST_END = -1000  # ms or m: a trace that ends above it has a wrong start
STANDARD_SCALARS = (0, 1, 10, 100, 1000, 10_000)  # or their negatives; 0 counts as 1
OFF_GRID = 0.02  # of the sample interval
GIVE_DZ = Text("give the distance between samples, in the unit of z: ", Keyword("dz"))
GIVE_Z0 = Text("give the start of the traces, in the unit of z: ", Keyword("z0"))


def interval(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Distance between samples, in milliseconds or metres; the headers state it in thousandths.

    Raises
    ------
    DataError
        If no header states it, if headers contradict each other, or if it is implausible.
    """
    path, stated = headers.layout.path, _stated_intervals(headers, traces)
    if not stated:
        raise DataError(
            f"{path} states no sample interval (bytes 3217-3218 of the file, 117-118 of the trace headers); ", GIVE_DZ
        )
    if np.ptp(stated) >= 1:  # trace headers hold whole numbers, even if the binary header does not
        raise DataError(*_several_intervals(headers, stated))
    value = stated[0] / 1000
    _check_interval(path, value, headers.layout.samples)
    return value


def finest_interval(headers: TraceHeaders, traces: np.ndarray) -> float | None:
    """The shortest interval that the headers state, in milliseconds or metres; None if they state none."""
    stated = _stated_intervals(headers, traces)
    return min(stated) / 1000 if stated else None


def _stated_intervals(headers: TraceHeaders, traces: np.ndarray) -> list[float]:
    """Intervals in thousandths of ms or m, that of the binary header first; zeros are left out."""
    own = np.unique(headers(117, traces) & 0xFFFF)  # signed in the standard, but not in practice
    return [value for value in (headers.layout.interval, *own.tolist()) if value]


def _several_intervals(headers: TraceHeaders, stated: list[float]) -> tuple[str, Text]:
    general, path = headers.layout.interval, headers.layout.path
    own = stated[1:] if general else stated
    where = f"{general:g} in its binary header (bytes 3217-3218) and " if general else ""
    values = ", ".join(f"{value:g}" for value in own[:5])
    return (
        f"{path} states several sample intervals: {where}{values} in its trace headers (bytes 117-118), in "
        "thousandths of ms, m or ft; neither can be preferred: ",
        GIVE_DZ,
    )


def _check_interval(path: Path, value: float, samples: int) -> None:
    low, high = INTERVALS
    where = "(bytes 3217-3218 of the file, 117-118 of the trace headers)"
    if not low <= value <= high:
        hint = "it may be in other units than thousandths" if value < low else "it may be negative, or in other units"
        raise DataError(
            f"{path} has a sample interval of {value:g} ms, m or ft {where}, but surveys have {low:g} to {high:g}; "
            f"{hint}: ",
            GIVE_DZ,
        )
    if value * (samples - 1) > LONGEST:
        raise DataError(
            f"{path} has {samples} samples {value:g} ms, m or ft apart {where}, so that a trace would be "
            f"{value * (samples - 1) / 1000:g} s, km or 1000 ft long, but none is longer than {LONGEST / 1000:g}; ",
            GIVE_DZ,
        )


def delay(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Time or depth of the first sample, in milliseconds or metres: bytes 109-110, and their scalar, 215-216.

    Raises
    ------
    DataError
        If traces start at different ones, if their scalar is not one of the standard's, or if it is implausible.
    """
    path, delays = headers.layout.path, headers(109, traces).astype(float)
    if delays.any():
        delays *= _delay_factors(headers, traces, delays)
    if np.ptp(delays):
        raise DataError(
            f"{path} has traces that start at different times or depths, from {delays.min():g} to "
            f"{delays.max():g} (bytes 109-110 of the trace headers); ",
            GIVE_Z0,
        )
    low, high = STARTS
    if not low <= delays[0] <= high:
        raise DataError(
            f"{path} has traces that start at {delays[0]:g} ms, m or ft (bytes 109-110 of the trace headers, scalar "
            f"215-216), but surveys start between {low} and {high}; ",
            GIVE_Z0,
        )
    finest = finest_interval(headers, traces[:1]) or 0.0
    if delays[0] + finest * headers.layout.samples < HIGHEST_END:
        raise DataError(
            f"{path} has traces that start at {delays[0]:g} ms, m or ft (bytes 109-110 of the trace headers) and would "
            "end far above 0; ",
            GIVE_Z0,
        )
    return float(delays[0])


def start_remarks(headers: TraceHeaders, dz: float, z0: float) -> tuple[Finding, ...]:
    """Warnings about a start of the traces that is doubtful beside their sample interval."""
    texts = []
    if z0 and z0 == headers.layout.interval:
        texts.append(
            f"the traces start at {z0:g} ms, m or ft (bytes 109-110), which is also the number of their sample "
            "interval in thousandths; if it was written there by mistake, give "
        )
    elif abs(z0 / dz - round(z0 / dz)) > OFF_GRID:
        texts.append(
            f"the traces start at {z0:g} ms, m or ft (bytes 109-110), which is no multiple of their sample interval, "
            f"{dz:g}; if it is in other units, give "
        )
    return tuple(Finding("warning", "start", Text(text, Keyword("z0"))) for text in texts)


def _delay_factors(headers: TraceHeaders, traces: np.ndarray, delays: np.ndarray) -> np.ndarray:
    """Factors of the delays; the bytes of their scalar are unassigned in revision 0."""
    scalar, path = headers(215, traces), headers.layout.path
    usual = np.isin(np.abs(scalar), STANDARD_SCALARS)
    if headers.layout.revision:
        if not usual.all():
            raise DataError(
                f"{path} has {scalar[~usual][0]} as the scalar of its delays (bytes 215-216 of the trace headers), "
                "which must be 1, 10, 100, 1000 or 10000, or the negative of one of these; ",
                GIVE_Z0,
            )
        return scalar_factors(scalar)
    doubtful = usual & (np.abs(scalar) > 1) & (delays != 0)
    if doubtful.any():
        value, multiplier = delays[doubtful][0], scalar[doubtful][0]
        raise DataError(
            f"{path} has traces that start at {value:g} ms, m or ft (bytes 109-110 of the trace headers), or at "
            f"{value * scalar_factors(multiplier):g} if bytes 215-216 hold a scalar, {multiplier}, which revision 0, "
            "that the file claims, does not have; ",
            GIVE_Z0,
        )
    return np.ones(len(traces))


def scalar_factors(scalar: np.ndarray) -> np.ndarray:
    """Factors for the standard's scalars: positive ones multiply, negative ones divide, 0 counts as 1."""
    size = np.where(scalar == 0, 1.0, np.abs(scalar))
    return np.where(scalar < 0, 1 / size, size)
