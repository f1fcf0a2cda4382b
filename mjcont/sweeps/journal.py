"""The journal of a sweep: a file to which the record of each case is appended, safe against a kill at any moment.

The first line says what the sweep is, each further line is the record of one case. Lines are on the disk before the
next ones are computed from them. A last line that was cut off is dropped when the file is opened again. Each line is
a JSON object whose last entry, `sha256`, is the digest of the line without it; journals of older versions have none.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from mjcont.errors import MjcontError, ResultFileError, ResultWarning, warn
from mjcont.outside.saving import flush_folder, write_all

FORMAT = "mjcont sweep journal 2"
_UNSEALED = "mjcont sweep journal 1"
_BEGINNING = b'{"format": "mjcont sweep journal'
_SEAL = re.compile(rb', "sha256": "([0-9a-f]{64})"\}\Z')
_TYPES = {"case": int, "from": int, "status": str, "message": str, "values": dict, "points": dict}
_PARTS = {"model": "model", "design": "design", "points": "points, parameters or quantities", "versions": "versions"}


def sealed_line(record: Mapping[str, Any]) -> bytes:
    """Return a record as a line with its digest."""
    text = json.dumps(record).encode()
    return text[:-1] + b', "sha256": "' + hashlib.sha256(text).hexdigest().encode() + b'"}\n'


def read_line(line: bytes, needed: bool) -> dict[str, Any]:
    """Return the record in a line, its digest checked; `needed` says that it must have one.

    Raises
    ------
    ValueError
        If it is not as it was written.
    """
    seal = _SEAL.search(line)
    if seal is None and needed:
        raise ValueError("its checksum is missing")
    if seal is not None:
        line = line[: seal.start()] + b"}"
        if hashlib.sha256(line).hexdigest().encode() != seal[1]:
            raise ValueError("it is not as it was written")
    try:
        found = json.loads(line)
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error
    if not isinstance(found, dict):
        raise ValueError("it is no object")
    return found


class Journal:
    """The records of a sweep, in memory and on the disk; a context manager.

    Parameters
    ----------
    path : path
    header : mapping
        What the sweep is: `what` in words; `identity`, the hashes of the parts that must agree.
    begin : callable
        Called for a new file: returns what its first line holds beside that.
    earlier : mapping, optional
        Further hashes of a part that an older version may have written for this sweep.

    Raises
    ------
    ResultFileError
        If the file belongs to another sweep, is damaged before its end, or is being written by another process.
    """

    def __init__(
        self, path: Path, header: Mapping[str, Any], begin: Callable[[], Mapping[str, Any]],
        earlier: Mapping[str, tuple[str, ...]] | None = None,
    ) -> None:
        self.path, self.header, self._begin, self._earlier = path, dict(header), begin, earlier or {}
        self.records: dict[int, dict[str, Any]] = {}
        self._handle, self._ours = -1, False

    def __enter__(self) -> Journal:
        """Open the file, lock it, and read what is there."""
        self._ours = not os.path.lexists(self.path)
        try:
            self._handle = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_BINARY", 0), 0o666)
        except OSError as error:
            raise self._cannot(error) from error
        try:
            self._lock()
        except BaseException:
            os.close(self._handle)
            raise
        try:
            self._read()
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the file."""
        self._close()

    def _close(self) -> None:
        """Close the file; a new one into which not even a first line could be written is not left."""
        if self._ours and os.fstat(self._handle).st_size == 0:
            self.path.unlink(missing_ok=True)
        os.close(self._handle)

    def _cannot(self, error: OSError) -> ResultFileError:
        return ResultFileError(f"cannot write {self.path}: {error.strerror or error}")

    def _lock(self) -> None:
        try:
            import fcntl
        except ImportError:  # Windows
            return
        try:
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ResultFileError(f"{self.path} is being written by another process: wait for that sweep") from error

    def _read(self) -> None:
        data = self.path.read_bytes()
        whole = data.rfind(b"\n") + 1
        if not whole and not data.startswith(_BEGINNING[: len(data)]):
            raise ResultFileError(f"{self.path} is no journal of a sweep: move it away")
        if whole < len(data):
            os.ftruncate(self._handle, whole)
        lines = data[:whole].split(b"\n")[:-1]
        if not lines:
            self.header |= self._begin()
            self._append([{"format": FORMAT, **self.header}])
            flush_folder(self.path.parent)
            return
        found = self._header(lines[0])
        sealed = found["format"] == FORMAT
        records: dict[int, dict[str, Any]] = {}
        for number, line in enumerate(lines[1:], 2):
            record = self._record(line, number, sealed)
            if record["case"] in records:
                raise ResultFileError(f"{self.path} is damaged: line {number} has a case that is there already")
            records[record["case"]] = record
        if not sealed:
            warn(
                f"{self.path} has no checksums (an older mjcont began it): damage to its numbers would not be noticed",
                ResultWarning,
            )
        self.header, self.records = found, records

    def _header(self, line: bytes) -> dict[str, Any]:
        """Return the first line of a journal that is of this sweep."""
        try:
            found = read_line(line, needed=False)
            theirs = found["identity"]
            if found["format"] not in (FORMAT, _UNSEALED) or (found["format"] == FORMAT and not _SEAL.search(line)):
                raise ValueError("its first line is none of a journal")
            different = [w for part, w in _PARTS.items() if theirs[part] not in self._accepted(part)]
            what = str(found["what"])
        except (ValueError, LookupError, TypeError) as error:
            raise ResultFileError(f"{self.path} is no journal of a sweep, or damaged in line 1: {error}") from error
        if different:
            raise ResultFileError(
                f"{self.path} belongs to another sweep ({what}) than this one ({self.header['what']}): they "
                f"differ in {' and '.join(different)}. Choose another folder, or delete that file to start anew."
            )
        return found

    def _accepted(self, part: str) -> tuple[str, ...]:
        """Return the hashes of a part with which a journal is this sweep's: now, and as older versions took them."""
        return (self.header["identity"][part], *self._earlier.get(part, ()))

    def _record(self, line: bytes, number: int, sealed: bool) -> dict[str, Any]:
        try:
            record = read_line(line, sealed)
            for name, kind in _TYPES.items():
                if not isinstance(record[name], kind):
                    raise TypeError(f"its {name} is no {kind.__name__}")
        except (ValueError, LookupError, TypeError) as error:
            raise ResultFileError(f"{self.path} is damaged in line {number}: {error}") from error
        return record

    def add(self, records: Iterable[Mapping[str, Any]]) -> None:
        """Append records and put them on the disk.

        Raises
        ------
        MjcontError
            If a case is there already.
        """
        fresh = [dict(r) for r in records]
        for r in fresh:
            if r["case"] in self.records:
                raise MjcontError(f"case {r['case']} is in {self.path} already")
            self.records[r["case"]] = r
        self._append(fresh)

    def _append(self, records: Iterable[Mapping[str, Any]]) -> None:
        before = os.fstat(self._handle).st_size
        try:
            write_all(self._handle, b"".join(map(sealed_line, records)))
            os.fsync(self._handle)
        except OSError as error:
            os.ftruncate(self._handle, before)  # what is there of the line would be in the way of the next
            raise self._cannot(error) from error
