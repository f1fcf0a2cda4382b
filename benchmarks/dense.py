"""What a row of a dense field costs, in LU factors of its size: CPU times of one process, taken in turns."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.linalg import lapack

import mjcont as mc

_FACTORS = 50


def cells(n: int, vectorized: bool = False) -> mc.VectorField:
    """Return n cells, each with a threshold and a decay of its own, coupled all with all; the Jacobian is given."""
    i = np.arange(n)
    coupling = np.exp(-np.abs(i[:, None] - i) / 10.0) / 20.0
    offset, decay = 0.1 * np.cos(i), 1.0 + i / n

    def f(u: Any, p: Any) -> Any:
        own, rate = (offset, decay) if u.ndim == 1 else (offset[:, None], decay[:, None])
        return coupling @ np.tanh(u) + p["a"] + own - rate * u

    def jacobian(u: Any, p: Any) -> Any:
        return coupling * (1.0 - np.tanh(u) ** 2) - np.diag(decay)

    return mc.VectorField(f, np.zeros(n), {"a": -2.0}, jacobian=jacobian, vectorized=vectorized)


def factors_a_row(n: int = 100, vectorized: bool = False) -> float:
    """Return the CPU time of a branch over its rows and the time of an LU factorization, before and after."""
    field = cells(n, vectorized)
    matrix = np.asfortranarray(field.linearize(field.u0, field.values(), ()).jac)

    def factor() -> float:
        return statistics.median(_cpu(lambda: lapack.dgetrf(matrix)) for _ in range(_FACTORS))

    rows = list[mc.Branch]()
    before = factor()
    taken = _cpu(lambda: rows.append(mc.continue_equilibria(field, "a", (-2.0, 2.0))))
    return taken / len(rows[0]) / (0.5 * (before + factor()))


def _cpu(function: Callable[[], Any]) -> float:
    """Return the CPU time that a call takes, in s."""
    began = time.process_time()
    function()
    return time.process_time() - began
