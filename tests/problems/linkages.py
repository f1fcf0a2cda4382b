"""The linkages of models_xml/ that loops close, once more: written out by hand, for comparison.

With `q` the coordinates, the crank's turn first, and the loops' pins open by `gap(q)`, elastic pins of stiffness K make

    V(q) = energy(q) + K |gap(q)|^2 / 2,   M = dV/dq_1 with dV/dq_i = 0 for the others,

and folds lie where dM/dq_1 = V_11 - V_1r V_rr^-1 V_r1 = 0. With rigid pins the crank's turn is the one coordinate left:
M = dE/da, E(a) the energy of the closed linkage, in which every other angle is a closed form (two circles that meet).
All turns are counted from the pose qpos0. Gradients are complex steps: the functions must not take absolute values.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import brentq

GRAVITY = 9.81
_EPS = 1e-30
_STENCIL = ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60))


@dataclass(frozen=True)
class Linkage:
    """A linkage: the number of its coordinates, its pins' openings, its energy, and the latter with pins closed."""

    n: int
    gap: Callable[[np.ndarray], np.ndarray]
    energy: Callable[[np.ndarray], float]
    closed_energy: Callable[[float], float]
    start: tuple[float, ...] = ()


def turned(vector, angle):
    """Return a vector (x, z) turned counter-clockwise."""
    x, z = vector
    return np.array([x * np.cos(angle) - z * np.sin(angle), x * np.sin(angle) + z * np.cos(angle)])


def turn_between(old, new):
    """Return the angle, in (-pi, pi], that turns one vector (x, z) into another."""
    return np.angle(complex(*new) / complex(*old))


def third_corner(p, q, from_p, from_q, side):
    """Return the corner of a triangle on p-q with the given other lengths; side +1 is left of p to q."""
    base = np.hypot(*(q - p))
    along = (base**2 + from_p**2 - from_q**2) / (2 * base)
    e = (q - p) / base
    return p + along * e + side * np.sqrt(from_p**2 - along**2) * np.array([-e[1], e[0]])


# -- elastic pins -----------------------------------------------------------------------------------------------


def _gradient(function, q):
    """Return the derivatives of a function (scalar or vector) by complex steps, (..., n)."""
    return np.stack([np.imag(function(q + 1j * _EPS * row)) / _EPS for row in np.eye(len(q))], axis=-1)


def _forces(linkage, q, stiffness, pins):
    """Return the gradient of V, with the pins' forces held fixed if given."""
    pins = stiffness * linkage.gap(q) if pins is None else pins
    return _gradient(linkage.energy, q) + _gradient(linkage.gap, q).T @ pins


def _hessian(linkage, q, stiffness):
    opened = _gradient(linkage.gap, q)
    pins, h = stiffness * linkage.gap(q), 1e-3
    rest = np.zeros((linkage.n, linkage.n))
    for k, row in enumerate(np.eye(linkage.n)):
        for step, weight in _STENCIL:
            ahead, behind = (_forces(linkage, q + s * step * h * row, stiffness, pins) for s in (1, -1))
            rest[:, k] += weight * (ahead - behind) / h
    return stiffness * opened.T @ opened + rest


def balanced(linkage, turn, stiffness, guess):
    """Return q at which all coordinates but the crank's are in balance."""
    q = np.array([turn, *guess[1:]], dtype=float)
    for _ in range(60):
        step = np.linalg.solve(_hessian(linkage, q, stiffness)[1:, 1:], _forces(linkage, q, stiffness, None)[1:])
        q[1:] -= step * min(1.0, 0.3 / np.abs(step).max())
        if np.abs(step).max() < 1e-12:
            break
    return q


def elastic_folds(linkage, stiffness, near):
    """Return (turn, M) of the folds beside those with rigid pins, whose turns are given in increasing order."""
    q = np.array(linkage.start or np.zeros(linkage.n), dtype=float)

    def slope(turn):
        nonlocal q
        for step in np.linspace(q[0], turn, 1 + int(abs(turn - q[0]) / 0.1))[1:]:
            q = balanced(linkage, step, stiffness, q)
        q = balanced(linkage, turn, stiffness, q)
        h = _hessian(linkage, q, stiffness)
        return h[0, 0] - h[0, 1:] @ np.linalg.solve(h[1:, 1:], h[1:, 0])

    found = []
    for rigid in near:
        turn = brentq(slope, rigid - 0.02, rigid + 0.02, xtol=1e-13)
        slope(turn)
        found.append((turn, _forces(linkage, q, stiffness, None)[0]))
    return np.array(found)


def unstable_directions(linkage, turns, stiffness):
    """Return how many eigenvalues of V's second derivatives are negative at each of the crank's turns."""
    q = np.array(linkage.start or np.zeros(linkage.n), dtype=float)
    found = {}
    for side in (1, -1):
        at = q.copy()
        for turn in sorted((t for t in turns if side * t >= 0), key=abs):
            for step in np.linspace(at[0], turn, 2 + int(abs(turn - at[0]) / 0.1))[1:]:
                at = balanced(linkage, step, stiffness, at)
            found[turn] = int((np.linalg.eigvalsh(_hessian(linkage, at, stiffness)) < 0).sum())
    return np.array([found[t] for t in turns])


# -- rigid pins -------------------------------------------------------------------------------------------------


def _slope(function, x, h):
    return sum(w * (function(x + k * h) - function(x - k * h)) for k, w in _STENCIL) / h


def rigid_folds(linkage, turns):
    """Return (turn, M) of the folds with rigid pins."""

    def moment(turn):
        return _slope(linkage.closed_energy, turn, 2e-3)

    def slope(turn):
        return _slope(moment, turn, 1e-2)

    grid = np.linspace(*turns, 400)
    slopes = np.array([slope(t) for t in grid])
    at = np.flatnonzero(slopes[:-1] * slopes[1:] < 0)
    folds = [brentq(slope, grid[i], grid[i + 1], xtol=1e-12) for i in at]
    return np.array([(t, moment(t)) for t in folds])


# -- the four linkages ------------------------------------------------------------------------------------------

_CRANK, _COUPLER, _ROCKER, _D = (0.0, 0.4), (1.2, 0.35), (0.2, 0.75), np.array([1.0, 0.0])


def _four_bar_gap(q):
    return turned(_CRANK, q[0]) + turned(_COUPLER, q[1]) - _D - turned(_ROCKER, q[2])


def _four_bar_energy(q):
    crank, coupler, rocker = turned(_CRANK, q[0]), turned(_COUPLER, q[1]), turned(_ROCKER, q[2])
    heights = 1.0 * crank[1] / 2 + 3.0 * (crank[1] + coupler[1] / 2) + 2.0 * rocker[1] / 2
    return GRAVITY * heights + 20.0 * q[2] ** 2 / 2


def _four_bar_angles(turn):
    b = turned(_CRANK, turn)
    c = third_corner(b, _D, np.hypot(*_COUPLER), np.hypot(*_ROCKER), +1)
    return turn_between(_COUPLER, c - b), turn_between(_ROCKER, c - _D)


FOUR_BAR = Linkage(
    3, _four_bar_gap, _four_bar_energy, lambda turn: _four_bar_energy(np.array([turn, *_four_bar_angles(turn)]))
)

_SHORT, _ROD = (0.3, 0.4), (1.2, -0.4)


def _slider_gap(q):
    return turned(_SHORT, q[0]) + turned(_ROD, q[1]) - np.array([1.5 + q[2], 0.0])


def _slider_energy(q):
    crank, rod = turned(_SHORT, q[0]), turned(_ROD, q[1])
    return GRAVITY * (1.0 * crank[1] / 2 + 2.0 * (crank[1] + rod[1] / 2)) + 50.0 * q[2] ** 2 / 2


def _slider_closed(turn):
    b = turned(_SHORT, turn)
    c = np.array([b[0] + np.sqrt(1.2**2 + 0.4**2 - b[1] ** 2), 0.0])
    return _slider_energy(np.array([turn, turn_between(_ROD, c - b), c[0] - 1.5]))


SLIDER_CRANK = Linkage(3, _slider_gap, _slider_energy, _slider_closed)

_ARM, _COUPLER_2, _LEVER, _G = (0.4, 0.45), (1.2, 0.4), (0.2, 0.85), np.array([2.4, 0.0])


def _six_bar_gap(q):
    second = _D + turned(_ARM, q[2]) + turned(_COUPLER_2, q[3]) - _G - turned(_LEVER, q[4])
    return np.concatenate([_four_bar_gap(q), second])


def _six_bar_energy(q):
    crank, coupler, arm = turned(_CRANK, q[0]), turned(_COUPLER, q[1]), turned(_ARM, q[2])
    ternary, coupler_2, lever = turned((0.2, 0.4), q[2]), turned(_COUPLER_2, q[3]), turned(_LEVER, q[4])
    heights = 1.0 * crank[1] / 2 + 3.0 * (crank[1] + coupler[1] / 2) + 3.0 * ternary[1]
    heights += 2.0 * (arm[1] + coupler_2[1] / 2) + 2.0 * lever[1] / 2
    return GRAVITY * heights + 30.0 * q[4] ** 2 / 2


def _six_bar_closed(turn):
    coupler, rocker = _four_bar_angles(turn)
    e = _D + turned(_ARM, rocker)
    f = third_corner(e, _G, np.hypot(*_COUPLER_2), np.hypot(*_LEVER), +1)
    return _six_bar_energy(
        np.array([turn, coupler, rocker, turn_between(_COUPLER_2, f - e), turn_between(_LEVER, f - _G)])
    )


WATT_SIX_BAR = Linkage(5, _six_bar_gap, _six_bar_energy, _six_bar_closed)

_BAR, _HEIGHT, _FOOT = np.array([0.8, 0.8, 0.3]), 0.6, np.array([0.8, 0.8, 0.0])


def _spun(vector, r):
    """Return a vector turned by the rotation vector r."""
    t = np.sqrt(r @ r + 1e-40)
    cross = np.array(
        [
            r[1] * vector[2] - r[2] * vector[1],
            r[2] * vector[0] - r[0] * vector[2],
            r[0] * vector[1] - r[1] * vector[0],
        ]
    )
    return np.cos(t) * vector + np.sin(t) / t * cross + (1 - np.cos(t)) / t**2 * (r @ vector) * r


def _rssr_points(q):
    """Return B, the coupler's vector B-C and the rocker's D-C; q = crank, rotation vector of the coupler, rocker."""
    x, z = turned((0.0, 0.3), q[0])
    u = _spun(_BAR, q[1:4])
    ux, uz = turned((u[0], u[2]), q[0])
    return np.array([x, 0.0 * x, z]), np.array([ux, u[1], uz]), _rssr_rocker(q[4])


def _rssr_rocker(angle):
    return _HEIGHT * np.array([0.0 * angle, -np.sin(angle), np.cos(angle)])


def _rssr_gap(q):
    b, bar, rocker = _rssr_points(q)
    return b + bar - _FOOT - rocker


def _rssr_energy(q):
    b, bar, rocker = _rssr_points(q)
    heights = 1.0 * b[2] / 2 + 2.0 * (b[2] + bar[2] / 2) + 1.5 * rocker[2] / 2
    return GRAVITY * heights + 4.0 * (q[1:4] @ q[1:4]) / 2 + 10.0 * q[4] ** 2 / 2


def _rssr_closed(turn):
    """Return the energy with closed pins: of all spins of the coupler the least rotation at B has the least energy."""
    x, z = turned((0.0, 0.3), turn)
    b = np.array([x, 0.0, z])
    # |b - foot - h (0, -sin, cos)|^2 = L^2 is p cos + q sin = r
    apart = b - _FOOT
    p, q = 2 * _HEIGHT * apart[2], -2 * _HEIGHT * apart[1]
    r = apart @ apart + _HEIGHT**2 - _BAR @ _BAR
    # of the two angles, the one that is 0 in the pose qpos0
    rocker = np.arctan2(q, p) - np.arccos(r / np.hypot(p, q))
    bar = _FOOT + _rssr_rocker(rocker) - b
    ux, uz = turned((bar[0], bar[2]), -turn)
    angle = np.arccos(np.array([ux, bar[1], uz]) @ _BAR / (_BAR @ _BAR))
    heights = 1.0 * b[2] / 2 + 2.0 * (b[2] + bar[2] / 2) + 1.5 * _HEIGHT * np.cos(rocker) / 2
    return GRAVITY * heights + 4.0 * angle**2 / 2 + 10.0 * rocker**2 / 2


RSSR = Linkage(5, _rssr_gap, _rssr_energy, _rssr_closed, start=(0.0, 1e-6, 1e-6, 1e-6, 0.0))

LINKAGES = {"four_bar": FOUR_BAR, "slider_crank": SLIDER_CRANK, "watt_six_bar": WATT_SIX_BAR, "rssr": RSSR}
# as parameters of tests: those of more bodies, and in space, take seconds each
QUICK_FIRST = [pytest.param(n, marks=[pytest.mark.long] * (n in ("watt_six_bar", "rssr"))) for n in LINKAGES]
