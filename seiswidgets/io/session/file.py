"""The file of a session: its form, and how older forms become today's. `docs/formats.md` describes it."""

import os
import re
from dataclasses import asdict, fields, replace
from pathlib import Path
from reprlib import repr as brief

from seiswidgets import __version__
from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.plan import Plan, Step
from seiswidgets.geology.weights import Weights
from seiswidgets.io.document import Entry, json_text, read_json, shortened
from seiswidgets.io.session.saved_picks import SavedPick
from seiswidgets.io.session.sources import FILE, SectionSource, relative, resolved

FORMAT, VERSION = "seiswidgets session", 1
ELSEWHERE = (
    "fixed",
    "pins",
    "regional",
)  # of a plan: the held point stands with the picks, the others are not used yet
DEEPEST = 4  # lists within lists in the choices of a source


def _from_version_0(old: dict) -> dict:
    """Version 0, of the first trials: flat, of a real section by its name, without its hash."""
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


MIGRATIONS = {0: _from_version_0}  # from each old version to the next


def text(session, path: Path) -> str:
    """A session as it is written into a file of that path."""
    return json_text(document(session, path))


def document(session, path: Path) -> dict:
    """A session as plain values, with paths relative to the folder of a file of that path."""
    source = session.source
    where = (
        {"path": relative(_folder(path), source.name), "choices": dict(source.choices)}
        if source.kind == FILE
        else {"name": source.name, "arguments": dict(source.choices)}
    )
    return {
        "format": FORMAT,
        "version": VERSION,
        "written_by": f"seiswidgets {__version__}",
        "section": {"source": {"kind": source.kind, **where}, "sha256": session.sha256},
        "picks": {
            "faults": [{"name": pick.name, "points": pick.pieces[0], **_looks(pick)} for pick in session.faults],
            "horizons": [{"name": pick.name, "pieces": pick.pieces, **_looks(pick)} for pick in session.horizons],
            "fixed": session.fixed,
        },
        "plan": {name: value for name, value in asdict(session.plan).items() if name not in ELSEWHERE},
    }


def _folder(path):
    """The folder that a session's file is in, also where the path is a link to it."""
    return Path(os.path.realpath(path)).parent


def _looks(pick):
    return {"colour": pick.colour, "visible": pick.visible}


def read(path: Path, allow_outside: bool) -> dict:
    """The fields of the session in a file.

    Raises
    ------
    DataError
        If it is not a session, is damaged, comes from a newer version, or leads out of its folder.
    """
    return fields_of(read_json(path), allow_outside)


def fields_of(entry: Entry, allow_outside: bool) -> dict:
    """The fields of the session in a document that has been parsed; errors as for `read`."""
    document = _migrated(entry)
    section, picks = document["section"], document["picks"]
    return {
        "source": _source(section["source"], allow_outside),
        "sha256": section.optional("sha256", _sha256),
        "faults": picks.optional("faults", _faults, ()),
        "horizons": picks.optional("horizons", _horizons, ()),
        "plan": replace(document.optional("plan", _plan, Plan()), fixed=picks.optional("fixed", Entry.point)),
        "written_by": document.optional("written_by", Entry.text, ""),
    }


def _migrated(document):
    """The document in today's form."""
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


def _made(entry, make, *values, **named):
    """What a constructor of ours makes of values; its errors get the file's name and the place."""
    try:
        return make(*values, **named)
    except SeiswidgetsError as error:
        raise DataError(f"{entry.path}: {entry.place}: {shortened(str(error))}") from error


def _source(entry, allow_outside):
    kind = entry["kind"].text()
    if kind != FILE:
        choices = entry.optional("arguments", _choices, {})
        return _made(entry, SectionSource, kind, entry["name"].text(), choices)
    path = entry["path"]
    name = _made(path, resolved, _folder(path.path), path.text(), allow_outside)
    return _made(entry, SectionSource, FILE, str(name), entry.optional("choices", _choices, {}))


def _choices(entry):
    return {name: _choice(entry[name], 1) for name in entry.members()}


def _choice(entry, depth):
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


def _sha256(entry):
    if not re.fullmatch("[0-9a-f]{64}", entry.text()):
        raise entry.error("a SHA-256, of 64 digits from 0 to f")
    return entry.text()


def _faults(entry):
    return _named(entry, lambda pick: (pick["points"].points(),))


def _horizons(entry):
    return _named(entry, lambda pick: tuple(piece.points() for piece in pick["pieces"].items()))


def _named(entry, pieces):
    picks = tuple(
        _made(
            pick,
            SavedPick,
            pick["name"].text(),
            pieces(pick),
            pick.optional("colour", Entry.text),
            pick.optional("visible", Entry.flag, True),
        )
        for pick in entry.items()
    )
    names = set()
    for pick, item in zip(picks, entry.items(), strict=True):
        if pick.name in names:
            raise item["name"].error("a name that no other has")
        names.add(pick.name)
    return picks


def _plan(entry):
    defaults = Plan()
    return _made(
        entry,
        Plan,
        steps=entry.optional("steps", _steps, defaults.steps),
        weights=entry.optional("weights", _weights, defaults.weights),
        solver=entry.optional("solver", Entry.text, defaults.solver),
        spacing=entry.optional("spacing", Entry.number),
        max_iterations=entry.optional("max_iterations", _count),
    )


def _count(entry):
    if type(entry.value) is not int or entry.value < 1:
        raise entry.error("a whole number of 1 or more")
    return entry.value


def _steps(entry):
    return tuple(
        _made(
            step,
            Step,
            step["kind"].text(),
            step.optional("picks", lambda picks: tuple(name.text() for name in picks.items()), ()),
            step.optional("datum", Entry.number),
            step.optional("on", Entry.flag, True),
        )
        for step in entry.items()
    )


def _weights(entry):
    known = [field.name for field in fields(Weights)]
    for name in entry.members():
        if name not in known:
            raise DataError(
                f"{entry.path}: {entry.place} has {brief(name)}, which is no weight; there are {', '.join(known)}"
            )
    return _made(entry, Weights, **{name: entry[name].number() for name in entry.members()})
