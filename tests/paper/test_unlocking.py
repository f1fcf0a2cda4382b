"""The unlocking study: gusts against closed forms, and what becomes of the gear against the cusp's unlock force.

The cusp, F_ul = -411.808 N, and the fold FP1, 474 766.687 N, are those of the paper's gear computed from energies of
planar links written out by hand.
"""

from __future__ import annotations

import importlib
import sys

import numpy as np
import pytest

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))
_gusts = importlib.import_module("_gusts")
_unlocking = importlib.import_module("_unlocking")

CUSP = 411.808  # N
PLAN = _unlocking.PLANS["nose_gear"]
AIRCRAFT = _gusts.Aircraft()
TIMES = np.arange(0.0, 21.0, 0.02)


@pytest.fixture(scope="module")
def stowed():
    """Return the gear at rest, locked up."""
    gear = mc.Mechanism.from_xml("nose_gear")
    return mc.find_equilibrium(gear, {"F_ret": PLAN.stowed}, keyframe="uplock_below")


def test_a_step_of_air_lifts_at_once_and_fades_with_the_time_constant():
    times = np.arange(0.0, 4.0, 1e-3)
    velocity = np.minimum(times / 1e-3, 1.0) * 5.0
    felt = _gusts.felt(times, velocity, AIRCRAFT)
    expected = 5.0 / (AIRCRAFT.tau * 9.81) * np.exp(-times / AIRCRAFT.tau)
    assert felt.load_factor[1:] - 1.0 == pytest.approx(expected[1:], rel=1e-3)


def test_the_load_factor_is_the_acceleration_of_the_climb_that_the_gravity_angle_shows():
    gust = _gusts.one_minus_cos(TIMES, 7.62, 107.0, 5.0, AIRCRAFT)
    climb = gust.gravity_angle * AIRCRAFT.speed
    impulse = np.trapezoid(9.81 * (gust.load_factor - 1.0), TIMES)
    assert climb[-1] == pytest.approx(impulse, abs=1e-3)
    assert gust.velocity.max() == pytest.approx(7.62, rel=1e-3)
    assert TIMES[gust.velocity > 0][-1] == pytest.approx(5.0 + 2 * 107.0 / 90.0, abs=0.05)


@pytest.mark.slow
def test_turbulence_has_the_variance_and_correlation_of_its_spectrum():
    times = np.arange(0.0, 20_000.0, 0.1)
    gust = _gusts.dryden(times, 1.5, 150.0, 3, AIRCRAFT)
    u = gust.velocity[1000:]
    lag = 10
    assert u.std() == pytest.approx(1.5, rel=0.05)
    assert np.mean(u[lag:] * u[:-lag]) / np.mean(u**2) == pytest.approx(np.exp(-90.0 * 1.0 / 150.0), abs=0.03)


def test_turbulence_is_the_same_for_the_same_seed_only():
    a, b, c = (_gusts.dryden(TIMES, 1.5, 150.0, seed, AIRCRAFT).velocity for seed in (1, 1, 2))
    assert np.array_equal(a, b)
    assert not np.array_equal(a, c)


@pytest.mark.slow
def test_in_still_air_the_force_measure_unlocks_beyond_the_cusp_only(stowed):
    runs = _unlocking.unlock_runs(stowed, "force", CUSP * np.array([0.9, 0.99, 1.01, 1.2]))
    assert list(runs.outcomes == 0) == [False, False, True, True]


@pytest.mark.slow
def test_the_position_measure_locks_again_unless_the_unlock_force_is_kept(stowed):
    position = _unlocking.unlock_runs(stowed, "position", np.array([CUSP * 1.2]))
    scheduled = _unlocking.unlock_runs(stowed, "scheduled", np.array([CUSP * 1.2]))
    assert _unlocking.OUTCOMES[position.outcomes[0]] == "re-locked"
    assert _unlocking.OUTCOMES[scheduled.outcomes[0]] == "unlocked"


@pytest.mark.slow
def test_both_actuators_follow_one_sequence(stowed):
    (history,) = _unlocking.unlock_runs(stowed, "force", np.array([500.0])).histories
    pulling = history["F_ul"] < -1.0
    assert history["F_ret"].max() == pytest.approx(PLAN.overtravel)
    assert history["F_ul"].min() == pytest.approx(-500.0)
    assert history["F_ret"][np.flatnonzero(pulling)[0]] == pytest.approx(PLAN.overtravel)
    falling = np.diff(history["F_ul"], append=0.0) > 1.0
    assert history["F_ret"][falling].max() <= PLAN.release + 2e3


@pytest.mark.long
def test_findings_of_the_study(tmp_path):
    findings = load_script(scripts_folder() / "unlocking.py").main(tmp_path)
    assert all(f.holds for f in findings), [f.claim for f in findings if not f.holds]
    assert (tmp_path / "unlocking.png").stat().st_size > 50_000
