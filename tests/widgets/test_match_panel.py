"""The tab Match: the present match, slips that are dragged, proposals, and what cannot be compared."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.drawing import PickSelection

TRUE = 173.2  # metres of slip


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold(width=2500, depth=1500, horizons=(600.0, 800.0, 1000.0), noise=0.0)


@pytest.fixture(scope="module")
def opened(case):
    """An app whose second horizon ends at the fault on one side only, with the tab Match opened."""
    picks = case.interpretation
    whole, half, _ = picks.horizons
    drawn = sw.Interpretation(picks.faults, [whole, sw.Horizon(half.pieces[0], name="H2")])
    app = sw.RestorationApp(case.section, drawn, fixed=case.fixed)
    app.match.wait(60)
    yield app
    app.close()


@pytest.fixture
def app(opened):
    """That app, whose edits are undone afterwards."""
    yield opened
    while opened.workspace.history.next_undo:
        opened.picker.editor.undo()
    opened.wait(60)


def test_the_curve_shows_the_match_that_is_picked(app):
    panel = app.match
    assert panel.fault.value == "F1"
    assert panel.chart.slip == pytest.approx(TRUE, abs=1)
    assert panel.chart.curve["peaks"][0]["slip"] == pytest.approx(TRUE, abs=3)
    assert len(panel.chart.curve["deformation"]) > 3
    assert [line["title"] for line in panel.chart.profile["lines"]] == ["throw (m)", "heave (m)", "correlation"]
    assert panel.chart.span == list(app.panes.original.view.window[2:])
    assert panel.chart.summary.startswith("F1: picked slip of 173 m")
    assert panel.by_horizons.disabled


def test_a_slip_that_is_dragged_is_one_edit_and_is_restored(app):
    panel, history = app.match, app.workspace.history
    before = history.undo_count
    for slip in (120.0, 130.0):
        panel.chart._handle_custom_msg({"kind": "slide", "slip": slip, "settled": False}, [])
        assert panel.chart.slip == pytest.approx(slip)
        assert not app.workspace.settled
    panel.chart._handle_custom_msg({"kind": "slide", "slip": 130.0, "settled": True}, [])
    assert history.undo_count == before + 1
    assert history.next_undo.label == "slip of F1"
    app.wait(60)
    assert app.restoration.stages[0].report.slips[0].most == pytest.approx(130)
    panel.by_horizons.click()
    app.wait(60)
    assert app.restoration.stages[0].report.slips == ()
    assert panel.chart.slip == pytest.approx(TRUE, abs=1)


def test_a_peak_gives_its_whole_profile(app):
    panel = app.match
    best = panel.scan.peaks[0]
    panel.chart._handle_custom_msg({"kind": "slide", "slip": best.slip, "settled": True}, [])
    assert app.steps[0].slip == {"F1": best.profile}


def test_the_marker_follows_a_horizon_that_is_moved(app):
    drawing = app.workspace.drawing
    (left, right), others = drawing.pick("horizon", "H1").pieces, app.match.chart.slip
    lower = [(x + 20 / np.sqrt(3), z + 20) for x, z in right]
    app.workspace.edit("move", drawing=drawing.with_pieces("horizon", "H1", [left, lower]))
    assert app.match.chart.slip > others + 15


def test_suggestions_are_accepted_or_dismissed(app, case):
    panel = app.match
    panel.suggest_all.click()
    panel.wait(60)
    (proposal,) = panel.proposals
    assert proposal.horizon == "H2"
    (ghost,) = app.picker._ghosts
    assert ghost.label.startswith("H2? ")
    panel.accept(proposal)
    assert panel.proposals == app.picker._ghosts == ()
    _, drawn = app.interpretation.horizon("H2").pieces
    truth = case.interpretation.horizon("H2").pieces[1]
    np.testing.assert_allclose(drawn[:, 1], np.interp(drawn[:, 0], *truth.T), atol=case.section.dz)
    app.picker.editor.undo()
    panel.suggest.click()
    panel.wait(60)
    panel.dismiss(panel.proposals[0])
    assert len(app.interpretation.horizon("H2").pieces) == 1


def test_the_fault_is_the_one_that_is_selected():
    case = sw.synthetic.graben(horizons=(600.0,))
    app = sw.RestorationApp(case.section, case.interpretation)
    panel = app.match
    assert panel.fault.options == ("F1", "F2")
    app.picker.editor.select("fault", "F2")
    app.picker.refresh()
    assert app.picker.selection == PickSelection("fault", "F2")
    panel.wait(60)
    assert (panel.fault.value, panel.scan.fault) == ("F2", "F2")
    app.close()


def test_what_cannot_be_compared_is_said_in_words():
    blank = sw.Section(np.zeros((100, 100)), 10.0, 10.0)
    app = sw.RestorationApp(blank)
    panel = app.match
    assert "Draw a fault" in panel.message.value
    assert panel.suggest.disabled
    app.interpretation = sw.Interpretation([sw.Fault([(400, 0), (600, 990)], "F")])
    panel.wait(60)
    assert "all amplitudes are alike" in panel.message.value
    assert panel.chart.curve == {}
    panel.chart._handle_custom_msg({"kind": "slide", "slip": 5.0, "settled": True}, [])
    assert not any(step.slip for step in app.steps)
    app.close()
