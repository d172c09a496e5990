import base64
import re
import threading
from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import PickError
from seiswidgets.interaction.overlay import stroke_points
from seiswidgets.widgets import restorer
from seiswidgets.widgets.app import RestorationApp
from tests.widgets.hands import appear, drag_to, draw, press, release, tell

LONG = 60  # seconds until a restoration must be done


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold()


@pytest.fixture
def new_app(case):
    """A function that makes an app which is on the screen; its threads are ended."""
    made = []

    def new(*arguments, section=case.section, **settings):
        app = RestorationApp(section, *arguments, **settings)
        app.solving.spacing = settings.get("spacing", 100.0)
        appear(app.panes.original, app.panes.restored)
        made.append(app)
        return app

    yield new
    for app in made:
        app.close()
        assert app.wait(LONG)


@pytest.fixture
def app(new_app, case):
    app = new_app(case.interpretation, fixed=case.fixed)
    assert app.wait(LONG)
    return app


def drawn_frames(app, monkeypatch):
    """Snapshots drawn from now on."""
    frames, show = [], app.panes.show

    def noting(frame, **choices):
        frames.append(frame)
        show(frame, **choices)

    monkeypatch.setattr(app.panes, "show", noting)
    return frames


def test_an_empty_app_says_what_to_do(new_app, case):
    app = new_app()
    assert "Draw a fault" in app.status.text
    app.interpretation = sw.Interpretation(case.interpretation.faults)
    assert "Now choose Horizon and draw one on both sides of F1" in app.status.text
    assert app.restoration.stages == ()
    app.interpretation = case.interpretation
    assert app.wait(LONG)
    assert app.status.text.startswith("Settled. Cut-offs meet to ")
    assert len(app.restoration.stages) == 2


@pytest.mark.parametrize(("piece", "side"), [(0, "right"), (1, "left")])
def test_a_drawing_in_progress_is_not_scolded_but_told_what_is_next(new_app, case, piece, side):
    pieces = sorted(case.interpretation.horizons[0].pieces, key=lambda points: points[:, 0].mean())
    app = new_app(sw.Interpretation(case.interpretation.faults, [sw.Horizon(pieces[piece][3:-3], name="H1")]))
    assert app.wait(LONG)
    assert f"Now draw H1 {side} of F1" in app.status.text
    assert 'role="status"' in app.status.line.value
    assert app.panes.restored.badge.severity in ("", "note")
    assert not [mark for mark in app.panes.original.layer.marks if mark["kind"] == "finding"]
    app.interpretation = case.interpretation
    assert app.wait(LONG)
    assert app.status.text.startswith("Settled")


def test_a_hold_that_cannot_be_explains_itself_in_the_apps_words_at_its_pin(new_app):
    case = sw.synthetic.planar_fault()
    app = new_app(case.interpretation, section=case.section)
    outside = (case.section.extent[1] + 100.0, 500.0)
    app.workspace.change_plan("pin", pins=(outside,))
    app.restore()
    assert app.wait(LONG)
    assert app.status.text.startswith("Hold: the pin lies outside the rock")
    assert app.panes.restored.badge.text == "not restored"
    marks = {mark["kind"]: mark for mark in app.panes.original.layer.marks}
    flag, pin = marks["finding"], marks["held"]
    assert (flag["x"], flag["z"]) == pytest.approx((pin["x"], pin["z"]), abs=1)


def test_what_no_fault_cuts_off_is_held_and_shows_its_pin(new_app):
    blind = sw.synthetic.blind_fault()
    app = new_app(blind.interpretation, section=blind.section, fixed=(500.0, 1000.0))
    assert app.wait(LONG)
    assert app.restoration.settled
    assert [mark["kind"] for mark in app.panes.original.layer.marks if mark["text"] == "held"] == ["held"]
    assert app.panes.original.layer.mesh_opacity == 0


def test_a_flag_on_the_section_opens_its_finding(app, case):
    left, right = case.interpretation.horizons[0].pieces
    crossing = sw.Horizon(left + [0, 300], right - [0, 250], name="X")
    app.interpretation = sw.Interpretation(case.interpretation.faults, [*case.interpretation.horizons[:1], crossing])
    assert app.wait(LONG)
    flagged = [mark for mark in app.panes.original.layer.marks if mark["kind"] == "finding"]
    shown = [finding for finding in app.restoration.findings if finding.severity != "note" and finding.where]
    assert [mark["text"] for mark in flagged] == [finding.text for finding in shown]
    np.testing.assert_allclose([(mark["x"], mark["z"]) for mark in flagged], [finding.where for finding in shown])
    app.tabs.selected_index = 1
    index = next(index for index, finding in enumerate(shown) if finding.pick == "X")
    tell(app.panes.original, "finding", key=str(index))
    assert shown[index].text in app.status.text
    assert app.picker.editor.state.selection.name == "X"
    assert app.tabs.selected_index == 0


def test_picks_drawn_by_hand_restore_by_themselves(new_app, case):
    app = new_app()
    app.picker.mode = "fault"
    draw(app.panes.original, *case.interpretation.faults[0].points.tolist())
    app.picker.mode = "horizon"
    for piece in case.interpretation.horizons[0].pieces:
        draw(app.panes.original, *piece[::5].tolist(), piece[-1].tolist())
    assert app.wait(LONG)
    assert [stage.kind for stage in app.restoration.stages] == ["unfault", "flatten"]
    (bed,) = app.restoration.stages[-1].report.beds
    assert bed.flatness < case.section.dz / 10
    assert app.timeline.labels == ["unfault", "flatten"]
    assert app.timeline.time == 2
    assert "throw" in app.reports.page.value


def test_a_line_drawn_in_the_restored_pane_lies_where_the_restoration_says(app, case):
    x_min, x_max, z_min, z_max = case.section.extent
    points = [(x_min + share * (x_max - x_min), z_min + 0.8 * (z_max - z_min)) for share in (0.05, 0.15, 0.3)]
    there = app.restoration.to_original(points)
    app.picker.mode = "horizon"
    app.picker.editor.deselect()
    draw(app.panes.restored, *points)
    new = app.interpretation.horizons[-1]
    pixel = app.panes.original.view.pixel
    for point in there:
        away = np.abs((np.concatenate(new.pieces) - point) / pixel).max(axis=1)
        assert away.min() < 1
    (line,) = (stroke_points(s) for s in app.panes.original.layer.strokes if s["label"] == new.name)
    assert len(line) == len(np.concatenate(new.pieces))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("weights", sw.Weights(stitch=50.0)),
        ("steps", (sw.Step("unfault"),)),
        ("fixed", None),
        ("interpretation", sw.synthetic.planar_fault().interpretation),
    ],
)
def test_traits_set_from_code_restore(app, case, name, value):
    before = app.restoration
    setattr(app, name, value)
    assert app.wait(LONG)
    assert app.restoration is not before
    direct = app.plan.restore(case.section, app.interpretation, fixed=app.fixed)
    points = np.random.default_rng(0).uniform(*np.reshape(case.section.extent, (2, 2)).T, size=(100, 2))
    np.testing.assert_allclose(app.restoration.to_restored(points), direct.to_restored(points), atol=10.0)
    control = {"weights": app.sliders, "steps": app.step_list}.get(name, app.picker)
    assert getattr(control, name) == value or name == "interpretation"


def test_a_restoration_set_from_code_is_shown_and_not_made_again(app, case):
    other = sw.Restoration(case.section, 120.0).unfault(case.interpretation.faults, case.interpretation.horizons)
    app.restoration = other
    assert app.wait(LONG)
    assert app.restoration is other
    assert app.panes.shown.restoration is other
    assert app.timeline.labels == ["unfault"]
    with pytest.raises(sw.SettingError, match="another section"):
        app.restoration = sw.Restoration(sw.synthetic.planar_fault().section)


def test_a_source_that_is_none_is_refused(case):
    with pytest.raises(sw.SettingError, match="source must be a SectionSource, but is a str"):
        sw.RestorationApp(case.section, source="line.sgy")


def test_dragging_restores_as_it_moves_and_in_full_at_rest(app, case, monkeypatch):
    monkeypatch.setattr(restorer, "BUDGET", 10.0)
    frames = drawn_frames(app, monkeypatch)
    whole = app.restoration
    app.picker.mode = "horizon"
    pane, vertex = app.panes.original, case.interpretation.horizons[0].pieces[0][3]
    press(pane, vertex)
    for step in (20.0, 40.0, 60.0):
        drag_to(pane, vertex + (0, step))
        assert frames[-1].is_preview
        assert app.restoration is whole
    assert len(frames) == 3
    assert len(frames[-1].restoration.stages[1].vertices) < 0.5 * len(whole.stages[1].vertices)
    release(pane, vertex + (0, 60.0))
    assert app.wait(LONG)
    assert not frames[-1].is_preview
    assert app.restoration is frames[-1].restoration


def test_twenty_quick_moves_of_a_slider_draw_only_the_newest(app, monkeypatch):
    newest, drawn = [], []
    show = app.panes.show

    def noting(frame, **choices):
        drawn.append((frame.is_preview, app.weights.stitch, newest[-1]))
        show(frame, **choices)

    monkeypatch.setattr(app.panes, "show", noting)
    (slider,) = (one for one in _sliders(app.sliders) if "stitch" in one.description)
    for value in np.geomspace(1, 100, 20):
        newest.append(float(value))
        slider.value = value
    assert app.wait(LONG)
    assert all(asked == pytest.approx(known) for _, asked, known in drawn)
    assert [preview for preview, *_ in drawn][-1] is False
    assert sum(not preview for preview, *_ in drawn) == 1


def _sliders(widget):
    found = [widget] if hasattr(widget, "base") else []
    return found + [one for child in getattr(widget, "children", ()) for one in _sliders(child)]


def test_cancel_leaves_what_was_there(app, monkeypatch):
    before, begun, go_on = app.restoration, threading.Event(), threading.Event()
    restored = restorer.RestorationJob.restored

    def slow(self, earlier=None, progress=None):
        def told(*numbers):
            begun.set()
            go_on.wait(LONG)
            return progress(*numbers)

        return restored(self, earlier, told)

    app.live = False
    app.weights = sw.Weights(stitch=33.0)
    assert "press Restore" in app.status.text
    monkeypatch.setattr(restorer.RestorationJob, "restored", slow)
    app.restore()
    assert begun.wait(LONG)
    app.cancel()
    go_on.set()
    assert app.wait(LONG)
    assert app.restoration is before
    assert app.panes.shown.restoration is before


def test_progress_names_the_step_its_iteration_and_the_energy(app, monkeypatch):
    said = []
    monkeypatch.setattr(restorer, "REPORT_INTERVAL", 0.0)
    app.status.label.observe(lambda change: said.append(change.new), "value")
    app.weights = sw.Weights(stitch=77.0)
    assert app.wait(LONG)
    assert any(re.match(r"unfault: iteration \d+, energy ", text) and text.endswith("m²") for text in said)
    assert app.status.progress.layout.display == "none"


def test_what_is_wrong_is_said_in_the_app_and_beside_the_pick(app, case):
    app.steps = (sw.Step("unfault"),)
    assert app.wait(LONG)
    before = app.restoration
    far = sw.Fault([(100.0, 100.0), (150.0, 500.0)], "<b>far</b>")
    app.interpretation = sw.Interpretation([far], case.interpretation.horizons)
    app.restore()
    assert app.wait(LONG)
    assert "<b>far</b>" in app.status.text
    assert "<b>far</b>" not in app.status.line.value
    rows = app.picker.list.rows("fault")
    assert "&lt;b&gt;far&lt;/b&gt;" in rows["<b>far</b>"].message.value
    assert app.restoration is before
    assert "seiswidgets-outdated" in app.panes.restored._dom_classes
    app.interpretation = case.interpretation
    assert app.wait(LONG)
    assert app.status.text.startswith("Settled. Cut-offs meet to ")
    assert "seiswidgets-outdated" not in app.panes.restored._dom_classes


def test_what_should_not_happen_is_said_too(app, monkeypatch, caplog):
    def broken(*arguments, **keywords):
        raise ZeroDivisionError("oh")

    app.live = False
    monkeypatch.setattr(restorer.RestorationJob, "restored", broken)
    app.restore()
    assert app.wait(LONG)
    assert "should not have happened: ZeroDivisionError" in app.status.text
    assert "a background job failed" in caplog.text


def test_the_timeline_shows_every_moment(app, case):
    for time in (0.0, 0.4, 1.0, 1.7):
        app.timeline.time = time
        shown = app.panes.shown.restoration
        assert len(shown.stages) == int(np.ceil(time))
        points = [(500.0, 500.0), (3000.0, 1500.0)]
        np.testing.assert_allclose(shown.to_restored(points), app.restoration.at(time).to_restored(points))
        ratio = app.restoration.at(time).area_ratio_at([points[0]])[0]
        assert f"median {np.nanmedian(app.panes.shown.ratio):.3f}" in app.histogram.summary
        assert time or ratio == 1
    app.timeline.time = 2.0
    assert app.panes.shown.restoration is app.restoration


def test_histogram_and_panes_share_brush_and_mark(app):
    app.panes.deformation = 0.5
    app.histogram.brush = [1.0, 1.1]
    assert app.panes.brush == [1.0, 1.1]
    app.panes.span = 1.3
    assert app.histogram.span == 1.3
    x, y = app.panes.original.view.to_pixels((1000.0, 1000.0)).tolist()
    tell(app.panes.original, "hover", x=x, y=y)
    assert app.histogram.mark == pytest.approx(app.restoration.area_ratio_at([(1000.0, 1000.0)])[0])
    tell(app.panes.original, "leave")
    assert app.histogram.mark is None


def test_a_reader_without_a_kernel_sees_a_picture(app):
    bundle = app._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/png"]).startswith(b"\x89PNG")


def test_the_app_of_a_time_section_and_settings_from_the_start(case):
    section = replace(case.section, z_unit="ms", velocity=2000.0)
    app = RestorationApp(section, live=False, weights=sw.Weights(edge=2.0), steps=(sw.Step("flatten"),))
    assert app.plan == sw.Plan((sw.Step("flatten"),), sw.Weights(edge=2.0))
    assert not app.live
    app.close()
    with pytest.raises(PickError, match="no fault called"):
        sw.Plan((sw.Step("unfault", ("F9",)),)).restore(section, case.interpretation)


@pytest.mark.parametrize(
    ("make", "misspelt", "hint"),
    [
        (lambda **settings: RestorationApp(sw.synthetic.tilt().section, **settings), "heigth", "height"),
        (sw.Gallery, "whith_picks", "with_picks"),
        (sw.StepList, "interpretations", "interpretation"),
        (sw.WeightSliders, "weigths", "weights"),
    ],
    ids=["RestorationApp", "Gallery", "StepList", "WeightSliders"],
)
def test_a_misspelt_keyword_is_refused_with_a_suggestion(make, misspelt, hint):
    with pytest.raises(TypeError, match=f"no keyword {misspelt}=; did you mean {hint}="):
        make(**{misspelt: None})
