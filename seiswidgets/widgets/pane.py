"""A section on the screen, to be zoomed, panned and drawn on."""

from collections.abc import Callable, Sequence
from html import escape

from ipycanvas import MultiCanvas
from ipywidgets import HTML, GridBox, Layout, VBox
from traitlets import Enum, Float, Instance, Int, Unicode, observe, validate

from seiswidgets.errors import SeiswidgetsError, SettingError
from seiswidgets.geology.section import Section
from seiswidgets.widgets.canvas import LOCK, held
from seiswidgets.widgets.colours import Colouring, clip_limit, colour_map
from seiswidgets.widgets.gestures import Gesture
from seiswidgets.widgets.overlay import Stroke, draw_strokes
from seiswidgets.widgets.pointer import Happening, PointerLayer, gesture_of
from seiswidgets.widgets.texture import detail, whole
from seiswidgets.widgets.view import View

LEFT, TOP, RIGHT, BOTTOM = 64, 10, 16, 42  # css pixels about the plot area, for the axes
ZOOM = 1.2  # a step of the wheel
CLOSER = 1.5  # a key
STRIDE = 60  # css pixels that an arrow key pans
ARROWS = {"ArrowLeft": (1, 0), "ArrowRight": (-1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}
KEYS = ("0", "+", "=", "-", "_", *ARROWS)
MESSAGE = '<div role="alert" style="color: var(--jp-error-color1, #b71c1c); line-height: 1.4">{}</div>'


class SectionPane(VBox):
    """A section with axes: the wheel zooms at the pointer, a drag pans, a double click or 0 fits, + and - zoom.

    Parameters
    ----------
    section : Section
    colours : str
        "greys", "red-white-blue", or any colour map of matplotlib.
    clip : float
        Percentile of the absolute amplitudes at which the colours end, on both sides of 0.
    gain : float
        Amplitudes are multiplied by it.
    polarity : {1, -1}
        -1 turns peaks into troughs.
    exaggeration : float
        Vertical; that of a pane filled by the whole section if left out.
    height : int
        Of the pane with its axes, in css pixels; it is as wide as the page.

    Attributes
    ----------
    view : View
        What is shown; may be set.
    message : str
        What is said below the pane, of an error mostly.

    Raises
    ------
    SettingError
        If a setting is out of its range.
    """

    section = Instance(Section)
    view = Instance(View)
    colours = Unicode("greys")
    clip = Float(99.0)
    gain = Float(1.0)
    polarity = Enum((1, -1), 1)
    exaggeration = Float()
    height = Int(480)
    message = Unicode()

    def __init__(self, section: Section, *, exaggeration: float | None = None, **settings):
        self._shown, self._texture, self._detail = False, None, None
        self._strokes, self._listeners, self._grip = (), [], None
        self._canvas = MultiCanvas(2, width=900, height=600, layout=_placed())
        self._canvas.add_class("seiswidgets-plot")
        self.layer = PointerLayer(hotkeys=list(KEYS), layout=_placed())
        self._grid = GridBox([self._canvas, self.layer], layout=_grid_layout(480))
        self._line = HTML(layout=Layout(display="none"))
        super().__init__([self._grid, self._line], section=section, view=View(section), **settings)
        self._grid.layout.height = f"{self.height}px"
        self.view = self.view if exaggeration is None else self.view.exaggerated(exaggeration)
        self.layer.on_happening(self._receive)

    def draw_lines(self, strokes: Sequence[Stroke]) -> None:
        """Show these lines on the section, and no others."""
        self._strokes = tuple(strokes)
        self._draw()

    def on_gesture(self, callback: Callable[[Gesture], bool]) -> None:
        """Call a function with each gesture, which says whether it consumed it; else it zooms or pans."""
        self._listeners.append(callback)

    def fit(self) -> None:
        """Show the whole section."""
        self.view = self.view.fitted()

    @validate("clip", "gain", "colours", "height")
    def _valid(self, proposal):
        name, value = proposal.trait.name, proposal.value
        if name == "colours":
            colour_map(value)
        elif name == "clip" and not 0 < value <= 100:
            raise SettingError(f"clip must be a percentile, above 0 and at most 100, but is {value:g}")
        elif name == "gain" and not 0 < value < float("inf"):
            raise SettingError(f"gain must be a finite number above 0, but is {value:g}")
        elif name == "height" and value < 150:
            raise SettingError(f"height must be at least 150 css pixels, but is {value}")
        return value

    @observe("section")
    def _take_section(self, change):
        self._close_textures()
        if self.view.section is not self.section:
            self.view = self._view_of(self.section)
        self.layer.label = f"{self.section.name or 'seismic section'}; zoom with + and -, 0 fits, arrows pan"
        self._colour()

    def _view_of(self, section):
        """The view of another section on the same pixels; of one that covers the same, the same part."""
        old = self.view
        same = old.section.shape == section.shape and old.section.extent == section.extent
        window = old.window if same else None
        return View(section, old.width, old.height, old.pixel_ratio, window)

    @observe("view")
    def _take_view(self, change):
        if (self._canvas.width, self._canvas.height) != self.view.backing:
            self._canvas.width, self._canvas.height = self.view.backing
        self.exaggeration = self.view.exaggeration
        self.layer.axes, self.layer.window = _axes(self.view), list(self.view.window)
        self._draw()

    @observe("exaggeration")
    def _take_exaggeration(self, change):
        if abs(change.new - self.view.exaggeration) > 1e-9 * self.view.exaggeration:
            self.view = self.view.exaggerated(change.new)

    @observe("colours", "clip", "gain", "polarity")
    def _colour(self, change=None):
        if self._shown:
            with held():
                self._paint_textures()
                self._draw()

    @observe("height")
    def _take_height(self, change):
        self._grid.layout.height = f"{self.height}px"

    @observe("message")
    def _show_message(self, change):
        self._line.value = MESSAGE.format(escape(self.message))
        self._line.layout.display = "" if self.message else "none"

    def _receive(self, happening: Happening):
        """Do what the browser asks, and say below the pane what went wrong."""
        with LOCK:
            try:
                self._act(happening)
            except SeiswidgetsError as error:
                self.message = str(error)
            except Exception as error:
                self.message = f"this should not have happened: {type(error).__name__}: {error}"
                raise
            else:
                self.message = self.message if happening.kind in ("hover", "leave", "rest", "size") else ""

    def _act(self, happening):
        if happening.kind == "size":
            self._resize(happening)
        elif happening.kind == "rest":
            self._sharpen()
        elif happening.kind == "wheel":
            self.view = self.view.zoomed(ZOOM**happening.steps, happening.pixel)
        elif not self._is_consumed(happening):
            self._move_view(happening)

    def _is_consumed(self, happening):
        gesture = gesture_of(happening, self.view)
        return self._grip is None and gesture is not None and any(listen(gesture) for listen in self._listeners)

    def _move_view(self, happening):
        if happening.kind == "press":
            self._grip = happening.pixel
        elif happening.kind == "drag" and self._grip:
            way = happening.x - self._grip[0], happening.y - self._grip[1]
            self._grip, self.view = happening.pixel, self.view.panned(*way)
        elif happening.kind == "release":
            self._move_view(Happening("drag", *happening.pixel))
            self._grip = None
        elif happening.kind == "double":
            self.fit()
        elif happening.kind == "key":
            self._press_key(happening)

    def _press_key(self, happening):
        if happening.key == "0":
            self.fit()
        elif happening.key in ARROWS:
            self.view = self.view.panned(*(STRIDE * way for way in ARROWS[happening.key]))
        else:
            self.view = self.view.zoomed(CLOSER if happening.key in "+=" else 1 / CLOSER)

    def _resize(self, happening):
        """Take the size that the browser gave the plot area; to a page that has just come, send everything."""
        view, size = self.view, (happening.width, happening.height, happening.ratio)
        with held():
            if happening.fresh:
                self._shown = True
                self._send_textures()
            if size != (view.width, view.height, view.pixel_ratio):
                self.view = view.resized(*size)
            else:
                self._draw()
            self._sharpen()

    def _colouring(self):
        limit = clip_limit(self.section, self.clip) / self.gain
        return Colouring(self.colours, limit * self.polarity)

    def _paint_textures(self):
        self._texture = self._texture or whole(self.section, self.view)
        for texture in filter(None, (self._texture, self._detail)):
            texture.paint(self._colouring())

    def _send_textures(self):
        if self._texture is None:
            self._paint_textures()
            return
        for texture in filter(None, (self._texture, self._detail)):
            texture.send()

    def _sharpen(self):
        """Draw what is shown anew from the amplitudes, where the section's picture is too coarse for it."""
        cells = (self.section.shape[1], self.section.shape[0])
        if not self._shown or self._texture.size == cells or not self._texture.is_coarse(self.view):
            return
        old, self._detail = self._detail, detail(self.section, self.view)
        with held():
            self._detail.paint(self._colouring())
            self._draw()
        if old:
            old.close()

    def _close_textures(self):
        for texture in filter(None, (self._texture, self._detail)):
            texture.close()
        self._texture = self._detail = None

    def _draw(self):
        if not self._shown:
            return
        picture, lines = self._canvas[0], self._canvas[1]
        with held():
            for canvas in (picture, lines):
                canvas.clear_rect(0, 0, *self.view.backing)
            for texture in filter(None, (self._texture, self._detail)):
                texture.draw_on(picture, self.view)
            draw_strokes(lines, self._strokes, self.view)


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


def _axes(view):
    x, z = ({"title": a.title, "pixels": _rounded(a.pixels), "labels": list(a.labels)} for a in view.ticks())
    exaggeration = "true proportions" if abs(view.exaggeration - 1) < 0.005 else f"V.E. {view.exaggeration:.3g}×"
    return {"x": x, "z": z, "left": LEFT, "note": exaggeration}


def _rounded(pixels):
    return [round(pixel, 2) for pixel in pixels]
