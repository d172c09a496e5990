"""What lies on top of a section's picture: lines, marks, and a map in colours."""

from dataclasses import dataclass

import numpy as np

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import TOLERANCE
from seiswidgets.errors import SettingError
from seiswidgets.interaction.viewport import Window, checked_window

KINDS = ("cutoff", "held", "cursor")


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line on a section, with a pale rim so that it stands out from any colours.

    Parameters
    ----------
    points : array, shape (n, 2)
        In the section's units; the line is interrupted where they are NaN.
    colour : str
        As CSS has it.
    width : float
        In css pixels.
    dots : bool
        Whether the vertices are shown.
    dash : tuple of float
        Lengths of dashes and gaps, in css pixels.
    label : str
        Written near the line's start.
    chosen : int, optional
        The vertex that is shown larger.
    """

    points: np.ndarray
    colour: str = "#d7191c"
    width: float = 2.0
    dots: bool = False
    dash: tuple[float, ...] = ()
    label: str = ""
    chosen: int | None = None

    def state(self) -> dict:
        """It as the layer in the browser knows it: points that cannot be drawn are None."""
        points = np.reshape(np.asarray(self.points, float), (-1, 2))
        seen = np.isfinite(points).all(axis=1).tolist()
        places = [point if there else None for point, there in zip(points.tolist(), seen, strict=True)]
        style = {"colour": self.colour, "width": self.width, "dots": self.dots, "dash": list(self.dash)}
        return {"points": places, **style, "label": self.label, "chosen": self.chosen}


@dataclass(frozen=True)
class Mark:
    """A place on a section.

    Parameters
    ----------
    point : tuple (x, z)
        In the section's units; a mark where it is NaN is not shown.
    kind : {"cutoff", "held", "cursor"}
        A disc with a number, a pin, and the cross of the keyboard.
    text : str
        The number.
    colour : str
        As CSS has it.
    """

    point: tuple[float, float]
    kind: str
    text: str = ""
    colour: str = "#212121"

    def __post_init__(self):
        if self.kind not in KINDS:
            raise SettingError(f"a mark's kind must be one of {', '.join(KINDS)}, but is {self.kind!r}")

    def state(self) -> dict:
        """It as the layer in the browser knows it."""
        x, z = (float(value) for value in self.point)
        return {"x": x, "z": z, "kind": self.kind, "text": self.text, "colour": self.colour}


@dataclass(frozen=True, eq=False)
class Overlay:
    """A map in colours, drawn over a section's picture.

    Parameters
    ----------
    levels : array of uint8, shape (h, w)
        Places in the palette.
    palette : array of uint8, shape (256, 4)
        Red, green, blue and opacity of each level.
    window : tuple (x_min, x_max, z_min, z_max)
        What it covers to its outer edges, in the section's units.

    Raises
    ------
    SettingError
        If these do not make a picture.
    """

    levels: np.ndarray
    palette: np.ndarray
    window: Window

    def __post_init__(self):
        for name, like in (("levels", "(h, w)"), ("palette", "(256, 4)")):
            array = np.array(getattr(self, name))
            fits = array.shape == (256, 4) if name == "palette" else array.ndim == 2 and array.size
            if array.dtype != np.uint8 or not fits:
                came = f"{array.dtype} of shape {array.shape}"
                raise SettingError(f"an overlay's {name} must be uint8 of shape {like}, but is {came}")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        object.__setattr__(self, "window", checked_window("an overlay's window", self.window))


def mesh_state(vertices, triangles) -> dict:
    """A mesh as the layer in the browser knows it, each edge once.

    Parameters
    ----------
    vertices : array, shape (n, 2)
        In the section's units.
    triangles : array, shape (m, 3)
    """
    mesh = Mesh(vertices, triangles)
    return {"vertices": mesh.vertices.astype("<f8").tobytes(), "edges": mesh.edges.astype("<u4").tobytes()}


def map_state(source, target, triangles) -> dict:
    """A piecewise affine map for the layer in the browser, which locates points as `PiecewiseAffineMap` does."""
    shapes = {name: np.asarray(array, "<f8").tobytes() for name, array in (("source", source), ("target", target))}
    return {**shapes, "triangles": np.asarray(triangles).astype("<u4").tobytes(), "tolerance": TOLERANCE}
