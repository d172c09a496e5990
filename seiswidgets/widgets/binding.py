"""Bindings that keep values equal: a trait and a field of the workspace, or a trait and a control."""

from collections.abc import Callable
from typing import Any

from ipywidgets import Widget
from traitlets import HasTraits

from seiswidgets.interaction.document import Document
from seiswidgets.widgets.workspace import Workspace


def bind(
    owner: HasTraits,
    name: str,
    workspace: Workspace,
    read: Callable[[Document], Any],
    write: Callable[[Any], object],
) -> None:
    """Keep a trait equal to a field of the workspace's document.

    It needs no guard against echoes, since an edit that changes nothing is not recorded.

    Parameters
    ----------
    owner : HasTraits
    name : str
    workspace : Workspace
    read : callable(Document) -> value
    write : callable(value)
        Sends an edit to the workspace.
    """

    def follow(change: object) -> None:
        setattr(owner, name, read(workspace.document))

    follow(None)
    workspace.observe(follow, "document")
    owner.observe(lambda change: write(change.new), name)


def bind_control(owner: HasTraits, name: str, control: Widget) -> None:
    """Keep a control's value equal to a trait; at first the control takes the value of the trait."""
    control.value = getattr(owner, name)
    control.observe(lambda change: setattr(owner, name, change.new), "value")
    owner.observe(lambda change: setattr(control, "value", change.new), name)
