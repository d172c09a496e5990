"""Assignments for a class: a synthetic section for each student, whose truth only the teacher's key tells."""

import re
import unicodedata
from dataclasses import replace
from hashlib import sha256

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.forward_model import Synthetic
from seiswidgets.geology.section import Section
from seiswidgets.geology.synthetic import faulted_fold

PRACTICE = "practice"
DEPTHS = 750.0, 1050.0, 1400.0  # of the three horizons at the left edge, the same for everybody


def assignment(name: str, course: str = PRACTICE) -> Section:
    """The section of a student's assignment: a dome cut by a normal fault, with a throw and beds of its own.

    The strong reflectors H1, H2 and H3 are at 750, 1050 and 1400 m at the left edge, for everybody. The same name and
    course always give the same section; letter case and spaces do not matter.

    Parameters
    ----------
    name : str
    course : str
        Any text, the same for all students of a class.

    Raises
    ------
    SettingError
        If the name is empty.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> sw.assignment("Ada Lovelace").shape
    (401, 321)
    """
    return assigned_case(name, course).section


def assigned_case(name: str, course: str) -> Synthetic:
    """The section of an assignment with its picks and its true history, for the teacher."""
    seed = int.from_bytes(sha256(f"{course}\n{file_stem(name)}".encode()).digest()[:8], "big")
    rng = np.random.default_rng(seed)
    throw, amplitude = rng.uniform(70, 190), rng.uniform(80, 240)
    case = faulted_fold(throw, amplitude, DEPTHS, seed=int(rng.integers(2**31)), noise=0.2)
    rounded = np.round(case.section.amplitude.astype(float), 3).astype(np.float32)  # the same bits on every computer
    return replace(case, section=replace(case.section, amplitude=rounded, name=f"assignment of {name.strip()}"))


def file_stem(name: str) -> str:
    """A name as the stem of a file, such as ``ada-lovelace``.

    Raises
    ------
    SettingError
        If it has no letter or digit.
    """
    words = re.findall(r"\w+", unicodedata.normalize("NFKC", str(name)).casefold())
    if not words:
        raise SettingError(
            f"an assignment needs a student's name, but got {name!r}; write your name between the quotes"
        )
    return "-".join(words)
