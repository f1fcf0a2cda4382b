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
# another reference is worth it where the largest angle shrinks by so much, rad
_BETTER = 0.1
_SERIES = [tuple((-1.0) ** j / math.factorial(k + 2 * j) for j in range(10)) for k in (4, 5)]


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

    def poses(self, xi: Array) -> Array:
        """Return the poses (k, nq) at coordinates (k, nv)."""
        own, plain = self._plain(xi.shape[1])
        found = np.empty((len(xi), xi.shape[1] + len(self.joints)))
        found[:, plain] = xi[:, own]
        found[:, self._quaternions] = self.rotations(xi)
        return found

    def rotations(self, xi: Array) -> Array:
        """Return the quaternions (k, r, 4) at coordinates (k, nv), continuous over half a turn and more."""
        return _product(self.reference, _exponential(xi[:, self._vectors]))

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
        return self._with(slopes, _forward(xi[:, self._vectors], slopes[:, self._vectors]))

    def slopes(self, xi: Array, speeds: Array) -> Array:
        """Return the coordinates' rates (k, nv) from velocities (k, nv)."""
        return self._with(speeds, _back(xi[:, self._vectors], speeds[:, self._vectors]))

    def accelerations(self, xi: Array, slopes: Array, bends: Array) -> Array:
        """Return accelerations (k, nv) from the coordinates' rates and second rates (k, nv)."""
        x, v = xi[:, self._vectors], slopes[:, self._vectors]
        return self._with(bends, _forward(x, bends[:, self._vectors]) + _turning(x, v))

    def bends(self, xi: Array, slopes: Array, accelerations: Array) -> Array:
        """Return the coordinates' second rates (k, nv) from accelerations (k, nv)."""
        x, v = xi[:, self._vectors], slopes[:, self._vectors]
        return self._with(accelerations, _back(x, accelerations[:, self._vectors] - _turning(x, v)))

    def _with(self, given: Array, rotations: Array) -> Array:
        found: Array = given.copy()
        found[:, self._vectors] = rotations
        return found

    # -- how far a chart reaches -------------------------------------------------------------------------------

    def angles(self, xi: Array) -> Array:
        """Return the angles (k, r), rad, between rotations and the reference."""
        found: Array = np.linalg.norm(xi[:, self._vectors], axis=2)
        return found

    def past(self, xi: Array, rest: Array) -> Array:
        """Whether rotations at coordinates (k, nv) are past half a turn from quaternions (r, 4), (k, r)."""
        side = np.where(np.einsum("ri,ri->r", self.reference, rest) < 0.0, -1.0, 1.0)
        found: Array = side * np.einsum("kri,ri->kr", self.rotations(xi), rest) < 0.0
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


# -- rotations (..., 3) and quaternions (..., 4) ----------------------------------------------------------------------


def _unit(quaternions: Array) -> Array:
    found: Array = quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)
    return found


def _inverse(q: Array) -> Array:
    found: Array = q * np.array([1.0, -1.0, -1.0, -1.0])
    return found


def _product(p: Array, q: Array) -> Array:
    p, q = np.broadcast_arrays(p, q)
    scalar = p[..., 0] * q[..., 0] - np.einsum("...i,...i->...", p[..., 1:], q[..., 1:])
    vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([scalar[..., None], vector], axis=-1)


def _exponential(x: Array) -> Array:
    """Return the quaternions of rotation vectors."""
    half = 0.5 * np.linalg.norm(x, axis=-1, keepdims=True)
    return np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * x], axis=-1)


def _logarithm(q: Array) -> Array:
    """Return the rotation vectors of unit quaternions, of up to a full turn where the scalar part is negative."""
    size = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(size, q[..., :1])
    found: Array = q[..., 1:] * np.where(size > 0.0, angle / np.where(size > 0.0, size, 1.0), 2.0)
    return found


def _factors(x: Array) -> tuple[Array, Array, Array, Array]:
    """Return a, b, (1/2 - a) / t^2 and (1/6 - b) / t^2 at rotation vectors of angle t, (..., 1) each."""
    square = np.einsum("...i,...i->...", x, x)[..., None]
    small, large = np.minimum(square, 1.0), np.maximum(square, 1.0)
    d, e = (sum(term * small**j for j, term in enumerate(terms)) for terms in _SERIES)
    t = np.sqrt(large)
    a, b = 2.0 * np.sin(0.5 * t) ** 2 / large, (t - np.sin(t)) / (large * t)
    near = square < 1.0
    return (
        np.where(near, 0.5 - small * d, a), np.where(near, 1.0 / 6.0 - small * e, b),
        np.where(near, d, (0.5 - a) / large), np.where(near, e, (1.0 / 6.0 - b) / large),
    )


def _forward(x: Array, v: Array) -> Array:
    """Return T v at rotation vectors x."""
    a, b, _, _ = _factors(x)
    across = np.cross(x, v)
    found: Array = v - a * across + b * np.cross(x, across)
    return found


def _back(x: Array, v: Array) -> Array:
    """Return T^-1 v."""
    a, b, d, _ = _factors(x)
    across = np.cross(x, v)
    found: Array = v + 0.5 * across + (b - 2.0 * d) / (2.0 * a) * np.cross(x, across)
    return found


def _turning(x: Array, v: Array) -> Array:
    """Return T' v where x' = v."""
    _, b, d, e = _factors(x)
    growth = 2.0 * np.einsum("...i,...i->...", x, v)[..., None]  # of t^2
    across = np.cross(x, v)
    turned = (d - 0.5 * b) * growth * across  # a and b change by d - b/2 and (3 e - d) / 2 of it
    found: Array = 0.5 * (3.0 * e - d) * growth * np.cross(x, across) - turned + b * np.cross(v, across)
    return found
