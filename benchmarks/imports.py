"""Cost of ``import seiswidgets`` in a new process."""

import subprocess
import sys
from functools import partial

import numpy as np
from timing import faster

RUNS = 11
CODE = """
import sys, time
began = time.perf_counter()
import {package}
print(time.perf_counter() - began)
print(*{{name.partition(".")[0] for name in sys.modules}})
"""
UNWANTED = {"matplotlib", "IPython", "anywidget", "ipycanvas", "ipywidgets", "jupyter_client", "traitlets"}


def rows():
    ours, numpy = (partial(imported, package) for package in ("seiswidgets", "numpy"))
    times = np.median([(ours()[0], numpy()[0]) for _ in range(RUNS)], axis=0)
    yield faster("import seiswidgets / import numpy", *times, None, RUNS)
    loaded = UNWANTED & ours()[1]
    met = "NO" if loaded else "yes"
    yield "import loads of Jupyter or matplotlib", ", ".join(loaded) or "nothing", "", "", "nothing", met, 1


def imported(package):
    code = CODE.format(package=package)
    seconds, modules = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    return float(seconds), set(modules.split())
