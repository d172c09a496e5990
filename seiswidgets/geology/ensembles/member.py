"""One member of an ensemble: a hypothesis drawn from the uncertainty, restored and measured."""

import hashlib
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.bodies import Body
from seiswidgets.geology.ensembles.uncertainty import Perturbation, Uncertainty
from seiswidgets.geology.hypothesis import Hypothesis, with_slip
from seiswidgets.geology.measures import (
    Label,
    Measures,
    depths_along,
    measure_picks,
    measure_restoration,
)
from seiswidgets.geology.picks import IGNORE, Fault, Horizon
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section

NODES, POSITIONS = 2400, 101  # of the map of the area ratio, about, and along a restored horizon


@dataclass(frozen=True, eq=False)
class Member:
    """The measures of one hypothesis.

    Attributes
    ----------
    index : int
    values : array, shape (q,)
        By the labels of the study, NaN where there is none.
    depths : array, shape (h, p)
        Depth of each restored horizon along the section, in the unit of z.
    ratio : array, shape (nz, nx)
        Area ratio of all stages together, on a lattice over the present-day section.
    problem : str
        The reason why it has no restoration, "" if it has.
    """

    index: int
    values: np.ndarray
    depths: np.ndarray
    ratio: np.ndarray
    problem: str = ""


@dataclass(frozen=True, eq=False)
class Study:
    """Everything that the members of an ensemble are computed from, small enough to be sent with each.

    Restoring needs the section's geometry but not its amplitudes, which are left out.

    Parameters
    ----------
    drawn : Hypothesis
    uncertainty : Uncertainty
    seed : int
    """

    drawn: Hypothesis
    uncertainty: Uncertainty
    seed: int = 0

    def __post_init__(self) -> None:
        section = self.drawn.section
        bare = replace(section, amplitude=np.zeros(section.shape, np.float32), conversion=None)
        object.__setattr__(self, "drawn", replace(self.drawn, section=bare))

    @cached_property
    def perturbation(self) -> Perturbation:
        """Draws the hypotheses of members."""
        return Perturbation(self.drawn, self.uncertainty, self.seed)

    @cached_property
    def fingerprint(self) -> str:
        """Hash of everything that the members depend on."""
        drawn, section = self.drawn, self.drawn.section
        hashed = hashlib.sha256()
        geometry = (section.shape, section.extent, section.x_unit, section.z_unit, section.velocity)
        for item in (geometry, drawn.plan, self.uncertainty, self.seed):
            hashed.update(repr(item).encode())
        faults, horizons, bodies = (
            drawn.interpretation.faults,
            drawn.interpretation.horizons,
            drawn.interpretation.bodies,
        )
        picks: list[Fault | Horizon | Body] = [*faults, *horizons, *bodies]
        for pick in picks:
            lines = pick.pieces if isinstance(pick, Horizon) else (pick.points,)
            hashed.update(repr((pick.name, [getattr(pick, name, "") for name in ("use", "ends", "kind")])).encode())
            for line in lines:
                hashed.update(repr(line.shape).encode() + np.ascontiguousarray(line, float).tobytes())
        return hashed.hexdigest()

    @cached_property
    def reference(self) -> tuple[Measures, Restoration]:
        """Measures and restoration as drawn, with the likeliest matches; raises what its restoration raises."""
        drawn = with_slip(self.drawn, self.perturbation.likeliest)
        restored = drawn.restored()
        return measure_picks(drawn.interpretation) | measure_restoration(restored, drawn.interpretation), restored

    @cached_property
    def frame(self) -> "Frame":
        """The labels and positions that all members share."""
        measures, restored = self.reference
        horizons = [pick for pick in self.drawn.interpretation.horizons if pick.use != IGNORE]
        lines = [line for pick in horizons for line in restored.carried(pick)] if restored.stages else []
        reach = np.concatenate(lines)[:, 0] if lines else np.zeros(1)
        return Frame(
            tuple(measures),
            tuple(pick.name for pick in horizons) if lines else (),
            np.linspace(reach.min(), reach.max(), POSITIONS),
            _lattice(self.drawn.section) if restored.stages else np.empty((0, 0, 2)),
            _cutoffs(restored),
        )


@dataclass(frozen=True, eq=False)
class Frame:
    """Labels and positions that all members of an ensemble share.

    Attributes
    ----------
    labels : tuple of (quantity, about)
    horizons : tuple of str
    x : array, shape (p,)
        Where the depths of restored horizons are taken, in the unit of x.
    nodes : array, shape (nz, nx, 2)
        Where the area ratio is taken, in the present-day section.
    cutoffs : set of (fault, horizon)
        That each stage has brought together.
    """

    labels: tuple[Label, ...]
    horizons: tuple[str, ...]
    x: np.ndarray
    nodes: np.ndarray
    cutoffs: frozenset[tuple[int, str, str]] = frozenset()

    def member(self, index: int, measures: Measures, problem: str, restored: Restoration | None = None) -> Member:
        """A member with these measures; depths and area ratio are NaN without a restoration."""
        values = np.array([measures.get(label, np.nan) for label in self.labels])
        depths = np.full((len(self.horizons), len(self.x)), np.nan)
        return Member(index, values, depths, np.full(self.nodes.shape[:2], np.nan), problem)


def compute_member(study_and_frame: tuple[Study, Frame], index: int) -> Member:
    """Draw, restore and measure a member; what refuses it becomes its problem."""
    study, frame = study_and_frame
    measures: Measures = {}
    try:
        hypothesis = study.perturbation.hypothesis(index)
        measures = measure_picks(hypothesis.interpretation)
        restored = hypothesis.restored()
        problem = _problem(restored, frame)
        if not problem:
            return measured(hypothesis, restored, study, frame, index, measures)
    except SeiswidgetsError as error:
        problem = str(error)
    except Exception as error:  # noqa: BLE001 - one member in a thousand must not stop the others; it is listed
        problem = f"unexpected {type(error).__name__}: {error}"
    return frame.member(index, measures, problem)


def measured(
    hypothesis: Hypothesis, restored: Restoration, study: Study, frame: Frame, index: int, measures: Measures
) -> Member:
    """The member of a restoration that has settled."""
    if not restored.stages:
        return frame.member(index, measures, "")
    picks = hypothesis.interpretation
    member = frame.member(index, measures | measure_restoration(restored, picks), "")
    depths = [depths_along(restored.carried(picks.horizon(name)), frame.x) for name in frame.horizons]
    grown = hypothesis.section.dz / study.drawn.section.dz  # by another velocity
    ratio = restored.area_ratio_at(frame.nodes.reshape(-1, 2) * [1, grown]).reshape(member.ratio.shape)
    return replace(member, depths=np.array(depths).reshape(member.depths.shape), ratio=ratio)


def _problem(restored: Restoration, frame: Frame) -> str:
    """The reason why a restoration cannot be compared with that of the drawn picks; "" if it can."""
    unsettled = [index for index, stage in enumerate(restored.stages, 1) if not stage.report.converged]
    if unsettled:
        return f"step {unsettled[0]} did not settle in {restored.stages[unsettled[0] - 1].report.iterations} iterations"
    if restored.skipped:
        return restored.skipped[0].text
    lost = sorted(frame.cutoffs - _cutoffs(restored))
    if lost:
        return f"horizon {lost[0][2]!r} does not meet fault {lost[0][1]!r} on both sides any more"
    return ""


def _cutoffs(restored: Restoration) -> frozenset[tuple[int, str, str]]:
    return frozenset(
        (index, cutoff.fault, cutoff.horizon)
        for index, stage in enumerate(restored.stages)
        for cutoff in stage.report.cutoffs
    )


def _lattice(section: Section) -> np.ndarray:
    """Nodes over a section, the borders left out by half a cell of the lattice, shape (nz, nx, 2)."""
    x_min, x_max, z_min, z_max = section.extent
    counts = np.array(section.shape) * min(1.0, np.sqrt(NODES / np.prod(section.shape)))
    nz, nx = np.maximum(2, np.rint(counts)).astype(int).tolist()
    x = x_min + (np.arange(nx) + 0.5) * (x_max - x_min) / nx
    z = z_min + (np.arange(nz) + 0.5) * (z_max - z_min) / nz
    return np.stack(np.meshgrid(x, z), axis=-1)
