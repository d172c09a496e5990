"""Files to open, and a file that a browser would send."""

import numpy as np

from tests.io.segyfiles import numbered, segy_bytes, straight, volume_headers


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


def send(field, name, content, size=None):
    """Let a browser upload a file into a field."""
    size = len(content) if size is None else size
    file = {"name": name, "type": "", "size": size, "content": memoryview(content), "last_modified": 0}
    field.upload.set_state({"value": [file]})
