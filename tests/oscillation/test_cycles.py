from __future__ import annotations

import math

import numpy as np
import pytest
from problems.motions import bautin, brusselator

import mjcont as mc


def hopf_of_the_reaction():
    return mc.continue_equilibria(brusselator(), "B", (1.5, 6.0)).point("HB1")


@pytest.fixture(scope="module")
def reaction():
    return mc.continue_cycles(hopf_of_the_reaction())


@pytest.mark.parametrize(
    ("b", "period", "multiplier"),
    [(2.1, 6.322065669428968, 0.5298829043910156), (3.0, 7.15691992117988, 0.000251637579988988)],
)
def test_a_cycle_has_the_known_period_and_multiplier(reaction, b, period, multiplier):
    (point,) = reaction.at(B=b)
    assert point.orbit.period == pytest.approx(period, rel=1e-9)
    assert point.orbit.multipliers[1].real == pytest.approx(multiplier, abs=1e-8)


def test_a_steep_cycle_is_resolved_on_a_finer_mesh(reaction):
    (point,) = reaction.at(B=5.0)
    assert point.orbit.period == pytest.approx(11.655589817031819, rel=1e-9)
    assert len(point.orbit.path.w) > 20


def test_the_multiplier_of_the_free_period_is_one_along_the_curve(reaction):
    trivial = [o.multipliers[o.trivial] for o in reaction.orbits]
    assert np.abs(np.array(trivial) - 1.0).max() < 1e-7


@pytest.mark.slow
def test_extremes_along_a_cycle_are_those_known():
    cycles = mc.continue_cycles(hopf_of_the_reaction(), bounds=(1.9, 2.1))
    assert cycles["x.max"][-1] == pytest.approx(1.4731202977360016, abs=1e-7)
    assert cycles["x.min"][-1] == pytest.approx(0.7094588769665628, abs=1e-7)


def test_the_curve_ends_at_its_bound(reaction):
    assert reaction.status == "at bound"
    assert reaction["B"][-1] == 6.0
    assert not reaction.special_points


@pytest.fixture(scope="module")
def folded():
    return mc.continue_cycles(mc.continue_equilibria(bautin(), "b1", (-0.5, 0.5)).point("HB1"))


def test_cycles_of_the_bautin_form_fold_where_they_must(folded):
    (fold,) = folded.special_points
    assert fold.kind == "LPC"
    assert fold["b1"] == pytest.approx(-0.25, abs=1e-8)


def test_cycles_of_the_bautin_form_gain_stability_at_their_fold(folded):
    at = folded.point("LPC1").index
    sides = [set(folded.stability[:at]), set(folded.stability[at + 1 :])]
    assert {"stable"} in sides
    assert {"unstable"} in sides


def test_cycles_of_the_bautin_form_have_the_exact_multipliers(folded):
    points = folded.at(b1=-0.2)
    assert len(points) == 2
    for point in points:
        r2 = float((point.orbit.path.s[0] ** 2).sum())
        (own,) = np.delete(point.orbit.multipliers, point.orbit.trivial)
        assert point.orbit.period == pytest.approx(2.0 * math.pi, rel=1e-10)
        assert own.real == pytest.approx(math.exp(4.0 * math.pi * r2 * (1.0 - 2.0 * r2)), rel=1e-7)


@pytest.mark.slow
def test_cycles_begin_at_hopf_points_only():
    branch = mc.continue_equilibria(brusselator(), "B", (1.5, 6.0), zeros={"y": 3.0})
    with pytest.raises(mc.MjcontError, match="limit cycles begin at points of kind HB"):
        mc.continue_cycles(branch.of_kind("UZ")[0])


@pytest.mark.slow
def test_wrong_options_are_named():
    hopf = hopf_of_the_reaction()
    with pytest.raises(mc.ParameterError, match="degree must be a whole number from 2 to 9"):
        mc.continue_cycles(hopf, degree=1)
    with pytest.raises(mc.NameLookupError, match="gauss, radau"):
        mc.continue_cycles(hopf, scheme="lobatto")


@pytest.fixture(scope="module")
def flutter():
    rods = mc.Mechanism.from_xml("ziegler_rods")
    return mc.continue_cycles(mc.continue_equilibria(rods, "P", (1.5, 2.2), start={"P": 1.5}).point("HB1"))


@pytest.mark.parametrize(
    ("load", "period", "multiplier"),
    [
        (1.689573, 7.651207427998781, 0.978569890122609),
        (1.822089, 7.480310949944562, 0.9003618235242208),
        (2.153378, 7.0498854157529856, 0.7170603569921984),
    ],
)
def test_rods_under_a_follower_load_flutter_with_the_known_period(flutter, load, period, multiplier):
    (point,) = flutter.at(P=load)
    orbit = point.orbit
    assert orbit.period == pytest.approx(period, rel=1e-9)
    assert abs(orbit.multipliers[orbit.trivial] - 1.0) < 1e-7
    assert np.abs(orbit.multipliers - multiplier).min() < 1e-6


def test_an_orbit_is_a_history_of_one_period(flutter):
    orbit = flutter[5].orbit
    history = orbit.history()
    assert history["time"][-1] == pytest.approx(orbit.period)
    assert history["q1"][0] == pytest.approx(history["q1"][-1], abs=1e-9)


def test_a_saved_curve_keeps_columns_and_multipliers(flutter, tmp_path):
    loaded = mc.load(flutter.save(tmp_path / "flutter.h5"))
    assert loaded["period"] == pytest.approx(flutter["period"], rel=0.0, abs=0.0)
    assert np.array_equal(loaded.eigenvalues, flutter.eigenvalues)
