"""The layer on top of a pane that owns every event, and draws axes, lines, marks, mesh and cursors in the browser."""

from collections.abc import Callable

import anywidget
from ipywidgets import CallbackDispatcher
from traitlets import Dict, Float, List, Unicode

from seiswidgets.interaction.messages import PointerMessage
from seiswidgets.widgets.assets import asset

ANSWERED = ("drag", "hover", "wheel", "pinch")  # of these the browser sends none before the last is answered


class PointerLayer(anywidget.AnyWidget):
    """A transparent layer over a canvas, in the same area of a CSS grid.

    All that it draws it draws in the browser, from points in the section's units and the window: zooming and panning
    send none of them again. Moves are throttled there: of drags and wheel steps one message is under way at most. Of
    several views of a layer each draws for its own size, and tells positions in the size that the kernel knows.

    Attributes
    ----------
    axes : dict
        "x" and "z", each with "title", "pixels" and "labels"; "left", the room left of the plot area; and "note", for
        the corner.
    window : list
        ``x_min, x_max, z_min, z_max`` of the plot area, in the section's units.
    size : list
        Width and height of the plot area that the kernel knows, in css pixels; those of the axes are of it.
    strokes, marks : list of dict
        See `Stroke.state` and `Mark.state`.
    rubber : list of [x, z]
        A dashed line, in the section's units, that goes on to the pointer, or else to the linked place.
    mesh : dict
        Empty, or see `mesh_state`.
    mesh_opacity : float
        0 to 1.
    chain : list of dict
        Maps that carry a point to another pane, one after the other; see `map_state`.
    carried, linked : dict
        Where the pointer is, carried by the chain, ``{"x", "z"}`` in the other pane's units or empty; and where to
        draw another pane's cursor. Link the one to the other with ``jslink``; the kernel never hears of either.
    hotkeys : list of str
        Those that the layer takes ("Enter", "Ctrl+z"); all others, Tab among them, keep their meaning. Space is
        always taken: held, it pans; let go without a drag, it is told as a key if it is among these.
    label : str
        What a screen reader says of it.
    """

    _esm = asset("pointer_layer.js")
    _css = asset("pointer_layer.css")

    axes = Dict().tag(sync=True)
    window = List().tag(sync=True)
    size = List().tag(sync=True)
    strokes = List().tag(sync=True)
    marks = List().tag(sync=True)
    rubber = List().tag(sync=True)
    mesh = Dict().tag(sync=True)
    mesh_opacity = Float(0.6).tag(sync=True)
    chain = List().tag(sync=True)
    carried = Dict().tag(sync=True)
    linked = Dict().tag(sync=True)
    hotkeys = List(Unicode()).tag(sync=True)
    label = Unicode("seismic section").tag(sync=True)

    def __init__(self, **traits):
        super().__init__(**traits)
        self._listeners = CallbackDispatcher()
        self.on_msg(self._receive)

    def on_pointer_message(self, callback: Callable[[PointerMessage], None], remove: bool = False) -> None:
        """Call a function with all that happens, or do so no more."""
        self._listeners.register_callback(callback, remove=remove)

    def _receive(self, _, content, buffers):
        try:
            self._listeners(_message(content))
        finally:
            if content.get("kind") in ANSWERED:
                self.send({"kind": "answer", "to": content["kind"]})


def _message(content):
    return PointerMessage(**{**content, "modifiers": frozenset(content.get("modifiers", ()))})
