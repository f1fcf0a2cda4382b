"""The one guard of the driver: an error that nobody expected ends a curve with a status, and keeps what there is.

Numerics are to be total: what can fail says so by a value or a status. The guard is for what was overlooked. It would
also hide it, so the test suite calls `raise_unexpected(True)` (`tests/conftest.py`), and such errors are raised there.
"""

from __future__ import annotations

from collections.abc import Iterator

from mjcont.errors import MjcontError
from mjcont.numerics.equations.clock import TimeUp
from mjcont.numerics.walk.steps import End, Item, Status

Items = Iterator[Item]
_raised = False


def raise_unexpected(on: bool) -> bool:
    """Say whether unexpected errors are raised, as in tests, and return whether they were before."""
    global _raised  # noqa: PLW0603
    before, _raised = _raised, on
    return before


def guarded(walk: Items) -> Items:
    """Yield what a walk yields, and an end with status "failed" where it raises what nobody expected."""
    try:
        yield from walk
    except (MjcontError, TimeUp):
        raise
    except Exception as error:
        if _raised:
            raise
        where = f"{type(error).__name__}: {error}".rstrip(": ")
        yield End(
            Status.FAILED,
            f"an unexpected error ended the curve ({where}); the points before it are kept. Please report this, with "
            "the model and the call: it is a defect of mjcont, unless a function of yours raised it",
        )
