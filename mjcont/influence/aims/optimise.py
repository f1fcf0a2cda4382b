"""The optimiser: SciPy's SLSQP in a box that shrinks where a point ceases to exist, and the nearest if nothing will do.

A design is done when the conditions hold and the gradient of the Lagrangian, projected on the bounds, vanishes (Karush,
Kuhn and Tucker). Where the conditions exclude each other the least sum of the squares of what is missing is sought, by
SciPy's least squares; those that are missed there pull against each other, and are named.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import least_squares, lsq_linear, minimize

from mjcont.influence.aims.followed import Lost
from mjcont.influence.aims.program import Program
from mjcont.numerics.equations.problem import Array

# accuracies of the objective in SLSQP: before full steps finish, and where they do not
_COARSE, _FINE, _MOST = 1e-7, 1e-14, 100
# conditions: within this of zero they are active; steps that polish them
_ACTIVE, _POLISH = 1e-6, 6
# full steps that finish: most of them, the gradient of the Lagrangian at which they end, and what lies near its limit
_FULL, _FLAT, _NEAR = 12, 1e-10, 1e-3
# the smallest box (scaled) beside where a point ceases, the part to which it shrinks, and most boxes
_SMALLEST, _SHRINK, _BOXES = 1e-3, 0.25, 60
_ON_BOUND = 1e-9
# designs that may be tried without what is missing falling to this part
_PATIENCE, _FALLS = 12, 0.7
# designs so close to each other (scaled) that differ by rounding, and how many of them are tried
_CLOSE, _STAYS = {_COARSE: 1e-2, _FINE: 1e-8}, 5
# what may be missing of a design from which full steps go on
_FAIR = 0.1
# least squares of what is missing: relative change at which they end, and most designs
_SETTLED, _TRIES = 1e-11, 40


class _Stalled(Exception):
    """Designs come no nearer to the conditions, which may exclude each other; or they differ by rounding alone."""


@dataclass(slots=True)
class Ended:
    """Where an optimisation ended.

    Attributes
    ----------
    v : the scaled design.
    met : whether the conditions hold to `tol`.
    stationary : whether it is a best one, or what is missing least.
    multipliers : (m,) of the conditions, in units of the objective.
    bounds : (d,) multipliers of bounds, positive at a lower and negative at an upper one.
    kkt : the largest component of the Lagrangian's gradient.
    cuts : sentences on where points ceased to exist.
    path : designs on the way.
    """

    v: Array
    met: bool
    stationary: bool
    multipliers: Array
    bounds: Array
    kkt: float
    cuts: list[str] = field(default_factory=list)
    path: list[Array] = field(default_factory=list)


class _Run:
    """One optimisation of a program."""

    def __init__(self, program: Program, tol: float, tell: Callable[[], None]) -> None:
        self.program, self.tol, self.tell = program, tol, tell
        self.path: list[Array] = []
        self.cuts: list[str] = []
        self._last: tuple[bytes, tuple[Array, Array]] | None = None
        self._tried: Array | None = None
        self._least, self._since, self._impatient = (np.inf, np.zeros(0)), 0, False
        self._place: Array | None = None
        self._stays, self._close = 0, 0.0

    def values(self, v: Array) -> tuple[Array, Array]:
        """Return conditions and gradients, kept for the design asked for last."""
        key = v.tobytes()
        if self._last is None or self._last[0] != key:
            self._tried = v.copy()
            self._last = key, self.program.values(v)
            self.tell()
            self._watch(v, self._last[1][0])
        return self._last[1]

    def _watch(self, v: Array, c: Array) -> None:
        """Note the design that misses least; end a run that tries one after the other without coming nearer."""
        missing = float(np.abs(self.program.missing(c)).max(initial=0.0))
        if self._place is not None and np.abs(v - self._place).max() <= self._close * max(1.0, float(np.abs(v).max())):
            self._stays += 1
            if missing < self._least[0]:
                self._least = missing, v.copy()
            if self._impatient and self._stays > _STAYS:
                raise _Stalled
        else:
            self._place, self._stays = v.copy(), 0
            self._least = (missing, v.copy()) if missing <= _FAIR else self._least
        if missing < _FALLS * self._least[0] or missing <= _ACTIVE:
            self._least, self._since = (missing, v.copy()), 0
            return
        self._since += 1
        if self._impatient and self._since > _PATIENCE:
            raise _Stalled

    def run(self, v: Array) -> Ended:
        """Return where the optimisation ends from a design at which the points exist."""
        radius, base = np.inf, v
        for _ in range(_BOXES):
            low = np.maximum(self.program.low, base - radius)
            high = np.minimum(self.program.high, base + radius)
            self.path.append(base)
            try:
                end, feasible = self._within(base, low, high)
            except Lost as lost:
                assert self._tried is not None
                radius = _SHRINK * min(radius, float(np.abs(self._tried - base).max()))
                self._said(f"a step was cut: {lost}")
                if radius < _SMALLEST:
                    return self._ended(base, False)
                continue
            held = (end <= low + _ON_BOUND) & (low > self.program.low) | (end >= high - _ON_BOUND) & (
                high < self.program.high)
            base = end
            if not held.any():
                return self._ended(base, True)
            radius *= 1.0 if self.cuts else 2.0
        return self._ended(base, False)

    def _said(self, sentence: str) -> None:
        if sentence not in self.cuts:
            self.cuts[1:] = [sentence] if self.cuts else []
            self.cuts = self.cuts or [sentence]

    def _within(self, v: Array, low: Array, high: Array) -> tuple[Array, bool]:
        """Return the best design in a box, or the one that misses least, and whether the conditions hold."""
        enough = max(self.tol, _ACTIVE)
        end = self._finished(self._slsqp(v, low, high, _COARSE), low, high)
        if end is not None:
            return end, True
        end = self._slsqp(v, low, high, _FINE)
        if self._missing(end) > enough:
            nearest = self._nearest(end, low, high)
            if self._missing(nearest) > enough:
                return nearest, False
            end = self._slsqp(nearest, low, high, _FINE)
            end = end if self._missing(end) <= enough else nearest
        finished = self._finished(end, low, high)
        end = self._polished(end, low, high) if finished is None else finished
        return end, self._missing(end) <= self.tol

    def _finished(self, v: Array, low: Array, high: Array) -> Array | None:
        """Return the best design by full steps on the Lagrangian from one close to it, None where they lead elsewhere.

        Each solves the equations of Karush, Kuhn and Tucker for what is active, with a Hessian updated by BFGS.
        """
        hessian = 2.0 * np.eye(len(v))
        kkt, multipliers, active, free, left = self._kkt(v, low, high)
        for _ in range(_FULL):
            if kkt <= _FLAT and self._missing(v) <= self.tol:
                return v
            c, gradient = self.values(v)
            rows = gradient[active][:, free]
            size, count = int(free.sum()), len(rows)
            matrix = np.zeros((size + count, size + count))
            matrix[:size, :size], matrix[size:, :size], matrix[:size, size:] = hessian[free][:, free], rows, rows.T
            rhs = np.concatenate([-left[free], -c[active]])
            step = np.zeros(len(v))
            step[free] = np.linalg.lstsq(matrix, rhs, rcond=1e-12)[0][:size]
            if not np.abs(step).max(initial=0.0) <= _NEAR * 1e2:
                return None
            moved = np.clip(v + step, low, high)
            before = self._lagrangian(v, multipliers)
            after, new, active, free, left = self._kkt(moved, low, high)
            change = self._lagrangian(moved, multipliers) - before
            hessian = _updated(hessian, moved - v, change)
            if after > max(10.0 * kkt, _ACTIVE) and after > 1e-4:
                return None
            v, kkt, multipliers = moved, after, new
        return v if kkt <= 1e-7 and self._missing(v) <= self.tol else None

    def _lagrangian(self, v: Array, multipliers: Array) -> Array:
        """Return the gradient of the Lagrangian with given multipliers of all conditions."""
        found: Array = self.program.objective_at(v)[1] - self.values(v)[1].T @ multipliers
        return found

    def _kkt(self, v: Array, low: Array, high: Array) -> tuple[float, Array, Array, Array, Array]:
        """Return the gradient of the Lagrangian left over (its size, multipliers, active, free and itself)."""
        c, gradient = self.values(v)
        slope = self.program.objective_at(v)[1]
        equal = self.program.equal
        near = equal | (c <= _NEAR)
        below, above = v <= low + _ON_BOUND, v >= high - _ON_BOUND
        found = _multipliers(gradient[near], equal[near], below, above, slope)
        multipliers = np.zeros(len(c))
        multipliers[near] = found[0]
        active = equal | (np.abs(multipliers) > 0.0) | (c < -self.tol)
        free = ~(below | above) | (np.abs(found[1]) <= 0.0)
        return float(np.abs(found[2]).max(initial=0.0)), multipliers, active, free, found[2]

    def _missing(self, v: Array) -> float:
        c, _ = self.values(v)
        return float(np.abs(self.program.missing(c)).max(initial=0.0))

    def _slsqp(self, v: Array, low: Array, high: Array, accuracy: float) -> Array:
        equal = self.program.equal
        constraints = [
            {"type": kind, "fun": lambda w, m=mask: self.values(w)[0][m], "jac": lambda w, m=mask: self.values(w)[1][m]}
            for kind, mask in (("eq", equal), ("ineq", ~equal)) if mask.any()
        ]
        self._least, self._since, self._impatient, self._place = (np.inf, v), 0, True, None
        self._close = _CLOSE[accuracy]
        try:
            end = minimize(
                lambda w: self.program.objective_at(w)[0], v, jac=lambda w: self.program.objective_at(w)[1],
                method="SLSQP", bounds=list(zip(low, high, strict=True)), constraints=constraints,
                options={"ftol": accuracy, "maxiter": _MOST},
            ).x
        except _Stalled:
            end = self._least[1]
        finally:
            self._impatient = False
        clipped: Array = np.clip(end, low, high)
        return clipped if np.all(np.isfinite(clipped)) else v

    def _nearest(self, v: Array, low: Array, high: Array) -> Array:
        """Return the design that misses the conditions least."""
        def missed(w: Array) -> Array:
            try:
                return self.program.missing(self.values(w)[0])
            except Lost as lost:
                self._said(f"a step was cut: {lost}")
                return np.full(len(self.program.conditions), np.inf)

        def slopes(w: Array) -> Array:
            c, gradient = self.values(w)
            return np.where(self.program.missing(c)[:, None] != 0.0, gradient, 0.0)

        inside = np.clip(v, low, np.nextafter(high, low))
        found = least_squares(missed, inside, slopes, bounds=(low, high), xtol=_SETTLED, ftol=_SETTLED,
                              gtol=_SETTLED, max_nfev=_TRIES)
        clipped: Array = np.clip(found.x, low, high)
        return clipped

    def _polished(self, v: Array, low: Array, high: Array) -> Array:
        """Return the design moved by the shortest steps to where active conditions hold as well as they can."""
        for _ in range(_POLISH):
            c, gradient = self.values(v)
            active = self._active(c)
            free = (v > low + _ON_BOUND) & (v < high - _ON_BOUND)
            if not active.any() or not free.any() or np.abs(c[active]).max() < 1e-13:
                break
            step = np.zeros(len(v))
            step[free] = -np.linalg.lstsq(gradient[active][:, free], c[active], rcond=1e-10)[0]
            moved = np.clip(v + step, low, high)
            if self._missing(moved) >= self._missing(v) or np.linalg.norm(step) > 1e-2:
                break
            v = moved
        return v

    def _active(self, c: Array) -> Array:
        equal = self.program.equal
        return equal | (np.abs(c) <= _ACTIVE)

    def _ended(self, v: Array, whole: bool) -> Ended:
        low, high = self.program.low, self.program.high
        v = np.where(v <= low + _ON_BOUND, low, np.where(v >= high - _ON_BOUND, high, v))  # not beside it by rounding
        c, gradient = self.values(v)
        missing = self.program.missing(c)
        met = bool(np.abs(missing).max(initial=0.0) <= self.tol)
        slope = self.program.objective_at(v)[1] if met else gradient.T @ missing
        below, above = v <= self.program.low + _ON_BOUND, v >= self.program.high - _ON_BOUND
        equal = self.program.equal
        kept = self._active(c) & met
        multipliers = np.zeros(len(c))
        multipliers[kept], bounds, left = _multipliers(gradient[kept], equal[kept], below, above, slope)
        kkt = float(np.abs(left).max(initial=0.0)) / max(1.0, float(np.abs(slope).max(initial=0.0)))
        return Ended(v, met, whole and kkt <= 1e-5, multipliers, bounds, kkt, self.cuts, self.path)


def _multipliers(rows: Array, equal: Array, below: Array, above: Array, slope: Array) -> tuple[Array, Array, Array]:
    """Return multipliers of conditions and of bounds, of the signs that they must have, and what a slope has left."""
    d = len(slope)
    held = np.flatnonzero(below | above)
    signs = np.where(below, 1.0, -1.0)[held]
    matrix = np.column_stack([rows.T, np.eye(d)[:, held] * signs])
    lowest = np.concatenate([np.where(equal, -np.inf, 0.0), np.zeros(len(held))])
    bounds = np.zeros(d)
    if not matrix.shape[1]:
        return np.zeros(0), bounds, slope
    plain = np.linalg.lstsq(matrix, slope, rcond=1e-12)[0]
    found = plain if np.all(plain >= lowest) else lsq_linear(matrix, slope, (lowest, np.full(len(lowest), np.inf)),
                                                             method="bvls", tol=1e-15).x
    bounds[held] = found[len(rows) :] * signs
    return found[: len(rows)], bounds, slope - matrix @ found


def _updated(hessian: Array, step: Array, change: Array) -> Array:
    """Return a Hessian after a step along which the gradient changed: BFGS, damped (Powell 1978)."""
    along = hessian @ step
    curved = float(step @ along)
    if not curved > 0.0:
        return hessian
    if float(step @ change) < 0.2 * curved:
        part = 0.8 * curved / (curved - float(step @ change))
        change = part * change + (1.0 - part) * along
    found: Array = hessian - np.outer(along, along) / curved + np.outer(change, change) / float(step @ change)
    return found


def optimise(program: Program, v: Array, tol: float, tell: Callable[[], None]) -> Ended:
    """Return the best design from a start, or the nearest to what cannot be met."""
    return _Run(program, tol, tell).run(v)
