"""A JupyterLab, and a Chromium that looks at it."""

import ast
import contextlib
import json
import os
import re
import secrets
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import expect

from tests.leftovers import ended, family

ROOT = Path(__file__).parents[2]
SCREENSHOTS = ROOT / "screenshots"
FLAGS = [
    "--no-sandbox",  # or it will not run as root
    "--disable-gpu",
    "--disable-quic",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",  # Voila's page asks others for icons and formulas
]
IGNORED = re.compile(
    "favicon|net::ERR_INTERNET_DISCONNECTED|net::ERR_NAME_NOT_RESOLVED"
    "|@jupyter-notebook/lab-extension"  # that Voila cannot load
    "|reading 'schema'"  # Notebook 7.6 says so of a notebook without any widget too
)
PREPARED, LOAD = "prepared", "exec('import seiswidgets.widgets.app', {})"
START, RUN, COMMAND = 60, 60, 180  # seconds: the server's start, anything in the page, all cells of a notebook
expect.set_options(timeout=RUN * 1000)


class Server:
    """JupyterLab on 127.0.0.1, at a free port, with a token, with none of the user's settings.

    Another Python than that of the tests uses the package as it is installed there.
    """

    def __init__(self, folder, python=sys.executable):
        self.folder, self.token, self.port = folder / "work", secrets.token_hex(16), _free_port()
        self._prepared = None
        self.folder.mkdir()
        settings = folder / "settings"
        (settings / "lab").mkdir(parents=True)
        self._write_overrides(folder)
        home = {
            name: str(folder / name.lower()) for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
        }
        path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
        environment = {**os.environ, **home, "PYTHONPATH": path if python == sys.executable else ""}
        environment.pop("MPLBACKEND", None)  # or no kernel would show a picture
        environment["JUPYTER_PATH"] = str(_write_kernel(folder / "data", python))
        command = [str(python), "-m", "jupyterlab", "--no-browser", "--allow-root", "--ip=127.0.0.1"]
        command += [f"--port={self.port}", "--ServerApp.port_retries=0", f"--IdentityProvider.token={self.token}"]
        command += [f"--ServerApp.root_dir={self.folder}", f"--LabApp.user_settings_dir={settings}"]
        command += [f"--LabApp.workspaces_dir={folder / 'workspaces'}", "--LabApp.expose_app_in_browser=True"]
        command += ["--KernelManager.shutdown_wait_time=0.2"]  # seconds; a kernel at rest has nothing left to do
        self.log = folder / "server.log"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(command, env=environment, stdout=log, stderr=log, cwd=self.folder)

    def _write_overrides(self, folder):
        config = folder / "jupyter_config_dir" / "labconfig"
        config.mkdir(parents=True)
        news = {"@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": False}}
        (config / "default_setting_overrides.json").write_text(json.dumps(news))

    def wait(self):
        """Until it answers."""
        for _ in range(START * 5):
            if self.process.poll() is not None:
                break
            with contextlib.suppress(OSError):
                self._asked("status")
                return
            time.sleep(0.2)
        pytest.fail(f"JupyterLab did not start:\n{self.log.read_text()[-3000:]}")

    def prepare(self):
        """Start a kernel that imports the package, for the next notebook: that takes longest of opening one."""
        if self._prepared is None:
            self._prepared = self._asked("kernels", "POST", {"name": PREPARED})["id"]

    def prepared(self):
        """The kernel that was prepared, which is used once, or None."""
        kernel, self._prepared = self._prepared, None
        return kernel

    def end_kernels(self):
        """End what the pages, which are closed now, have left to run."""
        for kernel in self._asked("kernels"):
            if kernel["id"] == self._prepared:
                continue
            with contextlib.suppress(urllib.error.HTTPError):  # Voila has ended it meanwhile
                self._asked(f"kernels/{kernel['id']}", "DELETE")

    def end(self):
        """End it and all that it has started."""
        if self.process.poll() is None:
            processes = family(self.process.pid)
            self.process.terminate()
            ended(processes)
            self.process.wait()

    def _asked(self, path, method="GET", content=None):
        """The answer of the server's interface."""
        token, address = {"Authorization": f"token {self.token}"}, f"http://127.0.0.1:{self.port}/api/{path}"
        data = None if content is None else json.dumps(content).encode()
        request = urllib.request.Request(address, data, token, method=method)
        with urllib.request.urlopen(request, timeout=RUN) as answer:
            return json.loads(answer.read() or "null")

    def write(self, cells):
        """Write a notebook of some cells of code into the folder, and give back its name."""
        name = f"{secrets.token_hex(4)}.ipynb"
        made = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
        made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
        nbformat.write(made, self.folder / name)
        return name

    def address(self, path, place="lab/tree"):
        """URL of a notebook, or of another path on the server."""
        return f"http://127.0.0.1:{self.port}/{place}/{path}?reset&token={self.token}"


class Page:
    """A page of the server in the browser, and the errors in its console.

    Parameters
    ----------
    chromium
        The fixture.
    address : str
    ratio : float
        Device pixels in a css pixel.
    width, height : int
        Of the window, in css pixels.
    touch : bool
        Whether the screen takes fingers.
    """

    def __init__(self, chromium, address, *, ratio=1.0, width=1200, height=900, touch=False):
        self.errors, self.dialogs, self.sent = [], [], []
        size = {"width": width, "height": height}
        self.context = chromium.new_context(viewport=size, device_scale_factor=ratio, has_touch=touch)
        self.visit(address)

    def visit(self, address):
        """Go to an address, in a new tab."""
        self.page = self.context.new_page()
        self.page.set_default_timeout(RUN * 1000)
        self.page.on("console", self._note)
        self.page.on("pageerror", lambda error: IGNORED.search(str(error)) or self.errors.append(str(error)))
        self.page.on("dialog", self._dismiss)
        self.page.on("websocket", lambda socket: socket.on("framesent", lambda frame: self.sent.append(frame)))
        self.page.goto(address)

    def _note(self, message):
        if message.type == "error" and not IGNORED.search(message.text):
            self.errors.append(f"{message.text} ({message.location.get('url')})")

    def _dismiss(self, dialog):
        self.dialogs.append(dialog.message)
        dialog.dismiss()

    def close(self):
        self.context.close()


class Notebook(Page):
    """A page of JupyterLab, and the notebook in it, of which there may be several, one after the other.

    Parameters
    ----------
    lab, chromium
        The fixtures.
    **options
        Of the page.
    """

    def __init__(self, lab, chromium, **options):
        self.lab = lab
        super().__init__(chromium, lab.address("", "lab"), **options)
        self._simplify()

    def _simplify(self):
        self.page.wait_for_function("window.jupyterapp?.restored.then(() => true)")
        self.command("application:toggle-left-area")

    def open(self, path, *, kernel=None, dark=False, width=1200, height=900):
        """Open a notebook of the server's folder, in JupyterLab's light or dark theme, and run its cells.

        The kernel is a new one, or that of an id.
        """
        self.address = self.lab.address(path)
        self.page.set_viewport_size({"width": width, "height": height})
        self.command("docmanager:open", {"path": path, "kernel": kernel and {"id": kernel}})
        self.page.wait_for_function(READY, polling=50)
        self.darken(dark)
        self.run()

    def shut(self):
        """End the notebook's kernel, and leave the page as if it were new."""
        self.page.evaluate(SHUT)
        self.page.mouse.move(0, 0)
        for told in (self.errors, self.dialogs, self.sent):
            told.clear()

    def darken(self, dark):
        """Take JupyterLab's dark theme, or its light one."""
        light = str(not dark).lower()
        if self.page.locator("body").get_attribute("data-jp-theme-light") != light:  # as the last test left it
            self.command("apputils:change-theme", {"theme": f"JupyterLab {'Dark' if dark else 'Light'}"})
            self.page.locator(f"body[data-jp-theme-light={light}]").wait_for(state="attached")
            self.page.locator("#jupyterlab-splash").wait_for(state="detached")  # covers the page, and takes its clicks

    def command(self, name, arguments=None):
        """Execute one of JupyterLab's commands."""
        self.page.evaluate(EXECUTE, [name, arguments or {}])
        self.page.wait_for_function("window.done", timeout=COMMAND * 1000, polling=50)

    def run(self):
        """Run all cells, until the last one is done, and show only what they put out."""
        self.command("notebook:run-all-cells")
        self.command("notebook:hide-all-cell-code")

    def reload(self):
        """Load the page anew, with this notebook only; the kernel goes on."""
        self.page.goto(self.address)
        self._simplify()
        self.page.wait_for_function(READY, polling=50)

    @contextlib.contextmanager
    def kernel_at_work(self):
        """A context in which the kernel executes a cell."""
        over = self.lab.folder / f"over-{secrets.token_hex(4)}"
        self.page.evaluate(BEGIN, WORK.format(str(over)))
        self.page.wait_for_function("window.atWork")
        yield
        assert self.page.evaluate("window.atWork")
        over.touch()
        assert self.ask("True")

    def ask(self, code):
        """Value of an expression in the kernel, through the notebook's own kernel connection."""
        told = self.page.evaluate(ASK, f"__import__('json').dumps({code})")
        if told["status"] != "ok":
            raise RuntimeError("\n".join(told["traceback"]))
        return json.loads(ast.literal_eval(told["data"]["text/plain"]))

    def until(self, code):
        """Wait until an expression is true in the kernel, where it may not even be evaluated at first."""

        def holds():
            with contextlib.suppress(RuntimeError):
                return self.ask(f"bool({code})")

        awaited(holds, bool, code)

    def becomes(self, code, value):
        """Wait until an expression has just this value in the kernel."""
        awaited(lambda: self.ask(code), lambda found: found == value, f"{code} == {value}")


READY = """() => {
  const kernel = window.jupyterapp?.shell.currentWidget?.sessionContext?.session?.kernel;
  return kernel?.connectionStatus === "connected" && kernel.status === "idle";
}"""

SHUT = """async () => {
  const { currentWidget } = window.jupyterapp.shell;
  await currentWidget.sessionContext.shutdown();
  currentWidget.dispose();
}"""

EXECUTE = """([name, given]) => {
  window.done = false;
  window.jupyterapp.commands.execute(name, given).then(() => { window.done = true; });
}"""

BEGIN = """(code) => {
  const kernel = window.jupyterapp.shell.currentWidget.sessionContext.session.kernel;
  kernel.requestExecute({ code }).onIOPub = ({ header, content }) => {
    if (header.msg_type === "status") window.atWork = content.execution_state === "busy";
  };
}"""
WORK = """
import pathlib, time
while not pathlib.Path({!r}).exists():
    time.sleep(0.05)
"""

ASK = """async (code) => {
  const kernel = window.jupyterapp.shell.currentWidget.sessionContext.session.kernel;
  const asked = { code: "", user_expressions: { told: code }, store_history: false };
  const { content } = await kernel.requestExecute(asked).done; // the reply: what is printed, a busy server may drop
  return content.user_expressions.told;
}"""


def awaited(read, suits, wanted):
    """Result of a function once it suits: a page shows things some frames after its kernel knows them."""
    end = time.monotonic() + RUN
    while not suits(found := read()):
        if time.monotonic() > end:
            pytest.fail(f"never came to {wanted}, but to {found}")
        time.sleep(0.05)
    return found


def settled(read, suits=lambda found: True):
    """Result of a function once it suits and has not changed for a while."""
    last = None

    def is_settled(found):
        nonlocal last
        last, before = found, last
        time.sleep(0.2)
        return before == found and suits(found)

    return awaited(read, is_settled, "rest")


def keep_picture(shown, name):
    """Keep a screenshot of a page or a part of it, to be looked at."""
    SCREENSHOTS.mkdir(exist_ok=True)
    (SCREENSHOTS / f"{name}.png").write_bytes(shown.screenshot())  # if Playwright wrote it, a thread of it would stay


def _write_kernel(folder, python):
    """Write the specification of a kernel that has the package loaded, and give back the folder to look for it in."""
    made = folder / "kernels" / PREPARED
    made.mkdir(parents=True)
    call = [str(python), "-m", "ipykernel_launcher", "-f", "{connection_file}", f"--IPKernelApp.exec_lines={LOAD}"]
    (made / "kernel.json").write_text(json.dumps({"argv": call, "display_name": PREPARED, "language": "python"}))
    return folder


def _free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]
