"""How slow is slow: when a load that changes at a finite rate makes a rest jump, against closed forms and motion."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ai_zeros

import mjcont as mc
from mjcont.numerics.points.passage import Passage, runaway

# less the first zero of Ai (Abramowitz and Stegun, table 10.13), and the first pole of the tritronquee solution of
# y'' = 6 y^2 + x (Joshi and Kitaev 2001), for x'' = s + x^2
AIRY, PAINLEVE = 2.33810741, 6.0**0.2 * 2.3841687


def jumped(field, state, start, end, **other):
    """Return the jump of a field whose load p (and others) goes from a start to an end."""
    problem = mc.VectorField(field, np.array(state), {"p": start, "q": 0.0})
    legs = [{"p": start, **{n: v[0] for n, v in other.items()}}, {"p": end, **{n: v[1] for n, v in other.items()}}]
    return mc.load_path(problem, legs, state=state).jumps[0]


def parabola(u, p):
    return p["p"] + p["q"] + u**2


def swinging(mass, damping):
    """Return m x'' + c x' = p + x^2 as a field of first order."""

    def field(u, p):
        x, speed = u.T
        return np.column_stack([speed, (p["p"] + x**2 - damping * speed) / mass])

    return field


def test_damping_alone_delays_to_airy_s_zero_and_inertia_alone_to_painleve_s_pole():
    assert runaway(0.0) == pytest.approx(-ai_zeros(1)[0][0], abs=1e-12)
    assert runaway(0.0) == pytest.approx(AIRY, abs=1e-8)
    assert runaway(1.0) == pytest.approx(PAINLEVE, abs=1e-6)
    assert np.all(np.diff([runaway(m) for m in (0.0, 1e-6, 9e-4, 1e-3, 1.1e-3, 0.1, 0.9, 1.0)]) > 0.0)
    assert math.isnan(runaway(-0.1))


@pytest.mark.slow
@pytest.mark.parametrize("mixture", [1e-4, 0.02, 0.5, 0.97])
def test_between_them_it_is_where_the_normal_form_s_own_motion_runs_away(mixture):
    m = mixture

    def motion(s, u):
        return [u[1], (s + u[0] ** 2 - (1.0 - m) * u[1]) / m]

    def large(s, u):
        return u[0] - 1e7

    large.terminal = True
    start = [-math.sqrt(40.0), 0.5 / math.sqrt(40.0)]
    run = solve_ivp(motion, (-40.0, 10.0), start, method="Radau", events=large, rtol=1e-8, atol=1e-10)
    left = math.sqrt(6.0 * m / 1e7)  # of the double pole
    assert run.t_events[0][0] + left == pytest.approx(runaway(m), abs=2e-3)


@pytest.mark.parametrize("rate", [1e-6, 1e-3, 1.0])
def test_a_scalar_field_jumps_at_airy_s_zero_times_the_rate_to_two_thirds(rate):
    jump = jumped(parabola, [-1.0], -1.0, 1.0)
    late = jump.delay(rate)
    assert late.shift == pytest.approx(AIRY * rate ** (2 / 3), rel=1e-8)
    assert late.time == pytest.approx(late.shift / rate, rel=1e-12)
    assert late.inertial == 0.0
    assert jump.delay(-rate) == late


@pytest.mark.slow
def test_its_own_motion_runs_away_there():
    jump, rate = jumped(parabola, [-1.0], -1.0, 1.0), 0.01

    def large(t, u):
        return u[0] - 1e8

    large.terminal = True
    run = solve_ivp(lambda t, u: rate * t + u**2, (-1.0 / rate, 1e3), [-1.0], events=large, rtol=1e-10, atol=1e-12)
    assert run.t_events[0][0] == pytest.approx(jump.delay(rate).time, rel=1e-6)


def test_coordinates_and_units_do_not_matter():
    """c x' = a p + b x^2 beside y' = -3 y, seen through a linear map."""
    a, b, c, rate = 0.3, 7.0, 2.0, 1e-3
    mix = np.array([[2.0, 1.0], [-1.0, 0.5]])

    def field(u, p):
        x, y = np.linalg.solve(mix, u.T)
        return (mix @ np.array([(a * p["p"] + b * x**2) / c, -3.0 * y])).T

    jump = jumped(field, (mix @ [-math.sqrt(a / b), 0.0]).tolist(), -1.0, 1.0)
    assert jump.delay(rate).shift == pytest.approx(AIRY * (c**2 * rate**2 / (a * b)) ** (1 / 3), rel=1e-7)


def test_loads_that_change_together_are_told_in_the_first_one_s_unit():
    rate = 1e-2
    jump = jumped(parabola, [-1.0], -1.0, 1.0, q=(0.0, 1.0))
    assert jump.parameter == "p"
    assert jump.delay(rate).shift == pytest.approx(AIRY * rate ** (2 / 3) / 1.5 ** (1 / 3), rel=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("rate", [1e-6, 1e-2])
def test_with_hardly_any_damping_the_power_is_four_fifths(rate):
    mass = 3.0
    late = jumped(swinging(mass, 1e-6), [-1.0, 0.0], -1.0, 1.0).delay(rate)
    assert late.inertial == pytest.approx(1.0, abs=1e-3)
    assert late.shift == pytest.approx(PAINLEVE * mass**0.4 * rate**0.8, rel=1e-3)


def test_a_field_of_first_order_and_its_normal_form_agree_with_both():
    mass, damping, rate = 0.5, 0.2, 1e-2
    late = jumped(swinging(mass, damping), [-1.0, 0.0], -1.0, 1.0).delay(rate)
    assert late.shift == pytest.approx(Passage(mass, damping, 1.0, 1.0).shift(rate), rel=1e-6)
    assert 0.1 < late.inertial < 0.9


FORMS = Passage(0.0, 2.0, 0.1, 5.0), Passage(3.0, 1e-9, 2.0, 1.0), Passage(1.0, 1.0, 1.0, 1.0)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("shift", [1e-6, 1.0, 1e3])
def test_the_rate_for_a_shift_is_the_inverse_of_the_shift(form, shift):
    assert form.shift(form.rate(shift)) == pytest.approx(shift, rel=1e-7)


# -- mechanisms ---------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module", params=[10.0, 0.01], ids=["damped", "swinging"])
def overcentre(request):
    """Return the overcentre's branch and its path, with the damping of both panels of figure 2."""
    model = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(model, "F", (-50.0, 50.0), start={"F": 50.0, "c_sp": request.param})
    return branch, mc.load_path(branch, "F", [50.0, -50.0, 50.0], landing="creep")


def passed(branch, jump, rate):
    """Return how long after the fold a history passes theta_1 = 0 under a falling load that begins on the branch."""
    late, fold = jump.delay(rate), jump.before["F"]
    first = fold + 5.0 * late.shift
    here, ahead = (branch.at(F=f)[-1] for f in (first, first - 1e-4))
    velocity = (ahead.state - here.state) / 1e-4 * rate
    duration = (first - fold) / rate + 2.0 * late.time
    history = mc.simulate(branch.problem, {"F": lambda t: first - rate * t}, duration, here, velocity=velocity,
                          samples=20000)
    below = np.argmax(history["theta_1"] < 0.0)
    rows = slice(below - 1, below + 1)
    return float(np.interp(0.0, -history["theta_1"][rows], history["time"][rows])) - (first - fold) / rate


@pytest.mark.long
def test_histories_of_the_overcentre_are_late_as_told(overcentre):
    """What higher terms of the normal form change in the time grows with the logarithm of the rate alone.

    The times themselves grow fivefold, so that a delay wrong by one part in a hundred would show.
    """
    branch, path = overcentre
    jump, rates = path.jumps[0], (0.1, 0.01, 0.001)
    told = np.array([jump.delay(rate).time for rate in rates])
    seen = np.array([passed(branch, jump, rate) for rate in rates])
    less = told - seen
    assert np.all(less > 0.0) and np.all(np.diff(less / told) < 0.0)
    assert abs(np.diff(less, 2)[0]) < 0.01 * told[-1]
    assert less[-1] < 0.15 * told[-1]


def test_the_powers_are_those_of_damping_and_of_inertia(overcentre):
    branch, path = overcentre
    power = math.log10(path.jumps[0].delay(1e-5).shift / path.jumps[0].delay(1e-6).shift)
    damped = branch.fixed["c_sp"] == 10.0
    assert power == pytest.approx(2 / 3 if damped else 4 / 5, abs=0.005 if damped else 0.03)


@pytest.mark.slow
def test_one_percent_of_the_load_is_told_in_the_summary_and_kept_in_files(overcentre, tmp_path):
    _, path = overcentre
    jump = path.jumps[0]
    assert jump.delay(jump.slow()).shift == pytest.approx(0.01 * jump.before["F"], rel=1e-7)
    assert f"late by 0.152 N under a load of {jump.slow():.3g} N/s" in str(path)
    loaded = mc.load(path.save(tmp_path / "path.h5")).jumps[0]
    assert (loaded.passage, loaded.slow(0.05)) == (jump.passage, jump.slow(0.05))


def test_what_is_no_fold_has_no_such_delay():
    rods = mc.Mechanism.from_xml("ziegler_rods")
    jump = mc.load_path(rods, "P", [1.4, 2.2], max_time=1.0).jumps[0]
    assert jump.kind == "HB"
    with pytest.raises(mc.MjcontError, match="HB1 is Hopf point: how slow is slow is known at folds"):
        jump.delay(0.1)


@pytest.mark.parametrize("rate", [0.0, math.nan, math.inf])
def test_a_rate_must_be_a_number(overcentre, rate):
    with pytest.raises(mc.ParameterError, match="the rate of F must be a number other than zero"):
        overcentre[1].jumps[0].delay(rate)
    with pytest.raises(mc.ParameterError, match="must be a positive number"):
        overcentre[1].jumps[0].slow(0.0 * rate)
