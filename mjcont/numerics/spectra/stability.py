"""Stability along a curve: by the inertia of K where that decides, by eigenvalues elsewhere, and by the points beside.

Where K is symmetric and the damping is known to be passive, the number of unstable eigenvalues is the number of
negative eigenvalues of K (Kelvin-Tait-Chetaev), and eigenvalues can wait until somebody reads them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.algebra import eigenvalues, symmetric_eigenvalues
from mjcont.numerics.equations.problem import Array, Equations, Range, Values
from mjcont.numerics.equations.system import Local
from mjcont.numerics.spectra.large import positive_count
from mjcont.numerics.spectra.spectrum import (
    MARGINAL,
    STABLE,
    UNSTABLE,
    Spectrum,
    conservative_spectra,
    first_order_spectra,
    settles,
    spectrum,
    symmetric,
)
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

# an eigenvalue no farther from zero than this many times one that is held there cannot be told from it
_AS_NEAR = 10.0
# entries of the evaluations for derivatives that are held at a time
_ENTRIES = 2**17
# unknowns from which on eigenvalues wait where anything else decides
_MANY = 128
# the spectrum; the number of negative eigenvalues of K; that of unstable ones, told by the points beside
SPECTRUM, NEGATIVE, COUNT = Note[Spectrum](), Note[int | None](), Note[int | None]()
# the least eigenvalue of K
SOFTEST = Note[float]()


def verdict_at(holds: tuple[int, int], s: Spectrum) -> tuple[str, int]:
    """Return stability and number of unstable eigenvalues of a special point: marginal, and those it does not hold.

    `holds` is how many eigenvalues it holds at zero, and how many pairs on the axis: rounding decides on which side of
    it they are found.
    """
    ev = s.eigenvalues
    zeros, pairs = holds
    held = np.zeros(len(ev), dtype=bool)
    if zeros:  # as many as the kind says, or more at a point of higher multiplicity
        held |= np.abs(ev) <= _AS_NEAR * np.sort(np.abs(ev))[min(zeros, len(ev)) - 1]
    beside = [i for i in np.argsort(np.abs(ev.real)) if ev[i].imag > 0.0 and not held[i]]
    for i in beside[:pairs]:
        held |= np.abs(ev - ev[i]) == 0.0
        held |= np.abs(ev - ev[i].conj()) == 0.0
    others = int(np.count_nonzero(ev.real[~held] > s.noise[~held]))
    known = others + int(np.count_nonzero(ev.real[held] > s.noise[held]))
    return MARGINAL, others if s.complete else others + max(s.n_unstable - known, 0)


def spectrum_of(point: CurvePoint) -> Spectrum:
    """Return the spectrum at a point, computed once."""

    def found() -> Spectrum:
        s = local_spectrum(point.local)
        if point.local.problem.n > _MANY:
            point.local.forget_pencil()
        return s

    return SPECTRUM.of(point, found)


def negative_stiffness(point: CurvePoint) -> int | None:
    """Return the number of negative eigenvalues of K, computed once: that of unstable eigenvalues.

    None where it does not decide: for a K that is not symmetric, or a problem whose damping is not known to be
    passive whatever the state (symmetric, semidefinite C).
    """

    def count() -> int | None:
        if not (point.local.problem.passive and symmetric(point.local.raw_jac)):
            return None
        jac = point.local.raw_jac
        if sparse.issparse(jac):
            return positive_count(jac)
        found = -symmetric_eigenvalues(jac)
        SOFTEST.put(point, float(found[-1]))
        return int(np.count_nonzero(found < 0.0))

    return NEGATIVE.of(point, count)


def spectra_of(points: Sequence[CurvePoint]) -> list[Spectrum]:
    """Return the spectra at points, those that the walk could do without in one go."""
    late = [p for p in points if not SPECTRUM.known(p) and negative_stiffness(p) is not None]
    if late:
        problem, states = late[0].local.problem, np.array([p.x for p in late])
        pencils = problem.pencils(states, [p.local.values for p in late], [p.local.raw_jac for p in late])
        for point, found in zip(late, conservative_spectra(pencils), strict=True):
            SPECTRUM.put(point, found)
    return [spectrum_of(p) for p in points]


def spectra_at(
    problem: Equations, states: Array, values: Sequence[Values], free: Mapping[str, Range]
) -> list[Spectrum]:
    """Return the spectra at equilibria, states (m, nq), between which free parameters differ, within their bounds."""
    found: list[Spectrum] = []
    (name, bounds), *others = free.items()
    many = 1 if others else max(_ENTRIES // (2 * problem.n**2), 1)
    for first in range(0, len(states), many):
        part = slice(first, first + many)
        found += _some_spectra(problem, states[part], values[part], name, bounds)
    return found


def _some_spectra(
    problem: Equations, states: Array, values: Sequence[Values], name: str, bounds: Range
) -> list[Spectrum]:
    column = np.array([v[name] for v in values])
    together = problem.linearize_along(states, values[0], name, column, bounds)
    every = [Local(problem, x, v, (), False) for x, v in zip(states, values, strict=True)]
    if together is not None and not problem.second_order:
        return first_order_spectra(together[1], eigenvalues(together[1]))
    jacs = list(together[1]) if together is not None else [local.raw_jac for local in every]
    if not problem.passive or not all(symmetric(j) for j in jacs):
        pencils = [problem.pencil(x, v, j) for x, v, j in zip(states, values, jacs, strict=True)]
        return [spectrum(p, partial(rounding_samples, local)) for p, local in zip(pencils, every, strict=True)]
    return conservative_spectra(problem.pencils(states, values, jacs))


def verdicts(
    points: Sequence[CurvePoint], needed: Collection[int]
) -> tuple[list[str], list[int], list[Spectrum | None]]:
    """Return stability, number of unstable eigenvalues and spectrum of a curve's points in order.

    Spectra are computed where they decide, and at the indices `needed`; elsewhere they are None. A point inside a long
    step, whose count the step's ends tell, has the stability of the end that has the same count.
    """
    found: list[tuple[str, int] | None] = [
        None if i in needed else _plain(p) for i, p in enumerate(points)
    ]
    inside = [i for i, v in enumerate(found) if v is None and _told(points[i]) and i not in needed]
    waiting = set(inside)
    spectra: list[Spectrum | None] = [None] * len(points)

    def compute(rows: Sequence[int]) -> None:
        for i, s in zip(rows, spectra_of([points[i] for i in rows]), strict=True):
            spectra[i], found[i] = s, (s.stability, s.n_unstable)

    compute([i for i, v in enumerate(found) if v is None and i not in waiting])
    beside, asked = _beside(len(points), waiting), []
    for i in inside:
        count = COUNT.get(points[i])
        ends = [v for v in (found[k] for k in beside[i]) if v is not None]
        told = [v for v in ends if v[1] == count and v[0] != MARGINAL]
        if told:
            found[i] = told[0]
        else:
            asked.append(i)
    compute(asked)
    done = [v for v in found if v is not None]
    return [v[0] for v in done], [v[1] for v in done], spectra


def tell(old: CurvePoint, between: Sequence[CurvePoint], new: CurvePoint) -> None:
    """Tell the points between two that have the same number of unstable eigenvalues that they have it, too."""
    a, b = spectrum_of(old), spectrum_of(new)
    if a.n_unstable == b.n_unstable:
        for point in between:
            COUNT.put(point, a.n_unstable)


def _told(point: CurvePoint) -> bool:
    """Whether a point inside a long step waits for its ends to tell its stability."""
    return not SPECTRUM.known(point) and COUNT.get(point) is not None


def _plain(point: CurvePoint) -> tuple[str, int] | None:
    """Return stability and count where the inertia of K decides alone; without it a mode may still be undamped.

    That is asked where eigenvalues would cost much.
    """
    negative = NEGATIVE.get(point)
    if negative is None or SPECTRUM.known(point):
        return None
    if negative:
        return UNSTABLE, negative
    softest = SOFTEST.get(point) if point.local.problem.n > _MANY else None
    return (STABLE, 0) if softest is not None and settles(point.local.pencil, softest) else None


def _beside(count: int, waiting: Collection[int]) -> list[tuple[int, ...]]:
    """Return for each index the nearest indices on both sides that do not wait."""
    before, after = [-1] * count, [-1] * count
    last = -1
    for i in range(count):
        before[i] = last
        last = last if i in waiting else i
    last = -1
    for i in reversed(range(count)):
        after[i] = last
        last = last if i in waiting else i
    return [tuple(k for k in pair if k >= 0) for pair in zip(before, after, strict=True)]


def local_spectrum(local: Local) -> Spectrum:
    """Return the spectrum at an evaluation, its noise measured from samples of f that differ by rounding."""
    return spectrum(local.pencil, lambda: rounding_samples(local))


def rounding_samples(local: Local) -> Array:
    """Return f at states a few units in the last place apart, (8, n)."""
    signs = np.cos(np.arange(8 * local.problem.n, dtype=float)).reshape(8, -1)
    return local.problem.residuals(local.x, local.values, 2e-15 * signs * local.problem.state_scale)
