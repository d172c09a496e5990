"""Picks that cannot constrain a restoration: they are carried along with the rock, each with a finding."""

from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

from seiswidgets.errors import PickError, Text
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import CONSTRAIN, Fault, Horizon, Pick

SEVERITIES = {"one-sided": "note", "contradiction": "problem"}  # by the kind of the error; others are warnings
Faults = dict[str, Fault]
Horizons = dict[str, Horizon]
Made = TypeVar("Made")


def constraining(picks: Mapping[str, Pick]) -> dict[str, Pick]:
    """The picks that constrain, by their use and their flaws."""
    return {name: pick for name, pick in picks.items() if pick.constrains}


def flaws(picks: Iterable[Fault | Horizon]) -> list[PickError]:
    """The flaws of picks that should constrain."""
    return [pick.flaw for pick in picks if pick.use == CONSTRAIN and pick.flaw]


def carried_finding(error: PickError) -> Finding:
    """The finding about a pick, or a part of it, that is carried along because of an error."""
    text = Text(error.text, " (until then it is only carried along)")
    return Finding(SEVERITIES.get(error.kind, "warning"), error.kind or "carried", text, error.pick, error.where)


def carry_refused(
    make: Callable[[Faults, Horizons], Made], faults: Faults, horizons: Horizons
) -> tuple[Made, list[PickError]]:
    """Call a function with the picks that it does not refuse.

    Parameters
    ----------
    make : callable(faults, horizons)
        Raises a PickError that names a pick to refuse it.
    faults, horizons : dicts by name

    Returns
    -------
    made : object
        The result of the function.
    refusals : list of PickError
        One for each pick that was left out.

    Raises
    ------
    PickError
        The first refusal, if no fault is left; or one that names none of the picks.
    """
    faults, horizons = dict(faults), dict(horizons)
    refusals: list[PickError] = []
    while True:
        try:
            return make(faults, horizons), refusals
        except PickError as error:
            refusals.append(error)
            name = error.pick or ""
            if faults.pop(name, None) is None and horizons.pop(name, None) is None:
                raise
            if not faults:
                raise refusals[0] from None
