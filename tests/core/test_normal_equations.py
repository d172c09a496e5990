from dataclasses import replace

import numpy as np
import pytest

from seiswidgets.core import cholesky, normal_equations
from seiswidgets.core.contact import contacts
from seiswidgets.core.normal_equations import NormalEquations
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


def dense_step(terms, free, vertices, damping):
    """Newton's step by a dense solve; what residuals' second derivatives add comes from differences of Jacobians."""
    unknown = np.repeat(free, 2)
    jacobian = np.vstack([term.jacobian(vertices).toarray() for term in terms])
    residual = np.concatenate([term.residual(vertices) for term in terms])
    matrix = jacobian.T @ jacobian
    weight = damping * np.median(np.diag(matrix)[unknown])
    for term in terms:
        if hasattr(term, "curvature"):
            matrix += second_derivatives(term, vertices)
    step = np.zeros(vertices.size)
    matrix = matrix[np.ix_(unknown, unknown)] + weight * np.eye(unknown.sum())
    step[unknown] = -np.linalg.solve(matrix, (jacobian.T @ residual)[unknown])
    return step.reshape(-1, 2)


def second_derivatives(term, vertices, change=1e-4):
    """The sum of residual times its Hessian."""
    residual, columns = term.residual(vertices), []
    for coordinate in range(vertices.size):
        nudge = np.zeros(vertices.size)
        nudge[coordinate] = change
        after, before = (term.jacobian(vertices + side * nudge.reshape(-1, 2)) for side in (1, -1))
        columns.append((after - before).T @ residual / (2 * change))
    return np.column_stack(columns)


@pytest.mark.parametrize(
    ("name", "held", "damping", "squeeze", "backend"),
    [
        ("steady", "nothing", 1e-3, 1.0, "preferred"),
        ("steady", "a block", 1.0, 1.0, "SuperLU"),
        ("with contacts", "nothing", 1.0, 1.0, "preferred"),
        ("with contacts", "a block", 1e-3, 1.0, "preferred"),
        ("with a barrier", "nothing", 1.0, 0.35, "SuperLU"),
        ("with a barrier", "a block", 1.0, 0.35, "preferred"),
    ],
)
def test_step_is_newtons(name, held, damping, squeeze, backend, monkeypatch):
    free = ~HELD if held == "a block" else np.ones(len(REST), bool)
    if backend == "SuperLU":
        monkeypatch.setattr(normal_equations, "Cholesky", cholesky.SuperLU)
    vertices = perturbed(2.0) * [1, squeeze]
    terms = update_contacts(TERMS[name], vertices)
    equations = NormalEquations(terms, both(free), vertices)
    equations.at(terms, vertices, residuals(terms, vertices))
    step = equations.step(damping, bending=1.0)
    expected = dense_step(terms, free, vertices, damping)
    np.testing.assert_allclose(step, expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_array_equal(step[~free], 0)


def test_the_same_equations_serve_at_one_place_after_another():
    free = ~HELD
    equations = NormalEquations(update_contacts(TERMS["with contacts"], REST), both(free), REST)
    for seed, start in enumerate([REST, SLID, REST, perturbed(2.0)]):
        vertices = start + np.random.default_rng(seed).standard_normal(start.shape)
        terms = update_contacts(TERMS["with contacts"], vertices)
        equations.at(terms, vertices, residuals(terms, vertices))
        expected = dense_step(terms, free, vertices, 1e-3)
        np.testing.assert_allclose(equations.step(1e-3, bending=1.0), expected, atol=1e-6 * np.abs(expected).max())


def test_the_pattern_is_analysed_anew_only_for_a_new_place():
    free = np.ones(len(REST), bool)
    at_rest, slid = (update_contacts(TERMS["with contacts"], vertices) for vertices in (REST, SLID))
    equations = NormalEquations(at_rest, both(free), REST)
    counts = []
    for terms in (at_rest, at_rest, slid, slid, at_rest):
        equations.at(terms, REST, residuals(terms, REST))
        equations.step(1e-6)
        counts.append(equations.analyses)
    assert counts == [2, 2, 3, 3, 3]
    assert equations.factorisations == 5


def test_steady_terms_are_analysed_once():
    equations = NormalEquations(STEADY, both(~HELD), REST)
    for seed in range(3):
        equations.at(STEADY, perturbed(5.0, seed), residuals(STEADY, perturbed(5.0, seed)))
        equations.step(1e-6)
    assert equations.analyses == 1


def test_a_contact_without_any_partner_takes_no_part():
    silent = [replace(term, partner=np.full(len(term.points), -1)) for term in CONTACTS]
    vertices = perturbed(5.0)
    steps = []
    for terms in (STEADY, STEADY + silent):
        equations = NormalEquations(terms, both(~HELD), vertices)
        equations.at(terms, vertices, residuals(terms, vertices))
        steps.append(equations.step(1e-3))
    np.testing.assert_allclose(*steps, atol=1e-12)


def test_without_what_is_shortened_the_matrix_is_positive_definite():
    squeezed = REST * [0.5, 0.5]
    equations = NormalEquations(STEADY, both(~HELD), squeezed)
    equations.at(STEADY, squeezed, residuals(STEADY, squeezed))
    with pytest.raises(cholesky.NotPositiveDefinite):
        equations.step(1e-9, bending=1.0)
    assert np.isfinite(equations.step(1e-9, bending=0.0)).all()


def test_damping_shortens_the_step():
    vertices = perturbed(10.0)
    equations = NormalEquations(STEADY, both(~HELD), vertices)
    equations.at(STEADY, vertices, residuals(STEADY, vertices))
    lengths = [np.linalg.norm(equations.step(damping)) for damping in (1e-6, 1e-2, 1.0, 1e3)]
    assert (np.diff(lengths) < 0).all()
