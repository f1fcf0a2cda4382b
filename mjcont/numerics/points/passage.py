"""How late a load that changes at a finite rate leaves a fold.

Near a fold the motion along the null vector v, u = x v, under a load that has passed it by `rate` t, obeys

    inertia x'' + damping x' = slope rate t + curvature x^2

with damping = w . C v, inertia = w . (M v + C u1), slope = w . f_p, curvature = w . B(v, v) / 2; u1 is how the other
motions lag behind, K u1 = (w . C v) b - C v with v . u1 = 0, and b = f_p / (w . f_p) how the load works. In units of
the time T and the length (damping / T + inertia / T^2) / curvature this is m x'' + (1 - m) x' = s + x^2, whose motion
from the vanishing rest runs away at s = D(m): D(0) = 2.338107, less the first zero of Airy's function Ai, where damping
rules, and D(1) = 6^(1/5) 2.384169, the pole of the tritronquee solution of the first Painleve equation, where inertia
does. The load's shift grows with rate^(2/3) and rate^(4/5).

Sources: R. Haberman, SIAM J. Appl. Math. 37 (1979) 69-106; N. Joshi and A. V. Kitaev, Stud. Appl. Math. 107 (2001)
253-291.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import odeint
from scipy.special import ai_zeros

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.defining import pencil_of
from mjcont.numerics.equations.differences import second_form
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Local
from mjcont.numerics.points.normalform import bordered_solve

# where motions of the normal form begin, and end; how far their logarithm grows until what is left is nothing
_BEFORE, _AFTER, _GROWN = 30.0, 10.0, 60.0
# below this part of inertia its effect is known in closed form
_STIFF = 1e-3
# damping is none below this part of what its terms add up to
_UNDAMPED = 1e-9


@dataclass(frozen=True, slots=True)
class Passage:
    """The normal form of a fold that a load passes slowly, in the unit of the load, SI else.

    Attributes
    ----------
    inertia, damping : of the motion along the null vector.
    slope, curvature : force along it that a unit of load makes, and that its square makes, both as positive numbers.
    """

    inertia: float
    damping: float
    slope: float
    curvature: float

    def time(self, rate: float) -> float:
        """Return the time in s between the fold and the moment of the jump under a load with |rate| per s."""
        unit = self._unit(abs(rate))
        return unit * runaway(self._mixture(unit))

    def shift(self, rate: float) -> float:
        """Return how far beyond the fold the load then is, as a positive number."""
        return abs(rate) * self.time(rate)

    def rate(self, shift: float) -> float:
        """Return the rate, per s, at which the load is a shift beyond the fold at the jump."""
        if not (shift > 0.0 and math.isfinite(self._strength)):
            return math.nan
        # the shift grows with the rate, by a power between 2/3 and 4/5
        low = high = 1.0
        for _ in range(400):
            if self.shift(low) < shift < self.shift(high):
                break
            low, high = (low * 0.1, high) if self.shift(low) >= shift else (low, high * 10.0)
        found = root(lambda z: math.log(self.shift(math.exp(z)) / shift), math.log(low), math.log(high))
        return math.exp(found)

    def inertial(self, rate: float) -> float:
        """Return the part of inertia in what delays the jump, 0 (damping alone) to 1."""
        return self._mixture(self._unit(abs(rate)))

    @property
    def _strength(self) -> float:
        return self.slope * self.curvature

    def _unit(self, rate: float) -> float:
        """Return T, with (damping / T + inertia / T^2)^2 = slope curvature rate T."""
        drive = np.float64(self._strength * rate)
        if not (drive > 0.0 and (self.damping > 0.0 or self.inertia > 0.0)):
            return math.nan
        damped, inert = np.cbrt(self.damping**2 / drive), (self.inertia**2 / drive) ** 0.2

        def excess(z: float) -> float:
            t = math.exp(z)
            return math.log((self.damping / t + self.inertia / t**2) ** 2 / (drive * t))

        # the true T is longer than with either alone, and less than twice as long as with the slower
        low, high = max(damped, inert), 2.0 * max(damped, inert)
        return math.exp(root(excess, math.log(low * (1.0 - 1e-12)), math.log(high)))

    def _mixture(self, unit: float) -> float:
        return self.inertia / (self.inertia + self.damping * unit)


def passage(local: Local, v: Array, w: Array, load: Array) -> Passage | None:
    """Return the normal form at a fold with null vectors v and w (any length) for a load's df/dp (n,).

    None where there is none: no load along w, no curvature or no damping and inertia. Inertia that comes out negative,
    where other motions lag rather than swing, counts as none.
    """
    mass, damping, stiffness = pencil_of(local)
    v, w = v / np.linalg.norm(v), w / np.linalg.norm(w)
    slope, resistance = float(w @ load), damping @ v
    along = float(w @ resistance)
    shape = load / slope if slope else np.full(len(v), np.nan)
    lag = bordered_solve(stiffness, w, v, along * shape - resistance)
    inertia = float(w @ (mass @ v + damping @ lag))
    # the rest is stable before the fold: damping is positive, or, where there is none, inertia
    damped = abs(along) > _UNDAMPED * float(np.abs(w) @ (abs(damping) @ np.abs(v)))
    inertia *= math.copysign(1.0, along if damped else inertia)
    curvature = float(0.5 * w @ second_form(local.problem, local.x, local.values, v, v))
    found = Passage(max(inertia, 0.0), abs(along), abs(slope), abs(curvature))
    numbers = (found.inertia, found.damping, found.slope, found.curvature)
    whole = all(map(math.isfinite, numbers)) and min(found.slope, found.curvature) > 0.0
    return found if whole and max(numbers[:2]) > 0.0 else None


def runaway(mixture: float) -> float:
    """Return D(m), at which m x'' + (1 - m) x' = s + x^2 runs away; NaN where m is not from 0 to 1."""
    damped = float(-ai_zeros(1)[0][0])
    if not 0.0 <= mixture <= 1.0:
        return math.nan
    if mixture >= _STIFF:
        return _integrated(mixture)
    # in the limit the last piece, where x is about 1 / m, adds m (2 log(1 / m) + c)
    c = (_integrated(_STIFF) - damped) / _STIFF + 2.0 * math.log(_STIFF)
    return damped + mixture * (c - 2.0 * math.log(mixture)) if mixture else damped


def _integrated(m: float) -> float:
    """Return D(m) by integration along x, which grows all the time, and along its logarithm once it is large."""
    # the rest's own motion, x = -sqrt(-s) and the next term, with its derivative
    x = -math.sqrt(_BEFORE + (1.0 - m) * 0.5 * _BEFORE**-0.5 + m * 0.25 * _BEFORE**-1.5)
    speed = (1.0 - (1.0 - m) * 0.25 * _BEFORE**-1.5 - m * 0.375 * _BEFORE**-2.5) / (-2.0 * x)

    def near(u: Array, x: float) -> tuple[float, float]:
        s, speed = u
        return 1.0 / speed, ((s + x**2 - (1.0 - m) * speed) / m) / speed

    def far(u: Array, z: float) -> tuple[float, float]:  # u[1] is the growth x' / x
        (s, growth), size = u, math.exp(z)
        return 1.0 / growth, ((s / size + size - (1.0 - m) * growth) / m) / growth - growth

    s, speed = odeint(near, (-_BEFORE, speed), (x, _AFTER), rtol=1e-9, atol=1e-11, mxstep=10_000)[-1]
    z = math.log(_AFTER)
    return float(odeint(far, (s, speed / _AFTER), (z, z + _GROWN), rtol=1e-9, atol=1e-11, mxstep=10_000)[-1, 0])
