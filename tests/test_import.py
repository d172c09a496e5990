import subprocess
import sys

import pytest

import seiswidgets

JUPYTER = ["IPython", "anywidget", "ipycanvas", "ipywidgets", "traitlets"]
NOT_AT_ONCE = [*JUPYTER, "matplotlib", "pooch", "scipy", "skimage"]


@pytest.fixture(scope="module")
def loaded():
    """The top-level packages that `import seiswidgets` loads in a new process."""
    code = "import sys, seiswidgets; print(*{name.partition('.')[0] for name in sys.modules})"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


def test_import_loads_neither_jupyter_nor_what_is_slow(loaded):
    assert "seiswidgets" in loaded
    assert loaded.isdisjoint(NOT_AT_ONCE)
    assert not [package for package in loaded if package.startswith(("jupyter", "ipy"))]


def test_the_app_appears_without_what_only_its_tabs_need():
    code = "import sys, seiswidgets; seiswidgets.RestorationApp; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert {"loky", "scipy.signal", "scipy.stats", "matplotlib.pyplot"}.isdisjoint(loaded)


def test_every_public_name_is_there():
    assert len(seiswidgets.__all__) > 40
    assert set(seiswidgets.__all__) <= set(dir(seiswidgets))
    assert [name for name in seiswidgets.__all__ if getattr(seiswidgets, name, None) is None] == []


def test_a_name_that_is_not_public_is_an_attribute_error():
    with pytest.raises(AttributeError, match="unfold"):
        seiswidgets.unfold  # noqa: B018
