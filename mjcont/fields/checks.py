"""Derivatives that a user gives, held against differences of f: what is off for certain is found out, and named.

An entry a of a derivative of order k is right if it agrees with the central differences d6, d4 by a step h:

    |a - d6| <= 1e-6 max(|a|, |d6|) + 10 e,   e = |d6 - d4| + 1e-15 max |f| / h^k.

Where it does not, it is off if it does not by h / 8 and h / 64 either, e then with what d6 has changed since the step
before (all of it, if that is more than a tenth: h does not resolve f), and beside the part of the difference of order
k + 1 by h^k that does not vanish with h: a kink at the point itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from mjcont.errors import FunctionError
from mjcont.fields.derivatives import Derivatives
from mjcont.numerics.equations.differences import FAR_NODES, NODES, by_orders
from mjcont.numerics.equations.problem import Array

# f at t (m,), shape (m, n)
Ray = Callable[[Array], Array]

# largest steps in scaled unknowns, and what they are made smaller by
_STEP, _FORM_STEPS = 1e-2, {2: 1e-2, 3: 2e-2}
_STEPS = (1.0, 1.0 / 8.0, 1.0 / 64.0)
_OFF, _OPEN, _KINK, _ROUNDING, _SETTLED = 1e-6, 10.0, 2.0, 1e-15, 0.1
# differences of one order more
_NEXT = {
    1: np.array([0.0, 0.0, 1.0, -2.0, 1.0, 0.0, 0.0]),
    2: np.array([0.0, -0.5, 1.0, 0.0, -1.0, 0.5, 0.0]),
    3: np.array([0.0, 0.0, 1.0, -4.0, 6.0, -4.0, 1.0, 0.0, 0.0]),
}


def off(own: Array, ray: Ray, order: int, h: float) -> tuple[int, float, float] | None:
    """Return the entry of a derivative (n,) that is most off, its value and that by differences; None if none is.

    `ray` gives f(t), (m, n), whose derivative of that order at 0 is meant; `h` is the largest step in t. Where f has no
    value, or the user's function raises so far aside, nothing is off.
    """
    try:
        with np.errstate(all="ignore"):
            return _off(own, ray, order, h)
    except FunctionError:
        return None


def _off(own: Array, ray: Ray, order: int, h: float) -> tuple[int, float, float] | None:
    tried, still = list[_Tried](), np.ones(len(own), dtype=bool)
    for step in _STEPS:
        now = _tried(ray, order, np.float64(h * step))
        left, size = now.left, np.maximum(np.abs(own), np.abs(now.value))
        if tried:
            change, larger = np.abs(now.value - tried[-1].value), np.maximum(np.abs(now.value), np.abs(tried[-1].value))
            left = np.where((change > _SETTLED * larger) & (larger > _OFF * size), np.inf, left + change)
        allowed = _OFF * size + _OPEN * left
        still &= np.abs(own - now.value) > allowed  # not where one is no number
        if not still.any():
            return None
        tried.append(now)
    (far, near), (before, last) = _STEPS[-2:], (each.beyond for each in tried[-2:])
    kink = np.abs(last / near - before / far) / (1.0 / near - 1.0 / far)
    gap = np.abs(own - tried[-1].value)
    gap[~(still & (gap > _KINK * kink))] = 0.0
    i = int((gap / np.maximum(np.maximum(np.abs(own), np.abs(tried[-1].value)), 1e-300)).argmax())
    return (i, float(own[i]), float(tried[-1].value[i])) if gap[i] > 0.0 else None


@dataclass(frozen=True, slots=True)
class _Tried:
    """A derivative by one step: its value, what that leaves open, and the difference of one order more by h^k."""

    value: Array
    left: Array
    beyond: Array


def _tried(ray: Ray, order: int, h: float) -> _Tried:
    rows = ray((FAR_NODES if order == 3 else NODES) * h)
    sixth, fourth, _ = by_orders(rows, order, h)
    left = np.abs(sixth - fourth) + _ROUNDING * np.abs(rows).max(axis=0) / h**order
    return _Tried(sixth, left, _NEXT[order] @ rows / h**order)


@dataclass(frozen=True, slots=True)
class Held:
    """The derivatives that a user gives, at one state, and what they are held against.

    Attributes
    ----------
    given, x, p : the derivatives, the state and the parameters as functions see them.
    labels, scale : names and typical sizes of the unknowns.
    moved : f at x plus each row of steps (m, n), shape (m, n).
    """

    given: Derivatives
    x: Array
    p: Mapping[str, Any]
    labels: Sequence[str]
    scale: Array
    moved: Callable[[Array], Array]

    def _ray(self, v: Array) -> Ray:
        return lambda t: self.moved(t[:, None] * v)

    def _refuse(self, what: str, entry: str, found: tuple[int, float, float]) -> FunctionError:
        return FunctionError(f"the {what} of {self.given.owner} is off: {entry} is {found[1]:g}, by differences of f "
                             f"{found[2]:g}")

    def jacobian(self, matrix: Any) -> None:
        """Raise a FunctionError, which names an entry, if a product with df/du is off."""
        whole = vector(self.scale)

        def entry(columns: slice) -> tuple[int, float, float] | None:
            v = np.zeros(len(whole))
            v[columns] = whole[columns]
            return off(matrix @ v, self._ray(v), 1, _STEP)

        if entry(slice(None)) is None:
            return
        j = column_off(len(whole), entry)
        if j is not None:
            self.column(matrix, j)

    def column(self, matrix: Any, j: int) -> None:
        """Raise a FunctionError if a column of df/du is off."""
        e = np.zeros(len(self.scale))
        e[j] = 1.0
        found = off(matrix @ e, self._ray(e), 1, _STEP * float(self.scale[j]))
        if found is not None:
            raise self._refuse("jacobian", f"d {self._f(found[0])} / d {self.labels[j]}", found)

    def slope(self, name: str, own: Array, ray: Ray, h: float) -> None:
        """Raise a FunctionError if df/dp is off for a parameter; `ray` gives f at changes of its value."""
        found = off(own, ray, 1, h)
        if found is not None:
            raise self._refuse("dfdp", f"d {self._f(found[0])} / d {name}", found)

    def form(self, order: int, turn: int = 0) -> None:
        """Raise a FunctionError if the second or third derivative is off along vectors."""
        vectors = [vector(self.scale, turn + k) for k in range(order)]
        own = self.given.form(self.x, self.p, *vectors)
        if own is None:
            return
        found = off(own, partial(_polar, self.moved, vectors), order, _FORM_STEPS[order])
        if found is not None:
            what, along = {2: ("second", "D2f[v, w]"), 3: ("third", "D3f[v, w, z]")}[order]
            raise self._refuse(f"{what} derivative", f"{self._f(found[0])} of {along}", found)

    def _f(self, i: int) -> str:
        return f"f[{i}]"


def _polar(moved: Callable[[Array], Array], vectors: Sequence[Array], t: Array) -> Array:
    """Return sums of f at t (m,) whose derivative of second or third order at 0 is that along two or three vectors."""
    first, *others = vectors
    signs = np.array(np.meshgrid(*([[1.0, -1.0]] * len(others)), indexing="ij")).reshape(len(others), -1).T
    rows = [np.prod(s) * moved(t[:, None] * (first + s @ np.array(others))) for s in signs]
    found: Array = np.sum(rows, axis=0) / {2: 4.0, 3: 24.0}[len(vectors)]
    return found


def vector(scale: Array, turn: int = 0) -> Array:
    """Return a vector with no small component in units of the scale, (n,), another one for each `turn`."""
    i = np.arange(len(scale))
    found: Array = scale * (0.75 + 0.25 * np.cos(3.0 * i + turn)) * np.where((i + turn * i // 2) % 2, -1.0, 1.0)
    return found


def column_off(columns: int, entry: Callable[[slice], tuple[int, float, float] | None]) -> int | None:
    """Return a column by which a product is off, found by halves; None if no single one is.

    `entry` says what is off of the product with a vector that is zero but for a slice of columns.
    """
    low, high = 0, columns
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if entry(slice(low, middle)) is not None else (middle, high)
    return low if entry(slice(low, high)) is not None else None
