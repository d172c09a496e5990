"""SEG-Y out: amplitudes as IEEE floats, headers carried from the original, and a word on what this is."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.io.exports.reports import stages_as_line
from seiswidgets.io.files import atomic_write, import_optional
from seiswidgets.io.options import OpenOptions
from seiswidgets.io.segy.lines import BYTES, line
from seiswidgets.io.segy.reading import trace_headers

THOUSANDTHS = {"ms": 1000, "s": 1_000_000, "m": 1000, "km": 1_000_000, "ft": 1000}  # of a millisecond, metre or foot
LIVE, DEAD = 1, 2
CARRIED = {*range(3201, 3217), *range(3227, 3261)}  # of the binary header: what is not of this file's own form
NUMBERS = (1, 5, 21)  # of the trace in its line and in the file, and of its common depth point
MOST, MOST_SAMPLES = 2**31 - 1, 2**16 - 1


def write_segy(section: Section, path: Path, done: Restoration | None, like: Path | None, choices: OpenOptions):
    """Write a section as SEG-Y; ``done`` is the restoration that it is from.

    Raises
    ------
    SettingError
        If SEG-Y cannot hold the section's size, spacing or amplitudes, or its line goes on to numbers too large.
    DataError
        If the file cannot be written, or ``like`` cannot be read.
    """
    segyio = import_optional("segyio", f"to write {path}")
    _check_samples(section, path)
    vertical = _vertical(section, path)
    if like is None:
        text, general, headers = [""] * 40, {3255: 2 if section.x_unit == "ft" else 1}, _own_headers(section, path)
    else:
        with trace_headers(like, choices) as original:
            text = original.layout.text.split("\n")
            general = {int(byte): value for byte, value in original.file.bin.items() if byte in CARRIED}
            headers = _carried_headers(section, original, line(original, choices, None), choices.keywords.get("x0"))
    spec = segyio.spec()
    spec.samples, spec.tracecount, spec.format = np.arange(section.shape[0]), section.shape[1], 5
    with atomic_write(path) as draft, segyio.create(draft, spec) as file:
        file.text[0] = _textual_header(text, section, done)
        file.bin = general | {3217: vertical[117], 3219: vertical[117], 3501: 256}
        for number, (trace, header) in enumerate(zip(section.amplitude.T, headers, strict=True)):
            _put_header(file, number, header | vertical | {115: section.shape[0], 29: _state(trace)}, path)
            file.trace[number] = np.nan_to_num(np.ascontiguousarray(trace, np.float32))


def _put_header(file, number, header, path):
    try:
        file.header[number] = header
    except OverflowError as error:
        raise SettingError(
            f"{path}: the numbers or positions of the line, carried on beyond its ends, are too large for SEG-Y; leave "
            "like= out"
        ) from error


def _state(trace):
    return DEAD if np.isnan(trace).all() else LIVE


def _check_samples(section, path):
    largest = np.nanmax(np.abs(section.amplitude))
    if section.shape[0] > MOST_SAMPLES or largest > np.finfo(np.float32).max:
        raise SettingError(
            f"{path}: SEG-Y holds {MOST_SAMPLES:,} samples a trace, of up to 3.4e38, but this section has "
            f"{section.shape[0]:,}, of up to {largest:.3g}; save it as .npz"
        )


def _vertical(section, path):
    """Sample interval, and where the first sample is, as the trace header has them."""
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
    raise SettingError(
        f"{path}: SEG-Y cannot hold that the first sample is at {section.z0:g} {section.z_unit}; save it as .npz"
    )


def _own_headers(section, path):
    """Headers of a line along the axis of x, its positions in thousandths of a metre or foot where they have room."""
    x = section.x * (1000 if section.x_unit == "km" else 1)
    scale = next((scale for scale in (1000, 100, 10, 1) if np.abs(x).max() * scale <= MOST), None)
    if scale is None:
        raise SettingError(f"{path}: SEG-Y cannot hold places as far out as {np.abs(x).max():g} m; save it as .npz")
    scalar = -scale if scale > 1 else 1
    return [
        {**dict.fromkeys(NUMBERS, number), BYTES["scalar"]: scalar, BYTES["x"]: place, 89: 1}
        for number, place in enumerate(np.rint(x * scale).astype(int).tolist(), 1)
    ]


def _carried_headers(section, original, traces, x0):
    """Headers of the original's traces; beyond its ends the last ones, their numbers and positions carried on."""
    places = np.rint((section.x - x0) / section.dx).astype(int)
    run_on = [*NUMBERS, *(original.bytes[name] for name in ("inline", "crossline", "x", "y"))]
    found = []
    for place in places:
        inside = int(np.clip(place, 0, len(traces) - 1))
        header = dict(original.file.header[int(traces[inside])])
        if place != inside:
            neighbour = original.file.header[int(traces[1 if inside == 0 else inside - 1])]
            beyond = abs(place - inside)
            header |= {byte: header[byte] + int(beyond) * (header[byte] - neighbour[byte]) for byte in run_on}
        found.append({int(byte): value for byte, value in header.items()})
    return found


def _textual_header(lines, section, done):
    """Forty lines of 80 letters: those of the original, and in empty ones, or the last, what this file is."""
    from seiswidgets import __version__

    texts = [line[4:].ljust(76)[:76] if line[:1] == "C" else line.ljust(76)[:76] for line in lines]
    texts = (texts + [" " * 76] * 40)[:40]
    did = "RESTORED" if done and done.stages else "WRITTEN"
    words = [
        f"{did} BY SEISWIDGETS {__version__}: AN INTERPRETATION, NOT A MEASUREMENT.",
        f"ZERO WHERE THERE ARE NO DATA. SECTION: {section.name}",
        *([f"STAGES: {stages_as_line(done)}"] if done and done.stages else []),
    ]
    blank = [number for number, text in enumerate(texts) if not text.strip()]
    places = blank[: len(words)] if len(blank) >= len(words) else range(40 - len(words), 40)
    for place, word in zip(places, words, strict=True):
        texts[place] = word
    lines = "".join(f"C{number:02} {text[:76].ljust(76)}" for number, text in enumerate(texts, 1))
    return "".join(letter if letter.isprintable() else " " for letter in lines).encode("ascii", "replace")
