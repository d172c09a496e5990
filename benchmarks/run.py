"""Cost of restoring, beside other libraries, in one table. Name groups to run only those.

Every ratio is of medians within one run on one machine, ours and the peer's measured in turns.
"""

import os
import platform
import sys
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

GROUPS = ["imports", "pictures", "solvers", "arap", "growth", "flips", "drawings", "scan", "ensembles", "browser"]
COLUMNS = ["what", "ours", "peer or bound", "ratio", "target", "met", "runs"]
WIDTHS = [58, 12, 16, 9, 10, 4, 4]


def main(names):
    sys.path.insert(0, str(Path(__file__).parents[1]))  # for what benchmarks share with the tests
    if unknown := set(names) - set(GROUPS):
        sys.exit(f"there is no benchmark called {', '.join(unknown)}; there are {', '.join(GROUPS)}")
    packages = ["numpy", "scipy", "cvxopt", "scikit-image", "libigl", "opencv-python-headless"]
    print(f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}", end="")
    print(*(f", {package} {installed(package)}" for package in packages), sep="")
    print(line(COLUMNS))
    missed = 0
    for name in names or GROUPS:
        for row in import_module(name).rows():
            print(line(row), flush=True)
            missed += row[5] == "NO"
    print(f"{missed or 'no'} target{'s' * (missed != 1)} missed")


def installed(package):
    try:
        return version(package)
    except PackageNotFoundError:
        return "missing"


def line(cells):
    padded = (f"{cell!s:<{width}}" for cell, width in zip(cells, WIDTHS, strict=True))
    return " ".join(padded).rstrip()


if __name__ == "__main__":
    main(sys.argv[1:])
