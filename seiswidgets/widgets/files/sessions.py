"""The work in an app as a session, and the picks of a session as a drawing."""

from pathlib import Path

from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import FAULT, HORIZON, Drawing
from seiswidgets.io.session.saved_picks import SavedPick
from seiswidgets.io.session.session import Session, SessionWithSection, source_beside
from seiswidgets.io.session.sources import SectionSource


def session_of(
    drawing: Drawing, plan, section: Section, sha256: str, source: SectionSource | None, path: Path
) -> Session | SessionWithSection:
    """What is drawn and planned on a section, to be saved under a path; a line under way is left out.

    A section without a source is saved with it.
    """
    picks = (_saved(drawing, FAULT), _saved(drawing, HORIZON), drawing.fixed, plan)
    if source is not None:
        return Session(source, sha256, *picks)
    return SessionWithSection(Session(source_beside(path, sha256), sha256, *picks), section)


def _saved(drawing, kind):
    picks = (pick for pick in drawing.picks if pick.kind == kind)
    return tuple(SavedPick(pick.name, pick.pieces, pick.colour, pick.visible) for pick in picks)


def drawing_of(session: Session) -> Drawing:
    """The picks of a session, with their looks, even those that cannot be used."""
    drawing = Drawing(fixed=session.fixed)
    for kind, picks in ((FAULT, session.faults), (HORIZON, session.horizons)):
        for pick in picks:
            drawing = drawing.with_pick(kind, pick.name, pick.pieces, pick.colour, pick.visible)
    return drawing
