"""Memory that is free again: what the C library keeps of it goes back to the system."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache


@cache
def _trim() -> Callable[[int], int] | None:
    """Return glibc's malloc_trim, None where the C library is another one."""
    try:
        found: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    except (OSError, TypeError):  # Windows
        return None
    return found


def give_back() -> None:
    """Return free memory to the system: each batch of MuJoCo has a thread, and with it a heap that glibc would keep."""
    trim = _trim()
    if trim is not None:
        trim(0)
