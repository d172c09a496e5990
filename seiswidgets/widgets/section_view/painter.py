"""What is painted in a pane: the section in colours, quickly while it moves and finely at rest, and a map over it."""

from ipycanvas import MultiCanvas
from ipywidgets import Layout

from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import Colouring
from seiswidgets.interaction.overlay import Overlay
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.section_view.canvas import held, resize
from seiswidgets.widgets.section_view.texture import Texture, detail, preview, whole


class Painter:
    """The canvases of a pane; they are sent nothing before a page has come that shows them.

    Each change of what is seen goes out as one message, so that the browser never shows half of it.

    Parameters
    ----------
    layout : Layout

    Attributes
    ----------
    canvas : MultiCanvas
        The widget: the section, and the overlay above it.
    colouring : Colouring
    opacity : float
        Of the overlay, 0 to 1.
    is_moving : bool
        Whether the section is drawn coarsely, as another follows soon.
    """

    def __init__(self, layout: Layout):
        self.canvas = MultiCanvas(2, width=900, height=600, layout=layout)
        self.colouring, self.opacity = None, 1.0
        self._section, self._overlay = None, None
        self._view, self._refined = None, None  # as last drawn, and as last painted finely
        self.is_moving, self._is_seen = False, False
        self._whole, self._detail, self._preview, self._map = self._textures = [Texture() for _ in range(4)]

    def take(self, section: Section, is_moving: bool = False) -> None:
        """Another section is to be drawn next, coarsely if it moves."""
        self._section, self.is_moving = section, is_moving
        self._forget()

    def colour(self, colouring: Colouring) -> None:
        """Other colours are to be drawn next."""
        self.colouring = colouring
        self._forget()

    def cover(self, overlay: Overlay | None) -> None:
        """Another overlay is to be drawn next, or none."""
        self._overlay = overlay
        self._map.forget()

    def resend(self, view: Viewport) -> None:
        """Draw everything for a page that knows nothing yet."""
        with held():
            self._is_seen = True
            for texture in self._textures:
                texture.send()
            self.draw(view)

    def draw(self, view: Viewport) -> None:
        """Draw what a view shows."""
        if not self._is_seen:
            return
        with held():
            for canvas in (*self.canvas._canvases, self.canvas):
                resize(canvas, *view.backing)
            self._paint(view)
            section, overlay = self.canvas[0], self.canvas[1]
            for canvas in (section, overlay):
                canvas.clear_rect(0, 0, *view.backing)
            for texture in (self._whole, self._detail, self._preview):
                texture.draw_on(section, view)
            overlay.global_alpha = self.opacity
            self._map.draw_on(overlay, view)
        self._view = view

    def sharpen(self, view: Viewport) -> None:
        """Draw what is shown anew from the amplitudes, where the section's picture is too coarse for it."""
        if self._is_seen and not self.is_moving and view != self._refined:
            with held():
                self._refine(view)
                self.draw(view)

    def _forget(self):
        for texture in (self._whole, self._detail, self._preview):
            texture.forget()

    def _paint(self, view):
        """Make those textures that are missing; what moves is made for one view only."""
        if self.is_moving and not (self._preview.picture and view == self._view):
            self._fill(self._preview, preview(self._section, view))
        elif not self.is_moving and not self._whole.picture:
            self._fill(self._whole, whole(self._section, view))
            self._refine(view)
        if self._overlay is not None and not self._map.picture:
            self._map.paint(self._overlay.levels, self._overlay.palette, self._overlay.window, self.is_moving)

    def _refine(self, view):
        self._refined = view
        if self._whole.size == self._section.shape[::-1] or not self._whole.is_coarse(view):
            self._detail.forget()
        else:
            self._fill(self._detail, detail(self._section, view))

    def _fill(self, texture, sample):
        amplitude, window = sample
        texture.paint(self.colouring.levels(amplitude), self.colouring.palette, window, self.is_moving)
