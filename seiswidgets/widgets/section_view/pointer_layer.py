"""The layer on top of a pane: it owns all events, and draws axes, lines, marks, mesh and cursors in the browser."""

import time
from collections.abc import Callable
from typing import Any

import anywidget
from ipywidgets import CallbackDispatcher, widget_serialization
from traitlets import Bool, Dict, Float, Instance, Int, List, Unicode

from seiswidgets.interaction.messages import PointerMessage
from seiswidgets.interaction.overlay import without_usual
from seiswidgets.widgets.assets import asset
from seiswidgets.widgets.section_view.live_picture import LivePicture

ANSWERED = ("drag", "hover", "wheel", "pinch")  # the browser waits for the answer before it sends more of a kind


class PointerLayer(anywidget.AnyWidget):
    """A transparent layer over a canvas, in the same area of a CSS grid.

    It draws everything in the browser, from points in the section's units and the window, so that zooming and panning
    resend no points. Moves are throttled there: at most one message about drags or wheel steps is in progress. If a
    layer has several views, each draws for its own size, and sends positions in the size that the kernel knows.

    Attributes
    ----------
    axes : dict
        "x" and "z", each with "title", "pixels" and "labels"; "left", the space left of the plot area; and "note",
        the text in the corner. See `axes_state`.
    window : list
        ``x_min, x_max, z_min, z_max`` of the plot area, in the section's units.
    size : list
        Width and height of the plot area as the kernel knows it, in css pixels; pixels of the axes refer to it.
    strokes, marks : list of dict
        See `Stroke.state` and `Mark.state`.
    changed_strokes : list of dict
        Strokes that are drawn instead of those at their "index", as during a drag.
    rubber : list of [x, z]
        A dashed line, in the section's units, that continues to the pointer, or else to the linked cursor.
    mesh : dict
        Empty, or see `mesh_state`.
    mesh_opacity : float
        0 to 1.
    shade : dict
        Empty, or see `Overlay.state`.
    chain : list of dict
        Maps that carry a point to another pane, applied in order; see `map_state`.
    carried, linked : dict
        The pointer carried by the chain, ``{"x", "z"}`` in the other pane's units or empty; and the position of another
        pane's cursor. Link one pane's to the other's with ``jslink``; neither is ever sent to the kernel.
    hotkeys : list of str
        Keys that the layer takes ("Enter", "Ctrl+z"); all others, Tab among them, keep their meaning. Space is always
        taken: while held, it pans; released without a drag, it is sent as a key if it is one of these.
    label : str
        Description for screen readers.
    picture : LivePicture or None
        Picture that the layer draws below everything else; then it carries points by the picture's meshes.
    restored : bool
        True to draw the restored section; strokes, marks and the rubber band are then where they are at the end.
    stage : int or None
        Number of stages after which these are given instead, since a later one removes rock.
    """

    _esm = asset("pointer_layer.js")
    _css = asset("pointer_layer.css")

    axes = Dict().tag(sync=True)
    window: List[Any] = List().tag(sync=True)
    size: List[Any] = List().tag(sync=True)
    strokes: List[Any] = List().tag(sync=True, to_json=without_usual)
    changed_strokes: List[Any] = List().tag(sync=True, to_json=without_usual)
    marks: List[Any] = List().tag(sync=True, to_json=without_usual)
    rubber: List[Any] = List().tag(sync=True)
    mesh = Dict().tag(sync=True)
    mesh_opacity = Float(0.6).tag(sync=True)
    shade = Dict().tag(sync=True)
    chain: List[Any] = List().tag(sync=True)
    carried = Dict().tag(sync=True)
    linked = Dict().tag(sync=True)
    hotkeys = List(Unicode()).tag(sync=True)
    label = Unicode("seismic section").tag(sync=True)
    picture = Instance(LivePicture, allow_none=True).tag(sync=True, **widget_serialization)
    restored = Bool(False).tag(sync=True)
    stage = Int(None, allow_none=True).tag(sync=True)

    def __init__(self, **traits: Any):
        super().__init__(**traits)
        self._listeners = CallbackDispatcher()
        self.on_msg(self._receive)

    def on_pointer_message(self, callback: Callable[[PointerMessage], None], remove: bool = False) -> None:
        """Call a function with each message, or stop calling it."""
        self._listeners.register_callback(callback, remove=remove)

    def _receive(self, _: object, content: dict[str, Any], buffers: object) -> None:
        start = time.perf_counter()
        try:
            self._listeners(_message(content))
        finally:
            if content.get("kind") in ANSWERED:
                took = round(1000 * (time.perf_counter() - start), 1)
                self.send({"kind": "answer", "to": content["kind"], "took": took})


def _message(content: dict[str, Any]) -> PointerMessage:
    return PointerMessage(**{**content, "modifiers": frozenset(content.get("modifiers", ()))})
