"""Cycles found in motion, against periods and multipliers of shooting in 80-bit arithmetic."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.motions import (
    parametric_pendulum,
    pendulum_under_torque,
    reactions,
    rossler,
    van_der_pol,
    ziegler_rods,
)

import mjcont as mc

PERIOD, MULTIPLIER, TRIVIAL = 1e-9, 1e-6, 1e-7


def holds(orbit, period, *multipliers):
    """Whether an orbit has a period and multipliers, the 1 of an unforced one among them."""
    assert orbit.period == pytest.approx(period, rel=PERIOD)
    assert len(orbit.multipliers) == len(multipliers) + (orbit.trivial >= 0)
    for mu in multipliers:
        assert np.abs(orbit.multipliers - mu).min() < MULTIPLIER
    return orbit.trivial < 0 or abs(orbit.multipliers[orbit.trivial] - 1.0) < TRIVIAL


@pytest.fixture(scope="module")
def relaxing():
    return mc.continue_cycles(van_der_pol(), "mu", (1.0, 10.0))


@pytest.mark.parametrize(
    ("mu", "period", "multiplier"),
    [(1.0, 6.66328685932313, 0.0008596950636038381), (5.0, 11.61223066771957, 0.0), (10.0, 19.078369566939017, 0.0)],
)
def test_a_relaxation_oscillation_has_the_known_period(relaxing, mu, period, multiplier):
    (point,) = relaxing.at(mu=mu)
    assert holds(point.orbit, period, multiplier)


def test_a_relaxation_oscillation_has_no_special_points(relaxing):
    assert relaxing.special_points == ()
    assert [status for status, _ in relaxing.ends] == ["at bound", "at bound"]


@pytest.mark.slow
def test_a_stiff_relaxation_oscillation_is_found_in_its_motion():
    assert mc.find_cycle(van_der_pol(100.0)).period == pytest.approx(162.8371, abs=1e-4)


@pytest.mark.long
def test_a_relaxation_oscillation_is_followed_until_its_jumps_are_steep():
    curve = mc.continue_cycles(van_der_pol(), "mu", (1.0, 100.0), direction=1)
    assert curve.ends[-1][0] == "at bound"
    assert curve["period"][-1] == pytest.approx(162.8371, abs=1e-4)
    assert curve.special_points == ()


@pytest.fixture(scope="module")
def spiral():
    return mc.continue_cycles(rossler(), "c", (2.5, 4.2))


@pytest.fixture(scope="module")
def doubled(spiral):
    return mc.continue_cycles(spiral.point("PD1"))


@pytest.mark.parametrize(
    ("c", "period", "multipliers"),
    [
        (2.5, 5.748991183278001, (-0.7696936417339523, -5.174304326541115e-06)),
        (4.0, 5.8253730804017625, (-1.6778186350799806, 0.0)),
    ],
)
def test_the_spiral_has_the_known_multipliers(spiral, c, period, multipliers):
    (point,) = spiral.at(c=c)
    assert holds(point.orbit, period, *multipliers)


def test_the_spiral_doubles_its_period_where_it_must(spiral):
    (doubling,) = spiral.special_points
    assert doubling.kind == "PD"
    assert doubling["c"] == pytest.approx(2.832445027862539, abs=1e-8)
    assert doubling.orbit.period == pytest.approx(5.769820016506563, rel=PERIOD)


def test_the_doubled_spiral_doubles_again(doubled):
    (again,) = doubled.special_points
    assert again.kind == "PD"
    assert again["c"] == pytest.approx(3.837358168410094, abs=1e-8)
    assert again.orbit.period == pytest.approx(11.572688804465818, rel=PERIOD)


def test_the_doubled_spiral_has_the_known_multipliers(doubled):
    (point,) = doubled.at(c=3.2)
    assert holds(point.orbit, 11.531081041210449, 0.1541925276439321, 0.0)


@pytest.mark.parametrize(
    ("damping", "torque", "period", "fastest"),
    [
        (0.5, 1.2, 2.6574358794989106, 2.7932670120757264),
        (0.5, 1.02, 3.1709867875448494, 2.493968398251866),
        (0.2, 0.6, 2.107498442451076, 3.3243246960407085),
    ],
)
def test_a_pendulum_goes_round_with_the_known_period(damping, torque, period, fastest):
    orbit = mc.find_cycle(pendulum_under_torque(damping, torque))
    assert holds(orbit, period, math.exp(-damping * period))
    assert orbit.shift == pytest.approx([2.0 * math.pi, 0.0])
    assert orbit.states[:, 1].max() == pytest.approx(fastest, rel=1e-3)


@pytest.mark.slow
def test_a_pendulum_that_hardly_gets_over_the_top_ends_its_curve_by_its_period():
    curve = mc.continue_cycles(pendulum_under_torque(0.5, 1.2), "torque", (0.3, 1.3), direction=-1)
    assert curve.status == "period"
    assert "lingers at the equilibrium" in curve.ends[0][1]
    assert curve.special_points == ()


@pytest.mark.slow
def test_a_hinge_with_a_motor_goes_round_like_the_pendulum():
    pendulum = mc.Mechanism.from_xml("""
    <mujoco model="pendulum">
      <option gravity="0 0 -1"/>
      <worldbody>
        <body name="bob">
          <joint name="pivot" type="hinge" axis="0 -1 0" damping="0.5"/>
          <inertial pos="0 0 -1" mass="1" diaginertia="1e-13 1e-13 1e-13"/>
        </body>
      </worldbody>
      <actuator><motor name="torque" joint="pivot"/></actuator>
    </mujoco>""")
    curve = mc.continue_cycles(pendulum, "torque", (1.02, 1.2), start={"torque": 1.2}, direction=-1)
    assert holds(curve.orbits[-1], 2.6574358794989106, math.exp(-0.5 * 2.6574358794989106))
    assert holds(curve.orbits[0], 3.1709867875448494, math.exp(-0.5 * 3.1709867875448494))


@pytest.mark.slow
def test_a_tank_of_reactions_has_the_known_cycle():
    assert holds(mc.find_cycle(reactions()), 6.260697425666006, 0.008544929379561864, 0.0)


@pytest.fixture(scope="module")
def column():
    return mc.continue_cycles(mc.continue_equilibria(ziegler_rods(), "P", (1.5, 2.2)).point("HB1"))


@pytest.mark.parametrize(
    ("load", "period", "multiplier", "fast"),
    [
        (1.689573, 7.651207427998781, 0.978569890122609, 8.651286675862135e-05 + 0.003083862801796801j),
        (1.822089, 7.480310949944562, 0.9003618235242208, 0.002569152907741625 + 0.0045357022306417305j),
        (2.153378, 7.0498854157529856, 0.7170603569921984, 0.013159358973469624 + 0.00220813258921611j),
    ],
)
def test_a_column_flutters_with_the_known_multipliers(column, load, period, multiplier, fast):
    (point,) = column.at(P=load)
    assert holds(point.orbit, period, multiplier, fast, fast.conjugate())


@pytest.fixture(scope="module")
def swinging():
    rest = mc.continue_response(parametric_pendulum(2.0), "A", (0.1, 0.7))
    return mc.continue_response(rest.point("PD1"))


def test_a_shaken_pendulum_swings_at_twice_the_period(swinging):
    (point,) = swinging.at(A=0.6)
    mu = -0.17015549733042729 + 0.7103064112193682j
    assert holds(point.orbit, 6.283185307179586, mu, mu.conjugate())
    assert swinging.special_points == ()


def nerve(u, p):
    """Hodgkin and Huxley's equations in mV and ms, rest at 0 mV."""

    def over(z):
        return z / math.expm1(z) if abs(z) > 1e-9 else 1.0 - 0.5 * z

    v, m, h, n = u
    ionic = 120.0 * m**3 * h * (v - 115.0) + 36.0 * n**4 * (v + 12.0) + 0.3 * (v - 10.599)
    return [
        p["I"] - ionic,
        over(0.1 * (25.0 - v)) * (1.0 - m) - 4.0 * math.exp(-v / 18.0) * m,
        0.07 * math.exp(-v / 20.0) * (1.0 - h) - h / (math.exp(0.1 * (30.0 - v)) + 1.0),
        0.1 * over(0.1 * (10.0 - v)) * (1.0 - n) - 0.125 * math.exp(-v / 80.0) * n,
    ]


@pytest.mark.long
@pytest.mark.parametrize("mesh", [None, 80])
def test_the_cycles_of_a_nerve_lead_from_one_hopf_point_to_the_other_over_three_folds(mesh):
    """Rinzel and Miller (Mathematical Biosciences 49, 1980) have the folds at 7.846, 7.922 and 6.265 uA/cm2.

    On the way a multiplier reaches millions, and the period more than doubles without growing without bound.
    """
    field = mc.VectorField(nerve, [0.0, 0.053, 0.596, 0.318], {"I": 0.0}, names=["V", "m", "h", "n"])
    first, second = mc.continue_equilibria(field, "I", (0.0, 200.0)).special_points
    cycles = mc.continue_cycles(first, bounds=(0.0, 200.0), **({} if mesh is None else {"mesh": mesh}))
    assert dict(cycles.ends)["rest"] == "the orbit shrinks to a Hopf point (HB)"
    assert cycles["I"].max() == pytest.approx(second["I"], rel=1e-3)
    assert [p["I"] for p in cycles.of_kind("LPC")] == pytest.approx([7.846, 7.922, 6.265], abs=1e-3)


def test_a_function_may_fill_one_array_again_and_again():
    kept = np.zeros(2)

    def f(u, p):
        kept[:] = u[1], p["mu"] * (1.0 - u[0] ** 2) * u[1] - u[0]
        return kept

    orbit = mc.find_cycle(mc.VectorField(f, [2.0, 0.0], {"mu": 1.0}))
    assert orbit.period == pytest.approx(6.66328685932313, rel=PERIOD)
