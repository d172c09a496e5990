"""A section on the screen, to be zoomed, panned and drawn on."""

from collections.abc import Callable, Sequence
from html import escape

import numpy as np
from ipywidgets import HTML, GridBox, Layout, VBox
from traitlets import Any, Enum, Float, Instance, Int, Unicode, dlink, observe, validate

from seiswidgets.errors import SeiswidgetsError, SettingError
from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import Colouring, clip_limit, colour_map
from seiswidgets.interaction.gestures import Gesture
from seiswidgets.interaction.messages import GestureReader, PointerMessage, axes_state
from seiswidgets.interaction.navigation import KEYS, Navigation
from seiswidgets.interaction.overlay import Mark, Overlay, Stroke, map_state, mesh_state
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport, checked_window
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.messages import TROUBLE
from seiswidgets.widgets.order import keep_order
from seiswidgets.widgets.section_view.badge import PaneBadge
from seiswidgets.widgets.section_view.canvas import held
from seiswidgets.widgets.section_view.painter import Painter
from seiswidgets.widgets.section_view.pointer_layer import PointerLayer

LEFT, TOP, RIGHT, BOTTOM = 64, 10, 16, 42  # css pixels about the plot area, for the axes
QUIET = ("hover", "leave", "rest", "size")  # what happens without anybody doing anything, and leaves the message alone


class SectionPane(WithParts, VBox):
    """A section with axes: the wheel zooms at the pointer, a drag pans, a double click or 0 fits, + and - zoom.

    Two fingers zoom and pan as well; the middle button or Space held pan even where a drag does something else.

    Parameters
    ----------
    section : Section
    colours : str
        "greys", "red-white-blue", or any colour map of matplotlib.
    clip : float
        Percentile of the absolute amplitudes at which the colours end, on both sides of 0.
    limit : float, optional
        The amplitude at which they end; from ``clip`` if left out.
    gain : float
        Amplitudes are multiplied by it.
    polarity : {1, -1}
        -1 turns peaks into troughs.
    exaggeration : float
        Vertical; that of a pane filled by the whole section if left out.
    frame : tuple (x_min, x_max, z_min, z_max), optional
        What is shown when it fits, in the section's units; all of the section if left out.
    overlay : Overlay, optional
        A map in colours over the section.
    overlay_opacity, mesh_opacity : float
        0 to 1.
    height : int
        Of the pane with its axes, in css pixels; it is as wide as the page.

    Attributes
    ----------
    view : Viewport
        What is shown; may be set.
    mesh : tuple (vertices, triangles) or None
        Whose edges are drawn; may be set. The vertices are in the section's units.
    rubber : sequence of (x, z)
        A dashed line that goes on to the pointer; may be set.
    projection : callable() -> PaneProjection
        How the pane shows the present-day section, in whose coordinates gestures are; may be set. That of a pane of
        the present-day section itself if not.
    layer : PointerLayer
    badge : PaneBadge
        Frame and label that mark the picture, as one of a result that needs a look.
    message : str
        What is said below the pane, of an error mostly.

    Raises
    ------
    SettingError
        If a setting is out of its range.
    """

    section = Instance(Section)
    view = Instance(Viewport)
    frame = Any()
    colours = Unicode("greys")
    clip = Float(99.0)
    limit = Float(None, allow_none=True)
    gain = Float(1.0)
    polarity = Enum((1, -1), 1)
    exaggeration = Float()
    overlay = Instance(Overlay, allow_none=True)
    overlay_opacity = Float(0.6)
    mesh_opacity = Float(0.6)
    height = Int(480)
    message = Unicode()

    def __init__(self, section: Section, *, exaggeration: float | None = None, **settings):
        self._navigation, self._mesh, self._will_move = Navigation(), None, False
        self._gesture_listeners, self._hover_listeners, self._gestures = [], [], GestureReader()
        self.projection = lambda: PaneProjection(self.view)
        self._painter = Painter(_placed())
        self._painter.canvas.add_class("seiswidgets-plot")
        self.layer = PointerLayer(hotkeys=list(KEYS), layout=_placed())
        self.badge = PaneBadge(_placed())
        self._grid = GridBox([self._painter.canvas, self.layer, self.badge], layout=_grid_layout(480))
        self._line = HTML(layout=Layout(display="none"))
        super().__init__([self._grid, self._line], section=section, view=Viewport(section), **settings)
        self._grid.layout.height = f"{self.height}px"
        self.view = self.view if exaggeration is None else self.view.exaggerated(exaggeration)
        dlink((self, "mesh_opacity"), (self.layer, "mesh_opacity"))
        self.layer.on_pointer_message(self._receive)
        keep_order(self)

    def show(self, section: Section, *, moving: bool = False) -> None:
        """Show another section, in the same window unless all of the old one was shown.

        One that is ``moving``, as another follows soon, is drawn quickly rather than finely; to set ``section`` is to
        show it at rest.
        """
        with held():
            self._will_move = moving
            try:
                if section is self.section and moving != self._painter.is_moving:
                    self._take_section()
                self.section = section
            finally:
                self._will_move = False

    def draw_lines(self, strokes: Sequence[Stroke]) -> None:
        """Show these lines on the section, and no others."""
        self.layer.strokes = [stroke.state() for stroke in strokes]

    def draw_marks(self, marks: Sequence[Mark]) -> None:
        """Show these marks on the section, and no others."""
        self.layer.marks = [mark.state() for mark in marks if np.isfinite(mark.point).all()]

    def carry(self, maps: Sequence[tuple]) -> None:
        """Carry the pointer's place to another pane, there to be its linked cursor.

        Parameters
        ----------
        maps : sequence of (source, target, triangles)
            Applied one after the other; each is affine in each triangle, and carries places of vertices, shape (n, 2),
            in the section's units, to others. Without any, a place is carried to itself.
        """
        self.layer.chain = [map_state(*each) for each in maps]

    @property
    def mesh(self):
        return self._mesh

    @mesh.setter
    def mesh(self, mesh):
        self._mesh = mesh
        self.layer.mesh = {} if mesh is None else mesh_state(*mesh)

    @property
    def rubber(self):
        return tuple((x, z) for x, z in self.layer.rubber)

    @rubber.setter
    def rubber(self, points):
        self.layer.rubber = [[float(x), float(z)] for x, z in points if np.isfinite((x, z)).all()]

    def on_gesture(self, callback: Callable[[Gesture], bool]) -> None:
        """Call a function with each gesture; it returns whether it consumed it. If not, the pane zooms or pans."""
        self._gesture_listeners.append(callback)

    def on_hover(self, callback: Callable[[tuple[float, float] | None], None]) -> None:
        """Call a function with the point (x, z) that the pointer is over, a few times a second; None when it leaves."""
        self._hover_listeners.append(callback)

    def take_keys(self, names: Sequence[str]) -> None:
        """Have these keys told to those who listen to gestures, besides the pane's own."""
        self.layer.hotkeys = list(dict.fromkeys([*self.layer.hotkeys, *names]))

    def fit(self) -> None:
        """Show the whole section, or the frame."""
        self.view = self.view.fitted()

    @validate("clip", "limit", "gain", "colours", "height", "frame", "overlay_opacity", "mesh_opacity")
    def _valid(self, proposal):
        name, value = proposal.trait.name, proposal.value
        if name == "colours":
            colour_map(value)
        elif name == "frame":
            return None if value is None else checked_window("frame", value)
        elif name == "clip" and not 0 < value <= 100:
            raise SettingError(f"clip must be a percentile, above 0 and at most 100, but is {value:g}")
        elif name in ("gain", "limit") and not (value is None or 0 < value < float("inf")):
            raise SettingError(f"{name} must be a finite number above 0, but is {value:g}")
        elif name == "height" and value < 150:
            raise SettingError(f"height must be at least 150 css pixels, but is {value}")
        elif name.endswith("opacity") and not 0 <= value <= 1:
            raise SettingError(f"{name} must be from 0 to 1, but is {value:g}")
        return value

    @observe("section")
    def _take_section(self, change=None):
        with held():
            self._painter.take(self.section, self._will_move)
            self._painter.colouring = self.colouring
            self.layer.label = f"{self.section.name or 'seismic section'}; zoom with + and -, 0 fits, arrows pan"
            if self.view.section is not self.section:
                self.view = self.view.with_section(self.section)  # which draws it
            else:
                self._painter.draw(self.view)

    @observe("frame")
    def _take_frame(self, change):
        self.view = self.view.with_frame(self.frame)

    @observe("view")
    def _take_view(self, change):
        with held(), self.layer.hold_sync():
            self.exaggeration = self.view.exaggeration
            self.layer.axes, self.layer.window = axes_state(self.view, LEFT), list(self.view.window)
            self.layer.size = self.view.size.tolist()
            self._painter.draw(self.view)

    @observe("exaggeration")
    def _take_exaggeration(self, change):
        if abs(change.new - self.view.exaggeration) > 1e-9 * self.view.exaggeration:
            self.view = self.view.exaggerated(change.new)

    @observe("colours", "clip", "limit", "gain", "polarity")
    def _take_colours(self, change):
        with UI_LOCK:
            self._painter.colour(self.colouring)
            self._painter.draw(self.view)

    @observe("overlay", "overlay_opacity")
    def _take_overlay(self, change):
        with UI_LOCK:
            if change.name == "overlay":
                self._painter.cover(self.overlay)
            self._painter.opacity = self.overlay_opacity
            self._painter.draw(self.view)

    @observe("height")
    def _take_height(self, change):
        self._grid.layout.height = f"{self.height}px"

    @observe("message")
    def _show_message(self, change):
        self._line.value = TROUBLE.format(escape(self.message))
        self._line.layout.display = "" if self.message else "none"

    def _receive(self, message: PointerMessage):
        """Do what the browser asks, and say below the pane what went wrong."""
        with UI_LOCK:
            try:
                self._act(message)
            except SeiswidgetsError as error:
                self.message = str(error)
            except Exception as error:
                self.message = f"this should not have happened: {type(error).__name__}: {error}"
                raise
            else:
                self.message = self.message if message.kind in QUIET else ""

    def _act(self, message):
        if message.kind == "size":
            self._resize(message)
        elif message.kind == "rest":
            self._painter.sharpen(self.view)
        elif not self._is_consumed(message):
            self.view = self._navigation.navigate(self.view, message)
        self._tell_hover(message)

    def _is_consumed(self, message):
        if message.pan or self._navigation.is_panning:
            return False
        gesture = self._gestures.read(message, self.projection())
        return gesture is not None and any(listen(gesture) for listen in self._gesture_listeners)

    def _tell_hover(self, message):
        if message.kind in ("hover", "drag", "leave"):
            point = None if message.kind == "leave" else tuple(self.view.to_section(message.pixel).tolist())
            for listen in self._hover_listeners:
                listen(point)

    def _resize(self, message):
        """Take the size that the browser gave the plot area; to a page that has just come, send everything."""
        with held():
            self.view = self.view.resized(message.width, message.height, message.ratio)
            if message.fresh:
                self._painter.resend(self.view)
            self._painter.sharpen(self.view)

    @property
    def colouring(self) -> Colouring:
        """How its amplitudes become colours."""
        limit = (self.limit or clip_limit(self.section, self.clip)) / self.gain
        return Colouring(self.colours, limit * self.polarity)


def _placed():
    return Layout(grid_area="plot", width="100%", height="100%", margin="0", min_width="0", min_height="0")


def _grid_layout(height):
    return Layout(
        width="100%",
        height=f"{height}px",
        overflow="hidden",
        grid_template_columns=f"{LEFT}px minmax(0, 1fr) {RIGHT}px",
        grid_template_rows=f"{TOP}px minmax(0, 1fr) {BOTTOM}px",
        grid_template_areas='". . ." ". plot ." ". . ."',
    )
