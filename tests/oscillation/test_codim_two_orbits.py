"""Points of codimension two on curves of special orbits, at which normal forms have them, and where the curves end."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import codimtwo, locusends
from problems.exactorbits import around
from problems.marks import long
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

import mjcont as mc

PLACE = 1e-7
FREE = pytest.mark.parametrize("forced", [long(False), long(True)], ids=["free", "forced"])  # period of the orbit


def locus(g, y, values, first, kind, other, bounds, *, turn=0.0, forced=True):
    """Follow the first point of a kind in p and q; `first` is varied to find it, `values` where that begins."""
    field = around(g, len(y), values, y, forced=forced, turn=turn)
    curve = (mc.continue_response if forced else mc.continue_cycles)(field, first, bounds[first], mesh=10)
    return mc.continue_special(curve.of_kind(kind)[0], other, bounds, mesh=10, ds_max=0.2)


def kinds(curve):
    return [p.kind for p in curve.special_points]


def at_origin(curve, *expected):
    """Whether these are the special points of a curve, of which the last lies at p = q = 0."""
    assert tuple(kinds(curve)) == expected
    (point,) = curve.of_kind(expected[-1])
    return [point["p"], point["q"]] == pytest.approx([0.0, 0.0], abs=PLACE)


# -- strong resonances --------------------------------------------------------------------------------------------


@FREE
def test_folds_pass_a_double_multiplier_one(forced):
    bounds = {"p": (-0.1, 0.1), "q": (-0.2, 0.2)}
    curve = locus(codimtwo.double_one, [0.3, 0.0], {"p": 0.09, "q": 0.15}, "p", "LPC", "q", bounds, forced=forced)
    assert np.abs(curve["p"]).max() < PLACE
    assert at_origin(curve, "R1")


@FREE
def test_tori_end_at_a_double_multiplier_one(forced):
    values, bounds = {"p": 0.0036, "q": -0.1}, {"p": (-0.01, 0.005), "q": (-0.1, 0.1)}
    curve = locus(codimtwo.double_one, [0.06, 0.0], values, "q", "NS", "p", bounds, forced=forced)
    assert np.abs(curve["p"] - curve["q"] ** 2).max() < PLACE
    assert curve["q"].max() < PLACE
    assert sorted(kinds(curve)) == ["R1", "R3", "R4"]
    for kind, angle in (("R1", 0.0), ("R3", 1.0 / 3.0), ("R4", 0.25)):
        assert curve.of_kind(kind)[0]["q"] == pytest.approx(-0.5 * angle**2, abs=PLACE)
    assert "R1" in dict(curve.ends)["at special point"]


@FREE
def test_doublings_pass_a_double_multiplier_minus_one(forced):
    values, bounds = {"p": -0.05, "q": -0.2}, {"p": (-0.05, 0.05), "q": (-0.25, 0.2)}
    curve = locus(codimtwo.double_minus_one, [0.0, 0.0], values, "p", "PD", "q", bounds, turn=0.5, forced=forced)
    assert np.abs(curve["p"]).max() < PLACE
    assert at_origin(curve, "R2")


@FREE
def test_tori_end_at_a_double_multiplier_minus_one(forced):
    values, bounds = {"p": -0.05, "q": -0.1}, {"p": (-0.09, 0.1), "q": (-0.1, 0.1)}
    curve = locus(codimtwo.double_minus_one, [0.0, 0.0], values, "q", "NS", "p", bounds, turn=0.5, forced=forced)
    assert np.abs(curve["q"]).max() < PLACE
    assert at_origin(curve, "R4", "R3", "R2")
    assert [p["p"] for p in curve.special_points] == pytest.approx([-1.0 / 16.0, -1.0 / 36.0, 0.0], abs=PLACE)
    assert "R2" in dict(curve.ends)["at special point"]


@pytest.mark.slow
def test_tori_near_a_double_multiplier_minus_one_come_to_their_end():
    """Their equations are regular there: few steps lead to it."""
    field = around(codimtwo.double_minus_one, 2, {"p": -0.004, "q": -0.005}, [0.0, 0.0], forced=True, turn=0.5)
    steps = {"mesh": 4, "ds": 0.1, "ds_max": 0.3}
    response = mc.continue_response(field, "q", (-0.005, 0.002), chord=0.5, **steps)
    curve = mc.continue_special(response.point("NS1"), "p", (-0.005, 0.01), direction=1, **steps)
    assert at_origin(curve, "R2")
    assert len(curve) < 20


@pytest.mark.long
@pytest.mark.parametrize(("g", "kind", "turn"), [(codimtwo.third, "R3", 1.0 / 3.0), (codimtwo.quarter, "R4", 0.25)])
def test_tori_pass_a_resonance_with_its_own_term(g, kind, turn):
    bounds = {"p": (-0.1, 0.1), "q": (-0.05, 0.065)}
    curve = locus(g, [0.0, 0.0], {"p": -0.1, "q": 0.06}, "p", "NS", "q", bounds, turn=turn)
    assert np.abs(curve["p"]).max() < PLACE
    assert at_origin(curve, kind)


# -- two at once --------------------------------------------------------------------------------------------------

BOTH = {"p": (-0.1, 0.1), "q": (-0.2, 0.25)}


@pytest.mark.long
@pytest.mark.parametrize(("g", "turn", "other", "name"), [
    (codimtwo.fold_and_flip, 0.5, "PD", "LPPD"), (codimtwo.fold_and_torus, 0.0, "NS", "LPNS"),
])
def test_folds_meet_other_curves(g, turn, other, name):
    start, values = [0.0, 0.0, 0.2], {"p": 0.04, "q": -0.15}
    folds = locus(g, start, values, "p", "LPC", "q", BOTH, turn=turn)
    assert np.abs(folds["p"]).max() < PLACE
    assert at_origin(folds, name)
    others = locus(g, start, values, "p", other, "q", BOTH, turn=turn)
    assert np.abs(others["p"] - others["q"] ** 2).max() < PLACE
    assert at_origin(others, name)


@pytest.mark.long
def test_doublings_meet_tori():
    doublings = locus(codimtwo.flip_and_torus, [0.0] * 4, {"p": -0.1, "q": -0.05}, "p", "PD", "q", BOTH, turn=0.5)
    assert np.abs(doublings["p"]).max() < PLACE
    assert at_origin(doublings, "PDNS")
    tori = locus(codimtwo.flip_and_torus, [0.0] * 4, {"p": -0.1, "q": -0.05}, "p", "NS", "q", BOTH, turn=0.5)
    assert np.abs(tori["p"] + tori["q"]).max() < PLACE
    assert at_origin(tori, "PDNS")


@pytest.mark.long
def test_tori_meet_tori():
    tori = locus(codimtwo.two_tori, [0.0] * 4, {"p": -0.1, "q": -0.05}, "p", "NS", "q", BOTH)
    assert np.abs(tori["p"]).max() < PLACE
    assert at_origin(tori, "NSNS")


# -- ends ---------------------------------------------------------------------------------------------------------


def shrinking(field, first, bounds, kind, other):
    """Return the locus in p and q of the first point of a kind on a curve in `first`, and the sentence on its rest."""
    cycles = mc.continue_cycles(field, first, bounds[first])
    curve = mc.continue_special(cycles.of_kind(kind)[0], other, bounds, ds_max=0.2)
    assert {status for status, _ in curve.ends} == {"rest", "at bound"}
    return curve, dict(curve.ends)["rest"]


@pytest.mark.long
def test_tori_end_at_a_zero_hopf_point_and_not_at_a_resonance():
    bounds = {"p": (-0.05, 0.05), "q": (-0.15, 0.1)}
    curve, rest = shrinking(locusends.tori_at_a_zero_hopf_point(), "q", bounds, "NS", "p")
    assert np.abs(curve["q"]).max() < PLACE
    assert kinds(curve) == ["R4"]
    assert curve.of_kind("R4")[0]["p"] == pytest.approx(-1.0 / 32.0, abs=PLACE)
    assert "zero-Hopf point (ZH)" in rest
    assert -1e-3 < curve["p"].max() < 0.0


@pytest.mark.long
def test_folds_end_at_a_zero_hopf_point_beside_which_there_is_no_equilibrium():
    bounds = {"p": (-0.2, 0.2), "q": (-0.1, 0.3)}
    curve, rest = shrinking(locusends.folds_at_a_zero_hopf_point(), "p", bounds, "LPC", "q")
    assert np.abs(curve["p"] + 0.3 * curve["q"]).max() < PLACE
    assert kinds(curve) == []
    assert "zero-Hopf point (ZH)" in rest


@pytest.mark.long
def test_tori_end_at_a_double_hopf_point():
    bounds = {"p": (-0.1, 0.25), "q": (-0.3, 0.1)}
    curve, rest = shrinking(locusends.tori_at_a_double_hopf_point(), "q", bounds, "NS", "p")
    assert np.abs(curve["p"] + curve["q"]).max() < PLACE
    assert kinds(curve) == []
    assert "double Hopf point (HH)" in rest


@pytest.mark.long
def test_doublings_end_at_a_double_hopf_point():
    bounds = {"p": (-0.1, 0.05), "q": (-0.5, 0.1)}
    curve, rest = shrinking(locusends.doublings_at_a_double_hopf_point(), "q", bounds, "PD", "p")
    assert np.abs(curve["p"] - curve["q"] ** 2).max() < PLACE
    assert kinds(curve) == []
    assert "double Hopf point (HH)" in rest


def along_closed_orbits(h):
    """Return the mean of x^2 that holds x'' = x - x^3 + e (q - x^2) x' on the orbit x'^2 = 2 h + x^2 - x^4 / 2."""
    end = math.sqrt(1.0 + math.sqrt(1.0 + 4.0 * h))

    def over(power):  # x = end sin(s): the root at the end is taken out
        def speed(s):
            x = end * math.sin(s)
            return x**power * math.sqrt(max(2.0 * h + x * x - 0.5 * x**4, 0.0)) * end * math.cos(s)

        return quad(speed, 0.0, 0.5 * math.pi, epsabs=1e-13, epsrel=1e-13)[0]

    return over(2) / over(0)


@pytest.mark.long
def test_folds_end_at_a_symmetric_bogdanov_takens_point():
    """The periods grow without bound there, and the orbits shrink: x = sqrt(p) X(sqrt(p) t), q = 0.752 p (Carr)."""
    ratio = minimize_scalar(along_closed_orbits, (0.01, 0.1, 1.0), tol=1e-10).fun
    assert ratio == pytest.approx(0.752, abs=5e-4)
    field = locusends.folds_at_a_symmetric_double_zero()
    cycles = mc.continue_cycles(field, "q", (0.7, 1.0), start=mc.simulate(field, duration=150.0))
    bounds = {"p": (-0.1, 1.1), "q": (-0.1, 1.0)}
    curve = mc.continue_special(cycles.point("LPC1"), "p", bounds, direction=-1)
    assert "Bogdanov-Takens point (BT)" in dict(curve.ends)["rest"]
    assert kinds(curve) == []
    assert curve["p"].min() < 1e-3
    assert curve["q"].min() / curve["p"].min() == pytest.approx(ratio, abs=1e-4)
