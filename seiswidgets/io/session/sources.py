"""Origin of a session's section: how it is opened again, and how it is recognised as unchanged."""

import hashlib
import inspect
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import partial
from pathlib import Path, PureWindowsPath
from reprlib import repr as brief
from types import MappingProxyType
from typing import Any

import numpy as np

from seiswidgets.errors import DataError, Keyword, SeiswidgetsError, SettingError
from seiswidgets.geology import synthetic
from seiswidgets.geology.kinematics import Survey
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.geology.velocity import Velocity
from seiswidgets.io import datasets
from seiswidgets.io.files import user_path
from seiswidgets.io.opening import open_section

FILE, SYNTHETIC, DATASET = "file", "synthetic", "dataset"
NAMES = {  # the only functions that a session may call, whatever its file says
    SYNTHETIC: tuple(name for name in synthetic.__all__ if name.islower()),
    DATASET: ("f3", "teapot"),
}
MOST_SAMPLES = 4_000_000  # in a synthetic section


@dataclass(frozen=True)
class SectionSource:
    """Origin of a section.

    Parameters
    ----------
    kind : {"file", "synthetic", "dataset"}
    name : str
        Path of the file, or name of a function of `synthetic` or `datasets`.
    choices : dict, optional
        Keywords that it is opened or made with: numbers, strings, True, False, None, slices, ranges, lists and dicts.
    velocity : velocity model, optional
        With it, a section in time is converted to depth.
    dz : float, optional
        Distance between the samples in depth, in metres.

    Raises
    ------
    SettingError
        If there is no such kind or name, or a choice has another type.
    DataError
        If the path of a file is not a path.
    """

    kind: str
    name: str
    choices: Mapping[str, Any] = field(default_factory=dict)
    velocity: Velocity | None = None
    dz: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in (FILE, *NAMES):
            raise SettingError(
                f"a section's source must be {', '.join(map(repr, (FILE, *NAMES)))}, but is {self.kind!r}"
            )
        if self.kind in NAMES and self.name not in NAMES[self.kind]:
            raise SettingError(
                f"the {self.kind} section must be one of {', '.join(NAMES[self.kind])}, but is {brief(self.name)}"
            )
        checked_kind(self.choices, Mapping, "choices")
        choices = {name: _as_json_value(name, value) for name, value in self.choices.items()}
        object.__setattr__(self, "name", os.path.abspath(user_path(self.name)) if self.kind == FILE else self.name)
        object.__setattr__(self, "choices", MappingProxyType(choices))

    @property
    def keywords(self) -> dict[str, Any]:
        """The choices as Python keywords, with slices and ranges."""
        return {name: revived(value) for name, value in self.choices.items()}

    def open(self) -> Section:
        """Open or make the section, and convert it to depth if there are velocities.

        Raises
        ------
        DataError, SettingError, SectionError
            If it cannot be opened, or not with these choices.
        """
        section = self._open_as_recorded()
        return section if self.velocity is None else section.to_depth(self.velocity, self.dz)

    def _open_as_recorded(self) -> Section:
        if self.kind == FILE:
            return self._call(partial(open_section, Path(self.name)))
        if self.kind == DATASET:
            return self._call(getattr(datasets, self.name))
        return self._call(partial(_synthetic, self.name))

    def _call(self, function: Callable[..., Section]) -> Section:
        try:
            inspect.signature(function).bind(**self.keywords)
            return function(**self.keywords)
        except SeiswidgetsError:
            raise
        except (TypeError, ValueError) as error:
            raise DataError(
                f"the section cannot be made with {dict(self.choices)}: {error}; correct its source"
            ) from error


def section_sha256(section: Section) -> str:
    """SHA-256 of a section's shape, geometry and amplitudes, in hexadecimal; name and credit are not included."""
    geometry = [section.shape, section.dx, section.dz, section.x0, section.z0]
    geometry += [section.x_unit, section.z_unit, section.velocity]
    amplitude = section.amplitude
    same = np.where(np.isnan(amplitude), np.nan, amplitude)  # NaN has many bit patterns: use one
    content = np.ascontiguousarray(same, dtype=amplitude.dtype.newbyteorder("<"))
    digest = hashlib.sha256(json.dumps([*geometry, content.dtype.str]).encode())
    digest.update(content.data)
    return digest.hexdigest()


def _as_json_value(name: str, value: object) -> object:
    """A choice as JSON can hold it."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, slice | range):
        return {type(value).__name__: [_as_json_value(name, part) for part in (value.start, value.stop, value.step)]}
    if isinstance(value, list | tuple):
        return [_as_json_value(name, part) for part in value]
    if isinstance(value, Mapping):
        return {str(key): _as_json_value(name, part) for key, part in value.items()}
    if value is None or isinstance(value, bool | int | str) or (isinstance(value, float) and np.isfinite(value)):
        return value
    raise SettingError(
        f"{name} must be a finite number, a string, True, False, None, a slice, a range, or a list or dict of these, "
        f"to be saved in a session, but is {value!r}"
    )


def revived(value: object) -> object:
    """A slice or a range from its form in JSON; other values unchanged."""
    for kind in (slice, range):
        if isinstance(value, dict) and list(value) == [kind.__name__] and isinstance(value[kind.__name__], list):
            parts = value[kind.__name__]
            if len(parts) == 3 and all(part is None or type(part) is int for part in parts):
                return kind(*parts)
    return value


def _synthetic(function: str, **choices: Any) -> Section:
    """Make a synthetic section, unless it would need much memory."""
    survey_fields = {field.name for field in fields(Survey)}
    survey = Survey(**{name: value for name, value in choices.items() if name in survey_fields})
    samples = survey.width / survey.dx * survey.depth / survey.dz
    if samples > MOST_SAMPLES:
        raise SettingError(
            f"a synthetic section of {samples:.0f} samples is too large; make ",
            Keyword("dx"),
            " or ",
            Keyword("dz"),
            " larger",
        )
    section: Section = getattr(synthetic, function)(**choices).section
    return section


def section_path(folder: Path, name: str, allow_outside: bool) -> Path:
    """Resolve a path in a session's file, following links.

    If there is no such file, it is looked for by its name in the session's folder.

    Raises
    ------
    DataError
        If it leads outside the session's folder, and that is not allowed.
    """
    root, name = os.path.realpath(folder), _moved(folder, name)
    try:
        path = os.path.realpath(os.path.join(root, name))
        inside = os.path.commonpath([root, path]) == root
    except ValueError:  # an unpaired surrogate, a null character, or another drive
        raise DataError(f"{name[:200]!r} cannot be the path of a section's file; correct it") from None
    if not (inside or allow_outside):
        raise DataError(
            f"the section's file {name[:200]!r} lies outside the session's folder {root}; put it there, or open the "
            "session with ",
            Keyword("allow_outside", True),
            " if you trust it",
        )
    return Path(path)


def _moved(folder: Path, name: str) -> str:
    """The same file in a session's folder if the session was moved here from another system; others unchanged."""
    path = PureWindowsPath(name)  # which accepts the separators of either system
    try:
        candidates = [] if (folder / name).exists() else [path.as_posix(), path.name]
        return next((moved for moved in candidates if (folder / moved).is_file()), name)
    except (OSError, ValueError):  # a name that the system does not allow, which is refused later
        return name


def relative_path(folder: Path, path: str) -> str:
    """A path as written into a session: relative if it lies in the session's folder."""
    root, path = os.path.realpath(folder), os.path.realpath(path)
    inside = Path(path).is_relative_to(root)
    return Path(path).relative_to(root).as_posix() if inside else path
