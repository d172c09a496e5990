import pytest

import seiswidgets as sw
from seiswidgets.widgets.timeline import FRAMES


@pytest.fixture
def timeline():
    return sw.Timeline(["unfault", "flatten"])


@pytest.fixture
def told(timeline):
    """The times of all notifications."""
    heard = []
    timeline.observe(lambda change: heard.append(change.new), "time")
    return heard


def controls(timeline):
    return timeline.play, timeline.slider


def test_with_nothing_restored_it_is_disabled():
    timeline = sw.Timeline()
    assert all(control.disabled for control in controls(timeline))
    assert timeline.time == 0
    assert timeline.moment == "nothing restored"
    assert timeline.slider.min < timeline.slider.max  # or the browser could not draw it


@pytest.mark.parametrize("count", [1, 2, 5])
def test_it_begins_at_the_end(count):
    timeline = sw.Timeline(["unfault"] * count)
    assert timeline.time == count
    assert timeline.moment == "restored"
    for control in controls(timeline):
        assert (control.value, control.max, control.disabled) == (FRAMES * count, FRAMES * count, False)


@pytest.mark.parametrize(
    ("time", "moment"),
    [(0, "present day"), (0.4, "unfault 40%"), (1, "unfault 100%"), (1.05, "flatten 5%"), (2, "restored")],
)
def test_the_moment_in_words(timeline, time, moment):
    timeline.time = time
    assert timeline.moment == moment
    assert timeline.text.value == moment


def test_time_follows_the_slider(timeline, told):
    timeline.slider.value = FRAMES // 4
    timeline.slider.value = 2 * FRAMES
    assert told == [0.25, 2.0]
    assert timeline.play.value == 2 * FRAMES  # so that Play goes on from here


def test_the_slider_follows_time_which_is_kept_as_it_was_set(timeline, told):
    timeline.time = 0.3301
    assert told == [0.3301]
    assert [control.value for control in controls(timeline)] == [FRAMES // 3] * 2


@pytest.mark.parametrize(
    ("labels", "before"),
    [(["flatten"], 2.0), (["a", "b", "c"], 0.5), (["unfault", "unfault"], 2.0), ([], 0.0), ([], 2.0)],
)
def test_other_labels_jump_to_the_end_with_one_change_at_most(timeline, told, labels, before):
    timeline.time = before
    told.clear()
    timeline.labels = labels
    assert timeline.time == len(labels)
    assert told == [len(labels)] * (before != len(labels))
    assert [control.value for control in controls(timeline)] == [FRAMES * len(labels)] * 2
    assert [control.max for control in controls(timeline)] == [FRAMES * max(1, len(labels))] * 2
    assert timeline.moment == ("restored" if labels else "nothing restored")


@pytest.mark.parametrize("time", [-0.1, 2.1, float("nan")])
def test_a_time_out_of_range_is_refused(timeline, time):
    with pytest.raises(sw.SettingError, match="time must be from 0 to 2"):
        timeline.time = time
    assert timeline.time == 2
