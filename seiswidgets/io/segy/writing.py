"""Writing of SEG-Y: amplitudes as IEEE floats, the original's headers, and a note that the section was restored."""

import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from seiswidgets.errors import Keyword, SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.io.exports.reports import stages_as_line
from seiswidgets.io.files import atomic_write
from seiswidgets.io.options import OpenOptions
from seiswidgets.io.segy.formats import HEADERS, TEXT, TRACE_HEADER
from seiswidgets.io.segy.lines import Line, line
from seiswidgets.io.segy.reading import open_headers
from seiswidgets.io.segy.traces import FIELDS, LONG, SHORT, HeaderField, TraceHeaders, standard_field

THOUSANDTHS = {"ms": 1000, "s": 1_000_000, "m": 1000, "km": 1_000_000, "ft": 1000}  # of a millisecond, metre or foot
LIVE, DEAD = 1, 2
LIKE = Keyword("like")  # as errors name it
COPIED = ((3201, 3217), (3227, 3261))  # bytes of the binary header that are copied, each to the one before
GENERAL_LONG = (3201, 3205, 3209)  # four-byte numbers of the binary header
NUMBERS = (1, 5, 21)  # trace number in the line and in the file, and number of its common depth point
LONG_FREE = (181, 185, 189, 193, 197, 205, 225)  # four-byte numbers of revision 1 that revision 0 leaves free
CODES = {"i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}  # of struct
REVISION = {3501: 0x100, 3503: 1}  # 1.0, with traces of equal length
LARGEST_INTEGER, MOST_SAMPLES = 2**31 - 1, 2**16 - 1


def write_segy(
    section: Section, path: Path, restored: Restoration | None, like: Path | None, options: OpenOptions
) -> None:
    """Write a section as SEG-Y; ``restored`` is the restoration that it comes from.

    Raises
    ------
    SettingError
        If SEG-Y cannot hold the section's size, spacing, amplitudes or positions.
    DataError
        If the file cannot be written, or ``like`` cannot be read.
    """
    _check_samples(section, path)
    vertical = _vertical(section, path)
    if like is None:
        text, general = [""] * 40, bytearray(HEADERS - TEXT)
        _put(general, _general(3255), 2 if section.x_unit == "ft" else 1)
        headers = _own_headers(section, path)
    else:
        with open_headers(like, options) as original:
            text, general = original.layout.text.split("\n"), _copied_general(original)
            selected = line(original, options, None)
            headers = list(_copied_headers(section, original, selected, options.keywords.get("x0") or 0.0, path))
    for byte, value in (REVISION | {3217: vertical[117], 3221: section.shape[0], 3225: 5}).items():
        _put(general, _general(byte, "u2"), value)
    with atomic_write(path) as draft, draft.open("wb") as file:
        file.write(_textual_header(text, section, restored) + bytes(general))
        for trace, header in zip(section.amplitude.T, headers, strict=True):
            for byte, value in (vertical | {115: section.shape[0], 29: _state(trace)}).items():
                _put(header, HeaderField(byte, "u2" if byte == 115 else "i2"), value)
            file.write(bytes(header) + np.nan_to_num(trace).astype(">f4").tobytes())


def _general(byte: int, kind: str = "i2") -> HeaderField:
    """A number of the binary header, by its byte in the file."""
    return HeaderField(byte - TEXT, kind)


def _put(header: bytearray, field: HeaderField, value: float) -> None:
    struct.pack_into(f">{CODES[field.kind]}", header, field.byte - 1, value)


def _number(header: bytes | bytearray, field: HeaderField) -> float:
    (value,) = struct.unpack_from(f">{CODES[field.kind]}", header, field.byte - 1)
    return value


def _state(trace: np.ndarray) -> int:
    return DEAD if np.isnan(trace).all() else LIVE


def _check_samples(section: Section, path: Path) -> None:
    largest = np.nanmax(np.abs(section.amplitude))
    if section.shape[0] > MOST_SAMPLES or largest > np.finfo(np.float32).max:
        raise SettingError(
            f"{path}: SEG-Y holds {MOST_SAMPLES:,} samples per trace, of up to 3.4e38, but this section has "
            f"{section.shape[0]:,}, of up to {largest:.3g}; save it as .npz"
        )


def _vertical(section: Section, path: Path) -> dict[int, int]:
    """Sample interval and start of the traces, as in the trace header."""
    interval = section.dz * THOUSANDTHS[section.z_unit]
    if not (np.isclose(interval, np.rint(interval), rtol=1e-9) and 1 <= np.rint(interval) < 2**15):
        raise SettingError(
            f"{path}: SEG-Y holds distances between samples from 0.001 to 32.767 ms, m or ft, in whole thousandths, "
            f"but this section has {section.dz:g} {section.z_unit}; save it as .npz"
        )
    start = section.z0 * THOUSANDTHS[section.z_unit] / 1000
    for scalar in (1, 10, 100, 1000):
        delay = np.rint(start * scalar)
        if abs(delay) < 2**15 and np.isclose(delay, start * scalar, rtol=1e-9, atol=1e-6):
            return {117: int(np.rint(interval)), 109: int(delay), 215: -scalar if scalar > 1 else 1}
    raise SettingError(f"{path}: SEG-Y cannot hold a first sample at {section.z0:g} {section.z_unit}; save it as .npz")


def _own_headers(section: Section, path: Path) -> list[bytearray]:
    """Headers of a line along the axis of x, with positions in thousandths of a metre or foot if these fit."""
    x = section.x * (1000 if section.x_unit == "km" else 1)
    scale = next((scale for scale in (1000, 100, 10, 1) if np.abs(x).max() * scale <= LARGEST_INTEGER), None)
    if scale is None:
        raise SettingError(f"{path}: SEG-Y cannot hold positions as far out as {np.abs(x).max():g} m; save it as .npz")
    headers = [bytearray(TRACE_HEADER) for _ in x]
    for count, (header, position) in enumerate(zip(headers, np.rint(x * scale).astype(int).tolist(), strict=True), 1):
        numbers = {**dict.fromkeys(NUMBERS, count), 89: 1}
        for byte, value in numbers.items():
            _put(header, standard_field(byte), value)
        _put(header, FIELDS["scalar"], -scale if scale > 1 else 1)
        _put(header, FIELDS["x"], position)
    return headers


def _copied_general(original: TraceHeaders) -> bytearray:
    """The binary header with the original's numbers of the line, big-endian."""
    with original.layout.path.open("rb") as file:
        file.seek(original.layout.label)
        content: bytes | bytearray = file.read(HEADERS)
    if original.layout.endian == "little":
        content = _swapped(content, dict.fromkeys(GENERAL_LONG, 4) | dict.fromkeys(range(3213, 3261, 2), 2))
    general = bytearray(HEADERS - TEXT)
    for first, end in COPIED:
        general[first - 1 - TEXT : end - 1 - TEXT] = content[first - 1 : end - 1]
    return general


def _swapped(content: bytes | bytearray, sizes: Mapping[int, int]) -> bytearray:
    """Reverse the bytes of each number, given its first byte and its size."""
    swapped = bytearray(content)
    for byte, size in sizes.items():
        swapped[byte - 1 : byte - 1 + size] = content[byte - 1 : byte - 1 + size][::-1]
    return swapped


def _header_sizes(fields: Mapping[str, HeaderField]) -> dict[int, int]:
    """First byte and size of all numbers of a trace header; the user's fields take precedence."""
    sizes = {field.byte: field.size for field in fields.values()}
    taken = {byte for first, size in sizes.items() for byte in range(first, first + size)}
    standard = dict.fromkeys((*LONG, *LONG_FREE), 4) | dict.fromkeys((*SHORT, *range(201, 240, 2)), 2)
    for first, size in sorted(standard.items(), key=lambda item: -item[1]):
        if taken.isdisjoint(range(first, first + size)):
            sizes[first] = size
            taken.update(range(first, first + size))
    return sizes


def _copied_headers(
    section: Section, original: TraceHeaders, selected: Line, x0: float, path: Path
) -> Iterator[bytearray]:
    """Headers of the original's traces; beyond its ends and in its gaps with numbers and positions continued."""
    fields = original.fields
    sizes = _header_sizes(fields) if original.layout.endian == "little" else {}
    continued = {*map(standard_field, NUMBERS), *(fields[name] for name in ("inline", "crossline", "x", "y"))}
    for column in np.rint((section.x - x0) / section.dx).astype(int).tolist():
        index = selected.index_before(column)
        header = _swapped(original.header(int(selected.traces[index])), sizes)
        beyond = column - int(selected.columns[index])
        if beyond:
            other = index - 1 if index else 1
            neighbour = bytes(_swapped(original.header(int(selected.traces[other])), sizes))
            share = beyond / int(selected.columns[index] - selected.columns[other])
            _continue(header, neighbour, share, continued, path)
        yield header


def _continue(header: bytearray, neighbour: bytes, share: float, fields: set[HeaderField], path: Path) -> None:
    """Continue the numbers of a header in steps like those from its neighbour."""
    for field in fields:
        if field.kind in CODES:
            value = _number(header, field)
            value += share * (value - _number(neighbour, field))
            try:
                _put(header, field, value if field.kind in ("f4", "f8") else round(value))
            except (struct.error, OverflowError) as error:
                raise SettingError(
                    f"{path}: the numbers or positions of the line, continued beyond its ends, are too large for "
                    "SEG-Y; leave out ",
                    LIKE,
                ) from error


def _textual_header(lines: Sequence[str], section: Section, restored: Restoration | None) -> bytes:
    """Forty lines of 80 characters: the original's, with a note about this file in empty lines or the last ones."""
    from seiswidgets import __version__

    texts = [line[4:].ljust(76)[:76] if line[:1] == "C" else line.ljust(76)[:76] for line in lines]
    texts = (texts + [" " * 76] * 40)[:40]
    action = "RESTORED" if restored and restored.stages else "WRITTEN"
    notes = [
        f"{action} BY SEISWIDGETS {__version__}: AN INTERPRETATION, NOT A MEASUREMENT.",
        f"ZERO WHERE THERE ARE NO DATA. SECTION: {section.name}",
        *([f"STAGES: {stages_as_line(restored)}"] if restored and restored.stages else []),
    ]
    blank = [index for index, text in enumerate(texts) if not text.strip()]
    free = blank[: len(notes)] if len(blank) >= len(notes) else range(40 - len(notes), 40)
    for index, note in zip(free, notes, strict=True):
        texts[index] = note
    header = "".join(f"C{count:02} {text[:76].ljust(76)}" for count, text in enumerate(texts, 1))
    printable = "".join(letter if letter.isprintable() else " " for letter in header)
    return printable.encode("ascii", "replace").decode("ascii").encode("cp500")
