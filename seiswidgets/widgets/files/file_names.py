"""Names from users and their files as names of files."""

import re

LONGEST = 80


def file_name(name: str, otherwise: str) -> str:
    """A name with nothing in it that the name of a file could mean something else by; another where nothing is left."""
    last = re.split(r"[/\\]", name)[-1]
    return re.sub(r"[^\w .()+-]", "_", last)[-LONGEST:].strip(" .") or otherwise
