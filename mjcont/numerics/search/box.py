"""Minimisation over a box where the function may not be defined everywhere: projected quasi-Newton steps.

The unknowns u run over [0, 1]^d. The Hessian of the unknowns off their bounds is approximated by BFGS updates; steps
are projected to the box and shortened until the function falls enough (Bertsekas, SIAM J. Control Optim. 20 (1982)
221-246). Where the function is not defined a step is shortened as well: no penalty bends it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why

_SUFFICIENT = 1e-4
_SHORTEST = 1e-6
_SHORTEST_UNDEFINED = 1e-3
_FLAT = 1e-13
_NEAR = 1e-3
_UNDEFINED = Refused(Why.UNDEFINED, "the function is not defined where it falls further")
_STALLED = Refused(Why.STALLED, "no step lowers it further")
_CREEP = 1e-2  # steps shortened by an edge of existence that gain less than this end a run


@dataclass(frozen=True, slots=True)
class Minimum:
    """Where a minimisation ended.

    Attributes
    ----------
    u : (d,) point of the box.
    value, gradient : there.
    kkt : largest component of the projected gradient, u - P(u - gradient).
    iterations : int
    failure : None where the point is stationary; undefined where the function is, beside the last point.
    """

    u: Array
    value: float
    gradient: Array
    kkt: float
    iterations: int
    failure: Refused | None = None


def projected(u: Array, gradient: Array) -> Array:
    """Return u - P(u - gradient): zero at a stationary point of the box."""
    moved: Array = u - np.clip(u - gradient, 0.0, 1.0)
    return moved


def minimise(
    function: Callable[[Array], tuple[float, Array] | None], u: Array, *, tol: float, most: int = 60
) -> Minimum | None:
    """Return a local minimum over [0, 1]^d, or None if the function is not defined at the start.

    Parameters
    ----------
    function : u -> (value, gradient), of order one, or None where it is not defined.
    u : (d,) start.
    tol : largest component of the projected gradient at which to stop.
    most : iterations.
    """
    here = function(u)
    if here is None:
        return None
    value, gradient = here
    inverse, undefined = np.eye(len(u)) / max(float(np.abs(gradient).max()), _FLAT), False
    failure: Refused | None = None
    for iteration in range(1, most + 1):
        kkt = float(np.abs(projected(u, gradient)).max())
        if kkt <= tol:
            return Minimum(u, value, gradient, kkt, iteration - 1)
        near = min(_NEAR, kkt)  # bounds this close count as met, or projecting a step could turn it uphill
        held = ((u <= near) & (gradient > 0.0)) | ((u >= 1.0 - near) & (gradient < 0.0))
        downhill = -gradient / max(float(np.abs(gradient).max()), _FLAT)
        direction = np.where(held, downhill, -(np.where(held[:, None] | held[None], 0.0, inverse) @ gradient))
        if not direction @ gradient < 0.0:
            direction = downhill
        found, undefined = _search(function, u, value, gradient, direction)
        if found is None or (undefined and value - found[1] < _CREEP):
            failure = _UNDEFINED if undefined else _STALLED
            if found is not None:
                u, value, gradient = found
            break
        after, value, slope = found
        inverse = _updated(inverse, after - u, slope - gradient)
        u, gradient = after, slope
    else:
        why = Why.UNDEFINED if undefined else Why.UNSETTLED
        failure = Refused(why, f"not stationary after {most} steps")
    kkt = float(np.abs(projected(u, gradient)).max())
    return Minimum(u, value, gradient, kkt, iteration, failure)


def _search(
    function: Callable[[Array], tuple[float, Array] | None],
    u: Array,
    value: float,
    gradient: Array,
    direction: Array,
) -> tuple[tuple[Array, float, Array] | None, bool]:
    """Return the first point along the projected direction that is low enough, and whether any was undefined."""
    length, undefined = 1.0, False
    while length >= (_SHORTEST_UNDEFINED if undefined else _SHORTEST):
        moved = np.clip(u + length * direction, 0.0, 1.0)
        there = function(moved)
        if there is None:
            undefined = True
        elif there[0] <= value + _SUFFICIENT * float(gradient @ (moved - u)) + _FLAT:
            return (moved, *there), undefined
        length *= 0.25
    return None, undefined


def _updated(inverse: Array, step: Array, change: Array) -> Array:
    """Return the BFGS update of an inverse Hessian, unchanged where the curvature along the step is not positive."""
    curvature = float(step @ change)
    if curvature <= 1e-12 * float(np.linalg.norm(step) * np.linalg.norm(change)):
        return inverse
    left = np.eye(len(step)) - np.outer(step, change) / curvature
    updated: Array = left @ inverse @ left.T + np.outer(step, step) / curvature
    return updated
