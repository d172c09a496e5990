"""Small meshes that several tests share, in metres."""

import numpy as np
import shapely

from seiswidgets.core.curves import along_curve, move_onto, smooth_curve
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.triangulation import edges_along, triangulate

BOX = shapely.box(0, 0, 1000, 600)
PLANAR = shapely.LineString([(400, 0), (600, 600)])  # cuts the box in two
BLIND = shapely.LineString([(400, 200), (600, 400)])


def grid(columns, rows):
    """A box of unit squares, halved; the vertex at (x, z) has the index z * (columns + 1) + x."""
    x, z = np.meshgrid(np.arange(columns + 1), np.arange(rows + 1))
    corner = np.arange((columns + 1) * (rows + 1)).reshape(x.shape)[:-1, :-1].ravel()
    across, down, both = corner + 1, corner + columns + 1, corner + columns + 2
    triangles = np.concatenate([np.column_stack([corner, across, both]), np.column_stack([corner, both, down])])
    return Mesh(np.column_stack([x.ravel(), z.ravel()]), triangles)


def chain(vertices):
    """Directed edges from each vertex of a list to the next."""
    return np.column_stack([vertices[:-1], vertices[1:]])


def cut_along(line, *others, spacing=100.0):
    """The box meshed and cut along a line: the cut, and both copies of the line's edges."""
    curve = shapely.intersection(smooth(line), BOX)
    chords = along_curve(curve, [curve.project(shapely.Point(other.coords[0])) for other in others], spacing)
    whole = triangulate(BOX, [chords, *others], spacing)
    edges = edges_along(whole, chords, spacing)
    cut = move_onto(whole, edges, curve).cut(edges)
    return cut, cut.sides(edges)


def smooth(line):
    """The smooth curve that a drawn line stands for."""
    return shapely.LineString(smooth_curve(shapely.get_coordinates(line), 1e-5))


def arc(chord, radius=1500.0, centre=(1500.0, -300.0), first=0.19, last=0.69):
    """A circle's arc as it is drawn, by chords of about the given length; from above the box to below it."""
    angles = np.linspace(first, last, round(radius * (last - first) / chord) + 1)
    return shapely.LineString(
        np.column_stack([centre[0] - radius * np.cos(angles), centre[1] + radius * np.sin(angles)])
    )


def rotated(points, angle, centre=(0.0, 0.0)):
    """Points turned from x towards z."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return (points - np.array(centre)) @ [[cosine, sine], [-sine, cosine]] + centre
