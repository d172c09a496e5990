"""Formats of SEG-Y's samples, and the sizes of its headers."""

import re
from typing import Any, NamedTuple

from seiswidgets.errors import Keyword, SettingError

TEXT, HEADERS, TRACE_HEADER, LABEL = 3200, 3600, 240, 128  # bytes
ORDERS = {"big": ">", "little": "<"}


class SampleFormat(NamedTuple):
    """A format of samples or header numbers: its kind in words, its bytes, and its name as an option."""

    kind: str
    size: int
    name: str

    @property
    def words(self) -> str:
        """Kind and size."""
        return f"{self.kind}, {self.size} byte{'s' * (self.size > 1)}"


FORMATS = {  # by SEG-Y's code
    1: SampleFormat("IBM float", 4, "ibm"),
    2: SampleFormat("integer", 4, "i4"),
    3: SampleFormat("integer", 2, "i2"),
    5: SampleFormat("IEEE float", 4, "f4"),
    6: SampleFormat("IEEE float", 8, "f8"),
    8: SampleFormat("integer", 1, "i1"),
    10: SampleFormat("unsigned integer", 4, "u4"),
    11: SampleFormat("unsigned integer", 2, "u2"),
    16: SampleFormat("unsigned integer", 1, "u1"),
}
CODES = {"ieee": 5, **{each.name: code for code, each in FORMATS.items()}}


def checked_choice(keyword: str, value: Any, known: tuple) -> Any:
    """Validate an option that has few values."""
    if isinstance(value, bool) or value not in known:
        raise SettingError(Keyword(keyword), f" must be one of {', '.join(map(repr, known))}, but is {value!r}")
    return value


def label_size(beginning: bytes) -> int:
    """Bytes of the tape label before the textual header, which some files have; 0 without one."""
    return LABEL if re.search(rb"SY[12]\.\d", beginning[:LABEL]) else 0


def revision(head: bytes) -> int:
    """Revision of the standard: two bytes, or one number in files of some programs; 0 if it is unknown."""
    major = head[3501] if head[3500:3502] == b"\0\1" else head[3500]
    return major if major in (1, 2) else 0
