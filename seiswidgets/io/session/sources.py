"""Where the section of a session comes from, how it is opened again, and how it is known to be the same."""

import hashlib
import inspect
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import partial
from pathlib import Path
from reprlib import repr as brief
from types import MappingProxyType

import numpy as np

from seiswidgets.errors import DataError, SeiswidgetsError, SettingError
from seiswidgets.geology import synthetic
from seiswidgets.geology.kinematics import Survey
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io import datasets
from seiswidgets.io.files import user_path
from seiswidgets.io.opening import open_section

FILE, SYNTHETIC, DATASET = "file", "synthetic", "dataset"
NAMES = {  # what a session may call, whatever it says
    SYNTHETIC: (
        "planar_fault",
        "listric_fault",
        "faulted_fold",
        "graben",
        "domino",
        "tilt",
        "sine_fold",
        "blind_fault",
    ),
    DATASET: ("f3", "teapot"),
}
MOST_SAMPLES = 4_000_000  # of a synthetic section


@dataclass(frozen=True)
class SectionSource:
    """Where a section comes from.

    Parameters
    ----------
    kind : {"file", "synthetic", "dataset"}
    name : str
        The path of the file, the function of `synthetic`, or that of `datasets`.
    choices : dict, optional
        Keywords it is opened or made with: numbers, texts, True, False, None, slices, ranges, lists and dicts.

    Raises
    ------
    SettingError
        If there is no such kind or name, or a choice is something else.
    DataError
        If the path of a file is none.
    """

    kind: str
    name: str
    choices: Mapping = field(default_factory=dict)

    def __post_init__(self):
        if self.kind not in (FILE, *NAMES):
            raise SettingError(
                f"a section's source must be {', '.join(map(repr, (FILE, *NAMES)))}, but is {self.kind!r}"
            )
        if self.kind in NAMES and self.name not in NAMES[self.kind]:
            raise SettingError(
                f"the {self.kind} section must be one of {', '.join(NAMES[self.kind])}, but is {brief(self.name)}"
            )
        checked_kind(self.choices, Mapping, "choices")
        choices = {name: _plain(name, value) for name, value in self.choices.items()}
        object.__setattr__(self, "name", os.path.abspath(user_path(self.name)) if self.kind == FILE else self.name)
        object.__setattr__(self, "choices", MappingProxyType(choices))

    @property
    def keywords(self) -> dict:
        """The choices as functions take them, slices and ranges among them."""
        return _keywords(self.choices)

    def open(self) -> Section:
        """The section.

        Raises
        ------
        DataError, SettingError
            If it cannot be opened, or not with these choices.
        """
        if self.kind == FILE:
            return _called(open_section, self.choices, Path(self.name))
        if self.kind == DATASET:
            return _called(getattr(datasets, self.name), self.choices)
        return _called(partial(_synthetic, self.name), self.choices)


def section_sha256(section: Section) -> str:
    """SHA-256 of a section's shape, geometry and amplitudes, in hexadecimal; not of its name and credit."""
    geometry = [section.shape, section.dx, section.dz, section.x0, section.z0]
    geometry += [section.x_unit, section.z_unit, section.velocity]
    amplitude = section.amplitude
    same = np.where(np.isnan(amplitude), np.nan, amplitude)  # one kind of NaN, of the many that there are
    content = np.ascontiguousarray(same, dtype=amplitude.dtype.newbyteorder("<"))
    digest = hashlib.sha256(json.dumps([*geometry, content.dtype.str]).encode())
    digest.update(content)
    return digest.hexdigest()


def _plain(name, value):
    """A choice as JSON can hold it."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, slice | range):
        return {type(value).__name__: [_plain(name, part) for part in (value.start, value.stop, value.step)]}
    if isinstance(value, list | tuple):
        return [_plain(name, part) for part in value]
    if isinstance(value, Mapping):
        return {str(key): _plain(name, part) for key, part in value.items()}
    if value is None or isinstance(value, bool | int | str) or (isinstance(value, float) and np.isfinite(value)):
        return value
    raise SettingError(
        f"{name} must be a finite number, a text, True, False, None, a slice, a range, or a list or dict of these, to "
        f"be kept in a session, but is {value!r}"
    )


def _keywords(choices):
    return {name: _revived(value) for name, value in choices.items()}


def _revived(value):
    """A slice or a range from how JSON holds it; other values as they are."""
    for kind in (slice, range):
        if isinstance(value, dict) and list(value) == [kind.__name__] and isinstance(value[kind.__name__], list):
            parts = value[kind.__name__]
            if len(parts) == 3 and all(part is None or type(part) is int for part in parts):
                return kind(*parts)
    return value


def _called(function, choices, *arguments):
    try:
        keywords = _keywords(choices)
        inspect.signature(function).bind(*arguments, **keywords)
        return function(*arguments, **keywords)
    except SeiswidgetsError:
        raise
    except (TypeError, ValueError) as error:
        raise DataError(f"the section cannot be made with {dict(choices)}: {error}; correct its source") from error


def _synthetic(function, **choices):
    """A synthetic section, unless it would need much memory."""
    named = {field.name for field in fields(Survey)}
    survey = Survey(**{name: value for name, value in choices.items() if name in named})
    samples = survey.width / survey.dx * survey.depth / survey.dz
    if samples > MOST_SAMPLES:
        raise SettingError(f"a synthetic section of {samples:.0f} samples is too large; make dx or dz larger")
    return getattr(synthetic, function)(**choices).section


def resolved(folder: Path, name: str, allow_outside: bool) -> Path:
    """A path in a session's file, links followed; refused if it leads out of the file's folder.

    Raises
    ------
    DataError
        If it does, and that is not allowed.
    """
    root = os.path.realpath(folder)
    try:
        path = os.path.realpath(os.path.join(root, name))
        inside = os.path.commonpath([root, path]) == root
    except ValueError:  # half a character, a zero, or another drive
        raise DataError(f"{name[:200]!r} cannot be the path of a section's file; correct it") from None
    if not (inside or allow_outside):
        raise DataError(
            f"the section's file {name[:200]!r} lies outside the session's folder {root}; put it there, or open the "
            "session with allow_outside=True if you trust it"
        )
    return Path(path)


def relative(folder: Path, path: str) -> str:
    """A path as it is written into a session: relative where it lies in the session's folder."""
    root, path = os.path.realpath(folder), os.path.realpath(path)
    inside = Path(path).is_relative_to(root)
    return Path(path).relative_to(root).as_posix() if inside else path
