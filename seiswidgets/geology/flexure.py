"""Isostasy: how far the crust sinks or rises under a change of load."""

from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, idct

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation

GRAVITY = 9.81  # m/s2
BEYONDS = MIRROR, CONSTANT, ZERO = "mirror", "constant", "zero"
FAR = 12.0  # flexural lengths, over which a load goes on beyond the section


@dataclass(frozen=True)
class Isostasy:
    """Airy isostasy, or a thin elastic plate on a fluid mantle.

    A load q of wave number k sinks by ``q / ((rho_mantle - rho_fill) g + D k^4)``, where the rigidity D is
    ``E Te^3 / (12 (1 - nu^2))``; with Te = 0 it is Airy's. The room above the sunken surface is filled by water, or by
    air if there is no sea.

    Parameters
    ----------
    elastic_thickness : float
        Effective elastic thickness Te, in metres; 0 is Airy isostasy.
    sea_level : float or None
        In the section's unit of z; None if there is no sea.
    mantle_density, water_density : float
        In kg/m³.
    youngs_modulus : float
        E, in Pa.
    poisson : float
        Poisson's ratio nu.

    Raises
    ------
    SettingError
        If a value is out of its range.
    """

    elastic_thickness: float = 0.0
    sea_level: float | None = 0.0
    mantle_density: float = 3300.0
    water_density: float = 1030.0
    youngs_modulus: float = 7e10
    poisson: float = 0.25

    def __post_init__(self) -> None:
        for name in ("elastic_thickness", "mantle_density", "water_density", "youngs_modulus", "poisson"):
            object.__setattr__(self, name, validation.finite_number(name, getattr(self, name)))
        if self.sea_level is not None:
            object.__setattr__(self, "sea_level", validation.finite_number("sea_level", self.sea_level))
        if self.elastic_thickness < 0 or self.youngs_modulus <= 0:
            raise SettingError("elastic_thickness must be 0 m or more, and youngs_modulus above 0 Pa")
        if not 0 <= self.poisson <= 0.5:
            raise SettingError(f"poisson must be from 0 to 0.5, but is {self.poisson:g}")
        if not 0 <= self.water_density < self.mantle_density:
            raise SettingError(
                f"mantle_density must be above water_density, but they are {self.mantle_density:g} and "
                f"{self.water_density:g} kg/m³"
            )

    @property
    def rigidity(self) -> float:
        """Flexural rigidity D, in N m."""
        return self.youngs_modulus * self.elastic_thickness**3 / (12 * (1 - self.poisson**2))

    @property
    def restoring(self) -> float:
        """Weight per metre of sinking that holds the plate up, in Pa/m."""
        return (self.mantle_density - (0.0 if self.sea_level is None else self.water_density)) * GRAVITY

    @property
    def flexural_length(self) -> float:
        """Distance over which the plate spreads a load, ``(4 D / restoring)^(1/4)``, in metres."""
        return (4 * self.rigidity / self.restoring) ** 0.25

    def deflection(self, load: np.ndarray, step: float, beyond: str = MIRROR) -> np.ndarray:
        """Depth by which the plate sinks under a load, in metres; shape (n,).

        Parameters
        ----------
        load : array, shape (n,)
            In Pa, at the middles of cells along the section.
        step : float
            Width of a cell, in metres.
        beyond : {"mirror", "constant", "zero"}
            The load beyond the section: its mirror image, that of the outermost cells, or none.
        """
        if beyond not in BEYONDS:
            raise SettingError(f"beyond must be {', '.join(map(repr, BEYONDS))}, but is {beyond!r}")
        pad = 0 if beyond == MIRROR else int(np.ceil(FAR * self.flexural_length / step))
        padded = np.pad(load, pad, mode="edge" if beyond == CONSTANT else "constant")
        wave_number = np.pi * np.arange(len(padded)) / (len(padded) * step)
        spectrum = dct(padded, type=2) / (self.restoring + self.rigidity * wave_number**4)
        return np.asarray(idct(spectrum, type=2)[pad : len(padded) - pad])
