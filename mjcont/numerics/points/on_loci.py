"""Detectors on loci of special points: the points of higher codimension that lie on them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.defining import Fold, Hopf
from mjcont.numerics.equations.newton import Corrected, solve
from mjcont.numerics.equations.onfolds import DoubleZero, FoldCoefficient, Transversality
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.points import codim2, normalform
from mjcont.numerics.points.events import Detector, Solved, ZeroDetector
from mjcont.numerics.points.on_equilibria import critical_pairs, critical_square, square_near, square_system
from mjcont.numerics.spectra.spectrum import Spectrum
from mjcont.numerics.spectra.stability import local_spectrum, spectrum_of
from mjcont.numerics.step.arclength import CurvePoint, tangent_at

Finish = Callable[[Corrected, System], tuple[dict[str, Any], str] | None]


class FirstLyapunov(Condition):
    """The condition l1 = 0 on a Hopf curve."""

    def __init__(self, weight: float, omega: float) -> None:
        self.weight, self.omega = weight, omega

    def value(self, local: Local, aux: Array) -> Array:
        """Return l1, relative to its size nearby."""
        return np.array([lyapunov_at(local, self.omega).value]) / self.weight

    def error(self, local: Local, aux: Array) -> Array:
        """Return what differences of third order leave open of l1."""
        return np.array([lyapunov_at(local, self.omega).error]) / self.weight

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return the derivative along the Hopf curve as a row along its tangent, (1, n + k); None for small problems.

        The other equations say what lies across the tangent: only the way to the zero depends on it.
        """
        if not sparse.issparse(local.jac):
            return None
        curve = System(system.problem, system.base, system.free, system.conditions[:-1], accurate=True)
        tangent = tangent_at(curve, local, y)
        found: Array = system.slope(self, local, y, tangent)[:, None] * tangent
        return found


def lyapunov_at(local: Local, omega: float) -> normalform.Lyapunov:
    """Return l1 at or near a Hopf point of about a frequency, NaN where no pair of eigenvalues is imaginary."""
    square = square_near(local, omega) if sparse.issparse(local.jac) else critical_square(local_spectrum(local))
    if square is None or square <= 0:
        return normalform.Lyapunov(math.nan, math.nan, 0.0)
    return normalform.lyapunov(local.problem, local.x, local.values, float(np.sqrt(square)))


def fold_locus_detectors(system: System, fold: Fold, settings: Settings) -> list[Detector]:
    """Return the detectors of CP, BT, ZH and BP on a fold locus."""

    def detector(kind: str, build: Callable[[Fold, Local], Any], finish: Finish) -> ZeroDetector:
        def test(point: CurvePoint) -> float:
            return float(build(fold, point.local).value(point.local, np.zeros(0))[0])

        def solve_with(near: Corrected) -> Solved:
            full, y = square_system(system, [build(fold, near.local)], near)
            return solve(full, near.x, y), full

        return ZeroDetector(kind, system, test, solve_with, finish, settings)

    def cusp(c: Corrected, full: System) -> tuple[dict[str, Any], str]:
        v, w = fold.physical(c.local)
        return {"c": normalform.cusp_coefficient(c.local, v, w), "v": v / np.linalg.norm(v), "w": w}, ""

    def double_zero(c: Corrected, full: System) -> tuple[dict[str, Any], str]:
        return normalform.double_zero_coefficients(c.local.problem, c.x, c.local.values), ""

    def turning(c: Corrected, full: System) -> tuple[dict[str, Any], str]:
        v, w = fold.physical(c.local)
        name = c.local.wrt[0]
        return {"v": v / np.linalg.norm(v), "w": w}, f"w . f_{name} = 0: the locus turns without a cusp"

    found: list[Detector] = [
        detector("CP", FoldCoefficient, cusp),
        detector("BT", DoubleZero, double_zero),
        detector("BP", Transversality, turning),
    ]
    found.append(_pair_detector("ZH", system, settings, _zero_hopf_count))
    return found


def _zero_hopf_count(s: Spectrum) -> int:
    """Return the number of unstable complex pairs."""
    ev = s.eigenvalues
    return int(np.count_nonzero((ev.imag > 0) & (ev.real > s.noise)))


def _double_hopf_count(s: Spectrum) -> int:
    """Return the number of unstable complex pairs apart from the critical one."""
    upper = s.eigenvalues.imag > 0
    ev, noise = s.eigenvalues[upper], s.noise[upper]
    if not len(ev):
        return 0
    own = np.argmin(np.abs(ev.real) / np.abs(ev))
    return int(np.count_nonzero(np.delete(ev.real > noise, own)))


def _pair_detector(kind: str, system: System, settings: Settings, count: Callable[[Spectrum], int]) -> ZeroDetector:
    """Return the detector of a further imaginary pair on a locus: ZH on folds, HH on Hopf curves."""

    def test(point: CurvePoint) -> float:
        s = spectrum_of(point)
        return 0.5 if s.conservative else float(count(s)) + 0.5

    def solve_with(near: Corrected) -> Solved:
        square = _next_square(local_spectrum(near.local), skip=kind == "HH")
        if square is None:
            failure = Refused(Why.UNDEFINED, "no pair of eigenvalues")
            return Corrected(near.x, near.y, near.local, None, 0, 0.0, np.inf, np.inf, failure), system
        full, y = square_system(system, [Hopf(near.local, square)], near)
        return solve(full, near.x, y), full

    def finish(c: Corrected, full: System) -> tuple[dict[str, Any], str] | None:
        pair = full.conditions[-1]
        assert isinstance(pair, Hopf)
        square = pair.square(c.y[-1:])
        if square <= 0:
            return None
        omega, local = float(np.sqrt(square)), c.local
        if kind == "ZH":
            return codim2.zero_hopf_coefficients(local.problem, c.x, local.values, omega)
        own = system.conditions[0].square(c.y[system.k - 1 : system.k])  # type: ignore[attr-defined]
        first = float(np.sqrt(own))
        return codim2.double_hopf_coefficients(local.problem, c.x, local.values, first, omega)

    return ZeroDetector(kind, system, test, solve_with, finish, settings, counts=True)


def _next_square(s: Spectrum, skip: bool) -> float | None:
    """Return omega^2 of the complex pair nearest the axis, or of the one after it."""
    pairs = sorted(
        (p for p in critical_pairs(s) if p[1] > 0 and p[0] * p[0] < 4.0 * p[1]), key=lambda p: abs(p[0]) / p[1] ** 0.5
    )
    index = 1 if skip else 0
    return pairs[index][1] if len(pairs) > index else None


def hopf_locus_detectors(system: System, hopf: Hopf, settings: Settings, *, lyapunov: bool) -> list[Detector]:
    """Return the detectors of BT, ZH, HH and (where l1 is wanted) GH on a Hopf locus."""
    last = system.k - 1

    def kappa(point: CurvePoint) -> float:
        return float(point.y[last])

    def solve_double_zero(near: Corrected) -> Solved:
        fold = Fold(near.local)
        free = len(system.free)
        base = System(system.problem, system.values(near.y), system.free, (), accurate=True)
        at = Corrected(near.x, near.y[:free], near.local, None, 0, 0.0, 0.0, 0.0)
        full, y = square_system(base, [fold, DoubleZero(fold, near.local)], at)
        c = solve(full, near.x, y)
        return Corrected(c.x, np.append(c.y, 0.0), c.local, None, c.iterations, 0.0, c.step, c.error, c.failure), full

    def finish_double_zero(c: Corrected, full: System) -> tuple[dict[str, Any], str]:
        return normalform.double_zero_coefficients(c.local.problem, c.x, c.local.values), ""

    def determinant(point: CurvePoint) -> float:
        return Factored(point.local.jac).sign * float(np.sign(point.y[last]))

    def solve_fold(near: Corrected) -> Solved:
        full, y = square_system(system, [Fold(near.local)], near)
        return solve(full, near.x, y), full

    def finish_fold(c: Corrected, full: System) -> tuple[dict[str, Any], str] | None:
        square = hopf.square(c.y[last : last + 1])
        if square <= 1e-6 * hopf.rate * hopf.rate:
            return None
        return codim2.zero_hopf_coefficients(c.local.problem, c.x, c.local.values, float(np.sqrt(square)))

    found: list[Detector] = [
        ZeroDetector("BT", system, kappa, solve_double_zero, finish_double_zero, settings),
        ZeroDetector("ZH", system, determinant, solve_fold, finish_fold, settings),
        _pair_detector("HH", system, settings, _double_hopf_count),
    ]
    if lyapunov:
        found.append(_generalised_hopf(system, hopf, settings))
    return found


def _generalised_hopf(system: System, hopf: Hopf, settings: Settings) -> ZeroDetector:
    last = system.k - 1

    def frequency(y: Array) -> float:
        return math.sqrt(max(hopf.square(y[last : last + 1]), 0.0))

    def test(point: CurvePoint) -> float:
        return lyapunov_at(point.local, frequency(point.y)).l1 if point.y[last] > 0 else math.nan

    def solve_with(near: Corrected) -> Solved:
        omega = frequency(near.y)
        weight = abs(lyapunov_at(near.local, omega).l1) or 1.0
        full, y = square_system(system, [FirstLyapunov(max(weight, 1e-3), omega)], near)
        return solve(full, near.x, y, tol=1e-11, most=12), full

    def finish(c: Corrected, full: System) -> tuple[dict[str, Any], str] | None:
        square = hopf.square(c.y[last : last + 1])
        if square <= 0:
            return None
        omega = float(np.sqrt(square))
        return {"omega": omega, "l1": lyapunov_at(c.local, omega).l1}, ""

    return ZeroDetector("GH", system, test, solve_with, finish, settings, vanishes=True)


def unfolding_stop(system: System) -> Callable[[CurvePoint], str | None]:
    """Return the stop of a branch-point locus: the unfolding parameter leaves zero where no such curve exists."""
    index = len(system.free)

    def stop(point: CurvePoint) -> str | None:
        if abs(point.y[index]) > 1e-9:
            return "the branch point does not persist when the second parameter moves: it unfolds"
        return None

    return stop
