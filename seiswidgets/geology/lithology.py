"""Lithologies, and how their porosity falls with the depth of burial."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation

PER_KM = 1e-3  # c is given per kilometre, depths in metres
SCLATER_CHRISTIE = "Sclater & Christie (1980), J. Geophys. Res. 85, 3711-3739"
DENSITIES = 1000.0, 8000.0  # kg/m3, least and most
STEPS, SETTLED = 60, 1e-13  # of Newton's method, and of a thickness


@dataclass(frozen=True)
class Lithology:
    """A rock that compacts by Athy's law: its porosity is ``phi0 exp(-c z)`` at a depth of burial z.

    Parameters
    ----------
    phi0 : float
        Porosity at the surface, from 0 to below 1.
    c : float
        Decrease of the porosity's logarithm with depth, per kilometre; 0 or more.
    grain_density : float
        Density of the grains, in kg/m³.
    name, source : str
        Its name, and where the numbers come from.

    Raises
    ------
    SettingError
        If a number is out of its range.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> round(float(sw.LITHOLOGIES["shale"].porosity(2000)), 3)
    0.227
    """

    phi0: float
    c: float
    grain_density: float
    name: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        for field in ("phi0", "c", "grain_density"):
            object.__setattr__(self, field, validation.finite_number(field, getattr(self, field)))
        if not 0 <= self.phi0 < 1:
            raise SettingError(
                f"the porosity phi0 of a lithology must be from 0 to below 1, but is {self.phi0:g}; give it as a share"
            )
        if self.c < 0:
            raise SettingError(f"c must be 0 per km or more, but is {self.c:g}: porosity does not grow with depth")
        low, high = DENSITIES
        if not low <= self.grain_density <= high:
            raise SettingError(
                f"grain_density must be from {low:g} to {high:g} kg/m³, but is {self.grain_density:g}; 2650 is quartz"
            )

    def porosity(self, depth: ArrayLike) -> np.ndarray:
        """Porosity at depths of burial, in metres."""
        return np.asarray(self.phi0 * np.exp(-self.c * PER_KM * np.asarray(depth, float)))

    def density(self, depth: ArrayLike, water: float = 1030.0) -> np.ndarray:
        """Density with its pores full of water, in kg/m³, at depths of burial in metres."""
        porosity = self.porosity(depth)
        return np.asarray(porosity * water + (1 - porosity) * self.grain_density)


LITHOLOGIES = {
    lithology.name: lithology
    for lithology in (
        Lithology(0.63, 0.51, 2720.0, "shale", SCLATER_CHRISTIE),
        Lithology(0.49, 0.27, 2650.0, "sand", SCLATER_CHRISTIE),
        Lithology(0.56, 0.39, 2680.0, "shaly sand", SCLATER_CHRISTIE),
        Lithology(0.70, 0.71, 2710.0, "chalk", SCLATER_CHRISTIE),
        Lithology(0.0, 0.0, 2160.0, "salt", "halite, without pores"),
        Lithology(0.0, 0.0, 2700.0, "basement", "crystalline rock, without pores"),
    )
}
"""Lithologies by name: those of Sclater & Christie (1980), and two without pores."""


def named_lithology(lithology: Lithology | str) -> Lithology:
    """A lithology itself, or the one of that name; SettingError if there is none."""
    if isinstance(lithology, Lithology):
        return lithology
    if lithology not in tuple(LITHOLOGIES):
        raise SettingError(
            f"a lithology must be a seiswidgets.Lithology or one of {', '.join(LITHOLOGIES)}, but is {lithology!r}"
        )
    return LITHOLOGIES[lithology]


def pore_thickness(phi0: np.ndarray, c: np.ndarray, top: np.ndarray, base: np.ndarray, length: ArrayLike) -> np.ndarray:
    """Thickness of the pores in stretches of rock along which the depth of burial changes linearly.

    Parameters
    ----------
    phi0, c : array, shape (n,)
        c per metre.
    top, base : array, shape (n,)
        Depth of burial, that the porosity stands for, at both ends, in metres.
    length : array, shape (n,)
        Thickness of the rock, in metres.
    """
    fall = c * (base - top)
    flat = np.abs(fall) < 1e-8
    mean = np.where(flat, 1 - fall / 2, -np.expm1(-fall) / np.where(flat, 1, fall))
    return np.asarray(length * phi0 * np.exp(-c * top) * mean)


def thickness_at(phi0: np.ndarray, c: np.ndarray, solid: np.ndarray, top: np.ndarray) -> np.ndarray:
    """Thickness of rock that holds a thickness of grains where its top is buried at a depth; by Newton's method.

    The function solved, ``length - pores(length) = solid``, rises with a slope from 1 - phi0 to 1 and is convex, so
    that Newton's method from above converges from any start.

    Parameters
    ----------
    phi0, c, solid, top : array, shape (n,)
        c per metre, the others in metres.
    """
    length = solid / (1 - phi0)
    for _ in range(STEPS):
        excess = length - pore_thickness(phi0, c, top, top + length, length) - solid
        step = excess / (1 - phi0 * np.exp(-c * (top + length)))
        length = length - step
        if (np.abs(step) <= SETTLED * (1 + length)).all():
            break
    return np.asarray(length)
