"""The weights of the energy's terms."""

from dataclasses import dataclass, fields
from numbers import Real

import numpy as np

from seiswidgets.errors import SettingError


@dataclass(frozen=True)
class Weights:
    """What multiplies the rows of each term, as in the paper's eq. 14; its section 4 gives the values set here.

    Parameters
    ----------
    mean_value, contour, edge : float
        The paper's alpha, beta and gamma: how strongly shapes, the contour's bends and lengths are kept.
    slide, stitch : float
        Its zeta and lambda while unfaulting: blocks stay in contact, and cut-offs meet.
    flatten, length : float
        Its zeta and lambda while flattening: the horizon becomes level, and keeps its length.

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

    def __post_init__(self):
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, value in values.items():
            if not (isinstance(value, Real) and np.isfinite(value) and value >= 0):
                raise SettingError(f"weight {name} must be a number of 0 or more, but is {value!r}")
        if not any(values.values()):
            raise SettingError("all weights are 0, so that nothing would be asked for; set at least one above 0")
