"""A limit on time that holds wherever problems are evaluated: `check` raises, and what there is by then is kept."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar

_deadline: ContextVar[float] = ContextVar("deadline", default=math.inf)


class TimeUp(Exception):
    """The time that a computation may take is over."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Let what is computed inside take no longer than that, and no longer than a limit outside allows."""
    token = _deadline.set(min(_deadline.get(), time.monotonic() + seconds))
    try:
        yield
    finally:
        _deadline.reset(token)


def allowance(seconds: float) -> Callable[[], AbstractContextManager[None]]:
    """Return what limits the time of several pieces of work to that after now."""
    end = time.monotonic() + seconds
    return lambda: limited(end - time.monotonic())


@contextmanager
def unlimited() -> Iterator[None]:
    """Let what is computed inside be finished: results are made of what there is."""
    token = _deadline.set(math.inf)
    try:
        yield
    finally:
        _deadline.reset(token)


def expired() -> bool:
    """Whether the time is over."""
    return time.monotonic() > _deadline.get()


def check() -> None:
    """Raise TimeUp if the time is over."""
    if expired():
        raise TimeUp
