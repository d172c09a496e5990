"""What a file holds, as far as can be told without reading it all."""

from dataclasses import dataclass
from pathlib import Path

HEIGHT = "z_unit or velocity"  # what may be needed: either will do


@dataclass(frozen=True)
class SectionInfo:
    """What a file holds, before it is opened: enough for a user to make the choices that it takes.

    Attributes
    ----------
    path : Path
    kind : "SEG-Y", "picture", "array" or "text"
    format : str
        Of its samples, in words: "IBM float, 4 bytes, big-endian".
    size : int
        Of the file, in bytes.
    shape : (int, int)
        Samples and traces, (nz, nx), of all of it.
    needed : tuple of str
        The choices that ``open_section`` needs beside the path; "z_unit or velocity" where either will do.
    dx, dz, z0 : float or None
        Where the file says so: in the unit of its positions; and in ms of time, or m of depth.
    x_unit : str or None
    inlines, crosslines : (first, last, count) or None
        Of a volume.
    header : str
        SEG-Y's textual header, decoded; lines of a stranger, to be escaped wherever they are shown.
    reasons : tuple of str
        Why a spacing or an origin cannot be told: positions that are missing, uneven or implausible, say.
    notes : tuple of str
        What was read in another way than the headers claim, or is unusual.
    """

    path: Path
    kind: str
    format: str
    size: int
    shape: tuple[int, int]
    needed: tuple[str, ...] = ()
    dx: float | None = None
    dz: float | None = None
    z0: float | None = None
    x_unit: str | None = None
    inlines: tuple[int, int, int] | None = None
    crosslines: tuple[int, int, int] | None = None
    header: str = ""
    reasons: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def middle(self, name: str) -> int | None:
        """The number of the inline or the crossline in the middle of a volume; None where there is no telling."""
        lines = {"inline": self.inlines, "crossline": self.crosslines}[name]
        if lines is None:
            return None
        first, last, count = lines
        return round(first + count // 2 * (last - first) / max(count - 1, 1))
