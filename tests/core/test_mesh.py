import numpy as np
import pytest

from seiswidgets.core.mesh import Mesh, triangle_areas
from tests.core.meshes import BLIND, BOX, PLANAR, chain, cut_along, grid

COLUMNS, ROWS = 8, 6
CENTRE = 3 * (COLUMNS + 1) + 4


def row(z, first=0, last=COLUMNS):
    """Vertices along a horizontal line of the grid."""
    return z * (COLUMNS + 1) + np.arange(first, last + 1)


def column(x, first=0, last=ROWS):
    return np.arange(first, last + 1) * (COLUMNS + 1) + x


CUTS = {
    "none": [],
    "through": [chain(row(3))],
    "blind": [chain(row(3, 2, 6))],
    "to one border": [chain(row(3, 0, 4))],
    "bent": [chain(np.append(row(2, 2, 4), column(4, 3, 5)))],
    "crossing": [chain(row(3)), chain(column(4))],
    "branch": [chain(row(3)), chain(column(4, 0, 3))],
    "blind branch": [chain(row(3, 2, 6)), chain(column(4, 1, 3))],
}


@pytest.fixture(params=CUTS)
def cut(request):
    return grid(COLUMNS, ROWS).cut(np.concatenate([np.empty((0, 2), int), *CUTS[request.param]]))


def characteristic(mesh):
    return len(mesh.vertices) - len(mesh.edges) + len(mesh.triangles)


def test_a_disc_has_euler_characteristic_one():
    assert characteristic(grid(COLUMNS, ROWS)) == 1


def test_areas_sum_to_the_box():
    mesh = grid(COLUMNS, ROWS)
    assert mesh.areas.sum() == pytest.approx(COLUMNS * ROWS)
    assert (mesh.areas > 0).all()


def test_area_is_positive_from_x_to_z():
    vertices = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 3.0]])
    np.testing.assert_array_equal(triangle_areas(vertices, np.array([[0, 1, 2], [0, 2, 1]])), [3, -3])


def test_each_edge_is_listed_once_with_its_lower_vertex_first():
    edges = grid(COLUMNS, ROWS).edges
    assert (edges[:, 0] < edges[:, 1]).all()
    assert len(np.unique(edges, axis=0)) == len(edges) == COLUMNS * (ROWS + 1) + ROWS * (COLUMNS + 1) + COLUMNS * ROWS


def test_boundary_and_interior_of_a_box():
    mesh = grid(COLUMNS, ROWS)
    x, z = mesh.vertices.T
    inside = (x > 0) & (x < COLUMNS) & (z > 0) & (z < ROWS)
    np.testing.assert_array_equal(mesh.interior, np.flatnonzero(inside))
    assert len(mesh.boundary) == 2 * (COLUMNS + ROWS)


def test_contour_closes(cut):
    mesh = cut.mesh
    before, vertex, after = mesh.contour.T
    np.testing.assert_array_equal(np.sort(vertex), np.unique(mesh.boundary))
    for other in (before, after):
        np.testing.assert_array_equal(np.sort(other), np.sort(vertex))
    directed = {tuple(edge) for edge in mesh.boundary}
    assert {*zip(before, vertex, strict=True)} == {*zip(vertex, after, strict=True)} == directed


def test_contour_encloses_the_area(cut):
    (x, z), (x_next, z_next) = cut.mesh.vertices[cut.mesh.boundary].transpose(1, 2, 0)
    assert np.sum(x * z_next - x_next * z) / 2 == pytest.approx(COLUMNS * ROWS)


def test_a_cut_keeps_triangles_where_they_were(cut):
    corners = (mesh.vertices[mesh.triangles] for mesh in (cut.whole, cut.mesh))
    np.testing.assert_array_equal(*corners)


@pytest.mark.parametrize(
    ("name", "more_vertices", "blocks"),
    [
        ("none", 0, 1),
        ("through", COLUMNS + 1, 2),
        ("blind", 4 - 1, 1),
        ("to one border", 4, 1),
        ("bent", 5 - 1, 1),
        ("crossing", COLUMNS + ROWS + 3, 4),
        ("branch", COLUMNS + 1 + 3 + 1, 3),
        ("blind branch", 4 - 1 + 2, 1),
    ],
)
def test_vertices_and_blocks_that_a_cut_makes(name, more_vertices, blocks):
    whole = grid(COLUMNS, ROWS)
    mesh = whole.cut(np.concatenate([np.empty((0, 2), int), *CUTS[name]])).mesh
    assert len(mesh.vertices) - len(whole.vertices) == more_vertices
    assert mesh.blocks.max() + 1 == blocks == len(np.unique(mesh.blocks))


def copies_of(cut, vertex):
    """The vertices of the cut mesh that one vertex of the whole mesh has become."""
    return np.unique(cut.mesh.triangles[cut.whole.triangles == vertex])


@pytest.mark.parametrize(
    ("name", "copies"), [("none", 1), ("blind", 2), ("to one border", 1), ("crossing", 4), ("branch", 3)]
)
def test_copies_of_the_middle(name, copies):
    cut = grid(COLUMNS, ROWS).cut(np.concatenate([np.empty((0, 2), int), *CUTS[name]]))
    middle = copies_of(cut, CENTRE)
    assert len(middle) == copies
    np.testing.assert_array_equal(cut.mesh.vertices[middle], np.tile([4.0, 3.0], (copies, 1)))


def test_tips_of_a_blind_cut_stay_joined():
    cut = grid(COLUMNS, ROWS).cut(CUTS["blind"][0])
    slit = row(3, 2, 6)
    assert [len(copies_of(cut, vertex)) for vertex in slit] == [1, 2, 2, 2, 1]
    right, left = cut.sides(chain(slit))
    assert right[0, 0] == left[0, 0]
    assert right[-1, 1] == left[-1, 1]
    assert characteristic(cut.mesh) == 0  # an annulus


def test_a_cut_along_the_border_changes_nothing():
    whole = grid(COLUMNS, ROWS)
    assert len(whole.cut(whole.boundary).mesh.vertices) == len(whole.vertices)


def test_the_sense_of_cut_edges_does_not_matter():
    whole, edges = grid(COLUMNS, ROWS), CUTS["blind"][0]
    np.testing.assert_array_equal(whole.cut(edges).mesh.triangles, whole.cut(edges[:, ::-1]).mesh.triangles)


@pytest.mark.parametrize("line", [PLANAR, BLIND])
@pytest.mark.parametrize("back", [False, True])
def test_sides_lie_to_the_right_and_to_the_left(line, back):
    cut, sides = cut_along(line.reverse() if back else line)
    start, stop = (cut.mesh.vertices[sides[..., k]] for k in (0, 1))
    np.testing.assert_array_equal(start[0], start[1])
    np.testing.assert_array_equal(stop[0], stop[1])
    corners = {tuple(edge): corner for edge, corner in zip(cut.mesh.half_edges, _opposite(cut.mesh), strict=True)}
    for side, turn, sign in ((sides[0], 1, 1), (sides[1], -1, -1)):
        opposite = cut.mesh.vertices[[corners[tuple(edge[::turn])] for edge in side]]
        along, arm = (stop - start)[0], opposite - start[0]
        assert (sign * (along[:, 0] * arm[:, 1] - along[:, 1] * arm[:, 0]) > 0).all()


def _opposite(mesh):
    """For each half-edge, the corner of its triangle that is not on it."""
    return mesh.triangles[:, [2, 0, 1]].ravel()


def test_sides_of_a_fault_through_the_box_are_two_blocks():
    cut, (right, left) = cut_along(PLANAR)
    assert np.ptp(cut.mesh.blocks[right]) == np.ptp(cut.mesh.blocks[left]) == 0
    assert cut.mesh.blocks[right[0, 0]] != cut.mesh.blocks[left[0, 0]]
    assert cut.mesh.areas.sum() == pytest.approx(BOX.area, rel=1e-12)


@pytest.mark.parametrize("name", ["vertices", "triangles"])
def test_a_mesh_cannot_be_changed(name):
    vertices = np.eye(3, 2)
    mesh = Mesh(vertices, [[0, 1, 2]])
    vertices[:] = 0  # the mesh has its own
    assert mesh.vertices.any()
    with pytest.raises(ValueError, match="read-only"):
        getattr(mesh, name)[0, 0] = 1


@pytest.mark.parametrize("line", ["top", "bottom", "inside"])
@pytest.mark.parametrize("turned", [False, True])
def test_a_line_that_is_not_cut_is_found_again_on_the_border_too(line, turned):
    cut = grid(COLUMNS, ROWS).cut(CUTS["blind"][0])
    edges = chain({"top": row(0, 0, COLUMNS), "bottom": row(ROWS, 0, COLUMNS), "inside": row(1, 1, 5)}[line])
    edges = edges[::-1, ::-1] if turned else edges
    found = cut.along(edges)
    np.testing.assert_array_equal(cut.mesh.vertices[found], cut.whole.vertices[edges])
    np.testing.assert_array_equal(found[1:, 0], found[:-1, 1])
