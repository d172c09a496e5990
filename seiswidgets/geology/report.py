"""The report of a stage: what it has achieved, in numbers with units."""

from dataclasses import dataclass
from html import escape

from seiswidgets.geology.findings import COLOURS, Finding, worst_first

CONSTRAINTS = {"cut-off", "contact", "datum", "bed length", "overlap"}  # kinds of findings


@dataclass(frozen=True)
class CutOffReport:
    """Throw and heave of a horizon at a fault before the step, and the distance between its cut-offs after it."""

    fault: str
    horizon: str
    throw: float
    heave: float
    misfit: float


@dataclass(frozen=True)
class SeamReport:
    """Area of gap and of overlap between the sides of a fault before they are welded, and the widest of either."""

    fault: str
    gap: float
    overlap: float
    widest: float


@dataclass(frozen=True)
class BedReport:
    """Relative change of a horizon's length, and its RMS distance from the datum if it was flattened."""

    horizon: str
    length_change: float
    flatness: float | None = None


@dataclass(frozen=True)
class Observations:
    """Cut-offs, seams, beds and findings of a stage."""

    cutoffs: tuple[CutOffReport, ...] = ()
    seams: tuple[SeamReport, ...] = ()
    beds: tuple[BedReport, ...] = ()
    findings: tuple[Finding, ...] = ()


@dataclass(frozen=True)
class Report:
    """The achievements of a stage.

    Attributes
    ----------
    kind : "unfault" or "flatten"
    picks : tuple of str
        The names of the faults, or of the horizon.
    solver : str
    vertices, triangles : int
    iterations, factorisations : int
    converged : bool
        True if the solver settled: no vertex moved by more than 1e-6 of the mesh spacing in its last step, or five
        steps of less than 1e-4 of it brought no gain.
    seconds : float
    energy : dict of str to float
        By term, in square metres, weights included.
    flipped : int
        Number of triangles turned over: always 0, since a stage that would turn any is refused.
    area_ratio : dict of int to float
        Percentiles, by area, of initial over final area; above 1 is compression.
    overlap : float
        Area of rock that lies on other rock after the step, in square metres; there the inverse is not unique.
    cutoffs : tuple of CutOffReport
        Throw in the unit of z and heave in that of x, before; the misfit in metres, after.
    seams : tuple of SeamReport
        In square metres and metres.
    beds : tuple of BedReport
        Flatness in the unit of z.
    findings : tuple of Finding
        Observations worth showing, problems first: a solver that did not settle; cut-offs, contacts and levels that
        are more than a tenth of a sample off; rock on rock; beds that changed their length; faults that end inside.
    x_unit, z_unit : str
    """

    kind: str
    picks: tuple[str, ...]
    solver: str
    vertices: int
    triangles: int
    iterations: int
    factorisations: int
    converged: bool
    seconds: float
    energy: dict[str, float]
    flipped: int
    area_ratio: dict[int, float]
    overlap: float = 0.0
    cutoffs: tuple[CutOffReport, ...] = ()
    seams: tuple[SeamReport, ...] = ()
    beds: tuple[BedReport, ...] = ()
    findings: tuple[Finding, ...] = ()
    x_unit: str = "m"
    z_unit: str = "m"

    @property
    def unmet(self) -> tuple[str, ...]:
        """Texts of the findings about constraints that gave way: cut-offs, contacts, levels, lengths and room."""
        return tuple(finding.text for finding in self.findings if finding.kind in CONSTRAINTS)

    def rows(self) -> list[tuple[str, str]]:
        """Return the report line by line, each a label and a text with its unit; findings follow the first line."""
        outcome = "settled" if self.converged else "did NOT settle"
        iterations = f"{self.iterations} iterations, {self.factorisations} factorisations, {self.seconds:.2f} s"
        rows = [
            (f"{self.kind} {', '.join(self.picks)}", f"{self.solver}: {outcome} in {iterations}"),
            *((finding.severity, finding.text) for finding in worst_first(self.findings)),
            ("mesh", f"{self.vertices} vertices, {self.triangles} triangles, {self.flipped} flipped"),
            ("energy (m²)", ", ".join(f"{name} {value:.2g}" for name, value in self.energy.items())),
            ("area ratio", ", ".join(f"P{percent} {value:.3f}" for percent, value in self.area_ratio.items())),
        ]
        rows += [
            (
                f"{cutoff.horizon} at {cutoff.fault}",
                f"throw {cutoff.throw:.4g} {self.z_unit}, heave {cutoff.heave:.4g} {self.x_unit}; "
                f"cut-offs now {cutoff.misfit:.2g} m apart",
            )
            for cutoff in self.cutoffs
        ]
        rows += [
            (f"fault {seam.fault}", f"gap {seam.gap:.3g} m², overlap {seam.overlap:.3g} m², widest {seam.widest:.2g} m")
            for seam in self.seams
        ]
        for bed in self.beds:
            level = "" if bed.flatness is None else f", {bed.flatness:.2g} {self.z_unit} RMS from the datum"
            rows.append((f"horizon {bed.horizon}", f"bed length {bed.length_change:+.2%}{level}"))
        return rows

    def __str__(self) -> str:
        rows = self.rows()
        width = max(len(label) for label, _ in rows)
        return "\n".join(f"{label:<{width}}  {text}" for label, text in rows)

    def _repr_html_(self) -> str:
        cells = (
            f'<tr><th style="{_label_style(label)}">{escape(label)}</th>'
            f'<td style="text-align: left">{escape(text)}</td></tr>'
            for label, text in self.rows()
        )
        return f"<table>{''.join(cells)}</table>"


def _label_style(label: str) -> str:
    """CSS of a row's label; findings are coloured by severity."""
    fill, ink = COLOURS.get(label, ("", ""))
    return "text-align: left" + (f"; background: {fill}; color: {ink}" if fill else "")
