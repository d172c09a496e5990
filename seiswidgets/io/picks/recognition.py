"""Formats of exports, recognised by their headers and marks, so that none is read as another."""

import re
from pathlib import Path

from seiswidgets.errors import DataError, Keyword

BEGINNING = 4000  # characters that are searched
SIGNS = {  # of the programs' formats, by the first word of their names here; MULTILINE
    "iesx": r"^(PROFILE\s|SNAPPING PARAMETERS|EOD)",
    "petrel": r"^(# Petrel Points|BEGIN HEADER)",
    "earthvision": r"^# *(Type: *scattered data|Field: *\d)",
    "dug": r"^# *(subgrid|vertical_dimension|vertical_unit)=",
    "charisma": r"^(?!#)[^\n]*\bI(N)?LINE\s*[:-]?\s*-?\d",
    "cps3": r"^(FFASCI|FFATTR|->)",
}
WORDS = {
    "iesx": "IESX (GeoFrame)",
    "petrel": "Petrel's points with attributes",
    "earthvision": "EarthVision",
    "dug": "DUG Insight",
    "charisma": "Charisma",
    "cps3": "CPS-3",
    "opendtect": "OpendTect",
    "kingdom": "Kingdom",
    "geographix": "GeoGraphix",
}
OTHERS = {  # that cannot be read
    "a CPS-3 grid": r"^FSASCI",
    "a ZMAP+ grid": r"^@[^\n]*,|^! *ZMAP",
    "an Irap classic grid": r"\A\s*-996\s",
    "GOCAD": r"^GOCAD\s",
    "a Surfer grid": r"\A(DSAA|DSBB|DSRB)",
    "LAS": r"^~V",
    "JSON": r"\A\s*[{\[]",
    "the CSV of seiswidgets": r"\Akind,name,piece",
    "WinPICS or SeisWare (HAS)": r"^#3D_GRIDNAME",
}


def recognised(text: str) -> str | None:
    """First word of the format that a text is in, or what it looks like if it cannot be read; None if unclear."""
    beginning = text[:BEGINNING]
    for names in (OTHERS, SIGNS):
        for name, sign in names.items():
            if re.search(sign, beginning, re.MULTILINE | (re.IGNORECASE if name == "charisma" else 0)):
                return name
    return None


def refuse_other_formats(path: Path, text: str, family: str, kind: str, known: tuple[str, ...]) -> None:
    """Raise DataError if a text shows the marks of another format than ``family-kind``; ``known`` can be read."""
    found = recognised(text)
    if found is None or found == family:
        return
    if found in OTHERS:
        raise DataError(f"{path} looks like {found}, not like {WORDS[family]}; export the picks in one of its formats")
    names = [name for name in known if name.startswith(found)]
    name = next((name for name in names if name.endswith(kind)), names[0])
    raise DataError(f"{path} looks like {WORDS[found]}, not like {WORDS[family]}; give ", Keyword("format", name))
