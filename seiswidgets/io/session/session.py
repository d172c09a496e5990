"""A session: everything that a restoration was made from, in one file that makes it again."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from seiswidgets import __version__
from seiswidgets.errors import DataError, PickError
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation, usable
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.document import LARGEST_OURS, check_size
from seiswidgets.io.files import user_path, write_whole
from seiswidgets.io.session import file
from seiswidgets.io.session.saved_picks import SavedPick, saved
from seiswidgets.io.session.sources import SectionSource, section_sha256

Point = tuple[float, float]


@dataclass(frozen=True)
class Session:
    """A section's source, what was drawn on it, and the plan to restore it.

    Parameters
    ----------
    source : SectionSource
    sha256 : str or None
        Of the section, by `section_sha256`; None if it was not known.
    faults, horizons : tuple of SavedPick
    plan : Plan
        With the held point.
    written_by : str
        The version of seiswidgets that wrote it.

    Raises
    ------
    PickError
        If a fault is not one line, or two faults or two horizons have the same name.
    SettingError
        If the source or the plan is something else.

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

    def __post_init__(self):
        checked_kind(self.source, SectionSource, "source")
        checked_kind(self.plan, Plan, "plan")
        for picks in (self.faults, self.horizons):
            names = [pick.name for pick in picks]
            if len(set(names)) < len(names):
                raise PickError(f"two picks are called {max(names, key=names.count)!r}; give each a name of its own")
        for fault in self.faults:
            if len(fault.pieces) != 1:
                raise PickError(f"fault {fault.name!r} must be one line, but has {len(fault.pieces)}; give each a name")

    @classmethod
    def of(
        cls,
        section: Section,
        source: SectionSource,
        interpretation: Interpretation,
        fixed: Point | None = None,
        plan: Plan | None = None,
        looks: Mapping | None = None,
    ) -> "Session":
        """The session of a section that is open.

        Parameters
        ----------
        section : Section
        source : SectionSource
            Where it comes from.
        interpretation : Interpretation
        fixed : (x, z), optional
        plan : Plan, optional
        looks : dict, optional
            ``{("fault", "F1"): {"colour": "#e69f00", "visible": False}, ...}``, of those picks that have any.

        Raises
        ------
        SettingError
            If an argument is of another kind.
        PickError
            If the fixed point is none.
        """
        checked_kind(section, Section, "section")
        checked_kind(interpretation, Interpretation, "interpretation")
        looks, plan = looks or {}, plan or Plan()
        return cls(
            source,
            section_sha256(section),
            tuple(saved(fault, looks.get((FAULT, fault.name))) for fault in interpretation.faults),
            tuple(saved(horizon, looks.get((HORIZON, horizon.name))) for horizon in interpretation.horizons),
            plan if fixed is None else replace(plan, fixed=fixed),
        )

    def save(self, path: str | os.PathLike) -> None:
        """Write the session; an older file of that name stays until the new one is complete.

        Raises
        ------
        DataError
            If it cannot be written, or is too large to be read again.
        """
        path = user_path(path)
        try:
            content = file.text(self, path).encode()
        except (TypeError, ValueError) as error:
            raise DataError(f"{path} cannot hold this session: {error}; correct its numbers") from error
        check_size(path, content, LARGEST_OURS)
        write_whole(path, content)

    @property
    def fixed(self) -> Point | None:
        """The point whose block is held."""
        return self.plan.fixed

    @property
    def interpretation(self) -> Interpretation:
        """The picks that can be restored with."""
        return self._usable[0]

    @property
    def problems(self) -> list[str]:
        """What is wrong with each line that cannot; it is left out."""
        return [message for *_, message in self._usable[1]]

    @property
    def _usable(self):
        kinds = ((FAULT, self.faults), (HORIZON, self.horizons))
        return usable((kind, pick.name, pick.pieces) for kind, picks in kinds for pick in picks)

    def open_section(self, *, allow_changed: bool = False) -> Section:
        """The section, from its source.

        Parameters
        ----------
        allow_changed : bool
            Whether it may be another than the session was made on.

        Raises
        ------
        DataError
            If it is and may not, or cannot be opened.
        """
        section = self.source.open()
        if not allow_changed and self.sha256 not in (None, section_sha256(section)):
            raise DataError(
                f"the section from {self.source.kind} {self.source.name!r} is not the one that the session was made "
                "on: its shape, geometry or amplitudes differ; find the old one, or allow it by allow_changed=True"
            )
        return section

    def restore(
        self, progress: Callable[[int, int, float], bool | None] | None = None, *, allow_changed: bool = False
    ) -> Restoration:
        """Carry the plan out once more.

        Parameters
        ----------
        progress : callable(step, iteration, energy), optional
            Called after each iteration, steps counted from 0; returning False cancels.
        allow_changed : bool
            Whether the section may be another than the session was made on.

        Raises
        ------
        DataError
            If the section cannot be opened, or differs.
        PickError, SettingError, FlippedError, Cancelled
            As for `Plan.restore`.
        """
        section = self.open_section(allow_changed=allow_changed)
        return self.plan.restore(section, self.interpretation, progress=progress)


def open_session(path: str | os.PathLike, *, allow_outside: bool = False) -> Session:
    """The session in a file; its section is not opened yet.

    Parameters
    ----------
    path : path
    allow_outside : bool
        Whether the section's file may lie outside the session's folder.

    Raises
    ------
    DataError
        If the file is damaged, comes from a newer version of seiswidgets, or leads out of its folder; the message names
        the file, the place in it, and what to do.
    """
    return Session(**file.read(user_path(path), allow_outside))
