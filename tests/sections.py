"""The real sections with their trial picks, for tests."""

import json
import os
from pathlib import Path

import pytest

import seiswidgets as sw

FILES = {"f3": "f3_inline362_picks.json", "teapot": "teapot_picks.json"}


def real_section(name):
    """A real section and its interpretation; skips where the data folder is not set, but never in CI."""
    folder = os.environ.get("SEISWIDGETS_DATA_DIR")
    if not folder:
        if os.environ.get("CI"):
            pytest.fail("CI must set SEISWIDGETS_DATA_DIR")
        pytest.skip("the real sections and their picks are not here; set SEISWIDGETS_DATA_DIR")
    picks = json.loads((Path(folder) / FILES[name]).read_text())
    faults = [sw.Fault(fault["points"], name=fault["name"]) for fault in picks["faults"]]
    horizons = [sw.Horizon(*horizon["pieces"], name=horizon["name"]) for horizon in picks["horizons"]]
    return getattr(sw.datasets, name)(), sw.Interpretation(faults, horizons)
