"""Growth of time and memory with the mesh."""

import subprocess
import sys

import numpy as np
from problems import problem
from timing import at_most, in_turns, told

import seiswidgets as sw

SIZES = 1_000, 3_000, 10_000, 30_000, 100_000
MOST_BYTES = 4e9
LARGE = """
import resource, sys
import numpy as np, seiswidgets as sw
case = sw.synthetic.{case}()
picks, start = case.interpretation, sw.Restoration(case.section, spacing={spacing})
restored = start.unfault(picks.faults, picks.horizons) if picks.faults else start.flatten(picks.horizons[1])
unit = 1 if sys.platform == "darwin" else 1024
print(restored.stages[0].report.vertices, unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def rows():
    for name, make in {"tilt": sw.synthetic.tilt, "blind_fault": sw.synthetic.blind_fault}.items():
        case, counts, times = make(), [], []
        for size in SIZES:
            runs = 5 if size < 30_000 else 1
            one = problem(case, size)
            counts.append(len(one.mesh.vertices))
            times.append(in_turns([one.solved], runs)[0])
        exponent = np.polyfit(np.log(counts), np.log(times), 1)[0]
        what = f"growth of {name}, {counts[0]:,} to {counts[-1]:,} vertices"
        yield at_most(what, told(times[-1]), f"n^ from {told(times[0])}", exponent, 1.5, "5-1")
        yield memory(name, one.tolerance * 1e6)


def memory(name, spacing):
    code = LARGE.format(case=name, spacing=spacing)
    vertices, size = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    what = f"  peak memory of a process with {int(vertices):,} vertices"
    return at_most(what, f"{int(size) / 1e9:.2f} GB", f"{MOST_BYTES / 1e9:g} GB", int(size) / MOST_BYTES, 1, 1)
