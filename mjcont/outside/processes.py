"""Processes that work for this one: an interrupt hits them not too early, and they end with their parent."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
_SET_PDEATHSIG = 1  # prctl: the signal that the kernel sends when the parent ends


@contextmanager
def starting() -> Iterator[None]:
    """Start processes in here: they compute with one thread each, and an interrupt waits until both sides expect it.

    A process that Python starts knows nothing of interrupts until its first own line has run: it inherits them blocked.
    """
    from multiprocessing import resource_tracker

    masks = hasattr(signal, "pthread_sigmask")
    if masks:
        resource_tracker.ensure_running()  # started within, it would let the interrupts through again
    before = {name: os.environ.get(name) for name in _ONE_THREAD}
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT}) if masks else set()
    os.environ.update(_ONE_THREAD)
    try:
        yield
    finally:
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.update({name: value})
        if masks:
            signal.pthread_sigmask(signal.SIG_SETMASK, blocked)


def end_with_parent(interrupt: signal.Handlers) -> None:
    """Let this process end when the one that started it does, whatever ends that; `interrupt` is what Ctrl-C does.

    Nobody reads what it computes then, and it must not write.
    """
    signal.signal(signal.SIGINT, interrupt)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    parent = multiprocessing.parent_process()
    if parent is None:
        return
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SET_PDEATHSIG, signal.SIGKILL)  # at once, whatever this process is busy with
        if os.getppid() != parent.pid:  # it ended before it was asked to take us along
            os._exit(1)

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
