"""Summary of a section file, made without reading all of it."""

from dataclasses import dataclass
from pathlib import Path

from seiswidgets.geology.findings import Finding

TIME_OR_DEPTH = "z_unit or velocity"  # an entry of ``needed``: either will do


@dataclass(frozen=True)
class SectionInfo:
    """Contents of a section file before it is opened: enough to choose the options that it needs.

    Attributes
    ----------
    path : Path
    kind : "SEG-Y", "picture", "array" or "text"
    format : str
        Sample format in words: "IBM float, 4 bytes, big-endian".
    size : int
        Size of the file, in bytes.
    shape : (int, int)
        Number of samples and traces, (nz, nx), of the whole file.
    needed : tuple of str
        Options that ``open_section`` needs besides the path; "z_unit or velocity" where either will do.
    dx, dz, z0 : float or None
        What the file states: dx in the unit of its positions, dz and z0 in ms of time or m of depth.
    x_unit : str or None
    inlines, crosslines : (first, last, count) or None
        Lines of a volume.
    header : str
        SEG-Y's textual header, decoded. Untrusted text: escape it wherever it is shown.
    findings : tuple of Finding
        A "problem" says why a spacing or an origin cannot be determined (positions that are missing or uneven, for
        example), a "warning" why one is doubtful.
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
    findings: tuple[Finding, ...] = ()

    def middle(self, name: str) -> int | None:
        """Number of a volume's middle inline or crossline, or None if the file is not a volume."""
        lines = {"inline": self.inlines, "crossline": self.crosslines}[name]
        if lines is None:
            return None
        first, last, count = lines
        return round(first + count // 2 * (last - first) / max(count - 1, 1))
