"""Locking and unlocking: the gear that locks along load paths, and the same gear with a stop for its locklinks.

The stop engages where the gear without it rests at the stop's angle: equilibria of planar links on linear springs,
written out by hand (gears.py), with theta_ov given and a load unknown.
"""

from __future__ import annotations

import importlib
import sys
from functools import cache

import numpy as np
import pytest
from problems.gears import LOCKING
from problems.marks import long

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))
_unlocking = importlib.import_module("_unlocking")

# N, computed apart from MuJoCo (test_locking_gear.py)
FP1, FP2, FP1_UNLOCKED = 514184.959, 450322.109, 414608.168
STOP = np.radians(-5.0)


@pytest.fixture(scope="module")
def gear():
    return mc.Mechanism.from_xml("nose_gear_locking")


@pytest.fixture(scope="module")
def stopped():
    return mc.Mechanism.from_xml("nose_gear_stop")


@pytest.fixture(scope="module")
def locked(stopped):
    """The locked curve of the gear with a stop, in F_ret."""
    return mc.continue_equilibria(stopped, "F_ret", (0.0, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")


@pytest.fixture(scope="module")
def along(stopped, locked):
    """Return a function: the curve in another parameter through the stopped gear's rest without retraction force."""
    (rest,) = locked.at(F_ret=0.0)

    @cache
    def branch(name, low, high, **values):
        start = mc.find_equilibrium(stopped, {**rest.parameters, **values}, state=rest.state)
        return mc.continue_equilibria(stopped, name, (low, high), start)

    return branch


def load_at_the_stop(gear, name, near, value, **values):
    """Return the value of a load, linear in the forces, that balances the free gear at theta_ov = STOP, by Newton."""
    p = {**gear.values(), **values}
    q, load = np.array(near, dtype=float), value
    q[4] = STOP

    def forces(at, load):
        return LOCKING.forces_at_rest(at, {**p, name: load})

    for _ in range(30):
        columns = [np.imag(forces_complex(q + 1e-30j * e, p, name, load)) / 1e-30 for e in np.eye(5)[:4]]
        rate = forces(q, load + 1.0) - forces(q, load)
        step = np.linalg.solve(np.column_stack([*columns, rate]), -forces(q, load))
        q[:4] += step[:4]
        load += step[4]
        if np.abs(step[:4]).max() < 1e-12:
            return load
    raise AssertionError("no balance at the stop")


def forces_complex(q, p, name, load):
    """Forces at a complex state: central differences of the potential along each coordinate."""
    values, h = {**p, name: load}, 1e-4
    work = np.zeros(5, dtype=complex)
    work[0] = -values["r_ret"] * values["F_ret"]
    slopes = [
        (8 * (LOCKING.potential(q + h * e, values) - LOCKING.potential(q - h * e, values))
         - (LOCKING.potential(q + 2 * h * e, values) - LOCKING.potential(q - 2 * h * e, values))) / (12 * h)
        for e in np.eye(5)
    ]
    return work - np.array(slopes)


def corner(branch):
    (point,) = branch.of_kind("CO")
    return point


# -- without a stop --------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def slowly(gear):
    legs = [{"F_ret": 2.5e5, "F_ul": 0.0}, {"F_ret": 5.5e5}, {"F_ret": 3e5}]
    return mc.load_path(gear, legs, keyframe="uplock_above")


@pytest.mark.slow
def test_the_retracting_gear_jumps_at_fp1_onto_the_locked_curve(gear, slowly):
    lock = slowly.jumps[0]
    assert lock.before["F_ret"] == pytest.approx(FP1, rel=1e-7)
    assert lock.before["theta_ov"] > 0 > lock.after["theta_ov"] > np.radians(-1.0)
    curve = mc.continue_equilibria(gear, "F_ret", (2e5, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")
    rest = max((p for p in curve.at(F_ret=lock.after["F_ret"]) if p.n_unstable == 0), key=lambda p: p["theta_ov"])
    assert lock.after["theta_ov"] == pytest.approx(rest["theta_ov"], abs=1e-9)


def test_the_locked_gear_stays_down_to_fp2_and_then_lets_go(slowly):
    lock, release = slowly.jumps
    held = slowly["theta_ov"][lock.index + 1 : release.index + 1]
    assert release.before["F_ret"] == pytest.approx(FP2, rel=1e-7)
    assert np.all(held < 0) and np.all(held > np.radians(-16.8))
    assert release.after["theta_ov"] < np.radians(-45.0)


@pytest.mark.slow
def test_500_newton_unlock_the_gear_at_the_new_fp1_and_it_stays_unlocked_without(gear):
    legs = [{"F_ret": 4.6e5, "F_ul": 0.0}, {"F_ret": 4.142e5, "F_ul": -500.0}, {"F_ret": 4.3e5}, {"F_ul": 0.0},
            {"F_ret": 1e5}]
    start = mc.continue_equilibria(gear, "F_ret", (4.55e5, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")
    path = mc.load_path(gear, legs, start=start.at(F_ret=4.6e5)[0])
    (unlock,) = path.jumps
    assert unlock.before["F_ret"] == pytest.approx(FP1_UNLOCKED, rel=1e-7)
    assert unlock.before["theta_ov"] < 0 < unlock.after["theta_ov"]
    assert path.final["theta_ov"] > 0 and path.final["F_ul"] == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("measure", ["position", long("force")])
def test_in_still_air_the_gear_unlocks_beyond_the_turn_of_its_locus(gear, measure):
    """w . f_F_ret = 0 lies at F_ul = -19.58 N (mjcont), the cusp at -176.61 N."""
    plan = _unlocking.PLANS["nose_gear_locking"]
    curve = mc.continue_equilibria(gear, "F_ret", (4.55e5, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")
    runs = _unlocking.unlock_runs(curve.at(F_ret=plan.stowed)[0], measure, np.array([15.0, 25.0, 100.0]))
    assert [_unlocking.OUTCOMES[k] for k in runs.outcomes] == ["stuck", "unlocked", "unlocked"]


# -- with a stop -----------------------------------------------------------------------------------------------------


def test_the_locklinks_meet_the_stop_where_the_free_gear_rests_at_its_angle(stopped, locked):
    meets = corner(locked)
    expected = load_at_the_stop(stopped, "F_ret", meets.state, 4.8e5)
    assert meets["F_ret"] == pytest.approx(expected, rel=1e-6)
    assert meets["theta_ov"] == pytest.approx(STOP, abs=1e-7)
    assert "stop engages" in meets.note or "stop releases" in meets.note


@pytest.mark.long
def test_with_a_stop_the_gear_stays_locked_without_retraction_force(stopped, locked):
    assert np.all(locked.n_unstable == 0)
    assert locked["F_ret"].min() == 0.0
    path = mc.load_path(stopped, "F_ret", [2.5e5, 5.5e5, 0.0], keyframe="uplock_above")
    assert [j.kind for j in path.jumps] == ["LP"]
    assert path.final["F_ret"] == 0.0
    assert np.radians(-5.5) < path.final["theta_ov"] < STOP


def test_the_load_on_the_stop_is_the_moment_by_which_the_free_gear_is_out_of_balance(stopped, locked):
    (rest,) = locked.at(F_ret=0.0)
    assert rest["stop_load"] == pytest.approx(-LOCKING.forces_at_rest(rest.state, rest.parameters)[4], rel=1e-6)
    assert rest["stop_load"] > 100.0


@pytest.mark.slow
@pytest.mark.parametrize("load_factor", [0.5, 1.0, 2.5])
def test_the_spring_may_be_as_short_as_the_balance_at_the_stop_allows(stopped, along, load_factor):
    branch = along("l_us", 0.75, 1.25, load_factor=load_factor)
    opens = corner(branch)
    expected = load_at_the_stop(stopped, "l_us", opens.state, 1.0, load_factor=load_factor)
    assert opens["l_us"] == pytest.approx(expected, rel=1e-6)
    longer = (branch["l_us"] > opens["l_us"] + 1e-6) & (branch["theta_ov"] < STOP)
    assert np.all(branch.n_unstable[longer] == 0) and longer.any()


def test_without_a_spring_the_weight_holds_the_gear_on_its_stop(along):
    branch = along("k_sp", 0.0, 1e5)
    assert np.all(branch.n_unstable == 0)
    assert np.all(branch["theta_ov"] < STOP)


@pytest.mark.slow
def test_the_unlock_force_without_retraction_force_is_that_of_the_balance_at_the_stop(stopped, along):
    opens = corner(along("F_ul", -6000.0, 0.0))
    assert opens["F_ul"] == pytest.approx(load_at_the_stop(stopped, "F_ul", opens.state, -3000.0), rel=1e-6)
    assert opens.note.endswith("F_ul turns back: a non-smooth fold")


@pytest.mark.slow
@pytest.mark.parametrize(("f_ul", "kind"), [(-100.0, "LP"), (-500.0, "CO")])
def test_weak_unlock_forces_open_the_lock_at_a_fold_strong_ones_at_the_corner(stopped, along, f_ul, kind):
    branch = along("F_ret", 0.0, 8e5, F_ul=f_ul)
    highest = int(np.argmax(branch["F_ret"]))
    (point,) = (p for p in branch.special_points if p.index == highest)
    assert point.kind == kind
    if kind == "CO":
        expected = load_at_the_stop(stopped, "F_ret", point.state, 4e5, F_ul=f_ul)
        assert point["F_ret"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.long
def test_a_displaced_gear_returns_to_its_rest_on_or_off_the_stop(stopped, locked):
    rests = [p for force in (0.0, 2e5, 4e5, 5e5, 6e5) for p in locked.at(F_ret=force)]
    aside = np.array([0.0, 0.0, 0.0, 1e-3, -1e-3])
    cases = [{"inputs": {"F_ret": p["F_ret"]}, "start": p, "state": p.state + aside} for p in rests]
    for rest, history in zip(rests, mc.simulate_many(stopped, cases, 6.0, integrator="model"), strict=True):
        assert history["theta_ov"][0] == pytest.approx(rest["theta_ov"] - 1e-3, abs=1e-9)
        assert history["theta_ov"][-1] == pytest.approx(rest["theta_ov"], abs=2e-4)


# -- long ------------------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(("keyframe", "force"), [("uplock_above", 2.5e5), ("uplock_below", 6e5)])
def test_simulations_beside_the_curves_grow_and_decay_as_the_eigenvalues_say(gear, keyframe, force):
    branch = mc.continue_equilibria(gear, "F_ret", (2e5, 8e5), {"F_ret": force}, keyframe=keyframe)
    certificate = mc.verify_stability(branch, n=10).certificate
    assert "10 confirmed" in str(certificate)


@pytest.mark.long
@pytest.mark.parametrize("study", ["locking", "locking_gusts"])
def test_findings_of_the_studies(study, tmp_path):
    findings = load_script(scripts_folder() / f"{study}.py").main(tmp_path)
    assert [f.claim for f in findings if not f.holds] == []
    assert (tmp_path / f"{study}.png").stat().st_size > 50_000
