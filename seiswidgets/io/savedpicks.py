"""Picks as a session keeps them: everything that was drawn, with its looks, even what cannot be used yet."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

import shapely

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.io.picks.lines import FAULT, HORIZON, LONG, Points

COLOUR = re.compile(r"#[0-9a-fA-F]{3}|#[0-9a-fA-F]{6}|[a-zA-Z]{1,40}")  # nothing else gets into a page


@dataclass(frozen=True)
class SavedPick:
    """A fault, of one piece, or a horizon, of any number.

    Attributes
    ----------
    name : str
    pieces : tuple of tuples of points (x, z)
        As drawn; a line may cross itself.
    colour : str, optional
        "#rrggbb", or the name of a colour.
    visible : bool
        Hidden picks are restored with all the same.

    Raises
    ------
    PickError
        If the name holds half a character.
    SettingError
        If the colour is neither.
    """

    name: str
    pieces: tuple[Points, ...]
    colour: str | None = None
    visible: bool = True

    def __post_init__(self):
        if any("\ud800" <= letter <= "\udfff" for letter in self.name):
            raise PickError(f"the name {self.name!r} holds half a character; rename it")
        if self.colour is not None and not COLOUR.fullmatch(self.colour):
            raise SettingError(
                f"the colour of {self.name!r} must be #rrggbb or the name of one, but is {self.colour!r}"
            )


def saved(pick: Fault | Horizon, looks: dict | None = None) -> SavedPick:
    """A pick of an interpretation, as it is saved."""
    pieces = (pick.points,) if isinstance(pick, Fault) else pick.pieces
    return SavedPick(pick.name, tuple(tuple(map(tuple, piece.tolist())) for piece in pieces), **(looks or {}))


def usable(faults: Iterable[SavedPick], horizons: Iterable[SavedPick]) -> tuple[Interpretation, list[str]]:
    """What can be restored with, and what is wrong with the rest."""
    made, problems = {FAULT: [], HORIZON: []}, []
    for kind, picks in ((FAULT, faults), (HORIZON, horizons)):
        for pick in picks:
            messages = {number: _problem(kind, pick, number) for number in range(len(pick.pieces))}
            problems += filter(None, messages.values())
            good = [piece for number, piece in enumerate(pick.pieces) if not messages[number]]
            if good:
                made[kind].append((Fault if kind == FAULT else Horizon)(*good, name=pick.name))
    return Interpretation(tuple(made[FAULT]), tuple(made[HORIZON])), problems


def _problem(kind, pick, number):
    """Why a piece cannot be used, or None."""
    points = pick.pieces[number]
    if len(points) > LONG and not shapely.LineString(points).is_simple:
        return f"piece {number + 1} of {kind} {pick.name!r} crosses or touches itself; redraw it"
    before = [[(0, 0), (1, 0)]] * number  # so that the message has the piece's own number
    try:
        Fault(points, pick.name) if kind == FAULT else Horizon(*before, points, name=pick.name)
    except PickError as error:
        return str(error)
    return None
