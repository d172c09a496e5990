"""What can go wrong, in words for the person who drew the picks."""


class SeiswidgetsError(Exception):
    """Root of every error that seiswidgets raises on purpose."""


class SectionError(SeiswidgetsError, ValueError):
    """A section's amplitudes, spacing or units do not make a section."""


class PickError(SeiswidgetsError, ValueError):
    """A fault, a horizon or a held point cannot be used as it was drawn."""


class SettingError(SeiswidgetsError, ValueError):
    """A weight, a spacing, a datum or a choice of solver is out of its range."""


class DataError(SeiswidgetsError, OSError):
    """A data file is missing, damaged, or out of reach."""


class FlippedError(SeiswidgetsError):
    """A solution would turn triangles over, so that it maps two places onto one.

    Attributes
    ----------
    count : int
        How many triangles.
    """

    def __init__(self, message, count):
        super().__init__(message)
        self.count = count


class Cancelled(SeiswidgetsError):
    """A progress callback returned False; the restoration it was called on is unchanged."""
