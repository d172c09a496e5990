"""JSON form of a session, and migration from older versions. `docs/formats.md` describes it."""

import os
import re
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

from seiswidgets import __version__
from seiswidgets.errors import DataError
from seiswidgets.geology.bodies import SALT
from seiswidgets.geology.hypothesis import FIRST_NAME
from seiswidgets.geology.picks import AUTO_ENDS, CONSTRAIN, Ends
from seiswidgets.geology.plan import Plan
from seiswidgets.io.document import Entry, Points, json_text, read_json
from seiswidgets.io.session.plans import read_plan, with_holds
from seiswidgets.io.session.saved_picks import SavedHypothesis, SavedPick
from seiswidgets.io.session.sources import FILE, SectionSource, relative_path, section_path
from seiswidgets.io.session.velocities import read_velocity, velocity_as_json

if TYPE_CHECKING:
    from seiswidgets.io.session.session import Session

FORMAT, VERSION = "seiswidgets session", 2
NOT_IN_PLAN = ("fixed", "pins", "regional")  # saved with the picks: points of the section
DEEPEST = 4  # lists within lists in the choices of a source


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
        "plan": with_holds(entry.optional("plan", read_plan, Plan()), picks),
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
        one.build(SavedHypothesis, name, **_hypothesis(one))
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


def _source(entry: Entry, allow_outside: bool) -> SectionSource:
    kind = entry["kind"].text()
    if kind == FILE:
        path = entry["path"]
        name = str(path.build(section_path, _folder(path.path), path.text(), allow_outside))
    else:
        name = entry["name"].text()
    choices = entry.optional("choices" if kind == FILE else "arguments", _choices, {})
    velocity = entry.optional("velocity", lambda model: model.build(read_velocity, model), None)
    return entry.build(SectionSource, kind, name, choices, velocity, entry.optional("dz", Entry.number, None))


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
        picks[name] = item.build(SavedPick, name, read_pieces(item), colour, visible, use, ends, body)
    return tuple(picks.values())


def _ends(entry: Entry) -> Ends:
    ends = [end.text() for end in entry.items()]
    if len(ends) != 2:
        raise entry.error("a list of two texts")
    return ends[0], ends[1]
