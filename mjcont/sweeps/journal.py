"""The journal of a sweep: a file to which the record of each case is appended, safe against a kill at any moment.

The first line says what the sweep is, each further line is the record of one case. Lines are on the disk before the
next ones are computed from them. A last line that was cut off is dropped when the file is opened again.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO

from mjcont.errors import MjcontError, ResultFileError

FORMAT = "mjcont sweep journal 1"
_PARTS = {"model": "model", "design": "design", "points": "points, parameters or quantities", "versions": "versions"}


def digest(data: Any) -> str:
    """Return a hash of plain data."""
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


class Journal:
    """The records of a sweep, in memory and on the disk; a context manager.

    Parameters
    ----------
    path : path
    header : mapping
        What the sweep is: `what` in words; `identity`, the hashes of the parts that must agree.
    begin : callable
        Called for a new file: returns what its first line holds beside that.

    Raises
    ------
    ResultFileError
        If the file belongs to another sweep, is damaged before its end, or is being written by another process.
    """

    def __init__(self, path: Path, header: Mapping[str, Any], begin: Callable[[], Mapping[str, Any]]) -> None:
        self.path, self.header, self._begin = path, dict(header), begin
        self.records: dict[int, dict[str, Any]] = {}
        self._file: BinaryIO | None = None

    def __enter__(self) -> Journal:
        """Open the file, lock it, and read what is there."""
        try:
            self._file = self.path.open("a+b")
        except OSError as error:
            raise ResultFileError(f"cannot write {self.path}: {error.strerror}") from error
        try:
            self._lock()
            self._read()
        except BaseException:
            self._file.close()
            raise
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the file."""
        assert self._file is not None
        self._file.close()

    def _lock(self) -> None:
        try:
            import fcntl
        except ImportError:  # Windows
            return
        assert self._file is not None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ResultFileError(f"{self.path} is being written by another process: wait for that sweep") from error

    def _read(self) -> None:
        assert self._file is not None
        self._file.seek(0)
        data = self._file.read()
        whole = data.rfind(b"\n") + 1
        if whole < len(data):
            self._file.truncate(whole)
        lines = data[:whole].splitlines()
        if not lines:
            self.header |= self._begin()
            self._append([{"format": FORMAT, **self.header}])
            return
        try:
            found, *rest = (json.loads(line) for line in lines)
            if found["format"] != FORMAT:
                raise ResultFileError(f"{self.path} is no journal of a sweep")
            theirs, records = found["identity"], {r["case"]: r for r in rest}
        except (ValueError, KeyError, TypeError) as error:
            raise ResultFileError(f"{self.path} is no journal of a sweep, or damaged: {error}") from error
        different = [words for part, words in _PARTS.items() if theirs.get(part) != self.header["identity"][part]]
        if different:
            raise ResultFileError(
                f"{self.path} belongs to another sweep ({found['what']}) than this one ({self.header['what']}): they "
                f"differ in {' and '.join(different)}. Choose another folder, or delete that file to start anew."
            )
        if len(records) != len(rest):
            raise ResultFileError(f"{self.path} is damaged: it has a case twice")
        self.header, self.records = found, records

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
        assert self._file is not None
        self._file.write(b"".join(json.dumps(r).encode() + b"\n" for r in records))
        self._file.flush()
        os.fsync(self._file.fileno())
