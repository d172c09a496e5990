"""The restoration app with a choice of sections."""

import gc
import json
from dataclasses import replace
from html import escape
from typing import Any

from ipywidgets import HTML, Button, Checkbox, Dropdown, HBox, Layout, VBox, Widget
from traitlets import Bool, Bunch, Enum, Instance

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.geology.synthetic import Synthetic
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.sources import SectionSource, section_sha256
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.binding import bind_control
from seiswidgets.widgets.browser_storage import BrowserStorage
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.exhibits import EXHIBITS, Exhibit
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.ipykernel_compat import keep_order
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.messages import HINT, TROUBLE
from seiswidgets.widgets.work import Work, observe_work

LOADING = "Loading this section; the first time, it may have to be downloaded."
BACK = "Your drawing on this section is back; Start over clears it."
SETTINGS_BACK = "Your settings for this section are back; Start over clears them."
DAMAGED = (
    "Your browser kept a drawing for this section, but it cannot be used: it is damaged, comes from a newer version, "
    "or does not lie on the section. Your next edit replaces it."
)
STARTED_OVER = "You have started over on this section."
RETURN = "Bring it back"
SET_ASIDE = "Your drawing on {} is set aside."
UNKEPT = (
    "Your browser cannot keep your drawing ({}). It will be lost when the page is reloaded: save it in a session in "
    "the tab File, or free some space."
)
CHOSEN = "choice"  # name under which the browser keeps the chosen section


class Gallery(WithParts, VBox):
    """The restoration app with a choice of sections: ten synthetic ones with known answers, and two real ones.

    Your work on each section is kept, separately with and without an interpreter's picks, and is back when you choose
    that section again. Your browser keeps it too, so it is also back when the page is reloaded and, as in Voila, a new
    kernel starts. *Start over* clears it.

    Parameters
    ----------
    **settings
        Initial values of the attributes. Without a choice, the gallery opens the section shown last in this browser.

    Attributes
    ----------
    choice : str
        Name of the section in `seiswidgets.synthetic` or `seiswidgets.datasets`; another choice opens another app.
    with_picks : bool
        Whether a synthetic section comes with its faults and horizons; if not, draw them yourself.
    app : RestorationApp or None
        None if the section's file is missing; the gallery then shows why.
    chooser, picks_box, start_over_button : Dropdown, Checkbox, Button
        Controls above the app.
    caption, warning : HTML
        A sentence about the section, and an error of the browser or the session.
    notice : Question
        News about kept work.

    Raises
    ------
    TypeError
        If a setting does not exist.
    """

    choice = Enum(tuple(EXHIBITS), next(iter(EXHIBITS)))
    with_picks = Bool(False)
    app = Instance(RestorationApp, allow_none=True)
    children: tuple[Widget, ...]

    def __init__(self, **settings: Any):
        self.check_settings(settings)
        self._works: dict[str, Work | None] = {}  # on each section in this kernel; None if started over
        self._aside: tuple[Work, Section, SectionSource | None] | None = None  # on a section of the user's own
        self._is_chosen = bool({"choice", "with_picks"} & settings.keys())
        super().__init__([KeyGuard(), self._make_head()], **settings)
        self.add_class("seiswidgets-gallery")
        keep_order(self)
        bind_control(self, "choice", self.chooser)
        self.picks_box.observe(self._take_picks_box, "value")
        self.observe(lambda change: self._show_picks_box(), "with_picks")
        self._open()
        self.observe(self._take_choice, ("choice", "with_picks"))
        self.storage.observe(self._take_found, "found")
        self.storage.observe(self._take_trouble, "trouble")

    @property
    def exhibit(self) -> Exhibit:
        """The chosen section."""
        return EXHIBITS[self.choice]

    def close(self) -> None:
        """Stop background work, remove the gallery from the page, and free its memory; the browser keeps your work."""
        if self.comm is not None:  # else closed already, or never opened
            self._leave()
        super().close()

    def start_over(self) -> None:
        """Clear the work on this section; undo, or the button that appears, brings it back."""
        if self.app is None:
            return
        done, section, source = _work_in(self.app)
        fresh = self._fresh if self._shows_choice(self.app) else replace(self._fresh, drawing=Drawing())
        self._put(fresh, section, source)
        self.notice.ask(STARTED_OVER, {RETURN: lambda: self._put(done, section, source)})

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """Add the app's picture, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**(self.app._repr_mimebundle_() if self.app else {}), **bundle}

    def _make_head(self) -> VBox:
        options = [(exhibit.title, name) for name, exhibit in EXHIBITS.items()]
        self.chooser = Dropdown(options=options, description="Section", layout=Layout(width="300px"))
        self.picks_box = Checkbox(description="with an interpreter's picks", indent=False, layout=Layout(width="auto"))
        self.start_over_button = Button(
            description="Start over",
            icon="eraser",
            tooltip="Clear your work on this section",
            layout=Layout(width="auto"),
        )
        self.start_over_button.on_click(lambda _: self.start_over())
        self.caption = HTML(layout=Layout(min_width="0"))
        self.warning = HTML(layout=Layout(display="none"))
        self.notice, self.storage = Question(), BrowserStorage()
        controls = HBox(
            [self.chooser, self.picks_box, self.start_over_button, self.caption],
            layout=Layout(flex_flow="wrap", align_items="center", grid_gap="0 16px"),
        )
        return VBox([controls, self.notice, self.warning, self.storage])

    def _take_choice(self, change: Bunch) -> None:
        self._is_chosen = True
        self._store(CHOSEN, json.dumps({"choice": self.choice, "with_picks": self.with_picks}))
        if self.app is None or self._name != self._chosen_name():
            self._open()

    def _show_picks_box(self) -> None:
        """Show whether the section comes with picks: off where there are none, whatever is wanted of others."""
        self.picks_box.disabled = not self.exhibit.has_picks
        self.picks_box.value = self.with_picks and self.exhibit.has_picks

    def _take_picks_box(self, change: Bunch) -> None:
        if self.exhibit.has_picks:
            self.with_picks = change.new

    def _chosen_name(self) -> str:
        """Name under which the work on the chosen section is kept."""
        return f"{self.choice}, with picks" if self.with_picks and self.exhibit.has_picks else self.choice

    def _open(self) -> None:
        try:
            self._leave()
        except DataError as error:  # the session cannot be saved; the gallery keeps the work all the same
            self._warn(str(error))
        self._show_picks_box()
        self.start_over_button.disabled = True
        self._show_caption(HINT, LOADING)
        try:
            loaded = self.exhibit.load()
        except DataError as error:
            self._show_caption(TROUBLE, f"{self.exhibit.title} is not available. {error}")
            return
        self._show(loaded)
        if self._aside is not None:
            question = SET_ASIDE.format(self._aside[1].name or "another section")
            self.notice.ask(f"{self.notice.text} {question}".strip(), {RETURN: self._return_to_aside})

    def _show(self, loaded: Synthetic | Section) -> None:
        self._name, self._source = self._chosen_name(), self.exhibit.source
        self._section = loaded if isinstance(loaded, Section) else loaded.section
        self._sha256 = section_sha256(self._section)
        self.app = self._make_app(loaded)
        self._fresh = Work.of(self.app)
        self._bring_back()
        observe_work(self.app, self._keep)
        self.children = (*self.children[:2], self.app)
        credit = f"Credit: {self._section.credit}." if self._section.credit else ""
        self._show_caption(HINT, f"{self.exhibit.text} {credit}".strip())

    def _make_app(self, loaded: Synthetic | Section) -> RestorationApp:
        if isinstance(loaded, Section) or not self.with_picks:
            return RestorationApp(self._section, source=self._source)
        return RestorationApp(loaded.section, loaded.interpretation, fixed=loaded.fixed, source=self._source)

    def _leave(self) -> None:
        """Close the app; a drawing on a section of the user's own is set aside."""
        self.notice.hint("")
        if self.app is None:
            return
        app, self.app = self.app, None
        if not self._shows_choice(app) and app.picker.drawing != Drawing():
            self._aside = _work_in(app)
        self.children = self.children[:2]
        app.close()
        del app
        gc.collect()  # frees the large section now: reference cycles keep it alive until a collection

    def _return_to_aside(self) -> None:
        if self._aside is not None:
            aside, self._aside = self._aside, None
            self._put(*aside)

    def _shows_choice(self, app: RestorationApp) -> bool:
        """Return whether the app shows the chosen section: another one can be opened in its tab File."""
        return app.section is self._section

    def _put(self, work: Work, section: Section, source: SectionSource | None) -> None:
        """Continue some work in the app, and keep it if it is on the chosen section."""
        if self.app is not None:
            work.put(self.app, section, source)
            self._keep()

    def _keep(self, change: Bunch | None = None) -> None:
        """Keep the present work, unless it is that of a fresh app."""
        if self.app is None or not self.app.workspace.settled:
            return
        shows_choice, work = self._shows_choice(self.app), Work.of(self.app)
        self.start_over_button.disabled = shows_choice and work == self._fresh
        if shows_choice:
            self._keep_work(work)

    def _keep_work(self, work: Work) -> None:
        if work == self._fresh:
            self._works[self._name] = None  # overrides what the browser may have kept
            self._store(self._name, None)
            return
        self._works[self._name] = work
        try:
            self._store(self._name, work.text(self._section, self._sha256, self._source))
        except SeiswidgetsError as error:
            self._warn(str(error))
        else:
            self._take_trouble()

    def _store(self, name: str, text: str | None) -> None:
        """Store a text in the browser under a name; None removes it."""
        others = {other: kept for other, kept in self.storage.kept.items() if other != name}
        self.storage.kept = others if text is None else {**others, name: text}

    def _bring_back(self) -> None:
        """Show earlier work on the section, if there is any."""
        try:
            work = self._earlier_work()
        except SeiswidgetsError:
            self.notice.alert(DAMAGED)
            return
        if self.app is None or work is None or work == self._fresh:
            return
        work.put(self.app, self._section, self._source)
        self.app.workspace.history.forget()  # or undo would clear it all
        self.app.picker.refresh()
        self._keep()
        self.notice.hint(BACK if work.drawing != self._fresh.drawing else SETTINGS_BACK)

    def _earlier_work(self) -> Work | None:
        """Work on the section from this kernel or from the browser; None if there is none."""
        if self._name in self._works:
            return self._works[self._name]
        text = (self.storage.found or {}).get(self._name)
        return None if text is None else Work.read(text, self._section)

    def _take_found(self, change: Bunch) -> None:
        """Show what the browser has kept, unless the user has begun something else here."""
        if self.app is not None and Work.of(self.app) != self._fresh:
            return
        choice = None if self._is_chosen else _read_choice(change.new.get(CHOSEN, ""))
        if choice and choice != (self.choice, self.with_picks):
            with self.hold_trait_notifications():
                self.choice, self.with_picks = choice
        elif self.app is not None:
            self._bring_back()

    def _take_trouble(self, change: Bunch | None = None) -> None:
        trouble = self.storage.trouble
        self._warn(UNKEPT.format(trouble) if trouble else "")

    def _warn(self, text: str) -> None:
        self.warning.value = TROUBLE.format(escape(text))
        self.warning.layout.display = "" if text else "none"

    def _show_caption(self, look: str, text: str) -> None:
        self.caption.value = look.format(escape(text))


def _work_in(app: RestorationApp) -> tuple[Work, Section, SectionSource | None]:
    """Present work in an app, its section, and the origin of that."""
    return Work.of(app), app.section, app.source


def _read_choice(text: str) -> tuple[str, bool] | None:
    """The section chosen last, and whether with its picks; None if the text is damaged."""
    try:
        kept = json.loads(text)
        choice, with_picks = kept["choice"], kept["with_picks"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return (choice, with_picks) if isinstance(with_picks, bool) and choice in list(EXHIBITS) else None
