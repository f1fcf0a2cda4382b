"""Derivatives of forces that are smooth in pieces: differences that do not straddle a kink, and a parameter's rule.

A piece's name is a string of bytes, its *side*, the same for all rows of a model whose forces are smooth everywhere.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mjcont.numerics.differences import CENTRED, PARAMETER, Stencil
from mjcont.numerics.problem import Array
from mjcont.quantities import Parameter

_SMALLER = (1.0, 1e-3, 1e-6)


def one_sided(jac: Array, rows: Array, sides: list[bytes], steps: Array) -> Array:
    """Return a difference Jacobian whose columns do not straddle a limit or contact.

    Parameters
    ----------
    jac : (n, n) from centred differences.
    rows : (1 + m, n) forces at the state and at the state moved by `steps`.
    sides : of each row, as `Evaluator.sides` gives them.
    steps : (m, n), each along one coordinate.
    """
    straddling = {j for r, step in enumerate(steps, 1) if sides[r] != sides[0] for j in np.flatnonzero(step)}
    out = jac.copy()
    for j in straddling:
        same = [r for r, step in enumerate(steps, 1) if step[j] != 0.0 and sides[r] == sides[0]]
        if same:
            r = min(same, key=lambda r: abs(steps[r - 1][j]))
            out[:, j] = (rows[r] - rows[0]) / steps[r - 1][j]
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
        forces, piece = at(offset * step) if offset else (f, side)
        total += weight * forces
        straddles |= piece != side
    for h in (step * s * size for size in _SMALLER for s in (1.0, -1.0)) if straddles else ():
        forces, piece = at(h)
        if piece == side:
            return (forces - f) / h
    return total / step


def difference_rule(parameter: Parameter, value: float, span: float | None = None) -> tuple[Stencil, float]:
    """Return the difference rule and step for derivatives in a parameter.

    Forces are affine in controls, stiffnesses and the like, where two points are exact for any step.
    """
    size = max(abs(value), 1e-2 * (span or parameter.bounds[1] - parameter.bounds[0]))
    if parameter.affine:
        return CENTRED, max(1.0, abs(value)) if parameter.kind == "control" else 0.1 * size
    if parameter.unit == "rad":
        return PARAMETER, min(PARAMETER.step, PARAMETER.step * size * 100.0)
    return PARAMETER, PARAMETER.step * size
