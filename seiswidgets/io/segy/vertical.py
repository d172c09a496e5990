"""Sample interval and start of SEG-Y traces, checked against each other and for plausibility."""

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.segy.traces import TraceHeaders

INTERVALS = (0.01, 32.767)  # ms or m; beyond it the standard's signed number of thousandths is negative
LONGEST = 200_000  # ms or m that a trace may take
STARTS = (-10_000, 20_000)  # ms or m
STANDARD_SCALARS = (0, 1, 10, 100, 1000, 10_000)  # or below 0; 0 is taken for 1


def interval(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Distance between samples, in milliseconds or metres; the headers state thousandths of it.

    Raises
    ------
    DataError
        If no header states it, if they contradict each other, or if no survey has such an interval.
    """
    path, stated = headers.layout.path, _stated_intervals(headers, traces)
    if not stated:
        raise DataError(
            f"{path} says no sample interval (bytes 3217-3218 of the file, 117-118 of the trace headers); say the "
            "distance between samples, in the unit of z: dz="
        )
    if np.ptp(stated) >= 1:  # those of the traces are whole numbers, even where the general one is not
        raise DataError(_several_intervals(headers, stated))
    found = stated[0] / 1000
    _check_interval(path, found, headers.layout.samples)
    return found


def finest_interval(headers: TraceHeaders, traces: np.ndarray) -> float | None:
    """The shortest interval that the headers state, in milliseconds or metres; None if none."""
    stated = _stated_intervals(headers, traces)
    return min(stated) / 1000 if stated else None


def _stated_intervals(headers, traces):
    """Thousandths of ms or m, the binary header's first; zeros left out."""
    own = np.unique(headers(117, traces) & 0xFFFF)  # the standard has it signed, programs do not
    return [value for value in (headers.layout.interval, *own.tolist()) if value]


def _several_intervals(headers, stated):
    general, path = headers.layout.interval, headers.layout.path
    own = stated[1:] if general else stated
    where = f"{general:g} in its binary header (bytes 3217-3218) and " if general else ""
    values = ", ".join(f"{value:g}" for value in own[:5])
    return (
        f"{path} speaks of several sample intervals: {where}{values} in its trace headers (bytes 117-118), in "
        "thousandths of ms, m or ft; neither can be preferred: say which holds, in the unit of z: dz="
    )


def _check_interval(path, found, samples):
    low, high = INTERVALS
    where = "(bytes 3217-3218 of the file, 117-118 of the trace headers)"
    if not low <= found <= high:
        hint = "it may be in other units than thousandths" if found < low else "it may be negative, or in other units"
        raise DataError(
            f"{path} has a sample interval of {found:g} ms, m or ft {where}, but surveys have {low:g} to {high:g}; "
            f"{hint}: say the distance between samples, in the unit of z: dz="
        )
    if found * (samples - 1) > LONGEST:
        raise DataError(
            f"{path} has {samples} samples {found:g} ms, m or ft apart {where}, so that a trace would take "
            f"{found * (samples - 1) / 1000:g} s, km or 1000 ft, but none takes more than {LONGEST / 1000:g}; say the "
            "distance between samples, in the unit of z: dz="
        )


def delay(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Time or depth of the first sample, in milliseconds or metres: bytes 109-110, and their scalar, 215-216.

    Raises
    ------
    DataError
        If traces start at different ones, if their scalar is not the standard's, or if no survey starts there.
    """
    path, found = headers.layout.path, headers(109, traces).astype(float)
    if found.any():
        found *= _delay_factors(headers, traces, found)
    if np.ptp(found):
        raise DataError(
            f"{path} has traces that start at different times or depths, from {found.min():g} to "
            f"{found.max():g} (bytes 109-110 of the trace headers); say where they shall start, in the unit of z: z0="
        )
    low, high = STARTS
    if not low <= found[0] <= high:
        raise DataError(
            f"{path} has traces that start at {found[0]:g} ms, m or ft (bytes 109-110 of the trace headers, scalar "
            f"215-216), but surveys start between {low} and {high}; say where they start, in the unit of z: z0="
        )
    return float(found[0])


def _delay_factors(headers, traces, delays):
    """What the delays are multiplied by; revision 0 leaves the bytes of their scalar unassigned."""
    scalar, path = headers(215, traces), headers.layout.path
    usual = np.isin(np.abs(scalar), STANDARD_SCALARS)
    if headers.layout.revision:
        if not usual.all():
            raise DataError(
                f"{path} has {scalar[~usual][0]} as the scalar of its delays (bytes 215-216 of the trace headers), "
                "which must be 1, 10, 100, 1000 or 10000, or one of these below 0; say where the traces start, in the "
                "unit of z: z0="
            )
        return scalar_factors(scalar)
    doubtful = usual & (np.abs(scalar) > 1) & (delays != 0)
    if doubtful.any():
        value, multiplier = delays[doubtful][0], scalar[doubtful][0]
        raise DataError(
            f"{path} has traces that start at {value:g} ms, m or ft (bytes 109-110 of the trace headers), or at "
            f"{value * scalar_factors(multiplier):g} if bytes 215-216 hold a scalar, {multiplier}, which revision 0, "
            "that the file claims, does not have; say where they start, in the unit of z: z0="
        )
    return np.ones(len(traces))


def scalar_factors(scalar: np.ndarray) -> np.ndarray:
    """Factors of the standard's scalars: positive ones multiply, negative ones divide, 0 counts as 1."""
    size = np.where(scalar == 0, 1.0, np.abs(scalar))
    return np.where(scalar < 0, 1 / size, size)
