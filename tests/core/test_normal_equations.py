from dataclasses import replace

import numpy as np
import pytest

from seiswidgets.core import cholesky, normal_equations
from seiswidgets.core.contact import contacts
from seiswidgets.core.normal_equations import NormalEquations, Springs
from seiswidgets.core.solver import residuals, update_contacts
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, Level, MeanValue, Stitch
from tests.core.meshes import PLANAR, cut_along

CUT, SIDES = cut_along(PLANAR)
MESH = CUT.mesh
REST = MESH.vertices
HELD = MESH.blocks == MESH.blocks[SIDES[0, 0, 0]]
SLID = REST + np.outer(~HELD, (30.0, 90.0))  # the right-hand block, along the fault
STEADY = [
    MeanValue(MESH),
    ContourLaplacian(MESH),
    EdgeLength(REST, MESH.edges),
    Stitch(SIDES[:, 2:3, 0].T, len(REST), 10.0),
    Level(np.arange(4), 100.0, len(REST), 10.0),
]
CONTACTS = list(contacts(MESH, SIDES, PLANAR, 10.0, "contact"))
TERMS = {
    "steady": STEADY,
    "with contacts": STEADY + CONTACTS,
    "with a barrier": [*STEADY, *CONTACTS, AreaBarrier(MESH)],
}


def perturbed(size, seed=0):
    return REST + size * np.random.default_rng(seed).standard_normal(REST.shape)


def both(free):
    """The coordinates of the vertices that are free."""
    return np.repeat(free[:, None], 2, axis=1)


def dense_matrix(terms, free, vertices, *, curved=False):
    """J^T J, and what residuals' second derivatives add, from differences of Jacobians."""
    unknown = np.repeat(free, 2)
    jacobian = np.vstack([term.jacobian(vertices).toarray() for term in terms])
    matrix = jacobian.T @ jacobian
    for term in terms if curved else ():
        if term.curvature(vertices):
            matrix += second_derivatives(term, vertices)
    return matrix[np.ix_(unknown, unknown)]


def dense_step(terms, free, vertices):
    """Gauss-Newton's step by a dense solve, with the least damping."""
    unknown = np.repeat(free, 2)
    gradient = sum(term.jacobian(vertices).T @ term.residual(vertices) for term in terms)[unknown]
    matrix = dense_matrix(terms, free, vertices)
    step = np.zeros(vertices.size)
    step[unknown] = -np.linalg.solve(matrix + 1e-9 * np.median(np.diag(matrix)) * np.eye(len(matrix)), gradient)
    return step.reshape(-1, 2)


def solved(equations, **options):
    equations.factorise(**options)
    return equations.step()


def second_derivatives(term, vertices, change=1e-4):
    """The sum of residual times its Hessian."""
    residual, columns = term.residual(vertices), []
    for coordinate in range(vertices.size):
        nudge = np.zeros(vertices.size)
        nudge[coordinate] = change
        after, before = (term.jacobian(vertices + side * nudge.reshape(-1, 2)) for side in (1, -1))
        columns.append((after - before).T @ residual / (2 * change))
    return np.column_stack(columns)


CASES = pytest.mark.parametrize(
    ("name", "squeeze", "backend"),
    [
        ("steady", 1.0, "SuperLU"),
        ("with contacts", 1.0, "preferred"),
        ("with a barrier", 0.35, "SuperLU"),
        ("with a barrier", 0.35, "preferred"),
    ],
)


@CASES
def test_step_is_gauss_newtons(name, squeeze, backend, monkeypatch):
    if backend == "SuperLU":
        monkeypatch.setattr(normal_equations, "Cholesky", cholesky.SuperLU)
    vertices = perturbed(2.0) * [1, squeeze]
    terms = update_contacts(TERMS[name], vertices)
    equations = NormalEquations(terms, both(~HELD), vertices)
    equations.update(terms, vertices, residuals(terms, vertices))
    step = solved(equations)
    expected = dense_step(terms, ~HELD, vertices)
    np.testing.assert_allclose(step, expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_array_equal(step[HELD], 0)
    gradient = sum(term.jacobian(vertices).T @ term.residual(vertices) for term in terms)
    assert equations.slope(step) == pytest.approx(2 * gradient @ step.ravel())


@CASES
def test_the_hessian_has_all_second_derivatives(name, squeeze, backend):
    vertices = perturbed(2.0) * [1, squeeze]
    terms = update_contacts(TERMS[name], vertices)
    equations = NormalEquations(terms, both(~HELD), vertices)
    equations.update(terms, vertices, residuals(terms, vertices))
    equations.factorise(curved=True)
    vector = np.random.default_rng(1).standard_normal(equations.size)
    expected = dense_matrix(terms, ~HELD, vertices, curved=True) @ vector
    np.testing.assert_allclose(equations.hessian()(vector), expected, atol=1e-6 * np.abs(expected).max())


def test_springs_resist_the_stretching_of_their_edges():
    vertices = perturbed(10.0)
    equations = NormalEquations(STEADY, both(~HELD), vertices)
    equations.update(STEADY, vertices, residuals(STEADY, vertices))
    stretches, edges = [], MESH.edges[~HELD[MESH.edges].any(axis=1)][-3:]
    for stiffness in (0.0, 10.0, 1e6):
        step = solved(equations, springs=Springs(edges, np.full(3, stiffness)))
        stretches.append(np.abs(step[edges[:, 0]] - step[edges[:, 1]]).max())
    assert stretches[0] > stretches[1] > 1e3 * stretches[2]


def test_the_same_equations_serve_at_one_place_after_another():
    free = ~HELD
    equations = NormalEquations(update_contacts(TERMS["with contacts"], REST), both(free), REST)
    for seed, start in enumerate([REST, SLID, REST, perturbed(2.0)]):
        vertices = start + np.random.default_rng(seed).standard_normal(start.shape)
        terms = update_contacts(TERMS["with contacts"], vertices)
        equations.update(terms, vertices, residuals(terms, vertices))
        expected = dense_step(terms, free, vertices)
        np.testing.assert_allclose(solved(equations), expected, atol=1e-6 * np.abs(expected).max())


def test_the_pattern_is_analysed_anew_only_for_a_new_place():
    free = np.ones(len(REST), bool)
    at_rest, slid = (update_contacts(TERMS["with contacts"], vertices) for vertices in (REST, SLID))
    equations = NormalEquations(at_rest, both(free), REST)
    counts = []
    for terms in (at_rest, at_rest, slid, slid, at_rest):
        equations.update(terms, REST, residuals(terms, REST))
        equations.factorise()
        counts.append(equations.analyses)
    assert counts == [2, 2, 3, 3, 3]
    assert equations.factorisations == 5


def test_steady_terms_are_analysed_once():
    equations = NormalEquations(STEADY, both(~HELD), REST)
    for seed in range(3):
        equations.update(STEADY, perturbed(5.0, seed), residuals(STEADY, perturbed(5.0, seed)))
        equations.factorise()
    assert equations.analyses == 1


def test_a_contact_without_any_partner_takes_no_part():
    silent = [replace(term, partner=np.full(len(term.points), -1)) for term in CONTACTS]
    vertices = perturbed(5.0)
    steps = []
    for terms in (STEADY, STEADY + silent):
        equations = NormalEquations(terms, both(~HELD), vertices)
        equations.update(terms, vertices, residuals(terms, vertices))
        steps.append(solved(equations))
    np.testing.assert_allclose(*steps, atol=1e-12)


def test_a_matrix_that_is_not_positive_definite_is_never_factorised():
    squeezed = REST * [0.5, 0.5]
    equations = NormalEquations(STEADY, both(~HELD), squeezed)
    equations.update(STEADY, squeezed, residuals(STEADY, squeezed))
    equations.factorise(curved=True)
    assert equations.factorisations == 1
    assert np.linalg.eigvalsh(dense_matrix(STEADY, ~HELD, squeezed, curved=True)).min() < 0
    step, norm, limited = equations.newton_step(50.0)
    assert limited
    assert norm == pytest.approx(50.0)
    assert equations.slope(step) < 0
