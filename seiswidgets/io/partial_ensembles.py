"""Members of an unfinished ensemble in a file, from which a later run continues.

The file is a line of text with the version and the fingerprint of the run, and one record for each member: its
length, its checksum, and its arrays as NumPy writes them. Records are only appended. A record that a crash has cut
short is left out, and overwritten.
"""

import errno
import io
import struct
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

import numpy as np

from seiswidgets import __version__
from seiswidgets.errors import DataError
from seiswidgets.geology.ensembles.member import Member
from seiswidgets.io.files import write_file

HEADER = f"seiswidgets {__version__} ensemble {{}}\n"
RECORD = struct.Struct("<II")  # length and checksum
LARGEST = 2**28  # bytes of a record: more is damage


class PartialEnsemble:
    """The file of an unfinished ensemble, open for appending; a context manager.

    Parameters
    ----------
    path : Path
    fingerprint : str
        Of the inputs of the run.

    Attributes
    ----------
    members : list of Member
        Those that the file held when it was opened.

    Raises
    ------
    DataError
        If the file belongs to a run with other inputs, is none of this kind, or cannot be read or written.
    """

    def __init__(self, path: Path, fingerprint: str):
        self._path, header = path, HEADER.format(fingerprint).encode()
        self.members: list[Member] = []
        if not path.exists():
            write_file(path, header)
        try:
            content = path.read_bytes()
        except OSError as error:
            raise DataError(f"{path} cannot be read: {error.strerror}; choose another file") from error
        if not content.startswith(header):
            raise DataError(
                f"{path} does not hold members of this ensemble: the section, the picks, the plan, the uncertainty, "
                "the seed or the version of seiswidgets differ; choose another file, or remove it"
            )
        end = len(header)
        for member, stop in _records(content, end):
            self.members.append(member)
            end = stop
        try:
            self._file = path.open("r+b", buffering=0)
            self._file.truncate(end)
            self._file.seek(end)
        except OSError as error:
            raise DataError(f"{path} cannot be written: {error.strerror}; choose another file") from error

    def append(self, member: Member) -> None:
        """Append a member; DataError if the disk is full."""
        buffer = io.BytesIO()
        problem = np.frombuffer(member.problem.encode(errors="replace"), np.uint8)
        values, depths, ratio = member.values, member.depths, member.ratio
        np.savez(buffer, index=member.index, problem=problem, values=values, depths=depths, ratio=ratio)
        payload = buffer.getvalue()
        record = RECORD.pack(len(payload), zlib.crc32(payload)) + payload
        start = self._file.tell()
        try:
            written = self._file.write(record)
            if written != len(record):
                raise OSError(errno.ENOSPC, "No space left on device")
        except OSError as error:
            self._file.truncate(start)
            raise DataError(
                f"{self._path} cannot grow: {error.strerror}; free some space and run again with the same file. It "
                "keeps all members but this one"
            ) from error

    def __enter__(self) -> "PartialEnsemble":
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._file.close()


def _records(content: bytes, start: int) -> Iterator[tuple[Member, int]]:
    """Yield each complete record as a member, and where it ends."""
    while start + RECORD.size <= len(content):
        length, checksum = RECORD.unpack_from(content, start)
        payload = content[start + RECORD.size : start + RECORD.size + length]
        if length > LARGEST or len(payload) < length or zlib.crc32(payload) != checksum:
            return
        start += RECORD.size + length
        try:
            with np.load(io.BytesIO(payload), allow_pickle=False) as arrays:
                problem = arrays["problem"].tobytes().decode()
                values, depths, ratio = arrays["values"], arrays["depths"], arrays["ratio"]
                yield Member(int(arrays["index"]), values, depths, ratio, problem), start
        except (KeyError, ValueError, zipfile.BadZipFile):
            return
