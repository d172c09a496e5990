"""Painting of a pane: the section in colours, and a map over it."""

from functools import cached_property

from ipycanvas import MultiCanvas
from ipywidgets import Layout

from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import Colouring
from seiswidgets.interaction.overlay import Overlay
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.ipycanvas_compat import hold_canvases
from seiswidgets.widgets.section_view.texture import Sample, Texture, detail, resize, whole


class Painter:
    """The canvases of a pane. Nothing is sent to them before a page shows them.

    Each change goes out as one message, so that the browser never shows half of it.

    Parameters
    ----------
    section : Section
    layout : Layout

    Attributes
    ----------
    colouring : Colouring
    opacity : float
        Opacity of the overlay, 0 to 1.
    """

    def __init__(self, section: Section, layout: Layout):
        self.colouring, self.opacity = Colouring("greys", 1.0), 1.0
        self._has_page = False
        self._section, self._layout = section, layout
        self._overlay: Overlay | None = None
        self._refined_view: Viewport | None = None
        self._whole, self._detail, self._map = self._textures = [Texture() for _ in range(3)]

    @cached_property
    def canvas(self) -> MultiCanvas:
        """The widget: the section, and the overlay above it."""
        canvas = MultiCanvas(2, width=900, height=600, layout=self._layout)
        canvas.add_class("seiswidgets-plot")
        return canvas

    def take_section(self, section: Section) -> None:
        """Replace the section."""
        self._section = section
        self._forget_section()

    def take_colouring(self, colouring: Colouring) -> None:
        """Replace the colours of the section."""
        self.colouring = colouring
        self._forget_section()

    def take_overlay(self, overlay: Overlay | None) -> None:
        """Replace the overlay, or remove it."""
        self._overlay = overlay
        self._map.forget()

    def resend(self, view: Viewport) -> None:
        """Send everything, for a page that has just appeared."""
        with hold_canvases():
            self._has_page = True
            for texture in self._textures:
                texture.send()
            self.draw(view)

    def draw(self, view: Viewport) -> None:
        """Draw the section and the overlay in a view."""
        if not self._has_page:
            return
        section, overlay = self.canvas[0], self.canvas[1]
        with hold_canvases():
            for canvas in (section, overlay, self.canvas):
                resize(canvas, *view.backing)
            self._paint(view)
            for canvas in (section, overlay):
                canvas.clear_rect(0, 0, *view.backing)
            for texture in (self._whole, self._detail):
                texture.draw_on(section, view)
            overlay.global_alpha = self.opacity
            self._map.draw_on(overlay, view)

    def sharpen(self, view: Viewport) -> None:
        """Draw a view afresh from the amplitudes if the picture of the whole section is too coarse for it."""
        if self._has_page and view != self._refined_view:
            with hold_canvases():
                self._refine(view)
                self.draw(view)

    def _forget_section(self) -> None:
        self._whole.forget()
        self._detail.forget()

    def _paint(self, view: Viewport) -> None:
        """Paint the textures that are missing."""
        if not self._whole.picture:
            self._fill(self._whole, whole(self._section, view))
            self._refine(view)
        if self._overlay is not None and not self._map.picture:
            self._map.paint(self._overlay.levels, self._overlay.palette, self._overlay.window)

    def _refine(self, view: Viewport) -> None:
        self._refined_view = view
        if self._whole.size == self._section.shape[::-1] or not self._whole.is_coarse(view):
            self._detail.forget()
        else:
            self._fill(self._detail, detail(self._section, view))

    def _fill(self, texture: Texture, sample: Sample) -> None:
        amplitude, window = sample
        texture.paint(self.colouring.levels(amplitude), self.colouring.palette, window)
