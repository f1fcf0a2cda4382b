"""Curves of orbits while they are followed: progress is told, and the user's stops and Ctrl-C keep orbits."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import pytest
from problems.motions import bautin
from problems.oscillators import QUICK, circles, linear

import mjcont as mc


def interrupting(after):
    def progress(count, special):
        if count == after:
            raise KeyboardInterrupt

    return progress


@pytest.mark.slow
def test_progress_counts_orbits_and_names_what_is_found():
    seen = []
    curve = mc.continue_cycles(circles()[0].point("HB1"), progress=lambda count, found: seen.append((count, found)))
    counts = [c for c, found in seen if not found.kind]
    assert counts == list(range(1, len(counts) + 1))
    (found,) = [found for _, found in seen if found.kind]
    assert (found.kind, found.parameters["b1"]) == ("LPC", pytest.approx(-0.25, abs=1e-8))
    assert len(curve) >= len(counts)


@pytest.mark.slow
def test_a_limit_on_time_keeps_the_orbits_reached():
    def dawdling(count, special):
        if count == 3:
            time.sleep(1.0)

    curve = mc.continue_response(linear(), "w", (0.5, 2.0), progress=dawdling, max_seconds=1.0, **QUICK)
    assert curve.status == "max time"
    assert "the limit of 1 s was reached" in dict(curve.ends)["max time"]
    assert 1 <= len(curve) <= 4


@pytest.mark.slow
def test_an_interrupt_keeps_the_orbits_reached(tmp_path):
    curve = mc.continue_response(linear(), "w", (0.5, 2.0), progress=interrupting(5), **QUICK)
    assert curve.interrupted
    assert 1 < len(curve) <= 6
    assert "interrupted" in str(curve)
    loaded = mc.load(curve.save(tmp_path / "part.h5"))
    assert loaded.interrupted
    assert loaded[-1].orbit.period == curve[-1].orbit.period


def test_an_interrupt_inside_the_users_function_keeps_the_orbits_reached():
    left = [math.inf]
    hopf = circles()[0].point("HB1")
    own = bautin().function

    def counted(u, p, t):
        left[0] -= 1
        if left[0] < 0:
            left[0] = math.inf
            raise KeyboardInterrupt
        return own(u, p, t)

    def progress(count, special):
        if count == 6:
            left[0] = 50

    field = mc.VectorField(counted, [0.0, 0.0], {"b1": -0.5, "b2": 1.0})
    curve = mc.continue_cycles(replace(hopf, problem=field), progress=progress)
    assert curve.interrupted
    assert len(curve) >= 6


@pytest.mark.slow
def test_a_stop_sees_the_orbit_and_ends_the_curve():
    def large(point):
        return "large enough" if point["u[0].max"] > 0.5 else None

    curve = mc.continue_cycles(circles()[0].point("HB1"), stop=large)
    assert "large enough" in curve.message
    assert curve["u[0].max"][-2] <= 0.5 or curve["u[0].max"][0] > 0.5
