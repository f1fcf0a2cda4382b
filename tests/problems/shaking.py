"""Noise as large as rounding, put into what the numerics compute with: another machine, as far as answers may tell.

Within `shaken(seed)` every evaluation is one of arguments off by 1 to 4 units in the last place, and the terms whose
sum it returns are off by as much:

    f~(u, p) = f(u + du, p + dp) + dr,   |du| <= 4 eps |u|,   |dp| <= 4 eps |p|,   |dr| <= 4 eps |r|,

which is noise relative to |J||u| + |r| in the directions in which rounding acts: a bush of 1e6 N/m whose pin is off by
a rounding error pulls along itself, and hardly along the mechanism's own motion. In a Mechanism coordinates are added
to lengths of the model, so that |u| is at least its scale, and r is a sum of passive, actuator and bias forces.
Differences take derivatives from such rows. Matrices given to solvers are off by 1 to 4 units in the last place of
|L||U| (Higham, Accuracy and Stability of Numerical Algorithms, theorem 9.4), and of the norm for orthogonal methods,
so that a solution x has a residual relative to |A||x|. Each call draws anew, from one stream for a seed.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
import pytest
import scipy.linalg
from scipy import sparse
from scipy.linalg import lapack
from scipy.sparse.linalg import LinearOperator

from mjcont.mechanism.batches import ConstrainedRows, Rows
from mjcont.mechanism.evaluation import Evaluator
from mjcont.mechanism.large.stages import Stages
from mjcont.models import states
from mjcont.numerics.equations import bordered
from mjcont.numerics.spectra import large
from mjcont.vectorfield import VectorField

Array = np.ndarray
UNITS = 4
# numbers that are drawn at a time
_TOGETHER = 2**16
_BALANCED = ("solve", "inv", "det")
_ORTHOGONAL = ("svd", "eig", "eigvals", "eigh", "eigvalsh", "qr", "lstsq", "cholesky")


class Noise:
    """A stream of signed factors of 1 to 4 units in the last place."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._drawn, self._next = np.empty(0), 0

    def units(self, count: int) -> Array:
        """Return as many whole numbers, each one of -4, ..., -1, 1, ..., 4."""
        if self._next + count > len(self._drawn):
            drawn = self._random.integers(-UNITS, UNITS, max(count, _TOGETHER))
            self._drawn, self._next = (drawn + (drawn >= 0)).astype(float), 0
        self._next += count
        return self._drawn[self._next - count : self._next]

    def off(self, values: Array, size: Array | None = None) -> Array:
        """Return values off by 1 to 4 units in the last place, of themselves or of `size`."""
        places = np.spacing(np.abs(values if size is None else size))
        return values + self.units(values.size).reshape(values.shape) * places

    def numbers_off(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return numbers off by 1 to 4 units in the last place."""
        units = self.units(len(values)).tolist()
        return {name: v + k * math.ulp(v) for (name, v), k in zip(values.items(), units, strict=True)}


# -- evaluations ----------------------------------------------------------------------------------------------


def coordinate_sizes(model: mujoco.MjModel) -> Array:
    """Return the size of what each coordinate is added to, (nq,): 1 rad, a unit quaternion, the model's length."""
    lengths = states.state_scale(model)
    sizes = np.ones(model.nq)
    for kind, q, dof in zip(model.jnt_type, model.jnt_qposadr, model.jnt_dofadr, strict=True):
        if kind == mujoco.mjtJoint.mjJNT_SLIDE:
            sizes[q] = lengths[dof]
        elif kind == mujoco.mjtJoint.mjJNT_FREE:
            sizes[q : q + 3] = lengths[dof : dof + 3]
    return sizes


def _shake_mechanisms(patch: pytest.MonkeyPatch, noise: Noise) -> None:
    sizes: dict[int, tuple[mujoco.MjModel, Array]] = {}

    def moved(model: mujoco.MjModel, qpos: Array) -> Array:
        if id(model) not in sizes:
            sizes[id(model)] = (model, coordinate_sizes(model))  # the model is kept, so that its id stays its own
        return noise.off(qpos, np.maximum(np.abs(qpos), sizes[id(model)][1]))

    def rounded(forces: Array, *terms: Array) -> Array:
        return noise.off(forces, sum(np.abs(t) for t in terms))

    forward, single = Rows.forward, Evaluator._single
    inverse, accelerations = ConstrainedRows.forward, ConstrainedRows.accelerations
    position, acceleration, stages = Evaluator.position, Rows.acceleration, Stages.forces

    def shaken_forward(self: Rows, qpos: Array, *rest: Any, **named: Any) -> Array:
        terms = [self.field(n) for n in ("qfrc_passive", "qfrc_actuator", "qfrc_bias")]
        return rounded(forward(self, moved(self._model, qpos), *rest, **named), *terms)

    def shaken_single(self: Evaluator, x: Array) -> Array:
        found, d = single(self, moved(self.model, x)), self._data
        return rounded(found, d.qfrc_passive, d.qfrc_actuator, d.qfrc_bias)

    def shaken_inverse(self: ConstrainedRows, qpos: Array, *rest: Any, **named: Any) -> Array:
        found, d = inverse(self, moved(self._model, qpos), *rest, **named), self._data
        return rounded(found, d.qfrc_passive, d.qfrc_actuator, d.qfrc_bias, d.qfrc_constraint)

    def shaken_stages(self: Stages, qpos: Array, *rest: Any, **named: Any) -> Array:
        found, d = stages(self, moved(self._model, qpos), *rest, **named), self._data
        return rounded(found, d.qfrc_passive, d.qfrc_actuator, d.qfrc_bias)

    def shaken_accelerations(self: ConstrainedRows, qpos: Array, *rest: Any) -> Array:
        return noise.off(accelerations(self, moved(self._model, qpos), *rest))

    patch.setattr(Rows, "forward", shaken_forward)
    patch.setattr(Rows, "acceleration", lambda self: noise.off(acceleration(self)))
    patch.setattr(Evaluator, "_single", shaken_single)
    patch.setattr(Evaluator, "position", lambda self, x: position(self, moved(self.model, x)))
    patch.setattr(ConstrainedRows, "forward", shaken_inverse)
    patch.setattr(Stages, "forces", shaken_stages)
    patch.setattr(ConstrainedRows, "accelerations", shaken_accelerations)


def _shake_fields(patch: pytest.MonkeyPatch, noise: Noise) -> None:
    rate, linearize = VectorField.rate, VectorField.linearize

    def shaken_rate(self: VectorField, x: Array, values: Any, time: float) -> Array:
        return noise.off(rate(self, noise.off(x), noise.numbers_off(values), time))

    def shaken_linearize(self: VectorField, *arguments: Any, **named: Any) -> Any:
        found = linearize(self, *arguments, **named)
        if self.jacobian is not None:
            jac = found.jac
            (jac.data if sparse.issparse(jac) else jac)[:] = noise.off(jac.data if sparse.issparse(jac) else jac)
        return found

    patch.setattr(VectorField, "rate", shaken_rate)
    patch.setattr(VectorField, "linearize", shaken_linearize)


# -- solvers --------------------------------------------------------------------------------------------------


def elimination_size(matrices: Array) -> Array:
    """Return |L||U| of matrices (..., n, n), their rows in order, by elimination with partial pivoting."""
    if matrices.ndim == 2:
        order, lower, upper = scipy.linalg.lu(matrices, p_indices=True, check_finite=False)
        return (np.abs(lower) @ np.abs(upper))[order]
    left, size = np.array(matrices), np.zeros(matrices.shape)
    every, waiting = np.arange(len(left)), np.ones(left.shape[:2], dtype=bool)
    for k in range(left.shape[-1]):
        column = np.where(waiting, np.abs(left[:, :, k]), -1.0)
        pivot = column.argmax(axis=1)
        row, top = left[every, pivot], column[every, pivot]
        factors = np.where(waiting, left[:, :, k], 0.0) / np.where(top > 0.0, row[:, k], 1.0)[:, None]
        size += np.abs(factors)[:, :, None] * np.abs(row)[:, None, :]
        waiting[every, pivot] = False
        factors[every, pivot] = 0.0
        left -= factors[:, :, None] * row[:, None, :]
    return size


def _in_elimination(noise: Noise, matrix: Array) -> Array:
    if not matrix.size or matrix.shape[-1] != matrix.shape[-2]:
        return matrix  # refused by the solver, which says so
    with np.errstate(all="ignore"):
        return noise.off(matrix, elimination_size(matrix))


def _in_norm(noise: Noise, matrix: Array) -> Array:
    """Return matrices off by a few units in the last place of their norm, their symmetry and zero blocks kept."""
    size = np.linalg.norm(matrix, axis=(-2, -1), keepdims=True) / max(matrix.shape[-1], 1)
    used = matrix != 0.0
    reach = used.any(axis=-1)[..., :, None] & used.any(axis=-2)[..., None, :]
    found = noise.off(matrix, size * reach)
    if matrix.shape[-1] == matrix.shape[-2] and np.array_equal(matrix, np.swapaxes(matrix, -1, -2)):
        found = 0.5 * (found + np.swapaxes(found, -1, -2))
    return found


def _asked_by_the_numerics(frame: Any) -> bool:
    return str(frame.f_globals.get("__name__", "")).startswith("mjcont")


def _shake_solvers(patch: pytest.MonkeyPatch, noise: Noise) -> None:
    def wrapped(solver: Callable[..., Any], off: Callable[[Noise, Array], Array]) -> Callable[..., Any]:
        def shaken_solver(matrix: Any, *rest: Any, **named: Any) -> Any:
            # an operator solves with factors of a matrix that was shaken
            if _asked_by_the_numerics(sys._getframe(1)) and not isinstance(matrix, LinearOperator):
                matrix = off(noise, matrix if sparse.issparse(matrix) else np.asarray(matrix))
            return solver(matrix, *rest, **named)

        return shaken_solver

    def off_where_not_zero(noise: Noise, matrix: Any) -> Any:
        found = matrix.copy()
        found.data[:] = noise.off(found.data)
        return found

    for name in _BALANCED:
        patch.setattr(np.linalg, name, wrapped(getattr(np.linalg, name), _in_elimination))
    for name in _ORTHOGONAL:
        patch.setattr(np.linalg, name, wrapped(getattr(np.linalg, name), _in_norm))
    patch.setattr(lapack, "dgetrf", wrapped(lapack.dgetrf, _in_elimination))
    for module, name in ((bordered, "splu"), (large, "splu")):
        patch.setattr(module, name, wrapped(getattr(module, name), off_where_not_zero))


@contextmanager
def shaken(seed: int) -> Iterator[Noise]:
    """Put noise into evaluations and solvers, the same for a seed whenever the same is computed."""
    noise = Noise(seed)
    with pytest.MonkeyPatch.context() as patch:
        _shake_mechanisms(patch, noise)
        _shake_fields(patch, noise)
        _shake_solvers(patch, noise)
        yield noise
