"""The pages below the panes, made when they are looked at, and the solver's controls on one of them."""

import numpy as np
import pytest
from ipywidgets import HTML

import seiswidgets as sw
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.widgets.app import LazyTabs
from seiswidgets.widgets.panels.controls import SolverControls
from seiswidgets.widgets.workspace import Workspace


def test_a_page_is_made_when_it_is_first_looked_at_and_once():
    made = []

    def page(name):
        made.append(name)
        return HTML(name)

    pages = LazyTabs(Picks=lambda: page("picks"), Weights=lambda: page("weights"))
    assert (pages.titles, made) == (("Picks", "Weights"), ["picks"])
    for number in (1, 0, 1):
        pages.selected_index = number
        assert pages.children[number].children[0].value == ("picks", "weights")[number]
    assert made == ["picks", "weights"]
    pages.selected_index = None  # as a page may send it
    assert made == ["picks", "weights"]


def test_only_a_hand_moves_the_mesh_spacing():
    controls = SolverControls(Workspace(sw.synthetic.faulted_fold().section))
    slider, middle = controls.slider, controls.slider.value
    slider.value = middle * 10 ** (0.5 * slider.step)  # as a page rounds what it is given
    assert controls.spacing is None
    slider.value = middle * 10**slider.step
    assert controls.spacing == pytest.approx(middle * 10**slider.step)
    controls.default_button.click()
    assert controls.spacing is None
    assert slider.value == pytest.approx(middle)


def test_the_mesh_spacing_suits_sections_of_any_size():
    small, large = (sw.Section(np.zeros((50, 50)), spacing, spacing) for spacing in (0.1, 1000.0))
    workspace = Workspace(small)
    controls = SolverControls(workspace)
    for section in (large, small):
        workspace.open(section, Drawing())
        slider, usual = controls.slider, sw.Restoration(section).domain.spacing
        np.testing.assert_allclose([10**slider.min, slider.value, 10**slider.max], [usual / 4, usual, 4 * usual])
        assert controls.spacing is None
