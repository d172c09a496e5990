"""Handouts as files: what is in them, and what is refused."""

import json
import re
from base64 import b64decode
from zlib import decompress

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.colour import clip_limit
from seiswidgets.interaction.overlay import stroke_points
from tests.io.restored import NAUGHTY, restored


def written(path, *arguments, **keywords):
    """A handout's text, and the data in it, with bytes in place of their positions."""
    sw.save_html(*arguments[:1], path, *arguments[1:], **keywords)
    text = path.read_text("utf-8")
    state, data = (re.search(rf'id="{name}">([^<]*)</script>', text)[1] for name in ("state", "data"))
    block = decompress(b64decode(data))

    def filled(value):
        if set(value) != {"bytes"}:
            return value
        start, length = value["bytes"]
        return block[start : start + length]

    return text, json.loads(state, object_hook=filled)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "handout.html"


def test_the_texture_is_within_half_a_grey_level_and_the_meshes_are_those_of_the_stages(path):
    _, state = written(path, restored())
    section = restored().original
    limit = clip_limit(section, 99.0)
    texture = np.frombuffer(state["texture"]["data"], "<i2").reshape(state["texture"]["shape"])
    levels = texture * state["colours"]["factor"]
    assert np.abs(levels - 127 * section.amplitude / limit).max() < 0.5
    for sent, stage in zip(state["stages"], restored().stages, strict=True):
        after = np.frombuffer(sent["after"], "<f4").reshape(-1, 2) * (section.dx, section.dz)
        np.testing.assert_allclose(after + (section.x0, section.z0), section.from_rock(stage.vertices), atol=0.01)


def test_its_frame_holds_the_rock_of_every_stage(path):
    _, state = written(path, restored())
    x_min, x_max, z_min, z_max = state["frame"]
    for stage in restored().stages:
        assert (stage.vertices >= (x_min, z_min)).all()
        assert (stage.vertices <= (x_max, z_max)).all()


def test_the_picks_are_those_of_the_stages_unless_others_are_given(path):
    case = sw.synthetic.faulted_fold()
    start = sw.Restoration(case.section, spacing=150)
    unfaulted = start.unfault(case.interpretation.faults, case.interpretation.horizons, fixed=case.fixed)
    _, own = written(path, unfaulted)
    strokes = own["strokes"][0]
    assert {stroke["label"] for stroke in strokes} == {"F1", "H1", "H2", "H3", ""}
    np.testing.assert_allclose(stroke_points(strokes[-1]), case.interpretation.faults[0].points, atol=0.3)
    horizon = stroke_points(own["strokes"][1][0])
    origins = unfaulted.to_original(horizon[np.isfinite(horizon).all(axis=1)])
    first = case.interpretation.horizons[0].pieces[0]
    assert np.abs(origins[:, 1] - np.interp(origins[:, 0], *first.T)).max() < 1.0
    few = sw.Interpretation(case.interpretation.faults)
    _, given = written(path, unfaulted, few, colours={("fault", "F1"): "#123456"})
    assert [stroke["colour"] for stroke in given["strokes"][0]] == ["#123456"]


def test_names_and_titles_are_text(path):
    text, state = written(path, restored(True), title="<b>Mine</b> & yours")
    assert "<title>&lt;b&gt;Mine&lt;/b&gt; &amp; yours</title>" in text
    assert NAUGHTY not in text
    assert NAUGHTY in {stroke["label"] for stroke in state["strokes"][0]}
    assert "Data: &lt;b&gt;us&lt;/b&gt;" in text
    assert state["height"] == "two-way time"


def test_it_refers_to_nothing_outside_and_says_what_made_it(path):
    text, _ = written(path, restored())
    assert not re.search(r"<link|<img|<script[^>]* src|url\(", text)
    assert f"seiswidgets {sw.__version__}" in text
    assert text.count("<h2>Stage") == 2


def test_without_stages_it_shows_the_section(path):
    text, state = written(path, sw.Restoration(restored().original))
    assert "Nothing has been restored yet." in text
    assert (state["stages"], state["strokes"]) == ([], [[]])


def test_a_large_section_is_averaged(path):
    amplitude = np.random.default_rng(0).normal(size=(3000, 1500)).astype(np.float32)
    _, state = written(path, sw.Restoration(sw.Section(amplitude, 25.0, 5.0)))
    assert np.prod(state["texture"]["shape"]) <= 2e6
    assert state["grid"]["shape"] == [3000, 1500]


@pytest.mark.parametrize(
    ("name", "keywords", "error", "match"),
    [
        ("missing/handout.html", {}, sw.DataError, "cannot be written"),
        ("handout.pdf", {}, sw.SettingError, "must end in .html or .htm"),
        ("handout.html", {"clip": 0.0}, sw.SettingError, "clip must be a percentile"),
        ("handout.html", {"span": 1.0}, sw.SettingError, "span must be above 1"),
        ("handout.html", {"cmap": "no such"}, sw.SettingError, "colours must be"),
        ("handout.html", {"interpretation": 3}, sw.SettingError, "interpretation must be an Interpretation"),
        ("handout.html", {"titel": "?"}, TypeError, "title"),
    ],
)
def test_what_cannot_be_written_is_refused_and_nothing_is_left(tmp_path, name, keywords, error, match):
    with pytest.raises(error, match=match):
        sw.save_html(restored(), tmp_path / name, **keywords)
    assert list(tmp_path.iterdir()) == []


def test_the_handout_of_a_real_section_is_small(path):
    section = sw.datasets.f3()
    sw.save_html(sw.Restoration(section), path)
    assert path.stat().st_size < 1.5e6
