"""Everything that a user has done in an app, as one value and as text that a browser can keep."""

import contextlib
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from traitlets import Bunch, HasTraits, TraitError

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.section import Section
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.drawing import LETTERS, DraftLine, Drawing
from seiswidgets.io.document import MOST_JSON_BYTES, Entry, json_text, parse_json
from seiswidgets.io.session.file import session_document, session_fields
from seiswidgets.io.session.session import Session
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.files.session_bar import drawing_of, others_of, session_of
from seiswidgets.widgets.workspace import OtherHypotheses

KEPT = Path("the drawing kept by the browser")  # stands for a file's path in error messages


@dataclass(frozen=True)
class Work:
    """The picks with their styles, the draft line, the plan, and the app's settings.

    Attributes
    ----------
    drawing : Drawing
    plan : Plan
    settings : dict
        Traits of the app and its parts, by name.
    others : dict
        Name of the hypothesis that drawing and plan make, and the other ones; see `Document`.
    """

    drawing: Drawing = field(default_factory=Drawing)
    plan: Plan = field(default_factory=Plan)
    settings: dict[str, Any] = field(default_factory=dict)
    others: OtherHypotheses = field(default_factory=lambda: OtherHypotheses())

    @classmethod
    def of(cls, app: RestorationApp) -> "Work":
        """Present work in an app."""
        settings = {name: getattr(owner, name) for owner, name in _settings_of(app)}
        document = app.workspace.document
        others: OtherHypotheses = {"name": document.name, "before": document.before, "after": document.after}
        return cls(document.drawing, document.plan, settings, others)

    def put(self, app: RestorationApp, section: Section, source: SectionSource | None) -> None:
        """Continue this work in an app; undo brings back what was drawn there before."""
        app.workspace.open(section, self.drawing, source=source, plan=self.plan, **self.others)
        for owner, name in _settings_of(app):
            if name in self.settings:
                with contextlib.suppress(SeiswidgetsError, TraitError):  # another version wrote it: keep the app's own
                    setattr(owner, name, self.settings[name])

    def text(self, section: Section, sha256: str, source: SectionSource) -> str:
        """JSON text of the work: a session's document, the draft line and the settings.

        Raises
        ------
        PickError
            If a name contains an unpaired surrogate.
        """
        session = session_of(Document(section, self.drawing, self.plan, **self.others), source, sha256)
        line = self.drawing.draft
        return json_text(
            {
                "session": session_document(session, KEPT),
                "draft": None if line is None else asdict(line),
                "settings": self.settings,
            }
        )

    @classmethod
    def read(cls, text: str, section: Section) -> "Work":
        """Read the work from a text.

        Raises
        ------
        SeiswidgetsError
            If the text is damaged or comes from a newer version, or the picks do not lie on the section.
        """
        if len(text) > MOST_JSON_BYTES:
            raise DataError(
                f"{KEPT} must have at most {MOST_JSON_BYTES:,} characters, but has {len(text):,}; start over"
            )
        entry = parse_json(text, KEPT)
        session = Session(**session_fields(entry["session"], allow_outside=False))
        line = entry.optional("draft", _line, None)
        drawing = replace(drawing_of(session), draft=line)
        points = [*(line.points if line else ()), *([session.fixed] if session.fixed else []), *session.plan.pins]
        if not (drawing.lies_on(section) and (not points or section.contains(points).all())):
            raise DataError(f"{KEPT} must lie on the section, but reaches beyond it; start over")
        return cls(drawing, session.plan, entry.optional("settings", _settings, {}), others_of(session))


def observe_work(app: RestorationApp, callback: Callable[[Bunch], None]) -> None:
    """Call a function after each change of the work in an app."""
    app.workspace.observe(callback, ("document", "settled"))
    for owner, name in _settings_of(app):
        owner.observe(callback, name)


def _settings_of(app: RestorationApp) -> list[tuple[HasTraits, str]]:
    """Traits kept besides the picks and the plan, each after the part that owns it; every name is unique."""
    kept: dict[HasTraits, tuple[str, ...]] = {
        app: ("live",),
        app.picker: ("snap", "window", "follow"),
        app.panes.original: ("colours", "clip", "gain", "polarity"),
        app.panes: ("deformation", "mesh", "span", "zoom_linked"),
    }
    return [(owner, name) for owner, names in kept.items() for name in names]


def _line(entry: Entry) -> DraftLine:
    kind = entry["kind"].text()
    if kind not in LETTERS:
        raise entry["kind"].error(" or ".join(f'"{known}"' for known in LETTERS))
    points = entry["points"].points()
    if not points:
        raise entry["points"].error("one point or more")
    return DraftLine(kind, points, entry.optional("name", Entry.text, None))


def _settings(entry: Entry) -> dict[str, Any]:
    for name, value in entry.members().items():
        if not isinstance(value, bool | str):
            entry[name].number()
    return dict(entry.members())
