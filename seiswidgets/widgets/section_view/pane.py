"""A pane that shows a section, to be zoomed, panned and drawn on."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from html import escape
from typing import Any

import numpy as np
from ipywidgets import HTML, GridBox, Layout, VBox
from traitlets import Any as AnyTrait
from traitlets import Bunch, Enum, Float, Instance, Int, Unicode, dlink, observe, validate

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import Colouring, clip_limit
from seiswidgets.interaction.drawing import Point
from seiswidgets.interaction.gestures import Gesture, Press
from seiswidgets.interaction.messages import GestureReader, PointerMessage, axes_state, press_at
from seiswidgets.interaction.navigation import KEYS, Navigation
from seiswidgets.interaction.overlay import Mark, Overlay, Stroke, map_state, mesh_state
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.ipycanvas_compat import hold_canvases
from seiswidgets.widgets.ipykernel_compat import keep_order
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.messages import TROUBLE
from seiswidgets.widgets.section_view.badge import PaneBadge
from seiswidgets.widgets.section_view.live_picture import LivePicture
from seiswidgets.widgets.section_view.painter import Painter
from seiswidgets.widgets.section_view.pointer_layer import PointerLayer
from seiswidgets.widgets.section_view.settings import checked_setting

LEFT, TOP, RIGHT, BOTTOM = 64, 10, 16, 42  # css pixels around the plot area, for the axes
PASSIVE = ("hover", "leave", "rest", "size")  # kinds of messages that are no action of the user, and clear no error

Mesh = tuple[np.ndarray, np.ndarray]  # vertices and triangles
GestureListener = Callable[[Gesture], bool]
MenuItem = tuple[str, Callable[[], object]]
MenuMaker = Callable[[Press], list[MenuItem]]
HoverListener = Callable[[Point | None], None]


class SectionPane(WithParts, VBox):
    """A section with axes: the wheel zooms at the pointer, a drag pans, a double click or 0 fits, + and - zoom.

    Two fingers zoom and pan too. A drag with the middle button, or with Space held, pans even over lines and marks.

    Parameters
    ----------
    section : Section
    colours : str
        "greys", "red-white-blue", or any matplotlib colour map.
    clip : float
        Percentile of the absolute amplitudes at which the colours end, on both sides of 0.
    limit : float, optional
        Amplitude at which the colours end; from ``clip`` if left out.
    gain : float
        Factor on the amplitudes.
    polarity : {1, -1}
        -1 turns peaks into troughs.
    exaggeration : float
        Vertical exaggeration; if left out, the whole section fills the pane.
    frame : tuple (x_min, x_max, z_min, z_max), optional
        Window that ``fit`` shows, in the section's units; the whole section if left out.
    overlay : Overlay, optional
        A map in colours over the section.
    overlay_opacity, mesh_opacity : float
        0 to 1.
    titles : pair of str, optional
        Titles of the axes; those of the section if left out.
    height : int or None
        Height of the pane with its axes, in css pixels; None for that of the box around it. It is as wide as the page.
    picture : LivePicture, optional
        Picture that the browser draws instead of the section; its colours are then its own.
    restored : bool
        True to draw the restored section of that picture.

    Attributes
    ----------
    view : Viewport
        The window shown; may be set.
    mesh : tuple (vertices, triangles) or None
        Mesh whose edges are drawn, its vertices in the section's units; may be set.
    rubber : sequence of (x, z)
        A dashed line that continues to the pointer; may be set.
    projection : callable() -> PaneProjection
        The map from the present-day section, in whose coordinates gestures are, to the pane; may be set. By default
        the pane shows the present-day section itself.
    line_projection : callable() -> PaneProjection
        The same for the lines and marks to be drawn; it differs if the browser carries them on.
    layer : PointerLayer
    badge : PaneBadge
        Frame and label that mark a result that needs a look.
    message : str
        Text below the pane, usually an error.
    note : str
        Text in the corner, beside the vertical exaggeration.
    message_line : HTML
        The widget that shows it.

    Raises
    ------
    SettingError
        If a setting is out of its range.
    """

    section = Instance(Section)
    view = Instance(Viewport)
    frame = AnyTrait()
    colours = Unicode("greys")
    clip = Float(99.0)
    limit = Float(None, allow_none=True)
    gain = Float(1.0)
    polarity = Enum((1, -1), 1)
    exaggeration = Float()
    overlay = Instance(Overlay, allow_none=True)
    overlay_opacity = Float(0.6)
    mesh_opacity = Float(0.6)
    height = Int(480, allow_none=True)
    message = Unicode()
    note = Unicode()
    titles = AnyTrait()

    def __init__(
        self,
        section: Section,
        *,
        exaggeration: float | None = None,
        picture: LivePicture | None = None,
        restored: bool = False,
        **settings: Any,
    ):
        self.check_settings(settings)
        self._navigation, self._gestures = Navigation(), GestureReader()
        self._mesh: Mesh | None = None
        self._lines: list[dict[str, Any]] = []
        self._bands: list[dict[str, Any]] = []
        self._gesture_listeners: list[GestureListener] = []
        self._hover_listeners: list[HoverListener] = []
        self._flag_listeners: list[Callable[[int], None]] = []
        self._make_menu: MenuMaker = lambda event: []
        self._menu: list[MenuItem] = []  # that is open
        self._fitted_window: Window | None = None  # of the view when its frame was last replaced
        self._pointer: Point | None = None  # in css pixels of the plot area; None while it is elsewhere
        self.projection = self.line_projection = lambda: PaneProjection(self.view)
        self._painter = Painter(section, _plot_area())
        self.layer = PointerLayer(hotkeys=list(KEYS), layout=_plot_area(), picture=picture, restored=restored)
        self.badge = PaneBadge(_plot_area())
        canvases = [] if picture else [self._painter.canvas]
        self._grid = GridBox([*canvases, self.layer, self.badge], layout=_grid_layout())
        self.message_line = HTML(layout=Layout(display="none"))
        super().__init__([self._grid, self.message_line], section=section, view=Viewport(section), **settings)
        self.add_class("seiswidgets-pane")
        dlink((self, "height"), (self._grid.layout, "height"), lambda height: height and f"{height}px")
        self.view = self.view if exaggeration is None else self.view.exaggerated(exaggeration)
        dlink((self, "mesh_opacity"), (self.layer, "mesh_opacity"))
        self.layer.on_pointer_message(self._receive)
        keep_order(self)

    def draw_lines(self, strokes: Sequence[Stroke], *, briefly: bool = False) -> None:
        """Replace the lines on the section; briefly, as during a drag, by sending only those that have changed."""
        self._lines = [stroke.state() for stroke in strokes]
        self._send_strokes(briefly=briefly)

    def draw_bands(self, strokes: Sequence[Stroke]) -> None:
        """Replace the lines below these, which belong to no pick."""
        self._bands = [stroke.state() for stroke in strokes]
        self._send_strokes()

    def _send_strokes(self, *, briefly: bool = False) -> None:
        states, layer = [*self._bands, *self._lines], self.layer
        if briefly and len(states) == len(layer.strokes):
            pairs = enumerate(zip(states, layer.strokes, strict=True))
            layer.changed_strokes = [{**state, "index": index} for index, (state, known) in pairs if state != known]
            return
        with layer.hold_sync():
            layer.strokes, layer.changed_strokes = states, []

    def draw_marks(self, marks: Sequence[Mark]) -> None:
        """Replace the marks on the section."""
        self.layer.marks = [mark.state() for mark in marks if np.isfinite(mark.point).all()]

    def carry(self, maps: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> None:
        """Carry the position of the pointer to another pane, which shows it as its linked cursor.

        Parameters
        ----------
        maps : sequence of (source, target, triangles)
            Piecewise affine maps, applied in order: positions of vertices before and after, shape (n, 2), in the
            section's units, and triangles. Without maps, a position is carried unchanged.
        """
        self.layer.chain = [map_state(*each) for each in maps]

    @property
    def mesh(self) -> Mesh | None:
        """Mesh whose edges are drawn, (vertices, triangles), or None."""
        return self._mesh

    @mesh.setter
    def mesh(self, mesh: Mesh | None) -> None:
        self._mesh = mesh
        self.layer.mesh = {} if mesh is None else mesh_state(*mesh)

    @property
    def rubber(self) -> Sequence[Point]:
        """Points of a dashed line that continues to the pointer."""
        return tuple((x, z) for x, z in self.layer.rubber)

    @rubber.setter
    def rubber(self, points: Sequence[Point]) -> None:
        self.layer.rubber = [[float(x), float(z)] for x, z in points if np.isfinite((x, z)).all()]

    def on_gesture(self, callback: GestureListener) -> None:
        """Call a function with each gesture; if it returns False, the pane zooms or pans."""
        self._gesture_listeners.append(callback)

    def on_hover(self, callback: HoverListener) -> None:
        """Call a function with the point (x, z) under the pointer, a few times a second; None when it leaves."""
        self._hover_listeners.append(callback)

    def offer_menu(self, make: MenuMaker) -> None:
        """Show the items that a function makes for a point, a right click or a long press, besides the pane's own."""
        self._make_menu = make

    def on_flag(self, callback: Callable[[int], None]) -> None:
        """Call a function with the index, among the flags drawn, of a finding's flag that is clicked."""
        self._flag_listeners.append(callback)

    @property
    def pointer(self) -> Point | None:
        """Point (x, z) under the pointer; None while it is elsewhere."""
        if self._pointer is None:
            return None
        x, z = self.view.to_section(self._pointer).tolist()
        return x, z

    def take_keys(self, names: Sequence[str]) -> None:
        """Pass these keys on as gestures, besides the pane's own."""
        self.layer.hotkeys = list(dict.fromkeys([*self.layer.hotkeys, *names]))

    def fit(self) -> None:
        """Show the whole section, or the frame."""
        self.view = self.view.fitted()

    def reframe(self, frame: Window, *, follow: bool) -> None:
        """Replace the frame; a fitted view follows it, or keeps its window until the pane is resized."""
        view = self.view.with_frame(frame)
        if self.view.is_fitted:
            self._fitted_window = self.view.window
        self.view = view if follow else replace(view, window=self.view.window)
        self.frame = frame

    @validate("clip", "limit", "gain", "colours", "height", "frame", "overlay_opacity", "mesh_opacity")
    def _valid(self, proposal: Bunch) -> Any:
        return checked_setting(proposal.trait.name, proposal.value)

    @observe("section")
    def _take_section(self, change: Bunch | None = None) -> None:
        with hold_canvases():
            self._painter.take_section(self.section)
            self._painter.colouring = self.colouring
            self.layer.label = f"{self.section.name or 'seismic section'}; zoom with + and -, 0 fits, arrows pan"
            if self.view.section is not self.section:
                self.view = self.view.with_section(self.section)  # and draw it
            else:
                self._painter.draw(self.view)

    @observe("frame")
    def _take_frame(self, change: Bunch) -> None:
        self.view = self.view.with_frame(self.frame)

    @observe("view", "note", "titles")
    def _take_view(self, change: Bunch) -> None:
        with hold_canvases(), self.layer.hold_sync():
            self.exaggeration = self.view.exaggeration
            self.layer.axes = axes_state(self.view, LEFT, self.note, self.titles)
            self.layer.window = list(self.view.window)
            self.layer.size = self.view.size.tolist()
            self._painter.draw(self.view)
        if self._pointer is not None:  # which is at another point now
            self._call_hover_listeners()

    @observe("exaggeration")
    def _take_exaggeration(self, change: Bunch) -> None:
        if abs(change.new - self.view.exaggeration) > 1e-9 * self.view.exaggeration:
            self.view = self.view.exaggerated(change.new)

    @observe("colours", "clip", "limit", "gain", "polarity")
    def _take_colours(self, change: Bunch) -> None:
        with UI_LOCK:
            self._painter.take_colouring(self.colouring)
            self._painter.draw(self.view)

    @observe("overlay", "overlay_opacity")
    def _take_overlay(self, change: Bunch) -> None:
        with UI_LOCK:
            if change.name == "overlay":
                self._painter.take_overlay(self.overlay)
            if self.layer.picture is not None:
                self.layer.shade = self.overlay.state(self.overlay_opacity) if self.overlay else {}
            self._painter.opacity = self.overlay_opacity
            self._painter.draw(self.view)

    @observe("message")
    def _show_message(self, change: Bunch) -> None:
        self.message_line.value = TROUBLE.format(escape(self.message))
        self.message_line.layout.display = "" if self.message else "none"

    def _receive(self, message: PointerMessage) -> None:
        """Handle a message from the browser, and show errors below the pane."""
        with UI_LOCK:
            try:
                self._act(message)
            except SeiswidgetsError as error:
                self.message = str(error)
            except Exception as error:
                self.message = f"this should not have happened: {type(error).__name__}: {error}"
                raise
            else:
                self.message = self.message if message.kind in PASSIVE else ""

    def _act(self, message: PointerMessage) -> None:
        if message.kind == "size":
            self._resize(message)
        elif message.kind == "menu":
            self._menu = [*self._make_menu(press_at(message, self.projection())), ("Fit the section", self.fit)]
            labels = [label for label, _ in self._menu]
            self.layer.send({"kind": "menu", "labels": labels, "x": message.x, "y": message.y})
        elif message.kind == "choose":
            chosen, self._menu = self._menu[int(message.key) :][:1], []
            for _, act in chosen:
                act()
        elif message.kind == "finding":
            for listen in self._flag_listeners:
                listen(int(message.key))
        elif message.kind == "rest":
            self._painter.sharpen(self.view)
        else:
            if message.kind in ("hover", "drag", "leave"):
                self._pointer = None if message.kind == "leave" else message.pixel
            if not self._is_consumed(message):
                self.view = self._navigation.navigate(self.view, message)
            if message.kind in ("hover", "drag", "leave"):
                self._call_hover_listeners()

    def _is_consumed(self, message: PointerMessage) -> bool:
        if message.pan or self._navigation.is_panning:
            return False
        gesture = self._gestures.read(message, self.projection())
        return gesture is not None and any(listen(gesture) for listen in self._gesture_listeners)

    def _call_hover_listeners(self) -> None:
        for listen in self._hover_listeners:
            listen(self.pointer)

    def _resize(self, message: PointerMessage) -> None:
        """Adopt the size of the plot area in the browser; send everything to a page that has just appeared."""
        with hold_canvases():
            is_resized = (message.width, message.height) != (self.view.width, self.view.height)
            view = self.view.fitted() if is_resized and self.view.window == self._fitted_window else self.view
            self.view = view.resized(message.width, message.height, message.ratio)
            if message.fresh and self.layer.picture is None:
                self._painter.resend(self.view)
            self._painter.sharpen(self.view)

    @property
    def colouring(self) -> Colouring:
        """Colours of the amplitudes."""
        limit = (self.limit or clip_limit(self.section, self.clip)) / self.gain
        return Colouring(self.colours, limit * self.polarity)


def _plot_area() -> Layout:
    return Layout(grid_area="plot", width="100%", height="100%", margin="0", min_width="0", min_height="0")


def _grid_layout() -> Layout:
    return Layout(
        width="100%",
        overflow="hidden",
        grid_template_columns=f"{LEFT}px minmax(0, 1fr) {RIGHT}px",
        grid_template_rows=f"{TOP}px minmax(0, 1fr) {BOTTOM}px",
        grid_template_areas='". . ." ". plot ." ". . ."',
    )
