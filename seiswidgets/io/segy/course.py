"""Course of a SEG-Y line on the map and spacing of its traces; implausible positions are refused."""

import numpy as np

from seiswidgets.errors import DataError, Keyword, Text
from seiswidgets.geology.findings import Finding
from seiswidgets.io.segy.doubts import LONGEST, SPACINGS, WIDE, are_degrees, remedy, rounded
from seiswidgets.io.segy.lines import Line
from seiswidgets.io.segy.positions import INTEGERS, POSITION_BYTES, Positions, conflict, positions, scale_of
from seiswidgets.io.segy.traces import TraceHeaders

STRAIGHT = 0.01  # of the distance between its ends: excess length of a line that counts as straight
CLEAR = 4  # roundings: length of a piece of a line that shows its direction
EXACT = 10  # roundings: distance between points that is exact to 0.1%
TURNED = 0.5  # of the arc length of two such pieces: if their ends are closer than this, the line turns back

DX = Keyword("dx")  # as errors name it
CHOOSE_LINE = (Keyword("inline"), ", ", Keyword("crossline"), " or ", Keyword("traces"))
GIVE_DX = Text("give the distance between traces: ", DX)


def spacing(headers: TraceHeaders, line: Line) -> float:
    """Distance between the columns of a line, in the unit of the positions; errors as for ``course``."""
    return _length(course(headers, line)) / (line.width - 1)


def course(headers: TraceHeaders, line: Line) -> np.ndarray:
    """Map positions along a line, in their own unit, shape (m, 2).

    A straight line is reduced to its ends, because rounded positions between them would make it longer.

    Raises
    ------
    DataError
        If positions are missing, angles, unevenly spaced or implausible, or if the line turns back.
    """
    traces = line.traces
    _refuse_angles(headers, traces)
    found = positions(headers, traces)
    if not found.steps.any():
        raise DataError(_missing(headers, traces), kind="positions")
    _refuse_conflict(headers, traces, found)
    _refuse_undeclared_angles(headers, traces, found)
    _refuse_beyond_maps(headers, traces, found)
    found = found.at(line.columns)
    _refuse_uneven(headers, line, found)
    _refuse_turning_back(headers, line, found)
    points = _without_rounding(found)
    _refuse_spacing(headers, traces, found, _length(points) / (line.width - 1))
    return points


def _without_rounding(found: Positions) -> np.ndarray:
    """Points along a line: its ends if it is straight, else positions so far apart that rounding adds no length."""
    points = np.column_stack([found.x, found.y])
    apart = int(np.ceil(EXACT * found.rounding / found.steps.mean()))
    thinned = points[sorted({*range(0, len(points) - apart, max(apart, 1)), 0, len(points) - 1})]
    ends = points[[0, -1]]
    return ends if _length(thinned) <= (1 + STRAIGHT) * _length(ends) else thinned


def _length(points: np.ndarray) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def remarks(headers: TraceHeaders, line: Line, measured: float) -> tuple[Finding, ...]:
    """Warnings about positions that were accepted."""
    traces = line.traces
    found, texts = positions(headers, traces), []
    if found.stored != INTEGERS:
        texts.append(
            Text(f"positions ({_bytes(headers)}) are read as {found.stored}, as they are not plausible as integers")
        )
    if measured * scale_of(headers, traces).metres > WIDE:
        texts.append(
            Text(
                f"traces are {measured:g} {headers.x_unit} apart, which is far: if positions are in tenths of that "
                "unit, give ",
                Keyword("dx", rounded(measured / 10)),
            )
        )
    return tuple(Finding("warning", "positions", text) for text in texts)


def _bytes(headers: TraceHeaders) -> str:
    return f"bytes {headers.first_bytes['x']} and {headers.first_bytes['y']}"


def _refuse_angles(headers: TraceHeaders, traces: np.ndarray) -> None:
    unit = int(headers(89, traces[:1])[0])
    if unit in (2, 3, 4):
        raise DataError(
            f"{headers.layout.path} has positions in degrees or seconds of arc (bytes 89-90 of the trace header: "
            f"{unit}), which are not distances; ",
            GIVE_DX,
            kind="positions",
        )


def _refuse_undeclared_angles(headers: TraceHeaders, traces: np.ndarray, found: Positions) -> None:
    apart = float(found.steps.mean())
    if are_degrees(found.x, found.y, apart):
        raise DataError(
            f"{headers.layout.path} has positions {apart:.2g} apart, all within ±360 and ±90, which seem to be "
            "degrees, not distances; ",
            GIVE_DX,
            kind="positions",
        )
    declared = headers(89, traces[:1])[0] == 1
    if not declared and scale_of(headers, traces).may_be_seconds(found.x, found.y, found.spacing):
        raise DataError(
            f"{headers.layout.path} has positions {found.spacing:.2g} apart, all within ±648000 and ±324000, which may "
            "be seconds of arc as well as lengths (bytes 89-90 of the trace header do not say); ",
            GIVE_DX,
            kind="positions",
        )


def _refuse_beyond_maps(headers: TraceHeaders, traces: np.ndarray, found: Positions) -> None:
    scale = scale_of(headers, traces)
    if scale.is_on_map(found.x, found.y, found.spacing):
        return
    name = max(("x", "y"), key=lambda name: np.abs(getattr(found, name)).max())
    values = getattr(found, name)
    raise DataError(
        f"{headers.layout.path} has traces at {name} = {values[np.argmax(np.abs(values))]:,.0f} {headers.x_unit} (byte "
        f"{headers.first_bytes[name]} of the trace header, scalar {found.scalar}), beyond every map, which reaches "
        f"10,010 km from its origin; so {found.spacing:.4g} {headers.x_unit} between traces is doubtful: ",
        remedy(scale, found.x, found.y, found.spacing, found.scalar),
        kind="positions",
    )


def _refuse_conflict(headers: TraceHeaders, traces: np.ndarray, found: Positions) -> None:
    if other := conflict(headers, traces, found):
        raise DataError(
            f"{headers.layout.path} has traces {found.spacing:.4g} {headers.x_unit} apart ({_bytes(headers)} of the "
            f"trace header, scalar {found.scalar}), but {other}; give the distance that is right: ",
            DX,
            kind="positions",
        )


def _refuse_uneven(headers: TraceHeaders, line: Line, found: Positions) -> None:
    if found.is_even:
        return
    steps, typical = found.steps, found.spacing
    worst = int(np.argmax(np.abs(steps - typical)))
    index = min(line.index_before(worst), len(line.traces) - 2)
    read = "" if found.stored == INTEGERS else f" (read as {found.stored})"
    same = "" if steps.all() else "; some are at the same position, as in an unstacked gather"
    raise DataError(
        f"{headers.layout.path} has unevenly spaced traces{read}: most are {typical:g} apart, but traces "
        f"{line.traces[index]} and {line.traces[index + 1]} (counted from 0) are {steps[worst]:g} apart{same}.",
        _without_positions(line, found),
        " Choose another part, or a line of a volume (",
        *CHOOSE_LINE,
        "), or ",
        GIVE_DX,
        kind="positions",
    )


def _without_positions(line: Line, found: Positions) -> Text:
    """Advice if traces at the ends of a line are at (0, 0), and all others elsewhere."""
    (placed,) = np.nonzero((found.x != 0) | (found.y != 0))
    first, last, count = placed[0], placed[-1], len(found.x)
    if len(placed) == count or last - first + 1 != len(placed) or line.width != line.traces[-1] + 1:
        return Text()
    return Text(
        f" {count - len(placed)} traces at the ends are at (0, 0), which means that their positions are missing; the "
        f"others are {first} to {last} of these: ",
        Keyword("traces", range(int(first), int(last) + 1)),
        ".",
    )


def _refuse_turning_back(headers: TraceHeaders, line: Line, found: Positions) -> None:
    """Compare the ends of two successive pieces, each long enough to show its direction despite the rounding."""
    piece = max(1, int(np.ceil(CLEAR * found.rounding / found.steps.mean())))
    if line.width <= 2 * piece:
        return
    distance = np.hypot(found.x[2 * piece :] - found.x[: -2 * piece], found.y[2 * piece :] - found.y[: -2 * piece])
    arc_length = np.cumsum(np.concatenate([[0], found.steps]))
    share = distance / np.maximum(arc_length[2 * piece :] - arc_length[: -2 * piece], found.rounding / 100)
    worst = int(np.argmin(share))
    if share[worst] < TURNED:
        raise DataError(
            f"{headers.layout.path} has traces that go back and forth: the line turns back at trace "
            f"{line.traces[line.index_before(worst + piece)]} (counted from 0; {_bytes(headers)} of the trace header). "
            "Choose a part without turns (",
            *CHOOSE_LINE,
            "), or ",
            GIVE_DX,
            kind="positions",
        )


def _refuse_spacing(headers: TraceHeaders, traces: np.ndarray, found: Positions, measured: float) -> None:
    scale, path, unit = scale_of(headers, traces), headers.layout.path, headers.x_unit
    observation = (
        f"{path} has traces {measured:.4g} {unit} apart ({_bytes(headers)} of the trace header, scalar {found.scalar})"
    )
    advice = remedy(scale, found.x, found.y, measured, found.scalar)
    if not scale.is_spacing(measured):
        low, high = SPACINGS
        raise DataError(
            f"{observation}, but those of a survey are {low:.1g} to {high:.3g} m apart: ", advice, kind="positions"
        )
    if scale.is_scalar_doubtful(found.x, found.y, measured, found.scalar):
        raise DataError(
            f"{observation}, which is doubtful: they would be unusually close, and not if the scalar did not apply: ",
            advice,
            ". If it does apply, give ",
            Keyword("dx", rounded(measured)),
            kind="positions",
        )
    if measured * scale.metres * (len(traces) - 1) > LONGEST:
        raise DataError(
            f"{observation}, so that all {len(traces)} would reach farther than halfway around the earth: ",
            advice,
            kind="positions",
        )


def _missing(headers: TraceHeaders, traces: np.ndarray) -> Text:
    x, y = headers.first_bytes["x"], headers.first_bytes["y"]
    observation = f"{headers.layout.path} has no trace positions: bytes {x} and {y} are the same in all headers"
    for other_x, other_y in POSITION_BYTES:
        if any(np.ptp(headers(byte, traces)) for byte in (other_x, other_y)):
            return Text(
                f"{observation}. Other positions are at bytes {other_x} and {other_y}: give ",
                Keyword("header_bytes", {"x": other_x, "y": other_y}),
                ", or the distance between traces, ",
                DX,
            )
    return Text(f"{observation}; ", GIVE_DX)
