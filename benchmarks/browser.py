"""The app in a browser: how soon it is painted, how long a drag waits for its picture, what zooming sends.

JupyterLab and Chromium run on this machine; there is no network in between, but once a slow one is imitated.
"""

import copy
import re
import shutil
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from slow_link import slow_link
from timing import at_most, told

WIDE, HIGH = 2080, 1300  # css pixels of the window: each pane's plot area is then about 900 by 600
FIRST, MEDIAN, P95, CANCEL = 1.5, 0.06, 0.09, 0.3  # seconds
DRAG_RATE, PLAY_RATE = 12, 30  # pictures a second
SLOW_MEDIAN, SLOW_RATE = 0.25, 8  # the same on a slow link
MEMORY, STEP = 400, 2048  # megabytes that a large section adds, bytes that a step of the wheel sends
DRAGS, RUNS, STEPS = 60, 5, 20
PAUSE = 100  # ms between two steps

APP = """
import seiswidgets as sw
case = sw.synthetic.{case}()
app = sw.RestorationApp(case.section, case.interpretation, fixed=case.fixed, height=652)
app.picker.mode = "horizon"
app
"""
LARGE = """
import re, numpy as np, seiswidgets as sw
from pathlib import Path
import seiswidgets.widgets.app
def peak():
    return int(re.search(r"VmHWM:\\s+(\\d+)", Path("/proc/self/status").read_text())[1]) / 1024
before = peak()
rows, columns = np.mgrid[:2000, :3000]
section = sw.Section(np.sin(rows / 9 + columns / 300).astype(np.float32), dx=10, dz=5)
del rows, columns
app = sw.RestorationApp(section, height=652)
app
"""
WATCH = """() => {
  const isWatched = window.pictures !== undefined;
  window.painted = [0, 0];
  window.pictures = [[], []];
  if (isWatched) return;
  const draw = CanvasRenderingContext2D.prototype.putImageData;
  const plots = () => [...document.querySelectorAll("canvas.seiswidgets-plot")];
  CanvasRenderingContext2D.prototype.putImageData = function (...given) {
    const number = plots().indexOf(this.canvas);
    if (number >= 0) requestAnimationFrame(() => {
      window.painted[number] = performance.now();
      window.pictures[number].push(performance.now());
    });
    return draw.apply(this, given);
  };
  window.addEventListener("pointermove", () => { window.moved = performance.now(); }, { capture: true });
}"""
NEXT = """async () => {
  while (window.painted[1] <= window.moved) await new Promise((done) => requestAnimationFrame(done));
  return window.painted[1] - window.moved;
}"""
PAINTED = """() => {
  const plot = document.querySelector("canvas.seiswidgets-plot");
  if (!plot) return false;
  const middle = plot.getContext("2d").getImageData(plot.width / 2, plot.height / 2, 1, 1);
  return middle.data[3] > 0 && performance.now() - (window.begun ?? 0);
}"""
CANCELLED = """() => {
  const cancel = [...document.querySelectorAll("button")].find((one) => one.textContent.includes("Cancel"));
  window.took = null;
  cancel.addEventListener("click", () => {
    const start = performance.now();
    const look = () => {
      if (cancel.offsetParent === null) window.took = performance.now() - start;
      else requestAnimationFrame(look);
    };
    look();
  });
}"""
RUN = """(code) => {
  window.begun = performance.now();
  window.jupyterapp.shell.currentWidget.content.widgets[0].model.sharedModel.setSource(code);
  window.jupyterapp.commands.execute("notebook:run-all-cells");
}"""
LISTEN = """() => {
  window.received = 0;
  window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.anyMessage.connect((_, { msg, direction }) => {
    if (direction !== "recv" || !msg.header.msg_type.startsWith("comm")) return;
    const buffers = (msg.buffers ?? []).reduce((sum, buffer) => sum + buffer.byteLength, 0);
    window.received += JSON.stringify(msg.content).length + buffers;
  });
}"""


def rows():
    with browser() as open_notebook:
        yield from first_paint(open_notebook)
        for case in ("faulted_fold", "planar_fault"):
            yield from drags(open_notebook, case)
        yield from continuous_drag(open_notebook)
        yield from playing(open_notebook)
        yield from far_away(open_notebook)
        yield from cancelling(open_notebook)
        yield from wheel(open_notebook)
        yield from memory(open_notebook)


@contextmanager
def browser():
    """A function that opens a notebook with some cells in a JupyterLab of its own."""
    from playwright.sync_api import sync_playwright

    from tests.widgets.browser import FLAGS, Notebook, Server

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        server = Server(Path(folder))
        try:
            server.wait()

            def open_notebook(*cells):
                through = copy.copy(server)
                through.port = link.port
                opened = Notebook(through, chromium)
                opened.open(server.write(cells), width=WIDE, height=HIGH)
                opened.slow_down = link.slow_down
                return opened

            with slow_link(server.port) as link:
                yield open_notebook
        finally:
            chromium.close()
            server.end()


def first_paint(open_notebook):
    seconds = []
    for _ in range(RUNS):
        opened = open_notebook("1")
        opened.page.evaluate(RUN, APP.format(case="faulted_fold"))
        seconds.append(opened.page.wait_for_function(PAINTED, polling=20).json_value() / 1000)
        opened.close()
    yield in_time(
        "the app: from running its cell, imports included, to its first paint", np.median(seconds), FIRST, RUNS
    )


def drags(open_notebook, case):
    """A vertex of a horizon is dragged step by step, each when the last one's picture is there."""
    opened = settled(open_notebook(APP.format(case=case)))
    what = picture_of(opened, case)
    waits = dragged(opened)
    opened.close()
    yield in_time(f"{what}, median", np.median(waits), MEDIAN, DRAGS)
    yield in_time("  the same, 95th percentile", np.percentile(waits, 95), P95, DRAGS)


def picture_of(opened, case):
    vertices = opened.ask("[len(stage.vertices) for stage in app.restoration.stages]")
    wide, high = opened.ask("app.panes.restored.view.size.tolist()")
    return f"{case.replace('_', ' ')} of {max(vertices):,} vertices at {wide:.0f} x {high:.0f}: from drag to picture"


def dragged(opened):
    """Seconds from each step of a drag to its picture."""
    x, y = vertex(opened)
    opened.page.evaluate(WATCH)
    opened.page.mouse.move(x, y)
    opened.page.mouse.down()
    waits = []
    for step in range(DRAGS):
        opened.page.mouse.move(x, y + 8 + 10 * np.sin(step / 3))
        waits.append(opened.page.evaluate(NEXT) / 1000)
        opened.page.wait_for_timeout(PAUSE)
    opened.page.mouse.up()
    return waits


def continuous_drag(open_notebook):
    """A vertex of a horizon is dragged to and fro, without waiting for pictures."""
    opened = settled(open_notebook(APP.format(case="faulted_fold")))
    rate = rate_of_drag(opened)
    opened.close()
    yield fast_enough("a continuous drag: restored pictures a second", rate, DRAG_RATE)


def rate_of_drag(opened):
    x, y = vertex(opened)
    opened.page.evaluate(WATCH)
    opened.page.mouse.move(x, y)
    opened.page.mouse.down()
    for step in range(5 * DRAGS):
        opened.page.mouse.move(x, y + 8 + 10 * np.sin(step / 10))
        opened.page.wait_for_timeout(16)
    rate = pictures_a_second(opened)
    opened.page.mouse.up()
    return rate


def far_away(open_notebook):
    """The same drags over a link of 100 ms round trip and 5 Mbit/s."""
    opened = settled(open_notebook(APP.format(case="faulted_fold")))
    opened.slow_down()
    waits = dragged(opened)
    what = "over a link of 100 ms and 5 Mbit/s: from drag to picture, median"
    yield in_time(what, np.median(waits), SLOW_MEDIAN, DRAGS)
    opened.ask("app.wait(60)")
    opened.page.wait_for_timeout(1500)
    rate = rate_of_drag(opened)
    opened.close()
    yield fast_enough("  a continuous drag: restored pictures a second", rate, SLOW_RATE)


def playing(open_notebook):
    """Play runs once from the present day to the end while the kernel is busy with a cell."""
    opened = settled(open_notebook(APP.format(case="faulted_fold")))
    opened.page.evaluate(WATCH)
    with opened.kernel_at_work():
        opened.page.locator(".widget-play button").first.click()
        opened.page.wait_for_function("window.pictures[1].length > 1 && performance.now() - window.painted[1] > 1000")
        rate = pictures_a_second(opened)
    opened.close()
    yield fast_enough("Play with the kernel asleep: restored pictures a second", rate, PLAY_RATE)


def pictures_a_second(opened):
    times = opened.page.evaluate("window.pictures[1]")
    return 1000 * (len(times) - 1) / (times[-1] - times[0])


def cancelling(open_notebook):
    """A restoration on a fine mesh is given up as soon as it tells of an iteration."""
    opened, seconds = settled(open_notebook(APP.format(case="faulted_fold"))), []
    opened.ask("[setattr(app, 'live', False), setattr(app.solving, 'spacing', app.solving.slider.value / 4)]")
    for _ in range(RUNS):
        opened.page.locator("button:has-text('Restore')").click()
        opened.page.get_by_text(re.compile("iteration [1-9]")).first.wait_for()
        opened.page.evaluate(CANCELLED)
        opened.page.locator("button:has-text('Cancel')").click()
        opened.page.wait_for_function("window.took !== null")
        seconds.append(opened.page.evaluate("window.took") / 1000)
        opened.ask("app.wait(60)")
    opened.close()
    yield in_time("from a click on Cancel until the screen shows it", np.median(seconds), CANCEL, RUNS)


def wheel(open_notebook):
    opened = settled(open_notebook(APP.format(case="faulted_fold")))
    opened.page.mouse.move(*vertex(opened))
    opened.page.wait_for_timeout(1000)
    opened.page.evaluate(LISTEN)
    for step in range(STEPS):
        opened.page.mouse.wheel(0, -100 if step < STEPS // 2 else 100)
        opened.page.wait_for_timeout(PAUSE)
    sent = opened.page.evaluate("window.received") / STEPS
    opened.close()
    yield at_most(
        "a step of the wheel: contents of messages to the page", f"{sent:.0f} B", f"{STEP} B", sent / STEP, 1, STEPS
    )


def memory(open_notebook):
    opened = settled(open_notebook(LARGE))
    added = opened.ask("peak() - before")
    opened.close()
    what = "a section of 3,000 x 2,000 and its app: added to the kernel's peak"
    yield at_most(what, f"{added:.0f} MB", f"{MEMORY} MB", added / MEMORY, 1, 1)


def settled(opened):
    """The notebook, when its app is painted and the kernel at rest."""
    opened.page.wait_for_function(PAINTED)
    opened.ask("app.wait(60)")
    opened.page.wait_for_timeout(1500)
    return opened


def vertex(opened):
    """Position in the window of a vertex of the first horizon."""
    code = "app.panes.original.view.to_pixels(app.interpretation.horizons[0].pieces[0][20]).tolist()"
    x, y = opened.ask(code)
    plot = opened.page.locator(".seiswidgets-layer .plot").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    return box["x"] + x, box["y"] + y


def fast_enough(what, rate, bound):
    return at_most(what, f"{rate:.1f}", f"{bound}", bound / rate, 1, 1)


def in_time(what, seconds, bound, runs):
    return at_most(what, told(seconds), told(bound), seconds / bound, 1, runs)
