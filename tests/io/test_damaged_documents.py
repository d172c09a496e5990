"""Files of picks and sessions, damaged at random: each opens, or gives an error of ours that names it."""

import time
import warnings

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import SeiswidgetsError
from tests.io.test_picks import (
    CHARISMA_FAULT,
    CHARISMA_HORIZON,
    CPS3,
    MULTI_LINE_HEADER,
    OPENDTECT_FAULT,
    OPENDTECT_HORIZON,
    SIMPLE,
    TIME,
)

EACH = 110  # mutations of each kind of file
EVIL = [
    *(b"NaN", b"Infinity", b"-inf", b"nan", b"1e999", b"1e308", b"-1e308", b"9" * 400, b"9" * 5000, b"0x10", b"1_0"),
    *(b"null", b"true", b'""', b"\\ud800", b"\\u0000", b"[" * 100_000, b'{"a":' * 50_000, b"[]", b"{}", b"-", b"->"),
    *(b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", b"\r", b"\n" * 1000, b'"', b"'", b",", b"\t", b"../../etc/passwd"),
    *("é☃".encode(), b"\xed\xa0\x80", b" " * 100_000, b'"' * 100_001),
]
EXPORT = {"x_unit": "m", "along": "x"}
EXPORTS = {
    "opendtect-horizons": (OPENDTECT_HORIZON, {"line": "L 1"}),
    "opendtect-horizons ": (MULTI_LINE_HEADER, {}),
    "opendtect-faults": (OPENDTECT_FAULT, {"line": "L 1", "z_unit": "ms"}),
    "charisma-horizons": (CHARISMA_HORIZON, {"line": "inline 362", "z_unit": "ms"}),
    "charisma-faults": (CHARISMA_FAULT, {"line": "inline 370", "z_unit": "ms"}),
    "cps3-faults": (CPS3, {"z_unit": "ms"}),
}


def mutated(rng, content):
    """A file's content with one to three kinds of damage."""
    for _ in range(rng.integers(1, 4)):
        at, to = sorted(rng.integers(0, len(content) + 1, 2))
        to = min(to, at + rng.integers(1, 200))
        damage = rng.integers(0, 7)
        if damage == 0:
            content = content[:at]
        elif damage == 1:
            flipped = bytearray(content)
            for place in rng.integers(0, max(1, len(content)), rng.integers(1, 20)):
                flipped[place : place + 1] = bytes(rng.integers(0, 256, 1, dtype=np.uint8))
            content = bytes(flipped)
        elif damage == 2:
            content = content[:at] + EVIL[rng.integers(len(EVIL))] + content[to:]
        elif damage == 3:
            content = with_evil_number(rng, content)
        elif damage == 4:
            content = content[:at] + content[at:to] * rng.integers(2, 50) + content[to:]
        elif damage == 5:
            content = content[:at] + content[to:]
        else:
            content = content.decode("latin-1").encode(["utf-16", "utf-7", "cp500", "utf-8"][rng.integers(4)])
    return content


def with_evil_number(rng, content):
    """With something else in the place of one of the numbers."""
    places = [place for place, letter in enumerate(content) if letter in b"0123456789"]
    if not places:
        return content
    start = end = places[rng.integers(len(places))]
    while end < len(content) and content[end] in b"0123456789.eE+-":
        end += 1
    return content[:start] + EVIL[rng.integers(len(EVIL))] + content[end:]


def outcome(path, content, read):
    """Read a damaged file; check the error, the time, and that the file is left alone."""
    path.write_bytes(content)
    begun = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of points that stand alone
            read(path)
        message = None
    except SeiswidgetsError as error:
        message = str(error)
    assert message is None or (str(path) in message and len(message) < 2000)
    assert time.process_time() - begun < 2
    assert path.read_bytes() == content
    assert len(list(path.parent.iterdir())) == 1
    return message is None


def check(path, content, read, seed):
    """Many mutations of one file; some must open and most must not, or the test would show nothing."""
    rng = np.random.default_rng(seed)
    assert outcome(path, content, read)
    opened = sum(outcome(path, mutated(rng, content), read) for _ in range(EACH))
    assert 0 < opened < EACH


@pytest.mark.parametrize("name", ["a.geojson", "a.csv"])
def test_our_picks(tmp_path, name):
    sw.write_picks(SIMPLE, tmp_path / name, TIME)
    check(tmp_path / name, (tmp_path / name).read_bytes(), lambda path: sw.read_picks(path, TIME), seed=1)


@pytest.mark.parametrize("kind", EXPORTS)
def test_exports(tmp_path, kind):
    text, choices = EXPORTS[kind]
    choices = {**EXPORT, **choices, "format": kind.strip()}
    check(tmp_path / "export.dat", text.encode(), lambda path: sw.read_picks(path, TIME, **choices), seed=2)


def test_sessions(tmp_path):
    looks = {("fault", "F1"): {"colour": "#123", "visible": False}}
    source = sw.SectionSource("file", str(tmp_path / "line.npz"), {"dx": 12.5})
    sw.Session.of(TIME, source, SIMPLE, (5.0, 5.0), looks=looks).save(tmp_path / "session.json")

    def read(path):
        session = sw.open_session(path)
        assert isinstance(session.interpretation, sw.Interpretation)

    check(tmp_path / "session.json", (tmp_path / "session.json").read_bytes(), read, seed=3)
