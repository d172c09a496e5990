"""The app in JupyterLab, by real mouse and keys: what is drawn, restored, and seen."""

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.widgets.appscreen import DRAFT, FEW, PICKS

STEPS = "[stage.kind for stage in app.restoration.stages]"
BEDS = "[np.concatenate([piece[5:-5] for piece in bed.pieces]) for bed in drawn.horizons]"  # clear of the fault
FOCUS = "() => document.activeElement.className.baseVal ?? document.activeElement.textContent"


def is_restored(screen):
    """Wait until both steps are done; the bed that was drawn is level, and those that were not are nearly so."""
    screen.until(f"{STEPS} == ['unfault', 'flatten']")
    screen.until("app.wait(30)")
    (bed,) = screen.ask("[bed.flatness for bed in app.restoration.stages[-1].report.beds]")
    assert bed < 1
    before, after = (
        screen.points(f"[np.ptp({carried}[:, 1]) for bed in {BEDS}]")
        for carried in ("bed", "app.restoration.to_restored(bed)")
    )
    assert (after < 0.3 * before).all()


def test_from_an_empty_app_to_a_restored_section_by_mouse_alone(open_app):
    screen = open_app()
    assert "Draw a fault" in screen.ask("app.status.text")
    original, restored = screen.pictures()
    assert original == restored
    screen.button("Live").click()
    screen.button("Fault").click()
    screen.draw(*screen.points("drawn.faults[0].points[::5]"))
    screen.becomes("len(app.interpretation.faults)", 1)
    screen.page.get_by_text("Now choose Horizon").wait_for()
    screen.button("Horizon").click()
    for side in (0, 1):
        screen.draw(*screen.points(f"drawn.horizons[0].pieces[{side}][np.r_[0:70:8, -1]]"))
        screen.becomes("[len(horizon.pieces) for horizon in app.interpretation.horizons]", [side + 1])
    assert screen.ask(STEPS) == []
    screen.button("Restore").click()
    is_restored(screen)
    assert screen.pictures()[1][3] != restored[3]
    expect(screen.page.locator(".labels .name")).to_have_text(2 * ["F1", "H1"])


def by_tab(screen, what, key="Tab"):
    """Press Tab until something has the focus."""
    for _ in range(60):
        screen.press(key)
        if what in screen.page.evaluate(FOCUS):
            return
    pytest.fail(f"{key} does not lead to {what!r}")


def steer(screen, target):
    """Bring the keyboard's cursor to a point, to the nearest trace and sample."""
    cursor = np.array(screen.ask("editor.state.cursor"))
    cell = np.array(screen.ask("[case.section.dx, case.section.dz]"))
    strides = screen.ask(
        "np.maximum(1, np.ceil(8 * panes[0].view.pixel / [case.section.dx, case.section.dz])).tolist()"
    )
    for axis, names in enumerate((("Left", "Right"), ("Up", "Down"))):
        cells = round((target[axis] - cursor[axis]) / cell[axis])
        key, left = f"Arrow{names[cells > 0]}", abs(cells)
        for modifier, stride in (("Shift+", 10 * strides[axis]), ("", strides[axis]), ("Control+", 1)):
            count, left = divmod(left, stride)
            screen.press(*[modifier + key] * int(count))
    screen.nears("editor.state.cursor", target, (cell / 2 + 1e-6).max())


def by_keys(screen, *points):
    """A line of the mode's kind: Enter shows the cursor, Space puts a vertex, Enter on the last one finishes."""
    for point in points:
        steer(screen, point)
        screen.press("Space")
    screen.press("Enter")


def test_from_an_empty_app_to_a_restored_section_by_keyboard_alone(open_app):
    screen = open_app()
    before = screen.pictures()[1]
    by_tab(screen, "plot")
    screen.press("f", "Enter")
    screen.until("editor.state.cursor")
    by_keys(screen, *screen.points("drawn.faults[0].points[::10]"))
    screen.becomes("len(app.interpretation.faults)", 1)
    screen.press("h", "Enter")
    for side in (0, 1):
        by_keys(screen, *screen.points(f"drawn.horizons[0].pieces[{side}][np.r_[0:70:17, -1]]"))
        screen.becomes("[len(horizon.pieces) for horizon in app.interpretation.horizons]", [side + 1])
    is_restored(screen)
    screen.press("Escape", "Escape", "Escape")
    screen.until("app.picker.mode == 'look'")
    first = screen.pictures(lambda pictures: pictures[1] != before)
    screen.ask("globals().update(first=app.restoration)")
    by_tab(screen, "Restore", "Shift+Tab")
    screen.press("Enter")
    screen.until("app.restoration is not first")
    assert screen.pictures() == first


def undone(screen, before):
    """An edit has been made; undo takes it back, redo makes it again."""
    screen.until(f"{PICKS} != {before}")
    after = screen.ask(PICKS)
    screen.press("Control+z")
    screen.becomes(PICKS, before)
    screen.press("Control+y")
    screen.becomes(PICKS, after)
    screen.press("Control+Shift+Z")  # there is nothing more to do again
    screen.press("Control+z")
    screen.becomes(PICKS, before)


def test_vertices_are_added_dragged_inserted_removed_and_nudged(open_app):
    screen = open_app(FEW)
    before, pixel = screen.ask(PICKS), screen.points("panes[0].view.pixel")
    (_, (fault,)), (_, (line, _)) = before
    line = np.array(line)

    screen.button("Fault").click()
    place = [(500, 300), (700, 900), (900, 1400)]
    for count, point in enumerate(place, 1):
        screen.click(point)
        screen.becomes(f"len({DRAFT})", count)
    np.testing.assert_allclose(screen.points(DRAFT), place, atol=1.01 * pixel.max())
    screen.press("Control+z", "Control+z")
    screen.becomes(f"len({DRAFT})", 1)
    screen.press("Control+Shift+Z", "Control+y")
    screen.becomes(f"len({DRAFT})", 3)
    screen.press("Escape")
    screen.becomes(f"len({DRAFT})", 0)
    screen.press("Control+z")
    screen.becomes(f"len({DRAFT})", 3)
    screen.press("Enter")
    vertices = "[len(pick.pieces[0]) for pick in editor.drawing.picks if pick.name == 'F2']"
    screen.becomes(vertices, [3])
    screen.press("Control+z")  # the last vertex; the line stays finished
    screen.becomes(vertices, [2])
    screen.press("Control+y")
    screen.becomes(vertices, [3])
    screen.press("Control+z", "Control+z")
    screen.becomes(PICKS, before)

    screen.drag(fault[1], fault[1] + np.array([150, 0]))
    screen.nears("editor.drawing.picks[0].pieces[0][1]", fault[1] + np.array([150, 0]), pixel.max())
    undone(screen, before)

    screen.button("Horizon").click()
    screen.drag(line[2], line[2] + [0, 200], drop=False)
    screen.until(f"{PICKS} != {before}")
    screen.press("Escape")
    screen.becomes(PICKS, before)
    screen.page.mouse.up()
    screen.becomes(PICKS, before)

    middle = line[1:3].mean(axis=0)
    screen.click(middle)
    screen.nears("editor.drawing.picks[1].pieces[0][2]", middle, pixel.max())
    undone(screen, before)
    for remove in (("Control",), ()):
        screen.click(line[2], modifiers=remove)
        if not remove:
            screen.press("Delete")
        screen.nears("editor.drawing.picks[1].pieces[0]", np.delete(line, 2, axis=0))
        undone(screen, before)
    screen.click(line[1])
    screen.press("Insert")
    screen.nears("editor.drawing.picks[1].pieces[0][2]", middle)
    undone(screen, before)
    screen.click(line[1])
    screen.press("PageDown", "ArrowDown", "Shift+ArrowRight")
    screen.nears("editor.drawing.picks[1].pieces[0][2]", line[2] + [125, 5])
    screen.press("Control+z", "Control+z")
    screen.becomes(PICKS, before)


def test_cut_offs_snapping_following_and_holding(open_app):
    screen = open_app(FEW)
    before, pixel = screen.ask(PICKS), screen.points("panes[0].view.pixel").max()
    fault = screen.points("editor.drawing.picks[0].pieces[0]")
    marks = screen.points("[mark.inside for mark in editor.cutoffs()]")
    assert len(marks) == 2
    expect(screen.plots.first.locator(".cutoff")).to_have_count(2)
    screen.page.mouse.move(*screen.pixels(marks[:1])[0])
    expect(screen.plots.first.locator(".grown .number")).to_have_text("1")
    screen.button("Horizon").click()
    aim = fault[1:3].mean(axis=0)
    screen.drag(marks[0], aim + [60, 0])
    end = "editor.drawing.picks[1].pieces[0][-1]"
    screen.until(f"{end} != {before[1][1][0][-1]}")
    screen.until("not app.picker.dragging")
    along, off = np.diff(fault[1:3], axis=0)[0], screen.points(end) - fault[1]
    share = along @ off / (along @ along)
    assert np.hypot(*(off - share * along)) < 0.01  # it has stayed on the fault
    assert share == pytest.approx(
        along @ (aim + [60, 0] - fault[1]) / (along @ along), abs=2 * pixel / np.hypot(*along)
    )
    undone(screen, before)

    screen.page.locator(".widget-dropdown select").first.select_option(label="snap to peak")
    screen.button("next line").click()
    bed = screen.points("drawn.horizons[1].pieces[0][[20, 40, 60]]")
    screen.click(bed[0] + [0, 20])
    screen.becomes(f"len({DRAFT})", 1)
    ((x, z),) = screen.points(DRAFT)
    depth = "np.interp({}, *drawn.horizons[1].pieces[0].T)"
    assert z == pytest.approx(screen.ask(f"float({depth.format(x)})"), abs=2)  # metres; the click was 20 m off
    screen.button("Follow").click()
    screen.click(bed[2] + [0, 15])
    screen.until(f"len({DRAFT}) > 2")
    way = screen.points("drawn.horizons[1].pieces[0][20:61]")
    assert abs(np.interp(way[:, 0], *screen.points(DRAFT).T) - way[:, 1]).max() < 5  # metres, a sample
    assert abs(np.interp(way[:, 0], *way[[0, -1]].T) - way[:, 1]).max() > 20
    screen.press("Control+z")
    screen.becomes(f"len({DRAFT})", 1)
    screen.press("Escape", "Escape")

    screen.button("Hold").click()
    (at,) = screen.click((3000, 700))
    screen.nears("app.fixed or []", (3000, 700), pixel)
    expect(screen.plots.first.locator(".held .pin")).to_have_count(1)
    screen.press("Control+z")
    screen.until("app.fixed is None")
    screen.press("Control+y")
    screen.until("app.fixed")
    screen.page.mouse.click(*at)
    screen.until("app.fixed is None")


def test_zoom_and_pan_while_a_line_is_under_way(open_app):
    screen = open_app(FEW)
    screen.button("Horizon").click()
    screen.button("next line").click()
    screen.click((400, 300), (800, 350))
    screen.becomes(f"len({DRAFT})", 2)
    line = screen.ask(DRAFT)

    def moved(by, *arguments):
        """Do something that must change the view, and nothing else."""
        window = screen.ask("panes[0].view.window")
        by(*arguments)
        screen.until(f"panes[0].view.window != tuple({window})")
        screen.becomes(DRAFT, line)

    mouse, (x, y) = screen.page.mouse, screen.pixels([(900, 400)])[0]
    mouse.move(x, y)
    moved(mouse.wheel, 0, -300)

    def drag(button):
        mouse.move(x, y)
        mouse.down(button=button)
        mouse.move(x + 50, y + 30, steps=4)
        mouse.up(button=button)

    moved(drag, "middle")
    screen.page.keyboard.down("Space")
    moved(drag, "left")
    screen.page.keyboard.up("Space")
    moved(screen.press, "+")
    screen.until("app.wait(9)")
    (start,) = screen.pixels(line[-1:])
    mouse.move(x, y)
    box = screen.plots.first.bounding_box()
    screen.page.wait_for_function(BAND, arg=[*(start - [box["x"], box["y"]]), x - box["x"], y - box["y"]])
    point = screen.points(f"panes[0].view.to_section([{x - box['x']}, {y - box['y']}])")
    mouse.dblclick(x, y)
    screen.nears("app.interpretation.horizons[-1].pieces[0]", [*line, point], 0.01)
    screen.press("0")
    screen.until("panes[0].view.is_fitted")


BAND = """(ends) => {
  const path = document.querySelector(".seiswidgets-layer .band .rubber")?.getAttribute("d") ?? "";
  const now = path.match(/[-.\\d]+/g)?.map(Number) ?? [];
  return now.length === 4 && now.every((value, i) => Math.abs(value - ends[i]) < 0.6);
}"""


def test_what_is_drawn_while_a_cell_runs_comes_in_order(open_app):
    screen = open_app(FEW)
    fault = screen.points("drawn.faults[0].points[[0, 10, 20, 30]]") - [900, 0]
    *others, last = screen.pixels(fault)
    screen.click((300, 900))  # so that the pane has been written to by a handler
    with screen.opened.kernel_at_work():
        screen.button("Fault").click()
        for x, y in others:
            screen.page.mouse.click(x, y)
        screen.page.mouse.dblclick(*last)
    screen.becomes("len(app.interpretation.faults)", 2)
    screen.nears("app.interpretation.faults[1].points", fault, screen.points("panes[0].view.pixel").max())
