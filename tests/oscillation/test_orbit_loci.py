"""Curves of special orbits and what lies on them, where both are in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from problems.exactorbits import (
    around,
    cusp,
    fork_along_a_parabola,
    fork_that_changes_side,
    ring_that_changes_side,
    ring_that_turns_faster,
)
from problems.motions import bautin

import mjcont as mc

PLACE = 1e-7


def special(g, n, q, kind, bounds=(-0.1, 0.1), start=None, turn=0.0):
    field = around(g, n, {"p": bounds[0], "q": q}, start or [0.0] * n, forced=True, turn=turn)
    response = mc.continue_response(field, "p", bounds)
    return response.of_kind(kind)[0]


def kinds(curve):
    return [p.kind for p in curve.special_points]


@pytest.fixture(scope="module")
def folds():
    fold = special(cusp, 2, 0.3, "LPC", (-0.2, 0.2), [-0.6, 0.0])
    return mc.continue_special(fold, "q", (-0.1, 0.5))


@pytest.mark.long
def test_folds_of_orbits_lie_on_the_cuspidal_curve(folds):
    assert np.abs(27.0 * folds["p"] ** 2 - 4.0 * folds["q"] ** 3).max() < PLACE


@pytest.mark.long
def test_the_cusp_of_orbits_is_found(folds):
    assert kinds(folds) == ["CPC"]
    assert folds.point("CPC1")["p"] == pytest.approx(0.0, abs=PLACE)
    assert folds.point("CPC1")["q"] == pytest.approx(0.0, abs=PLACE)


@pytest.mark.long
def test_doublings_lie_on_the_parabola():
    doubling = special(fork_along_a_parabola, 2, 0.1, "PD", turn=0.5)
    locus = mc.continue_special(doubling, "q", (-0.2, 0.2), ds_max=0.2)
    assert np.abs(locus["p"] - locus["q"] ** 2).max() < PLACE
    assert kinds(locus) == []


@pytest.mark.long
def test_a_doubling_changes_side_where_it_must():
    doubling = special(fork_that_changes_side, 2, -0.1, "PD", turn=0.5)
    locus = mc.continue_special(doubling, "q", (-0.2, 0.2))
    assert np.abs(locus["p"]).max() < PLACE
    assert kinds(locus) == ["GPD"]
    assert locus.point("GPD1")["q"] == pytest.approx(0.0, abs=PLACE)


@pytest.mark.long
def test_tori_lie_on_the_parabola_with_their_strong_resonances():
    torus = special(ring_that_turns_faster, 2, 0.1, "NS")
    locus = mc.continue_special(torus, "q", (-0.15, 0.25))
    assert np.abs(locus["p"] - locus["q"] ** 2).max() < PLACE
    assert kinds(locus) == ["R4", "R3"]
    found = [p["q"] for p in locus.special_points]
    assert found == pytest.approx([0.25 - 0.2, 1.0 / 3.0 - 0.2], abs=PLACE)


@pytest.mark.long
def test_a_torus_changes_side_where_it_must():
    torus = special(ring_that_changes_side, 2, -0.1, "NS")
    locus = mc.continue_special(torus, "q", (-0.2, 0.2))
    assert np.abs(locus["p"]).max() < PLACE
    assert kinds(locus) == ["CH"]
    assert locus.point("CH1")["q"] == pytest.approx(0.0, abs=PLACE)


@pytest.mark.long
def test_folds_of_cycles_of_the_bautin_form_end_at_its_generalised_hopf_point():
    cycles = mc.continue_cycles(mc.continue_equilibria(bautin(), "b1", (-0.5, 0.5)).point("HB1"))
    locus = mc.continue_special(cycles.point("LPC1"), "b2", {"b1": (-1.0, 0.5), "b2": (-1.0, 1.5)})
    assert np.abs(locus["b1"] + locus["b2"] ** 2 / 4.0).max() < PLACE
    ends = dict(locus.ends)
    assert "generalised Hopf point (GH)" in ends["rest"]
    assert np.abs(locus["b2"]).min() < 1e-3
    assert locus["b2"].max() == 1.5


@pytest.mark.slow
def test_points_without_a_curve_are_named():
    response = mc.continue_response(around(fork_along_a_parabola, 2, {"p": -0.1, "q": 0.0}, [0.0, 0.0], forced=True),
                                    "p", (-0.1, 0.1))
    with pytest.raises(mc.MjcontError, match="Valid kinds: LPC, PD, NS"):
        mc.continue_special(response.point("BPC1"), "q", (-0.2, 0.2))
