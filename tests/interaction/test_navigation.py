import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.messages import PointerMessage
from seiswidgets.interaction.navigation import KEYS, Navigation
from seiswidgets.interaction.viewport import Viewport

VIEW = Viewport(sw.Section(np.zeros((200, 300)), dx=10, dz=5)).zoomed(3)


def moved(*happenings, view=VIEW):
    navigation = Navigation()
    for message in happenings:
        view = navigation.navigate(view, message)
    return view


def test_two_fingers_hold_on_to_what_is_under_them():
    first, second = np.array([(300, 200), (500, 300)]), np.array([(320, 180), (640, 340)])
    x, y = second.mean(axis=0)
    dx, dz = second.mean(axis=0) - first.mean(axis=0)
    view = moved(PointerMessage("pinch", x, y, factor=1.6, dx=dx, dz=dz))
    assert view.to_section(second) == pytest.approx(VIEW.to_section(first))


def test_pinches_that_are_merged_do_the_same():
    one = PointerMessage("pinch", 310, 205, factor=1.3, dx=10, dz=5)
    two = PointerMessage("pinch", 305, 225, factor=0.9, dx=-5, dz=20)
    merged = PointerMessage("pinch", 305, 225, factor=1.3 * 0.9, dx=5, dz=25)
    assert moved(one, two).window == pytest.approx(moved(merged).window)


def test_a_drag_that_was_taken_away_goes_no_further():
    press, drag = PointerMessage("press", 300, 200), PointerMessage("drag", 310, 220)
    there = moved(press, drag)
    assert there.window == pytest.approx(VIEW.panned(10, 20).window)
    away = PointerMessage("release", 0, 0, cancelled=True)
    assert moved(press, drag, away, PointerMessage("drag", 50, 50)) == there


def test_a_drag_without_a_press_does_nothing():
    assert moved(PointerMessage("drag", 310, 220), PointerMessage("release", 0, 0)) == VIEW


@pytest.mark.parametrize("key", KEYS)
def test_each_key_does_something(key):
    assert moved(PointerMessage("key", key=key)) != VIEW


def test_other_keys_do_nothing():
    assert moved(*(PointerMessage("key", key=key) for key in ("Enter", " ", "a", "Escape"))) == VIEW
