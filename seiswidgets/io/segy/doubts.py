"""Plausibility of map positions and of the spacing between traces: what no map and no survey has."""

from dataclasses import dataclass

import numpy as np

NORTHING = 10_010_000  # m, from the equator to a pole, and the most that a projection in use adds to a southern one
ZONED = (10e6, 61e6)  # m: eastings that begin with the number of their zone, as those of China and Russia do
IN_ZONE = (160_000, 840_000)  # m: the rest of such an easting
ZONED_NORTHING = 1_500_000  # m: zones are put before eastings only farther north
ZONED_SPACING = 51  # m: above it, an easting with a zone may as well be one in decimetres
SPACINGS = (0.49, 205)  # m: of a boomer's line, and of one in groups of 660 feet
FINE_SPACING, FINE_INTERVAL = 0.045, 0.25  # m, and the sample interval in ms at which traces may stand so close
USUAL = (1, 60)  # m: of most surveys
WIDE = 105  # m: believed, but said
LONGEST = 20_000_000  # m, half around the earth
FOOT = 0.3048  # m
DEGREES, CLOSE = (360, 90), 0.005  # positions within these, and no farther apart, cannot be metres or feet
SECONDS, SECONDS_CLOSE, SECONDS_INTERVAL = (648_000, 324_000), 4, 1  # of arc: 0.8 to 3 are usual spacings
FAR_FROM_0 = 3600  # seconds of arc: a degree
UNITS = {0.1: "decimetres", 0.01: "centimetres", 0.001: "millimetres", 10: "tens of metres", 100: "hundreds of metres"}


@dataclass(frozen=True)
class Scale:
    """What is needed to judge positions.

    Attributes
    ----------
    metres : float
        In the unit of the positions.
    interval : float or None
        Of the samples, in ms or m, the finest that the headers state.
    """

    metres: float
    interval: float | None

    def is_spacing(self, spacing: float) -> bool:
        """Whether a survey may have this distance between traces."""
        fine = self.interval is not None and self.interval <= FINE_INTERVAL
        return (FINE_SPACING if fine else SPACINGS[0]) <= spacing * self.metres <= SPACINGS[1]

    def is_on_map(self, x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
        """Whether a map reaches as far as these positions."""
        far_x, far_y = (np.abs(values).max() * self.metres for values in (x, y))
        if far_y > NORTHING:
            return False
        return far_x <= NORTHING or self._is_zoned(x, y, spacing)

    def _is_zoned(self, x, y, spacing):
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

    def may_be_seconds(self, x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
        """Whether positions may be seconds of arc: as far from 0 as most places are, and too close for the samples."""
        coarse = self.is_spacing(spacing) and (self.interval is None or self.interval >= SECONDS_INTERVAL)
        sizes = zip((x, y), SECONDS, strict=True)
        return (
            coarse
            and spacing < SECONDS_CLOSE
            and all(np.abs(v).min() > FAR_FROM_0 and np.abs(v).max() <= most for v, most in sizes)
        )


def are_degrees(x: np.ndarray, y: np.ndarray, spacing: float) -> bool:
    """Whether positions are too small and too close to be anything but degrees."""
    return spacing < CLOSE and np.abs(x).max() <= DEGREES[0] and np.abs(y).max() <= DEGREES[1]


def remedy(scale: Scale, x: np.ndarray, y: np.ndarray, spacing: float, scalar: int) -> str:
    """Explanations that make the positions plausible, each with the keyword to give, ready to follow a colon."""
    found = [
        f"if {reason}, the traces are {spacing * factor:.4g} apart: dx={spacing * factor:.4g}"
        for reason, factor in _explanations(scalar)
        if USUAL[0] <= spacing * factor * scale.metres <= USUAL[1]
        and scale.is_on_map(x * factor, y * factor, spacing * factor)
    ][:1]
    feet = Scale(FOOT, scale.interval)
    if scale.metres == 1 and feet.is_spacing(spacing) and feet.is_on_map(x, y, spacing):
        found.append('if they are in feet: x_unit="ft"')
    otherwise = "give the distance between traces, dx=, or other bytes of positions, header_bytes="
    return "; ".join([*found, "else " * bool(found) + otherwise])


def _explanations(scalar):
    """Reasons why positions may be wrong, and what they are to be multiplied by then."""
    if abs(scalar) > 1:
        size = float(abs(scalar))
        yield f"the scalar should be {-scalar}", size ** (-2 if scalar > 0 else 2)
        yield "the scalar does not apply", size ** (-1 if scalar > 0 else 1)
    for factor, unit in UNITS.items():
        yield f"they are in {unit}", factor
