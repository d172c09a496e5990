"""The scenes of a restoration: the states between its steps, as a storyboard shows them."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from seiswidgets.geology.stage import Stage

ACTIONS = {
    "unfault": "unfaulting",
    "flatten": "flattening",
    "strip": "stripping",
    "unerode": "uneroding",
    "decompact": "decompaction",
    "isostasy": "isostasy",
}
WHOLE = ("decompact", "isostasy")


@dataclass(frozen=True)
class Scene:
    """The section after some stages.

    Attributes
    ----------
    count : int
        Number of stages carried out; 0 is the present day.
    title : str
        The present day, or what has been done since the scene before.
    age : float or None
        In Ma.
    """

    count: int
    title: str
    age: float | None = None

    @property
    def label(self) -> str:
        """The title, after the age if there is one."""
        return self.title if self.age is None else f"{self.age:g} Ma · {self.title}"


def scenes(stages: Sequence[Stage]) -> tuple[Scene, ...]:
    """The present day, and the section after each stage; stages of the same age make one scene."""
    has_ages = any(stage.age is not None for stage in stages)
    shown = [Scene(0, "present day", 0.0 if has_ages else None)]
    numbered = enumerate(stages, 1)
    for _, group in groupby(numbered, key=lambda each: each[0] if each[1].age is None else (each[1].age,)):
        members = list(group)
        count, last = members[-1]
        shown.append(Scene(count, ", ".join(action(stage) for _, stage in members), last.age))
    return tuple(shown)


def action(stage: Stage) -> str:
    """Name a stage's action, and its picks unless it acts on all rock: "unfaulting F1 and F2"."""
    picks = () if stage.kind in WHOLE else stage.outcome.picks
    return " ".join([ACTIONS.get(stage.kind, stage.kind), " and ".join(picks)]).strip()
