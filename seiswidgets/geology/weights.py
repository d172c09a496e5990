"""The weights of the energy's terms."""

from dataclasses import dataclass, fields

import numpy as np

from seiswidgets.errors import SettingError


@dataclass(frozen=True)
class Weights:
    """Factors of the rows of each term, as in the paper's eq. 14; the defaults are from its section 4.

    Parameters
    ----------
    mean_value, contour, edge : float
        The paper's alpha, beta and gamma: how strongly shapes, the contour's bends and lengths are kept.
    slide, stitch : float
        Its zeta and lambda while unfaulting: blocks stay in contact, and cut-offs meet.
    flatten, length : float
        Its zeta and lambda while flattening: the horizon becomes level, and keeps its length.
    rotation : float
        Not in the paper, and off by default: how strongly blocks are kept from turning while unfaulting.
    bedding : float
        Not in the paper, and off by default: how strongly areas, and lengths along the beds, are kept in all the rock
        so that beds slip past each other, as in a flexural-slip fold or a thrust sheet; 10 is a good value.

    Those of a line (stitch, flatten, length) are multiplied by the root of the number of its edges, so that they mean
    the same on a fine mesh as on a coarse one.

    Raises
    ------
    SettingError
        If a weight is negative or not finite, or if all are 0.
    """

    mean_value: float = 1.0
    contour: float = 1.0
    edge: float = 1.0
    slide: float = 10.0
    stitch: float = 10.0
    flatten: float = 10.0
    length: float = 10.0
    rotation: float = 0.0
    bedding: float = 0.0

    def __post_init__(self) -> None:
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, value in values.items():
            is_real = isinstance(value, float | int | np.floating | np.integer)
            if not (is_real and np.isfinite(value) and value >= 0):
                raise SettingError(f"weight {name} must be a number of 0 or more, but is {value!r}")
        if not any(values.values()):
            raise SettingError("all weights are 0, so nothing would be restored; set at least one above 0")
