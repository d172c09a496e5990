"""The workspace: sole owner of the section, the picks, the plan, the restoration and the session's path.

Views and panels read it, observe it, and send it edits; none of them keeps a copy of its state.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypedDict, Unpack

from traitlets import Bool, Bunch, HasTraits, Instance, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import Plan, RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.alternatives import alternatives, switched, with_alternatives
from seiswidgets.interaction.document import Alternative, Document, EditHistory
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.sources import FILE, SectionSource


class OtherHypotheses(TypedDict, total=False):
    """Fields of a document: the name of its hypothesis, and the others."""

    name: str
    before: tuple[Alternative, ...]
    after: tuple[Alternative, ...]


class Workspace(HasTraits):
    """A section that is interpreted and restored.

    Every edit of the document can be undone: picks, the held point, weights, steps, the mesh, imported picks, and a
    change of section.

    Parameters
    ----------
    section : Section
    drawing : Drawing, optional
    plan : Plan, optional
    source : SectionSource, optional

    Attributes
    ----------
    document : Document
        Section, drawing, plan and source; only ``history`` changes it. Observe it to follow all edits.
    history : EditHistory
    settled : bool
        False while something is being dragged.
    restoration : Restoration
        The newest restoration on the full mesh; may be set.
    session_path : Path or None
        Path under which the work is saved; None if it is not.
    """

    document = Instance(Document)
    settled = Bool(True)
    restoration = Instance(Restoration)
    session_path = Instance(Path, allow_none=True)

    def __init__(
        self,
        section: Section,
        drawing: Drawing | None = None,
        plan: Plan | None = None,
        source: SectionSource | None = None,
    ):
        document = Document(section, drawing or Drawing(), plan or Plan(), source)
        self.history = EditHistory(document, self._publish, self._check)
        self._guards: list[Callable[[], None]] = []
        super().__init__(document=document, restoration=Restoration(section))

    @property
    def section(self) -> Section:
        """The present-day section."""
        return self.document.section

    @property
    def drawing(self) -> Drawing:
        """All picks with their styles, unusable ones included, and the draft line."""
        return self.document.drawing

    @property
    def interpretation(self) -> Interpretation:
        """Finished and valid picks; the same object as long as they do not change."""
        return self.document.drawing.interpretation

    @property
    def plan(self) -> Plan:
        """The steps, weights, mesh, solver and held point."""
        return self.document.plan

    @property
    def source(self) -> SectionSource | None:
        """Origin of the section."""
        return self.document.source

    @property
    def job(self) -> RestorationJob:
        """The restoration that the document asks for."""
        return RestorationJob(self.section, self.interpretation, self.plan)

    def edit(self, label: str, **changes: Any) -> None:
        """Change fields of the document as one edit, named in the tooltip of Undo; no change is no edit."""
        self.history.edit(label, **changes)

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """All hypotheses of the document, in their order."""
        return tuple(
            Hypothesis(self.section, one.drawing.interpretation, one.plan, one.name)
            for one in alternatives(self.document)
        )

    def load_hypotheses(self, hypotheses: Sequence[Hypothesis]) -> None:
        """Replace all hypotheses by others, as one edit, and show the first; picks of the same name keep their looks.

        Raises
        ------
        SettingError
            If there is none, one is of another section, or two have the same name.
        """
        names = [one.name for one in hypotheses]
        if not names or len(set(names)) < len(names):
            raise SettingError("give at least one hypothesis, each with a name of its own")
        if any(one.section is not self.section for one in hypotheses):
            raise SettingError("a hypothesis is of another section; open that section first")
        loaded = [
            Alternative(one.name, self.drawing.with_interpretation(one.interpretation), one.plan) for one in hypotheses
        ]
        self.edit_hypotheses("load hypotheses", lambda document: with_alternatives(document, loaded, 0))

    def edit_hypotheses(self, label: str, change: Callable[[Document], Document]) -> None:
        """Change the hypotheses as one edit, by a function of `alternatives`."""
        self.edit(label, **vars(change(self.document)))

    def step_hypothesis(self, step: int) -> None:
        """Show the next hypothesis (1) or the one before (-1); after the last one comes the first."""
        document = self.document
        index = (len(document.before) + step) % len(alternatives(document))
        if index != len(document.before):
            self.edit_hypotheses(f"show {alternatives(document)[index].name}", lambda old: switched(old, index))

    def change_plan(self, label: str, **choices: Any) -> None:
        """Change choices of the plan as one edit; the present ones are no edit, even while they are being dragged."""
        plan = replace(self.plan, **choices)
        if plan != self.plan:
            self.edit(label, plan=plan)

    def open(
        self,
        section: Section,
        drawing: Drawing,
        *,
        source: SectionSource | None = None,
        plan: Plan | None = None,
        **others: Unpack[OtherHypotheses],
    ) -> None:
        """Continue with another section and its picks, as one edit.

        Parameters
        ----------
        section : Section
        drawing : Drawing
        source : SectionSource, optional
            Origin of the section.
        plan : Plan, optional
            If left out, the present steps and weights on a mesh of default spacing; held points stay if they lie on
            the new section, and so does a regional level.
        name, before, after
            The hypothesis and the others, if there are any; see `Document`.

        Raises
        ------
        DataError
            If a session cannot save the edits of the present section.
        """
        plan = plan or replace(self.plan, spacing=None, **self._kept_holds(section))
        opened = Document(section, drawing, plan, source, **others)
        self.edit(f"open {_title(section, source)}", **vars(opened))

    def as_drawn(self, interpretation: Interpretation) -> Interpretation:
        """Interpretation that results from loading one; loading the present one changes nothing."""
        if interpretation is self.interpretation:
            return interpretation  # not the same picks in another order, which would be an edit
        return self.drawing.with_interpretation(interpretation).interpretation

    def picks_fit(self, section: Section) -> bool:
        """Return whether the picks and the held point lie on another section too, in the same units."""
        same_units = (section.x_unit, section.z_unit) == (self.section.x_unit, self.section.z_unit)
        return (
            same_units
            and self.drawing.lies_on(section)
            and replace(self.plan, **self._kept_holds(section)) == self.plan
        )

    def guard_section(self, check: Callable[[], None]) -> None:
        """Call a function before each change of section; it may raise to prevent the change."""
        self._guards.append(check)

    def _kept_holds(self, section: Section) -> dict[str, Any]:
        """The held points and the regional level of the plan that lie on a section."""
        plan = self.plan

        def lies_on(*points: tuple[float, float]) -> bool:
            return bool(section.contains(points).all())

        level = [(section.x0, plan.regional)] if isinstance(plan.regional, float) else plan.regional or ()
        return {
            "fixed": plan.fixed if plan.fixed and lies_on(plan.fixed) else None,
            "pins": tuple(pin for pin in plan.pins if lies_on(pin)),
            "regional": plan.regional if level and lies_on(*level) else None,
        }

    def _check(self, document: Document) -> None:
        if document.section is not self.section:
            for check in self._guards:
                check()

    def _publish(self) -> None:
        if not self.history.is_settled:
            self.settled = False
        self.document = self.history.document
        self.settled = self.history.is_settled

    @observe("document")
    def _drop_restoration(self, change: Bunch) -> None:
        if isinstance(change.old, Document) and change.old.section is not change.new.section:
            self.restoration = Restoration(change.new.section)

    @validate("restoration")
    def _valid_restoration(self, proposal: Bunch) -> Restoration:
        if proposal.value.original is not self.section:
            raise SettingError("the restoration is of another section; open that section first")
        return proposal.value


def _title(section: Section, source: SectionSource | None) -> str:
    """Short title of a section: its file's name, or its own."""
    return Path(source.name).name if source and source.kind == FILE else section.name or "a section"
