"""The app with a choice of the sections that come with the package."""

import gc
import json
from dataclasses import replace
from html import escape

from ipywidgets import HTML, Button, Checkbox, Dropdown, HBox, Layout, VBox
from traitlets import Bool, Enum, Instance

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.sources import section_sha256
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

WAIT = "Looking for this section; the first time it may have to be fetched."
BACK = "Your drawing on this section is back; Start over clears it."
SETTINGS_BACK = "Your settings for this section are back; Start over clears them."
DAMAGED = (
    "Your browser had kept a drawing for this section, but it is left out: it is damaged, comes from a newer version, "
    "or does not lie on the section. The next thing that you draw replaces it."
)
STARTED_OVER = "You have started over on this section."
RETURN = "Bring it back"
SET_ASIDE = "Your drawing on {} is set aside."
UNKEPT = (
    "Your browser cannot keep your drawing ({}). It will be gone when the page is loaded again: save it in a session "
    "in the tab File, or make room."
)
CHOSEN = "choice"  # the name under which the browser keeps what is chosen


class Gallery(WithParts, VBox):
    """The restoration app with a choice of sections: seven made by computer, whose truth is known, and two real ones.

    What you do on each section is kept, with an interpreter's picks and without them apart: it is back when you choose
    that section again. Your browser keeps it too, so that it is also back when the page is loaded again and, as in
    Voila, a new kernel begins. *Start over* clears it.

    Parameters
    ----------
    **settings
        Initial values of the attributes. Without a choice, the section that was shown last in this browser is shown.

    Attributes
    ----------
    choice : str
        The section's name in `seiswidgets.synthetic` or `seiswidgets.datasets`; another one makes another app.
    with_picks : bool
        Whether a section made by computer comes with its faults and horizons; else they are yours to draw.
    app : RestorationApp or None
        None where the section's file is missing, which is said in its place.
    """

    choice = Enum(tuple(EXHIBITS), next(iter(EXHIBITS)))
    with_picks = Bool(False)
    app = Instance(RestorationApp, allow_none=True)

    def __init__(self, **settings):
        self._works = {}  # what has been done on each section in this kernel, by its name
        self._aside = None  # work on a section of the user's own, with that section and its source
        self._is_chosen = bool({"choice", "with_picks"} & settings.keys())
        super().__init__([KeyGuard(), self._made_head()], **settings)
        keep_order(self)
        bind_control(self, "choice", self._chooser)
        bind_control(self, "with_picks", self._picked)
        self._open()
        self.observe(self._take_choice, ("choice", "with_picks"))
        self._storage.observe(self._take_found, "found")
        self._storage.observe(self._take_trouble, "trouble")

    @property
    def exhibit(self) -> Exhibit:
        """What is chosen."""
        return EXHIBITS[self.choice]

    def close(self) -> None:
        """Stop what is in progress, take everything off the screen, and free its memory; what you did stays kept."""
        if self.comm is not None:  # else it was closed before, or never opened
            self._leave()
        super().close()

    def start_over(self) -> None:
        """Clear what was done on this section; undo, or the button that appears, brings it back."""
        if self.app is None:
            return
        done, section, source = _work_in(self.app)
        fresh = self._fresh if self._is_here(self.app) else replace(self._fresh, drawing=Drawing())
        self._put(fresh, section, source)
        self.notice.ask(STARTED_OVER, {RETURN: lambda: self._put(done, section, source)})

    def _repr_mimebundle_(self, **kwargs):
        """Beside the gallery itself the app's picture, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**(self.app._repr_mimebundle_() if self.app else {}), **bundle}

    def _made_head(self):
        options = [(exhibit.title, name) for name, exhibit in EXHIBITS.items()]
        self._chooser = Dropdown(options=options, description="Section", layout=Layout(width="300px"))
        self._picked = Checkbox(description="with an interpreter's picks", indent=False, layout=Layout(width="auto"))
        self._anew = Button(
            description="Start over", icon="eraser", tooltip="Clear what you did here", layout=Layout(width="auto")
        )
        self._anew.on_click(lambda _: self.start_over())
        self._text = HTML(layout=Layout(min_width="0"))
        self._warning = HTML(layout=Layout(display="none"))
        self.notice, self._storage = Question(), BrowserStorage()
        wrapped = Layout(flex_flow="wrap", grid_gap="0 16px")
        controls = HBox([self._chooser, self._picked, self._anew, self._text], layout=wrapped)
        self._head = VBox([controls, self.notice, self._warning, self._storage])
        return self._head

    def _take_choice(self, change):
        self._is_chosen = True
        self._keep_text(CHOSEN, json.dumps({"choice": self.choice, "with_picks": self.with_picks}))
        if self.app is None or self._name != self._wanted():
            self._open()

    def _wanted(self):
        """The name under which the work on what is chosen is kept."""
        return f"{self.choice}, with picks" if self.with_picks and self.exhibit.has_picks else self.choice

    def _open(self):
        try:
            self._leave()
        except DataError as error:  # its session cannot be saved; here the work is kept
            self._warn(str(error))
        self._picked.disabled, self._anew.disabled = not self.exhibit.has_picks, True
        self._say(HINT, WAIT)
        try:
            found = self.exhibit.load()
        except DataError as error:
            self._say(TROUBLE, f"{self.exhibit.title} is not here. {error}")
        else:
            self._show(found)
            if self._aside is not None:
                asked = SET_ASIDE.format(self._aside[1].name or "another section")
                self.notice.ask(f"{self.notice.text} {asked}".strip(), {RETURN: self._return})

    def _show(self, found):
        self._name = self._wanted()
        self._section = found if isinstance(found, Section) else found.section
        self._sha256 = section_sha256(self._section)
        self._source = self.exhibit.source
        self.app = self._made(found)
        self._fresh = Work.of(self.app)
        self._bring_back()
        observe_work(self.app, self._keep)
        self.children = (*self.children[:2], self.app)
        self._say(HINT, " ".join(filter(None, (self.exhibit.text, _credit(self.app.section)))))

    def _made(self, found):
        if isinstance(found, Section) or not self.with_picks:
            return RestorationApp(self._section, source=self._source)
        return RestorationApp(found.section, found.interpretation, fixed=found.fixed, source=self._source)

    def _leave(self):
        """Take the app off, and give up its restoration; what was drawn on a section of the user's own is set aside."""
        self.notice.hint("")
        if self.app is None:
            return
        app, self.app = self.app, None
        if not self._is_here(app) and app.picker.drawing != Drawing():
            self._aside = _work_in(app)
        self.children = self.children[:2]
        app.close()
        del app
        gc.collect()  # the section is large, and Python would not hurry: most of what refers to it is in circles

    def _return(self):
        aside, self._aside = self._aside, None
        self._put(*aside)

    def _is_here(self, app):
        """Whether the app shows the section that is chosen: another one can be opened in its tab File."""
        return app.section is self._section

    def _put(self, work, section, source):
        """Show some work in the app, and keep it if it is of the section that is chosen."""
        work.put(self.app, section, source)
        self._keep()

    def _keep(self, change=None):
        """Keep the work as it is now, unless it is that of a fresh app."""
        if self.app is None or not self.app.workspace.settled:
            return
        here, work = self._is_here(self.app), Work.of(self.app)
        self._anew.disabled = here and work == self._fresh
        if here:
            self._hold(work)

    def _hold(self, work):
        if work == self._fresh:
            self._works[self._name] = None  # known, unlike what the browser may have kept
            self._keep_text(self._name, None)
            return
        self._works[self._name] = work
        try:
            self._keep_text(self._name, work.text(self._section, self._sha256, self._source))
        except SeiswidgetsError as error:
            self._warn(str(error))
        else:
            self._take_trouble()

    def _keep_text(self, name, text):
        """Have the browser keep a text under a name, or nothing."""
        others = {other: kept for other, kept in self._storage.kept.items() if other != name}
        self._storage.kept = others if text is None else {**others, name: text}

    def _bring_back(self):
        """Show what was done on the section before, if anything was."""
        try:
            work = self._known()
        except SeiswidgetsError:
            self.notice.alert(DAMAGED)
            return
        if work is None or work == self._fresh:
            return
        work.put(self.app, self._section, self._source)
        self.app.workspace.history.forget()  # or undo would clear it all
        self.app.picker.refresh()
        self._keep()
        self.notice.hint(BACK if work.drawing != self._fresh.drawing else SETTINGS_BACK)

    def _known(self):
        """The work on this section, from this kernel or from the browser; None if there is none."""
        if self._name in self._works:
            return self._works[self._name]
        text = (self._storage.found or {}).get(self._name)
        return None if text is None else Work.read(text, self._section)

    def _take_found(self, change):
        """Show what the browser had kept, unless the user has begun something else here."""
        if self.app is not None and Work.of(self.app) != self._fresh:
            return
        chosen = None if self._is_chosen else _chosen(change.new.get(CHOSEN, ""))
        if chosen and chosen != (self.choice, self.with_picks):
            with self.hold_trait_notifications():
                self.choice, self.with_picks = chosen
        elif self.app is not None:
            self._bring_back()

    def _take_trouble(self, change=None):
        trouble = self._storage.trouble
        self._warn(UNKEPT.format(trouble) if trouble else "")

    def _warn(self, text):
        self._warning.value = TROUBLE.format(escape(text))
        self._warning.layout.display = "" if text else "none"

    def _say(self, look, text):
        self._text.value = look.format(escape(text))


def _work_in(app):
    """The work in an app, with its section and where that comes from."""
    return Work.of(app), app.section, app.source


def _chosen(text):
    """Which section was chosen, with its picks or without; None if a text does not say so."""
    try:
        kept = json.loads(text)
        choice, with_picks = kept["choice"], kept["with_picks"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return (choice, with_picks) if isinstance(with_picks, bool) and choice in list(EXHIBITS) else None


def _credit(section):
    return f"Credit: {section.credit}." if section.credit else ""
