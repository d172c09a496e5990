"""Files to open, and a file that a browser would send."""

import itertools

import numpy as np

from tests.io.segyfiles import numbered, segy_bytes, straight, volume_headers

SENDERS = itertools.count(1)


def line(path, count=30, samples=40, text=None):
    """A 2-D line, traces 25 m and samples 4 ms apart."""
    traces = np.random.default_rng(1).normal(size=(count, samples)).astype(np.float32)
    path.write_bytes(segy_bytes(traces, straight(count), text=text))
    return path


def volume(path):
    """Inlines 10 to 12 of crosslines 1 to 5."""
    headers = volume_headers([10, 11, 12], [1, 2, 3, 4, 5])
    path.write_bytes(segy_bytes(numbered(headers), headers))
    return path


def send(field, name, content, size=None, piece=2**20):
    """Let a browser upload a file into a field, piece by piece as it is asked for; give back what was asked."""
    asked, sender = [], next(SENDERS)
    field.upload.send = asked.append
    message(field, "begin", sender, name=name, size=len(content) if size is None else size)
    while asked[-1]["next"] is not None and asked[-1]["next"] < len(content):
        start = asked[-1]["next"]
        message(field, "piece", sender, memoryview(content[start : start + piece]), start=start)
    return [answer["next"] for answer in asked]


def message(field, kind, sender, *buffers, **content):
    """Send a message of the upload button."""
    field.upload._handle_custom_msg({"kind": kind, "id": sender, **content}, list(buffers))
