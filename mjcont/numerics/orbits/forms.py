"""Coefficients of normal forms of special orbits, up to positive factors: what changes sign at CPC, GPD and CH.

With v, w the null vectors of the defining system, and D2, D3 the derivatives of the equations, which act point by
point, so that v need not be periodic:

    fold       w . D2[v, v]
    doubling   w . (D3[v, v, v] / 6 + D2[v, h]),                                 J h = -D2[v, v] / 2
    torus      w . (D3[v, v, v*] / 2 + D2[v, h] + D2[v*, g]),    J h = -D2[v, v*],  K(mu^2) g = -D2[v, v] / 2

over the rate w . mu dK/dmu v at which the multiplier moves; of a torus the real part. The doubled orbits, or the torus,
lie where the multiplier is outside, supercritically, if that is positive.

Source: Kuznetsov, Govaerts, Doedel and Dhooge, Numerical periodic normalization for codim 1 bifurcations of limit
cycles (SIAM J. Numer. Anal. 43, 2005), here for the discretised equations.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Condition, Local
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.defining import CycleFold, PeriodDoubling, Torus, orbits_of, turned
from mjcont.numerics.step.arclength import CurvePoint

# how far an orbit is moved for second and third derivatives, relative to its sizes: of fourth order
_MOVED = 1e-2


def _accurate(point: CurvePoint) -> Local:
    local = point.local
    return Local(local.problem, local.x, local.values, local.wrt, True, local.ranges)


class _Bends:
    """Second and third derivatives of the equations along a direction of scaled unknowns: of the matrix J."""

    def __init__(self, local: Local, along: Array) -> None:
        orbits, self.scale = orbits_of(local), local.problem.state_scale
        step = along * self.scale
        size = float(np.abs(step[: orbits.ends].reshape(-1, orbits.flow.d) / orbits.sizes).max())
        e = _MOVED / max(size, 1e-100)
        far_ahead, ahead, behind, far_behind = (_matrix(local, local.x + s * e * step) for s in (2.0, 1.0, -1.0, -2.0))
        self.first = (8.0 * (ahead - behind) - (far_ahead - far_behind)) / (12.0 * e)
        self.second = (16.0 * (ahead + behind) - (far_ahead + far_behind) - 30.0 * local.jac) / (12.0 * e**2)


def _matrix(local: Local, x: Array) -> Any:
    return Local(local.problem, x, local.values, local.wrt, True, local.ranges).jac


def _whole(orbits: Orbits, vector: Array) -> Array:
    """Return a vector with zeros for the period and the phase condition, (n,)."""
    found = np.zeros(orbits.n, dtype=vector.dtype)
    found[: len(vector)] = vector
    return found


def square_of_fold(point: CurvePoint, fold: Condition) -> float:
    """Return w . D2[v, v] of an LPC; the curve's own condition keeps the sign of w from point to point."""
    assert isinstance(fold, CycleFold)
    local = _accurate(point)
    v, w, _ = fold.vectors(local, np.zeros(0))
    return float(w @ (_Bends(local, v).first @ v) / (np.linalg.norm(w * np.abs(local.jac).max()) * (v @ v)))


def cubic_of_doubling(point: CurvePoint) -> float:
    """Return the cubic coefficient of a PD, up to a positive factor."""
    local = _accurate(point)
    orbits = orbits_of(local)
    short, left, _ = PeriodDoubling(local).vectors(local, np.zeros(0))
    v, w = _whole(orbits, short), _whole(orbits, left)
    bends = _Bends(local, v)
    h = Factored(local.jac).solve(-0.5 * (bends.first @ v))
    along = bends.second @ v / 6.0 + bends.first @ h
    return float(w @ along) * _side(orbits, v, w, -1.0).real


def cubic_of_torus(point: CurvePoint, theta: float) -> float:
    """Return the real part of the cubic coefficient of an NS with the angle theta, up to a positive factor."""
    local = _accurate(point)
    orbits = orbits_of(local)
    short, left, _ = Torus(local, theta, deflates=False).vectors(local, np.array([theta]))
    v, w = _whole(orbits, short), _whole(orbits, left)
    real, imag = _Bends(local, v.real), _Bends(local, v.imag)
    first = real.first + 1j * imag.first  # D2[v, .]
    h = Factored(local.jac).solve(-(first @ np.conj(v)).real)
    g = Factored(turned(local, np.exp(2j * theta))).solve(-0.5 * (first @ v)[: len(short)])
    along = 0.5 * ((real.second + imag.second) @ v) + first @ h + np.conj(first) @ _whole(orbits, g)
    return float((w @ along * _side(orbits, v, w, np.exp(1j * theta))).real)


def side_of(value: float) -> str:
    """Return what the sign of a cubic coefficient is called."""
    return "supercritical" if value > 0.0 else "subcritical" if value < 0.0 else "degenerate"


def _side(orbits: Orbits, v: Array, w: Array, mu: complex) -> complex:
    """Return the direction of 1 / (w . mu dK/d(mu) v): which way the multiplier moves as w . G v grows."""
    first, d = orbits.inside + orbits.intervals * orbits.flow.d, orbits.flow.d
    moved = complex(-mu * (w[first : first + d] @ (orbits.state_scale[:d] * v[:d])))
    return complex(np.conj(moved) / abs(moved) ** 2) if moved else complex(np.nan)
