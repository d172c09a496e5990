"""The built sdist and wheel, and the wheel installed into an empty environment: run by `make package`."""

import os
import re
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

import seiswidgets

ROOT = Path(__file__).parents[1]
RELEASE = f"seiswidgets-{seiswidgets.__version__}"
SHIPPED = {".py", ".js", ".css", ".typed"}
APP = """
import seiswidgets as sw

case = sw.synthetic.planar_fault()
app = sw.RestorationApp(case.section, case.interpretation, fixed=case.fixed)
assert app.wait(60)
print([stage.kind for stage in app.restoration.stages])
app.close()
"""


@pytest.fixture(scope="module")
def dist():
    """Folder of the built files."""
    return Path(os.environ["SEISWIDGETS_DIST"])


@pytest.fixture
def run(tmp_path):
    """Run Python in the environment of the wheel, outside the repository; return what it prints."""
    python = Path(os.environ["SEISWIDGETS_PACKAGE"]) / "bin" / "python"

    def run(*arguments):
        command = [python, "-I", *arguments]  # isolated: neither PYTHONPATH nor the working directory count
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def test_wheel_holds_the_whole_package_and_nothing_else(dist):
    (wheel,) = dist.glob(f"{RELEASE}-*.whl")
    held = set(zipfile.ZipFile(wheel).namelist())
    needed = {path.relative_to(ROOT).as_posix() for path in ROOT.glob("seiswidgets/**/*") if path.suffix in SHIPPED}
    assert "seiswidgets/py.typed" in needed
    assert needed - held == set()
    assert {name.partition("/")[0] for name in held} == {"seiswidgets", f"{RELEASE}.dist-info"}
    assert [name for name in held if "test" in name] == []


def test_sdist_holds_the_tests_and_the_licences(dist):
    with tarfile.open(dist / f"{RELEASE}.tar.gz") as sdist:
        held = set(sdist.getnames())
    files = ("pyproject.toml", "README.md", "LICENSE", "LICENSES.md", "CHANGELOG.md", "tests/conftest.py")
    assert {f"{RELEASE}/{name}" for name in files} <= held


def test_package_is_imported_from_the_environment(run):
    where = run("-c", "import seiswidgets; print(seiswidgets.__file__)").strip()
    assert Path(where).is_relative_to(os.environ["SEISWIDGETS_PACKAGE"])


def test_command_states_the_version(run):
    assert run("-m", "seiswidgets", "--version").strip() == f"seiswidgets {seiswidgets.__version__}"


def test_readme_example_runs(run, tmp_path):
    whole, small = "sw.Restoration(case.section)", "sw.Restoration(case.section, spacing=150)"
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"^```python\n(.*?)^```", readme, flags=re.DOTALL | re.MULTILINE)
    assert whole in example
    assert "settled" in run("-c", example.replace(whole, small))
    assert (tmp_path / "workflow.png").stat().st_size > 10_000


def test_app_restores(run):
    assert run("-c", APP).strip() == "['unfault', 'flatten']"
