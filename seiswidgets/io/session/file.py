"""JSON form of a session, and migration from older versions. `docs/formats.md` describes it."""

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import asdict, fields, replace
from pathlib import Path
from reprlib import repr as brief
from typing import TYPE_CHECKING, Any, ParamSpec, TypedDict, TypeVar

from seiswidgets import __version__
from seiswidgets.errors import DataError, SeiswidgetsError, Text
from seiswidgets.geology.beyond import FREE
from seiswidgets.geology.bodies import SALT
from seiswidgets.geology.flexure import Isostasy
from seiswidgets.geology.hypothesis import FIRST_NAME
from seiswidgets.geology.lithology import Lithology
from seiswidgets.geology.picks import AUTO_ENDS, CONSTRAIN, Ends
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.steps import Step
from seiswidgets.geology.stratigraphy import Layer, Stratigraphy
from seiswidgets.geology.vertical_shear import LENGTH
from seiswidgets.geology.weights import Weights
from seiswidgets.io.document import Entry, Points, json_text, read_json, shortened
from seiswidgets.io.session.saved_picks import SavedHypothesis, SavedPick
from seiswidgets.io.session.sources import FILE, SectionSource, relative_path, section_path
from seiswidgets.io.session.velocities import read_velocity, velocity_as_json

if TYPE_CHECKING:
    from seiswidgets.io.session.session import Session

FORMAT, VERSION = "seiswidgets session", 2
NOT_IN_PLAN = ("fixed", "pins", "regional")  # saved with the picks: points of the section
DEEPEST = 4  # lists within lists in the choices of a source

Arguments = ParamSpec("Arguments")
Value = TypeVar("Value")


class HypothesisFields(TypedDict):
    """Fields that a `Session` and a `SavedHypothesis` have in common."""

    faults: tuple[SavedPick, ...]
    horizons: tuple[SavedPick, ...]
    bodies: tuple[SavedPick, ...]
    plan: Plan


class SessionFields(HypothesisFields):
    """Fields of a `Session`."""

    source: SectionSource
    sha256: str | None
    name: str
    before: tuple[SavedHypothesis, ...]
    after: tuple[SavedHypothesis, ...]
    written_by: str


def _from_version_0(old: dict[str, Any]) -> dict[str, Any]:
    """Migrate version 0, of the first trials: flat, with a real section by its name, without its hash."""
    steps = old.get("steps", ["unfault", "flatten"])
    return {
        "format": FORMAT,
        "version": 1,
        "section": {"source": {"kind": "dataset", "name": old.get("dataset")}},
        "picks": {key: old[key] for key in ("faults", "horizons", "fixed") if key in old},
        "plan": {
            "steps": [{"kind": kind} for kind in steps] if isinstance(steps, list) else steps,
            "weights": old.get("weights"),
        },
    }


def _from_version_1(old: dict[str, Any]) -> dict[str, Any]:
    """Migrate version 1, which lacks only members that may be missing."""
    return {**old, "version": 2}


MIGRATIONS = {0: _from_version_0, 1: _from_version_1}  # from each old version to the next


def session_as_json(session: "Session", path: Path) -> str:
    """The content of a session's file at a path."""
    return json_text(session_document(session, path))


def session_document(session: "Session", path: Path) -> dict[str, Any]:
    """A session as plain values, with paths relative to the folder of a session's file at ``path``."""
    source = session.source
    origin: dict[str, Any] = (
        {"path": relative_path(_folder(path), source.name), "choices": dict(source.choices)}
        if source.kind == FILE
        else {"name": source.name, "arguments": dict(source.choices)}
    )
    if source.velocity is not None:
        origin |= {"velocity": velocity_as_json(source.velocity), "dz": source.dz}
    document = {
        "format": FORMAT,
        "version": VERSION,
        "written_by": f"seiswidgets {__version__}",
        "section": {"source": {"kind": source.kind, **origin}, "sha256": session.sha256},
        **_hypothesis_document(session),
    }
    if session.before or session.after or session.name != FIRST_NAME:
        before, after = (
            [{"name": one.name, **_hypothesis_document(one)} for one in others]
            for others in (session.before, session.after)
        )
        document["hypotheses"] = [*before, {"name": session.name}, *after]
    return document


def _hypothesis_document(hypothesis: "Session | SavedHypothesis") -> dict[str, Any]:
    """Picks and plan as plain values."""
    plan = hypothesis.plan
    return {
        "picks": {
            "faults": [{"name": pick.name, "points": pick.pieces[0], **_style(pick)} for pick in hypothesis.faults],
            "horizons": [{"name": pick.name, "pieces": pick.pieces, **_style(pick)} for pick in hypothesis.horizons],
            "bodies": [
                {"name": pick.name, "kind": pick.body, "points": pick.pieces[0], **_style(pick)}
                for pick in hypothesis.bodies
            ],
            "fixed": plan.fixed,
            "pins": plan.pins,
            "regional": plan.regional,
        },
        "plan": {name: value for name, value in asdict(plan).items() if name not in NOT_IN_PLAN},
    }


def _folder(path: Path) -> Path:
    """The folder of a session's file; links are followed."""
    return Path(os.path.realpath(path)).parent


def _style(pick: SavedPick) -> dict[str, object]:
    style: dict[str, object] = {"colour": pick.colour, "visible": pick.visible, "use": pick.use}
    return style if pick.ends == AUTO_ENDS else {**style, "ends": pick.ends}


def read_session_fields(path: Path, allow_outside: bool) -> SessionFields:
    """Read the fields of the session in a file.

    Raises
    ------
    DataError
        If it is not a session, is damaged, comes from a newer version, or its section lies outside its folder.
    """
    return session_fields(read_json(path), allow_outside)


def session_fields(entry: Entry, allow_outside: bool) -> SessionFields:
    """The fields of the session in a parsed document; errors as for `read_session_fields`."""
    document = _migrated(entry)
    section, own = document["section"], _hypothesis(document)
    name, before, after = document.optional("hypotheses", _hypotheses, (FIRST_NAME, (), ()))
    return {
        "source": _source(section["source"], allow_outside),
        "sha256": section.optional("sha256", _sha256, None),
        **own,
        "name": name,
        "before": before,
        "after": after,
        "written_by": document.optional("written_by", Entry.text, ""),
    }


def _hypothesis(entry: Entry) -> HypothesisFields:
    picks = entry["picks"]
    return {
        "faults": picks.optional("faults", _faults, ()),
        "horizons": picks.optional("horizons", _horizons, ()),
        "bodies": picks.optional("bodies", _faults, ()),
        "plan": _with_holds(entry.optional("plan", _plan, Plan()), picks),
    }


def _hypotheses(entry: Entry) -> tuple[str, tuple[SavedHypothesis, ...], tuple[SavedHypothesis, ...]]:
    """Name of the session's own hypothesis, which is the one without picks, and those before and after it."""
    entries = list(entry.items())
    own = [index for index, one in enumerate(entries) if one.members().get("picks") is None]
    if len(own) != 1:
        raise entry.error("a list of hypotheses, of which one has no picks: the session's own")
    names = [one["name"].text() for one in entries]
    if len(set(names)) < len(names):
        raise entry.error("a list of hypotheses, each with a name of its own")
    others = [
        _build(one, SavedHypothesis, name, **_hypothesis(one))
        for index, (name, one) in enumerate(zip(names, entries, strict=True))
        if index != own[0]
    ]
    return names[own[0]], tuple(others[: own[0]]), tuple(others[own[0] :])


def _migrated(document: Entry) -> Entry:
    """The document in the present version."""
    if document.members().get("format") != FORMAT:
        raise DataError(f'{document.path} is not a session of seiswidgets: it lacks "format": "{FORMAT}"')
    version = document["version"].value
    if type(version) is not int or version < 0:
        raise document["version"].error("a whole number")
    if version > VERSION:
        raise DataError(
            f"{document.path} is a session in version {min(version, 10**9)}, and seiswidgets {__version__} reads up to "
            f"{VERSION}; update seiswidgets to open it"
        )
    value = document.value
    for older in range(version, VERSION):
        value = MIGRATIONS[older](value)
    return Entry(value, document.path)


def _build(
    entry: Entry, make: Callable[Arguments, Value], *arguments: Arguments.args, **keywords: Arguments.kwargs
) -> Value:
    """Call a constructor; its errors are given the file's name and the location."""
    try:
        return make(*arguments, **keywords)
    except SeiswidgetsError as error:
        message = shortened(error.text)
        text = error.text if message == error.text else Text(message)
        raise DataError(f"{entry.full_location}: ", text, kind=error.kind, pick=error.pick) from error


def _source(entry: Entry, allow_outside: bool) -> SectionSource:
    kind = entry["kind"].text()
    if kind == FILE:
        path = entry["path"]
        name = str(_build(path, section_path, _folder(path.path), path.text(), allow_outside))
    else:
        name = entry["name"].text()
    choices = entry.optional("choices" if kind == FILE else "arguments", _choices, {})
    velocity = entry.optional("velocity", lambda model: _build(model, read_velocity, model), None)
    return _build(entry, SectionSource, kind, name, choices, velocity, entry.optional("dz", Entry.number, None))


def _choices(entry: Entry) -> dict[str, object]:
    return {name: _choice(entry[name], 1) for name in entry.members()}


def _choice(entry: Entry, depth: int) -> object:
    if depth > DEEPEST:
        raise entry.error(f"nested no more than {DEEPEST} deep")
    if isinstance(entry.value, list):
        return [_choice(item, depth + 1) for item in entry.items()]
    if isinstance(entry.value, dict):
        return {name: _choice(entry[name], depth + 1) for name in entry.value}
    if entry.value is None or isinstance(entry.value, bool):
        return entry.value
    if isinstance(entry.value, str):
        return entry.text()
    entry.number()
    return entry.value  # a whole number stays one


def _sha256(entry: Entry) -> str:
    if not re.fullmatch("[0-9a-f]{64}", entry.text()):
        raise entry.error("a SHA-256 of 64 digits from 0 to f")
    return entry.text()


def _faults(entry: Entry) -> tuple[SavedPick, ...]:
    return _picks(entry, lambda pick: (pick["points"].points(),))


def _horizons(entry: Entry) -> tuple[SavedPick, ...]:
    return _picks(entry, lambda pick: tuple(piece.points() for piece in pick["pieces"].items()))


def _picks(entry: Entry, read_pieces: Callable[[Entry], tuple[Points, ...]]) -> tuple[SavedPick, ...]:
    picks: dict[str, SavedPick] = {}
    for item in entry.items():
        name = item["name"].text()
        if name in picks:
            raise item["name"].error("a name that no other pick has")
        colour, visible = item.optional("colour", Entry.text, None), item.optional("visible", Entry.flag, True)
        use = item.optional("use", Entry.text, CONSTRAIN)
        ends = item.optional("ends", _ends, AUTO_ENDS)
        body = item.optional("kind", Entry.text, SALT)
        picks[name] = _build(item, SavedPick, name, read_pieces(item), colour, visible, use, ends, body)
    return tuple(picks.values())


def _ends(entry: Entry) -> Ends:
    ends = [end.text() for end in entry.items()]
    if len(ends) != 2:
        raise entry.error("a list of two texts")
    return ends[0], ends[1]


def _plan(entry: Entry) -> Plan:
    defaults = Plan()
    return _build(
        entry,
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
    return _build(entry, Stratigraphy, [_layer(layer) for layer in entry["layers"].items()])


def _layer(entry: Entry) -> Layer:
    rock = entry["lithology"]
    phi0, c, density = (rock[name].number() for name in ("phi0", "c", "grain_density"))
    name, source = (rock.optional(text, Entry.text, "") for text in ("name", "source"))
    lithology = _build(rock, Lithology, phi0, c, density, name, source)
    top, depth = entry.optional("top", Entry.text, None), entry.optional("water_depth", _level, 0.0)
    return _build(entry, Layer, top, entry["age"].number(), lithology, depth)


def _isostasy(entry: Entry) -> Isostasy:
    numbers = {name: entry[name].number() for name in entry.members() if name != "sea_level"}
    known = {field.name for field in fields(Isostasy)}
    if not numbers.keys() <= known:
        raise DataError(f"{entry.full_location} may hold only {', '.join(sorted(known))}")
    return _build(entry, Isostasy, sea_level=entry.optional("sea_level", Entry.number, None), **numbers)


def _with_holds(plan: Plan, picks: Entry) -> Plan:
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
        _build(
            step,
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
    return {name: _build(entry[name], SlipProfile, *_numbers(entry[name], "s", "slip")) for name in entry.members()}


def _numbers(entry: Entry, *names: str) -> Iterator[tuple[float, ...]]:
    return (tuple(item.number() for item in entry[name].items()) for name in names)


def _weights(entry: Entry) -> Weights:
    known = [field.name for field in fields(Weights)]
    for name in entry.members():
        if name not in known:
            raise DataError(
                f"{entry.full_location} has {brief(name)}, which is not a weight; the weights are {', '.join(known)}"
            )
    return _build(entry, Weights, **{name: entry[name].number() for name in entry.members()})
