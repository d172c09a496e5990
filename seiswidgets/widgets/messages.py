"""How things are said in the app; every text is escaped by who fills it in."""

import logging

from seiswidgets.errors import SeiswidgetsError

TROUBLE = '<div role="alert" style="color: var(--jp-error-color1, #b71c1c); line-height: 1.4">{}</div>'
HINT = '<div role="status" style="color: var(--jp-ui-font-color2, #616161); line-height: 1.4">{}</div>'

_log = logging.getLogger(__name__)


def in_words(error: Exception) -> str:
    """What an error says; one that is not ours is logged too, as it is a mistake in seiswidgets."""
    if isinstance(error, SeiswidgetsError):
        return error.text
    _log.error("an action in the background failed", exc_info=error)
    return f"this should not have happened: {type(error).__name__}: {error}"
