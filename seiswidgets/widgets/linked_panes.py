"""The present-day section and the restored one, side by side."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from ipywidgets import HTML, GridBox, Layout, VBox, jslink
from traitlets import Bool, Bunch, Float, Instance, List, observe, validate

from seiswidgets.core.deformation import USUAL_SPAN
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import FADED, RatioColouring, checked_span, clip_limit
from seiswidgets.interaction.drawing import Point
from seiswidgets.interaction.overlay import Overlay
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.ipycanvas_compat import hold_canvases
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.section_view.still import still
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.verdict import Verdict

PRESENT_DAY, RESTORED, NOT_RESTORED = "Present day", "Restored", "Not restored yet"
SLACK = 0.005  # share of the window by which rock may reach beyond the frame before the frame grows
READOUT = (
    '<div style="font-variant-numeric: tabular-nums; min-height: 1.4em; line-height: 1.4; white-space: nowrap; '
    'overflow: hidden; text-overflow: ellipsis">{}</div>'
)
HEADING = '<div style="font-weight: 600; padding-left: 64px">{}</div>'
BRUSHED_ALONE = 0.6  # opacity of what is brushed while the map itself is not shown
SHARED = ("colours", "clip", "gain", "polarity", "height")


@dataclass(frozen=True)
class Reading:
    """The values at the pointer.

    Attributes
    ----------
    original, restored : tuple (x, z)
        Its point in either section; NaN where there is none.
    amplitude : float
        Amplitude of the nearest sample of the original.
    ratio : float
        Area ratio, present-day over restored, of all stages together.
    """

    original: Point
    restored: Point
    amplitude: float
    ratio: float

    def text(self, section: Section) -> str:
        """Text of the readout, in the units of a section."""
        height = "two-way time" if section.is_time else "depth"
        parts = [
            f"{name}: x {x:.6g} {section.x_unit}, {height} {z:.6g} {section.z_unit}"
            for name, (x, z) in (("present day", self.original), ("restored", self.restored))
            if np.isfinite((x, z)).all()
        ]
        if np.isfinite(self.amplitude):
            parts.append(f"amplitude {self.amplitude:.3g}")
        if np.isfinite(self.ratio):
            parts.append(f"area ratio {self.ratio:.3f}")
        return " &ensp;·&ensp; ".join(parts) or "no rock here"


class LinkedPanes(WithParts, VBox):
    """Two panes: the cursor in one shows at once at its mapped point in the other.

    Parameters
    ----------
    restoration : Restoration or Section
    height : int
        Height of each pane in css pixels.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    restoration : Restoration
        The restoration shown; may be set.
    original, restored : SectionPane
        The panes. Colours, clip, gain and polarity of the first apply to both.
    zoom_linked : bool
        True to show the same window in both panes.
    deformation, mesh : float
        Opacity of the area ratio's colours and of the mesh, from 0 to 1.
    span : float
        The colours of the area ratio run from 1 / span to span.
    brush : list
        Smallest and largest area ratio to highlight, or empty; highlighted even if the opacity is 0.
    readout : HTML
        Line with the values at the pointer.

    Raises
    ------
    TypeError
        If a keyword does not exist.
    """

    restoration = Instance(Restoration)
    zoom_linked = Bool(False)
    deformation = Float(0.0, min=0.0, max=1.0)
    mesh = Float(0.0, min=0.0, max=1.0)
    span = Float(USUAL_SPAN)
    brush: List[float] = List()

    def __init__(self, restoration: Restoration | Section, *, height: int = 420, **settings: Any):
        self.check_settings(settings)
        if isinstance(restoration, Section):
            restoration = Restoration(restoration)
        section = restoration.original
        self.original, self.restored = (SectionPane(section, height=height) for _ in range(2))
        self._snapshot: Snapshot | None = None  # until the restoration is taken
        self._readers: list[Callable[[Reading | None], None]] = []
        self._links: list[object] = []
        self.restored.projection = self.projection
        self.readout = HTML(READOUT.format(""))
        self._link_panes()
        headed = (PRESENT_DAY, self.original), (RESTORED, self.restored)
        columns = [VBox([HTML(HEADING.format(title)), pane]) for title, pane in headed]
        panes = GridBox(columns, layout=Layout(grid_template_columns="minmax(0, 1fr) minmax(0, 1fr)", grid_gap="8px"))
        super().__init__([KeyGuard(), panes, self.readout], restoration=restoration, **settings)

    def _link_panes(self) -> None:
        for pane, other in ((self.original, self.restored), (self.restored, self.original)):
            self._links.append(jslink((pane.layer, "carried"), (other.layer, "linked")))
            pane.on_hover(partial(self._read, pane=pane))
            pane.observe(lambda change, other=other: self._zoom_too(other, change.new), "view")
        self.original.observe(self._share, SHARED)
        self.original.observe(self._share_limit, ("clip", "section"))
        self._share_limit()

    @property
    def shown(self) -> Snapshot:
        """The snapshot that is drawn."""
        return self._snapshot or Snapshot.of(self.restoration)

    def projection(self) -> PaneProjection:
        """Return the map from the present-day section to the restored pane."""
        return PaneProjection(self.restored.view, self.shown.restoration)

    def still(self) -> str:
        """Draw both panes fitted, as a PNG in base 64."""
        title = RESTORED if self.shown.restoration.stages else NOT_RESTORED
        return still([(PRESENT_DAY, self.original), (title, self.restored)])

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any] | None:
        """Add a still picture to the panes, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**bundle, "image/png": self.still()}

    def on_reading(self, callback: Callable[[Reading | None], None]) -> None:
        """Call a function with the values at the pointer; None when it leaves."""
        self._readers.append(callback)

    def show(self, snapshot: Snapshot) -> None:
        """Draw a snapshot in both panes at once; if it is moving, the map follows in a second message."""
        with UI_LOCK:
            with hold_canvases():
                self._draw_snapshot(snapshot)
                if not snapshot.moving:
                    self._grow_frame(snapshot)
                    self._draw_ratio()
            if snapshot.moving:
                self._draw_ratio()
            self._read_again()

    def _draw_snapshot(self, snapshot: Snapshot) -> None:
        """Draw the sections and the mesh, and link the cursors."""
        old, self._snapshot = self._snapshot, snapshot
        if self.original.section is not snapshot.restoration.original:
            for pane in (self.original, self.restored):
                pane.frame = None
                pane.fit()
            self.original.show(snapshot.restoration.original)
        self.restored.show(snapshot.section, moving=snapshot.moving)
        self._show_badge(snapshot.verdict)
        if old is None or old.restoration is not snapshot.restoration:
            self.original.carry(snapshot.restoration.maps_to_restored)
            self.restored.carry(snapshot.restoration.maps_to_original)
        self._draw_mesh()

    def _show_badge(self, verdict: Verdict | None) -> None:
        """Mark the restored pane if the result has a problem or a warning."""
        if verdict is None or verdict.is_good:
            self.restored.badge.hide()
        else:
            self.restored.badge.show(verdict.severity, verdict.title)

    @observe("restoration")
    def _take_restoration(self, change: Bunch) -> None:
        snapshot = self._snapshot
        if snapshot is None or snapshot.restoration is not self.restoration or snapshot.moving:
            self.show(Snapshot.of(self.restoration))

    @observe("mesh")
    def _draw_mesh(self, change: Bunch | None = None) -> None:
        stages = self._snapshot.restoration.stages if self._snapshot else ()
        for pane in (self.original, self.restored):
            pane.mesh_opacity = self.mesh
        if not (self._snapshot and stages and self.mesh):
            self.original.mesh = self.restored.mesh = None
            return
        section = self._snapshot.restoration.original
        first, last = stages[0], stages[-1]
        self.original.mesh = section.from_rock(first.mesh.vertices), first.mesh.triangles
        self.restored.mesh = section.from_rock(last.vertices), last.mesh.triangles

    @validate("span")
    def _valid_span(self, proposal: Bunch) -> float:
        return checked_span(proposal.value)

    @observe("deformation", "brush", "span")
    def _draw_ratio(self, change: Bunch | None = None) -> None:
        snapshot = self._snapshot
        opacity = self.deformation or (BRUSHED_ALONE if self.brush else 0.0)
        for pane in (self.original, self.restored):
            pane.overlay_opacity = opacity
        if not (snapshot and snapshot.restoration.stages and opacity):
            self.original.overlay = self.restored.overlay = None
            return
        colouring = RatioColouring(self.span)
        brush = (self.brush[0], self.brush[1]) if self.brush else None
        palette = colouring.palette(brush, FADED if self.deformation else 0.0)
        for pane, ratio_map in ((self.original, snapshot.ratio_before), (self.restored, snapshot.ratio_after)):
            pane.overlay = Overlay(colouring.levels(ratio_map.ratio), palette, ratio_map.window)

    def _grow_frame(self, snapshot: Snapshot) -> None:
        """Make both panes fit all of the rock, before and after, at one scale."""
        windows = [Viewport(section).whole for section in (snapshot.restoration.original, snapshot.section)]
        low, high = np.min(windows, axis=0), np.max(windows, axis=0)
        needed = low[0], high[1], low[2], high[3]
        present = self.original.frame or windows[0]
        slack = SLACK * np.array([present[1] - present[0], present[3] - present[2]]).repeat(2)
        reaches_beyond = (np.subtract(needed, present) * (-1, 1, -1, 1) > slack).any()
        if reaches_beyond or self.restored.frame is None:
            self.original.frame = self.restored.frame = needed if reaches_beyond else present

    def _share(self, change: Bunch) -> None:
        setattr(self.restored, change.name, change.new)

    def _share_limit(self, change: Bunch | None = None) -> None:
        self.restored.limit = clip_limit(self.original.section, self.original.clip)

    @observe("zoom_linked")
    def _link_zoom(self, change: Bunch) -> None:
        self._zoom_too(self.restored, self.original.view)

    def _zoom_too(self, pane: SectionPane, view: Viewport) -> None:
        if self.zoom_linked and pane.view.window != view.window:
            pane.view = replace(pane.view, window=view.window)

    def _read_again(self) -> None:
        """Let the readout follow a picture that changes under a pointer at rest."""
        for pane in (self.original, self.restored):
            if pane.pointer is not None:
                self._read(pane.pointer, pane)

    def _read(self, point: Point | None, pane: SectionPane) -> None:
        reading = None if point is None else self._reading(point, pane)
        self.readout.value = READOUT.format(reading.text(self.shown.restoration.original) if reading else "")
        for reader in self._readers:
            reader(reading)

    def _reading(self, point: Point, pane: SectionPane) -> Reading:
        restoration = self.shown.restoration
        rows = np.array([point])
        if pane is self.original:
            before, after = rows, restoration.to_restored(rows)
        else:
            before, after = restoration.to_original(rows), rows
        ratio = np.nan
        if restoration.stages and np.isfinite(before).all():
            (ratio,) = restoration.area_ratio_at(before)
        amplitude = _amplitude(restoration.original, before)
        return Reading(tuple(before[0].tolist()), tuple(after[0].tolist()), amplitude, float(ratio))


def _amplitude(section: Section, point: np.ndarray) -> float:
    """Amplitude of the sample nearest to a point of shape (1, 2); NaN outside the section."""
    if not section.contains(point).all():
        return float("nan")
    column, row = np.rint((point[0] - (section.x0, section.z0)) / (section.dx, section.dz)).astype(int)
    return float(section.amplitude[row, column])
