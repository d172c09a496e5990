"""Bindings between values that must be equal: a trait and a field of the workspace, or a trait and a control."""

from collections.abc import Callable

from ipywidgets import Widget
from traitlets import HasTraits

from seiswidgets.interaction.document import Document
from seiswidgets.widgets.workspace import Workspace


def bind(owner: HasTraits, name: str, workspace: Workspace, read: Callable, write: Callable) -> None:
    """Keep a trait equal to a field of the workspace's document.

    No flag guards against echoes: an edit that changes nothing is no edit.

    Parameters
    ----------
    owner : HasTraits
    name : str
    workspace : Workspace
    read : callable(Document) -> value
    write : callable(value)
        Sends an edit to the workspace.
    """

    def follow(change: Document):
        setattr(owner, name, read(workspace.document))

    follow(workspace.document)
    workspace.observe(follow, "document")
    owner.observe(lambda change: write(change.new), name)


def bind_control(owner: HasTraits, name: str, control: Widget) -> None:
    """Keep a control's value equal to a trait, which prevails at first."""
    control.value = getattr(owner, name)
    control.observe(lambda change: setattr(owner, name, change.new), "value")
    owner.observe(lambda change: setattr(control, "value", change.new), name)
