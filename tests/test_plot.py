from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

import seiswidgets as sw
from seiswidgets.core.deformation import AREA_RATIO_COLOURS
from seiswidgets.core.mesh import Mesh
from seiswidgets.interaction.drawing import Drawing

AMPLITUDE = np.random.default_rng(0).normal(size=(40, 60))
DEPTH = sw.Section(AMPLITUDE, dx=25.0, dz=10.0, x0=1000.0, z0=200.0)
TIME = sw.Section(AMPLITUDE, dx=25.0, dz=4.0, z_unit="ms", velocity=2400.0, name="line 7", credit="the survey")


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.planar_fault(throw=60.0, width=1500.0, depth=1000.0, horizons=(400.0, 600.0))


@pytest.fixture(scope="module")
def restored(case):
    picks = case.interpretation
    unfaulted = sw.Restoration(case.section, spacing=80.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    return unfaulted.flatten(picks.horizons[0])


@pytest.fixture
def uneven(restored):
    """A restoration whose last stage compresses its first triangle to half its area and doubles the second's."""
    vertices = np.array([[0, 0], [100, 0], [0, 100], [500, 0], [600, 0], [500, 100]], float)
    mesh = Mesh(vertices, [[0, 1, 2], [3, 4, 5]])
    after = vertices * (1, 0.5) * np.repeat([[1, 1], [1, 4]], 3, axis=0)
    stage = replace(restored.stages[0], mesh=mesh, vertices=after)
    return replace(restored, stages=(stage,))


def footnotes(ax):
    return " ".join(text.get_text() for text in ax.texts)


def test_a_section_reaches_to_the_edges_of_its_cells():
    (image,) = sw.plot.section(DEPTH).images
    assert image.get_extent() == [987.5, 2487.5, 595.0, 195.0]


def test_z_runs_down():
    bottom, top = sw.plot.section(DEPTH).get_ylim()
    assert bottom == 595.0
    assert top == 195.0


@pytest.mark.parametrize(
    ("section", "labels"),
    [
        (DEPTH, ("Distance (m)", "Depth (m)")),
        (TIME, ("Distance (m)", "Two-way time (ms)")),
        (replace(TIME, dz=0.004, z_unit="s"), ("Distance (m)", "Two-way time (s)")),
        (replace(DEPTH, dx=0.025, x_unit="km", z_unit="ft"), ("Distance (km)", "Depth (ft)")),
    ],
)
def test_axes_carry_units(section, labels):
    ax = sw.plot.section(section)
    assert (ax.get_xlabel(), ax.get_ylabel()) == labels


@pytest.mark.parametrize("section", [DEPTH, TIME, replace(DEPTH, z_unit="ft")])
@pytest.mark.parametrize("exaggeration", [1, 3])
def test_proportions_are_those_of_the_rock(section, exaggeration):
    ax = sw.plot.section(section, exaggeration=exaggeration)
    x, z = section.metres
    assert ax.get_aspect() == pytest.approx(exaggeration * z / x)


@pytest.mark.parametrize(("exaggeration", "said"), [(1, "true proportions"), (2.5, "vertical exaggeration 2.5×")])
def test_exaggeration_is_stated(exaggeration, said):
    assert said in footnotes(sw.plot.section(DEPTH, exaggeration=exaggeration))


def test_exaggeration_in_time_is_stated_with_its_velocity():
    assert "at 2400 m/s" in footnotes(sw.plot.section(TIME))


def test_a_long_and_flat_section_is_exaggerated_by_itself():
    section = sw.Section(np.ones((50, 400)), dx=50.0, dz=10.0)
    assert sw.plot.section(section).get_aspect() > 5


def test_credit_is_shown():
    assert "data: the survey" in footnotes(sw.plot.section(TIME))


def test_colours_are_clipped_evenly_about_zero():
    low, high = sw.plot.section(DEPTH, clip=90).images[0].get_clim()
    assert low == -high
    assert np.mean(np.abs(AMPLITUDE) <= high) == pytest.approx(0.9, abs=0.01)


def test_nan_has_the_colour_of_the_background():
    amplitude = AMPLITUDE.copy()
    amplitude[:, :10] = np.nan
    ax = sw.plot.section(replace(DEPTH, amplitude=amplitude))
    (image,) = ax.images
    assert image.get_array().mask[:, :10].all()
    np.testing.assert_allclose(image.cmap.get_bad(), ax.get_facecolor())


def test_a_silent_section_can_be_drawn():
    low, high = sw.plot.section(replace(DEPTH, amplitude=np.zeros((5, 5)))).images[0].get_clim()
    assert low < high


def test_picks_are_drawn_where_they_are_and_named(case):
    picks = case.interpretation
    ax = sw.plot.section(case.section, picks)
    drawn = [line.get_xydata() for line in ax.lines]
    for line in (picks.faults[0].points, *picks.horizons[0].pieces):
        assert any(line.shape == other.shape and np.allclose(line, other) for other in drawn)
    assert {"F1", "H1", "H2"} <= {text.get_text() for text in ax.texts}


def test_names_are_no_formulas(case):
    name = r"$x_{$ <b>"
    horizons = [sw.Horizon(*case.interpretation.horizons[0].pieces, name=name)]
    section = replace(case.section, name=name, credit=name)
    ax = sw.plot.section(section, sw.Interpretation(horizons=horizons))
    ax.figure.draw_without_rendering()
    assert {ax.get_title(loc="left"), ax.texts[0].get_text()} == {name}


def test_a_pick_outside_the_section_can_be_seen():
    astray = sw.Interpretation([sw.Fault([(0.0, 250.0), (1200.0, 400.0)])])
    assert len(sw.plot.section(DEPTH, astray).lines) == 1


def test_a_window_shows_a_part(case):
    ax = sw.plot.section(case.section, case.interpretation, window=(100, 300, 50, 150))
    assert ax.get_xlim() == (100, 300)
    assert ax.get_ylim() == (150, 50)
    assert "H1" not in {text.get_text() for text in ax.texts}


def test_an_axes_that_is_given_is_used():
    ax = plt.figure().add_subplot()
    assert sw.plot.section(DEPTH, ax=ax) is ax
    assert len(plt.get_fignums()) == 1


def test_a_restored_section_shows_the_horizon_level(case, restored):
    level = sw.Interpretation(horizons=case.interpretation.horizons[:1])
    ax = sw.plot.restoration(restored, level)
    depths = np.concatenate([line.get_ydata() for line in ax.lines])
    assert np.ptp(depths) < 1.0
    assert ax.get_title(loc="left") == "after flattening H1"


def test_a_restored_section_has_the_grey_tones_of_the_original(restored):
    before, after = sw.plot.section(restored.original), sw.plot.restoration(restored)
    assert before.images[0].get_clim() == after.images[0].get_clim()


@pytest.mark.parametrize("when", ["before", "after"])
def test_mesh_shows_its_edges(restored, when):
    ax = sw.plot.mesh(restored, 0, when)
    stage = restored.stages[0]
    vertices = stage.mesh.vertices if when == "before" else stage.vertices
    drawn = ax.lines[0].get_xydata()
    np.testing.assert_allclose(np.nanmin(drawn, axis=0), vertices.min(axis=0), atol=1e-9)
    np.testing.assert_allclose(np.nanmax(drawn, axis=0), vertices.max(axis=0), atol=1e-9)


def test_compression_is_red_and_expansion_blue(uneven):
    assert uneven.stages[0].area_ratio.tolist() == [2.0, 0.5]
    figure = sw.plot.deformation(uneven)
    figure.draw_without_rendering()
    (triangles,) = [child for child in figure.axes[0].collections if isinstance(child, PolyCollection)]
    compressed, expanded = triangles.get_facecolors()
    assert compressed[0] > 2 * compressed[2]
    assert expanded[2] > 2 * expanded[0]


def test_no_deformation_is_white(uneven):
    triangles = sw.plot.deformation(uneven).axes[0].collections[0]
    assert min(triangles.to_rgba(1.0)) > 0.95


def test_bars_of_the_histogram_add_up_and_have_the_colours_of_the_map(restored):
    figure = sw.plot.deformation(restored)
    triangles = figure.axes[0].collections[0]
    bars = figure.axes[1].patches
    assert sum(bar.get_height() for bar in bars) == pytest.approx(1.0)
    middle = np.sqrt(bars[3].get_x() * (bars[3].get_x() + bars[3].get_width()))
    np.testing.assert_allclose(bars[3].get_facecolor(), triangles.to_rgba(middle), atol=0.01)
    assert triangles.cmap.name == AREA_RATIO_COLOURS


def test_the_colour_bar_says_what_it_measures(restored):
    (bar,) = sw.plot.deformation(restored).axes[1].child_axes
    assert bar.get_xlabel() == "area before / after restoring"


def test_a_span_sets_the_ends_of_the_colours(restored):
    triangles = sw.plot.deformation(restored, span=1.6).axes[0].collections[0]
    assert triangles.get_clim() == pytest.approx((1 / 1.6, 1.6))


def test_percentiles_are_printed(uneven):
    title = sw.plot.deformation(uneven).axes[1].get_title(loc="left")
    assert title == "median 1.250\n98% of the area from 0.500 to 2.000"


def test_workflow_shows_every_state_and_the_deformation(case, restored):
    figure = sw.plot.workflow(restored, case.interpretation)
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    assert titles[:4] == [
        "(a) planar fault",
        "(b) after unfaulting",
        "(c) after flattening H1",
        "(d) deformation by flattening",
    ]
    assert len({ax.get_xlim() for ax in figure.axes[:4]}) == 1
    assert len({ax.get_ylim() for ax in figure.axes[:4]}) == 1


@pytest.mark.parametrize("count", [1, 2])
def test_workflow_of_any_number_of_stages(restored, count):
    figure = sw.plot.workflow(replace(restored, stages=restored.stages[:count]))
    figure.draw_without_rendering()
    assert len(figure.axes) == count + 3


def test_workflow_is_drawn_on_a_figure_that_is_given(restored):
    figure = Figure()
    assert sw.plot.workflow(restored, figure=figure) is figure
    assert plt.get_fignums() == []
    np.testing.assert_array_equal(figure.get_size_inches(), sw.plot.workflow(restored).get_size_inches())


def test_workflow_can_show_the_deformation_of_another_stage(restored):
    figure = sw.plot.workflow(restored, stage=0)
    assert figure.axes[3].get_title(loc="left") == "(d) deformation by unfaulting"


def test_whole_figures_credit_the_data(restored):
    credited = replace(restored, original=replace(restored.original, credit="the survey"))
    for figure in (sw.plot.workflow(credited), sw.plot.deformation(credited)):
        assert "data: the survey" in figure.get_supxlabel()


@pytest.mark.parametrize(
    ("keywords", "match"),
    [
        ({"clip": 0}, "clip must be a percentile, above 0 and at most 100, but is 0"),
        ({"exaggeration": -1}, "exaggeration must be above 0, or 1 for true proportions, but is -1"),
        ({"window": (5, 1, 0, 1)}, "window must be"),
        ({"window": (5, 1)}, "window must be"),
    ],
)
def test_a_setting_out_of_range_is_refused(keywords, match):
    with pytest.raises(sw.SettingError, match=match):
        sw.plot.section(DEPTH, **keywords)


def test_a_stage_that_is_not_there_is_refused(restored):
    with pytest.raises(sw.SettingError, match="there is no stage 2; there are 2, counted from 0"):
        sw.plot.mesh(restored, 2)
    with pytest.raises(sw.SettingError, match="nothing has been restored yet"):
        sw.plot.workflow(replace(restored, stages=()))
    with pytest.raises(sw.SettingError, match='"before" or "after", but is \'while\''):
        sw.plot.mesh(restored, when="while")


def test_a_pick_has_the_colour_that_it_has_in_the_app():
    case = sw.synthetic.faulted_fold()
    picks = case.interpretation
    app_colours = Drawing().with_interpretation(picks).colours
    ax = sw.plot.section(case.section, picks)
    lines = {to_hex(line.get_color()) for line in ax.lines}
    assert lines == set(app_colours.values())
    figure = sw.plot.workflow(case_restored(case), picks, colours={("fault", "F1"): "#123456"})
    panels = [axes for axes in figure.axes if axes.lines]
    assert len(panels) == 4
    expected = {**app_colours, ("fault", "F1"): "#123456"}
    for panel in panels:
        assert {to_hex(line.get_color()) for line in panel.lines} == set(expected.values())


def case_restored(case):
    return sw.Plan(spacing=200.0).restore(case.section, case.interpretation, fixed=case.fixed)


def test_picks_are_drawn_beside_the_truth_with_their_errors(case):
    true = case.interpretation
    low = sw.Horizon(*(piece + [0, 9] for piece in true.horizons[0].pieces), name="$mine$")
    ax = sw.plot.comparison(case.section, sw.Interpretation(true.faults, [low]), true)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["F1: 0 m off", "H1: 9 m off", "H2: not picked", "truth"]
    assert ax.get_legend().get_texts()[0].get_fontsize() >= 9
    dashed = [line for line in ax.lines if line.get_linestyle() == "--" and len(line.get_xdata())]
    assert len(dashed) == 5


def test_a_class_is_drawn_as_lines_bands_and_throws(case):
    true = case.interpretation
    everybody = [
        sw.Interpretation(
            true.faults, [sw.Horizon(bed.pieces[0], bed.pieces[1] + [0, down]) for bed in true.horizons[:1]]
        )
        for down in range(-10, 11, 5)
    ]
    figure = sw.plot.pooled(case.section, sw.pool_picks(case.section, everybody, true), figure=Figure())
    left, right = figure.axes
    assert left.get_title("left") == "5 interpretations"
    assert [label.get_text() for label in right.get_yticklabels()] == ["H1 at F1", "H2 at F1"]
    throws = right.lines[0].get_xdata()
    assert np.ptp(throws) == pytest.approx(20, abs=1)
