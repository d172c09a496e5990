"""The section of today and the restored one, side by side."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from ipywidgets import HTML, GridBox, Layout, VBox, jslink
from traitlets import Bool, Float, Instance, List, observe

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import RatioColouring, clip_limit
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

BEYOND = 0.005  # of the window: rock that reaches less far beyond it does not make it larger
READOUT = (
    '<div style="font-variant-numeric: tabular-nums; min-height: 1.4em; line-height: 1.4; white-space: nowrap; '
    'overflow: hidden; text-overflow: ellipsis">{}</div>'
)
HEADING = '<div style="font-weight: 600; padding-left: 64px">{}</div>'
SHARED = ("colours", "clip", "gain", "polarity", "height")


@dataclass(frozen=True)
class Reading:
    """What is under the pointer.

    Attributes
    ----------
    original, restored : tuple (x, z)
        Where it lies in either section, NaN where nowhere.
    amplitude : float
        Of the nearest sample of the original.
    ratio : float
        Area ratio, initial over final, of all stages together.
    """

    original: tuple[float, float]
    restored: tuple[float, float]
    amplitude: float
    ratio: float


class LinkedPanes(WithParts, VBox):
    """Two panes: the cursor in one shows at its mapped place in the other, at once.

    Parameters
    ----------
    restoration : Restoration or Section
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    restoration : Restoration
        That is shown; may be set.
    original, restored : SectionPane
        The panes. Colours, clip, gain and polarity of the first hold for both.
    zoom_linked : bool
        Whether both always show the same window.
    deformation, mesh : float
        Opacity of the area ratio's colours and of the mesh, from 0 to 1.
    brush : list
        Empty, or the smallest and the largest area ratio that is lit up.
    """

    restoration = Instance(Restoration)
    zoom_linked = Bool(False)
    deformation = Float(0.0, min=0.0, max=1.0)
    mesh = Float(0.0, min=0.0, max=1.0)
    brush = List()

    def __init__(self, restoration: Restoration | Section, *, height: int = 420, **settings):
        if isinstance(restoration, Section):
            restoration = Restoration(restoration)
        section = restoration.original
        self.original, self.restored = (SectionPane(section, height=height) for _ in range(2))
        self._snapshot, self._readers, self._links = None, [], []
        self.restored.projection = self.projection
        self._readout = HTML(READOUT.format(""))
        self._tie_panes()
        columns = [VBox([HTML(HEADING.format(title)), pane]) for title, pane in self._titled()]
        panes = GridBox(columns, layout=Layout(grid_template_columns="minmax(0, 1fr) minmax(0, 1fr)", grid_gap="8px"))
        super().__init__([KeyGuard(), panes, self._readout], restoration=restoration, **settings)

    def _titled(self):
        return ("Today", self.original), ("Restored", self.restored)

    def _tie_panes(self):
        for one, other in ((self.original, self.restored), (self.restored, self.original)):
            self._links.append(jslink((one.layer, "carried"), (other.layer, "linked")))
            one.on_hover(lambda point, pane=one: self._read(point, pane))
            one.observe(lambda change, pane=other: self._zoom_too(pane, change.new), "view")
        self.original.observe(self._share, SHARED)
        self.original.observe(lambda _: self._set_limit(), ("clip", "section"))
        self._set_limit()

    @property
    def shown(self) -> Snapshot:
        """What is drawn now."""
        return self._snapshot

    def projection(self) -> PaneProjection:
        """How the restored pane shows the present-day section."""
        return PaneProjection(self.restored.view, self._snapshot.restoration)

    def still(self) -> str:
        """What both panes show in full, as a PNG in base 64."""
        today, (title, restored) = self._titled()
        return still([today, (title if self._snapshot.restoration.stages else "Not restored yet", restored)])

    def _repr_mimebundle_(self, **kwargs):
        """Beside the panes themselves a picture of what they show, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**bundle, "image/png": self.still()}

    def on_reading(self, callback: Callable[[Reading | None], None]) -> None:
        """Call a function with what is under the pointer, None where that is nothing."""
        self._readers.append(callback)

    def show(self, snapshot: Snapshot) -> None:
        """Draw a snapshot in both panes at once; while something moves, the picture does not wait for the map."""
        with UI_LOCK:
            with hold_canvases():
                self._draw_snapshot(snapshot)
                if not snapshot.moving:
                    self._make_room(snapshot)
                    self._draw_ratio()
            if snapshot.moving:
                self._draw_ratio()

    def _draw_snapshot(self, snapshot):
        """The sections, the mesh, and how points are carried between them."""
        old, self._snapshot = self._snapshot, snapshot
        if self.original.section is not snapshot.restoration.original:
            for pane in (self.original, self.restored):
                pane.frame = None
                pane.fit()
            self.original.show(snapshot.restoration.original)
        self.restored.show(snapshot.section, moving=snapshot.moving)
        self._mark_restored(snapshot.verdict)
        if old is None or old.restoration is not snapshot.restoration:
            self.original.carry(snapshot.restoration.maps_to_restored)
            self.restored.carry(snapshot.restoration.maps_to_original)
        self._draw_mesh()

    def _mark_restored(self, verdict):
        """Mark the restored picture where the result has a problem or a warning."""
        if verdict is None or verdict.is_good:
            self.restored.badge.hide()
        else:
            self.restored.badge.show(verdict.severity, verdict.title)

    @observe("restoration")
    def _take_restoration(self, change):
        if self._snapshot is None or self._snapshot.restoration is not self.restoration or self._snapshot.moving:
            self.show(Snapshot.of(self.restoration))

    @observe("mesh")
    def _draw_mesh(self, change=None):
        stages = self._snapshot.restoration.stages if self._snapshot else ()
        for pane in (self.original, self.restored):
            pane.mesh_opacity = self.mesh
        if not (stages and self.mesh):
            self.original.mesh = self.restored.mesh = None
            return
        section = self._snapshot.restoration.original
        first, last = stages[0], stages[-1]
        self.original.mesh = section.from_rock(first.mesh.vertices), first.mesh.triangles
        self.restored.mesh = section.from_rock(last.vertices), last.mesh.triangles

    @observe("deformation", "brush")
    def _draw_ratio(self, change=None):
        snapshot = self._snapshot
        for pane in (self.original, self.restored):
            pane.overlay_opacity = self.deformation
        if not (snapshot and snapshot.restoration.stages and self.deformation):
            self.original.overlay = self.restored.overlay = None
            return
        colouring = RatioColouring.of(snapshot.ratio_before.ratio)
        palette = colouring.palette(self.brush or None)
        for pane, drawn in ((self.original, snapshot.ratio_before), (self.restored, snapshot.ratio_after)):
            pane.overlay = Overlay(colouring.levels(drawn.ratio), palette, drawn.window)

    def _make_room(self, snapshot):
        """Let both panes fit all of the rock, before and after, at one scale."""
        windows = [Viewport(section).whole for section in (snapshot.restoration.original, snapshot.section)]
        low, high = np.min(windows, axis=0), np.max(windows, axis=0)
        wanted = low[0], high[1], low[2], high[3]
        now = self.original.frame or windows[0]
        slack = BEYOND * np.array([now[1] - now[0], now[3] - now[2]]).repeat(2)
        out = (np.subtract(wanted, now) * (-1, 1, -1, 1) > slack).any()
        if out or self.restored.frame is None:
            self.original.frame = self.restored.frame = wanted if out else now

    def _share(self, change):
        setattr(self.restored, change.name, change.new)

    def _set_limit(self):
        self.restored.limit = clip_limit(self.original.section, self.original.clip)

    @observe("zoom_linked")
    def _link_zoom(self, change):
        self._zoom_too(self.restored, self.original.view)

    def _zoom_too(self, pane, view):
        if self.zoom_linked and pane.view.window != view.window:
            pane.view = replace(pane.view, window=view.window)

    def _read(self, point, pane):
        reading = None if point is None else self._reading(point, pane)
        self._readout.value = READOUT.format(self._words(reading) if reading else "")
        for reader in self._readers:
            reader(reading)

    def _reading(self, point, pane):
        restoration = self._snapshot.restoration
        if pane is self.original:
            before, after = point, restoration.to_restored([point])[0]
        else:
            before, after = restoration.to_original([point])[0], point
        section, ratio = restoration.original, np.nan
        if restoration.stages and np.isfinite(before).all():
            (ratio,) = restoration.area_ratio_at([before])
        return Reading(tuple(map(float, before)), tuple(map(float, after)), _amplitude(section, before), float(ratio))

    def _words(self, reading):
        section = self._snapshot.restoration.original
        height = "two-way time" if section.is_time else "depth"
        parts = [
            f"{name}: x {at[0]:.6g} {section.x_unit}, {height} {at[1]:.6g} {section.z_unit}"
            for name, at in (("today", reading.original), ("restored", reading.restored))
            if np.isfinite(at).all()
        ]
        if np.isfinite(reading.amplitude):
            parts.append(f"amplitude {reading.amplitude:.3g}")
        if np.isfinite(reading.ratio):
            parts.append(f"area ratio {reading.ratio:.3f}")
        return " &ensp;·&ensp; ".join(parts) or "no rock here"


def _amplitude(section, point):
    """Of the nearest sample, NaN off the section."""
    if not section.contains([point]).all():
        return float("nan")
    column, row = np.rint((np.asarray(point) - (section.x0, section.z0)) / (section.dx, section.dz)).astype(int)
    return float(section.amplitude[row, column])
