"""A piece that slides keeps its shape, and its cut-off stays on the fault."""

import numpy as np
import pytest
from shapely import LineString, Point

import seiswidgets as sw
from seiswidgets.interaction.sliding import slide_piece, slip_to

SECTION = sw.Section(np.zeros((61, 91)), dx=10.0, dz=5.0, z_unit="ms", velocity=2000.0)  # 5 m of rock a sample
BENT = [(400.0, 0.0), (450.0, 150.0), (500.0, 300.0)]
PIECE = [(450.0, 150.0), (600.0, 140.0), (700.0, 160.0)]


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize("drawn", [1, -1])
@pytest.mark.parametrize("slip", [40.0, -40.0])
def test_the_cutoff_moves_by_the_slip_along_the_fault_and_the_rest_with_it(slip, drawn, turned):
    fault, piece = BENT[::drawn], np.array(PIECE[::turned])
    moved = slide_piece(piece, fault, slip, SECTION)
    np.testing.assert_allclose(moved - piece, np.broadcast_to((moved - piece)[0], piece.shape))
    (before, after), line = SECTION.to_rock([PIECE[0], moved[::turned][0]]), LineString(SECTION.to_rock(BENT))
    assert line.distance(Point(after)) < 1e-9
    assert line.project(Point(after)) - line.project(Point(before)) == pytest.approx(slip)


def test_a_slide_there_and_back_changes_nothing_and_slip_to_is_its_inverse():
    moved = slide_piece(PIECE, BENT, 50.0, SECTION)
    assert slip_to(PIECE, BENT, moved[0], SECTION) == pytest.approx(50.0)
    np.testing.assert_allclose(slide_piece(moved, BENT, -50.0, SECTION), PIECE)


def test_the_cutoff_stops_at_the_end_of_the_fault_and_what_leaves_the_section_is_cut_off():
    to_border = [(450.0, 150.0), (900.0, 150.0)]
    end = slide_piece(to_border, BENT, 1e6, SECTION)
    np.testing.assert_allclose(end, [BENT[-1], (900.0, 300.0)])


def test_throw_of_a_slid_piece_is_that_of_the_slip():
    """A piece slid by s down a fault of 45 degrees drops by s sin 45."""
    section = sw.Section(np.zeros((61, 91)), dx=10.0, dz=10.0)
    fault = sw.Fault([(300.0, 0.0), (600.0, 300.0)], "F1")
    footwall, hanging_wall = [(100.0, 150.0), (450.0, 150.0)], [(450.0, 150.0), (800.0, 150.0)]
    slid = slide_piece(hanging_wall, fault.points, 60.0, section)
    assert sw.throw(fault, sw.Horizon(footwall, slid, name="H1")) == pytest.approx(60.0 * np.sqrt(0.5))
