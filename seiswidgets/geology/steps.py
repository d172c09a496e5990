"""The steps of a plan."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.beyond import FREE, check_beyond
from seiswidgets.geology.slip_profile import SlipProfile, checked_slip
from seiswidgets.geology.stage import DECOMPACT, ISOSTASY, STRIP, UNERODE
from seiswidgets.geology.stratigraphy import Profile, checked_profile
from seiswidgets.geology.vertical_shear import FLATTENINGS, LENGTH

UNFAULT, FLATTEN = "unfault", "flatten"
KINDS = (UNFAULT, FLATTEN, STRIP, UNERODE, DECOMPACT, ISOSTASY)
ON_A_HORIZON = (FLATTEN, STRIP)  # which they name
WITH_LAYERS = (DECOMPACT, ISOSTASY)  # which need a stratigraphy


@dataclass(frozen=True)
class Step:
    """One step of a plan.

    Parameters
    ----------
    kind : {"unfault", "flatten", "strip", "unerode", "decompact", "isostasy"}
    picks : tuple of str
        Names of the faults to slide along, or of the one horizon to flatten or to strip down to; a single name may be a
        string. By default all faults, or the first horizon.
    datum : float or list of (x, z), optional
        The level or the palaeobathymetry to flatten to, in the section's units, or the surface of the eroded rock to
        put back; for a horizon, its mean level if left out.
    on : bool
        A step that is off is left out.
    slip : dict of str to SlipProfile
        Slip to undo along some of the faults, by name; see `Restoration.unfault`. Names of faults that the step does
        not slide along have no effect.
    horizons : tuple of str
        For "unfault": names of the horizons to match across the faults; by default all.
    by : {"length", "vertical shear"}
        For "flatten"; see `Restoration.flatten`.
    beyond : {"free", "keep", "level", "trend"}
        What happens to the rock beyond the ends of a flattened horizon; see `Restoration.flatten`.
    age : float, optional
        Time that the section after the step stands for, in Ma.

    Raises
    ------
    SettingError
        If the kind is not one of these, the datum is not finite or, for "unerode", missing, or a slip is not a
        SlipProfile.
    """

    kind: str
    picks: tuple[str, ...] = ()
    datum: float | Profile | None = None
    on: bool = True
    slip: Mapping[str, SlipProfile] = field(default_factory=dict, hash=False)
    horizons: tuple[str, ...] = ()
    by: str = LENGTH
    age: float | None = None
    beyond: str = FREE

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise SettingError(f"a step must be one of {', '.join(map(repr, KINDS))}, but is {self.kind!r}")
        for name in ("picks", "horizons"):
            names: str | tuple[str, ...] = getattr(self, name)
            object.__setattr__(self, name, (names,) if isinstance(names, str) else tuple(names))
        if self.by not in FLATTENINGS:
            raise SettingError(f"by must be {' or '.join(map(repr, FLATTENINGS))}, but is {self.by!r}")
        if self.datum is not None:
            object.__setattr__(self, "datum", checked_profile("datum", self.datum))
        elif self.kind == UNERODE:
            raise SettingError("the step unerode needs a datum: the surface of the rock before it was eroded")
        check_beyond(self.beyond)
        if self.age is not None:
            object.__setattr__(self, "age", validation.finite_number("age", self.age))
        object.__setattr__(self, "slip", checked_slip(self.slip, tuple(self.slip or ())))

    def slides_along(self, fault: str) -> bool:
        """True if the step is on, and undoes the slip of a fault."""
        return self.on and self.kind == UNFAULT and (not self.picks or fault in self.picks)
