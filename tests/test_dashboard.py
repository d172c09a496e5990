import json
from pathlib import Path

from jupyter_server.services.kernels.kernelmanager import MappingKernelManager

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


def test_voila_ends_the_kernels_of_closed_pages():
    """Voila reads voila.json from the folder that it is started in."""
    (name, settings), *others = json.loads((NOTEBOOKS / "voila.json").read_text()).items()
    assert (name, others) == (MappingKernelManager.__name__, [])
    assert set(settings) <= set(MappingKernelManager.class_traits(config=True))
    assert 0 < settings["cull_interval"] <= settings["cull_idle_timeout"] <= 600
    assert not settings["cull_connected"]  # a page that is open keeps its kernel
