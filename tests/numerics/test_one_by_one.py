"""Plain pseudo-arclength, and that long steps with points inside lead along the same curve."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import mjcont as mc
from mjcont.curves.walkers import equilibrium_walker
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.step.arclength import CurvePoint, first_point
from mjcont.numerics.walk.filled import Filled
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.steps import End
from mjcont.numerics.walk.trace import trace


class OneAtATime(mc.Mechanism):
    """A mechanism whose states are evaluated one after the other: long steps do not pay."""

    def side_by_side(self, name):
        return False


def circle():
    field = mc.VectorField(lambda u, p: [u[0] ** 2 + p["a"] ** 2 - 1.0], [1.0], {"a": 0.0}, bounds={"a": (-2.0, 2.0)})
    return System(field, field.values(), [Free("a", -2.0, 2.0)])


def test_plain_steps_stay_on_the_circle_and_turn_round_it():
    system = circle()
    stepper, point = OneByOne(system, Settings()), first_point(circle(), np.ones(1), np.zeros(1), 1.0, Settings())
    h, turned = stepper.begin(point), 0.0
    while turned < 2.0 * math.pi:
        (step,) = stepper.steps(point, h)
        assert not isinstance(step, End)
        (new,) = (i for i in step.items if isinstance(i, CurvePoint))
        assert new.x[0] ** 2 + system.values(new.y)["a"] ** 2 == pytest.approx(1.0, abs=1e-12)
        turned += new.angle
        point, h = new, step.next
    assert h <= Settings().ds_max


@pytest.mark.parametrize(("cls", "kind"), [(mc.Mechanism, Filled), (OneAtATime, OneByOne)])
def test_long_steps_are_taken_where_points_inside_are_cheap(cls, kind):
    mechanism = cls.from_xml("overcentre")
    system = System(mechanism, mechanism.values(), [Free("F", -30.0, 30.0)])
    assert type(equilibrium_walker(system, Settings(), {}).stepper) is kind


@pytest.mark.slow
@pytest.mark.parametrize(("model", "parameter"), [("overcentre", "F"), ("four_bar", None)])
def test_the_walk_without_long_steps_is_exactly_the_plain_one_and_the_filled_one_the_same_curve(model, parameter):
    plain, filled = (cls.from_xml(model) for cls in (OneAtATime, mc.Mechanism))
    name = parameter or next(n for n, p in filled.parameters.items() if p.kind == "control")
    off, on = (mc.continue_equilibria(m, name, chord=math.inf) for m in (plain, filled))
    assert [(p.kind, p.label) for p in off.special_points] == [(p.kind, p.label) for p in on.special_points]
    for a, b in zip(off.special_points, on.special_points, strict=True):
        assert a[name] == pytest.approx(b[name], rel=1e-9, abs=1e-9)
        assert a.state == pytest.approx(b.state, abs=1e-7)
    assert [s for s, _ in off.ends] == [s for s, _ in on.ends]
    low, high = on.free[name]
    z, w = (np.column_stack([b.states / filled.state_scale, b[name] / (high - low)]) for b in (on, off))
    chords = z[1:] - z[:-1]
    lengths = np.maximum(np.linalg.norm(chords, axis=1), 1e-300)
    for p in w:  # a chord of length h is h^2 / 8 times the curvature off the curve: 5 degrees over ds_max
        part = np.clip(((p - z[:-1]) * chords).sum(axis=1) / lengths**2, 0.0, 1.0)
        assert np.linalg.norm(p - z[:-1] - part[:, None] * chords, axis=1).min() < 1e-3

    system = System(plain, off.parameters_at(off.start_index), [Free(name, low, high, plain.parameter(name).unit)])
    start = first_point(system, off.states[off.start_index], system.start_y(), 1.0, Settings())
    by_hand, h, point = [start], Settings().ds, start
    stepper = OneByOne(system, Settings(), equilibrium_walker(system, Settings(), {}).stepper.detectors)
    walked = trace(equilibrium_walker(system, Settings(), {}), start, None).points
    while len(by_hand) < len(walked):
        step = stepper.step(point, h)
        assert not isinstance(step, End)
        point, h = next(i for i in step.items if isinstance(i, CurvePoint)), step.next
        by_hand.append(point)
    assert all(np.array_equal(a.x, b.x) and np.array_equal(a.y, b.y) for a, b in zip(by_hand, walked, strict=True))


@pytest.mark.slow
def test_what_a_monitor_says_of_a_step_does_not_depend_on_what_it_was_asked_before():
    system = circle()
    stepper = equilibrium_walker(system, Settings(), {"u[0]": 0.5}).stepper
    points = trace(equilibrium_walker(system, Settings(), {}), first_point(system, np.ones(1), np.zeros(1), 1.0,
                                                                           Settings()), None).points
    for detector in stepper.detectors:
        forward = [detector.crossed(a, b) for a, b in itertools.pairwise(points)]
        backward = [detector.crossed(a, b) for a, b in reversed(list(itertools.pairwise(points)))]
        assert forward == backward[::-1]
        assert [detector.value(p) for p in points] == [detector.value(p) for p in points]
