"""Picks as saved in a session: everything that was drawn, with its style, even what cannot be used yet."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.bodies import SALT, Body, check_kind
from seiswidgets.geology.picks import AUTO_ENDS, CONSTRAIN, Ends, Fault, Horizon, both_ends, check_use
from seiswidgets.io.document import Points

COLOUR = re.compile(r"#[0-9a-fA-F]{3}|#[0-9a-fA-F]{6}|[a-zA-Z]{1,40}")  # nothing else may get into a page


@dataclass(frozen=True)
class SavedPick:
    """A fault or a body with one piece, or a horizon with any number of pieces.

    Attributes
    ----------
    name : str
    pieces : tuple of tuples of points (x, z)
        As drawn; a line may cross itself.
    colour : str, optional
        "#rrggbb", or the name of a colour.
    visible : bool
        Hidden picks are used in the restoration all the same.
    use : {"constrain", "carry", "ignore"}
        See `Fault` and `Horizon`.
    ends : pair of {"auto", "tip", "extend"}
        See `Fault`.
    body : {"salt", "no data"}
        See `Body`.

    Raises
    ------
    PickError
        If the name contains an unpaired surrogate.
    SettingError
        If the colour, the use or the ends are invalid.
    """

    name: str
    pieces: tuple[Points, ...]
    colour: str | None = None
    visible: bool = True
    use: str = CONSTRAIN
    ends: Ends = AUTO_ENDS
    body: str = SALT

    def __post_init__(self) -> None:
        if any("\ud800" <= letter <= "\udfff" for letter in self.name):
            raise PickError(f"the name {self.name!r} contains an unpaired surrogate; rename that pick", pick=self.name)
        if self.colour is not None and not (isinstance(self.colour, str) and COLOUR.fullmatch(self.colour)):
            raise SettingError(
                f"the colour of {self.name!r} must be #rrggbb or the name of a colour, but is {self.colour!r}",
                pick=self.name,
            )
        check_use(self.name, self.use)
        check_kind(self.name, self.body)
        object.__setattr__(self, "ends", both_ends(self.ends))


def saved_pick(pick: Fault | Horizon | Body, style: Mapping[str, Any] | None = None) -> SavedPick:
    """Convert a pick of an interpretation; SettingError if its style has other keys than colour and visible."""
    style = style or {}
    if unknown := set(style) - {"colour", "visible"}:
        raise SettingError(
            f"the looks of {pick.name!r} may be colour and visible, but not {', '.join(map(str, unknown))}",
            pick=pick.name,
        )
    pieces = pick.pieces if isinstance(pick, Horizon) else (pick.points,)
    points = tuple(tuple((x, z) for x, z in piece.tolist()) for piece in pieces)
    if isinstance(pick, Body):
        return SavedPick(pick.name, points, **style, body=pick.kind)
    ends = both_ends(pick.ends) if isinstance(pick, Fault) else AUTO_ENDS
    return SavedPick(pick.name, points, **style, use=pick.use, ends=ends)
