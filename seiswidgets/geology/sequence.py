"""From a stratigraphy to the steps of a sequential restoration, and to which faults moved when."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.cutoffs import cutoffs
from seiswidgets.geology.picks import MISSING, Fault, Interpretation
from seiswidgets.geology.stage import DECOMPACT, ISOSTASY, STRIP
from seiswidgets.geology.steps import FLATTEN, UNFAULT, Step
from seiswidgets.geology.stratigraphy import Layer, Profile, Stratigraphy

GROWN = 0.02  # of a fault's largest throw: a smaller increment is an error of the picks


@dataclass(frozen=True)
class FaultMovement:
    """Movement of a fault after a top was laid down, and before the next younger one was.

    Attributes
    ----------
    fault, top : str
        Names of the fault, and of the horizon at the top.
    age : float
        Of the top, in Ma.
    throw : float or None
        Present-day throw of the top, in the section's unit of z; None if the fault does not cut it.
    growth : float
        The part of it that the next younger top lacks.
    moved : bool
        True if the step at that time undoes slip on the fault.
    """

    fault: str
    top: str
    age: float
    throw: float | None
    growth: float
    moved: bool


@dataclass(frozen=True)
class FaultActivity:
    """The movements of faults through time, young to old; prints as a table.

    Attributes
    ----------
    movements : tuple of FaultMovement
    """

    movements: tuple[FaultMovement, ...]

    @classmethod
    def of(cls, stratigraphy: Stratigraphy, interpretation: Interpretation) -> "FaultActivity":
        """Derive which faults moved when from the horizons that they offset.

        A fault moved after a top where it offsets that top more than the next younger one, by more than 2% of its
        largest throw; a top that it does not offset is younger than its activity.
        """
        used = [fault for fault in interpretation.faults if fault.constrains]
        return cls(tuple(move for fault in used for move in _movements(fault, stratigraphy, interpretation)))

    def moved(self, top: str) -> tuple[str, ...]:
        """Names of the faults whose slip is undone when that top is the surface."""
        return tuple(move.fault for move in self.movements if move.top == top and move.moved)

    def rows(self) -> list[tuple[str, str, str, str, str]]:
        """Fault, top with its age, throw, growth, and "moved" or "", as texts."""
        return [
            (
                move.fault,
                f"{move.top} ({move.age:g} Ma)",
                "-" if move.throw is None else f"{move.throw:.4g}",
                f"{move.growth:+.4g}",
                "moved" if move.moved else "",
            )
            for move in self.movements
        ]

    def __str__(self) -> str:
        rows = [("fault", "top", "throw", "growth", ""), *self.rows()]
        widths = [max(len(row[column]) for row in rows) for column in range(5)]
        return "\n".join("  ".join(map(str.ljust, row, widths)).rstrip() for row in rows)

    def _repr_html_(self) -> str:
        rows = [("fault", "top", "throw", "growth", ""), *self.rows()]
        cells = ("".join(f"<td>{escape(text)}</td>" for text in row) for row in rows)
        return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


def _movements(fault: Fault, stratigraphy: Stratigraphy, interpretation: Interpretation) -> list[FaultMovement]:
    tops = [(layer, layer.top) for layer in stratigraphy.layers if layer.top is not None]
    throws = [_throw(fault, top, interpretation) for _, top in tops]
    known = [throw for throw in throws if throw is not None]
    largest, sense = max(map(abs, known), default=0.0), -1 if sum(known) < 0 else 1
    found, younger = [], 0.0
    for (layer, top), throw in zip(tops, throws, strict=True):
        growth = 0.0 if throw is None else sense * throw - younger
        found.append(FaultMovement(fault.name, top, layer.age, throw, growth, abs(growth) > GROWN * largest))
        younger = younger if throw is None else sense * throw
    return found


def _throw(fault: Fault, top: str, interpretation: Interpretation) -> float | None:
    """The largest throw of a horizon at a fault; None if the fault does not cut it."""
    try:
        return max((cutoff.throw for cutoff in cutoffs(fault, interpretation.horizon(top))), key=abs)
    except PickError as error:
        if error.pick == top and error.kind == MISSING:
            raise
        return None


def sequential_steps(
    stratigraphy: Stratigraphy,
    activity: Mapping[str, Sequence[str]],
    *,
    decompact: bool,
    isostasy: bool,
    unfold: str,
    sea_level: float,
) -> tuple[Step, ...]:
    """The steps of a sequential restoration, young to old.

    Parameters
    ----------
    stratigraphy : Stratigraphy
    activity : dict of str to list of str
        For each top, the faults whose slip is undone when it is the surface.
    decompact, isostasy : bool
        Whether these steps are taken.
    unfold : str
        See `Step.by`.
    sea_level : float
        In the section's unit of z.
    """
    if not stratigraphy.tops:
        raise SettingError("a sequence needs a layer with a horizon at its top, down to which it can strip")
    steps: list[Step] = []
    for index, layer in enumerate(stratigraphy.layers):
        if layer.top is None:
            continue
        age = layer.age
        steps.append(Step(STRIP, (layer.top,), age=age))
        if index:  # the first top is the present-day sea floor: nothing has been taken away but water
            if moved := activity.get(layer.top):  # before the rock expands, which would bend the faults
                steps.append(Step(UNFAULT, tuple(moved), horizons=(layer.top,), age=age))
            steps += [Step(DECOMPACT, age=age)] if decompact else []
            steps += [Step(ISOSTASY, age=age)] if isostasy else []
            datum = _below_sea(layer, sea_level)
            steps.append(Step(FLATTEN, (layer.top,), datum, by=unfold, age=age))
    return tuple(steps)


def _below_sea(layer: Layer, sea_level: float) -> float | Profile:
    depth = layer.water_depth
    return tuple((x, sea_level + z) for x, z in depth) if isinstance(depth, tuple) else sea_level + depth
