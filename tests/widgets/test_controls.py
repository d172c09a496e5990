import pytest

import seiswidgets as sw
from seiswidgets.widgets.restoring.controls import SolverControls


def test_only_a_hand_moves_the_mesh_spacing():
    controls = SolverControls(sw.synthetic.faulted_fold().section)
    slider, middle = controls._slider, controls._slider.value
    slider.value = middle * 10 ** (0.5 * slider.step)  # as a page rounds what it is given
    assert controls.spacing is None
    slider.value = middle * 10**slider.step
    assert controls.spacing == pytest.approx(middle * 10**slider.step)
    controls._usual.click()
    assert controls.spacing is None
    assert slider.value == pytest.approx(middle)
