"""Firefox, driven over WebDriver BiDi: Playwright only drives a Firefox of its own, and this one needs nothing else."""

import contextlib
import itertools
import json
import os
import re
import subprocess
import time

import pytest
import websocket

from tests.leftovers import ended, family
from tests.widgets.browser import IGNORED, RUN

PREFERENCES = {
    "focusmanager.testmode": True,  # the page has the focus though there is no screen
    # no address but this machine's is reached
    "network.proxy.type": 1,
    "network.proxy.http": "127.0.0.1",
    "network.proxy.http_port": 9,
    "network.proxy.ssl": "127.0.0.1",
    "network.proxy.ssl_port": 9,
    "network.proxy.allow_hijacking_localhost": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
}
CALL = "async (given) => JSON.stringify((await ({})(...JSON.parse(given))) ?? null)"


class Firefox:
    """One window of Firefox.

    Parameters
    ----------
    path : str
        Of its program.
    folder : Path
        For its profile.
    size : tuple (width, height)
        Of the window, in css pixels.
    """

    def __init__(self, path, folder, size):
        lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});" for name, value in PREFERENCES.items()]
        (folder / "user.js").write_text("\n".join(lines))
        command = [path, "--headless", "--no-remote", "--profile", str(folder), "--remote-debugging-port=0"]
        self._log = folder / "log"
        with self._log.open("w") as log:
            home = {**os.environ, "HOME": str(folder)}  # where it makes a folder for downloads
            self._process = subprocess.Popen(command, stdout=log, stderr=log, env=home)
        self._numbers, self.errors = itertools.count(), []
        self._socket = websocket.create_connection(f"{self._address()}/session", suppress_origin=True, timeout=RUN)
        self._command("session.new", capabilities={})
        self._command("session.subscribe", events=["log.entryAdded"])
        self._context = self._command("browsingContext.create", type="tab")["context"]  # the first tab has no focus
        width, height = size
        self._in_page("browsingContext.setViewport", viewport={"width": width, "height": height})

    def _address(self):
        end = time.monotonic() + RUN
        while not (found := re.search(r"WebDriver BiDi listening on (ws://\S+)", self._log.read_text())):
            if self._process.poll() is not None or time.monotonic() > end:
                pytest.fail(f"Firefox did not start:\n{self._log.read_text()[-2000:]}")
            time.sleep(0.05)
        return found[1]

    def _command(self, method, **parameters):
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self._socket.recv())
            if message["type"] == "event":
                self._note(message["params"])
            elif message["id"] == number:
                assert message["type"] == "success", message
                return message["result"]

    def _note(self, entry):
        text = f"{entry['text']} ({entry.get('stackTrace')})"
        if entry["level"] == "error" and not IGNORED.search(text):
            self.errors.append(text)

    def _in_page(self, method, **parameters):
        return self._command(method, context=self._context, **parameters)

    def goto(self, address):
        """Load a page."""
        self._in_page("browsingContext.navigate", url=address, wait="complete")

    def evaluate(self, function, *given):
        """Result of a JavaScript function, awaited."""
        argument = {"type": "string", "value": json.dumps(given)}
        called = {"functionDeclaration": CALL.format(function), "arguments": [argument], "awaitPromise": True}
        done = self._command("script.callFunction", target={"context": self._context}, **called)
        assert done["type"] == "success", done["exceptionDetails"]["text"]
        return json.loads(done["result"]["value"])

    def click(self, x, y, times=1):
        """Click at a point of the page, in css pixels."""
        strokes = [{"type": kind, "button": 0} for _ in range(times) for kind in ("pointerDown", "pointerUp")]
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        self._act({"type": "pointer", "id": "mouse", "actions": [move, *strokes]})

    def wheel(self, x, y, delta):
        """Turn the wheel over a point of the page."""
        scroll = {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": delta}
        self._act({"type": "wheel", "id": "wheel", "actions": [scroll]})

    def _act(self, actions):
        self._in_page("input.performActions", actions=[actions])

    def end(self):
        """End it and all that it has started."""
        processes = family(self._process.pid)
        with contextlib.suppress(websocket.WebSocketException, OSError):
            self._socket.close()
        self._process.terminate()
        ended(processes)
        self._process.wait()
