"""What public functions are given, where it may be of another kind than they take."""

from seiswidgets.errors import SettingError


def checked_kind(value, kind: type, name: str):
    """SettingError if an argument is not of the class that it must be of."""
    if not isinstance(value, kind):
        raise SettingError(f"{name} must be {_a(kind)}, but is {_a(type(value))}")


def _a(kind):
    return f"{'an' if kind.__name__[0] in 'AEIOUaeiou' else 'a'} {kind.__name__}"
