"""Picks as a session keeps them: everything that was drawn, with its looks, even what cannot be used yet."""

import re
from dataclasses import dataclass

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.io.picks.lines import Points

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
        if self.colour is not None and not (isinstance(self.colour, str) and COLOUR.fullmatch(self.colour)):
            raise SettingError(
                f"the colour of {self.name!r} must be #rrggbb or the name of one, but is {self.colour!r}"
            )


def saved(pick: Fault | Horizon, looks: dict | None = None) -> SavedPick:
    """A pick of an interpretation, as it is saved; SettingError if it has other looks than a colour and visible."""
    if unknown := set(looks or {}) - {"colour", "visible"}:
        raise SettingError(f"the looks of {pick.name!r} may be colour and visible, but not {', '.join(unknown)}")
    pieces = (pick.points,) if isinstance(pick, Fault) else pick.pieces
    return SavedPick(pick.name, tuple(tuple(map(tuple, piece.tolist())) for piece in pieces), **(looks or {}))
