import inspect
from importlib.metadata import version

import ipykernel.kernelbase
import pytest
from comm.base_comm import BaseComm
from ipywidgets import Button, HBox, VBox
from packaging.version import Version

from seiswidgets.widgets.ipykernel_compat import ROUTE, keep_order


def threads(*widgets):
    """Destination of messages that came by another thread, as ipykernel asks the widget; None is the main thread."""
    return [getattr(widget.comm, ROUTE)({}, "other") for widget in widgets]


def test_all_messages_to_a_widget_and_what_it_will_hold_go_to_the_main_thread(monkeypatch):
    monkeypatch.setattr(BaseComm, ROUTE, lambda comm, data, default: default, raising=False)
    inner, late, apart = Button(), Button(), Button()
    row = HBox([inner])
    box = VBox([row])
    keep_order(box)
    row.children = [inner, late]
    assert threads(box, row, inner, late) == [None] * 4
    assert threads(apart) == ["other"]


def test_other_versions_of_the_kernel_are_left_alone():
    button = Button()
    keep_order(button)
    assert not hasattr(button.comm, ROUTE)


def test_ipykernel_still_asks_the_widget_for_the_thread():
    """If this fails, see how a new version chooses the thread, and adapt `ipykernel_compat`."""
    if Version(version("ipykernel")) < Version("7.4"):
        pytest.skip("earlier versions keep the order by themselves")
    assert ROUTE in inspect.getsource(ipykernel.kernelbase)
