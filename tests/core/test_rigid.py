import numpy as np
import pytest

from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.solver import energy, held_now
from seiswidgets.core.terms import Stitch
from tests.core.meshes import PLANAR, arc
from tests.core.problems import about_centre, along_planar, faulted


def between(terms):
    return [term for term in terms if term.name == "contact" or isinstance(term, Stitch)]


@pytest.mark.parametrize("turn", [-0.06, 0.04])
def test_a_block_turns_along_a_round_fault(turn):
    mesh, terms, free = faulted(arc(50.0), about_centre(turn))
    placed = rigid_blocks(mesh.blocks, between(terms), mesh.vertices, free)
    expected = np.where(free[:, None], about_centre(turn)(mesh.vertices), mesh.vertices)
    np.testing.assert_allclose(placed, expected, atol=0.1)


def test_a_block_slides_along_a_straight_fault_and_no_length_changes():
    mesh, terms, free = faulted(PLANAR, along_planar(-80.0))
    placed = rigid_blocks(mesh.blocks, between(terms), mesh.vertices, free)
    np.testing.assert_array_equal(placed[~free], mesh.vertices[~free])
    at_rest, now = (np.hypot(*(at[mesh.edges[:, 0]] - at[mesh.edges[:, 1]]).T) for at in (mesh.vertices, placed))
    np.testing.assert_allclose(now, at_rest, rtol=1e-12)
    np.testing.assert_allclose(placed[free], along_planar(-80.0)(mesh.vertices[free]), atol=1e-2)


def test_the_energy_does_not_rise():
    mesh, terms, free = faulted(arc(50.0), about_centre(0.05))
    terms = between(terms)
    placed = rigid_blocks(mesh.blocks, terms, mesh.vertices, free)
    before, after = (energy(held_now(terms, at), at) for at in (mesh.vertices, placed))
    assert after < 1e-3 * before
