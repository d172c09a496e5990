"""HTML of messages in the app, and errors in words; whoever fills a text into the HTML escapes it."""

import logging

from seiswidgets.errors import SeiswidgetsError, Text

TROUBLE = '<div role="alert" style="color: var(--jp-error-color1, #b71c1c); line-height: 1.4">{}</div>'
HINT = '<div role="status" style="color: var(--jp-ui-font-color2, #616161); line-height: 1.4">{}</div>'

IN_THE_APP = {  # by the kind of an error
    "held outside": "Hold: the pin lies outside the rock. Click it to remove it, then click inside the block to hold.",
}

LABELS = {"beyond": "“beyond its ends”, in Steps"}  # by keyword

_log = logging.getLogger(__name__)


def in_the_app(text: str) -> str:
    """Render a message with the labels of the app in place of keywords."""
    return text.rendered(LABELS) if isinstance(text, Text) else text


def in_words(error: Exception) -> str:
    """Message of an error; an error that is not a `SeiswidgetsError` is a bug, and is logged too."""
    if isinstance(error, SeiswidgetsError):
        return IN_THE_APP.get(error.kind, error.text)
    log_error(error)
    return f"this should not have happened: {type(error).__name__}: {error}"


def log_error(error: Exception) -> None:
    """Log an error that is a bug in seiswidgets."""
    _log.error("a background job failed", exc_info=error)
