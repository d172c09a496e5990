"""The curve of correlation against the slip along a fault, and profiles along the fault, in the browser."""

from collections.abc import Callable
from typing import Any

import anywidget
import numpy as np
from traitlets import Dict, Float, List, Unicode

from seiswidgets.geology.correlation import Correlation
from seiswidgets.geology.fault_traces import FaultTraces
from seiswidgets.geology.scan import Scan
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.slip_search import VARYING
from seiswidgets.widgets.assets import asset

POINTS = 120  # of a profile


class MatchChart(anywidget.AnyWidget):
    """A chart on which the slip of a fault is dragged: correlation, and faintly deformation, against slip.

    With the keyboard: the arrows change the slip, with Shift by ten steps, Page Up and Page Down go to the next peak,
    Enter to the likeliest. Beside it are throw, heave and correlation along the fault, at the depths that the panes
    show.

    Attributes
    ----------
    curve, profile : dict
        The drawings; empty before a scan.
    span : list
        First and last z that the profiles show.
    slip : float or None
        The present match, at the middle of the fault, in metres.
    summary : str
        Text above.
    """

    _esm = asset("match_chart.js")
    _css = asset("match_chart.css")

    curve = Dict().tag(sync=True)
    profile = Dict().tag(sync=True)
    span: List[float] = List([0.0, 1.0]).tag(sync=True)
    slip = Float(None, allow_none=True).tag(sync=True)
    summary = Unicode().tag(sync=True)

    def on_slide(self, callback: Callable[[float, bool], None]) -> None:
        """Call a function with a slip that the user chooses, and False while it is still being dragged."""

        def take(_: object, message: dict[str, Any], __: object) -> None:
            if message.get("kind") == "slide" and np.isfinite(message["slip"]):
                callback(float(message["slip"]), bool(message["settled"]))

        self.on_msg(take)

    def show(self, scan: Scan | None, deformation: list[tuple[float, float]] | None = None) -> None:
        """Show the best curve of a scan, and the mean strain for some slips; None for nothing."""
        self.curve = {} if scan is None else _curve(scan, deformation or [])

    def show_profile(self, traces: FaultTraces | None, profile: SlipProfile | None) -> None:
        """Show throw, heave and correlation of a slip along a fault; None for nothing."""
        self.profile = {} if traces is None or profile is None else _profile(traces, profile)


def _curve(scan: Scan, deformation: list[tuple[float, float]]) -> dict[str, Any]:
    sample = scan.traces.section.dz * float(scan.traces.section.metres[1])
    peaks = [peak for peak in scan.peaks if scan.slip[0] <= peak.slip <= scan.slip[-1]]
    points = dict(zip(scan.slip.tolist(), np.clip(scan.correlation, -1, 1).round(4).tolist(), strict=True))
    if scan.best.kind != VARYING:  # whose curve is of another measure
        points |= {peak.slip: round(peak.correlation, 4) for peak in peaks}
    slip, correlation = zip(*sorted(points.items()), strict=True)
    return {
        "slip": slip,
        "correlation": correlation,
        "peaks": [{"slip": peak.slip, "correlation": peak.correlation, "weight": peak.weight} for peak in peaks],
        "deformation": [[slip, percent] for slip, percent in deformation if np.isfinite(percent)],
        "chance": scan.best.chance,
        "step": sample,
    }


def _profile(traces: FaultTraces, profile: SlipProfile) -> dict[str, Any]:
    section = traces.section
    match = Correlation.of_profile(traces, profile)
    rows = np.linspace(0, len(match.s) - 1, min(POINTS, len(match.s))).astype(int)
    s = match.s[rows]
    heave, throw = traces.offsets(s, profile).T
    titles = f"throw ({section.z_unit})", f"heave ({section.x_unit})", "correlation"
    quantity = "Time" if section.is_time else "Depth"
    return {
        "z": traces.points(s)[:, 1].tolist(),
        "title": f"{quantity} ({section.z_unit})",
        "lines": [_line(*one) for one in zip(titles, (throw, heave, match.local[rows]), strict=True)],
    }


def _line(title: str, values: np.ndarray) -> dict[str, Any]:
    least, most = (-1.0, 1.0) if title == "correlation" else (min(0.0, values.min()), max(0.0, values.max()))
    most = most if most > least else least + 1
    return {"title": title, "values": values.round(4).tolist(), "least": float(least), "most": float(most)}
