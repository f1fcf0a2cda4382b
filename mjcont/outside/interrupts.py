"""Signals that ask this process to end, and the few moments at which they have to wait."""

from __future__ import annotations

import _thread
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

TERMINATED = 143
# s after which a signal comes again
_SOON = 0.01
_ENDING = [getattr(signal, n) for n in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, n)]


@contextmanager
def held() -> Iterator[None]:
    """Let signals that would end this process wait until the block is done; they count then, as they would have.

    Python hears signals in its main thread only: in other threads nothing is held, nor needs to be for Ctrl-C.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    before: dict[int, Any] = {}

    def note(number: int, frame: FrameType | None) -> None:
        came.append(number)

    try:
        for number in _ENDING:
            handler = signal.getsignal(number)
            if handler not in (None, signal.SIG_IGN):  # None: not ours to replace, it was set outside Python
                before[number] = handler
                signal.signal(number, note)
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in dict.fromkeys(came):
            _deliver(number, before[number])


def _deliver(number: int, handler: Callable[[int, FrameType | None], Any] | int) -> None:
    if callable(handler):
        handler(number, None)
    else:
        os.kill(os.getpid(), number)


def ended_by(error: BaseException | None) -> int | None:
    """Return the status of a signal that an error tells of, None if it tells of none.

    Compiled modules whose import a signal cuts short say that they could not be initialised, because of it.
    """
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return 128 + signal.SIGINT
        if isinstance(error, SystemExit):
            return int(error.code or 0)
        error = error.__cause__ or error.__context__
    return None


@contextmanager
def termination_unwinds() -> Iterator[None]:
    """Let SIGTERM and SIGHUP raise SystemExit, so that what is open is cleaned up: children, journals, files.

    A signal that arrives in a callback out of which Python lets nothing through comes again a moment later.
    """

    def end(number: int, frame: FrameType | None) -> None:
        signal.signal(number, signal.SIG_IGN)  # a second one must not cut the cleaning short
        raise SystemExit(128 + number)

    def again(lost: Any) -> None:
        number = ended_by(lost.exc_value)
        if number is None or threading.current_thread() is not threading.main_thread():
            told(lost)
            return
        if number - 128 in before:
            signal.signal(number - 128, end)
        timer = threading.Timer(_SOON, _thread.interrupt_main, (number - 128,))
        timer.daemon = True
        timer.start()

    before: dict[int, Any] = {}
    told, sys.unraisablehook = sys.unraisablehook, again
    if threading.current_thread() is threading.main_thread():
        for number in _ENDING[1:]:
            if signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, end)
    try:
        yield
    finally:
        sys.unraisablehook = told
        for number, handler in before.items():
            signal.signal(number, handler)
