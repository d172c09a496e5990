"""The app with a choice of the sections that come with the package."""

from collections.abc import Callable
from dataclasses import dataclass
from html import escape

from ipywidgets import HTML, Checkbox, Dropdown, HBox, Layout, VBox
from traitlets import Bool, Enum, Instance

from seiswidgets.errors import DataError
from seiswidgets.geology import synthetic
from seiswidgets.geology.section import Section
from seiswidgets.geology.synthetic import Synthetic
from seiswidgets.io import datasets
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.binding import bind_control
from seiswidgets.widgets.messages import HINT, TROUBLE

WAIT = "Looking for this section; the first time it may have to be fetched."


@dataclass(frozen=True)
class Exhibit:
    """A section of the gallery: what it is called, how it is made, and what is to be seen in it."""

    title: str
    load: Callable[[], Synthetic | Section]
    text: str

    @property
    def has_picks(self) -> bool:
        """Whether it comes with the picks of an interpreter: those made by computer do."""
        return self.load.__module__ == synthetic.__name__


EXHIBITS = {
    exhibit.load.__name__: exhibit
    for exhibit in (
        Exhibit("Dome, cut by a fault", synthetic.faulted_fold, "Unfault it, then flatten it: the two steps in one."),
        Exhibit("Straight fault", synthetic.planar_fault, "Its hanging wall slid down; a shift brings it back."),
        Exhibit("Listric fault", synthetic.listric_fault, "Its hanging wall turned as it slid along an arc."),
        Exhibit("Graben", synthetic.graben, "Two faults, and between them a block that sank."),
        Exhibit("Dominoes", synthetic.domino, "Parallel faults between blocks that turned together."),
        Exhibit("Blind fault", synthetic.blind_fault, "It dies out at both ends inside the section."),
        Exhibit("Folds", synthetic.sine_fold, "No fault: a horizon alone is enough to flatten it."),
        Exhibit("F3, Dutch North Sea", datasets.f3, "A real section in two-way time; small faults at its lower left."),
        Exhibit("Teapot Dome, Wyoming", datasets.teapot, "A real section in two-way time; one fault in its middle."),
    )
}


class Gallery(VBox):
    """The restoration app with a choice of sections: seven made by computer, whose truth is known, and two real ones.

    Parameters
    ----------
    **settings
        Initial values of the attributes.

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
        options = [(exhibit.title, name) for name, exhibit in EXHIBITS.items()]
        chooser = Dropdown(options=options, description="Section", layout=Layout(width="300px"))
        self._picked = Checkbox(description="with an interpreter's picks", indent=False, layout=Layout(width="auto"))
        self._text = HTML(layout=Layout(min_width="0"))
        self._head = HBox([chooser, self._picked, self._text], layout=Layout(flex_flow="wrap", grid_gap="0 16px"))
        super().__init__([self._head], **settings)
        bind_control(self, "choice", chooser)
        bind_control(self, "with_picks", self._picked)
        self._open()
        self.observe(self._open, ("choice", "with_picks"))

    @property
    def exhibit(self) -> Exhibit:
        """What is chosen."""
        return EXHIBITS[self.choice]

    def close(self) -> None:
        """Stop what is under way, and take all off the screen."""
        self._leave()
        super().close()

    def _repr_mimebundle_(self, **kwargs):
        """Beside the gallery itself the app's picture, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**(self.app._repr_mimebundle_() if self.app else {}), **bundle}

    def _open(self, change=None):
        self._leave()
        self._picked.disabled = not self.exhibit.has_picks
        self._say(HINT, WAIT)
        try:
            found = self.exhibit.load()
        except DataError as error:
            self._say(TROUBLE, f"{self.exhibit.title} is not here. {error}")
            return
        self.app = self._made(found)
        self.children = (self._head, self.app)
        self._say(HINT, " ".join(filter(None, (self.exhibit.text, _credit(self.app.section)))))

    def _made(self, found):
        if isinstance(found, Section):
            return RestorationApp(found)
        if not self.with_picks:
            return RestorationApp(found.section)
        return RestorationApp(found.section, found.interpretation, fixed=found.fixed)

    def _leave(self):
        """Take the app off; its restoration, which may be under way, is given up."""
        if self.app is not None:
            self.children = (self._head,)
            self.app.close()
            self.app = None

    def _say(self, look, text):
        self._text.value = look.format(escape(text))


def _credit(section):
    return f"Credit: {section.credit}." if section.credit else ""
