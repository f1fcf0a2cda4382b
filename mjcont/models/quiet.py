"""MuJoCo kept quiet while it works for mjcont: what it would warn of is in the results.

MuJoCo prints a warning and appends it to MUJOCO_LOG.TXT in the working folder, unless a handler takes it. `quiet` is
that handler, for as long as it is entered and where the user has none; a user's own goes on hearing everything. Where
the two calls that this takes cost too much, data of our own is told beforehand that each warning was given.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np
from mujoco.batch import Batch

_KINDS = mujoco.mjtWarning
_SPOILING = [int(_KINDS.mjWARN_CONTACTFULL), int(_KINDS.mjWARN_CNSTRFULL), int(_KINDS.mjWARN_BADCTRL)]


def _ignored(message: str) -> None:
    """Take a warning."""


class _Quiet:
    """A context that may be entered again, and by several threads at a time: the last to leave restores."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._depth = 0

    def __enter__(self) -> None:
        with self._lock:
            self._depth += 1
            if mujoco.get_mju_user_warning() is None:
                mujoco.set_mju_user_warning(_ignored)

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._depth -= 1
            if not self._depth and mujoco.get_mju_user_warning() is _ignored:
                mujoco.set_mju_user_warning(None)


quiet = _Quiet()


class Warned:
    """What MuJoCo would have warned of in evaluations with data, or with a batch, that from now on warns of nothing.

    MuJoCo prints each kind of warning once for each data, and counts: its counters begin at one here.
    """

    def __init__(self, holder: mujoco.MjData | Batch) -> None:
        several = isinstance(holder, Batch)
        self._numbers = holder.warning[..., 1] if several else holder.warning.number[None]  # (rows, kinds), live
        self._numbers[...] = 1
        self._none = self._numbers.tobytes()

    def spoilt(self) -> np.ndarray | None:
        """Return which rows were not evaluated as asked since the last call, (rows,); None where all were.

        MuJoCo takes zero for a control that is no number or beyond 1e10, and leaves out contacts and constraints for
        which it has no room.
        """
        if self._numbers.tobytes() == self._none:
            return None
        rows = (self._numbers[:, _SPOILING] > 1).any(axis=1)
        self._numbers[...] = 1
        return rows if rows.any() else None


def quiet_data(model: mujoco.MjModel) -> mujoco.MjData:
    """Return data of a model that warns of nothing."""
    data = mujoco.MjData(model)
    Warned(data)
    return data


@contextmanager
def heard() -> Iterator[list[str]]:
    """Keep MuJoCo quiet while it reads and compiles; the list has, afterwards, what it warned of."""
    told: list[str] = []
    with quiet, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            yield told
        finally:
            told += dict.fromkeys(" ".join(str(w.message).split()) for w in caught)
