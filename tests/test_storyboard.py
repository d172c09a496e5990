from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text

import seiswidgets as sw
from seiswidgets.geology.scenes import Scene, scenes


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def restored():
    case = sw.synthetic.planar_fault(throw=60.0, width=1500.0, depth=1000.0, horizons=(400.0, 600.0))
    picks = case.interpretation
    unfaulted = sw.Restoration(case.section, spacing=80.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    return unfaulted.flatten(picks.horizons[0])


def aged(restored, *ages):
    stages = tuple(replace(stage, age=age) for stage, age in zip(restored.stages, ages, strict=True))
    return replace(restored, stages=stages)


def test_scenes_are_the_present_day_and_each_stage(restored):
    assert scenes(()) == (Scene(0, "present day"),)
    expected = (Scene(0, "present day"), Scene(1, "unfaulting F1"), Scene(2, "flattening H1"))
    assert scenes(restored.stages) == expected


def test_stages_of_one_age_make_one_scene(restored):
    both = Scene(0, "present day", 0.0), Scene(2, "unfaulting F1, flattening H1", 12.5)
    assert scenes(aged(restored, 12.5, 12.5).stages) == both
    assert both[1].label == "12.5 Ma · unfaulting F1, flattening H1"
    assert [scene.age for scene in scenes(aged(restored, 5.0, 12.5).stages)] == [0.0, 5.0, 12.5]
    assert [scene.count for scene in scenes(aged(restored, None, 12.5).stages)] == [0, 1, 2]


def test_all_panels_have_one_scale_and_fixed_colours(restored):
    figure = sw.plot.storyboard(restored, colours={("fault", "F1"): "#123456"})
    panels = figure.axes
    assert [ax.get_title(loc="left") for ax in panels] == ["1  present day", "2  unfaulting F1", "3  flattening H1"]
    assert len({(ax.get_xlim(), ax.get_ylim(), ax.get_aspect()) for ax in panels}) == 1
    assert len({ax.images[0].get_clim() for ax in panels}) == 1
    assert len({tuple(line.get_color() for line in ax.lines[-1:]) for ax in panels}) == 1
    assert "#123456" in {line.get_color() for line in panels[2].lines}
    np.testing.assert_array_equal(panels[0].images[0].get_array(), restored.original.amplitude)


def test_layers_keep_their_colours_and_are_named_with_their_ages(restored):
    layers = sw.Stratigraphy([sw.Layer(None, 0.0), sw.Layer("H1", 5.0), sw.Layer("H2", 9.0)])
    figure = sw.plot.storyboard(restored, stratigraphy=layers)
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["top of the section, 0 Ma", "H1, 5 Ma", "H2, 9 Ma"]
    for ax in figure.axes:
        tints = ax.images[1].get_array()
        column = tints[tints[:, 20, 3] > 0, 20, :3]
        for found, patch in ((column[0], 0), (column[-1], 2)):
            np.testing.assert_allclose(found, to_rgb(legend.get_patches()[patch].get_facecolor()), atol=0.01)


def test_names_of_close_horizons_stand_at_different_ends():
    lines = [sw.Horizon([(0, z), (1400, z)], name=f"H{z}") for z in (100, 110, 120, 500)]
    ax, *_ = sw.plot.storyboard(sw.Restoration(sw.Section(np.eye(100), 15.0, 10.0)), sw.Interpretation([], lines)).axes
    names = {text.get_text(): text.get_horizontalalignment() for text in ax.texts}
    assert names == {"H100": "left", "H110": "right", "H500": "left"}  # there is no room for H120


def test_letters_are_large_enough_for_print(restored):
    figure = sw.plot.storyboard(restored)
    figure.canvas.draw()
    texts = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    assert min(text.get_fontsize() for text in texts) >= 9.0
    assert figure.get_figwidth() == pytest.approx(7.1)


def test_it_can_be_told_forwards_in_one_column_on_a_figure_of_ones_own(restored):
    figure = Figure()
    assert sw.plot.storyboard(aged(restored, 3.0, 9.0), columns=1, oldest_first=True, figure=figure) is figure
    assert [ax.get_title(loc="left")[:8] for ax in figure.axes] == ["1  9 Ma ", "2  3 Ma ", "3  0 Ma "]
    assert [ax.get_xlabel() != "" for ax in figure.axes] == [False, False, True]


def test_without_stages_it_is_the_section(restored):
    (ax,) = sw.plot.storyboard(sw.Restoration(restored.original)).axes
    assert ax.get_title(loc="left") == "1  present day"


@pytest.mark.parametrize(
    ("arguments", "keywords", "match"),
    [
        ((3,), {}, "restored must be a Restoration"),
        ((None,), {"columns": 0}, "columns must be a whole number"),
        ((None,), {"clip": 0}, "clip must be"),
    ],
)
def test_what_makes_no_storyboard_is_refused(restored, arguments, keywords, match):
    with pytest.raises(sw.SettingError, match=match):
        sw.plot.storyboard(*(restored if one is None else one for one in arguments), **keywords)
