"""Folds and cusps of many variants of a problem moved to other variants, side by side.

As a point is moved alone: predicted by its derivative in the parameters, corrected by Newton's method with derivatives
of its own, and accepted where prediction, solution and the derivatives at both ends agree and the orientation is as it
was. There is one step: what it does not take is left to who asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.directions import dot
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Equations, Variants
from mjcont.numerics.points.bundle import Bundle

# longest predicted step, scaled; parts of a step, and a length, by which prediction and solution may differ
REACH, AGREE, CLOSE = 0.3, 0.2, 1e-4
_TOL, _NEWTON, _POLISH = 1e-12, 5, 4
# a Newton step below which its derivatives do for what is left
_NEAR = 1e-6
# a correction that is no shorter than half the one before is noise: below this after a Newton step, below that after
# another correction
_NOISE, _NOISE_AGAIN = 1e-9, 1e-6


@dataclass(frozen=True, slots=True)
class Moved:
    """Where points came to, one row each.

    Attributes
    ----------
    reached : (K,) bool
        Whether a point was moved; the rest has no meaning where it was not.
    x, values : states (K, nq) and values of the free parameters (K, k).
    tolerance : (K,)
        The last correction, scaled.
    coefficient : (K,)
        Of the normal form, with |v| = 1 and w . v = 1.
    evaluations : (K,) int
    """

    reached: Array
    x: Array
    values: Array
    tolerance: Array
    coefficient: Array
    evaluations: Array


def move(
    problem: Equations, variants: Variants, x: Array, free: Sequence[Sequence[Free]], values: Array, like: Array
) -> Moved:
    """Move points from one set of variants to another; arguments as of a `Bundle`.

    `like` (K,) has for each point the first that is the same one on the same variant.
    """
    bundle = Bundle(problem, variants, x, free, values)
    with np.errstate(all="ignore"):
        return _Move(bundle, like).moved()


class _Move:
    """Members of a bundle on their way.

    `alive` marks those that were not given up, `settled` those that have arrived; `start` and `last` have G linearised
    where members come from, and where it was last.
    """

    def __init__(self, bundle: Bundle, like: Array) -> None:
        self.bundle = bundle
        count = bundle.count
        firsts = np.unique(like)
        start, defined = bundle.begin(firsts)
        place = np.searchsorted(firsts, like)
        bundle.share(np.arange(count), like)
        self.start, self.alive = start.of(place), defined[place]
        self.last = start.of(place)
        self.x, self.y = bundle.x.copy(), bundle.y.copy()
        self.settled = np.zeros(count, dtype=bool)
        self.tolerance = np.full(count, np.inf)

    def moved(self) -> Moved:
        """Predict, correct and check."""
        bundle, everyone = self.bundle, np.arange(self.bundle.count)
        predicted = -self.start.solved(bundle.change(everyone, self.start, True))
        self._leave(everyone, ~(_norms(predicted) <= REACH))
        going = self._going()
        self.x[going], self.y[going] = bundle.moved(self.x[going], self.y[going], predicted[going])
        for _ in range(_NEWTON):
            going = self._going()
            if not len(going):
                break
            self._newton(going)
        self._leave(everyone, ~self.settled)
        self._check(np.flatnonzero(self.alive), predicted)
        reached = np.flatnonzero(self.alive)
        values, coefficient = np.full((bundle.count, bundle.k), np.nan), np.full(bundle.count, np.nan)
        y, found = bundle.finished(reached, self.last.of(reached), self.x[reached], self.y[reached])
        values[reached], coefficient[reached] = bundle.values(reached, y), found
        return Moved(self.alive, self.x, values, self.tolerance, coefficient, bundle.counts)

    def _going(self) -> Array:
        return np.flatnonzero(self.alive & ~self.settled)

    def _leave(self, members: Array, which: Array) -> None:
        self.alive[members[which]] = False

    def _newton(self, members: Array) -> None:
        """Take a Newton step, and corrections with its derivatives where it is short."""
        bundle = self.bundle
        here = bundle.linear(members, self.x[members], self.y[members])
        self.last.put(members, here)
        sizes = self._step(members, -here.solved(here.value))
        self._leave(members, ~(sizes <= REACH))
        close, before = members[sizes <= _NEAR], sizes[sizes <= _NEAR]
        for turn in range(_POLISH):
            at = self.last.of(close)
            sizes = self._step(close, -at.solved(bundle.value(close, self.x[close], self.y[close])))
            self.tolerance[close] = sizes
            noise = (sizes > 0.5 * before) & (sizes <= (_NOISE_AGAIN if turn else _NOISE))
            done = noise | (sizes <= _TOL)
            self.settled[close[done]] = True
            close, before = close[~done], sizes[~done]

    def _step(self, members: Array, step: Array) -> Array:
        """Move by scaled steps and return their lengths."""
        self.x[members], self.y[members] = self.bundle.moved(self.x[members], self.y[members], step)
        return _norms(step)

    def _check(self, members: Array, predicted: Array) -> None:
        """Leave what is not the point predicted, or not on the same curve, or turned."""
        bundle, start, last = self.bundle, self.start.of(members), self.last.of(members)
        moved = bundle.difference(self.x[members], self.y[members], start.x, start.y)
        size = _norms(moved)
        ahead = last.solved(bundle.change(members, last, False))  # backwards: the sign is that of going on
        off, bent = moved - predicted[members], moved - 0.5 * (predicted[members] + ahead)
        agree = (_norms(off) <= AGREE * size + CLOSE) & (_norms(bent) <= 0.5 * AGREE * size + CLOSE)
        self._leave(members, ~(agree & (last.sign * start.sign > 0.0)))


def _norms(steps: Array) -> Array:
    found: Array = np.sqrt(dot(steps, steps))
    return found
