"""The badge of a pane: a coloured frame with a label on its upper edge."""

from ipywidgets import HTML, Layout

from seiswidgets.widgets.severity import LOOKS, label

FRAME = (
    '<div style="box-shadow: 0 0 0 {width}px {fill}"><span style="position: absolute; right: 8px; top: -9px; '
    'line-height: 0">{label}</span></div>'
)
WIDTHS = {"problem": 3, "warning": 2}  # css pixels of the frame


class PaneBadge(HTML):
    """Frame and label over a pane; neither covers the picture, nor takes mouse events.

    Parameters
    ----------
    layout : Layout
        Puts it on the plot area.

    Attributes
    ----------
    severity : str
        Severity of the finding shown; "" if there is none.
    text : str
        The label.
    """

    def __init__(self, layout: Layout):
        super().__init__(layout=layout)
        self.add_class("seiswidgets-pane-badge")
        self.hide()

    def show(self, severity: str, text: str) -> None:
        """Show the frame and the label."""
        self.severity, self.text = severity, text
        fill, _ = LOOKS[severity].colours
        self.value = FRAME.format(width=WIDTHS.get(severity, 1), fill=fill, label=label(severity, text))
        self.layout.display = ""

    def hide(self) -> None:
        """Hide the frame and the label."""
        self.severity = self.text = self.value = ""
        self.layout.display = "none"
