"""Derivatives of forces that are smooth in pieces: differences that do not straddle a kink, and a parameter's rule.

A piece's name is a string of bytes, its *side*, the same for all rows of a model whose forces are smooth everywhere.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mjcont.numerics.equations.differences import CENTRED, PARAMETER, kept_within
from mjcont.numerics.equations.problem import Array, Range, Stencil
from mjcont.results.quantities import Parameter

_FINER = (1e-2, 1e-4)
_SMALLER = (1.0, 1e-3, 1e-6)


def one_sided(
    jac: Array, rows: Array, sides: list[bytes], steps: Array, at: Callable[[Array], tuple[Array, list[bytes]]]
) -> Array:
    """Return a difference Jacobian whose columns do not straddle a limit, a contact or another kink.

    Parameters
    ----------
    jac : (n, n) from centred differences.
    rows : (1 + m, n) forces at the state and at the state moved by `steps`.
    sides : of each row, as `Evaluator.sides` gives them.
    steps : (m, n), each along one coordinate.
    at : returns forces and sides at the state moved by other steps; asked where all of a column's points are beyond.
    """
    out, rows = jac.copy(), rows.copy()
    left = {int(j) for r, step in enumerate(steps, 1) if sides[r] != sides[0] for j in np.flatnonzero(step)}
    tried, forces, pieces = steps, rows[1:], sides[1:]
    for size in (*_FINER, 0.0):
        for j in sorted(left):
            same = [r for r, step in enumerate(tried) if step[j] != 0.0 and pieces[r] == sides[0]]
            if same:
                r = min(same, key=lambda r: abs(tried[r][j]))
                out[:, j] = (forces[r] - rows[0]) / tried[r][j]
                left.remove(j)
        if not left or not size:
            break
        # a stiff contact yields by less than the usual step
        columns = sorted(left)
        finer = size * np.diag(np.abs(steps).max(axis=0))[columns]
        tried = np.concatenate([finer, -finer])
        forces, pieces = at(tried)
    return out


def parameter_rate(
    at: Callable[[float], tuple[Array, bytes]], f: Array, side: bytes, rule: Stencil, step: float
) -> Array:
    """Return the derivative of forces in a parameter, one-sided where the rule's points straddle a kink, (n,).

    Parameters
    ----------
    at : returns the forces and their smooth piece at an offset of the parameter.
    f, side : the same at no offset.
    rule, step : the difference rule, and the step to use in the place of its own.
    """
    total, straddles = np.zeros_like(f), False
    for offset, weight in zip(rule.offsets, rule.weights, strict=True):
        if not offset:
            total += weight * f
            continue
        forces, piece = at(offset * step)
        total += weight * forces
        straddles |= piece != side
    if not straddles:
        return total / step
    for h in (step * s * size for size in _SMALLER for s in (1.0, -1.0)):
        forces, piece = at(h)
        if piece == side:
            return (forces - f) / h
    return total / step


def difference_rule(parameter: Parameter, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
    """Return the difference rule and step for derivatives in a parameter, which leave neither its bounds nor its range.

    Forces are affine in controls, stiffnesses and the like, where two points are exact for any step.
    """
    hard = parameter.hard_bounds
    low, high = parameter.bounds if bounds is None else bounds
    span = high - low
    if bounds is not None and low <= value <= high:
        hard = max(low, hard[0]), min(high, hard[1])
    return kept_within(*_free_rule(parameter, value, span), value, hard)


def _free_rule(parameter: Parameter, value: float, span: float) -> tuple[Stencil, float]:
    """Return the difference rule and step where nothing limits the parameter."""
    if parameter.kind == "control":
        return CENTRED, max(1.0, abs(value))
    size = max(abs(value), 1e-2 * span)
    if parameter.springs:  # a step must not lead to a negative stiffness, which MuJoCo has not
        return (CENTRED, 0.1 * abs(value)) if parameter.affine else (PARAMETER, PARAMETER.step * abs(value))
    if parameter.affine:
        return CENTRED, 0.1 * size
    if parameter.unit == "rad":
        return PARAMETER, min(PARAMETER.step, PARAMETER.step * size * 100.0)
    return PARAMETER, PARAMETER.step * size
