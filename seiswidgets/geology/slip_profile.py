"""Slip along a fault: a function of position along it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation

CARRIED = 20  # positions of a carried profile: even a constant slip varies where the fault was stretched


@dataclass(frozen=True)
class SlipProfile:
    """Slip along a fault as a function of position, in metres of rock.

    The hanging-wall point at arc length ``s + slip / 2`` and the footwall point at ``s - slip / 2`` were together
    before the fault slipped. Between two positions the slip is linear, and beyond the first and the last it is
    constant.

    Parameters
    ----------
    s : tuple of float
        Positions: arc lengths along the fault from its upper end, in increasing order.
    slip : tuple of float
        One for each; positive where the hanging wall slid down (a normal fault).

    Raises
    ------
    SettingError
        If they are not finite numbers, as many of the one as of the other, at increasing positions.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> sw.SlipProfile([0, 1000], [100, 180]).at(250).tolist()
    120.0
    """

    s: tuple[float, ...]
    slip: tuple[float, ...]

    def __post_init__(self) -> None:
        for name in ("s", "slip"):
            values = np.atleast_1d(np.asarray(getattr(self, name), object))
            if values.ndim != 1 or not values.size:
                raise SettingError(f"{name} of a slip profile must be a list of numbers, but has shape {values.shape}")
            object.__setattr__(self, name, tuple(validation.finite_number(name, value) for value in values))
        if len(self.s) != len(self.slip):
            raise SettingError(f"a slip profile has {len(self.s)} positions s, but {len(self.slip)} values of slip")
        if any(np.diff(self.s) <= 0):
            raise SettingError("the positions s of a slip profile must increase along the fault, from its upper end")

    def at(self, s: ArrayLike) -> np.ndarray:
        """Slip at some positions, in metres."""
        return np.interp(np.asarray(s, float), self.s, self.slip)

    def carried(self, before: np.ndarray, after: np.ndarray) -> "SlipProfile":
        """The profile after the fault was deformed, as by other velocities: the same points stay together.

        Parameters
        ----------
        before, after : array, shape (n, 2)
            Points along the fault from its upper end, in metres of rock; close enough together to follow its curve.
        """
        old, new = (np.append(0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))) for line in (before, after))
        first, last = (np.diff(new)[end] / np.diff(old)[end] for end in (0, -1))

        def moved(s: np.ndarray) -> np.ndarray:
            """Arc lengths on the deformed fault, straight on beyond its ends."""
            return np.interp(s, old, new) + first * np.minimum(s, 0) + last * np.maximum(s - old[-1], 0)

        s = np.union1d(self.s, old[:: max(1, len(old) // CARRIED)])
        hanging_wall, footwall = moved(s + self.at(s) / 2), moved(s - self.at(s) / 2)
        return SlipProfile(tuple((hanging_wall + footwall) / 2), tuple(hanging_wall - footwall))


def checked_slip(slip: Mapping[str, SlipProfile] | None, faults: Sequence[str]) -> dict[str, SlipProfile]:
    """Validate slip profiles by the names of faults."""
    profiles = dict(slip or {})
    for name, profile in profiles.items():
        if not isinstance(profile, SlipProfile):
            raise SettingError(f"the slip of fault {name!r} must be a seiswidgets.SlipProfile, but is {profile!r}")
        if name not in faults:
            known = ", ".join(map(repr, faults)) or "none"
            raise SettingError(f"slip names fault {name!r}, which is not unfaulted here; there are {known}")
    return profiles
