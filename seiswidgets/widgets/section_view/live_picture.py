"""The picture of a section and of its restoration, drawn in the browser by two panes."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from operator import is_
from typing import Any

import anywidget
from traitlets import Bool, Dict, Float, Int, List

from seiswidgets.core.deformation import USUAL_SPAN
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.interaction.colour import FADED, Colouring, RatioColouring
from seiswidgets.interaction.live_state import (
    TextureSource,
    colours_state,
    deformation_state,
    grid_state,
    stage_state,
    triangles_state,
)
from seiswidgets.widgets.assets import asset

FRAMES = 60  # per stage


class LivePicture(anywidget.AnyWidget):
    """A section's amplitudes and the meshes of a restoration, from which the browser draws both sections itself.

    So nothing but vertices is sent while something is dragged, and nothing at all while panes are zoomed or time runs.
    The amplitudes are sent coarsely at first, and in full while nothing moves. It has no view: `PointerLayer` draws it.

    Attributes
    ----------
    grid, texture, colours, deformation : dict
        See `interaction.live_state`; "texture" has a number ("id"), its shape, the rows of a tile, and an overview.
    stages, triangles : list of dict
        The meshes; see `stage_state` and `triangles_state`.
    frame : float or None
        Moment that is shown, in frames from the present day; None is the end. Link a slider to it with ``jslink``.
    frames : int
        Number of frames per stage.
    changing : bool
        True while things are sent that are to be seen at once.
    """

    _esm = asset("live_picture.js")

    grid = Dict().tag(sync=True)
    texture = Dict().tag(sync=True)
    stages: List[Any] = List().tag(sync=True)
    triangles: List[Any] = List().tag(sync=True)
    frame = Float(None, allow_none=True).tag(sync=True)
    frames = Int(FRAMES).tag(sync=True)
    colours = Dict().tag(sync=True)
    deformation = Dict().tag(sync=True)
    changing = Bool(False).tag(sync=True)

    def __init__(self, section: Section):
        self._shown: tuple[Stage, ...] = ()
        self._source = TextureSource(section)
        super().__init__(grid=grid_state(section), texture=self._texture_state(0))
        self.colour_ratios(RatioColouring(USUAL_SPAN))
        self.on_msg(self._receive)

    @property
    def section(self) -> Section:
        """The present-day section."""
        return self._source.section

    def take_section(self, section: Section) -> None:
        """Replace the section."""
        if section is not self.section:
            self._source = TextureSource(section)
            with self.hold_sync():
                self.grid, self.texture = grid_state(section), self._texture_state(self.texture["id"] + 1)

    def take_stages(self, stages: Sequence[Stage], quick: bool = False) -> None:
        """Replace the stages of the restoration, or of a quick preview; those that stay are not encoded again."""
        if len(stages) == len(self._shown) and all(map(is_, stages, self._shown)):
            return
        known = {id(stage): state for stage, state in zip(self._shown, self.stages, strict=True)}
        with self.hold_sync():
            self.triangles = [triangles_state(stage) for stage in stages]
            self.stages = [known.get(id(stage)) or stage_state(self.section, stage, quick) for stage in stages]
        self._shown = tuple(stages)

    def colour(self, colouring: Colouring) -> None:
        """Replace the colours of the amplitudes."""
        self.colours = colours_state(colouring, self._source.scale)

    def colour_ratios(
        self,
        colouring: RatioColouring,
        brush: tuple[float, float] | None = None,
        opacity: float = 0.0,
        faded: float = FADED,
    ) -> None:
        """Replace the colours of the area ratios; see `RatioColouring.palette`."""
        self.deformation = deformation_state(colouring, colouring.palette(brush, faded), opacity)

    @contextmanager
    def one_frame(self) -> Iterator[None]:
        """Let the browser draw everything that is sent inside in one frame."""
        if self.changing:
            yield
            return
        self.changing = True
        try:
            yield
        finally:
            self.changing = False

    def _texture_state(self, number: int) -> dict[str, Any]:
        source = self._source
        return {"id": number, "shape": list(source.shape), "rows": source.rows, "overview": source.overview}

    def _receive(self, _: object, content: dict[str, Any], buffers: object) -> None:
        """Send a tile of the texture to a page that asks for it."""
        if content.get("kind") == "tile" and content["texture"] == self.texture["id"]:
            self.send(content, [self._source.tile(content["index"])])
