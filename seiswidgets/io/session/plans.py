"""Plans in a session's file."""

from collections.abc import Iterator
from dataclasses import fields, replace
from reprlib import repr as brief

from seiswidgets.errors import DataError
from seiswidgets.geology.beyond import FREE
from seiswidgets.geology.flexure import Isostasy
from seiswidgets.geology.lithology import Lithology
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.steps import Step
from seiswidgets.geology.stratigraphy import Layer, Stratigraphy
from seiswidgets.geology.vertical_shear import LENGTH
from seiswidgets.geology.weights import Weights
from seiswidgets.io.document import Entry, Points


def read_plan(entry: Entry) -> Plan:
    """The plan of an entry, without its points, which are saved with the picks; see `with_holds`."""
    defaults = Plan()
    return entry.build(
        Plan,
        steps=entry.optional("steps", _steps, defaults.steps),
        weights=entry.optional("weights", _weights, defaults.weights),
        solver=entry.optional("solver", Entry.text, defaults.solver),
        weighting=entry.optional("weighting", Entry.text, None),
        spacing=entry.optional("spacing", Entry.number, None),
        max_iterations=entry.optional("max_iterations", _count, None),
        stratigraphy=entry.optional("stratigraphy", _stratigraphy, None),
        isostasy=entry.optional("isostasy", _isostasy, None),
        load_beyond=entry.optional("load_beyond", Entry.text, defaults.load_beyond),
    )


def _stratigraphy(entry: Entry) -> Stratigraphy:
    return entry.build(Stratigraphy, [_layer(layer) for layer in entry["layers"].items()])


def _layer(entry: Entry) -> Layer:
    rock = entry["lithology"]
    phi0, c, density = (rock[name].number() for name in ("phi0", "c", "grain_density"))
    name, source = (rock.optional(text, Entry.text, "") for text in ("name", "source"))
    lithology = rock.build(Lithology, phi0, c, density, name, source)
    top, depth = entry.optional("top", Entry.text, None), entry.optional("water_depth", _level, 0.0)
    return entry.build(Layer, top, entry["age"].number(), lithology, depth)


def _isostasy(entry: Entry) -> Isostasy:
    numbers = {name: entry[name].number() for name in entry.members() if name != "sea_level"}
    known = {field.name for field in fields(Isostasy)}
    if not numbers.keys() <= known:
        raise DataError(f"{entry.full_location} may hold only {', '.join(sorted(known))}")
    return entry.build(Isostasy, sea_level=entry.optional("sea_level", Entry.number, None), **numbers)


def with_holds(plan: Plan, picks: Entry) -> Plan:
    """The plan with its held point, pins and regional level, from the entry of the picks."""
    return replace(
        plan,
        fixed=picks.optional("fixed", Entry.point, None),
        pins=picks.optional("pins", Entry.points, ()),
        regional=picks.optional("regional", _level, None),
    )


def _level(entry: Entry) -> float | Points:
    return entry.points() if isinstance(entry.value, list) else entry.number()


def _count(entry: Entry) -> int:
    if type(entry.value) is not int or entry.value < 1:
        raise entry.error("a whole number of 1 or more")
    return entry.value


def _steps(entry: Entry) -> tuple[Step, ...]:
    return tuple(
        step.build(
            Step,
            step["kind"].text(),
            step.optional("picks", lambda picks: tuple(name.text() for name in picks.items()), ()),
            step.optional("datum", _level, None),
            step.optional("on", Entry.flag, True),
            step.optional("slip", _slip, {}),
            step.optional("horizons", lambda names: tuple(name.text() for name in names.items()), ()),
            step.optional("by", Entry.text, LENGTH),
            step.optional("age", Entry.number, None),
            step.optional("beyond", Entry.text, FREE),
        )
        for step in entry.items()
    )


def _slip(entry: Entry) -> dict[str, SlipProfile]:
    return {name: entry[name].build(SlipProfile, *_numbers(entry[name], "s", "slip")) for name in entry.members()}


def _numbers(entry: Entry, *names: str) -> Iterator[tuple[float, ...]]:
    return (tuple(item.number() for item in entry[name].items()) for name in names)


def _weights(entry: Entry) -> Weights:
    known = [field.name for field in fields(Weights)]
    for name in entry.members():
        if name not in known:
            raise DataError(
                f"{entry.full_location} has {brief(name)}, which is not a weight; the weights are {', '.join(known)}"
            )
    return entry.build(Weights, **{name: entry[name].number() for name in entry.members()})
