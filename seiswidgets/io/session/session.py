"""Sessions: everything that a restoration was made from, in one file that makes it again."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from seiswidgets import __version__
from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.hypothesis import FIRST_NAME, Hypothesis
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.document import Point, check_file_size
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.files import user_path, write_file
from seiswidgets.io.session.file import read_session_fields, session_as_json
from seiswidgets.io.session.saved_picks import SavedHypothesis, SavedPick, check_picks, saved_pick, usable_picks
from seiswidgets.io.session.sources import FILE, SectionSource, section_sha256
from seiswidgets.signatures import strict_keywords


@dataclass(frozen=True)
class Session:
    """A section's source, the picks drawn on it, and the plan to restore it.

    Parameters
    ----------
    source : SectionSource
    sha256 : str or None
        Hash of the section, by `section_sha256`; None if unknown.
    faults, horizons : tuple of SavedPick
    plan : Plan
        Includes the held point.
    written_by : str
        The version of seiswidgets that wrote it.
    bodies : tuple of SavedPick
    name : str
        Of the hypothesis that these picks and this plan make.
    before, after : tuple of SavedHypothesis
        The other hypotheses, in their order.

    Raises
    ------
    PickError
        If a fault or a body is not one line, or two picks of a kind have the same name.
    SettingError
        If the source or the plan has the wrong type, or two hypotheses have the same name.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.faulted_fold()
    >>> source = sw.SectionSource("synthetic", "faulted_fold")
    >>> session = sw.Session.of(case.section, source, case.interpretation, case.fixed)
    >>> [stage.kind for stage in session.restore().stages]
    ['unfault', 'flatten']
    """

    source: SectionSource
    sha256: str | None
    faults: tuple[SavedPick, ...] = ()
    horizons: tuple[SavedPick, ...] = ()
    plan: Plan = field(default_factory=Plan)
    written_by: str = field(default=f"seiswidgets {__version__}", compare=False)
    bodies: tuple[SavedPick, ...] = ()
    name: str = FIRST_NAME
    before: tuple[SavedHypothesis, ...] = ()
    after: tuple[SavedHypothesis, ...] = ()

    def __post_init__(self) -> None:
        checked_kind(self.source, SectionSource, "source")
        checked_kind(self.plan, Plan, "plan")
        check_picks(self.faults, self.horizons, self.bodies)
        names = [self.name, *(other.name for other in (*self.before, *self.after))]
        if len(set(names)) < len(names):
            raise SettingError(
                f"two hypotheses are called {max(names, key=names.count)!r}; give each a name of its own"
            )

    @classmethod
    def of(
        cls,
        section: Section,
        source: SectionSource,
        interpretation: Interpretation,
        fixed: Point | None = None,
        plan: Plan | None = None,
        looks: Mapping[tuple[str, str], Mapping[str, Any]] | None = None,
    ) -> "Session":
        """Make the session of an open section.

        Parameters
        ----------
        section : Section
        source : SectionSource
            Origin of the section.
        interpretation : Interpretation
        fixed : (x, z), optional
        plan : Plan, optional
        looks : dict, optional
            ``{("fault", "F1"): {"colour": "#e69f00", "visible": False}, ...}``, for the picks that have any.

        Raises
        ------
        SettingError
            If an argument has the wrong type.
        PickError
            If the fixed point is not a point.
        """
        checked_kind(section, Section, "section")
        checked_kind(interpretation, Interpretation, "interpretation")
        looks, plan = looks or {}, plan or Plan()
        return cls(
            source,
            section_sha256(section),
            tuple(saved_pick(fault, looks.get((FAULT, fault.name))) for fault in interpretation.faults),
            tuple(saved_pick(horizon, looks.get((HORIZON, horizon.name))) for horizon in interpretation.horizons),
            plan if fixed is None else replace(plan, fixed=fixed),
            bodies=tuple(saved_pick(body, looks.get((BODY, body.name))) for body in interpretation.bodies),
        )

    def save(self, path: str | os.PathLike) -> None:
        """Write the session; an existing file stays until the new one is complete.

        Raises
        ------
        DataError
            If it cannot be written, or is too large to be read again.
        """
        path = user_path(path)
        try:
            content = session_as_json(self, path).encode()
        except (TypeError, ValueError) as error:
            raise DataError(f"{path} cannot hold this session: {error}; correct its numbers") from error
        check_file_size(path, content)
        write_file(path, content)

    @property
    def fixed(self) -> Point | None:
        """The point whose block is held."""
        return self.plan.fixed

    @property
    def interpretation(self) -> Interpretation:
        """The picks that can be used in a restoration."""
        return self._usable_picks()[0]

    @property
    def colours(self) -> dict[tuple[str, str], str]:
        """Colours of the picks that have one of their own, by kind and name."""
        kinds = ((FAULT, self.faults), (HORIZON, self.horizons), (BODY, self.bodies))
        return {(kind, pick.name): pick.colour for kind, picks in kinds for pick in picks if pick.colour}

    @property
    def problems(self) -> list[str]:
        """Reason why each unusable line is left out, or only carried along."""
        return [message for *_, message in self._usable_picks()[1]]

    def _usable_picks(self) -> tuple[Interpretation, tuple]:
        return usable_picks(self.faults, self.horizons, self.bodies)

    def hypotheses(self, section: Section) -> tuple[Hypothesis, ...]:
        """All hypotheses of the session on its section, in their order, its own among them."""
        own = Hypothesis(section, self.interpretation, self.plan, self.name)
        before, after = ([one.on(section) for one in others] for others in (self.before, self.after))
        return *before, own, *after

    def open_section(self, *, allow_changed: bool = False) -> Section:
        """Open the section from its source.

        Parameters
        ----------
        allow_changed : bool
            Whether it may differ from the section that the session was made on.

        Raises
        ------
        DataError
            If it differs and may not, or cannot be opened.
        """
        section = self.source.open()
        if not allow_changed and self.sha256 not in (None, section_sha256(section)):
            raise DataError(
                f"the section from {self.source.kind} {self.source.name!r} is not the one that the session was made "
                "on: its shape, geometry or amplitudes differ; find the original one, or allow it with ",
                Keyword("allow_changed", True),
                kind="changed section",
            )
        return section

    def restore(
        self, progress: Callable[[int, int, float], bool | None] | None = None, *, allow_changed: bool = False
    ) -> Restoration:
        """Run the plan on the section.

        Parameters
        ----------
        progress : callable(step, iteration, energy), optional
            Called after each iteration, steps counted from 0; returning False cancels.
        allow_changed : bool
            Whether the section may differ from the one that the session was made on.

        Raises
        ------
        DataError
            If the section cannot be opened, or differs.
        PickError, SettingError, FlippedError, Cancelled
            As for `Plan.restore`.
        """
        section = self.open_section(allow_changed=allow_changed)
        return self.plan.restore(section, self.interpretation, progress=progress)


@strict_keywords
def open_session(path: str | os.PathLike, *, allow_outside: bool = False) -> Session:
    """Open a session's file, without opening its section yet.

    Parameters
    ----------
    path : path
    allow_outside : bool
        Whether the section's file may lie outside the session's folder.

    Raises
    ------
    DataError
        If the file is damaged, comes from a newer version of seiswidgets, or its section lies outside its folder; the
        message names the file, the location in it, and what to do.
    """
    return Session(**read_session_fields(user_path(path), allow_outside))


@dataclass(frozen=True)
class SessionWithSection:
    """A session of a section that comes from no file: its section is saved beside it, so that it can be opened again.

    Parameters
    ----------
    session : Session
        Its source names the file to save the section in, as `source_beside` does.
    section : Section
    """

    session: Session
    section: Section

    def save(self, path: Path) -> None:
        """Write the section, unless it is there already, and the session.

        Raises
        ------
        DataError
            If either cannot be written.
        """
        section_file = Path(self.session.source.name)
        if not section_file.exists():
            save_section(self.section, section_file)
        self.session.save(path)


def source_beside(path: Path, sha256: str) -> SectionSource:
    """Source of a section saved beside a session's path: ``<stem>.section-<first 12 digits of its hash>.npz``."""
    return SectionSource(FILE, str(path.with_name(f"{path.stem}.section-{sha256[:12]}.npz").absolute()))
