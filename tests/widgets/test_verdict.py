import base64
import threading
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.widgets import restorer
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.live_restoration import OUTDATED
from seiswidgets.widgets.panels.reports import Reports
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.section_view.still import LEFT, SIZE, TOP
from seiswidgets.widgets.severity import LOOKS, label
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.status_bar import BUSY, StatusBar
from seiswidgets.widgets.verdict import TITLES, Verdict
from tests.widgets.hands import appear, drag_to, press, release

LONG = 60  # seconds until a restoration must be done
GOOD_TEXT = "Settled. Cut-offs meet to 0.01 samples."
NASTY = "<img src=x onerror=alert(1)>"
APART = sw.Finding("problem", "cut-off", "the cut-offs of H1 at F1 are 12 m apart", "H1")
LOOSE = sw.Finding("warning", "contact", "the sides of fault F1 are 3 m apart", "F1")
TOLD = sw.Finding("note", "bed length", "H1 is 1% longer", "H1")


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.planar_fault()


@pytest.fixture(scope="module")
def unfaulted(case):
    picks = case.interpretation
    return sw.Restoration(case.section, 200.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)


@pytest.fixture(scope="module")
def unsettled():
    """A restoration whose solver was stopped early, and the case it is of."""
    fold = sw.synthetic.faulted_fold()
    plan = sw.Plan(spacing=150.0, max_iterations=1)
    return fold, plan.restore(fold.section, fold.interpretation, fixed=fold.fixed)


def with_report(restoration, **changes):
    """The same restoration, its first stage reporting something else."""
    first, *others = restoration.stages
    report = replace(first.report, **changes)
    stage = replace(first)
    object.__setattr__(stage, "report", report)
    return replace(restoration, stages=(stage, *others))


def judged(restoration, *findings):
    return Verdict.of(with_report(restoration, findings=findings))


def test_a_good_result_is_said_to_be_good(unfaulted):
    verdict = Verdict.of(unfaulted)
    assert verdict.is_good
    assert str(verdict) == GOOD_TEXT
    assert str(judged(unfaulted, TOLD)) == f"{GOOD_TEXT} 1 note (see Report)"


def test_a_level_bed_is_praised_only_until_the_next_stage(case, unfaulted):
    first, _, third = case.interpretation.horizons
    flat = unfaulted.flatten(first)
    assert str(Verdict.of(flat)) == "Settled. Cut-offs meet to 0.01 samples; H1 lies on its datum to 0.01 m."
    assert "H1" not in str(Verdict.of(flat.flatten(third)))


def test_the_worst_finding_is_the_verdict(unfaulted):
    verdict = judged(unfaulted, TOLD, LOOSE, APART)
    assert verdict.severity == "problem"
    assert str(verdict) == f"cut-offs apart: {APART.text} and 1 more (see Report)"
    assert verdict.findings == (APART, LOOSE, TOLD)
    assert str(judged(unfaulted, LOOSE)) == f"check: fault sides apart: {LOOSE.text}"


def test_a_kind_without_a_title_of_its_own_is_its_own_title(unfaulted):
    assert judged(unfaulted, sw.Finding("problem", "hinge", "a hinge")).title == "hinge"


def test_a_stage_that_did_not_settle_is_one_problem(unsettled):
    _, stopped = unsettled
    verdict = Verdict.of(stopped)
    assert verdict.severity == "problem"
    unsettled_stages = sum(not stage.report.converged for stage in stopped.stages)
    assert [finding.kind for finding in verdict.findings].count("unsettled") == unsettled_stages > 0


def test_no_verdict_is_given_on_a_quick_look_or_on_nothing(case, unfaulted):
    assert Snapshot.of(sw.Restoration(case.section)).verdict is None
    assert Snapshot.of(replace(unfaulted, quick=True)).verdict is None
    assert Snapshot.of(unfaulted.at(0.5)).verdict == Snapshot.of(unfaulted).verdict


@pytest.mark.parametrize(("finding", "role"), [(APART, "alert"), (LOOSE, "status"), (TOLD, "status")])
def test_only_problems_interrupt_and_names_are_text(unfaulted, finding, role):
    bar = StatusBar(None, None)
    bar.judge(judged(unfaulted, replace(finding, text=f"{finding.text} {NASTY}")))
    assert f'role="{role}"' in bar.line.value
    assert "<img" not in bar.line.value
    assert bar.line.value.count("&lt;img") == (0 if finding is TOLD else 2)  # in the line, and in its tooltip


@pytest.mark.parametrize("severity", LOOKS)
def test_labels_can_be_read_and_told_apart_without_colour(severity):
    fill, ink = LOOKS[severity].colours
    assert contrast(fill, {"white": "#ffffff"}.get(ink, ink)) >= 4.5  # WCAG 2, level AA
    assert f'aria-label="{severity}"' in label(severity, "text")
    assert len({look.path for look in LOOKS.values()}) == len(LOOKS)


def contrast(*colours):
    dark, light = sorted(luminance(colour) for colour in colours)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour):
    """Relative luminance as WCAG 2 defines it."""
    channels = np.array([int(colour[start : start + 2], 16) / 255 for start in (1, 3, 5)])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def test_the_restored_pane_is_marked_and_so_is_its_still_picture(unfaulted):
    panes = LinkedPanes(with_report(unfaulted, findings=(APART,)))
    assert (panes.restored.badge.severity, panes.restored.badge.text) == ("problem", "cut-offs apart")
    assert panes.restored.badge.layout.display == ""
    assert not panes.original.badge.severity
    today, restored = framed_in_red(panes)
    assert restored
    assert not today
    panes.restoration = unfaulted
    assert panes.restored.badge.layout.display == "none"
    assert framed_in_red(panes) == [False, False]


def framed_in_red(panes):
    """Return whether each half of the still picture has a red upper edge."""
    picture = np.asarray(Image.open(BytesIO(base64.b64decode(panes.still()))))
    halves = np.split(picture, 2, axis=1)
    return [bool((half[TOP + 1, LEFT : LEFT + SIZE[0]] == (0xD3, 0x2F, 0x2F)).all()) for half in halves]


def test_the_mark_is_escaped(unfaulted):
    panes = LinkedPanes(with_report(unfaulted, findings=(replace(APART, kind=NASTY),)))
    assert "<img" not in panes.restored.badge.value


def test_findings_come_first_in_the_report(unfaulted):
    found = with_report(unfaulted, findings=(LOOSE, replace(APART, text=NASTY)))
    report = found.stages[0].report
    assert report.rows()[0][1].endswith(f"; but {NASTY}.")
    assert report.rows()[1] == ("warning", LOOSE.text)
    assert ["background: #d32f2f" in row for row in report._repr_html_().split("<tr>")[1:3]] == [True, False]
    reports = Reports()
    reports.show(found)
    page = reports.page.value
    assert page.index("&lt;img") < page.index(LOOSE.text) < page.index("<table")
    assert page.count(LOOSE.text) == 1
    assert "<img" not in page
    assert TITLES["cut-off"] in page


def test_a_pick_is_marked_with_its_worst_finding(case):
    picker = Picker(case.section, interpretation=case.interpretation)
    picker.show_findings([TOLD, replace(LOOSE, text=NASTY), APART])
    assert "&lt;img" in message(picker, "fault").value
    assert 'aria-label="warning"' in message(picker, "fault").value
    assert APART.text in message(picker, "horizon").value
    picker.show_findings([])
    assert message(picker, "horizon").layout.display == "none"


def message(picker, kind):
    return next(iter(picker.list.rows(kind).values())).message


@pytest.fixture
def new_app():
    """A function that makes an app which is on the screen; its threads are ended."""
    made = []

    def new(section, *arguments, **settings):
        app = RestorationApp(section, *arguments, **settings)
        appear(app.panes.original, app.panes.restored)
        made.append(app)
        assert app.wait(LONG)
        return app

    yield new
    for app in made:
        app.close()
        assert app.wait(LONG)


@pytest.fixture
def app(new_app, case):
    app = new_app(case.section, case.interpretation, fixed=case.fixed, steps=(sw.Step("unfault"),))
    app.solving.spacing = 200.0
    assert app.wait(LONG)
    return app


def test_a_result_that_did_not_settle_does_not_look_like_a_good_one(new_app, unsettled):
    fold, stopped = unsettled
    app = new_app(fold.section, fold.interpretation, fixed=fold.fixed, live=False)
    app.restoration = stopped
    assert "did not settle" in app.status.line.value
    assert 'role="alert"' in app.status.line.value
    assert app.panes.restored.badge.severity == "problem"
    assert "did not settle" in app.reports.page.value.split("<table")[0]


def test_contradicting_picks_are_a_problem_in_the_app(app, case):
    assert app.status.text == GOOD_TEXT
    first, _, third = case.interpretation.horizons
    falling = sw.Horizon(first.pieces[0], third.pieces[1], name="falling")
    rising = sw.Horizon(third.pieces[0], first.pieces[1], name="rising")
    app.interpretation = sw.Interpretation(case.interpretation.faults, [falling, rising])
    assert app.wait(LONG)
    assert 'role="alert"' in app.status.line.value
    assert "'rising' contradicts horizon 'falling'" in app.status.text
    assert app.panes.restored.badge.severity == "problem"
    assert "until then it is only carried along" in app.picker.list.rows("horizon")["rising"].message.value
    app.interpretation = case.interpretation
    assert app.wait(LONG)
    assert app.status.text == GOOD_TEXT
    assert not app.panes.restored.badge.severity
    assert message(app.picker, "horizon").layout.display == "none"


def test_no_verdict_stands_beside_a_newer_picture(app, case, monkeypatch):
    begun, go_on, made = threading.Event(), threading.Event(), restorer.RestorationJob.restored

    def slow(self, earlier=None, progress=None):
        if not self.quick:
            begun.set()
            assert go_on.wait(LONG)
        return made(self, earlier, progress)

    monkeypatch.setattr(restorer, "BUDGET", 10.0)
    monkeypatch.setattr(restorer.RestorationJob, "restored", slow)
    app.restoration = with_report(app.restoration, findings=(APART, LOOSE))
    assert app.panes.restored.badge.severity == "problem"
    app.picker.mode = "horizon"
    pane, vertex = app.panes.original, case.interpretation.horizons[0].pieces[0][3]
    press(pane, vertex)
    drag_to(pane, vertex + (0, 20.0))
    assert app.panes.shown.is_preview
    assert app.status.text == BUSY
    assert not app.panes.restored.badge.severity
    assert message(app.picker, "fault").layout.display == "none"
    release(pane, vertex + (0, 20.0))
    assert begun.wait(LONG)
    assert app.status.text == BUSY
    go_on.set()
    assert app.wait(LONG)
    assert app.status.text not in (BUSY, "")


def test_a_verdict_on_other_picks_is_withdrawn(app):
    app.live = False
    app.restoration = with_report(app.restoration, findings=(APART,))
    app.weights = sw.Weights(stitch=33.0)
    assert app.status.text == OUTDATED
    assert message(app.picker, "horizon").layout.display == "none"
    app.restore()
    app.cancel()
    assert app.wait(LONG)
    assert app.status.text == OUTDATED


def test_picks_that_are_not_finished_are_not_scolded(app, case):
    above = sw.Fault([(3000.0, 50.0), (3100.0, 300.0)], "F2")
    app.interpretation = sw.Interpretation([*case.interpretation.faults, above], case.interpretation.horizons)
    assert app.wait(LONG)
    said = (app.status.line.value, *(row.message.value for row in app.picker.list.rows("fault").values()))
    assert "F2" in "".join(said)
    assert not any('role="alert"' in text or "problem" in text for text in said)


def test_a_rest_that_turns_can_be_kept_by_a_button_which_undo_takes_back(new_app):
    case = sw.synthetic.tilt()
    (bed,) = case.interpretation.horizons[0].pieces
    picks = sw.Interpretation(horizons=[sw.Horizon(bed[bed[:, 0] < 700], name="H1")])
    app = new_app(case.section, picks)
    assert app.wait(30)
    assert "the rest turns" in app.status.text
    assert "“beyond its ends”" in app.status.text
    shown = [button.description for button in app.status.offers.children]
    assert shown == ["Leave the rest", "Extend level", "Extend along trend"]
    app.status.offers.children[0].click()
    assert [step.beyond for step in app.steps] == ["free", "keep"]
    assert app.workspace.history.next_undo.label == "leave the rest of H1"
    assert app.wait(30)
    far = case.section.extent[1] - 50, case.section.extent[3] - 50
    np.testing.assert_allclose(app.restoration.to_restored([far]), [far], atol=1e-6)
    assert app.status.offers.layout.display == "none"
    app.picker.editor.undo()
    assert app.steps == sw.Plan().steps
