"""Charts: rotation vectors in place of the quaternions of ball and free joints, along orbits.

A quaternion is r exp(xi), r the chart's reference and xi (3,) a rotation vector in the body's frame. With t = |xi|,

    omega = T xi',   T = 1 - a [xi]x + b [xi]x^2,   a = (1 - cos t) / t^2,   b = (t - sin t) / t^3
    xi'' = T^-1 (omega' - T' xi'),   T^-1 = 1 + [xi]x / 2 + c [xi]x^2,   c = (1 - t sin t / (2 (1 - cos t))) / t^2

T, the right Jacobian of the exponential map, is singular at t = 2 pi (Stuelpnagel, On the parametrization of the
three-dimensional rotation group, SIAM Review 6, 1964; Sola, Deray and Atchuthan, A micro Lie theory for state
estimation in robotics, arXiv:1812.01537, 2018). The coordinates of hinges, slides and places are their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mjcont.numerics.equations.problem import Array

# the largest angle, rad: nearer to a full turn T^-1 loses digits; beyond the other one a chart had better be laid anew
EDGE, NEAR_EDGE = 1.9 * math.pi, 1.5 * math.pi
# the entries of a vector after each, and before each
_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
# another reference is worth it where the largest angle shrinks by so much, rad
_BETTER = 0.1
# squares of angles below which series stand for a', b' (their derivatives in t^2), b and c: closed forms cancel
_SMALL = 0.01
_SERIES = np.array([
    [-1 / 24, 1 / 360, -1 / 13440, 1 / 907200], [-1 / 120, 1 / 2520, -1 / 120960, 1 / 9979200],
    [1 / 6, -1 / 120, 1 / 5040, -1 / 362880], [1 / 12, 1 / 720, 1 / 30240, 1 / 1209600],
])


@dataclass(frozen=True, eq=False)
class Chart:
    """Coordinates for the poses of a model with r ball and free joints.

    Attributes
    ----------
    joints : names of these joints.
    places : (r, 2) where each quaternion begins in a pose (nq,), and its rotation vector in the coordinates (nv,).
    reference : (r, 4) unit quaternions at which the rotation vectors are zero.
    """

    joints: tuple[str, ...]
    places: Array
    reference: Array

    def about(self, pose: Array) -> Chart:
        """Return the same chart with its reference in a pose (nq,)."""
        return replace(self, reference=_unit(pose[self._quaternions]))

    # -- poses and motions -------------------------------------------------------------------------------------

    def moving(self, xi: Array, slopes: Array) -> Moving:
        """Return motions at coordinates (k, nv) and their rates (k, nv)."""
        return Moving(self, xi, slopes)

    def poses(self, xi: Array) -> Array:
        """Return the poses (k, nq) at coordinates (k, nv)."""
        return self._posed(xi, self.rotations(xi))

    def rotations(self, xi: Array) -> Array:
        """Return the quaternions (k, r, 4) at coordinates (k, nv), continuous over half a turn and more."""
        return _product(self.reference, Turns(xi[:, self._vectors]).quaternions)

    def _posed(self, xi: Array, rotations: Array) -> Array:
        own, plain = self._plain(xi.shape[1])
        found = np.empty((len(xi), xi.shape[1] + len(self.joints)))
        found[:, plain], found[:, self._quaternions] = xi[:, own], rotations
        return found

    def coordinates(self, poses: Array) -> Array:
        """Return the coordinates (k, nv) of poses (k, nq), rotations at most half a turn."""
        turned = _product(_inverse(self.reference), _unit(poses[:, self._quaternions]))
        return self._coordinates(poses, np.where(turned[..., :1] < 0.0, -turned, turned))

    def taken(self, xi: Array, other: Chart) -> Array:
        """Return the coordinates here of coordinates (k, nv) in another chart, continuous where those are."""
        turned = _product(_inverse(self.reference), other.rotations(xi))
        return self._coordinates(other.poses(xi), turned)

    def _coordinates(self, poses: Array, turned: Array) -> Array:
        own, plain = self._plain(poses.shape[1] - len(self.joints))
        found = np.empty((len(poses), poses.shape[1] - len(self.joints)))
        found[:, own] = poses[:, plain]
        found[:, self._vectors] = _logarithm(turned)
        return found

    def speeds(self, xi: Array, slopes: Array) -> Array:
        """Return velocities (k, nv) from the coordinates' rates (k, nv) at coordinates (k, nv)."""
        return self.moving(xi, slopes).speeds

    def slopes(self, xi: Array, speeds: Array) -> Array:
        """Return the coordinates' rates (k, nv) from velocities (k, nv)."""
        return self._with(speeds, Turns(xi[:, self._vectors]).back(speeds[:, self._vectors]))

    def accelerations(self, xi: Array, slopes: Array, bends: Array) -> Array:
        """Return accelerations (k, nv) from the coordinates' rates and second rates (k, nv)."""
        at = Turns(xi[:, self._vectors])
        return self._with(bends, at.forward(bends[:, self._vectors]) + at.turning(slopes[:, self._vectors]))

    def _with(self, given: Array, rotations: Array) -> Array:
        found: Array = given.copy()
        found[:, self._vectors] = rotations
        return found

    # -- how far a chart reaches -------------------------------------------------------------------------------

    def angles(self, xi: Array) -> Array:
        """Return the angles (k, r), rad, between rotations and the reference."""
        found: Array = np.linalg.norm(xi[:, self._vectors], axis=2)
        return found

    def centred(self, xi: Array) -> Chart:
        """Return a chart for motion through coordinates (k, nv): one in their middle if that keeps it off the edge."""
        largest = self.angles(xi).max(axis=0)
        if not (largest > NEAR_EDGE).any():
            return self
        rotations = self.rotations(xi)
        mean = rotations.mean(axis=0)
        tried = np.concatenate([rotations, _unit(np.where(mean.any(axis=1)[:, None], mean, self.reference))[None]])
        cosines = np.einsum("kri,jri->kjr", tried, rotations).min(axis=1)  # of half the largest angle from each
        best, joints = cosines.argmax(axis=0), np.arange(len(largest))
        reached = 2.0 * np.arccos(np.clip(cosines[best, joints], -1.0, 1.0))
        better = (largest > NEAR_EDGE) & (reached < largest - _BETTER)
        if not better.any():
            return self
        return replace(self, reference=np.where(better[:, None], tried[best, joints], self.reference))

    def same(self, other: Chart) -> bool:
        """Whether another chart has the same reference."""
        return bool(np.array_equal(self.reference, other.reference))

    # -- where entries stand -----------------------------------------------------------------------------------

    @cached_property
    def _quaternions(self) -> Array:
        return self.places[:, :1] + np.arange(4)

    @cached_property
    def _vectors(self) -> Array:
        return self.places[:, 1:] + np.arange(3)

    def _plain(self, n: int) -> tuple[Array, Array]:
        """Return where entries that are no rotations stand, in nv coordinates and in poses."""
        found = np.ones(n, dtype=bool), np.ones(n + len(self.joints), dtype=bool)
        found[0][self._vectors], found[1][self._quaternions] = False, False
        return found


class Moving:
    """Motions in a chart.

    Attributes
    ----------
    poses, speeds : (k, nq) and (k, nv).
    angles : (k, r), rad, between rotations and the reference.
    """

    def __init__(self, chart: Chart, xi: Array, slopes: Array) -> None:
        self._chart, self._turns = chart, Turns(xi[:, chart._vectors])
        self._slopes = slopes[:, chart._vectors]
        self._rotations = _product(chart.reference, self._turns.quaternions)
        self.poses, self.angles = chart._posed(xi, self._rotations), self._turns.angle[..., 0]
        self.speeds = chart._with(slopes, self._turns.forward(self._slopes))

    def bends(self, accelerations: Array) -> Array:
        """Return the coordinates' second rates (k, nv) from accelerations (k, nv)."""
        own = accelerations[:, self._chart._vectors] - self._turns.turning(self._slopes)
        return self._chart._with(accelerations, self._turns.back(own))

    def past(self, rest: Array) -> Array:
        """Whether rotations are past half a turn from quaternions (r, 4), (k, r)."""
        side = np.where(np.einsum("ri,ri->r", self._chart.reference, rest) < 0.0, -1.0, 1.0)
        found: Array = side * np.einsum("kri,ri->kr", self._rotations, rest) < 0.0
        return found


# -- rotations (..., 3) and quaternions (..., 4) ----------------------------------------------------------------------


class Turns:
    """Rotation vectors x (..., 3), with T and its inverse there."""

    def __init__(self, x: Array) -> None:
        self.x, self.square = x, _dot(x, x)
        self.angle = np.sqrt(self.square)
        self._cosine, self._sinc = np.cos(0.5 * self.angle), np.sinc(self.angle / (2.0 * np.pi))

    @property
    def quaternions(self) -> Array:
        """exp(x), (..., 4)."""
        return np.concatenate([self._cosine, 0.5 * self._sinc * self.x], axis=-1)

    @cached_property
    def _factors(self) -> tuple[Array, Array, Array, Array, Array]:
        """Return a and b, their derivatives in t^2, and c, (..., 1) each."""
        s, near = self.square, self.square < _SMALL
        large, small = np.where(near, 1.0, s), np.where(near, s, 0.0)
        a = 0.5 * self._sinc**2
        b = (1.0 - self._sinc * self._cosine) / large
        closed = (
            ((1.0 - 2.0 * a) / large - b) / 2.0, (a - 3.0 * b) / (2.0 * large), b,
            (1.0 - self._cosine / self._sinc) / large,
        )
        series = (((r[3] * small + r[2]) * small + r[1]) * small + r[0] for r in _SERIES)
        over_a, over_b, b, c = (np.where(near, p, q) for p, q in zip(series, closed, strict=True))
        return a, b, over_a, over_b, c

    def forward(self, v: Array) -> Array:
        """Return T v."""
        a, b, _, _, _ = self._factors
        found: Array = v - a * _cross(self.x, v) + b * self._twice(v)
        return found

    def back(self, v: Array) -> Array:
        """Return T^-1 v."""
        found: Array = v + 0.5 * _cross(self.x, v) + self._factors[4] * self._twice(v)
        return found

    def turning(self, v: Array) -> Array:
        """Return T' v where x' = v."""
        _, b, over_a, over_b, _ = self._factors
        along = _dot(self.x, v)
        grown = over_b * self._twice(v) - over_a * _cross(self.x, v)
        found: Array = 2.0 * along * grown + b * (_dot(v, v) * self.x - along * v)
        return found

    def _twice(self, v: Array) -> Array:
        """Return x x (x x v)."""
        found: Array = _dot(self.x, v) * self.x - self.square * v
        return found


def _dot(u: Array, v: Array) -> Array:
    found: Array = (u * v).sum(axis=-1, keepdims=True)
    return found


def _cross(u: Array, v: Array) -> Array:
    found: Array = u[..., _NEXT] * v[..., _LAST] - u[..., _LAST] * v[..., _NEXT]
    return found


def _unit(q: Array) -> Array:
    found: Array = q / np.sqrt(_dot(q, q))
    return found


def _inverse(q: Array) -> Array:
    found: Array = q * np.array([1.0, -1.0, -1.0, -1.0])
    return found


def _product(p: Array, q: Array) -> Array:
    u, v = p[..., 1:], q[..., 1:]
    scalar = p[..., :1] * q[..., :1] - _dot(u, v)
    return np.concatenate([scalar, p[..., :1] * v + q[..., :1] * u + _cross(u, v)], axis=-1)


def _logarithm(q: Array) -> Array:
    """Return the rotation vectors of unit quaternions, of up to a full turn where the scalar part is negative."""
    size = np.sqrt(_dot(q[..., 1:], q[..., 1:]))
    angle = 2.0 * np.arctan2(size, q[..., :1])
    found: Array = q[..., 1:] * np.where(size > 0.0, angle / np.where(size > 0.0, size, 1.0), 2.0)
    return found
