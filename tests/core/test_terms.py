import numpy as np
import pytest

from seiswidgets.core.bedding import AreaChange, BedStretch
from seiswidgets.core.contact import contacts
from seiswidgets.core.facing import Facing
from seiswidgets.core.solver import update_contacts
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, Level, MeanValue, Stitch
from tests.core.derivatives import check_curvature, check_jacobian
from tests.core.meshes import PLANAR, arc, cut_along, rotated

LINES = {"planar": PLANAR, "curved": arc(100.0)}
ANGLES = np.random.default_rng(11).uniform(0, np.pi, 10_000)
DIRECTIONS = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
CUTS = {name: cut_along(line) for name, line in LINES.items()}


def terms_on(name, weight=1.5):
    """Every term there is, on the box cut along a line."""
    cut, sides = CUTS[name]
    mesh = cut.mesh
    count = len(mesh.vertices)
    right, left = contacts(mesh, sides, LINES[name], weight, "contact")
    return {
        "mean value": MeanValue(mesh, weight),
        "contour": ContourLaplacian(mesh, weight),
        "edge length": EdgeLength(mesh.vertices, mesh.edges, weight),
        "stitch": Stitch(sides[:, ::2, 0].T, count, weight),
        "facing": Facing(sides[0, 1:, 0], sides[1, :-1], *np.full((2, sides.shape[1] - 1), 0.3), count, weight),
        "level": Level(np.arange(5, 15), 120.0, count, weight),
        "bed stretch": BedStretch(mesh, DIRECTIONS[: len(mesh.triangles)], weight),
        "area change": AreaChange(mesh, weight),
        "area barrier": AreaBarrier(mesh),
        "contact, right": right,
        "contact, left": left,
    }


NAMES = list(terms_on("planar"))
SHAPES = [
    "mean value",
    "contour",
    "edge length",
    "bed stretch",
    "area change",
    "area barrier",
    "contact, right",
    "contact, left",
]


def on_both_lines(names):
    """Each term at a straight fault, and those at a curved one which that makes different."""
    cases = [(line, name) for line in LINES for name in names if line == "planar" or name.startswith("contact")]
    return pytest.mark.parametrize(("line", "name"), cases)


EVERY_TERM, SHAPE_TERMS = on_both_lines(NAMES), on_both_lines(SHAPES)
PAPERS_TERMS = on_both_lines([name for name in NAMES if name not in ("bed stretch", "area change", "area barrier")])


def case(line, name, weight=1.5):
    """A term, with its partners at rest chosen, and the vertices at rest."""
    term, rest = terms_on(line, weight)[name], CUTS[line][0].mesh.vertices
    return update_contacts([term], rest)[0], rest


def perturbed(vertices, rng, size):
    return vertices + size * rng.standard_normal(vertices.shape)


def energy(term, vertices):
    return np.sum(term.residual(vertices) ** 2)


@EVERY_TERM
@pytest.mark.parametrize("size", [0.0, 15.0])
def test_jacobian_is_the_derivative(line, name, size):
    term, rest = case(line, name)
    rng = np.random.default_rng(7)
    vertices = perturbed(rest, rng, size)
    check_jacobian(update_contacts([term], vertices)[0], vertices, rng)


@EVERY_TERM
def test_jacobian_is_the_derivative_after_a_large_turn(line, name):
    term, rest = case(line, name)
    rng = np.random.default_rng(8)
    check_jacobian(term, perturbed(rotated(rest, 2.5), rng, 3.0), rng)


@pytest.mark.parametrize("squeeze", [0.35, 0.01])
def test_jacobian_of_the_barrier_is_the_derivative_when_squeezed(squeeze):
    barrier, rest = case("planar", "area barrier")
    vertices = rest * [squeeze, 1]
    assert len(barrier.residual(vertices)) == len(barrier.mesh.triangles)
    check_jacobian(barrier, vertices, np.random.default_rng(9), step=1e-6)


CURVED = [
    ("edge length", 0.9),
    ("contour", 0.9),
    ("contact, right", 0.9),
    ("area barrier", 0.35),
    ("area barrier", 0.1),
]


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize(("name", "squeeze"), CURVED)
def test_curvature_is_what_the_jacobian_leaves_of_the_second_derivative(line, name, squeeze):
    term, rest = case(line, name)
    vertices = perturbed(rest * [squeeze, 1], np.random.default_rng(4), 0.5)
    check_curvature(update_contacts([term], vertices)[0], vertices, np.random.default_rng(10))


@SHAPE_TERMS
@pytest.mark.parametrize("angle", [0.3, -2.0])
def test_a_rigid_motion_costs_nothing(line, name, angle):
    term, rest = case(line, name)
    moved = rotated(np.add(rest, (2000.0, -700.0)), angle, (300, 200))
    snapped = line == "curved" and name.startswith("contact")  # a mesh's vertices are a little off a drawn arc
    np.testing.assert_allclose(term.residual(moved), 0, atol=1e-4 if snapped else 1e-9)


@SHAPE_TERMS
def test_a_deformation_costs_something(line, name):
    term, rest = case(line, name)
    assert energy(term, perturbed(rest * [0.5, 1], np.random.default_rng(0), 20.0)) > 1


@PAPERS_TERMS
def test_the_weight_multiplies_the_rows(line, name):
    (one, rest), (three, _) = case(line, name, 1.0), case(line, name, 3.0)
    vertices = perturbed(rest, np.random.default_rng(1), 5.0)
    np.testing.assert_allclose(three.residual(vertices), 3 * one.residual(vertices), rtol=1e-9)


@PAPERS_TERMS
def test_rows_and_targets_of_the_fixed_point_have_the_same_energy(line, name):
    term, rest = case(line, name)
    vertices = perturbed(rest, np.random.default_rng(2), 5.0)
    term = update_contacts([term], vertices)[0]
    lagged = np.sum((term.rows @ vertices - term.target(vertices)) ** 2)
    assert lagged == pytest.approx(energy(term, vertices), rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("share", [1.0, 0.41])
def test_the_barrier_is_silent_while_areas_are_kept(share):
    barrier, rest = case("planar", "area barrier")
    assert barrier.residual(rest * [share, 1]).size == 0
    assert barrier.jacobian(rest * [share, 1]).shape == (0, rest.size)


def test_the_barrier_is_without_bound_when_squeezed():
    barrier, rest = case("planar", "area barrier")
    energies = [energy(barrier, rest * [share, 1]) for share in (0.39, 0.2, 1e-2, 1e-4, 1e-6)]
    assert (np.diff(energies) > 0).all()
    assert energies[-1] == pytest.approx(barrier.mesh.areas.sum() * 1e12, rel=1e-4)


def test_shear_along_the_beds_costs_nothing():
    mesh = CUTS["planar"][0].mesh
    sheared = mesh.vertices + np.outer(mesh.vertices[:, 1], [0.7, 0.0])
    level, upright = (np.tile(direction, (len(mesh.triangles), 1)) for direction in ([1.0, 0.0], [0.0, 1.0]))
    np.testing.assert_allclose(BedStretch(mesh, level).residual(sheared), 0, atol=1e-9)
    np.testing.assert_allclose(AreaChange(mesh).residual(sheared), 0, atol=1e-9)
    assert energy(BedStretch(mesh, upright), sheared) == pytest.approx((np.hypot(1, 0.7) - 1) ** 2 * mesh.areas.sum())


def test_level_sees_z_only():
    level, rest = case("planar", "level")
    aside = rest + np.outer(np.random.default_rng(3).standard_normal(len(rest)), [100, 0])
    np.testing.assert_array_equal(level.residual(aside), level.residual(rest))
    at_datum = rest.copy()
    at_datum[level.vertices, 1] = 120.0
    np.testing.assert_array_equal(level.residual(at_datum), 0)
    assert not level.jacobian(rest)[:, ::2].nnz


def test_stitch_is_silent_where_its_pairs_meet():
    stitch, rest = case("planar", "stitch")
    np.testing.assert_array_equal(stitch.residual(rest), 0)
    apart = rest.copy()
    apart[stitch.pairs[:, 0]] += [3, 4]
    assert energy(stitch, apart) == pytest.approx(len(stitch.pairs) * (1.5 * 5) ** 2)


def test_edge_length_measures_the_stretch():
    term, rest = case("planar", "edge length")
    lengths = np.linalg.norm(rest[term.edges[:, 0]] - rest[term.edges[:, 1]], axis=1)
    np.testing.assert_allclose(term.residual(1.1 * rest), 1.5 * 0.1 * lengths, rtol=1e-9)


def test_contour_follows_a_stretch_that_keeps_its_bends():
    """The bend is kept in metres: twice the size leaves one bend too many at each corner, none on straight sides."""
    term, rest = case("planar", "contour")
    bend = term.rows @ rest
    np.testing.assert_allclose(term.residual(2 * rest).reshape(-1, 2), bend, atol=1e-9)


@pytest.mark.parametrize("name", ["contour", "edge length", "contact, right"])
def test_a_collapsed_mesh_gives_finite_numbers(name):
    term, rest = case("planar", name)
    point = np.zeros_like(rest)
    assert np.isfinite(term.residual(point)).all()
    assert np.isfinite(term.jacobian(point).data).all()
