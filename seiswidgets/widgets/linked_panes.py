"""The present-day section and the restored one, side by side."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from ipywidgets import HTML, GridBox, HBox, Layout, VBox, jslink
from traitlets import Bool, Bunch, Float, Instance, List, observe, validate

from seiswidgets.core.deformation import USUAL_SPAN
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import STRIP
from seiswidgets.interaction.colour import FADED, RatioColouring, checked_span, clip_limit
from seiswidgets.interaction.drawing import Point
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.section_view.live_picture import LivePicture
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.section_view.still import still
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.verdict import Verdict

PRESENT_DAY, RESTORED, NOT_RESTORED = "Present day", "Restored", "Not restored yet"
UNFINISHED = "drawing unfinished"
SLACK = 0.005  # share of the window by which rock may reach beyond the frame before the frame grows
READOUT = (
    '<div style="font-variant-numeric: tabular-nums; min-height: 1.4em; line-height: 1.4; white-space: nowrap; '
    'overflow: hidden; text-overflow: ellipsis">{}</div>'
)
HEADING = '<div style="font-weight: 600; padding-left: 64px; line-height: 20px">{}</div>'
BEYOND = "0 shows all of the rock"
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
        if section.conversion and np.isfinite(self.original).all():
            recorded = section.conversion.time_section
            time = section.conversion.to_time(self.original)[1]
            parts.insert(1, f"recorded at two-way time {time:.6g} {recorded.z_unit}")
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
    height : int or None
        Height of each pane in css pixels; None for that of the box around the panes.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    restoration : Restoration
        The restoration shown; may be set.
    picture : LivePicture
        What both panes draw.
    original, restored : SectionPane
        The panes. Colours, clip, gain and polarity of the first apply to both.
    zoom_linked : bool
        True to show the same window in both panes; the vertical exaggeration is the same in any case.
    deformation, mesh : float
        Opacity of the area ratio's colours and of the mesh, from 0 to 1.
    span : float
        The colours of the area ratio run from 1 / span to span.
    brush : list
        Smallest and largest area ratio to highlight, or empty; highlighted even if the opacity is 0.
    readout, foot : HTML, HBox
        Line with the values at the pointer, and the box that holds it, below the panes.

    Raises
    ------
    TypeError
        If a keyword does not exist.
    """

    restoration = Instance(Restoration)
    zoom_linked = Bool(True)
    deformation = Float(0.0, min=0.0, max=1.0)
    mesh = Float(0.0, min=0.0, max=1.0)
    span = Float(USUAL_SPAN)
    brush: List[float] = List()

    def __init__(self, restoration: Restoration | Section, *, height: int | None = 420, **settings: Any):
        self.check_settings(settings)
        if isinstance(restoration, Section):
            restoration = Restoration(restoration)
        section = restoration.original
        self.picture = picture = LivePicture(section)
        self.original, self.restored = (
            SectionPane(section, height=height, picture=picture, restored=restored, mesh_opacity=0.0)
            for restored in (False, True)
        )
        self._snapshot: Snapshot | None = None  # until the restoration is taken
        self._moment: Snapshot | None = None  # None at the end
        self._readers: list[Callable[[Reading | None], None]] = []
        self._links: list[object] = []
        self.restored.projection, self.restored.line_projection = self.projection, self.line_projection
        self.readout = HTML(READOUT.format(""))
        self.foot = HBox([self.readout])
        self._link_panes()
        headed = (PRESENT_DAY, self.original), (RESTORED, self.restored)
        columns = [VBox([HTML(HEADING.format(title), layout=Layout(margin="0")), pane]) for title, pane in headed]
        panes = GridBox(columns)
        super().__init__([KeyGuard(), panes, self.foot], restoration=restoration, **settings)
        for box, name in ((self, "panes"), (panes, "pair"), (self.foot, "foot")):
            box.add_class(f"seiswidgets-{name}")

    def _link_panes(self) -> None:
        for pane, other in ((self.original, self.restored), (self.restored, self.original)):
            self._links.append(jslink((pane.layer, "carried"), (other.layer, "linked")))
            pane.on_hover(partial(self._read, pane=pane))
            pane.observe(lambda change, other=other: self._zoom_too(other, change.new), "view")
        self.original.observe(self._share, SHARED)
        self.original.observe(self._share_limit, ("clip", "section"))
        self.original.observe(self._colour, ("colours", "clip", "limit", "gain", "polarity", "section"))
        self._share_limit()
        self._colour()

    @property
    def shown(self) -> Snapshot:
        """The snapshot that is shown, at its moment."""
        return self._moment or self._snapshot or Snapshot.of(self.restoration)

    def projection(self) -> PaneProjection:
        """Return the map from the present-day section to the restored pane."""
        return PaneProjection(self.restored.view, self.shown.restoration)

    def line_projection(self) -> PaneProjection:
        """Return the map from the present-day section to the restored pane, at the last stage with the rock of now.

        From there the browser carries lines to any other moment.
        """
        restoration, stage = (self._snapshot or self.shown).restoration, self.restored.layer.stage
        return PaneProjection(self.restored.view, restoration if stage is None else restoration.at(stage))

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

    def show(self, snapshot: Snapshot, *, follow: bool = True) -> None:
        """Show a restoration at its end in both panes at once; the browser draws it.

        Parameters
        ----------
        snapshot : Snapshot
        follow : bool
            True if fitted views are to hold all of the rock; after an edit, the view must not jump.
        """
        with UI_LOCK, self.picture.one_frame():
            self._snapshot, self._moment, self.restored.layer.stage = snapshot, None, None
            restoration = snapshot.restoration
            self._show_section(restoration.original)
            self.picture.frame = None
            self.picture.take_stages(restoration.stages, restoration.quick)
            if not snapshot.is_preview:
                self.restored.section = snapshot.section
                self._frame(snapshot, follow)
                self._read_again()  # a preview follows the pointer, which is read after it
            self._show_badge(snapshot.verdict)

    def show_moment(self, moment: Snapshot | None) -> bool:
        """Take gestures, and read values, at a moment of the restoration, which the browser shows by itself.

        None is the end. Return True if lines are to be drawn anew, since there is other rock than at the moment before.
        """
        with UI_LOCK:
            self._moment = moment
            self._read_again()
            layer, before = self.restored.layer, self.restored.layer.stage
            layer.stage = None if self._snapshot is None or moment is None else _next_strip(self._snapshot, moment)
            return bool(layer.stage != before)

    def _show_section(self, section: Section) -> None:
        """Show another present-day section, unless it is the same."""
        if self.original.section is not section:
            for pane in (self.original, self.restored):
                pane.frame = None
                pane.fit()
            self.picture.take_section(section)
            self.original.section = section

    def _show_badge(self, verdict: Verdict | None) -> None:
        """Mark the restored pane if the result has a problem or a warning."""
        if verdict is None or verdict.is_good:
            self.restored.badge.hide()
        elif verdict.is_incomplete:
            self.restored.badge.show("note", UNFINISHED)
        else:
            self.restored.badge.show(verdict.severity, verdict.title)

    @observe("restoration")
    def _take_restoration(self, change: Bunch) -> None:
        if self._snapshot is None or self._snapshot.restoration is not self.restoration:
            self.show(Snapshot.of(self.restoration))

    @observe("mesh")
    def _show_mesh(self, change: Bunch) -> None:
        self.original.mesh_opacity = self.restored.mesh_opacity = self.mesh

    @validate("span")
    def _valid_span(self, proposal: Bunch) -> float:
        return checked_span(proposal.value)

    @observe("deformation", "brush", "span")
    def _colour_ratios(self, change: Bunch | None = None) -> None:
        opacity = self.deformation or (BRUSHED_ALONE if self.brush else 0.0)
        brush = (self.brush[0], self.brush[1]) if self.brush else None
        self.picture.colour_ratios(RatioColouring(self.span), brush, opacity, FADED if self.deformation else 0.0)

    def _colour(self, change: Bunch | None = None) -> None:
        self.picture.colour(self.original.colouring)

    def _frame(self, snapshot: Snapshot, follow: bool) -> None:
        """Let both panes fit all of the rock, before and after, at one scale; say so if some lies beyond the window."""
        windows = [Viewport(section).whole for section in (snapshot.restoration.original, snapshot.section)]
        low, high = np.min(windows, axis=0), np.max(windows, axis=0)
        frame = low[0], high[1], low[2], high[3]
        if not _reaches_beyond(frame, windows[0]):
            frame = windows[0]
        follow = follow or self.restored.frame is None
        for pane in (self.original, self.restored):
            pane.reframe(frame, follow=follow)
        self._note_rock_beyond()

    def _note_rock_beyond(self) -> None:
        """Say so if the panes show all of the present-day section, but not all of the restored one."""
        view = self.original.view
        shows_section = not _reaches_beyond(view.covered, view.window)
        self.restored.note = BEYOND if shows_section and _reaches_beyond(view.whole, view.window) else ""

    def _share(self, change: Bunch) -> None:
        setattr(self.restored, change.name, change.new)

    def _share_limit(self, change: Bunch | None = None) -> None:
        self.restored.limit = clip_limit(self.original.section, self.original.clip)

    @observe("zoom_linked")
    def _link_zoom(self, change: Bunch) -> None:
        self._zoom_too(self.restored, self.original.view)

    def _zoom_too(self, pane: SectionPane, view: Viewport) -> None:
        """Give a pane the window of the other one, or if zooms are not linked, its exaggeration."""
        following = pane.view.resized(view.width, view.height, view.pixel_ratio)
        if self.zoom_linked:
            following = replace(following, window=view.window)
        elif not np.isclose(following.exaggeration, view.exaggeration, rtol=1e-9):
            following = following.exaggerated(view.exaggeration)
        pane.view = following
        self._note_rock_beyond()

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


def _next_strip(snapshot: Snapshot, moment: Snapshot) -> int | None:
    """Number of stages before the next one that removes rock; None if there is none."""
    stages, done = snapshot.restoration.stages, len(moment.restoration.stages)
    return next((index for index in range(done, len(stages)) if stages[index].kind == STRIP), None)


def _reaches_beyond(window: Window, other: Window) -> bool:
    """Return whether a window reaches notably beyond another one."""
    slack = SLACK * np.array([other[1] - other[0], other[3] - other[2]]).repeat(2)
    return bool((np.subtract(window, other) * (-1, 1, -1, 1) > slack).any())


def _amplitude(section: Section, point: np.ndarray) -> float:
    """Amplitude of the sample nearest to a point of shape (1, 2); NaN outside the section."""
    if not section.contains(point).all():
        return float("nan")
    column, row = np.rint((point[0] - (section.x0, section.z0)) / (section.dx, section.dz)).astype(int)
    return float(section.amplitude[row, column])
