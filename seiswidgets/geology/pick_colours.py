"""Colours of picks: the same in the app, in figures and in exported files."""

from collections.abc import Mapping
from itertools import cycle

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation

COLOURS = {  # distinguishable for the colour-blind, on grey and on red-white-blue
    FAULT: ("#e69f00", "#f0e442", "#ff5fa2", "#c77cff", "#ffb000"),
    HORIZON: ("#00c2a8", "#56b4e9", "#7ad151", "#0072b2", "#b8de29"),
    BODY: ("#ff7f6e", "#d9a6ff", "#ffd0a0"),
}

PickColours = Mapping[tuple[str, str], str]


def pick_colours(interpretation: Interpretation, given: PickColours | None = None) -> dict[tuple[str, str], str]:
    """Colour of each pick, by its kind ("fault", "horizon", "body") and name: the given one, or else the next."""
    names = {FAULT: [fault.name for fault in interpretation.faults]}
    names[HORIZON] = [horizon.name for horizon in interpretation.horizons]
    names[BODY] = [body.name for body in interpretation.bodies]
    usual = {(kind, name): colour for kind in names for name, colour in zip(names[kind], cycle(COLOURS[kind]))}
    return {key: (given or {}).get(key, colour) for key, colour in usual.items()}
