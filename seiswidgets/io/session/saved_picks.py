"""Picks as saved in a session: everything that was drawn, with its style, even what cannot be used yet."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.bodies import BODY, SALT, Body, check_kind
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.picks import (
    AUTO_ENDS,
    CONSTRAIN,
    FAULT,
    HORIZON,
    Ends,
    Fault,
    Horizon,
    Interpretation,
    Problem,
    both_ends,
    check_use,
    usable,
)
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.section import Section
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


@dataclass(frozen=True)
class SavedHypothesis:
    """A hypothesis of a session: its picks and its plan.

    Raises
    ------
    PickError
        If a fault or a body is not one line, or two picks of a kind have the same name.
    """

    name: str
    faults: tuple[SavedPick, ...] = ()
    horizons: tuple[SavedPick, ...] = ()
    plan: Plan = field(default_factory=Plan)
    bodies: tuple[SavedPick, ...] = ()

    def __post_init__(self) -> None:
        check_picks(self.faults, self.horizons, self.bodies)

    def on(self, section: Section) -> Hypothesis:
        """The hypothesis on its section, without lines that cannot be used."""
        interpretation, _ = usable_picks(self.faults, self.horizons, self.bodies)
        return Hypothesis(section, interpretation, self.plan, self.name)


def check_picks(faults: tuple[SavedPick, ...], horizons: tuple[SavedPick, ...], bodies: tuple[SavedPick, ...]) -> None:
    """Raise PickError if a fault or a body is not one line, or two picks of a kind have the same name."""
    for picks in (faults, horizons, bodies):
        names = [pick.name for pick in picks]
        if len(set(names)) < len(names):
            name = max(names, key=names.count)
            raise PickError(f"two picks are called {name!r}; give each a name of its own", pick=name)
    for kind, picks in ((FAULT, faults), (BODY, bodies)):
        for pick in picks:
            if len(pick.pieces) != 1:
                raise PickError(
                    f"{kind} {pick.name!r} must be one line, but has {len(pick.pieces)}; give each line a name",
                    pick=pick.name,
                )


def usable_picks(
    faults: tuple[SavedPick, ...], horizons: tuple[SavedPick, ...], bodies: tuple[SavedPick, ...]
) -> tuple[Interpretation, tuple[Problem, ...]]:
    """The picks that can be used in a restoration, and the problems of the others; see `usable`."""
    kinds = ((FAULT, faults), (HORIZON, horizons), (BODY, bodies))
    return usable(
        (kind, pick.name, pick.pieces, pick.use, pick.ends, pick.body) for kind, picks in kinds for pick in picks
    )


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
