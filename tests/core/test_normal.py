from dataclasses import replace

import numpy as np
import pytest

from seiswidgets.core import cholesky, normal
from seiswidgets.core.contact import contacts
from seiswidgets.core.normal import NormalEquations
from seiswidgets.core.solver import held_now
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


def dense_step(terms, free, vertices, damping):
    """The step by dense least squares; the damping is more rows, as heavy as the mean of the diagonal asks."""
    unknown = np.repeat(free, 2)
    jacobian = np.vstack([term.jacobian(vertices).toarray() for term in terms])[:, unknown]
    residual = np.concatenate([term.residual(vertices) for term in terms])
    weight = np.sqrt(damping * np.mean(np.sum(jacobian**2, axis=0)))
    jacobian = np.vstack([jacobian, weight * np.eye(unknown.sum())])
    step = np.zeros(vertices.size)
    step[unknown] = np.linalg.lstsq(jacobian, -np.append(residual, np.zeros(unknown.sum())), rcond=None)[0]
    return step.reshape(-1, 2)


@pytest.mark.parametrize("backend", ["preferred", "SuperLU"])
@pytest.mark.parametrize("name", TERMS)
@pytest.mark.parametrize("free", [np.ones(len(REST), bool), ~HELD], ids=["free", "held"])
@pytest.mark.parametrize("damping", [1e-6, 1.0])
def test_step_is_the_dense_least_squares_solution(backend, name, free, damping, monkeypatch):
    if backend == "SuperLU":
        monkeypatch.setattr(normal, "Cholesky", cholesky.SuperLU)
    vertices = perturbed(15.0)
    terms = held_now(TERMS[name], vertices)
    equations = NormalEquations(terms, free, vertices)
    equations.at(terms, vertices)
    step = equations.step(damping)
    expected = dense_step(terms, free, vertices, damping)
    np.testing.assert_allclose(step, expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_array_equal(step[~free], 0)


def test_the_same_equations_serve_at_one_place_after_another():
    free = ~HELD
    equations = NormalEquations(held_now(TERMS["with contacts"], REST), free, REST)
    for seed, start in enumerate([REST, SLID, REST, perturbed(10.0)]):
        vertices = start + 3 * np.random.default_rng(seed).standard_normal(start.shape)
        terms = held_now(TERMS["with contacts"], vertices)
        equations.at(terms, vertices)
        expected = dense_step(terms, free, vertices, 1e-6)
        np.testing.assert_allclose(equations.step(1e-6), expected, atol=1e-6 * np.abs(expected).max())


def test_the_pattern_is_analysed_anew_only_for_a_new_place():
    free = np.ones(len(REST), bool)
    at_rest, slid = (held_now(TERMS["with contacts"], vertices) for vertices in (REST, SLID))
    equations = NormalEquations(at_rest, free, REST)
    counts = []
    for terms in (at_rest, at_rest, slid, slid, at_rest):
        equations.at(terms, REST)
        equations.step(1e-6)
        counts.append(equations.analyses)
    assert counts == [2, 2, 3, 3, 3]
    assert equations.factorisations == 5


def test_steady_terms_are_analysed_once():
    equations = NormalEquations(STEADY, ~HELD, REST)
    for seed in range(3):
        equations.at(STEADY, perturbed(5.0, seed))
        equations.step(1e-6)
    assert equations.analyses == 1


def test_a_contact_without_any_partner_takes_no_part():
    silent = [replace(term, partner=np.full(len(term.points), -1)) for term in CONTACTS]
    vertices = perturbed(5.0)
    steps = []
    for terms in (STEADY, STEADY + silent):
        equations = NormalEquations(terms, ~HELD, vertices)
        equations.at(terms, vertices)
        steps.append(equations.step(1e-3))
    np.testing.assert_allclose(*steps, atol=1e-12)


def test_damping_shortens_the_step():
    vertices = perturbed(10.0)
    equations = NormalEquations(STEADY, ~HELD, vertices)
    equations.at(STEADY, vertices)
    lengths = [np.linalg.norm(equations.step(damping)) for damping in (1e-6, 1e-2, 1.0, 1e3)]
    assert (np.diff(lengths) < 0).all()
