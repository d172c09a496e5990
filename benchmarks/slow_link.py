"""A slow network between a browser and a server on this machine."""

import queue
import socket
import threading
import time
from contextlib import contextmanager

DELAY, RATE = 0.05, 5e6 / 8  # seconds one way, bytes a second
CHUNK = 4096  # bytes: a link sends one after the other, whichever connection they belong to


class Direction:
    """One way of a link, which all connections share."""

    def __init__(self):
        self.is_slow, self._free_at, self._lock = False, 0.0, threading.Lock()

    def arrival(self, size):
        """When bytes that are sent now arrive."""
        with self._lock:
            if not self.is_slow:
                return 0.0
            self._free_at = max(self._free_at, time.monotonic()) + size / RATE
            return self._free_at + DELAY

    def carry(self, source, target):
        """Carry bytes from one socket to another until the first is closed."""
        waiting = queue.SimpleQueue()
        threading.Thread(target=_deliver, args=(waiting, target), daemon=True).start()
        while data := _received(source):
            waiting.put((self.arrival(len(data)), data))
        waiting.put((self.arrival(0), b""))


def _received(source):
    try:
        return source.recv(CHUNK)
    except OSError:
        return b""


def _deliver(waiting, target):
    data = b" "
    while data:
        at, data = waiting.get()
        time.sleep(max(0.0, at - time.monotonic()))
        try:
            target.sendall(data) if data else target.shutdown(socket.SHUT_WR)
        except OSError:
            return


class SlowLink:
    """A port through which a server is reached: fast, until ``slow_down`` is called."""

    def __init__(self, port):
        self._target, self._ways = port, (Direction(), Direction())
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def slow_down(self):
        for way in self._ways:
            way.is_slow = True

    def close(self):
        self._listening.close()

    def _accept(self):
        while True:
            try:
                browser, _ = self._listening.accept()
            except OSError:
                return
            server = socket.create_connection(("127.0.0.1", self._target))
            for one in (browser, server):
                one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            for way, ends in zip(self._ways, ((browser, server), (server, browser)), strict=True):
                threading.Thread(target=way.carry, args=ends, daemon=True).start()


@contextmanager
def slow_link(port):
    """A link to a port, while it is needed."""
    link = SlowLink(port)
    try:
        yield link
    finally:
        link.close()
