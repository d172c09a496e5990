"""Plausibility of the sample format: amplitudes show whether they were stored in the format that the header states."""

from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import Keyword, Text
from seiswidgets.io.segy.formats import FORMATS, SampleFormat
from seiswidgets.io.segy.traces import TraceHeaders

TRACES, SAMPLES = 32, 2000  # that are compared: traces, and samples in the middle of each
FEWEST = 8  # samples of a trace, without which nothing is concluded
ENOUGH = 50  # different amplitudes, without which nothing is concluded
PLAUSIBLE = (1e-18, 1e18)  # size of an amplitude
MOST_IMPLAUSIBLE = 0.02  # share of the amplitudes
SMOOTHER = 1.5  # times smoother traces show another format
NOISE = 1.2  # roughness above which traces are noise in any format (white noise has the square root of 6)
MANTISSA_STARTS_AT_0 = 0.01  # share of the amplitudes: about 0.08 for IEEE floats, 0 for IBM floats
GAPS = 10  # amplitudes on either side of a gap that only IBM floats have
ALTERNATIVES = {"ibm": ("f4", "i4"), "f4": ("ibm", "i4"), "i4": ("f4", "ibm"), "i2": ("u2",), "u2": ("i2",)}
ALTERNATIVES |= {"i1": ("u1",), "u1": ("i1",), "u4": ("i4", "f4", "ibm")}
FLOATS_AS_INTEGERS = 2**28  # size that nearly all floats have if they are read as integers


@dataclass(frozen=True)
class FormatDoubt:
    """Another sample format than the header states, which the amplitudes show.

    Attributes
    ----------
    stated, likely : str
        Names of the formats, as for ``open_section``.
    text : Text
        The reason, and the keyword to give.
    """

    stated: str
    likely: str
    text: Text


def format_doubt(headers: TraceHeaders, traces: np.ndarray) -> FormatDoubt | None:
    """Compare the sample format with others of the same size; None if it is plausible."""
    layout = headers.layout
    stated = FORMATS[layout.code]
    if stated.name not in ALTERNATIVES or layout.samples < FEWEST:
        return None
    start = max(0, (layout.samples - SAMPLES) // 2)
    chosen = traces[np.unique(np.linspace(0, len(traces) - 1, TRACES).astype(int))].tolist()
    part = slice(start, min(start + SAMPLES, layout.samples))

    def read(name: str, order: str = layout.sample_order) -> np.ndarray:
        return np.array([headers.samples(trace, part, order, name) for trace in chosen])

    bits = read(f"u{stated.size}")
    if len(np.unique(bits)) < ENOUGH:
        return None
    values = {name: _live(read(name), bits) for name in (stated.name, *ALTERNATIVES[stated.name])}
    if stated.size > 1:
        other_order = "<" if layout.sample_order == ">" else ">"
        values[other_order + stated.name] = _live(read(stated.name, other_order), bits)
    likely = _likely_format(stated.name, bits, values)
    return None if likely is None else FormatDoubt(stated.name, likely, _doubt_text(headers, stated, likely, values))


def _live(values: np.ndarray, bits: np.ndarray) -> np.ndarray:
    """Amplitudes as float64, without the traces that hold zeros only."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(values[bits.any(axis=1)], float)


def _likely_format(stated: str, bits: np.ndarray, values: dict[str, np.ndarray]) -> str | None:
    """Name of the likelier format among ``values``; None if the stated one is as likely."""
    if stated == "ibm" and _is_plausible(values["f4"]) and _has_gapless_mantissas(bits):
        return "f4"
    if stated == "f4" and _is_plausible(values["ibm"]) and not _has_gapless_mantissas(bits):
        smoother = _roughness(values["f4"]) > SMOOTHER * _roughness(values["ibm"])
        if smoother or _has_gaps_of_ibm(bits):
            return "ibm"
    others = [name for name in values if name != stated and _is_plausible(values[name])]
    if not others:
        return None
    best = min(others, key=lambda name: (_roughness(values[name]), name == "ibm"))
    if best == "f4" and "ibm" in others and not _has_gapless_mantissas(bits):
        best = "ibm"
    if not _is_plausible(values[stated]) or (stated in ("i4", "u4") and best != "i4" and _are_floats(values[stated])):
        return best
    rough = _roughness(values[stated])
    return best if rough > 2 * SMOOTHER * _roughness(values[best]) and _roughness(values[best]) < NOISE else None


def _is_plausible(values: np.ndarray) -> bool:
    """Check whether nearly all amplitudes have a size that a survey may have."""
    sizes = np.abs(values[values != 0])
    outside = ~((sizes >= PLAUSIBLE[0]) & (sizes <= PLAUSIBLE[1]))  # NaN is outside, too
    return bool(outside.mean() <= MOST_IMPLAUSIBLE) if len(sizes) else True


def _are_floats(integers: np.ndarray) -> bool:
    """Check whether integers of four bytes are the bits of floats of common sizes, without any value near 0."""
    sizes = np.abs(integers[integers != 0])
    return bool(np.mean(sizes >= FLOATS_AS_INTEGERS) > 1 - MOST_IMPLAUSIBLE)


def _roughness(values: np.ndarray) -> float:
    """Second differences along the traces, relative to the variation; at least 0.01, infinite if they overflow."""
    with np.errstate(all="ignore"):
        size = np.std(values)
        rough = np.sqrt(np.mean(np.diff(values, 2, axis=1) ** 2)) / size
    return max(float(rough), 0.01) if np.isfinite(rough) else np.inf


def _has_gapless_mantissas(bits: np.ndarray) -> bool:
    """Check for amplitudes whose bits 20 to 23 are 0: an IBM float, whose fraction begins there, has none."""
    counts = _counts(bits).sum(axis=0)
    share = counts[0] / counts.sum()
    return bool(MANTISSA_STARTS_AT_0 <= share <= 0.5)


def _has_gaps_of_ibm(bits: np.ndarray) -> bool:
    """Check whether amplitudes leave out bits 20 to 23 equal to 0 but have those before and after, as IBM floats do."""
    counts = _counts(bits)
    around = np.minimum(counts[:-1, 15], counts[1:, 1])
    return bool(around.sum() >= GAPS and not counts[1:][around > 0, 0].any())


def _counts(bits: np.ndarray) -> np.ndarray:
    """Number of different amplitudes by bits 24 to 30 and bits 20 to 23, shape (128, 16)."""
    sizes = np.unique(bits & 0x7FFFFFFF)
    return np.bincount(sizes[sizes > 0] >> 20, minlength=2048).reshape(128, 16)


def _doubt_text(headers: TraceHeaders, stated: SampleFormat, likely: str, values: dict[str, np.ndarray]) -> Text:
    words = next((each.words for each in FORMATS.values() if each.name == likely), "numbers in the other byte order")

    def reach(name: str) -> str:
        return f"{np.nanmin(values[name]):.3g} to {np.nanmax(values[name]):.3g}"

    return Text(
        f"{headers.layout.path} has samples of the format {stated.words} (bytes 3225-3226), but they look like "
        f"{words}: read so they run from {reach(likely)}, otherwise from {reach(stated.name)}; give ",
        Keyword("sample_format", likely),
        ", or, if the header is right, ",
        Keyword("sample_format", stated.name),
    )
