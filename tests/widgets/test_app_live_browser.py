"""The app in JupyterLab while it restores: what follows the mouse, what is newest, and what a new page shows."""

import re
from itertools import pairwise

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.widgets.appscreen import FEW, RESTORED
from tests.widgets.browser import awaited
from tests.widgets.test_histogram_browser import bar

PLACES = "[(500.0, 400.0), (1500.0, 900.0), (2600.0, 1600.0), (3500.0, 700.0)]"
NOTING = """
from seiswidgets.geology.plan import RestorationJob
asked, shown, restored, show = {}, [], RestorationJob.restored, app.panes.show
def note(task, *arguments):
    result = restored(task, *arguments)
    asked[id(result)] = result, task.plan.weights.mean_value
    return result
def show_noted(frame, **choices):
    shown.append(asked[id(frame.restoration)][1])
    show(frame, **choices)
RestorationJob.restored, app.panes.show = note, show_noted
"""
NAME = "<img src=x onerror=alert(1)>"


def linked_cross(screen, number):
    """Position of the other pane's cursor in a pane, in CSS pixels of its plot area."""
    lines = screen.plots.nth(number).locator(".linked line.cross")
    x = lines.nth(0).get_attribute("x1")
    return float(x), float(lines.nth(1).get_attribute("y1"))


def sent_by_a_sweep(screen):
    """Number of messages for 250 moves of the mouse in each pane."""
    frames = len(screen.opened.sent)
    for number in (0, 1):
        box = screen.plots.nth(number).bounding_box()
        screen.page.mouse.move(box["x"] + 9, box["y"] + 9)
        screen.page.mouse.move(box["x"] + box["width"] - 9, box["y"] + box["height"] - 9, steps=250)
    return len(screen.opened.sent) - frames


def test_cursors_follow_each_other_while_the_kernel_sleeps_and_moves_are_not_sent(open_app):
    screen = open_app(RESTORED)
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    screen.pictures()
    points = screen.points(PLACES), screen.points(f"app.restoration.to_restored({PLACES})")
    pages = [screen.pixels(points[number], number) for number in (0, 1)]
    assert any(sent_by_a_sweep(screen) <= 30 for _ in range(3))  # the mouse seems to rest whenever the machine does

    boxes = [screen.plots.nth(number).bounding_box() for number in (0, 1)]
    with screen.opened.kernel_at_work():
        for number in (0, 1):
            other, box = 1 - number, boxes[1 - number]
            for here, there in zip(pages[number], pages[other] - [box["x"], box["y"]], strict=True):
                screen.page.mouse.move(*here)
                screen.page.evaluate(
                    "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
                )
                assert linked_cross(screen, other) == pytest.approx(there, abs=1)


def test_a_line_drawn_in_the_restored_pane_is_where_to_original_says(open_app):
    screen = open_app(RESTORED + "app.wait(30)\napp.live = False\n")
    screen.until("len(app.restoration.stages) == 2")
    screen.button("Horizon").click()
    screen.button("next line").click()
    ends = np.array([(600.0, 600.0), (1400.0, 800.0), (3300.0, 700.0)])  # the last stretch crosses the fault
    along = np.concatenate([a + (b - a) * np.linspace(0, 1, 40)[:, None] for a, b in pairwise(ends)])
    there = screen.points(f"app.restoration.to_original({along.tolist()})")
    before = set(screen.paths())
    screen.click(*ends, number=1)
    last = f"np.allclose(editor.drawing.draft.points[-1], {there[-1].tolist()}, 0, 1)"
    screen.until(f"editor.drawing.draft and {last}")
    is_drawn_through(screen, there, before)
    screen.press("Enter")
    screen.becomes("len(app.interpretation.horizons)", 4)
    is_drawn_through(screen, there, before)


def is_drawn_through(screen, points, before):
    """Wait until the original's pane shows lines, besides those before, within a css pixel of points."""
    box = screen.plots.first.bounding_box()
    wanted = screen.pixels(points) - [box["x"], box["y"]]

    def away():
        new = [line for path in screen.paths() if path not in before for line in polylines(path)]
        return np.min([distances(wanted, line) for line in new], axis=0).max() if new else np.inf

    awaited(away, lambda pixels: pixels < 1, "less than a pixel")


def polylines(path):
    """The lines of an SVG path, each of shape (n, 2)."""
    lines = (np.array(re.findall(r"[-.\de]+", one), float).reshape(-1, 2) for one in path.split("M"))
    return [line for line in lines if len(line) > 1]


def distances(points, line):
    """Distances of points from a polyline, shape (n,)."""
    start, way = line[:-1], np.diff(line, axis=0)
    off = points[:, None] - start
    share = np.clip((off * way).sum(axis=2) / np.maximum((way**2).sum(axis=1), 1e-12), 0, 1)
    return np.hypot(*np.moveaxis(off - share[..., None] * way, 2, 0)).min(axis=1)


def test_a_reloaded_page_and_a_second_view_show_the_same(open_app):
    screen = open_app(RESTORED, "app.panes.mesh = 0.5\n", more=["app"], height=2200)
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    screen.plots.nth(3).wait_for()
    first = screen.pictures(lambda pictures: len(pictures) == 4 and pictures[:2] == pictures[2:])
    lines = [screen.lines(number) for number in range(4)]
    assert lines[:2] == lines[2:]
    screen.opened.command("docmanager:save")
    screen.opened.reload()
    screen.plots.nth(3).wait_for()
    screen.pictures(lambda pictures: pictures == first)
    assert [screen.lines(number) for number in range(4)] == lines


def test_cancel_leaves_all_as_it_was(open_app):
    screen = open_app(RESTORED, "app.wait(30)\napp.live = False\n")
    screen.until("len(app.restoration.stages) == 2")
    screen.ask("app.solving.set_trait('spacing', app.restoration.domain.spacing / 4)")
    before = screen.pictures()
    screen.ask("globals().update(whole=app.restoration)")
    screen.button("Restore").click()
    screen.page.get_by_text(re.compile("iteration [1-9]")).first.wait_for()
    screen.button("Cancel").click()
    screen.button("Cancel").wait_for(state="hidden")
    assert screen.ask("app.wait(20)")
    assert screen.ask("app.restoration is whole")
    assert screen.pictures() == before


def test_twenty_quick_moves_of_a_slider_draw_the_newest_and_nothing_older_after_it(open_app):
    screen = open_app(RESTORED, "app.wait(30)\n", NOTING)
    screen.until("len(app.restoration.stages) == 2")
    screen.tab("Weights")
    handle = screen.page.locator(".noUi-handle:visible").nth(1)  # the first is the timeline's
    handle.focus()
    screen.press(*20 * ["ArrowRight"])
    is_newest(screen, handle)
    screen.ask("shown.clear()")
    box = handle.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    screen.page.mouse.move(x, y)
    screen.page.mouse.down()
    for step in range(1, 21):
        screen.page.mouse.move(x + 3 * step, y)
    screen.page.mouse.up()
    is_newest(screen, handle)


def is_newest(screen, handle):
    """The last picture belongs to the slider's position, and no picture followed a newer one."""
    at = float(handle.get_attribute("aria-valuenow"))
    screen.nears("np.log10(app.weights.mean_value)", at, 0.051)  # the slider says it to a tenth
    screen.until("app.wait(30) and shown[-1] == app.weights.mean_value and not app.panes.shown.is_preview")
    shown = screen.ask("shown")
    assert shown == sorted(shown)
    drawn = screen.pictures()
    screen.ask("show(type(app.panes.shown).of(app.restoration))")  # once more
    assert screen.pictures() == drawn


def test_a_name_is_shown_as_text_everywhere(open_app):
    screen = open_app(FEW)
    field = screen.page.locator("input[title='name of this fault']")
    field.fill(NAME)
    field.press("Enter")
    screen.becomes(f"[fault.name == {NAME!r} for fault in app.interpretation.faults]", [True])
    for number in (0, 1):
        screen.plots.nth(number).locator(".name").get_by_text(NAME, exact=True).wait_for(state="attached")
    screen.button("Restore").click()
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    screen.tab("Report")
    screen.page.get_by_role("tabpanel").get_by_text(NAME).first.wait_for()
    screen.tab("Steps")
    screen.page.locator(f"option:text-is('{NAME}')").first.wait_for(state="attached")
    far = "sw.Fault([(100.0, 100.0), (150.0, 500.0)], app.interpretation.faults[0].name)"
    screen.ask(f"app.set_trait('interpretation', sw.Interpretation([{far}], app.interpretation.horizons))")
    screen.button("Restore").click()
    screen.page.get_by_role("status").get_by_text(NAME).first.wait_for()  # above the panes
    screen.tab("Picks")
    screen.page.get_by_role("note").get_by_text(NAME).locator("visible=true").first.wait_for()  # beside the pick
    assert screen.page.locator("img[src=x]").count() == 0
    assert screen.opened.dialogs == []


def test_play_brush_and_hover(open_app):
    screen = open_app(
        RESTORED, "app.wait(30)\ntimes = []\napp.timeline.observe(lambda c: times.append(c.new), 'time')\n"
    )
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    end = screen.pictures()
    screen.page.locator(".widget-play button").first.click()
    screen.until("len(times) > 3")
    on_the_way = screen.page.locator(".seiswidgets-layer .plot").nth(1).locator(".strokes").inner_html()
    screen.until("app.timeline.time == 2 and not app.timeline.play.playing and app.wait(30)")
    assert screen.ask("times") == sorted(screen.ask("times"))
    assert screen.pictures() == end
    assert screen.plots.nth(1).locator(".strokes").inner_html() != on_the_way

    (at,) = screen.pixels([(1500.0, 900.0)])
    screen.page.mouse.move(*at)
    mark = screen.page.locator(".chart .mark")
    ratio = screen.ask("float(app.restoration.area_ratio_at([(1500.0, 900.0)])[0])")
    number = int(np.searchsorted(screen.ask("app.histogram.bars['edges']"), ratio)) - 1
    expect(mark).to_have_attribute("data-bar", str(number))

    screen.page.mouse.move(*bar(screen.opened, 25))
    screen.page.mouse.down()
    screen.page.mouse.move(*bar(screen.opened, 40), steps=5)
    screen.page.mouse.up()
    screen.until("len(app.panes.brush) == 2 and app.panes.brush == app.histogram.brush")
    brushed = screen.pictures(lambda pictures: pictures[0] != end[0] and pictures[1] != end[1])
    assert brushed != end
    at = screen.points(PLACED)
    ratio = screen.points(f"app.restoration.area_ratio_at({PLACED})")
    low, high = screen.ask("app.panes.brush")
    inside, outside = (at[(ratio > one) & (ratio < two)][::25] for one, two in ((low, high), (0.9, 0.999)))
    assert max(colourful(screen, inside)) > 25
    assert np.mean(colourful(screen, outside)) < 0.2 * np.mean(colourful(screen, inside))


PLACED = "np.random.default_rng(0).uniform((100, 100), (3900, 1900), (4000, 2))"
COLOURFUL = """(places) => {
  const canvas = document.querySelector("canvas.seiswidgets-plot");
  return places.map(([x, y]) => {
    const [red, green, blue] = canvas.getContext("2d").getImageData(x, y, 1, 1).data;
    return Math.max(red, green, blue) - Math.min(red, green, blue);
  });
}"""


def colourful(screen, points):
    """Colourfulness of the original's pane at some points."""
    box = screen.plots.first.bounding_box()
    return screen.page.evaluate(COLOURFUL, (screen.pixels(points) - [box["x"], box["y"]]).tolist())
