"""The axis of the area ratio, present-day over restored, on which its histogram is drawn."""

from typing import Any

import numpy as np

from seiswidgets.interaction.colour import RatioColouring

BINS = 41  # an odd number centres a bar on 1
ROUND_RATIOS = (  # the roundest first
    *(1, 10, 0.1, 100, 0.01, 2, 0.5, 5, 0.2, 1.25, 0.8),
    *(1.1, 0.9, 1.05, 0.95, 1.02, 0.98, 1.01, 0.99, 1.005, 0.995),
)
TICK_DISTANCE = 0.09  # least distance between two ticks, as a share of the axis


def ratio_axis(colouring: RatioColouring, bins: int = BINS) -> dict[str, Any]:
    """Edges and colours of bars, the ticks "x" with their labels, and the "decimals" that distinguish two edges."""
    edges = colouring.span ** np.linspace(-1, 1, bins + 1)
    colours = colouring.palette()[colouring.levels(np.sqrt(edges[:-1] * edges[1:])), :3].tolist()
    return {
        "edges": edges.tolist(),
        "colours": [f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in colours],
        "x": [[tick, f"{tick:g}"] for tick in ratio_ticks(colouring.span)],
        "decimals": max(2, -int(np.floor(np.log10(edges[1] / edges[0] - 1)))),
    }


def ratio_ticks(span: float) -> list[float]:
    """Choose round area ratios from 1 / span to span; the roundest come first, until the axis is full."""
    ticks: list[float] = []
    distance = 2 * TICK_DISTANCE * np.log(span)
    for tick in ROUND_RATIOS:
        if 1 / span <= tick <= span and all(abs(np.log(tick / other)) >= distance for other in ticks):
            ticks.append(tick)
    return sorted(ticks)
