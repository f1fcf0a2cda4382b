"""Peers on PyPI: steps in the parameter with scipy.optimize.root, and PyCont-Lite."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
from scipy.optimize import root

from benchmarks.cases import Case
from benchmarks.measure import seconds


def root_stepping(case: Case, steps: int = 200) -> float:
    """Return the time of a point, in s, when the parameter is stepped and scipy's `root` corrects; no stability.

    It stops at the first fold, where natural-parameter stepping cannot go on.
    """
    problem = case.problem
    values = dict(case.start.parameters)
    low, high = case.bounds
    x = case.start.state
    done = 0

    def residual(u: np.ndarray) -> np.ndarray:
        return problem.residual(u, values)

    def run() -> None:
        nonlocal x, done
        for value in np.linspace(values[case.parameter], high if case.direction != -1 else low, steps):
            values[case.parameter] = float(value)
            found = root(residual, x, method="hybr", options={"xtol": 1e-10})
            if not found.success:
                break
            x, done = found.x, done + 1

    return seconds(run) / max(done, 1)


def pycont_missing() -> str | None:
    """Return why PyCont-Lite cannot be run here, or None."""
    return None if find_spec("pycont") else "PyCont-Lite is not installed (pip install PyCont-Lite)"


def pycont(case: Case) -> float:
    """Return PyCont-Lite's time of a point, in s, on a plain problem."""
    import pycont

    problem, (low, high) = case.problem, case.bounds
    values = dict(case.start.parameters)

    def residual(u: np.ndarray, p: float) -> np.ndarray:
        return problem.residual(u, {**values, case.parameter: float(p)})

    kept: list[int] = []

    def run() -> None:
        result = pycont.arclengthContinuation(
            residual, case.start.state, low, 1e-6, 0.1, 0.01, 500,
            solver_parameters={"param_max": high, "initial_directions": "increase_p"}, verbosity="OFF",
        )
        kept.append(sum(len(b.p_path) for b in result.branches))

    took = seconds(run)
    return took / max(kept[-1], 1)
