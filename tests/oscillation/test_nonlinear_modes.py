"""Nonlinear normal modes: families of periodic motions without damping, against exact periods and shooting."""

from __future__ import annotations

import numpy as np
import pytest
from problems.conservative import (
    CUBIC_PAIR,
    IN_PHASE,
    OUT_OF_PHASE,
    PENDULUM,
    RESONANCE,
    TWO_PI,
    cubic_pair,
    duffing,
    period_of_duffing,
    period_of_pendulum,
)

import mjcont as mc


def loaded(text, folder):
    path = folder / "model.xml"
    path.write_text(text)
    return mc.Mechanism.from_xml(path)


def check(curve, points):
    """Compare energies, sums of multipliers and their distance from the unit circle at given frequencies."""
    for omega, energy, total in points:
        (point,) = curve.at(frequency=omega / TWO_PI)
        own = point.orbit.multipliers[point.orbit.own]
        assert point["energy"] == pytest.approx(energy, rel=1e-9)
        assert own.sum() == pytest.approx(total, abs=1e-9)
        assert np.abs(np.abs(own) - 1.0).max() < 1e-10
        assert np.abs(point.orbit.multipliers[~point.orbit.own] - 1.0).max() < 1e-10
        assert point.stability == "stable"


@pytest.fixture(scope="module")
def in_phase():
    return mc.continue_modes(cubic_pair(), "frequency", (0.15, 0.207))


@pytest.mark.slow
def test_the_in_phase_mode_of_two_masses_has_its_energies_and_multipliers(in_phase):
    check(in_phase, IN_PHASE)


@pytest.mark.slow
def test_the_out_of_phase_mode_of_two_masses_has_its_energies_and_multipliers():
    check(mc.continue_modes(cubic_pair(), "frequency", (0.15, 3.01 / TWO_PI), mode=2), OUT_OF_PHASE)


@pytest.mark.slow
def test_a_branch_leaves_the_in_phase_mode_where_its_pair_reaches_one(in_phase):
    point = in_phase.point("BPC1")
    omega, energy = RESONANCE
    assert [p.kind for p in in_phase.special_points] == ["IR", "BPC"]
    assert TWO_PI * point.orbit.frequency == pytest.approx(omega, rel=1e-10)
    assert point["energy"] == pytest.approx(energy, rel=1e-9)
    other = mc.continue_modes(point, "energy", (40.0, 44.0))
    high = other.at(energy=43.0)
    assert len(high) == 2 and high[0].stability == "stable"
    even = [abs(p.orbit.harmonics("x", 2)[2]) for p in high]
    assert min(even) > 0.3 and even[0] == pytest.approx(even[1], rel=1e-6)  # two motions, each the other half a turn on


@pytest.mark.slow
def test_a_mechanism_has_the_modes_of_its_equations_and_says_what_is_left_out(tmp_path):
    curve = mc.continue_modes(loaded(CUBIC_PAIR, tmp_path), "frequency", (0.15, 0.2))
    check(curve, IN_PHASE)
    assert "left out: the damping of joint y; the damping of tendon between" in curve.notes


@pytest.mark.slow
def test_the_period_of_duffings_equation_is_its_elliptic_integral():
    curve = mc.continue_modes(duffing(), "energy", (1e-3, 50.0))
    exact = [period_of_duffing(e) for e in curve["energy"]]
    assert curve["period"] == pytest.approx(np.array(exact), rel=1e-9)
    assert curve.ends == [("at bound", "energy reached its bound 50")]


@pytest.mark.slow
def test_damping_of_a_field_with_velocities_is_left_out(in_phase):
    damped = mc.continue_modes(cubic_pair(damping=0.3), "energy", (0.1, 5.0))
    assert damped.notes == ("left out: what depends on the direction of motion",)
    (point,) = damped.at(energy=IN_PHASE[2][1])
    assert TWO_PI * point["frequency"] == pytest.approx(IN_PHASE[2][0], rel=1e-9)


@pytest.mark.slow
def test_the_period_of_a_pendulum_is_its_elliptic_integral(tmp_path):
    curve = mc.continue_modes(loaded(PENDULUM, tmp_path), "energy", (1e-2, 19.0))
    assert curve["period"] == pytest.approx(np.array([period_of_pendulum(e) for e in curve["energy"]]), rel=1e-8)
    assert set(curve.stability) == {"stable"}
    assert "left out: the damping of joint theta" in curve.notes


@pytest.mark.slow
def test_a_curve_in_frequency_begins_where_its_mode_comes_within_the_bounds():
    curve = mc.continue_modes(cubic_pair(), "frequency", (1.05 / TWO_PI, 1.1 / TWO_PI))
    assert curve["energy"][[0, -1]] == pytest.approx([IN_PHASE[1][1], IN_PHASE[2][1]], rel=1e-9)


@pytest.mark.slow
def test_modes_are_saved_and_go_on_from_any_orbit(in_phase, tmp_path):
    field = cubic_pair()
    loaded = mc.load(in_phase.save(tmp_path / "modes.h5"), problem=field)
    assert loaded.kind == "nonlinear modes" and loaded["energy"] == pytest.approx(in_phase["energy"], rel=1e-15)
    row = loaded[len(loaded) // 2]
    assert row.orbit.energy == row["energy"]
    onward = mc.continue_modes(row, "energy", (0.5 * row["energy"], 2.0 * row["energy"]), max_points=5)
    assert onward.at(energy=row["energy"])[0]["period"] == pytest.approx(row["period"], rel=1e-9)


# -- refusals -------------------------------------------------------------------------------------------------


def test_a_mode_that_there_is_not_is_told_with_those_that_there_are():
    with pytest.raises(mc.ParameterError, match=r"1 \(0.159155 Hz\), 2 \(0.275664 Hz\); got 3"):
        mc.continue_modes(cubic_pair(), "energy", (0.1, 1.0), mode=3)


def test_modes_vary_in_energy_or_frequency():
    with pytest.raises(mc.NameLookupError, match="energy, frequency"):
        mc.continue_modes(cubic_pair(), "c", (0.1, 1.0))


def test_a_field_whose_energy_is_not_known_is_asked_for_it():
    spiral = mc.VectorField(lambda u, p: [2.0 * u[1], -u[0]], [0.0, 0.0], {"k": 1.0})
    with pytest.raises(mc.MjcontError, match="give it, VectorField"):
        mc.continue_modes(spiral, "energy", (0.1, 1.0))


def test_a_field_that_keeps_no_energy_is_refused():
    def follower(u, p):  # the second mass pulls the first, which does not pull it
        return [u[2], u[3], -2.0 * u[0] + u[1], -3.0 * u[1]]

    pushed = mc.VectorField(follower, np.zeros(4), {"k": 1.0})
    with pytest.raises(mc.MjcontError, match="forces with a potential"):
        mc.continue_modes(pushed, "energy", (0.1, 1.0))


def test_a_parameter_called_energy_is_to_be_renamed():
    own = mc.VectorField(lambda u, p: [u[1], -u[0]], [0.0, 0.0], {"energy": 1.0})
    with pytest.raises(mc.ParameterError, match="energy_0"):
        mc.continue_modes(own, "energy", (0.1, 1.0))


def test_an_equilibrium_about_which_nothing_swings_has_no_modes():
    falling = mc.VectorField(lambda u, p: [u[1], u[0]], [0.0, 0.0], {"k": 1.0})
    with pytest.raises(mc.ParameterError, match="there is none"):
        mc.continue_modes(falling, "energy", (0.1, 1.0))


# -- stiff bushes ---------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [pytest.param(1e3, marks=pytest.mark.long), 1e6])
def test_a_mode_on_elastic_pins_begins_as_the_linear_one_and_is_stable(stiffness):
    overcentre = mc.Mechanism.from_xml("overcentre")
    start = {"F": 30.0, "k_j": stiffness}
    linear = mc.modes(mc.find_equilibrium(overcentre, {**start, "c_sp": 0.0}))[0]
    curve = mc.continue_modes(overcentre, "energy", (1e-4, 4e-4), start=start, resonances=())
    assert curve["frequency"][0] == pytest.approx(linear.frequency, rel=1e-4)
    assert set(curve.stability) == {"stable"} and not curve.special_points
    assert "left out: the damping of tendon spring" in curve.notes


def test_mechanisms_that_move_freely_are_refused(tmp_path):
    text = PENDULUM.replace('name="theta" type="hinge" axis="0 1 0"', 'name="theta" type="ball"')
    with pytest.raises(mc.MjcontError, match="nothing opposes rotation about z"):
        mc.continue_modes(loaded(text, tmp_path), "energy", (0.1, 1.0))


@pytest.mark.parametrize("sign", [0.0, -1.0])
def test_an_energy_that_does_not_grow_along_the_mode_is_refused(sign):
    field = mc.VectorField(lambda u, p: [u[1], -u[0]], [0.0, 0.0], {"a": 1.0},
                           energy=lambda u, p: sign * (u[0] ** 2 + u[1] ** 2))
    with pytest.raises(mc.MjcontError, match="does not grow along the mode of 0.159155 Hz"):
        mc.continue_modes(field, "energy", (0.1, 1.0))
