import numpy as np
import pytest

from seiswidgets.core.rigid import part_of_motion, rigid_blocks
from seiswidgets.core.solver import energy, update_contacts
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
    before, after = (energy(update_contacts(terms, at), at) for at in (mesh.vertices, placed))
    assert after < 1e-3 * before


BLOCKS = np.array([0, 0, 0, 1, 1, 1])
SIX = np.array([(0, 0), (4, 0), (0, 3), (10, 0), (14, 1), (11, 5.0)])


def turned(points, angle, pole):
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return (points - pole) @ turn + pole


@pytest.mark.parametrize(
    ("angle", "share"), [(1e-12, 0.3), (0.4, 0.0), (0.4, 0.3), (-2.0, 0.3), (3.0, 0.3), (3.0, 1.0)]
)
def test_a_share_of_a_turn_is_a_turn_about_the_same_pole(angle, share):
    pole = np.array([3.0, -50.0])
    after = np.vstack([turned(SIX[:3], angle, pole), SIX[3:] + [2.0, 7.0]])
    now = part_of_motion(SIX, after, BLOCKS, np.ones(6), share)
    np.testing.assert_allclose(now[:3], turned(SIX[:3], share * angle, pole), atol=1e-9)
    np.testing.assert_allclose(now[3:], SIX[3:] + share * np.array([2.0, 7.0]), atol=1e-9)


def test_a_share_of_a_stretch_is_even():
    after = SIX * [1.5, 1.0]
    now = part_of_motion(SIX, after, np.zeros(6, int), np.arange(1.0, 7.0), 0.5)
    edges = [(0, 1), (2, 5)]
    for one, other in edges:
        lengths = [np.hypot(*(at[one] - at[other])) for at in (SIX, now, after)]
        assert min(lengths[0], lengths[2]) <= lengths[1] <= max(lengths[0], lengths[2])
