"""Uncertainty in the app."""

import base64
import io

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.panels import uncertainty
from tests.executors import InThisThread

LONG = 60  # seconds
CASE = sw.synthetic.planar_fault(throw=60.0, width=1500.0, depth=1000.0, horizons=(400.0, 600.0))


@pytest.fixture
def app(monkeypatch):
    """An app, whose members are computed without other processes."""

    def compute(study, indices, workers):
        return compute_members(study, indices, InThisThread())

    compute_members = uncertainty.iterate_members
    monkeypatch.setattr(uncertainty, "iterate_members", compute)
    app = RestorationApp(CASE.section, CASE.interpretation, fixed=CASE.fixed)
    app.workspace.change_plan("mesh", spacing=150.0)
    assert app.wait(LONG)
    yield app
    app.close()


@pytest.fixture
def panel(app):
    return app.uncertainty_panel


def run(panel, members=4):
    panel.members.value = members
    panel.run_button.click()
    assert panel.wait(LONG)


def test_sliders_become_deviations(panel):
    panel.sliders["velocity"].value, panel.sliders["horizon"].value = 5, 2
    assert panel.uncertainty == sw.Uncertainty(horizon=2, fault=1, correlation_length=500, dip=0, velocity=0.05)


def test_a_run_shows_error_bars_bands_and_a_map(panel):
    panes, before = panel._panes, len(panel._panes.restored.layer.strokes)
    run(panel)
    ensemble = panel.ensemble
    assert len(ensemble.members) == 4
    assert panel.table.value.count("<svg") == np.sum(np.ptp(ensemble.values, axis=0) > 0)
    assert "throw H1 at F1" in panel.table.value
    assert len(panes.restored.layer.strokes) == before + 2 * len(ensemble.frame.horizons)
    assert panes.original.layer.shade == {}
    panel.map_box.value = True
    shade = panes.original.layer.shade
    picture = Image.open(io.BytesIO(base64.b64decode(shade["href"].partition(",")[2])))
    assert picture.size == ensemble.frame.nodes.shape[1::-1]
    x_min, x_max, z_min, z_max = CASE.section.extent
    half = CASE.section.dx / 2, CASE.section.dz / 2
    assert shade["window"] == [x_min - half[0], x_max + half[0], z_min - half[1], z_max + half[1]]


def test_the_match_is_drawn_from_the_peaks_of_a_scan(panel):
    panel.match_box.value = True
    run(panel, 3)
    ensemble = panel.ensemble
    peaks = sw.scan(CASE.section, CASE.interpretation.faults[0]).peaks
    means = [(min(peak.profile.slip) + max(peak.profile.slip)) / 2 for peak in peaks]
    slips = ensemble.values[:, ensemble.labels.index(("slip", "F1"))]
    assert all(min(abs(slip - mean) for mean in means) < 1 for slip in slips)


def test_the_report_shows_the_error_bars_too(app, panel):
    run(panel)
    assert panel.table.value in app.reports.errors.value
    app.workspace.change_plan("weights", weights=sw.Weights(edge=2))
    assert app.reports.errors.value == ""


def test_an_edit_makes_it_outdated(panel):
    run(panel)
    panel.map_box.value = True
    before = len(panel._panes.restored.layer.strokes)
    panel._workspace.change_plan("weights", weights=sw.Weights(edge=2))
    assert panel.ensemble is None
    assert panel.table.value == ""
    assert "run it again" in panel.message.value
    assert panel._panes.original.layer.shade == {}
    assert len(panel._panes.restored.layer.strokes) < before


def test_what_cannot_be_restored_is_said(panel):
    panel._workspace.history.edit("clear", drawing=type(panel._workspace.drawing)())
    panel._workspace.change_plan("steps", steps=(sw.Step("unfault", ("F9",)),))
    run(panel)
    assert "no fault called" in panel.message.value
    assert not panel.run_button.disabled
