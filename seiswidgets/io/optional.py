"""Packages that only some files need."""

from importlib import import_module

from seiswidgets.errors import DataError


def required(package: str, purpose: str):
    """A package of the extra ``files``, imported; ``purpose`` says for what it is needed, as "to read line.sgy".

    Raises
    ------
    DataError
        If it is not installed; the message says how to install it.
    """
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        raise DataError(
            f"{purpose} takes the package {package}, which is not installed: pip install {package}, "
            'or "seiswidgets[files]" for all that files may need'
        ) from error
