"""Map positions of SEG-Y traces: integers as in the standard, or floats at the same bytes where that is evident."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seiswidgets.errors import DataError, Keyword, Text
from seiswidgets.geology.section import METRES
from seiswidgets.io.segy.doubts import Scale, are_degrees
from seiswidgets.io.segy.traces import TraceHeaders, ibm_floats
from seiswidgets.io.segy.vertical import STANDARD_SCALARS, finest_interval, scalar_factors

POSITION_BYTES = ((181, 185), (73, 77), (81, 85))  # midpoint; source and receiver, used by old lines
SMALLEST, LARGEST = 1e-3, 1e9  # size of a position other than 0 stored as a float
INTEGERS = "integers"
EVEN = 0.05  # of the spacing: tolerance of a step, besides the rounding of the positions
ROUNDED = 1.5  # roundings: tolerance of a step whose ends are both rounded, in x and in y


@dataclass(frozen=True, eq=False)
class Positions:
    """Positions of traces in their own unit.

    Attributes
    ----------
    x, y : array, shape (n,)
    rounding : float
        Smallest step in which they are stored.
    stored : str
        Storage format, in words.
    scalar : int
        Scalar of the first trace, as in its header.
    """

    x: np.ndarray
    y: np.ndarray
    rounding: float
    stored: str
    scalar: int

    def at(self, columns: np.ndarray) -> "Positions":
        """Positions at all columns of a line; those without a trace are interpolated."""
        every = np.arange(columns[-1] + 1)
        if len(every) == len(columns):
            return self
        return replace(self, x=np.interp(every, columns, self.x), y=np.interp(every, columns, self.y))

    @property
    def steps(self) -> np.ndarray:
        """Distance from each position to the next, shape (n - 1,)."""
        return np.hypot(np.diff(self.x), np.diff(self.y))

    @property
    def spacing(self) -> float:
        """Median distance from one position to the next."""
        return float(np.median(self.steps))

    @property
    def is_even(self) -> bool:
        """True if all steps are as long as the median, within tolerance."""
        return bool(np.abs(self.steps - self.spacing).max() <= EVEN * self.spacing + ROUNDED * self.rounding)


def scale_of(headers: TraceHeaders, traces: np.ndarray) -> Scale:
    """Unit and sample interval by which positions are judged."""
    return Scale(METRES[headers.x_unit], finest_interval(headers, traces[:1]))


def positions(headers: TraceHeaders, traces: np.ndarray) -> Positions:
    """Positions of traces, read as floats if integers are implausible and exactly one kind of floats is plausible.

    Raises
    ------
    DataError
        If their scalar is not one of the standard's, or if several readings are plausible.
    """
    scalar = _checked_scalar(headers, traces)
    raw, factor = [headers(name, traces) for name in ("x", "y")], scalar_factors(scalar)
    if any(values.dtype.kind == "f" for values in raw):
        return _given_floats(headers, raw, scalar)
    integers = Positions(raw[0] * factor, raw[1] * factor, float(factor.max()), INTEGERS, int(scalar[0]))
    floats = list(_as_floats(headers, raw, scalar))
    if not floats:
        return integers
    plausible = _plausible(scale_of(headers, traces), [integers, *floats])
    if len(plausible) > 1:
        raise DataError(_ambiguous(headers, plausible), kind="positions")
    return next(iter(plausible), integers)


def _given_floats(headers: TraceHeaders, raw: Sequence[np.ndarray], scalar: np.ndarray) -> Positions:
    """Floats, as the user has given them; their scalar applies if they are plausible only with it."""
    kinds = " and ".join(dict.fromkeys(headers.fields[name].kind for name in ("x", "y")))
    x, y = (values.astype(float) for values in raw)
    if not np.isfinite([x, y]).all():
        raise DataError(
            f"{headers.layout.path} has positions that are no numbers if they are read as {kinds}; correct ",
            Keyword("header_bytes"),
            kind="positions",
        )
    readings = list(_with_and_without_scalar(x, y, 2.0**-20, f"floats ({kinds})", scalar))
    return next(iter(_plausible(scale_of(headers, np.arange(1)), readings)), readings[0])


def _plausible(scale: Scale, readings: Sequence[Positions]) -> list[Positions]:
    """Readings that a survey may have: if there are several, the even one; if none, one that is in degrees."""
    plausible = [
        each for each in readings if scale.is_spacing(each.spacing) and scale.is_on_map(each.x, each.y, each.spacing)
    ]
    if not plausible:
        return [each for each in readings if each.spacing and are_degrees(each.x, each.y, each.spacing)][:1]
    even = [each for each in plausible if each.is_even]
    return even if len(even) == 1 else plausible


def _checked_scalar(headers: TraceHeaders, traces: np.ndarray) -> np.ndarray:
    scalar = headers("scalar", traces)
    other = scalar[~np.isin(np.abs(scalar), STANDARD_SCALARS)]
    if len(other):
        raise DataError(
            f"{headers.layout.path} has {other[0]} as the scalar of its positions (byte "
            f"{headers.first_bytes['scalar']} of the trace header), which must be 1, 10, 100, 1000 or 10000, or the "
            "negative of one of these. If it is at another byte, give ",
            Keyword("header_bytes"),
            "; or give the distance between traces: ",
            Keyword("dx"),
            kind="positions",
        )
    return scalar


def _as_floats(headers: TraceHeaders, raw: Sequence[np.ndarray], scalar: np.ndarray) -> Iterator[Positions]:
    """Readings of four bytes as floats, with and without the scalar, if all of them may be positions."""
    if any(headers.fields[name].kind != "i4" or headers.fields[name].is_given for name in ("x", "y")):
        return
    bits = [values.astype(np.uint32) for values in raw]  # negative integers keep their bits
    for kind, read in (("IEEE floats", _ieee_floats), ("IBM floats", ibm_floats)):
        x, y = map(read, bits)
        sizes = np.abs(np.concatenate([x, y]))
        sizes = sizes[sizes != 0]
        if not len(sizes) or not ((sizes >= SMALLEST) & (sizes <= LARGEST)).all():
            continue
        yield from _with_and_without_scalar(x, y, 2.0**-23 * (16 if read is ibm_floats else 1), kind, scalar)


def _with_and_without_scalar(
    x: np.ndarray, y: np.ndarray, precision: float, stored: str, scalar: np.ndarray
) -> Iterator[Positions]:
    rounding = precision * float(np.abs([x, y]).max())
    first, factor = int(scalar[0]), scalar_factors(scalar)
    yield Positions(x, y, rounding, stored, first)
    if (factor != 1).any():
        yield Positions(x * factor, y * factor, rounding * float(factor.max()), f"{stored} with their scalar", first)


def _ieee_floats(bits: np.ndarray) -> np.ndarray:
    return bits.view(np.float32).astype(float)


def _ambiguous(headers: TraceHeaders, plausible: Sequence[Positions]) -> Text:
    x, y = headers.first_bytes["x"], headers.first_bytes["y"]
    readings = " or ".join(f"{each.spacing:.4g} apart as {each.stored}" for each in plausible)
    return Text(
        f"{headers.layout.path} has positions at bytes {x} and {y} that can be read in several ways: traces are "
        f"{readings}; give the distance that is right: ",
        Keyword("dx"),
    )


def conflict(headers: TraceHeaders, traces: np.ndarray, own: Positions) -> str:
    """Describe other positions in the trace headers that differ only by a power of ten; "" if there are none."""
    if own.stored != INTEGERS:
        return ""
    factor = scalar_factors(headers("scalar", traces))
    for x, y in POSITION_BYTES:
        if (x, y) == (headers.first_bytes["x"], headers.first_bytes["y"]):
            continue
        other = Positions(headers(x, traces) * factor, headers(y, traces) * factor, own.rounding, INTEGERS, own.scalar)
        if _differ_by_a_power_of_ten(own, other):
            return f"bytes {x} and {y} hold the same positions, but {other.spacing:.4g} apart"
    return ""


def _differ_by_a_power_of_ten(own: Positions, other: Positions) -> bool:
    if not own.spacing or not other.spacing:
        return False
    power = np.rint(np.log10(other.spacing / own.spacing))
    sizes = [(np.hypot(each.x, each.y), each.spacing) for each in (own, other)]
    ratios = sizes[1][0] / np.maximum(sizes[0][0], own.rounding), sizes[1][1] / sizes[0][1]
    return bool(power) and all(np.allclose(ratio, 10**power, rtol=0.02) for ratio in ratios)
