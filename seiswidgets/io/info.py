"""Summary of a section file, made without reading all of it."""

from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap

from seiswidgets.geology.findings import Finding

TIME_OR_DEPTH = "z_unit or velocity"  # an entry of ``needed``: either will do


@dataclass(frozen=True, repr=False)
class SectionInfo:
    """Contents of a section file before it is opened: enough to choose the options that it needs.

    Printed, it is a summary of a few lines, without the textual header.

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
    offsets : (first, last, count) or None
        Offsets of traces before stack, of which one must be chosen.
    sample_formats : tuple of str
        If the sample format is doubtful: the likely one, and the one that the header states.
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
    offsets: tuple[int, int, int] | None = None
    sample_formats: tuple[str, ...] = ()
    header: str = ""
    findings: tuple[Finding, ...] = ()

    @property
    def facts(self) -> tuple[str, ...]:
        """The contents in a few phrases."""
        samples, traces = self.shape
        texts = [
            f"{self.kind} ({self.format}), {readable_size(self.size)}",
            f"{traces:,} traces of {samples:,} samples",
        ]
        for name in ("inlines", "crosslines", "offsets"):
            lines = getattr(self, name)
            texts += [f"{lines[2]:,} {name}, {lines[0]} to {lines[1]}"] if lines else []
        where = " along the first line" if self.inlines else ""
        texts += [f"traces {self.dx:g} {self.x_unit} apart{where}"] if self.dx is not None else []
        texts += [f"samples {self.dz:g} ms (or m) apart"] if self.dz is not None else []
        texts += [f"first sample at {self.z0:g} ms (or m)"] if self.z0 else []
        return tuple(texts)

    def __repr__(self) -> str:
        rows = [f"{self.path.name}: {'; '.join(self.facts)}"]
        rows += [f"needs {', '.join(self.needed)}"] if self.needed else []
        rows += [f"{finding.severity}: {finding.text}" for finding in self.findings]
        rows += [f"textual header of {len(self.header):,} characters in .header"] if self.header else []
        return "\n".join(line for row in rows for line in wrap(row, 100, subsequent_indent="  "))

    def middle(self, name: str) -> int | None:
        """Number of a volume's middle inline or crossline, or None if the file is not a volume."""
        lines = {"inline": self.inlines, "crossline": self.crosslines}[name]
        if lines is None:
            return None
        first, last, count = lines
        return round(first + count // 2 * (last - first) / max(count - 1, 1))


def readable_size(size: int) -> str:
    """A number of bytes in KiB or MiB."""
    return f"{size / 2**20:.1f} MiB" if size >= 2**20 else f"{size / 2**10:.1f} KiB"
