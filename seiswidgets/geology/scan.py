"""Scanning the slip along a fault: which slip makes its two walls match, and how sure that is."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from html import escape

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.warping import local_correlation
from seiswidgets.errors import Cancelled, SettingError
from seiswidgets.geology.correlation import Correlation
from seiswidgets.geology.fault_traces import FOOT, HANGING, FaultTraces, fault_traces
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.proposals import Proposal, proposals
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.slip_search import KINDS, WINDOW, Curve, Peak, SlipSearch
from seiswidgets.geology.tables import Table

MOST = 0.5  # of the fault's length: largest slip that is tried
CLOSE = 8.0  # slips per wavelength that are tried
UNRELATED = 3  # traces that chance is judged by
WORDS = {2: "two", 3: "three"}
RIVAL = 0.2  # likelihood, relative to the best, of a peak that cannot be excluded

Progress = Callable[[float], bool | None]


@dataclass(frozen=True, eq=False)
class Scan:
    """Slip along a fault against the correlation of its walls.

    Attributes
    ----------
    traces : FaultTraces
    curves : dict of str to Curve
        For slip that is "constant", "linear", "elliptic" or "varying" along the fault, and "piecewise" if intervals
        were given.
    proposals : tuple of Proposal
        Counterparts of the horizons that reach the fault on one side.
    findings : tuple of Finding
        Doubts: there is no credible match, or there are two that are about as likely.
    """

    traces: FaultTraces
    curves: Mapping[str, Curve]
    proposals: tuple[Proposal, ...] = ()
    findings: tuple[Finding, ...] = ()

    @property
    def fault(self) -> str:
        """Name of the fault."""
        return self.traces.name

    @property
    def best(self) -> Curve:
        """The curve whose highest peak explains the match with the fewest parameters, among credible ones if any."""
        credible = [curve for curve in self.curves.values() if curve.credible]
        return min(credible or self.curves.values(), key=lambda curve: curve.cost)

    @property
    def slip(self) -> np.ndarray:
        """Slips at the middle of the fault of the best curve, in metres, shape (k,)."""
        return self.best.slip

    @property
    def correlation(self) -> np.ndarray:
        """The correlation for each, shape (k,)."""
        return self.best.correlation

    @property
    def peaks(self) -> tuple[Peak, ...]:
        """Peaks of the best curve, the likeliest first."""
        return self.best.peaks

    @property
    def profile(self) -> SlipProfile:
        """The slip of the likeliest peak."""
        return self.best.peaks[0].profile

    @property
    def decided(self) -> bool:
        """True if there is a credible match, and no other one that is nearly as likely."""
        return not self.findings

    def profile_through(self, slip: float) -> SlipProfile:
        """The profile of the peak nearest to a slip at the middle of the fault, shifted to that slip."""
        nearest = min(self.peaks, key=lambda peak: abs(peak.slip - slip))
        shifted = np.asarray(nearest.profile.slip) + slip - nearest.slip
        return SlipProfile(nearest.profile.s, tuple(shifted.tolist()))

    @cached_property
    def local_correlation(self) -> np.ndarray:
        """Correlation in a window around each of ``traces.s``, for each slip, shape (k, n)."""
        s, width = self.traces.s, WINDOW * self.traces.wavelength / self.traces.step
        half = self.slip[:, None] / 2
        return local_correlation(self.traces.read(HANGING, s + half), self.traces.read(FOOT, s - half), width)

    def throw(self, s: ArrayLike, profile: SlipProfile | None = None) -> np.ndarray:
        """Vertical component of the slip at some positions, in the unit of z, positive for a normal fault.

        Of the likeliest profile unless another one is given.
        """
        return self.traces.offsets(s, profile or self.profile)[:, 1]

    def heave(self, s: ArrayLike, profile: SlipProfile | None = None) -> np.ndarray:
        """Horizontal component of the slip at some positions, in the unit of x, positive for a normal fault."""
        return self.traces.offsets(s, profile or self.profile)[:, 0]

    @property
    def table(self) -> Table:
        """The peaks of the best curve, with throw and heave at the middle of the fault."""
        section, middle = self.traces.section, [self.traces.length / 2]
        rows = tuple(
            (
                peak.slip,
                float(self.throw(middle, peak.profile)[0]),
                float(self.heave(middle, peak.profile)[0]),
                peak.correlation,
                float(peak.significance),
                peak.weight,
            )
            for peak in self.peaks
        )
        units = {"slip": "m", "throw": section.z_unit, "heave": section.x_unit}
        shares = dict.fromkeys(("correlation", "significance", "likelihood"), "1")
        return Table(f"Matches at fault {self.fault}, {self.best.kind} slip", {**units, **shares}, rows)

    def __repr__(self) -> str:
        return "\n".join([str(self.table), *(finding.text for finding in self.findings)])

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + "".join(f"<p>{escape(finding.text)}</p>" for finding in self.findings)


def scan(
    section: Section,
    fault: Fault,
    horizons: Horizon | Sequence[Horizon] = (),
    *,
    slips: ArrayLike | None = None,
    intervals: ArrayLike | None = None,
    gap: int = 2,
    width: int = 8,
    progress: Progress | None = None,
) -> Scan:
    """Try many slips along a fault, and see for which its two walls match.

    Slip that is constant, linear, elliptic (dying out at both ends) or varying along the fault gives a curve each of
    the best correlation against the slip at the middle of the fault. Slip that varies is found by dynamic programming
    over the whole fault, which keeps to one cycle of the reflections, and refined by least squares. No mesh is made.

    Parameters
    ----------
    section : Section
    fault : Fault
    horizons : list of Horizon
        Their counterparts across the fault are proposed.
    slips : array, optional
        Slips to try, in metres of rock along the fault, positive for a normal fault, in increasing order; by default up
        to half the fault's length, either way.
    intervals : array, optional
        Ends of intervals along the fault, in metres of rock from its upper end and in increasing order, such as the
        cut-offs of horizons: another curve is that of slip which is linear in each of them.
    gap, width : int
        As for `cross_fault_correlation`.
    progress : callable(share), optional
        Called with the share that is done; returning False cancels.

    Raises
    ------
    PickError
        If the fault lies outside the section, all amplitudes beside it are alike, or fewer than eight samples have data
        on both sides.
    SettingError
        If the slips are fewer than three, the ends of intervals fewer than two, or not in increasing order.
    Cancelled
        If ``progress`` returned False.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault(throw=150)
    >>> found = sw.scan(case.section, case.interpretation.faults[0])
    >>> [round(float(throw)) for throw in found.throw([500, 1000])]
    [150, 150]
    """
    traces = fault_traces(section, fault, gap, width)
    tried = _tried(traces, slips)
    ends = np.empty(0) if intervals is None else _increasing("intervals", intervals, 2)
    matching = SlipSearch(traces, traces.pair, tried, ends)
    chances = []
    for turn in range(UNRELATED):
        _report(progress, (turn + 1) / (UNRELATED + 2))
        upside_down = np.roll(traces.pair.second[::-1], turn * len(traces.s) // UNRELATED)
        chances.append(SlipSearch(traces, replace(traces.pair, second=upside_down), tried, ends).chances())
    _report(progress, (UNRELATED + 1) / (UNRELATED + 2))
    curves = {
        kind: matching.curve(kind, max(chance[kind] for chance in chances)) for kind in KINDS if kind in chances[0]
    }
    found = Scan(traces, curves)
    given = [horizons] if isinstance(horizons, Horizon) else list(horizons)
    counterparts = proposals(traces, found.profile, Correlation.of_profile(traces, found.profile), given)
    return replace(found, proposals=counterparts, findings=tuple(_findings(found)))


def _report(progress: Progress | None, share: float) -> None:
    if progress is not None and progress(share) is False:
        raise Cancelled("the scan was cancelled")


def _tried(traces: FaultTraces, slips: ArrayLike | None) -> np.ndarray:
    if slips is None:
        step = min(traces.wavelength / CLOSE, MOST * traces.length / 20)
        count = int(MOST * traces.length / step)
        return step * np.arange(-count, count + 1)
    return _increasing("slips", slips, 3)


def _increasing(name: str, values: ArrayLike, least: int) -> np.ndarray:
    try:
        numbers = np.asarray(values, float)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    if numbers.ndim != 1 or len(numbers) < least or not np.isfinite(numbers).all() or (np.diff(numbers) <= 0).any():
        raise SettingError(f"{name} must be {WORDS[least]} or more numbers in increasing order, in metres of rock")
    return numbers


def _findings(scan: Scan) -> list[Finding]:
    """Doubts about a scan: no credible match, or two that are nearly as likely."""
    best, first = scan.best, scan.peaks[0]
    x, z = scan.traces.points(np.array([scan.traces.length / 2]))[0].tolist()
    if not best.credible:
        text = (
            f"fault {scan.fault}: no slip matches its two sides credibly; the best correlation is "
            f"{first.correlation:.2f}, but unrelated rock reaches {best.chance:.2f} with {first.samples:.0f} "
            "independent samples. Match a horizon across it, or leave it undecided"
        )
        return [Finding("warning", "no match", text, scan.fault, (x, z))]
    rivals = [peak for peak in scan.peaks[1:] if peak.weight > RIVAL * first.weight]
    if rivals:
        slips = " or ".join(f"{peak.slip:.0f} m" for peak in (first, *rivals))
        text = (
            f"fault {scan.fault}: its two sides match about as well for a slip of {slips}; a second horizon, or the "
            "balance of the restoration, must decide"
        )
        return [Finding("warning", "undecided", text, scan.fault, (x, z))]
    return []
