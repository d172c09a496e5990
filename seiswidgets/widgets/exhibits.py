"""The sections that come with the package, as the gallery shows them."""

from collections.abc import Callable
from dataclasses import dataclass

from seiswidgets.geology import synthetic
from seiswidgets.geology.section import Section
from seiswidgets.geology.synthetic import Synthetic
from seiswidgets.io import datasets
from seiswidgets.io.session.sources import DATASET, SYNTHETIC, SectionSource


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

    @property
    def source(self) -> SectionSource:
        """Where the section comes from."""
        return SectionSource(SYNTHETIC if self.has_picks else DATASET, self.load.__name__)


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
