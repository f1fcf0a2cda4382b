"""Cost of a point: mjcont beside the floor, what it is made of, and how it grows with the degrees of freedom."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
import scipy.linalg.lapack
from mujoco.batch import Batch

import mjcont as mc
from benchmarks.cases import Case
from benchmarks.measure import seconds
from mjcont.mechanism import batches


class Floor:
    """What a point costs with full K, C and spectrum and no overhead at all.

    4 nv + 4 forward evaluations in one bare batched call, and the eigenvalues of one dense matrix of size 2 nv.
    """

    def __init__(self, case: Case, branch: mc.Branch) -> None:
        n = case.problem.n
        model = case.problem.simulation_model()
        count = 4 * n + 4
        self._batch = Batch(model, count, nthread=1)
        self._states = branch.states[np.arange(count) % len(branch)]
        self._qpos, self._forces = self._batch.bind("qpos"), self._batch.bind("qfrc_smooth")
        self._matrix = np.random.default_rng(0).standard_normal((2 * n, 2 * n))

    def point(self) -> None:
        """Do the work of one point."""
        self._qpos[:] = self._states
        self._batch.forward()
        np.linalg.eigvals(self._matrix)

    def per_point(self, calls: int = 50) -> float:
        """Return the mean time of a point over some calls, in s."""
        return seconds(lambda: [self.point() for _ in range(calls)]) / calls


def per_point(case: Case, *, eigenvalues: bool = False, **options: Any) -> float:
    """Return the time of a run divided by its points, in s: stability and special points included.

    With `eigenvalues` all of them are read, too; otherwise those that stability does not need wait.
    """
    began = time.perf_counter()
    branch = case.run(**options)
    if eigenvalues:
        assert len(branch.eigenvalues) == len(branch)
    return (time.perf_counter() - began) / len(branch)


class _Meter:
    """Adds up the time spent in functions that are wrapped."""

    def __init__(self) -> None:
        self.total = 0.0
        self._depth = 0

    def wrap(self, function: Any) -> Any:
        def timed(*args: Any, **kwargs: Any) -> Any:
            if self._depth:
                return function(*args, **kwargs)
            self._depth += 1
            began = time.perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                self.total += time.perf_counter() - began
                self._depth -= 1

        return timed


_ALGEBRA = (
    "solve", "svd", "eig", "eigvals", "eigh", "eigvalsh", "cholesky", "lstsq", "qr", "inv", "det", "dgetrf", "dgetrs"
)
_MUJOCO = ("mj_forward", "mj_fwdPosition", "mj_fullM", "mju_sparse2dense")


@contextmanager
def _patched(owner: Any, names: tuple[str, ...], meter: _Meter) -> Iterator[None]:
    kept = {n: getattr(owner, n) for n in names if hasattr(owner, n)}
    for name, function in kept.items():
        setattr(owner, name, meter.wrap(function))
    try:
        yield
    finally:
        for name, function in kept.items():
            setattr(owner, name, function)


def _forget_batches(case: Case) -> None:
    """Have batches made anew."""
    case.problem._core.evaluator._batches = {}
    case.problem._core.readings._rows = None


def split(case: Case) -> dict[str, float]:
    """Return the shares of MuJoCo, linear algebra and Python in a point's time; the timers cost a little themselves."""
    mujoco_time, algebra = _Meter(), _Meter()

    class TimedBatch(Batch):
        forward = mujoco_time.wrap(Batch.forward)
        set_models = mujoco_time.wrap(Batch.set_models)

    original = batches.Batch
    batches.Batch = TimedBatch  # type: ignore[misc]
    try:
        with (
            _patched(np.linalg, _ALGEBRA, algebra),
            _patched(scipy.linalg.lapack, _ALGEBRA, algebra),
            _patched(mujoco, _MUJOCO, mujoco_time),
        ):
            _forget_batches(case)
            case.run()
            mujoco_time.total = algebra.total = 0.0
            whole = seconds(case.run)
    finally:
        batches.Batch = original  # type: ignore[misc]
        _forget_batches(case)
    shares = {"mujoco": mujoco_time.total / whole, "algebra": algebra.total / whole}
    return {**shares, "python": 1.0 - sum(shares.values())}


def growth(sizes: list[int], times: list[float]) -> float:
    """Return the exponent e of times ~ sizes^e, by least squares over the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
