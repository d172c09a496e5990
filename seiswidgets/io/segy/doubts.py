"""Plausibility of map positions and of trace spacing: limits that no map and no survey exceeds."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import Keyword, Text

NORTHING = 10_010_000  # m: equator to pole, and the largest offset that projections add to southern northings
ZONED = (10e6, 61e6)  # m: eastings that begin with the number of their zone, as in China and Russia
IN_ZONE = (160_000, 840_000)  # m: such an easting without its zone
ZONED_NORTHING = 1_500_000  # m: zones precede eastings only farther north
ZONED_SPACING = 51  # m: above it, an easting with a zone may also be one in decimetres
SPACINGS = (0.49, 205)  # m: from a boomer's line to one with groups of 660 feet
FINE_SPACING, FINE_INTERVAL = 0.045, 0.25  # m, and the largest sample interval, in ms, that allows it
USUAL = (1, 60)  # m: most surveys
CLOSEST, CLOSE_ON_MAP = 0.8, 7  # m per ms between samples, and m: closer traces are rare
WIDE = 105  # m: accepted with a warning
LONGEST = 20_000_000  # m: half the earth's circumference
FOOT = 0.3048  # m
DEGREES, CLOSE = (360, 90), 0.005  # positions within these limits, and closer than this, cannot be metres or feet
SECONDS, SECONDS_CLOSE, SECONDS_INTERVAL = (648_000, 324_000), 4, 1  # of arc; usual spacings are 0.8 to 3
FAR_FROM_0 = 3600  # seconds of arc: a degree
DX, BYTES = Keyword("dx"), Keyword("header_bytes")  # as errors name them
UNITS = {0.1: "decimetres", 0.01: "centimetres", 0.001: "millimetres", 10: "tens of metres", 100: "hundreds of metres"}


@dataclass(frozen=True)
class Scale:
    """Unit and sample interval by which positions are judged.

    Attributes
    ----------
    metres : float
        Metres in the unit of the positions.
    interval : float or None
        Finest sample interval that the headers state, in ms or m.
    """

    metres: float
    interval: float | None

    def is_spacing(self, spacing: float) -> bool:
        """Check whether a survey may have this distance between traces."""
        fine = self.interval is not None and self.interval <= FINE_INTERVAL
        return (FINE_SPACING if fine else SPACINGS[0]) <= spacing * self.metres <= SPACINGS[1]

    def is_on_map(self, x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
        """Check whether a map reaches as far as these positions."""
        far_x, far_y = (np.abs(values).max() * self.metres for values in (x, y))
        if far_y > NORTHING:
            return False
        return bool(far_x <= NORTHING) or self._is_zoned(x, y, spacing)

    def _is_zoned(self, x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
        rest = x % 1e6
        return bool(
            self.metres == 1
            and ZONED[0] <= x.min()
            and x.max() <= ZONED[1]
            and IN_ZONE[0] <= rest.min()
            and rest.max() <= IN_ZONE[1]
            and y.min() >= ZONED_NORTHING
            and spacing <= ZONED_SPACING
        )

    def is_scalar_doubtful(self, x: np.ndarray, y: np.ndarray, spacing: float, scalar: int) -> bool:
        """Check whether traces are too close for their samples or their map, but not if a scalar did not divide."""
        close, size = spacing * self.metres, abs(scalar)
        if scalar >= -1 or not USUAL[0] <= close * size <= USUAL[1]:
            return False
        finely_sampled = self.interval is not None and self.interval >= 1 and close < CLOSEST * self.interval
        return finely_sampled or (close <= CLOSE_ON_MAP and _in_zone(x * size, y * size) and not _in_zone(x, y))

    def may_be_seconds(self, x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
        """Check whether positions may be seconds of arc: far from 0, and too close for their sample interval."""
        coarse = self.is_spacing(spacing) and (self.interval is None or self.interval >= SECONDS_INTERVAL)
        sizes = zip((x, y), SECONDS, strict=True)
        return (
            coarse
            and spacing < SECONDS_CLOSE
            and all(np.abs(v).min() > FAR_FROM_0 and np.abs(v).max() <= most for v, most in sizes)
        )


def _in_zone(x: np.ndarray, y: np.ndarray) -> bool:
    """Check whether positions are an easting and a northing of a zone, as on most maps of the world."""
    return bool(IN_ZONE[0] <= x.min() and x.max() <= IN_ZONE[1] and y.min() >= 1e6 and y.max() <= NORTHING)


def are_degrees(x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
    """Check whether positions are too small and too close to be anything but degrees."""
    return bool(spacing < CLOSE and np.abs(x).max() <= DEGREES[0] and np.abs(y).max() <= DEGREES[1])


def remedy(scale: Scale, x: np.ndarray, y: np.ndarray, spacing: float, scalar: int) -> Text:
    """Explanations that make the positions plausible, each with the keyword to give."""
    advice: list[str | Keyword] = []
    for reason, factor in _explanations(scalar):
        corrected = rounded(spacing * factor)
        is_usual = USUAL[0] <= spacing * factor * scale.metres <= USUAL[1]
        if is_usual and scale.is_on_map(x * factor, y * factor, spacing * factor):
            advice += [f"if {reason}, the traces are {corrected:g} apart: ", Keyword("dx", corrected), "; "]
            break
    feet = Scale(FOOT, scale.interval)
    if scale.metres == 1 and feet.is_spacing(spacing) and feet.is_on_map(x, y, spacing):
        advice += ["if they are in feet: ", Keyword("x_unit", "ft"), "; "]
    otherwise = "otherwise " if advice else ""
    return Text(*advice, otherwise, "give the distance between traces, ", DX, ", or other bytes of positions, ", BYTES)


def rounded(value: float) -> float:
    """A value with four digits, as an int if it is whole."""
    short = float(f"{value:.4g}")
    return int(short) if short.is_integer() else short


def _explanations(scalar: int) -> Iterator[tuple[str, float]]:
    """Reasons why positions may be wrong, each with the factor that corrects them."""
    if abs(scalar) > 1:
        size = float(abs(scalar))
        yield f"the scalar should be {-scalar}", size ** (-2 if scalar > 0 else 2)
        yield "the scalar does not apply", size ** (-1 if scalar > 0 else 1)
    for factor, unit in UNITS.items():
        yield f"they are in {unit}", factor
