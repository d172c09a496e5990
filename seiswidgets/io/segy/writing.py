"""Writing of SEG-Y: amplitudes as IEEE floats, the original's headers, and a note that the section was restored."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.io.exports.reports import stages_as_line
from seiswidgets.io.files import atomic_write, import_optional
from seiswidgets.io.options import OpenOptions
from seiswidgets.io.segy.layout import Layout
from seiswidgets.io.segy.lines import line
from seiswidgets.io.segy.reading import open_headers
from seiswidgets.io.segy.traces import BYTES

THOUSANDTHS = {"ms": 1000, "s": 1_000_000, "m": 1000, "km": 1_000_000, "ft": 1000}  # of a millisecond, metre or foot
LIVE, DEAD = 1, 2
LIKE = Keyword("like")  # as errors name it
COPIED = {
    *range(3201, 3217),
    *range(3227, 3261),
}  # bytes of the binary header that are copied
NUMBERS = (1, 5, 21)  # trace number in the line and in the file, and number of its common depth point
REVISION = b"\1\0\0\1\0\0"  # 1.0, traces of equal length, no further textual headers
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
    segyio = import_optional("segyio", f"to write {path}")
    _check_samples(section, path)
    vertical = _vertical(section, path)
    if like is None:
        text, general, headers = [""] * 40, {3255: 2 if section.x_unit == "ft" else 1}, _own_headers(section, path)
    else:
        with open_headers(like, options) as original:
            text = original.layout.text.split("\n")
            traces = line(original, options, None)
            with _open_with_segyio(segyio, original.layout) as file:
                general = {int(byte): value for byte, value in file.bin.items() if byte in COPIED}
                headers = _copied_headers(
                    section, file, original.first_bytes, traces, options.keywords.get("x0") or 0.0
                )
    spec = segyio.spec()
    spec.samples, spec.tracecount, spec.format = np.arange(section.shape[0]), section.shape[1], 5
    with atomic_write(path) as draft:
        with segyio.create(draft, spec) as file:
            file.text[0] = _textual_header(text, section, restored)
            file.bin = general | {3217: vertical[117], 3219: vertical[117]}
            for index, (trace, header) in enumerate(zip(section.amplitude.T, headers, strict=True)):
                _put_header(file, index, header | vertical | {115: section.shape[0], 29: _state(trace)}, path)
                file.trace[index] = np.nan_to_num(np.ascontiguousarray(trace, np.float32))
        with draft.open("r+b") as written:  # versions of segyio differ in how they write these
            written.seek(3500)
            written.write(REVISION)


def _open_with_segyio(segyio: ModuleType, layout: Layout) -> Any:
    """Open the original with segyio, which must understand its headers in the same way."""
    try:
        file = segyio.open(layout.path, ignore_geometry=True, endian=layout.endian)
    except (OSError, RuntimeError, ValueError) as error:
        raise DataError(f"{layout.path} has headers that cannot be copied: {error}; leave out ", LIKE) from error
    if (file.tracecount, len(file.samples)) != (layout.traces, layout.samples):
        file.close()
        raise DataError(
            f"{layout.path} has headers that can be read in two ways ({layout.traces} traces of {layout.samples} "
            "samples, or otherwise), and cannot be copied; leave out ",
            LIKE,
        )
    return file


def _put_header(file: Any, index: int, header: Mapping[int, int], path: Path) -> None:
    try:
        file.header[index] = header
    except OverflowError as error:
        raise SettingError(
            f"{path}: the numbers or positions of the line, continued beyond its ends, are too large for SEG-Y; leave "
            "out ",
            LIKE,
        ) from error


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


def _own_headers(section: Section, path: Path) -> list[dict[int, int]]:
    """Headers of a line along the axis of x, with positions in thousandths of a metre or foot if these fit."""
    x = section.x * (1000 if section.x_unit == "km" else 1)
    scale = next((scale for scale in (1000, 100, 10, 1) if np.abs(x).max() * scale <= LARGEST_INTEGER), None)
    if scale is None:
        raise SettingError(f"{path}: SEG-Y cannot hold positions as far out as {np.abs(x).max():g} m; save it as .npz")
    scalar = -scale if scale > 1 else 1
    return [
        {**dict.fromkeys(NUMBERS, count), BYTES["scalar"]: scalar, BYTES["x"]: position, 89: 1}
        for count, position in enumerate(np.rint(x * scale).astype(int).tolist(), 1)
    ]


def _copied_headers(
    section: Section, file: Any, positions: Mapping[str, int], traces: np.ndarray, x0: float
) -> list[dict[int, int]]:
    """Headers of the original's traces; beyond its ends the last ones, with numbers and positions continued."""
    columns = np.rint((section.x - x0) / section.dx).astype(int)
    continued = [*NUMBERS, *(positions[name] for name in ("inline", "crossline", "x", "y"))]
    headers = []
    for column in columns:
        inside = int(np.clip(column, 0, len(traces) - 1))
        header = dict(file.header[int(traces[inside])])
        if column != inside:
            neighbour = file.header[int(traces[1 if inside == 0 else inside - 1])]
            beyond = abs(column - inside)
            header |= {byte: header[byte] + int(beyond) * (header[byte] - neighbour[byte]) for byte in continued}
        headers.append({int(byte): value for byte, value in header.items()})
    return headers


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
    return "".join(letter if letter.isprintable() else " " for letter in header).encode("ascii", "replace")
