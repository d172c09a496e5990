"""The course of a SEG-Y line on the map and the spacing of its traces, refused where positions cannot be believed."""

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.segy.doubts import LONGEST, SPACINGS, WIDE, are_degrees, remedy
from seiswidgets.io.segy.positions import INTEGERS, PLACES, Positions, conflict, positions, scale_of
from seiswidgets.io.segy.traces import TraceHeaders

STRAIGHT = 0.01  # of its length: by how much a line may be longer than the way from end to end
CLEAR = 4  # roundings that a piece of a line must be long to show its direction
EXACT = 10  # roundings between places whose distance is exact to 0.1%
TURNED = 0.5  # of the way along two such pieces: a shorter distance between their ends means that the line turns back


def spacing(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Distance between the traces of a line, from their positions, in their own unit; errors as for ``course``."""
    return _length(course(headers, traces)) / (len(traces) - 1)


def course(headers: TraceHeaders, traces: np.ndarray) -> np.ndarray:
    """Where a line runs on the map, in its own unit: through the positions of its traces, shape (m, 2).

    A straight line is given by its ends, since rounded positions make the way along them longer.

    Raises
    ------
    DataError
        If positions are missing, are angles, are not evenly spaced, turn back, or are such as no survey has.
    """
    _refuse_angles(headers, traces)
    found = positions(headers, traces)
    if not found.steps.any():
        raise DataError(_missing(headers, traces))
    _refuse_conflict(headers, traces, found)
    _refuse_undeclared_angles(headers, traces, found)
    _refuse_beyond_maps(headers, traces, found)
    _refuse_uneven(headers, traces, found)
    _refuse_turning_back(headers, traces, found)
    places = _without_rounding(found)
    _refuse_spacing(headers, traces, found, _length(places) / (len(traces) - 1))
    return places


def _without_rounding(found):
    """Places along a line: its ends if it is straight, else positions so far apart that rounding adds no length."""
    places = np.column_stack([found.x, found.y])
    apart = int(np.ceil(EXACT * found.rounding / found.steps.mean()))
    thinned = places[sorted({*range(0, len(places) - apart, max(apart, 1)), 0, len(places) - 1})]
    ends = places[[0, -1]]
    return ends if _length(thinned) <= (1 + STRAIGHT) * _length(ends) else thinned


def _length(places):
    return float(np.hypot(*np.diff(places, axis=0).T).sum())


def remarks(headers: TraceHeaders, traces: np.ndarray, measured: float) -> tuple[str, ...]:
    """What a user should know of positions that were believed."""
    found, said = positions(headers, traces), []
    if found.stored != INTEGERS:
        said.append(f"positions ({_bytes(headers)}) are read as {found.stored}, since they are no plausible integers")
    if measured * scale_of(headers, traces).metres > WIDE:
        said.append(
            f"traces are {measured:g} {headers.x_unit} apart, which is much: if positions are in tenths of "
            f"that unit, give dx={measured / 10:g}"
        )
    return tuple(said)


def _bytes(headers):
    return f"bytes {headers.bytes['x']} and {headers.bytes['y']}"


def _refuse_angles(headers, traces):
    unit = int(headers(89, traces[:1])[0])
    if unit in (2, 3, 4):
        raise DataError(
            f"{headers.layout.path} has positions in degrees or seconds of arc (bytes 89-90 of the trace header: "
            f"{unit}), which are no distances; say how far apart its traces are: dx="
        )


def _refuse_undeclared_angles(headers, traces, found: Positions):
    apart = found.steps.mean()
    if are_degrees(found.x, found.y, apart):
        raise DataError(
            f"{headers.layout.path} has positions {apart:.2g} apart, all within ±360 and ±90, which seem to be "
            "degrees, and are no distances then; say how far apart its traces are: dx="
        )
    declared = headers(89, traces[:1])[0] == 1
    if not declared and scale_of(headers, traces).may_be_seconds(found.x, found.y, found.spacing):
        raise DataError(
            f"{headers.layout.path} has positions {found.spacing:.2g} apart, all within ±648000 and ±324000, which may "
            "be seconds of arc as well as lengths (bytes 89-90 of the trace header do not say); say how far apart its "
            "traces are: dx="
        )


def _refuse_beyond_maps(headers, traces, found):
    scale = scale_of(headers, traces)
    if scale.is_on_map(found.x, found.y, found.spacing):
        return
    name = max(("x", "y"), key=lambda name: np.abs(getattr(found, name)).max())
    values = getattr(found, name)
    raise DataError(
        f"{headers.layout.path} has traces at {name} = {values[np.argmax(np.abs(values))]:,.0f} {headers.x_unit} (byte "
        f"{headers.bytes[name]} of the trace header, scalar {found.scalar}), beyond every map, which reaches 10,010 km "
        f"from its origin; so {found.spacing:.4g} {headers.x_unit} between traces is not believed: "
        f"{remedy(scale, found.x, found.y, found.spacing, found.scalar)}"
    )


def _refuse_conflict(headers, traces, found):
    if other := conflict(headers, traces, found):
        raise DataError(
            f"{headers.layout.path} has traces {found.spacing:.4g} {headers.x_unit} apart ({_bytes(headers)} of the "
            f"trace header, scalar {found.scalar}), but {other}; say which holds: dx="
        )


def _refuse_uneven(headers, traces, found):
    if found.is_even:
        return
    steps, typical = found.steps, found.spacing
    worst = int(np.argmax(np.abs(steps - typical)))
    read = "" if found.stored == INTEGERS else f" (read as {found.stored})"
    same = "" if steps.all() else "; some stand at the same place, as those of a gather before it is stacked do"
    raise DataError(
        f"{headers.layout.path} has unevenly spaced traces{read}: most are {typical:g} apart, but traces "
        f"{traces[worst]} and {traces[worst + 1]} (counted from 0) {steps[worst]:g}{same}.{_without_positions(found)} "
        "Choose another part, or a line of a volume (inline=, crossline=, traces=), or say how far apart they shall "
        "count: dx="
    )


def _without_positions(found):
    """Advice where traces at the ends of a line stand at (0, 0), and all others elsewhere."""
    (placed,) = np.nonzero((found.x != 0) | (found.y != 0))
    first, last, count = placed[0], placed[-1], len(found.x)
    if len(placed) == count or last - first + 1 != len(placed):
        return ""
    return (
        f" {count - len(placed)} of them, at the ends, stand at (0, 0), where positions are missing; the others are "
        f"{first} to {last} of these: traces=slice({first}, {last + 1})."
    )


def _refuse_turning_back(headers, traces, found):
    """Compare the ends of two successive pieces, each long enough to show its direction in spite of the rounding."""
    piece = max(1, int(np.ceil(CLEAR * found.rounding / found.steps.mean())))
    if len(traces) <= 2 * piece:
        return
    reach = np.hypot(found.x[2 * piece :] - found.x[: -2 * piece], found.y[2 * piece :] - found.y[: -2 * piece])
    way = np.cumsum(np.concatenate([[0], found.steps]))
    share = reach / np.maximum(way[2 * piece :] - way[: -2 * piece], found.rounding / 100)
    worst = int(np.argmin(share))
    if share[worst] < TURNED:
        raise DataError(
            f"{headers.layout.path} has traces that go back and forth: the line turns back at trace "
            f"{traces[worst + piece]} (counted from 0; {_bytes(headers)} of the trace header). Choose a part that goes "
            "one way (inline=, crossline=, traces=), or say how far apart the traces shall count: dx="
        )


def _refuse_spacing(headers, traces, found, measured):
    scale, path, unit = scale_of(headers, traces), headers.layout.path, headers.x_unit
    said = (
        f"{path} has traces {measured:.4g} {unit} apart ({_bytes(headers)} of the trace header, scalar {found.scalar})"
    )
    advice = remedy(scale, found.x, found.y, measured, found.scalar)
    if not scale.is_spacing(measured):
        low, high = SPACINGS
        raise DataError(f"{said}, but those of a survey are {low:.1g} to {high:.3g} m apart: {advice}")
    if measured * scale.metres * (len(traces) - 1) > LONGEST:
        raise DataError(f"{said}, so that all {len(traces)} would reach farther than half around the earth: {advice}")


def _missing(headers, traces):
    x, y = headers.bytes["x"], headers.bytes["y"]
    said = f"{headers.layout.path} has no positions of its traces: bytes {x} and {y} of all headers hold the same"
    for other_x, other_y in PLACES:
        if any(np.ptp(headers(byte, traces)) for byte in (other_x, other_y)):
            others = f'header_bytes={{"x": {other_x}, "y": {other_y}}}'
            return f"{said}. Others stand at bytes {other_x} and {other_y}: give {others}, or the distance dx="
    return f"{said}. Say how far apart they are: dx="
