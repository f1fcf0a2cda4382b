"""What the command line prints, and where: a stream that cannot be written to never stops what is computed."""

from __future__ import annotations

import errno
import os
import shutil
import sys
from contextlib import suppress
from typing import TextIO

from mjcont.outside.escapes import for_terminal


def say(text: str = "") -> None:
    """Print lines at once; when nobody reads any more, or the disk is full, go on in silence."""
    try:
        _write(sys.stdout, text)
    except OSError as error:
        _silence(sys.stdout)
        if error.errno != errno.EPIPE:  # whoever reads has had enough
            complain(f"mjcont: cannot write to standard output: {error.strerror or error}; going on without")


def complain(line: str) -> None:
    """Print a line on stderr."""
    with suppress(OSError):
        _write(sys.stderr, " ".join(line.split()))


def _write(stream: TextIO | None, text: str) -> None:
    if stream is None:  # closed before this program began
        return
    encoding = getattr(stream, "encoding", None) or "utf-8"
    print(for_terminal(text).encode(encoding, "backslashreplace").decode(encoding), file=stream, flush=True)


def _silence(stream: TextIO) -> None:
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


class Live:
    """A line that is written over and over, on a terminal; nothing any more once that is gone."""

    def __init__(self, stream: TextIO) -> None:
        self._stream: TextIO | None = stream

    def show(self, text: str = "") -> None:
        """Write the line anew; empty to wipe it."""
        if self._stream is None:
            return
        try:
            width = shutil.get_terminal_size().columns - 1  # a line that wraps is not wiped
            self._stream.write(f"\r\x1b[K{for_terminal(text)[:width]}")
            self._stream.flush()
        except OSError:
            self._stream = None


def live_stream() -> TextIO | None:
    """Return stderr if it is a terminal that can show a live line."""
    able = sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
    return sys.stderr if able else None
