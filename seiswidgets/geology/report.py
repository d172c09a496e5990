"""The report of a stage: what it has achieved, in numbers with units."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from seiswidgets.geology.findings import COLOURS, Finding, worst_first

LEAST = 0.001  # metres between cut-offs that are worth a figure
CLOSED_FORM = "closed form"  # solver of a stage that needs none
CONSTRAINTS = {"cut-off", "slip", "contact", "datum", "bed length", "overlap"}  # kinds of findings


@dataclass(frozen=True)
class CutOffReport:
    """Throw and heave of a horizon at a fault before the step, and the distance between its cut-offs after it."""

    fault: str
    horizon: str
    throw: float
    heave: float
    misfit: float

    @property
    def sense(self) -> str:
        """The sense of the fault there: "normal" where the hanging wall lies deeper, "reverse" where it lies higher."""
        return "normal" if self.throw >= 0 else "reverse"


@dataclass(frozen=True)
class SeamReport:
    """Area of gap and of overlap between the sides of a fault before they are welded, and the widest of either."""

    fault: str
    gap: float
    overlap: float
    widest: float


@dataclass(frozen=True)
class SlipReport:
    """Least and largest slip prescribed along a fault, and the largest distance from it after the step, in metres."""

    fault: str
    least: float
    most: float
    misfit: float


@dataclass(frozen=True)
class BedReport:
    """Relative change of a horizon's length, and its RMS distance from the datum if it was flattened."""

    horizon: str
    length_change: float
    flatness: float | None = None


@dataclass(frozen=True)
class MotionReport:
    """Rigid motion of a block, or of a limb beside a fault that dies out, nearest to that of its rock.

    Attributes
    ----------
    part : str
        The faults that bound it, such as "hanging wall of F1".
    rotation : float
        In degrees, positive clockwise as the section is drawn, in true proportions.
    dx, dz : float
        Motion of its centre of area, in the units of x and z.
    where : (x, z)
        That centre before the step, in the section's units.
    """

    part: str
    rotation: float
    dx: float
    dz: float
    where: tuple[float, float]


@dataclass(frozen=True)
class BodyReport:
    """Area of a body before and after a step, in square metres of rock."""

    body: str
    before: float
    after: float


@dataclass(frozen=True)
class Observations:
    """Cut-offs, seams, beds, findings, prescribed slip and details of a stage: labels and texts, with units."""

    cutoffs: tuple[CutOffReport, ...] = ()
    seams: tuple[SeamReport, ...] = ()
    beds: tuple[BedReport, ...] = ()
    findings: tuple[Finding, ...] = ()
    slips: tuple[SlipReport, ...] = ()
    details: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Report:
    """The achievements of a stage.

    Attributes
    ----------
    kind : str
        "unfault", "flatten", "strip", "unerode", "decompact" or "isostasy".
    picks : tuple of str
        The names of the faults, or of the horizons.
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
        Percentiles, by area, of the area before over the area after the step: above 1, rock was compressed by
        restoring it, so that it was dilated in nature.
    overlap, gap : float
        Area of rock that lies on other rock after the step, where the inverse is not unique, and of holes that the step
        has opened between the blocks; in square metres.
    cutoffs : tuple of CutOffReport
        Throw in the unit of z and heave in that of x, before; the misfit in metres, after.
    seams : tuple of SeamReport
        In square metres and metres.
    beds : tuple of BedReport
        Flatness in the unit of z.
    slips : tuple of SlipReport
        In metres, of the faults whose slip was prescribed.
    motions : tuple of MotionReport
        Rigid motion of each block or limb, the largest first.
    bodies : tuple of BodyReport
        Areas in square metres.
    findings : tuple of Finding
        Observations worth showing, problems first: a solver that did not settle; cut-offs, contacts and levels that
        are more than a tenth of a sample off; rock on rock, and gaps; beds that changed their length; faults that end
        inside, or whose tip the section folds about; offsets that grow downwards.
    mesher : str
        "Triangle", or "CDT" where that is not installed.
    x_unit, z_unit : str
    sample : float
        Height of a sample, in metres.
    velocity : str
        Velocities that relate time to depth, and their source; "" for a section that was in depth.
    age : float, optional
        Time that the rock after the step stands for, in Ma.
    details : tuple of (str, str)
        What else the step did: labels, and texts with units.
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
    gap: float = 0.0
    cutoffs: tuple[CutOffReport, ...] = ()
    seams: tuple[SeamReport, ...] = ()
    beds: tuple[BedReport, ...] = ()
    motions: tuple[MotionReport, ...] = ()
    bodies: tuple[BodyReport, ...] = ()
    findings: tuple[Finding, ...] = ()
    slips: tuple[SlipReport, ...] = ()
    mesher: str = ""
    x_unit: str = "m"
    z_unit: str = "m"
    sample: float = 1.0
    velocity: str = ""
    age: float | None = None
    details: tuple[tuple[str, str], ...] = ()

    @property
    def unmet(self) -> tuple[str, ...]:
        """Texts of the findings about constraints that gave way: cut-offs, contacts, levels, lengths and room."""
        return tuple(finding.text for finding in self.findings if finding.kind in CONSTRAINTS)

    @property
    def verdict(self) -> str:
        """One sentence: whether the solver settled, what it achieved, and the worst problem or warning."""
        return verdict([self], self.findings)

    def rows(self) -> list[tuple[str, str]]:
        """Return the report line by line, each a label and a text with its unit.

        The verdict comes first, then the other findings, throw and heave, beds, areas and motions; the solver last.
        """
        when = "" if self.age is None else f" ({self.age:g} Ma)"
        rows = [(f"{self.kind} {', '.join(self.picks)}{when}", self.verdict)]
        rows += [(finding.severity, finding.text) for finding in self.findings if finding is not worst(self.findings)]
        rows += [(f"{cutoff.horizon} at {cutoff.fault}", self._offset(cutoff)) for cutoff in self.cutoffs]
        rows += [(f"slip of {slip.fault}", self._slip(slip)) for slip in self.slips]
        rows += [(f"horizon {bed.horizon}", self._bed(bed)) for bed in self.beds]
        rows += self.details
        percentiles = ", ".join(f"P{percent} {value:.3f}" for percent, value in self.area_ratio.items())
        rows.append(("area ratio, before / after", f"{percentiles}; above 1, restoring compressed the rock"))
        rows.append(("overlap and gaps", f"{self.overlap:.3g} m² of rock on other rock, {self.gap:.3g} m² of gaps"))
        rows += [(f"body {body.body}", self._body(body)) for body in self.bodies]
        rows += [("motion", self._motion(motion)) for motion in self.motions]
        rows += [("velocity", self.velocity)] * bool(self.velocity)
        return rows + self._solver_rows()

    def _offset(self, cutoff: CutOffReport) -> str:
        apart = f"{cutoff.misfit:.2g}" if cutoff.misfit >= LEAST else f"less than {LEAST:g}"
        return (
            f"{cutoff.sense}: throw {cutoff.throw:.4g} {self.z_unit}, heave {cutoff.heave:.4g} {self.x_unit}; "
            f"cut-offs now {apart} m apart"
        )

    def _slip(self, slip: SlipReport) -> str:
        apart = f"{slip.misfit:.2g}" if slip.misfit >= LEAST else f"less than {LEAST:g}"
        return f"prescribed, from {slip.least:.4g} to {slip.most:.4g} m; now met to {apart} m"

    def _bed(self, bed: BedReport) -> str:
        level = "" if bed.flatness is None else f", {bed.flatness:.2g} {self.z_unit} RMS from the datum"
        return f"bed length {bed.length_change:+.2%}{level}"

    def _body(self, body: BodyReport) -> str:
        change = body.after / body.before - 1 if body.before else 0.0
        return f"area {body.before:.4g} m² before, {body.after:.4g} m² after ({change:+.1%})"

    def _motion(self, motion: MotionReport) -> str:
        turn = f"{abs(motion.rotation):.1f}° {'clockwise' if motion.rotation >= 0 else 'anticlockwise'}"
        dx, dz = (0.0 if abs(shift) < LEAST * LEAST else shift for shift in (motion.dx, motion.dz))
        shift = f"{dx:+.3g} {self.x_unit} in x and {dz:+.3g} {self.z_unit} in z"
        return f"{motion.part}: turned by {turn}, moved by {shift}"

    def _solver_rows(self) -> list[tuple[str, str]]:
        mesh = f"{self.vertices} vertices, {self.triangles} triangles by {self.mesher}, {self.flipped} flipped"
        if self.solver == CLOSED_FORM:
            return [("solver", f"none: computed in closed form in {self.seconds:.2f} s"), ("mesh", mesh)]
        iterations = f"{self.iterations} iterations, {self.factorisations} factorisations, {self.seconds:.2f} s"
        return [
            *(
                (f"fault {seam.fault}", f"gap {seam.gap:.3g} m², overlap {seam.overlap:.3g} m² before welding")
                for seam in self.seams
            ),
            ("solver", f"{self.solver}: {'settled' if self.converged else 'did NOT settle'} in {iterations}"),
            ("mesh", mesh),
            ("energy (m²)", ", ".join(f"{name} {value:.2g}" for name, value in self.energy.items())),
        ]

    def __str__(self) -> str:
        rows = self.rows()
        width = max(len(label) for label, _ in rows)
        return "\n".join(f"{label:<{width}}  {text}" for label, text in rows)

    def _repr_html_(self) -> str:
        (label, text), *rows = self.rows()
        grave = worst(self.findings)
        cells = [_row(label, text, grave.severity if grave else ""), *(_row(*row, row[0]) for row in rows)]
        return f"<table>{''.join(cells)}</table>"


def verdict(reports: Sequence[Report], findings: Sequence[Finding]) -> str:
    """One sentence on some stages: whether all settled, what they achieved, and the worst problem or warning."""
    settled = "Settled" if all(report.converged for report in reports) else "Not settled"
    outcome, grave = settled if reports else "Nothing has been restored yet", worst(findings)
    doubt = [f"but {grave.text.removesuffix('.')}"] if grave else []
    return "; ".join([outcome, *achievements(reports), *doubt]) + ("" if doubt and doubt[0].endswith("?") else ".")


def achievements(reports: Sequence[Report]) -> list[str]:
    """How well cut-offs meet and the last flattened horizon lies, in samples."""
    misfits = [cutoff.misfit / report.sample for report in reports for cutoff in report.cutoffs]
    level = [bed for report in reports[-1:] for bed in report.beds if bed.flatness is not None]  # later stages may bend
    return [
        *([f"cut-offs meet to {_rounded(max(misfits))} samples"] if misfits else []),
        *(f"{bed.horizon} lies on its datum to {_rounded(bed.flatness or 0)} {reports[-1].z_unit}" for bed in level),
    ]


def _rounded(value: float) -> str:
    return f"{max(value, 0.01):.1g}"


def worst(findings: Sequence[Finding]) -> Finding | None:
    """The first of the gravest findings; None if all are notes."""
    first = next(iter(worst_first(findings)), None)
    return first if first and first.severity != "note" else None


def _row(label: str, text: str, severity: str) -> str:
    """HTML of a row; the label of a finding is coloured by its severity."""
    fill, ink = COLOURS.get(severity, ("", ""))
    style = "text-align: left" + (f"; background: {fill}; color: {ink}" if fill else "")
    cells = f'<th style="{style}">{escape(label)}</th><td style="text-align: left">{escape(text)}</td>'
    return f"<tr>{cells}</tr>"
