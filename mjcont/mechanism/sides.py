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
# the change from second to fourth order that calls for tenfold shorter steps, how often it may, and how often they may
# be where points lie on several pieces: a contact of 1e8 N/m yields by 1e-8 m
_CURVED, _STRAIGHT, _FINEST = 1e-6, 3, 6


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


def on_one_side(
    jac: Array,
    rows: Array,
    sides: list[bytes],
    steps: Array,
    at: Callable[[Array], tuple[Array, list[bytes]]],
    accurate: bool,
) -> Array:
    """Return a difference Jacobian of one smooth piece; arguments as in `one_sided`, `accurate` for fourth order."""
    if not accurate:
        return one_sided(jac, rows, sides, steps, at)
    found, left = refined(jac, rows, sides, steps, at)
    if len(left):
        found[:, left] = one_sided(jac, rows, sides, steps, at)[:, left]
    return found


def refined(
    jac: Array, rows: Array, sides: list[bytes], steps: Array, at: Callable[[Array], tuple[Array, list[bytes]]]
) -> tuple[Array, Array]:
    """Return a difference Jacobian of fourth order with shorter steps where they are too long, and where none would do.

    They are too long where a column's points do not lie on one smooth piece, or where it changes by more than
    `_CURVED` from second to fourth order: the force of a contact is curved over the width of its impedance.

    Parameters
    ----------
    jac, rows, sides, steps, at : as in `one_sided`, with the steps of `FOURTH_ORDER`, (4 n, n).

    Returns
    -------
    jac : (n, n)
    left : the columns whose points lie on several pieces however short the steps.
    """
    out, n = jac.copy(), jac.shape[1]
    h, columns, f, pieces = np.abs(steps).max(axis=0), np.arange(n), rows[1:], sides[1:]
    size = np.abs(jac).max(axis=0)
    straddles = np.zeros(n, dtype=bool)
    for finest in range(_FINEST + 1):
        blocks = f.reshape(4, len(columns), -1)
        second = (blocks[0] - blocks[1]) / h[columns, None]
        fourth = (8.0 * (blocks[0] - blocks[1]) - (blocks[2] - blocks[3])) / (6.0 * h[columns, None])
        whole = np.array([s == sides[0] for s in pieces]).reshape(4, -1).all(axis=0)
        straight = np.abs(second - fourth).max(axis=1) <= _CURVED * size[columns]
        settled = whole & (straight | (finest >= _STRAIGHT))
        out[:, columns[whole]] = fourth[whole].T
        straddles[columns] = ~whole
        columns = columns[~settled]
        if not len(columns) or finest == _FINEST:
            break
        h = 0.1 * h
        unit = 0.5 * h[columns, None] * np.eye(n)[columns]
        f, pieces = at(np.concatenate([unit, -unit, 2.0 * unit, -2.0 * unit]))
    return out, np.flatnonzero(straddles)


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
