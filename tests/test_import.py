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


def test_the_package_is_loaded_at_all(loaded):
    assert "seiswidgets" in loaded


@pytest.mark.parametrize("package", NOT_AT_ONCE)
def test_import_does_not_load(loaded, package):
    assert package not in loaded


def test_import_loads_no_jupyter_package(loaded):
    assert not [package for package in loaded if package.startswith(("jupyter", "ipy"))]


@pytest.mark.parametrize("name", seiswidgets.__all__)
def test_every_public_name_is_there(name):
    assert getattr(seiswidgets, name) is not None
    assert name in dir(seiswidgets)


def test_a_name_that_is_not_public_is_an_attribute_error():
    with pytest.raises(AttributeError, match="unfold"):
        seiswidgets.unfold  # noqa: B018
