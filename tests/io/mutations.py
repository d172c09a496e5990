"""Opens files that were damaged in many ways, in a process of its own: run by test_damaged_sections.py.

Prints, for each sound file, how many of its mutations opened, how many were refused, the slowest in seconds of work,
and the memory in kB that they took beside what a sound file takes.
"""

import json
import sys
import time
import warnings
from pathlib import Path

import numpy as np
from memory import peak

import seiswidgets as sw

CHOICES = {"dx": 10.0, "dz": 4.0, "z_unit": "m"}
EXTREMES = [
    bytes(4),
    b"\xff" * 4,
    b"\x7f\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\x80\0\0\0",
    b"\0\0\xff\xff",
    b"\x7f\x80\0\0",
]
WORDS = [b"nan", b"inf", b"-1e999", b"\xc3\x28", b"\xff\xfe", b"\0", b"9" * 20, b"(9999999, 9999999)", b"'O'", b"\n\n"]


def mutated(content, random):
    """A file's content with one thing wrong: cut short, bits flipped, a count made huge, a word put in, or doubled."""
    where = int(random.integers(len(content)))
    near = int(random.integers(min(len(content), 4000)))  # most of what can be misread is near the beginning
    kind = random.integers(6)
    if kind == 0:
        return content[:where]
    if kind == 1:
        flipped = bytearray(content)
        for place in random.integers(len(content), size=random.integers(1, 9)):
            flipped[place] ^= 1 << random.integers(8)
        return bytes(flipped)
    if kind == 2:
        flipped = bytearray(content)
        flipped[near] = random.integers(256)
        return bytes(flipped)
    if kind == 3:
        extreme = EXTREMES[random.integers(len(EXTREMES))][: random.choice([2, 4])]
        return content[:near] + extreme + content[near + len(extreme) :]
    if kind == 4:
        word = WORDS[random.integers(len(WORDS))]
        return content[:near] + word + content[near + len(word) * random.integers(2) :]
    return content[:where] + content[near:]


def outcome(path, choices):
    """True if a file opens, or its error is one of ours that names the file and says what to do."""
    for act in (sw.preview, lambda path: sw.open_section(path, **choices)):
        try:
            act(path)
        except (sw.DataError, sw.SettingError) as error:
            said = str(error)
            if str(path) not in said or len(said) < len(str(path)) + 30:
                raise AssertionError(f"{error!r} does not say what and where") from error
            refused = True
        else:
            refused = False
    return refused


def main(sound, count, seed):
    warnings.filterwarnings(
        "ignore", r".* pages, of which only the first is read"
    )  # as what is doubled may seem to have
    choices = {"inline": 11, "z_unit": "m"} if sound.suffix == ".inline" else CHOICES
    content, random = sound.read_bytes(), np.random.default_rng(seed)
    assert not outcome(sound, choices), f"{sound} is sound"
    damaged, refused, slowest = sound.with_name(f"damaged{sound.suffix}"), 0, 0.0
    before = peak()
    for number in range(count):
        damaged.write_bytes(mutated(content, random))
        start = time.process_time()
        try:
            refused += outcome(damaged, choices)
        except Exception as error:
            raise AssertionError(f"mutation {number} of {sound.name} gave {error!r}") from error
        slowest = max(slowest, time.process_time() - start)
    memory = peak() - before
    return {"refused": refused, "opened": count - refused, "slowest": slowest, "memory": memory}


if __name__ == "__main__":
    count, *files = sys.argv[1:]
    print(json.dumps({name: main(Path(name), int(count), seed) for seed, name in enumerate(files)}))
