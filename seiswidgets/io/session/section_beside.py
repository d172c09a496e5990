"""Sessions of sections that come from no file: the section is kept beside its session."""

from dataclasses import dataclass
from pathlib import Path

from seiswidgets.geology.section import Section
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.session.session import Session
from seiswidgets.io.session.sources import FILE, SectionSource


@dataclass(frozen=True)
class SessionWithSection:
    """A session that writes its section too where that is not yet, so that it can be opened again.

    Parameters
    ----------
    session : Session
    section : Section
        That the session's source names as a file.
    """

    session: Session
    section: Section

    def save(self, path: Path) -> None:
        """Write the session, and before it its section.

        Raises
        ------
        DataError
            If either cannot be written.
        """
        beside = Path(self.session.source.name)
        if not beside.exists():
            save_section(self.section, beside)
        self.session.save(path)


def source_beside(path: Path, sha256: str) -> SectionSource:
    """Where a section of that hash is kept beside a session of that path: ``<stem>.section-<first digits>.npz``."""
    return SectionSource(FILE, str(path.with_name(f"{path.stem}.section-{sha256[:12]}.npz").absolute()))
