"""Map positions of SEG-Y traces: integers as the standard has them, or floats at the same bytes where that is plain."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.section import METRES
from seiswidgets.io.segy.doubts import Scale, are_degrees
from seiswidgets.io.segy.traces import SHORT, TraceHeaders, ibm_floats
from seiswidgets.io.segy.vertical import STANDARD_SCALARS, finest_interval, scalar_factors

PLACES = ((181, 185), (73, 77), (81, 85))  # of the midpoint; source and receiver, where old lines have their positions
SMALLEST, LARGEST = 1e-3, 1e9  # of a float that is a position, beside 0
INTEGERS = "integers"
EVEN = 0.05  # of the spacing: what a step may differ from it, beside the rounding of the positions
ROUNDED = 1.5  # roundings: by how much a step may differ whose ends are both rounded, in x and in y


@dataclass(frozen=True, eq=False)
class Positions:
    """Positions of traces in their own unit.

    Attributes
    ----------
    x, y : array, shape (n,)
    rounding : float
        The step in which they are stored.
    stored : str
        As what, in words.
    scalar : int
        That of the first trace, as the header has it.
    """

    x: np.ndarray
    y: np.ndarray
    rounding: float
    stored: str
    scalar: int

    @property
    def steps(self) -> np.ndarray:
        """Distance from each to the next, shape (n - 1,)."""
        return np.hypot(np.diff(self.x), np.diff(self.y))

    @property
    def spacing(self) -> float:
        """Median distance from one to the next."""
        return float(np.median(self.steps))

    @property
    def is_even(self) -> bool:
        """Whether all steps are as long as the median, but for their rounding."""
        return bool(np.abs(self.steps - self.spacing).max() <= EVEN * self.spacing + ROUNDED * self.rounding)


def scale_of(headers: TraceHeaders, traces: np.ndarray) -> Scale:
    """The unit and the sample interval by which positions are judged."""
    return Scale(METRES[headers.x_unit], finest_interval(headers, traces[:1]))


def positions(headers: TraceHeaders, traces: np.ndarray) -> Positions:
    """Positions of traces, read as floats where integers cannot be meant and one kind of floats is plausible.

    Raises
    ------
    DataError
        If their scalar is not the standard's, or if they are plausible when read in several ways.
    """
    scalar = _checked_scalar(headers, traces)
    raw, factor = [headers(name, traces) for name in ("x", "y")], scalar_factors(scalar)
    integers = Positions(raw[0] * factor, raw[1] * factor, float(factor.max()), INTEGERS, int(scalar[0]))
    floats = list(_as_floats(headers, raw, scalar))
    if not floats:
        return integers
    found = _plausible(scale_of(headers, traces), [integers, *floats])
    if len(found) > 1:
        raise DataError(_ambiguous(headers, found))
    return next(iter(found), integers)


def _plausible(scale, readings):
    """Those that a survey may have; of several the even one, and only if there are none, floats that are degrees."""
    found = [
        each for each in readings if scale.is_spacing(each.spacing) and scale.is_on_map(each.x, each.y, each.spacing)
    ]
    if not found:
        return [each for each in readings if each.spacing and are_degrees(each.x, each.y, each.spacing)][:1]
    even = [each for each in found if each.is_even]
    return even if len(even) == 1 else found


def _checked_scalar(headers, traces):
    scalar = headers("scalar", traces)
    other = scalar[~np.isin(np.abs(scalar), STANDARD_SCALARS)]
    if len(other):
        raise DataError(
            f"{headers.layout.path} has {other[0]} as the scalar of its positions (byte {headers.bytes['scalar']} of "
            "the trace header), which must be 1, 10, 100, 1000 or 10000, or one of these below 0. If it stands at "
            "another byte, give header_bytes=; or say how far apart the traces are: dx="
        )
    return scalar


def _as_floats(headers, raw, scalar) -> Iterator[Positions]:
    """Readings of four bytes as floats, with and without the scalar; none where one is no size of a position."""
    if {headers.bytes["x"], headers.bytes["y"]} & SHORT:
        return
    bits = [values.astype(np.uint32) for values in raw]  # negative integers keep their bits
    for kind, read in (("IEEE floats", _ieee_floats), ("IBM floats", ibm_floats)):
        x, y = map(read, bits)
        sizes = np.abs(np.concatenate([x, y]))
        sizes = sizes[sizes != 0]
        if not len(sizes) or not ((sizes >= SMALLEST) & (sizes <= LARGEST)).all():
            continue
        rounding = 2.0**-23 * float(sizes.max()) * (16 if read is ibm_floats else 1)
        first, factor = int(scalar[0]), scalar_factors(scalar)
        yield Positions(x, y, rounding, kind, first)
        if (factor != 1).any():
            rounding *= float(factor.max())
            yield Positions(x * factor, y * factor, rounding, f"{kind} with their scalar", first)


def _ieee_floats(bits):
    return bits.view(np.float32).astype(float)


def _ambiguous(headers, plausible):
    x, y = headers.bytes["x"], headers.bytes["y"]
    readings = " or ".join(f"{each.spacing:.4g} apart as {each.stored}" for each in plausible)
    return (
        f"{headers.layout.path} has positions at bytes {x} and {y} that can be read in several ways: traces are "
        f"{readings}; say which distance holds: dx="
    )


def conflict(headers: TraceHeaders, traces: np.ndarray, own: Positions) -> str:
    """Other positions in the trace headers that are the same but for a power of ten, in words; "" if none."""
    if own.stored != INTEGERS:
        return ""
    factor = scalar_factors(headers("scalar", traces))
    for x, y in PLACES:
        if (x, y) == (headers.bytes["x"], headers.bytes["y"]):
            continue
        other = Positions(headers(x, traces) * factor, headers(y, traces) * factor, own.rounding, INTEGERS, own.scalar)
        if _same_but_for_a_power_of_ten(own, other):
            return f"bytes {x} and {y} hold the same positions, but {other.spacing:.4g} apart"
    return ""


def _same_but_for_a_power_of_ten(own, other):
    if not own.spacing or not other.spacing:
        return False
    power = np.rint(np.log10(other.spacing / own.spacing))
    sizes = [(np.hypot(each.x, each.y), each.spacing) for each in (own, other)]
    ratios = sizes[1][0] / np.maximum(sizes[0][0], own.rounding), sizes[1][1] / sizes[0][1]
    return bool(power) and all(np.allclose(ratio, 10**power, rtol=0.02) for ratio in ratios)
