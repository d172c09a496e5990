"""Validation of the settings of a pane, so that errors name the setting and its range."""

from typing import Any

from seiswidgets.errors import SettingError
from seiswidgets.interaction.colour import colour_map
from seiswidgets.interaction.viewport import checked_window

LEAST_HEIGHT = 150  # css pixels


def checked_setting(name: str, value: Any) -> Any:
    """Validate the value of a setting of `SectionPane`, and return it.

    Raises
    ------
    SettingError
        If the value is out of its range.
    """
    if name == "colours":
        colour_map(value)
    elif name == "frame":
        return None if value is None else checked_window("frame", value)
    elif name == "clip" and not 0 < value <= 100:
        raise SettingError(f"clip must be a percentile, above 0 and at most 100, but is {value:g}")
    elif name in ("gain", "limit") and not (value is None or 0 < value < float("inf")):
        raise SettingError(f"{name} must be a finite number above 0, but is {value:g}")
    elif name == "height" and value is not None and value < LEAST_HEIGHT:
        raise SettingError(f"height must be at least {LEAST_HEIGHT} css pixels, but is {value}")
    elif name.endswith("opacity") and not 0 <= value <= 1:
        raise SettingError(f"{name} must be from 0 to 1, but is {value:g}")
    return value
