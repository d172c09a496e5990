"""Lines, marks and a map in colours, drawn over a section's picture."""

from base64 import b64encode
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import TOLERANCE
from seiswidgets.errors import SettingError
from seiswidgets.interaction.viewport import Window, checked_window

MARK_KINDS = ("cutoff", "held", "cursor", "finding")
State = dict[str, Any]  # as JSON

# of strokes and marks, what the browser assumes unless it is sent something else
USUAL = {"dots": False, "dash": [], "label": "", "chosen": None, "joined": True, "text": "", "path": ""}


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line on a section, with a pale rim so that it stands out from any colour.

    Parameters
    ----------
    points : array, shape (n, 2)
        In the section's units; the line is interrupted where they are NaN.
    colour : str
        A CSS colour.
    width : float
        In css pixels.
    dots : bool
        True to show the vertices.
    dash : tuple of float
        Lengths of dashes and gaps, in css pixels.
    label : str
        Text near the start of the line.
    chosen : int, optional
        Index of a vertex to show larger.
    joined : bool
        False to show no line between the vertices.
    """

    points: np.ndarray
    colour: str = "#d7191c"
    width: float = 2.0
    dots: bool = False
    dash: tuple[float, ...] = ()
    label: str = ""
    chosen: int | None = None
    joined: bool = True

    def state(self) -> State:
        """Convert to what the pointer layer draws: points as 32-bit offsets from the first, NaN where interrupted."""
        points = np.reshape(np.asarray(self.points, float), (-1, 2))
        drawable = np.asarray(np.isfinite(points).all(axis=1))
        origin = np.array([float(f"{value:.9g}") for value in points[drawable][0]]) if drawable.any() else np.zeros(2)
        return {
            "origin": origin.tolist(),
            "points": np.where(drawable[:, None], points - origin, np.nan).astype("<f4").tobytes(),
            "colour": self.colour,
            "width": self.width,
            "dots": self.dots,
            "dash": list(self.dash),
            "label": self.label,
            "chosen": self.chosen,
            "joined": self.joined,
        }


def without_usual(states: list[State], _: object = None) -> list[State]:
    """States of strokes or marks without what is as usual: they are sent again and again during a drag."""
    return [{name: value for name, value in state.items() if USUAL.get(name, ...) != value} for state in states]


def stroke_points(state: State) -> np.ndarray:
    """Points of a stroke's state, shape (n, 2); NaN where the line is interrupted."""
    return np.frombuffer(state["points"], "<f4").reshape(-1, 2) + np.array(state["origin"])


@dataclass(frozen=True)
class Mark:
    """A marked point on a section.

    Parameters
    ----------
    point : tuple (x, z)
        In the section's units; where it is NaN, the mark is not shown.
    kind : {"cutoff", "held", "cursor", "finding"}
        A disc with a number, a pin, the cross of the keyboard cursor, and a flag that can be clicked.
    text : str
        Number on the disc; tooltip of the flag.
    colour : str
        A CSS colour.
    path : str
        SVG path of the icon on a flag, in a square of 16 units.
    """

    point: tuple[float, float]
    kind: str
    text: str = ""
    colour: str = "#212121"
    path: str = ""

    def __post_init__(self) -> None:
        if self.kind not in MARK_KINDS:
            raise SettingError(f"a mark's kind must be one of {', '.join(MARK_KINDS)}, but is {self.kind!r}")

    def state(self) -> State:
        """Convert to the JSON that the pointer layer draws."""
        x, z = (float(f"{value:.9g}") for value in self.point)
        return {"x": x, "z": z, "kind": self.kind, "text": self.text, "colour": self.colour, "path": self.path}


@dataclass(frozen=True, eq=False)
class Overlay:
    """A map in colours, drawn over a section's picture.

    Parameters
    ----------
    levels : array of uint8, shape (h, w)
        Indices into the palette.
    palette : array of uint8, shape (256, 4)
        Red, green, blue and alpha of each level.
    window : tuple (x_min, x_max, z_min, z_max)
        Extent of the map to its outer edges, in the section's units.

    Raises
    ------
    SettingError
        If the arrays do not make a picture.
    """

    levels: np.ndarray
    palette: np.ndarray
    window: Window

    def __post_init__(self) -> None:
        for name, shape in (("levels", "(h, w)"), ("palette", "(256, 4)")):
            array = np.array(getattr(self, name))
            fits = array.shape == (256, 4) if name == "palette" else array.ndim == 2 and array.size
            if array.dtype != np.uint8 or not fits:
                actual = f"{array.dtype} of shape {array.shape}"
                raise SettingError(f"an overlay's {name} must be uint8 of shape {shape}, but is {actual}")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        object.__setattr__(self, "window", checked_window("an overlay's window", self.window))

    def state(self, opacity: float) -> State:
        """Convert to what the pointer layer draws."""
        buffer = BytesIO()
        Image.fromarray(self.palette[self.levels]).save(buffer, "png")
        href = f"data:image/png;base64,{b64encode(buffer.getvalue()).decode()}"
        return {"href": href, "window": list(self.window), "opacity": opacity}


def mesh_state(vertices: np.ndarray, triangles: np.ndarray) -> State:
    """Convert a mesh to what the pointer layer draws: its vertices, and each edge once.

    Parameters
    ----------
    vertices : array, shape (n, 2)
        In the section's units.
    triangles : array, shape (m, 3)
    """
    mesh = Mesh(vertices, triangles)
    return {"vertices": mesh.vertices.astype("<f8").tobytes(), "edges": mesh.edges.astype("<u4").tobytes()}


def map_state(source: ArrayLike, target: ArrayLike, triangles: ArrayLike) -> State:
    """A piecewise affine map for the layer in the browser, which locates points as `PiecewiseAffineMap` does."""
    arrays = {name: np.asarray(array, "<f8").tobytes() for name, array in (("source", source), ("target", target))}
    return {**arrays, "triangles": np.asarray(triangles).astype("<u4").tobytes(), "tolerance": TOLERANCE}
