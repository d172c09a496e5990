import base64
import json
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from comm import DummyComm
from PIL import Image

import seiswidgets as sw
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.interaction.overlay import Stroke
from seiswidgets.widgets import linked_panes
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.section_view.still import LEFT, SIZE, TOP
from seiswidgets.widgets.snapshot import Snapshot
from tests.widgets.hands import appear, tell


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold()


@pytest.fixture(scope="module")
def restored(case):
    return sw.Plan(spacing=80.0).restore(case.section, case.interpretation, fixed=case.fixed)


@pytest.fixture
def panes(restored):
    panes = LinkedPanes(restored)
    appear(panes.original, panes.restored)
    return panes


def hover(pane, point):
    x, y = pane.view.to_pixels(point).tolist()
    tell(pane, "hover", x=x, y=y)


def test_both_panes_fit_the_same_window_which_holds_all_rock(panes, restored):
    assert panes.original.frame == panes.restored.frame == panes.original.view.window == panes.restored.view.window
    x_min, x_max, z_min, z_max = panes.original.frame
    corners = restored.original.from_rock(restored.stages[-1].vertices)
    slack = 0.01 * np.array([x_max - x_min, z_max - z_min])
    assert (corners >= (x_min, z_min) - slack).all()
    assert (corners <= (x_max, z_max) + slack).all()


def test_the_readout_follows_what_changes_under_a_pointer_at_rest(panes, restored):
    point = (1500.0, 900.0)
    hover(panes.original, point)
    panes.show(Snapshot.of(restored.at(1.0)), follow=False)
    (x, z), *_ = restored.at(1.0).to_restored([point]).tolist()
    assert f"restored: x {x:.6g} m, depth {z:.6g} m" in panes.readout.value
    before = panes.readout.value
    tell(panes.original, "key", key="+")
    assert panes.readout.value != before
    x, z = panes.original.pointer
    assert f"present day: x {x:.6g} m, depth {z:.6g} m" in panes.readout.value


def test_a_section_alone_is_its_own_restoration(case):
    panes = LinkedPanes(case.section)
    appear(panes.original, panes.restored)
    assert panes.restoration.stages == ()
    assert panes.restored.section is case.section
    assert panes.picture.stages == []


def test_the_picture_holds_the_meshes_in_samples_and_only_new_ones_are_encoded_again(panes, restored):
    section = restored.original
    states = panes.picture.stages
    after = np.frombuffer(states[-1]["after"], "<f4").reshape(-1, 2)
    points = after * (section.dx, section.dz) + (section.x0, section.z0)
    np.testing.assert_allclose(points, section.from_rock(restored.stages[-1].vertices), atol=1e-3)
    panes.show(Snapshot(replace(restored, stages=restored.stages[:1])))
    assert [state is states[0] for state in panes.picture.stages] == [True]


def test_what_is_under_the_pointer_is_read_out_in_units(panes, restored, case):
    seen = []
    panes.on_reading(seen.append)
    point = (1230.0, 780.0)
    hover(panes.original, point)
    reading = seen[-1]
    np.testing.assert_allclose(reading.original, point, atol=1e-6)
    np.testing.assert_allclose(reading.restored, restored.to_restored([point])[0])
    column, row = round(point[0] / case.section.dx), round(point[1] / case.section.dz)
    assert reading.amplitude == pytest.approx(case.section.amplitude[row, column])
    assert reading.ratio == pytest.approx(restored.area_ratio_at([point])[0])
    for words in ("1230 m", "depth 780 m", "amplitude", "area ratio", "restored"):
        assert words in panes.readout.value
    hover(panes.restored, reading.restored)
    np.testing.assert_allclose(seen[-1].original, point, atol=1e-3)
    tell(panes.restored, "leave")
    assert seen[-1] is None
    assert "amplitude" not in panes.readout.value


def test_beyond_the_rock_there_is_nothing_to_read(panes):
    seen = []
    panes.on_reading(seen.append)
    hover(panes.restored, (-1000.0, -1000.0))
    assert np.isnan(seen[-1].amplitude)
    assert np.isnan(seen[-1].ratio)


def test_panes_share_their_window_or_if_that_is_switched_off_their_exaggeration(panes):
    panes.original.view = panes.original.view.zoomed(2)
    assert panes.restored.view.window == panes.original.view.window
    panes.restored.view = panes.restored.view.zoomed(3, (100, 100))
    assert panes.original.view.window == panes.restored.view.window
    tell(panes.original, "size", width=500, height=400, ratio=1)  # the other one's message is still to come
    assert panes.restored.exaggeration == pytest.approx(panes.original.exaggeration)
    panes.zoom_linked = False
    panes.original.fit()
    assert not panes.restored.view.is_fitted
    for pane in (panes.original, panes.restored):
        pane.exaggeration *= 1.5
        assert panes.restored.exaggeration == pytest.approx(panes.original.exaggeration)


def test_the_view_follows_the_rock_only_when_it_is_told_to(panes, restored):
    today = sw.Restoration(restored.original)
    panes.show(Snapshot.of(today))
    whole = panes.original.view.window
    assert whole == panes.original.view.covered
    panes.show(Snapshot.of(restored), follow=False)  # after an edit
    assert panes.original.view.window == panes.restored.view.window == whole
    assert "0 shows all" in panes.restored.layer.axes["note"]
    tell(panes.original, "size", width=800, height=400, ratio=2)
    assert panes.original.view.window == whole
    tell(panes.original, "size", width=500, height=400, ratio=2)  # the picture changes in any case
    assert panes.original.view.window == panes.restored.view.window == panes.original.frame != whole
    panes.show(Snapshot.of(today))
    panes.show(Snapshot.of(restored), follow=False)
    panes.restored.fit()
    assert panes.original.view.window == panes.original.frame != whole
    assert "0 shows all" not in panes.restored.layer.axes["note"]
    panes.show(Snapshot.of(today))  # after an undo
    assert panes.original.view.window == panes.restored.view.window == whole


def test_colours_of_the_first_pane_hold_for_both(panes):
    panes.original.colours, panes.original.gain, panes.original.polarity = "red-white-blue", 2.0, -1
    assert (panes.restored.colours, panes.restored.gain, panes.restored.polarity) == ("red-white-blue", 2.0, -1)
    before = panes.restored.limit
    panes.original.clip = 80.0
    assert panes.restored.limit < before


def test_mesh_deformation_and_brush_reach_the_picture(panes):
    panes.mesh = 0.5
    assert panes.original.mesh_opacity == panes.restored.mesh_opacity == 0.5
    panes.deformation = 0.7
    full = palette_of(panes)
    assert panes.picture.deformation["opacity"] == 0.7
    assert panes.picture.deformation["span"] == panes.span
    panes.brush = [1.0, 1.05]
    brushed = palette_of(panes)
    lit = brushed[:, 3] == 255
    assert 0 < lit.sum() < 255
    assert (brushed[~lit, 3] <= full[~lit, 3]).all()
    panes.deformation = 0.0
    alone = palette_of(panes)
    assert panes.picture.deformation["opacity"] > 0
    assert (alone[lit] == brushed[lit]).all()
    assert not alone[~lit, 3].any()
    panes.brush = []
    assert panes.picture.deformation["opacity"] == 0


def palette_of(panes):
    return np.frombuffer(panes.picture.deformation["palette"], np.uint8).reshape(256, 4)


def test_a_preview_sends_little_and_moves_no_window(restored, monkeypatch):
    panes = LinkedPanes(restored)
    appear(panes.original, panes.restored)
    panes.original.view = panes.original.view.zoomed(1.5)
    before, sizes = panes.restored.view, []
    preview = RestorationJob(restored.original, sw.synthetic.faulted_fold().interpretation, sw.Plan()).coarse.restored()

    def publish(self, kind, data=None, metadata=None, buffers=None, **keys):
        sizes.append(len(json.dumps(data)) + sum(memoryview(buffer).nbytes for buffer in buffers or ()))

    monkeypatch.setattr(DummyComm, "publish_msg", publish)
    panes.show(Snapshot.of(preview))
    assert 1000 < sum(sizes) <= 30_000
    assert panes.restored.view == before
    assert panes.shown.restoration is preview


def test_what_is_seen_at_once_is_held_until_all_of_it_is_sent(panes, restored):
    changes = []
    panes.picture.observe(lambda change: changes.append((change.name, change.new)), ["changing", "stages"])
    panes.show(Snapshot(restored.at(0.5)))
    assert [name for name, _ in changes] == ["changing", "stages", "changing"]
    assert (changes[0][1], changes[-1][1]) == (True, False)
    with pytest.raises(ZeroDivisionError), panes.picture.one_frame():
        1 / 0  # noqa: B018
    assert not panes.picture.changing


def test_a_still_shows_both_panes_with_their_lines():
    amplitude = np.ones((40, 60))
    amplitude[:, 30:] = -1
    panes = LinkedPanes(sw.Section(amplitude, dx=10, dz=10))
    panes.original.clip = 100.0
    panes.original.draw_lines([Stroke([(0, 200), (600, 200)], "#ff0000"), Stroke([(0, 0), (np.nan, 0)], "#00ff00")])
    picture = np.asarray(Image.open(BytesIO(base64.b64decode(panes.still()))))
    rows, columns = TOP + SIZE[1] // 4, [LEFT + SIZE[0] // 4, LEFT + 3 * SIZE[0] // 4]
    for offset in (0, picture.shape[1] // 2):
        np.testing.assert_array_equal(picture[rows, np.add(columns, offset)], [[255] * 3, [0] * 3])
    red = (picture == (255, 0, 0)).all(axis=2)
    assert set(np.flatnonzero(red.any(axis=1))) <= set(range(TOP + SIZE[1] // 2 - 5, TOP + SIZE[1] // 2 + 12))
    assert red[:, : picture.shape[1] // 2].any(axis=0).sum() > 0.9 * SIZE[0]
    assert not red[:, picture.shape[1] // 2 :].any()


def test_the_right_side_of_a_still_says_whether_it_is_restored(monkeypatch):
    case, titles = sw.synthetic.planar_fault(), []
    panes = LinkedPanes(case.section)
    monkeypatch.setattr(linked_panes, "still", lambda sides: titles.append([title for title, _ in sides]))
    panes.still()
    panes.restoration = sw.Restoration(case.section, spacing=400).flatten(sw.Horizon([(100, 500), (3900, 500)]))
    panes.still()
    assert titles == [["Present day", "Not restored yet"], ["Present day", "Restored"]]


def test_lines_of_rock_that_is_stripped_later_are_shown_until_then():
    case = sw.synthetic.half_graben(dx=25, dz=10)
    top, faults = case.interpretation.horizon("H2"), case.interpretation.faults
    start = sw.Restoration(case.section, 150.0).flatten(case.interpretation.horizon("H4"))
    restored = start.strip(top, faults=faults).flatten(top)
    panes = sw.LinkedPanes(restored)
    above = case.interpretation.horizon("H1").pieces[0]
    assert np.isnan(panes.line_projection().to_pane(above)).all()
    for time, stage in ((0, 1), (0.5, 1), (1, 1), (1.5, None), (2, None)):
        panes.show_moment(Snapshot(restored.at(time)))
        assert panes.restored.layer.stage == stage
        assert np.isfinite(panes.line_projection().to_pane(above)).all() == (stage == 1)
    assert panes.show_moment(Snapshot(restored.at(0)))
    assert not panes.show_moment(Snapshot(restored.at(0.3)))
    assert panes.show_moment(None)
    panes.close()
