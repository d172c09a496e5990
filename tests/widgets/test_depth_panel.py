"""Conversion to depth in the app: section, picks, held points and levels together, and back."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.linked_panes import Reading


@pytest.fixture
def app():
    case = sw.synthetic.planar_fault(throw=150)
    section = case.section.to_time(sw.LinearVelocity(1800, 0.6))
    back = sw.DepthConversion(section, sw.LinearVelocity(1800, 0.6), 5.0).to_time
    app = RestorationApp(section, live=False)
    app.interpretation, app.fixed = back(case.interpretation), tuple(back(case.fixed))
    yield app, case
    app.close()


def points(picks):
    return np.concatenate([fault.points for fault in picks.faults] + [p for h in picks.horizons for p in h.pieces])


def test_section_picks_and_held_point_go_to_depth_together_and_back(app):
    app, case = app
    recorded, drawn, fixed = app.section, app.interpretation, app.fixed
    app.files.depth.convert()
    assert app.section.z_unit == "m"
    np.testing.assert_allclose(app.fixed, case.fixed, atol=1e-6)
    np.testing.assert_allclose(
        app.interpretation.faults[0].points[[0, -1]], case.interpretation.faults[0].points[[0, -1]]
    )
    app.files.depth.revert()
    assert app.section is recorded
    np.testing.assert_allclose(app.fixed, fixed, atol=1e-6)
    assert len(points(app.interpretation)) >= len(points(drawn))


def test_it_is_one_edit_that_undo_reverses(app):
    app, _ = app
    before = app.workspace.document
    app.files.depth.convert()
    assert app.workspace.history.next_undo.label == "convert to depth"
    app.workspace.history.undo()
    assert app.workspace.document == before


def test_another_model_starts_from_the_recorded_section(app):
    app, _ = app
    recorded, panel = app.section, app.files.depth
    panel.convert()
    panel.model.value = "layers between the horizons"
    panel.fields["velocities"].value = "1800, 2000, 2300, 2600"
    panel.convert()
    assert app.section.to_time() is recorded
    assert "above" in app.section.velocity_text


def test_steps_and_levels_are_converted_too(app):
    app, _ = app
    level = float(app.section.z[50])
    app.steps = [sw.Step("unfault"), sw.Step("flatten", "H1", datum=level)]
    app.workspace.change_plan("regional", regional=level, pins=((500.0, level),))
    app.files.depth.convert()
    depth = sw.LinearVelocity(1800, 0.6).depth(0, level / 1000)
    plan = app.workspace.plan
    np.testing.assert_allclose([plan.steps[1].datum, plan.regional, plan.pins[0][1]], depth)


def test_the_session_opens_the_recorded_file_and_converts_it_again(app, tmp_path):
    app, _ = app
    app.files.depth.fields["source"].value = "well 1"
    app.files.depth.convert()
    app.files.session.path.value = str(tmp_path / "work.json")
    app.files.session.keep()
    app.interpretation = sw.Interpretation(app.interpretation.faults)
    app.session_bar.end()
    saved = max(tmp_path.glob("work*.json"), key=lambda path: path.stat().st_mtime_ns)
    again = sw.open_session(saved).open_section()
    np.testing.assert_array_equal(again.amplitude, app.section.amplitude)
    assert again.conversion.velocity.source == "well 1"


def test_the_readout_gives_the_recorded_time(app):
    app, _ = app
    app.files.depth.convert()
    reading = Reading((1000.0, 800.0), (1000.0, 800.0), np.nan, np.nan)
    time = 1000 * sw.LinearVelocity(1800, 0.6).time(0, 800.0)
    assert f"two-way time {time:.6g} ms" in reading.text(app.section)


@pytest.mark.parametrize(
    ("model", "fields", "message"),
    [
        ("v0 + k z", {"v0": "fast"}, "v0 (m/s) must be a finite number, but is 'fast'"),
        ("one velocity", {"velocity": "2.2"}, "from 100 to 12000 m/s"),
        ("time-depth table", {"table": "0 0\n100"}, "each row of the table must be"),
        ("layers between the horizons", {"velocities": "1800"}, "but there are 1 velocities"),
    ],
)
def test_bad_fields_are_named_beside_them(app, model, fields, message):
    app, _ = app
    panel, before = app.files.depth, app.section
    panel.model.value = model
    for name, value in fields.items():
        panel.fields[name].value = value
    panel.convert_button.click()
    assert message in panel.notice.text
    assert app.section is before


def test_a_prescribed_slip_brings_the_same_points_together_in_depth(app):
    app, case = app
    fault, horizon = app.interpretation.faults[0], app.interpretation.horizons[1]
    (cutoff,) = sw.cutoffs(fault, horizon)
    walls = [np.array([cutoff.hanging_wall, cutoff.footwall])]

    def arcs(section, line, points):
        top = section.to_rock(line.points[0])
        return [np.hypot(*(section.to_rock(point) - top)) for point in points]

    hanging_wall, footwall = arcs(app.section, fault, walls[0])  # nearly straight in rock, by one velocity
    profile = sw.SlipProfile([(hanging_wall + footwall) / 2], [hanging_wall - footwall])
    app.steps = [sw.Step("unfault", "F1", slip={"F1": profile})]
    app.files.depth.convert()
    deep = app.steps[0].slip["F1"]
    slip = 150 / np.sin(np.deg2rad(60))
    throw_at = case.interpretation.horizons[1].pieces[0][-1, 1] + 75
    assert deep.at(throw_at / np.sin(np.deg2rad(60))) == pytest.approx(slip, rel=0.01)
