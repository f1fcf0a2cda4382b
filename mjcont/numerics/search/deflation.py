"""More solutions of f(x) = 0 at one parameter: Newton's method from many starts, away from the solutions known.

Deflation multiplies f by a scalar that has a pole at each known solution r_i,

    m(x) = prod_i (1 / |x - r_i|^2 + 1),

so that Newton's method on m f cannot converge to them again. Its step is that of f times a scalar (Sherman-Morrison):

    s = d / (1 - grad(log m) . d),   d = -J^-1 f.

Source: Farrell, Birkisson, Funke, Deflation techniques for finding distinct solutions of nonlinear partial
differential equations, SIAM J. Sci. Comput. 37 (2015) A2026.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.search.multistart import Many, Runs, shortened, spectral_step


@dataclass(frozen=True, slots=True)
class Deflation:
    """The deflation operator of known solutions.

    Attributes
    ----------
    separation : callable
        `separation(states)` returns the scaled steps from every known solution to every state, (m, r, n), in which
        full turns of periodic angles do not count.
    periods : (n,) array
        Period of each scaled coordinate, inf where it has none.
    """

    separation: Callable[[Array], Array]
    periods: Array

    def log_gradient(self, states: Array) -> Array:
        """Return the gradient of log m at each state in scaled coordinates, (m, n).

        The distance along a periodic coordinate is the chord (P / pi) sin(pi u / P), which is smooth at half a turn.
        """
        chord, slope = self.separation(states), np.ones(len(self.periods))
        if np.isfinite(self.periods).any():
            turning = np.isfinite(self.periods)
            rate = np.where(turning, np.pi / np.where(turning, self.periods, 1.0), 1.0)
            angle = rate * chord
            chord = np.where(turning, np.sin(angle) / rate, chord)
            slope = np.where(turning, np.cos(angle), 1.0)
        squared = np.maximum(np.einsum("mri,mri->mr", chord, chord), 1e-30)
        # the logarithmic derivative of 1 / d^2 + 1
        found: Array = np.einsum("mr,mri->mi", -2.0 / (squared * (1.0 + squared)), chord * slope)
        return found

    def factor(self, states: Array, steps: Array) -> Array:
        """Return what Newton's steps of f are multiplied by, (m,)."""
        below = 1.0 - np.sum(self.log_gradient(states) * steps, axis=1)
        return 1.0 / np.where(np.abs(below) > 1e-12, below, 1e-12)


def newton(
    many: Many, states: Array, deflation: Deflation | None = None, *, most: int = 40, tol: float = 1e-7
) -> Runs:
    """Run Newton's method from every state at once, with steps of limited length, on f or on the deflated f.

    Where a stiff part of the model makes the valleys of |f| narrow this finds what Levenberg-Marquardt does not: its
    steps do not depend on how equations are scaled.
    """
    x, active = states.copy(), np.arange(len(states))
    converged, sign = np.zeros(len(x), dtype=bool), np.zeros(len(x))
    for _ in range(most):
        direct, sigma, orientation = spectral_step(*many.linearize(x[active]))
        usable = np.all(np.isfinite(direct), axis=1) & (sigma[:, 0] > 0)
        active, direct, orientation = active[usable], direct[usable], orientation[usable]
        done = np.linalg.norm(direct, axis=1) < tol
        step = direct if deflation is None else direct * deflation.factor(x[active], direct)[:, None]
        step = np.where(done[:, None], direct, shortened(step))
        x[active] = many.move(x[active], step)
        converged[active[done]], sign[active[done]] = True, orientation[done]
        active = active[~done & many.near(x[active])]
        if not len(active):
            break
    return Runs(x, converged, sign)
