from dataclasses import replace

import numpy as np
import pytest

from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.solver import energy, first_flip, fixed_point, gauss_newton
from seiswidgets.core.terms import AreaBarrier, Level, MeanValue
from seiswidgets.core.triangulation import triangulate
from seiswidgets.errors import Cancelled
from tests.core.meshes import BOX, PLANAR, arc, grid, rotated
from tests.core.problems import (
    FOLDED,
    PROBLEMS,
    about_centre,
    along_planar,
    faulted,
    levelled,
    shape_terms,
    unfolded,
    whole,
)

TOLERANCE = 1e-4


@pytest.mark.parametrize("seed", range(6))
def test_first_flip_is_where_a_dense_scan_finds_it(seed):
    mesh, rng = grid(4, 3), np.random.default_rng(seed)
    step = rng.standard_normal(mesh.vertices.shape) * rng.uniform(0.02, 2)
    shares = np.linspace(0, 5, 5001)
    least = np.array([triangle_areas(mesh.vertices + share * step, mesh.triangles).min() for share in shares])
    flipped = np.flatnonzero(least <= 0)
    flip = first_flip(mesh.vertices, step, mesh.triangles)
    if len(flipped):
        assert shares[flipped[0] - 1] <= flip <= shares[flipped[0]]
    else:
        assert flip > 5


@pytest.mark.parametrize(
    ("step", "flip"),
    [
        (lambda points: 0 * points, np.inf),
        (lambda points: 0 * points + [3.0, -1.0], np.inf),
        (lambda points: points, np.inf),
        (lambda points: -points * [2.0, 0.0], 0.5),
        (lambda points: -points * [2.0, 4.0], 0.25),
        (lambda points: points[:, ::-1] * [-1.0, 1.0], np.inf),  # a turn, which grows
        (lambda points: points[:, ::-1] * [0.5, 0.5], 2.0),  # a squeeze along the diagonal
    ],
)
def test_first_flip_of_affine_steps(step, flip):
    mesh = grid(3, 3)
    assert first_flip(mesh.vertices, step(mesh.vertices), mesh.triangles) == pytest.approx(flip)


def test_a_quadratic_energy_takes_one_step():
    mesh = triangulate(BOX, [PLANAR], 80.0)
    free = np.zeros(len(mesh.vertices), bool)
    free[mesh.interior] = True
    middle = mesh.interior[np.argsort(np.abs(mesh.vertices[mesh.interior, 1] - 300))[:5]]
    terms = [MeanValue(mesh), Level(middle, 310.0, len(free), 10.0)]
    solution = gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE)
    assert solution.converged
    assert solution.iterations <= 2
    unknown = np.repeat(free, 2)
    gradient = sum(term.jacobian(solution.vertices).T @ term.residual(solution.vertices) for term in terms)
    assert np.abs(gradient[unknown]).max() < 1e-6


@pytest.mark.parametrize("distance", [-80.0, 120.0])
def test_a_block_slides_back_along_a_straight_fault(distance):
    mesh, terms, free = faulted(PLANAR, along_planar(-distance))
    solution = gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE)
    assert solution.converged
    assert energy(solution.terms, solution.vertices) < 1e-6
    expected = np.where(free[:, None], along_planar(-distance)(mesh.vertices), mesh.vertices)
    np.testing.assert_allclose(solution.vertices, expected, atol=1e-3)


@pytest.mark.parametrize("turn", [-0.06, 0.04])
def test_a_block_turns_back_along_a_circular_fault(turn):
    mesh, terms, free = faulted(arc(50.0), about_centre(turn))
    solution = gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE)
    assert solution.converged
    assert solution.iterations <= 15
    expected = np.where(free[:, None], about_centre(turn)(mesh.vertices), mesh.vertices)
    np.testing.assert_allclose(solution.vertices, expected, atol=0.05)


@pytest.mark.parametrize("angle", [1.0, -2.5])
def test_the_answer_turns_with_the_section(angle):
    """Slid back, then turned, or turned, then slid back: no term knows which way is up."""
    line = arc(50.0)
    mesh, terms, free = faulted(line, about_centre(0.04))
    upright = gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE)
    turned = gauss_newton(terms, mesh.triangles, rotated(mesh.vertices, angle), free, TOLERANCE)
    np.testing.assert_allclose(turned.vertices, rotated(upright.vertices, angle), atol=1e-2)


@pytest.fixture(scope="module", params=PROBLEMS)
def solved(request):
    mesh, terms, free = PROBLEMS[request.param]()
    seen = []
    solution = gauss_newton(
        terms, mesh.triangles, mesh.vertices, free, TOLERANCE, progress=lambda *now: seen.append(now)
    )
    return mesh, free, solution, seen


def test_it_converges(solved):
    _, _, solution, _ = solved
    assert solution.converged
    assert solution.factorisations >= solution.iterations


def test_the_energy_never_rises(solved):
    _, _, solution, _ = solved
    energies = np.array(solution.energies)
    assert len(energies) == solution.iterations + 1
    assert (np.diff(energies) <= 1e-9 * energies[0]).all()
    assert energies[-1] == energy(solution.terms, solution.vertices)


def test_held_vertices_do_not_move(solved):
    mesh, free, solution, _ = solved
    np.testing.assert_array_equal(solution.vertices[~free], mesh.vertices[~free])


def test_no_triangle_is_ever_flipped(solved):
    mesh, _, _, seen = solved
    for _, _, vertices in seen:
        assert triangle_areas(vertices, mesh.triangles).min() > 0


def test_progress_is_told_of_every_iteration(solved):
    _, _, solution, seen = solved
    iterations, energies, positions = zip(*seen, strict=True)
    assert iterations == tuple(range(1, solution.iterations + 1))
    assert energies == solution.energies[1:]
    np.testing.assert_array_equal(positions[-1], solution.vertices)


def test_the_gradient_vanishes_at_the_end(solved):
    mesh, free, solution, _ = solved

    def gradient(vertices):
        parts = [term.jacobian(vertices).T @ term.residual(vertices) for term in solution.terms]
        return np.abs(sum(parts)[np.repeat(free, 2)]).max()

    assert gradient(solution.vertices) < 1e-4 * gradient(mesh.vertices)


def test_the_folded_horizon_is_level():
    mesh, terms, horizon = whole(FOLDED, spacing=50.0)
    free = np.ones(len(mesh.vertices), bool)
    terms = [*terms[:3], replace(terms[3], weight=100.0), AreaBarrier(mesh)]
    solution = gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE)
    assert np.ptp(mesh.vertices[horizon, 1]) > 199
    assert np.ptp(solution.vertices[horizon, 1]) < 1


def test_at_rest_it_stops_at_once():
    mesh = triangulate(BOX, [PLANAR], 80.0)
    solution = run("gauss-newton", mesh, shape_terms(mesh), np.ones(len(mesh.vertices), bool))
    assert solution.converged
    assert solution.iterations <= 2
    np.testing.assert_allclose(solution.vertices, mesh.vertices, atol=TOLERANCE)


@pytest.mark.parametrize("solve", ["gauss-newton", "fixed-point"])
def test_with_everything_held_nothing_moves(solve):
    mesh, terms, free = levelled()
    solution = run(solve, mesh, terms, ~free)
    assert solution.converged
    np.testing.assert_array_equal(solution.vertices, mesh.vertices)


@pytest.mark.parametrize("solve", ["gauss-newton", "fixed-point"])
def test_returning_false_cancels(solve):
    mesh, terms, free = levelled()
    calls = []

    def progress(iteration, energy, vertices):
        calls.append(iteration)
        return iteration < 2

    with pytest.raises(Cancelled, match="cancelled after iteration 2"):
        run(solve, mesh, terms, free, progress=progress)
    assert calls == [1, 2]


@pytest.mark.parametrize("answer", [None, 0, True])
def test_only_false_cancels(answer):
    mesh, terms, free = levelled()
    assert run("gauss-newton", mesh, terms, free, progress=lambda *now: answer).converged


def test_progress_cannot_change_the_vertices():
    mesh, terms, free = levelled()

    def progress(iteration, energy, vertices):
        vertices[:] = 0

    spoiled, plain = (run("gauss-newton", mesh, terms, free, progress=spoil) for spoil in (progress, None))
    np.testing.assert_array_equal(spoiled.vertices, plain.vertices)


@pytest.mark.parametrize("solve", ["gauss-newton", "fixed-point"])
def test_it_says_so_when_it_did_not_get_there(solve):
    mesh, terms, free = levelled()
    solution = run(solve, mesh, terms, free, max_iterations=2)
    assert not solution.converged
    assert solution.iterations == 2
    assert len(solution.energies) == 3


def run(solve, mesh, terms, free, **options):
    if solve == "fixed-point":
        return fixed_point(terms, mesh.vertices, free, TOLERANCE, **options)
    return gauss_newton(terms, mesh.triangles, mesh.vertices, free, TOLERANCE, **options)


def test_the_fixed_point_gets_to_the_same_place_more_slowly():
    mesh, terms, free = levelled()
    newton, fixed = (run(solve, mesh, terms, free, max_iterations=200) for solve in ("gauss-newton", "fixed-point"))
    assert newton.converged
    assert newton.energies[-1] < fixed.energies[-1] < 0.9 * fixed.energies[0]
    assert newton.iterations < 20 < fixed.iterations
    assert newton.energies[0] == fixed.energies[0] == energy(terms, mesh.vertices)


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_fixed_point_lowers_the_energy_and_holds_what_is_held(name):
    mesh, terms, free = PROBLEMS[name]()
    solution = fixed_point(terms, mesh.vertices, free, TOLERANCE, max_iterations=50)
    assert solution.energies[-1] < solution.energies[0]
    assert solution.factorisations == 1
    np.testing.assert_array_equal(solution.vertices[~free], mesh.vertices[~free])


def test_the_fixed_point_leaves_out_the_barrier():
    mesh, terms, free = levelled()
    plain, barred = (
        fixed_point(chosen, mesh.vertices, free, TOLERANCE, max_iterations=3)
        for chosen in (terms, [*terms, AreaBarrier(mesh)])
    )
    assert [term.name for term in plain.terms] == [term.name for term in barred.terms]
    np.testing.assert_array_equal(plain.vertices, barred.vertices)


def test_a_solution_is_a_fixed_point_of_gauss_newton():
    mesh, terms, free = unfolded()
    first = run("gauss-newton", mesh, terms, free)
    again = gauss_newton(first.terms, mesh.triangles, first.vertices, free, TOLERANCE)
    assert again.iterations == 1
    np.testing.assert_allclose(again.vertices, first.vertices, atol=TOLERANCE)
