"""Loops that MuJoCo's own constraints close, three ways: as they are, as bushes, and by equations written by hand.

The equations (linkages.py) know nothing of MuJoCo: V = energy + K |gap|^2 / 2. For gears, a rope and a weld they are
written out below.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from problems.linkages import (
    GRAVITY,
    LINKAGES,
    QUICK_FIRST,
    Linkage,
    elastic_folds,
    rigid_folds,
    turned,
    unstable_directions,
)

import mjcont as mc

TURNS = {"four_bar": (-3.0, 3.0), "slider_crank": (-3.0, 3.0), "watt_six_bar": (-3.0, 3.0), "rssr": (-1.2, 1.6)}
STIFFNESSES = [1e4, 1e5, 1e6, 1e7]
LONG = pytest.mark.long


@cache
def rigid(name):
    return rigid_folds(LINKAGES[name], TURNS[name])


@cache
def by_hand(name, stiffness):
    return elastic_folds(LINKAGES[name], stiffness, rigid(name)[:, 0])


@cache
def branch_of(name, closure, stiffness):
    """Return a linkage's branch in M and the crank's angle in the pose qpos0."""
    if closure == "native":
        mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness(name, stiffness))
    else:
        mechanism = mc.Mechanism.from_spec(mc.add_bushes(name, stiffness=stiffness))
    assert mechanism.constrained == (closure == "native")
    start = mechanism.qpos0[mechanism.state_labels.index(("crank", "rad"))]
    window = tuple(start + t for t in TURNS[name])
    return mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), start={"M": 0.0}, limits={"crank": window}), start


def folds(name, closure, stiffness):
    """Return (turn, M) of the folds."""
    branch, start = branch_of(name, closure, stiffness)
    return np.array(sorted((p["crank"] - start, p["M"]) for p in branch.of_kind("LP")))


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [1e4, *(pytest.param(k, marks=LONG) for k in (1e5, 1e6, 1e7))])
@pytest.mark.parametrize("closure", ["native", "bush"])
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_folds_are_those_of_the_equations_written_by_hand(name, closure, stiffness):
    np.testing.assert_allclose(folds(name, closure, stiffness), by_hand(name, stiffness), rtol=1e-7, atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_folds_with_native_constraints_approach_the_rigid_linkage_at_rate_1_over_k(name):
    errors = np.array([folds(name, "native", k) - rigid(name) for k in STIFFNESSES])
    # error = c / K + d / K^2: the rate K times error tends to c, itself at rate 1/K
    rates = errors * np.array(STIFFNESSES)[:, None, None]
    change = np.abs(np.diff(rates, axis=0)).max(axis=1) / np.abs(rates[-1]).max(axis=0)
    assert np.all(change < [[0.1], [1e-2], [1e-3]])


@pytest.mark.slow
@pytest.mark.parametrize("closure", ["native", pytest.param("bush", marks=LONG)])
@pytest.mark.parametrize("stiffness", [1e4, pytest.param(1e6, marks=LONG)])
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_the_verdicts_on_stability_are_those_of_the_energy(name, closure, stiffness):
    # a native constraint adds mass to the fast modes; the number of unstable directions is the energy's all the same
    branch, start = branch_of(name, closure, stiffness)
    labels = np.array([bool(label) for label in branch.labels])
    near = np.min(np.abs((branch["crank"] - start)[:, None] - by_hand(name, stiffness)[:, 0]), axis=1)
    rows = np.flatnonzero(~labels & (near > 1e-3))[:: max(1, len(branch) // 15)]
    expected = unstable_directions(LINKAGES[name], branch["crank"][rows] - start, stiffness)
    assert set(expected) == {0, 1}
    np.testing.assert_array_equal(branch.n_unstable[rows], expected)
    words = np.where(expected > 0, "unstable", "stable")
    np.testing.assert_array_equal(branch.stability[rows], words)


# -- stiffness studies -----------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_a_stiffness_study_of_native_constraints_has_the_rigid_linkage_as_its_limit(name):
    branch, start = branch_of(name, "native", 1e6)
    for fold, expected in zip(sorted(branch.of_kind("LP"), key=lambda p: p["crank"]), rigid(name), strict=True):
        study = mc.stiffness_study(branch.problem, fold, "equality:*.stiffness", bounds=(1e4, 1e8))
        assert study.locus.status == "at bound"
        assert study.limit == pytest.approx(expected[1], rel=1e-7)
        k, deviation = study.locus["equality:*.stiffness"], study.locus["M"] - expected[1]
        stiff = (k > 3e5) & (k < 1e7)
        rate = (k * deviation)[stiff]
        assert stiff.sum() > 3
        np.testing.assert_allclose(rate, rate.mean(), rtol=0.02)


@pytest.mark.slow
def test_a_stiffness_study_names_the_stiffness_from_which_on_the_fold_is_rigid():
    branch, _ = branch_of("four_bar", "native", 1e6)
    fold = max(branch.of_kind("LP"), key=lambda p: p["M"])
    study = mc.stiffness_study(branch.problem, fold, "equality:C.stiffness", tol=1e-4)
    # M - M_rigid = c / K, from the rigid linkage and the equations written by hand
    errors = by_hand("four_bar", 1e6)[:, 1] - rigid("four_bar")[:, 1]
    k = 1e6 * errors[np.argmax(rigid("four_bar")[:, 1])] / (1e-4 * fold["M"])
    assert study.converged_from == pytest.approx(k, rel=0.02)
    assert "equality:C.stiffness = " in str(study) and "N/m on" in str(study)


# -- the other kinds of equality -------------------------------------------------------------------------------------

PENDULUM = """<body name="{name}" pos="{x} 0 0"><joint name="{name}" axis="0 -1 0" damping="0.1" stiffness="{spring}"/>
  <inertial pos="0 0 {length}" mass="{mass}" diaginertia="0.01 0.01 0.01"/><site name="{name}_tip" pos="0 0 {length}"/>
  {inside}</body>"""


def model_of(bodies, equality, rest=""):
    return f"""<mujoco><compiler angle="radian"/><option gravity="0 0 -{GRAVITY}"><flag contact="disable"/></option>
      <statistic extent="1"/><worldbody>{bodies}</worldbody>{rest}<equality>{equality}</equality>
      <actuator><general name="M" joint="crank"/></actuator></mujoco>"""


def pendulum(name, mass, length, spring, x=0.0, inside=""):
    return PENDULUM.format(name=name, mass=mass, length=length, spring=spring, x=x, inside=inside)


def found_folds(text, stiffness, turns):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness(text, stiffness, ["eq"]))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-200, 200), start={"M": 0.0}, limits={"crank": turns})
    return np.array(sorted((p["crank"], p["M"]) for p in branch.of_kind("LP")))


def check_folds(text, linkage_of, stiffnesses, turns):
    """Compare with equations written by hand, and with the rigid limit at rate 1/K; return the number of folds."""
    closed = rigid_folds(linkage_of(stiffnesses[0]), turns)
    errors = []
    for stiffness in stiffnesses:
        found = found_folds(text, stiffness, turns)
        expected = elastic_folds(linkage_of(stiffness), stiffness, closed[:, 0])
        np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-8)
        errors.append(found - closed)
    rates = np.array(errors[-2:]) * np.array(stiffnesses[-2:])[:, None, None]
    assert np.abs(rates[1] - rates[0]).max() < 2e-3 * np.abs(rates[1]).max()
    return len(closed)


@pytest.mark.slow
def test_pendulums_geared_by_a_joint_equality():
    # the second pendulum turns by 0.8 t + 0.3 t^2 where the crank turns by t
    def gap(q):
        return np.array([q[1] - 0.8 * q[0] - 0.3 * q[0] ** 2])

    def energy(q):
        heights = 1.5 * 0.6 * np.cos(q[0]) + 2.0 * 0.4 * np.cos(q[1])
        return GRAVITY * heights + 6.0 * q[0] ** 2 / 2 + 1.0 * q[1] ** 2 / 2

    linkage = Linkage(2, gap, energy, lambda t: energy(np.array([t, 0.8 * t + 0.3 * t**2])))
    bodies = pendulum("crank", 1.5, 0.6, 6.0) + pendulum("geared", 2.0, 0.4, 1.0, x=2.0)
    gears = '<joint name="eq" joint1="geared" joint2="crank" polycoef="0 0.8 0.3 0 0"/>'
    assert check_folds(model_of(bodies, gears), lambda _: linkage, [1e3, 1e4, 1e5, 1e6], (-2.5, 2.5)) >= 2


@pytest.mark.long
def test_a_weight_on_a_rope_by_a_tendon_equality():
    # a rope from the crank's tip to a weight, over a pulley at (0.9, 1.1): its length stays
    pulley, tip = np.array([0.9, 1.1]), (0.0, 0.6)

    def length(turn):
        x, z = turned(tip, turn) - pulley
        return np.sqrt(x**2 + z**2)

    def gap(q):
        return np.array([length(q[0]) - length(0.0) - q[1]])

    def energy(q):
        return GRAVITY * (1.5 * turned(tip, q[0])[1] + 2.0 * q[1]) + 6.0 * q[0] ** 2 / 2 + 4.0 * q[1] ** 2 / 2

    linkage = Linkage(2, gap, energy, lambda t: energy(np.array([t, length(t) - length(0.0)])))
    bodies = pendulum("crank", 1.5, 0.6, 6.0) + """<site name="pulley" pos="0.9 0 1.1"/>
      <body name="weight" pos="0.9 0 -0.7"><joint name="weight" type="slide" axis="0 0 1" damping="1" stiffness="4"/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.01 0.01 0.01"/><site name="weight"/></body>"""
    ropes = """<tendon><spatial name="to_crank"><site site="crank_tip"/><site site="pulley"/></spatial>
      <spatial name="to_weight"><site site="pulley"/><site site="weight"/></spatial></tendon>"""
    rope = '<tendon name="eq" tendon1="to_crank" tendon2="to_weight" polycoef="0 -1 0 0 0"/>'
    text = model_of(bodies, rope, ropes)
    assert check_folds(text, lambda _: linkage, [1e4, 1e5, 1e6, 1e7], (-2.5, 2.5)) >= 2


@pytest.mark.long
def test_an_arm_welded_to_the_crank():
    # the arm has its place (x, z) and turn; its centre of mass lies off the weld, which therefore bends and turns
    centre, tip = (0.3, 0.2), (0.0, 0.6)
    bodies = pendulum("crank", 1.5, 0.6, 6.0) + """<body name="arm" pos="0 0 0.6"><joint type="slide" axis="1 0 0"/>
      <joint type="slide" axis="0 0 1"/><joint name="arm" axis="0 -1 0"/><site name="arm"/>
      <inertial pos="0.3 0 0.2" mass="2" diaginertia="0.01 0.01 0.01"/></body>"""
    text = model_of(bodies, '<weld name="eq" site1="crank_tip" site2="arm" torquescale="0.5"/>')

    def linkage_of(stiffness):
        # torque = K_rot sin(angle) is the derivative of K_rot (1 - cos(angle)) = K (lever sin(angle / 2))^2 / 2
        _, turning = mc.constraint_stiffness(mc.set_constraint_stiffness(text, stiffness, ["eq"]).compile())
        lever = 2.0 * np.sqrt(turning.stiffness / stiffness)

        def gap(q):
            apart = q[1:3] + np.array(tip) - turned(tip, q[0])
            return np.array([*apart, lever * np.sin((q[3] - q[0]) / 2)])

        def energy(q):
            arm = q[1:3] + np.array(tip) + turned(centre, q[3])
            return GRAVITY * (1.5 * turned(tip, q[0])[1] + 2.0 * arm[1]) + 6.0 * q[0] ** 2 / 2

        return Linkage(4, gap, energy, lambda t: energy(np.array([t, *(turned(tip, t) - np.array(tip)), t])))

    assert check_folds(text, linkage_of, [1e5, 1e6, 1e7, 1e8], (-2.5, 2.5)) >= 2
