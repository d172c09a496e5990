"""Controls and traits that are kept equal."""

from ipywidgets import Widget
from traitlets import HasTraits


def tie(owner: HasTraits, name: str, control: Widget) -> None:
    """Keep a control's value and a trait equal; at first, the trait's value holds."""
    control.value = getattr(owner, name)
    control.observe(lambda change: setattr(owner, name, change.new), "value")
    owner.observe(lambda change: setattr(control, "value", change.new), name)
