"""Which process saves its work under a session's path: it says so in a small file beside it, ``.<name>.owner``."""

import contextlib
import json
import os
import socket
import uuid
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.files import write_file

OURS = uuid.uuid4().hex  # of this process


@dataclass(frozen=True)
class Owner:
    """A process that saves under a path, on a host, since a time."""

    key: str
    host: str
    process: int
    since: str

    @property
    def is_alive(self) -> bool:
        """False if the process has ended; one on another host is taken to be alive, as is any on Windows."""
        if self.host != socket.gethostname() or os.name == "nt":
            return True
        try:
            os.kill(self.process, 0)  # only asks whether it exists
        except ProcessLookupError:
            return False
        except OSError:
            pass  # it belongs to another user
        return True

    def __str__(self) -> str:
        return f"process {self.process} on {self.host}, since {self.since}"


def other_owner(path: Path) -> Owner | None:
    """The other process that saves under a path, unless it has ended; None if there is none."""
    owner = _owner(path)
    return owner if owner is not None and owner.key != OURS and owner.is_alive else None


def claim(path: Path) -> None:
    """Make this process the owner of a path; another one that was it can see that. A full disk prevents it silently."""
    owner = Owner(OURS, socket.gethostname(), os.getpid(), f"{datetime.now():%d %b %Y, %H:%M}")
    with contextlib.suppress(DataError):  # saving will say so
        write_file(_file(path), json.dumps(asdict(owner)).encode())


def release(path: Path) -> None:
    """Give up the ownership of a path, if this process has it."""
    owner = _owner(path)
    if owner is not None and owner.key == OURS:
        with contextlib.suppress(OSError):
            _file(path).unlink()


def _file(path: Path) -> Path:
    return path.with_name(f".{path.name}.owner")


def _owner(path: Path) -> Owner | None:
    """Owner of a path; None if there is none, or its file is damaged."""
    try:
        owner = Owner(**json.loads(_file(path).read_text("utf-8")))
    except (OSError, ValueError, TypeError):
        return None
    return owner if type(owner.process) is int and owner.process > 0 else None
