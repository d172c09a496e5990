"""Sections shown in the gallery."""

from collections.abc import Callable
from dataclasses import dataclass

from seiswidgets.geology import synthetic
from seiswidgets.geology.section import Section
from seiswidgets.geology.synthetic import Synthetic
from seiswidgets.io import datasets
from seiswidgets.io.session.sources import DATASET, SYNTHETIC, SectionSource


@dataclass(frozen=True)
class Exhibit:
    """A section of the gallery: its title, the function that loads it, and a sentence about it."""

    title: str
    load: Callable[[], Synthetic | Section]
    text: str

    @property
    def has_picks(self) -> bool:
        """True if the section comes with an interpreter's picks, as synthetic ones do."""
        return self.load.__module__ == synthetic.__name__

    @property
    def source(self) -> SectionSource:
        """Origin of the section."""
        return SectionSource(SYNTHETIC if self.has_picks else DATASET, self.load.__name__)


EXHIBITS = {
    exhibit.load.__name__: exhibit
    for exhibit in (
        Exhibit("Dome, cut by a fault", synthetic.faulted_fold, "Unfault it, then flatten it: the two steps in one."),
        Exhibit("Straight fault", synthetic.planar_fault, "The hanging wall slid down; a shift restores it."),
        Exhibit("Listric fault", synthetic.listric_fault, "The hanging wall rotated as it slid along an arc."),
        Exhibit("Graben", synthetic.graben, "Two faults, and between them a block that subsided."),
        Exhibit("Dominoes", synthetic.domino, "Parallel faults between blocks that rotated together."),
        Exhibit("Blind fault", synthetic.blind_fault, "Both tips of the fault lie inside the section."),
        Exhibit("Folds", synthetic.sine_fold, "No fault: one horizon is enough to flatten it."),
        Exhibit("Thrust", synthetic.thrust, "A sheet slid along a floor and up a ramp, and bent at its foot."),
        Exhibit("Fault-bend fold", synthetic.fault_bend_fold, "A sheet slid over a ramp, and folded at its bends."),
        Exhibit("Parallel fold", synthetic.flexural_fold, "Beds slipped past each other and kept their lengths."),
        Exhibit("F3, Dutch North Sea", datasets.f3, "A real section in two-way time; small faults at the lower left."),
        Exhibit("Teapot Dome, Wyoming", datasets.teapot, "A real section in two-way time; one fault in the middle."),
    )
}
