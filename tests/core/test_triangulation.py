import re

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from seiswidgets.core import meshers
from seiswidgets.core.triangulation import edges_along, triangulate, triangulate_to
from seiswidgets.errors import SettingError
from tests.core.meshes import BLIND, BOX, PLANAR, arc

STEEP = shapely.LineString([(300, -50), (420, 310), (450, 700)])  # from outside to outside
RISING = shapely.LineString([(380, 420), (640, 180)])
LEVEL = shapely.LineString([(0, 350), (1000, 300)])
HOLED = shapely.Polygon(BOX.exterior, [[(200, 200), (200, 400), (300, 400), (300, 200)]])
OUTLINES = {
    "box": BOX,
    "shifted": shapely.transform(BOX, lambda points: points * 3.7 + [123_456.7, -98_765.4]),
    "hole": HOLED,
    "two parts": shapely.MultiPolygon([shapely.box(0, 0, 400, 600), shapely.box(500, 0, 1000, 600)]),
    "bent": shapely.Polygon([(0, 0), (1000, 40), (960, 610), (480, 380), (30, 555)]),
}
LINES = {
    "planar": [PLANAR],
    "blind": [BLIND],
    "curved": [arc(50.0)],
    "crossing": [BLIND, RISING],
    "crossing at a narrower angle": [BLIND, LEVEL],
    "across the border": [STEEP, LEVEL],
    "branch": [LEVEL, shapely.LineString([(500, 325), (700, 600)])],
}


@pytest.fixture(params=meshers.MESHERS, autouse=True)
def mesher(request, monkeypatch):
    monkeypatch.setattr(meshers, "MESHERS", {request.param: meshers.MESHERS[request.param]})
    return request.param


def angles(mesh):
    """The angles of all triangles, degrees."""
    corners = mesh.vertices[mesh.triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0]
    return np.degrees(np.arctan2(np.abs(cross), np.sum(ahead * back, axis=-1)))


def lengths(mesh, edges):
    return np.linalg.norm(np.diff(mesh.vertices[edges], axis=1)[:, 0], axis=1)


@pytest.mark.parametrize("name", OUTLINES)
def test_fills_its_outline(name):
    outline = OUTLINES[name]
    mesh = triangulate(outline, [], np.sqrt(outline.area) / 10)
    exact = 1e-9 if name in ("box", "shifted") else 1e-7  # other corners are snapped, by 2**-24 of the size
    assert mesh.areas.sum() == pytest.approx(outline.area, rel=exact)
    assert (mesh.areas > 0).all()
    assert mesh.blocks.max() + 1 == len(shapely.get_parts(outline))
    border = mesh.vertices[mesh.boundary]
    assert np.sum(np.linalg.norm(border[:, 1] - border[:, 0], axis=1)) == pytest.approx(outline.length, rel=exact)


def test_every_vertex_belongs_to_a_triangle():
    mesh = triangulate(HOLED, [LEVEL], 60.0)
    np.testing.assert_array_equal(np.unique(mesh.triangles), np.arange(len(mesh.vertices)))


def test_a_hole_stays_empty():
    mesh = triangulate(HOLED, [LEVEL], 60.0)
    centroids = shapely.points(mesh.vertices[mesh.triangles].mean(axis=1))
    assert shapely.contains(HOLED, centroids).all()


@pytest.mark.parametrize("name", LINES)
@pytest.mark.parametrize("spacing", [30.0, 100.0])
def test_conforms_to_every_line(name, spacing):
    mesh = triangulate(BOX, LINES[name], spacing)
    for line in LINES[name]:
        inside = shapely.intersection(line, BOX)
        edges = edges_along(mesh, line, spacing)
        assert lengths(mesh, edges).sum() == pytest.approx(inside.length, rel=1e-6)
        np.testing.assert_array_equal(edges[1:, 0], edges[:-1, 1])  # one after the other
        ends = shapely.get_coordinates(inside)[[0, -1]]
        np.testing.assert_allclose(mesh.vertices[[edges[0, 0], edges[-1, 1]]], ends, atol=1e-4)


def test_crossings_are_vertices():
    mesh = triangulate(BOX, [BLIND, LEVEL], 70.0)
    crossing = shapely.get_coordinates(BLIND.intersection(LEVEL))[0]
    assert np.linalg.norm(mesh.vertices - crossing, axis=1).min() < 1e-4


def test_a_line_off_the_mesh_has_no_edges():
    mesh = triangulate(BOX, [PLANAR], 100.0)
    assert edges_along(mesh, shapely.LineString([(1500, 0), (1600, 600)]), 100.0).shape == (0, 2)


@pytest.mark.parametrize("name", ["box", "shifted", "hole", "two parts"])
def test_no_angle_is_small(name, mesher):
    mesh = triangulate(OUTLINES[name], [], np.sqrt(OUTLINES[name].area) / 15)
    assert angles(mesh).min() > meshers.LEAST_ANGLE[mesher] - 0.1


@pytest.mark.parametrize("name", ["planar", "blind", "curved", "crossing", "branch"])  # no angle below 60 degrees
def test_no_angle_is_small_near_lines(name, mesher):
    assert angles(triangulate(BOX, LINES[name], 40.0)).min() > meshers.LEAST_ANGLE[mesher] - 0.1


@pytest.mark.parametrize("spacing", [20.0, 50.0, 100.0])
def test_edges_are_about_as_long_as_the_spacing(spacing):
    mesh = triangulate(BOX, [PLANAR], spacing)
    assert np.median(lengths(mesh, mesh.edges)) == pytest.approx(spacing, rel=0.25)


@pytest.mark.parametrize(("count", "lines"), [(600, []), (6000, [PLANAR, LEVEL]), (20000, [arc(50.0)])])
def test_makes_about_as_many_vertices_as_asked_for(count, lines):
    assert len(triangulate_to(BOX, lines, count).vertices) == pytest.approx(count, rel=0.15)


@pytest.mark.parametrize(
    ("spacing", "message"),
    [
        (0.5, "spacing of 0.5 m would make about .* vertices; the limit is 250,000: choose at least"),
        (5000.0, "spacing of 5000 m makes only 4 vertices; at least 30 are needed"),
    ],
)
def test_an_absurd_spacing_is_refused(spacing, message):
    with pytest.raises(SettingError, match=message):
        triangulate(BOX, [], spacing)


def test_the_spacing_that_a_refusal_advises_is_taken():
    with pytest.raises(SettingError, match="choose at least") as refusal:
        triangulate(BOX, [], 0.5)
    advised = float(re.search(r"at least ([\d.]+) m", str(refusal.value))[1])
    assert len(triangulate(BOX, [], advised).vertices) > 200_000


points = st.tuples(st.integers(-20, 120), st.integers(-20, 80)).map(lambda point: (10.0 * point[0], 10.0 * point[1]))
polylines = st.lists(points, min_size=2, max_size=6, unique=True).map(shapely.LineString)


def may_be_picked(line):
    """Return whether a line neither crosses itself nor turns back by more than 170 degrees, as picks must not."""
    arms = np.diff(shapely.get_coordinates(line), axis=0)
    arms /= np.linalg.norm(arms, axis=1)[:, None]
    return line.is_simple and (np.sum(arms[1:] * arms[:-1], axis=1) > -np.cos(np.radians(10))).all()


polylines = polylines.filter(may_be_picked)


@settings(deadline=None, max_examples=50, derandomize=True)
@given(st.lists(polylines, min_size=1, max_size=3))
def test_any_drawing_makes_a_mesh_that_conforms_to_it(lines):
    mesh = triangulate(BOX, lines, 120.0)
    assert (mesh.areas > 0).all()
    assert mesh.areas.sum() == pytest.approx(BOX.area, rel=1e-6)
    for line in lines:
        inside = shapely.intersection(line, BOX)
        edges = np.unique(np.sort(edges_along(mesh, line, 120.0), axis=1), axis=0)
        # what lies within a tenth of a metre becomes one, and both ends are drawn on to the border over 12 m
        assert lengths(mesh, edges).sum() == pytest.approx(inside.length, rel=1e-3, abs=25.0)
