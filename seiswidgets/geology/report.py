"""What a stage of a restoration has achieved, in numbers with units."""

from dataclasses import dataclass
from html import escape

from seiswidgets.geology.findings import COLOURS, Finding, worst_first


@dataclass(frozen=True)
class CutOffReport:
    """Of one horizon at one fault: throw and heave before, and what parts the cut-offs after."""

    fault: str
    horizon: str
    throw: float
    heave: float
    misfit: float


@dataclass(frozen=True)
class SeamReport:
    """Of one fault: area of gap and of overlap between its sides before they are welded, and the widest of either."""

    fault: str
    gap: float
    overlap: float
    widest: float


@dataclass(frozen=True)
class BedReport:
    """Of one horizon: change of its length as a share of it, and its distance from the datum (RMS), if flattened."""

    horizon: str
    length_change: float
    flatness: float | None = None


@dataclass(frozen=True)
class Report:
    """What was achieved by a stage.

    Attributes
    ----------
    kind : "unfault" or "flatten"
    picks : tuple of str
        The names of the faults, or of the horizon.
    solver : str
    vertices, triangles : int
    iterations, factorisations : int
    converged : bool
        Whether the solver settled: no vertex moved by more than 1e-6 of the mesh spacing in its last step, or five
        steps of less than 1e-4 of it brought no gain.
    seconds : float
    energy : dict of str to float
        By term, in square metres, weights included.
    flipped : int
        Triangles turned over: always 0, since a stage that would turn any is refused.
    area_ratio : dict of int to float
        Percentiles, by area, of initial over final area; above 1 is compression.
    overlap : float
        Area of rock that lies on other rock after the step, in square metres; there the way back is not unique.
    cutoffs : tuple of CutOffReport
        Throw in the unit of z and heave in that of x, before; the misfit in metres, after.
    seams : tuple of SeamReport
        In square metres and metres.
    beds : tuple of BedReport
        Flatness in the unit of z.
    findings : tuple of Finding
        What the user should know, problems first: a solver that did not settle; cut-offs, contacts and levels that are
        more than a tenth of a sample off; rock on rock; beds that changed their length; faults that end inside.
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
    energy: dict
    flipped: int
    area_ratio: dict
    overlap: float = 0.0
    cutoffs: tuple = ()
    seams: tuple = ()
    beds: tuple = ()
    findings: tuple[Finding, ...] = ()
    x_unit: str = "m"
    z_unit: str = "m"

    def rows(self) -> list[tuple[str, str]]:
        """Return the report line by line, each a label and a text with its unit; findings follow the first line."""
        state = "settled" if self.converged else "did NOT settle"
        iterations = f"{self.iterations} iterations, {self.factorisations} factorisations, {self.seconds:.2f} s"
        rows = [
            (f"{self.kind} {', '.join(self.picks)}", f"{self.solver}: {state} in {iterations}"),
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

    def __str__(self):
        rows = self.rows()
        width = max(len(label) for label, _ in rows)
        return "\n".join(f"{label:<{width}}  {text}" for label, text in rows)

    def _repr_html_(self):
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
