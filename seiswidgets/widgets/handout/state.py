"""The data of a handout: what its panes receive from a kernel in the app."""

from dataclasses import replace
from typing import Any

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.pick_colours import PickColours, pick_colours
from seiswidgets.geology.picks import FAULT, HORIZON, Fault, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import Scene, action, scenes
from seiswidgets.interaction.colour import Colouring, RatioColouring
from seiswidgets.interaction.live_state import TextureSource, colours_state, grid_state, stage_state, triangles_state
from seiswidgets.interaction.overlay import Stroke
from seiswidgets.interaction.projection import PaneProjection, moved_off_fault, side_of
from seiswidgets.interaction.ratio_axis import ratio_axis
from seiswidgets.interaction.viewport import Viewport, Window

MOST_SAMPLES = 2_000_000  # of the texture: about 3 MB in the file
LEVELS = 254  # of the texture between amplitude 0 and the clip: half a grey level each


def handout_state(
    restored: Restoration,
    interpretation: Interpretation,
    colours: PickColours | None,
    colouring: Colouring,
    ratios: RatioColouring,
) -> dict[str, Any]:
    """Everything that the page draws, as JSON with bytes; see `interaction.live_state`."""
    section = restored.original
    source = TextureSource(section, MOST_SAMPLES, colouring.limit / LEVELS)
    frame = rock_frame(restored)
    view = Viewport(section, frame=frame)
    x_axis, z_axis = view.ticks()
    return {
        "grid": grid_state(section),
        "texture": source.whole,
        "stages": [stage_state(section, stage) for stage in restored.stages],
        "triangles": [triangles_state(stage) for stage in restored.stages],
        "names": [Scene(0, action(stage), stage.age).label for stage in restored.stages],
        "scenes": [{"count": scene.count, "label": scene.label} for scene in scenes(restored.stages)],
        "colours": colours_state(colouring, source.scale),
        "ratios": {"palette": ratios.palette().tobytes(), "span": ratios.span, "axis": ratio_axis(ratios)},
        "frame": list(frame),
        "titles": [x_axis.title, z_axis.title],
        "units": [section.x_unit, section.z_unit],
        "height": "two-way time" if section.is_time else "depth",
        "label": section.name or "seismic section",
        "strokes": [_strokes(interpretation, colours, PaneProjection(view, step)) for step in _steps(restored)],
    }


def _steps(restored: Restoration) -> list[Restoration | None]:
    """The restoration after each number of stages, None at first: a pick may end with the rock that a stage removes."""
    stages = restored.stages
    return [None, *(replace(restored, stages=stages[:count]) for count in range(1, len(stages) + 1))]


def rock_frame(restored: Restoration) -> Window:
    """The window that holds the rock at every stage."""
    section = restored.original
    covered = Viewport(section).covered
    points = [np.reshape(covered, (2, 2)).T, *(section.from_rock(stage.vertices) for stage in restored.stages)]
    (x_min, z_min), (x_max, z_max) = (bound(np.concatenate(points), axis=0).tolist() for bound in (np.min, np.max))
    return x_min, x_max, z_min, z_max


def _strokes(
    interpretation: Interpretation, colours: PickColours | None, projection: PaneProjection
) -> list[dict[str, Any]]:
    """The lines of all picks as a pane shows them, each pick with its name once."""
    looks = pick_colours(interpretation, colours)
    picks = [(HORIZON, horizon.name, list(horizon.pieces)) for horizon in interpretation.horizons]
    picks += [(BODY, body.name, [np.append(body.points, body.points[:1], axis=0)]) for body in interpretation.bodies]
    pieces = [(kind, name, index, points) for kind, name, lines in picks for index, points in enumerate(lines)]
    shown = projection.lines([(points, side_of(kind, points)) for kind, _, _, points in pieces])
    named = [(piece[:3], points) for piece, points in zip(pieces, shown, strict=True)]
    named += [((FAULT, fault.name, 0), _fault_line(fault, projection)) for fault in interpretation.faults]
    return [
        Stroke(points, looks[kind, name], label="" if index else name).state() for (kind, name, index), points in named
    ]


def _fault_line(fault: Fault, projection: PaneProjection) -> np.ndarray:
    """A fault as a pane shows it, on one side of itself throughout: the browser moves it with that rock."""
    restored = projection.restoration
    lines = [fault.points] if restored is None else restored.carried(fault)
    beside = [moved_off_fault(line, projection.view.pixel, side_of(FAULT, line)) for line in lines]
    return np.concatenate([np.empty((0, 2)), *beside])
