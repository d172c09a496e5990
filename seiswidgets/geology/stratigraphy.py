"""The layers of a section, young to old: their tops, ages, lithologies and the depths of water they were laid in."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.lithology import Lithology, named_lithology

Profile = tuple[tuple[float, float], ...]  # points (x, depth), joined by straight lines and level beyond their ends


@dataclass(frozen=True)
class Layer:
    """Rock between a top and the top of the next older layer.

    Parameters
    ----------
    top : str or None
        Name of the horizon at its top; None for the top of the section, in the youngest layer only.
    age : float
        Age of its top, in Ma.
    lithology : Lithology or str
        Or the name of one of `LITHOLOGIES`.
    water_depth : float or list of (x, depth)
        Depth of the water when its top was the sea floor, below the sea level, in the section's unit of z: a number, or
        a profile along the section (its palaeobathymetry).

    Raises
    ------
    SettingError
        If a value is out of its range.
    """

    top: str | None
    age: float
    lithology: Lithology | str = "shaly sand"
    water_depth: float | Profile = 0.0

    def __post_init__(self) -> None:
        if self.top is not None and not isinstance(self.top, str):
            raise SettingError(f"the top of a layer must be the name of a horizon, or None, but is {self.top!r}")
        object.__setattr__(self, "age", validation.finite_number("age", self.age))
        if self.age < 0:
            raise SettingError(f"the age of a top must be 0 Ma or more, but is {self.age:g}; older is more")
        object.__setattr__(self, "lithology", named_lithology(self.lithology))
        object.__setattr__(self, "water_depth", checked_profile("water_depth", self.water_depth))

    @property
    def rock(self) -> Lithology:
        """Its lithology, never a name."""
        return named_lithology(self.lithology)

    @property
    def name(self) -> str:
        """The name of its top."""
        return self.top or "top of the section"


@dataclass(frozen=True)
class Stratigraphy:
    """The layers of a section, from young to old.

    A layer is the rock between its top and the top of the next older one, where it exists: horizons may end at
    unconformities, onlap, or pinch out. The oldest layer reaches down to the bottom of the section.

    Parameters
    ----------
    layers : sequence of Layer

    Raises
    ------
    SettingError
        If there are none, a layer other than the first has no top, two have the same one, or their ages do not rise.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> layers = sw.Stratigraphy([sw.Layer(None, 0.0, "sand"), sw.Layer("H1", 12.0, "shale", water_depth=80.0)])
    >>> layers.layer("H1").lithology.phi0
    0.63
    """

    layers: Sequence[Layer]

    def __post_init__(self) -> None:
        object.__setattr__(self, "layers", tuple(self.layers))
        wrong = [layer for layer in self.layers if not isinstance(layer, Layer)]
        if wrong or not self.layers:
            raise SettingError(f"a stratigraphy must hold one seiswidgets.Layer or more, but holds {wrong or 'none'}")
        for index, layer in enumerate(self.layers[1:], 2):
            if layer.top is None:
                raise SettingError(f"layer {index} has no top; only the first may reach up to the top of the section")
        for above, below in pairwise(self.layers):
            if below.age <= above.age:
                raise SettingError(
                    f"ages must rise from young to old, but {below.name!r} ({below.age:g} Ma) follows {above.name!r} "
                    f"({above.age:g} Ma); correct an age, or the order of the layers",
                    kind="ages",
                    pick=below.top,
                )
        repeated = [top for top in self.tops if self.tops.count(top) > 1]
        if repeated:
            raise SettingError(f"two layers have the same top, {repeated[0]!r}; give each its own", pick=repeated[0])

    @property
    def tops(self) -> list[str]:
        """Names of the horizons at the tops, young to old."""
        return [layer.top for layer in self.layers if layer.top is not None]

    def layer(self, top: str | None) -> Layer:
        """The layer with that top; PickError if there is none."""
        for layer in self.layers:
            if layer.top == top:
                return layer
        raise PickError(
            f"no layer has the top {top!r}; there are {', '.join(repr(layer.name) for layer in self.layers)}", pick=top
        )


def checked_profile(name: str, value: object) -> float | Profile:
    """Validate a number, or points (x, depth) in the order of their x."""
    if isinstance(value, int | float | np.number | str):
        return validation.finite_number(name, value)
    try:
        points = np.array(value, float).reshape(-1, 2)
    except (TypeError, ValueError):
        points = np.full((1, 2), np.nan)
    if not len(points) or not np.isfinite(points).all():
        raise SettingError(f"{name} must be a finite number, or points (x, depth) of finite numbers, but is {value!r}")
    if (np.diff(points[:, 0]) <= 0).any():
        raise SettingError(f"the points of {name} must be in the order of their x, each with an x of its own")
    return tuple((float(x), float(depth)) for x, depth in points)


def profile_at(profile: float | Profile, x: np.ndarray) -> np.ndarray:
    """A number, or a profile's depth, at each x; level beyond its ends."""
    if isinstance(profile, tuple):
        return np.asarray(np.interp(x, *np.transpose(profile)))
    return np.full(np.shape(x), float(profile))
