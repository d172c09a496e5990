"""A strip of thumbnails: the section at the present day and after each stage, to go to that moment."""

from typing import Any

import anywidget
from ipywidgets import widget_serialization
from traitlets import Dict, Instance, Int, List

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import scenes
from seiswidgets.widgets.assets import asset
from seiswidgets.widgets.section_view.live_picture import FRAMES, LivePicture


class StageStrip(anywidget.AnyWidget):
    """Buttons with small pictures of the scenes of a restoration, which the browser draws; hidden for a single stage.

    A click goes to that moment. With the keyboard, Tab moves to the strip, the arrows move in it, and Enter goes.

    Parameters
    ----------
    picture : LivePicture
        Picture of the panes, from which the thumbnails are drawn.

    Attributes
    ----------
    scenes : list of dict
        "count", the number of stages carried out, and "label".
    frame : int
        Moment that is shown, in frames from the present day. Link a slider to it with ``jslink``.
    frames : int
        Number of frames per stage.
    """

    _esm = asset("stage_strip.js")
    _css = asset("stage_strip.css")

    picture = Instance(LivePicture).tag(sync=True, **widget_serialization)
    scenes: List[dict[str, Any]] = List(Dict()).tag(sync=True)
    frame = Int().tag(sync=True)
    frames = Int(FRAMES).tag(sync=True)

    def __init__(self, picture: LivePicture):
        super().__init__(picture=picture)

    def show(self, restoration: Restoration) -> None:
        """Show the scenes of a restoration."""
        self.scenes = [{"count": scene.count, "label": scene.label} for scene in scenes(restoration.stages)]
