"""Restorations in small, on the box: each a mesh, the terms, and which vertices are free."""

import numpy as np
import shapely

from seiswidgets.core.contact import contacts
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, Level, MeanValue, Stitch
from seiswidgets.core.triangulation import edges_along, triangulate
from tests.core.meshes import BOX, PLANAR, arc, cut_along, rotated, smooth

TILTED = shapely.LineString([(0, 250), (1000, 350)])
FOLD_X = np.linspace(0, 1000, 81)
# limbs of 51 degrees
FOLDED = shapely.LineString(np.column_stack([FOLD_X, 300 + 100 * np.sin(2 * np.pi * FOLD_X / 500)]))


def shape_terms(mesh):
    return [MeanValue(mesh), ContourLaplacian(mesh), EdgeLength(mesh.vertices, mesh.edges)]


def whole(line, spacing=70.0):
    """The box with a horizon in it: its mesh, and the terms that make the horizon level."""
    mesh = triangulate(BOX, [line], spacing)
    horizon = np.unique(edges_along(mesh, line, spacing))
    terms = [*shape_terms(mesh), Level(horizon, mesh.vertices[horizon, 1].mean(), len(mesh.vertices), 10.0)]
    return mesh, terms, horizon


def faulted(line, motion, spacing=70.0):
    """The box cut in two, and the terms that bring back the block at larger x: one pair of cut-offs is stitched.

    ``motion`` is the block's known way back; it takes the block's cut-off to its partner.
    """
    cut_off = np.array(shapely.intersection(smooth(line), BOX).interpolate(0.55, normalized=True).coords)[0]
    partner = motion(cut_off)
    # a bed from each makes them vertices
    beds = [shapely.LineString([place, np.add(place, (60.0, 0.0))]) for place in (cut_off, partner)]
    cut, (left, right) = cut_along(line, *beds, spacing=spacing)
    mesh = cut.mesh
    free = mesh.blocks == mesh.blocks[right[0, 0]]
    pair = [_nearest(mesh, left, partner), _nearest(mesh, right, cut_off)]
    terms = [
        *shape_terms(mesh),
        *contacts(mesh, np.stack([left, right]), smooth(line), 10.0, "contact"),
        Stitch(np.array([pair]), len(mesh.vertices), 10.0),
        AreaBarrier(mesh),
    ]
    return mesh, terms, free


def _nearest(mesh, side, place):
    vertices = np.unique(side)
    return vertices[np.argmin(np.linalg.norm(mesh.vertices[vertices] - place, axis=1))]


def along_planar(distance):
    return lambda points: np.add(points, distance * np.array([200.0, 600.0]) / np.hypot(200, 600))


def about_centre(turn):
    return lambda points: rotated(np.asarray(points), turn, (1500.0, -300.0))


def levelled():
    mesh, terms, _ = whole(TILTED)
    return mesh, terms, np.ones(len(mesh.vertices), bool)


def unfolded():
    mesh, terms, _ = whole(FOLDED, spacing=50.0)
    return mesh, [*terms, AreaBarrier(mesh)], np.ones(len(mesh.vertices), bool)


PROBLEMS = {
    "slide": lambda: faulted(PLANAR, along_planar(-80.0)),
    "turn": lambda: faulted(arc(50.0), about_centre(0.05)),
    "tilt": levelled,
    "fold": unfolded,
}
