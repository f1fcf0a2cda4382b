"""Models with equalities, limits and contacts, against closed forms."""

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc

STIFFNESS, DAMPING, IMPEDANCE = 1e5, 100.0, 0.9
LOWER, UPPER = -1.0, 0.5


def pendulum_with_stops(gravity: float) -> mc.Mechanism:
    """An inverted pendulum, m = l = k = 1, turned by a moment M between two stops."""
    soft = f'solreflimit="{-STIFFNESS} {-DAMPING}" solimplimit="{IMPEDANCE} {IMPEDANCE} 0.001 0.5 2"'
    return mc.Mechanism.from_xml(
        f"""<mujoco model="stops"><compiler angle="radian"/><option gravity="0 0 {-gravity}"/>
        <worldbody><body><joint name="q" axis="0 1 0" stiffness="1" damping="0.1" range="{LOWER} {UPPER}" {soft}/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-6 1e-6 1e-6"/></body></worldbody>
        <actuator><general name="M" joint="q"/></actuator></mujoco>"""
    )


def moment(q: float, gravity: float) -> float:
    """Return the moment that holds the pendulum at q between the stops."""
    return q - gravity * math.sin(q)


def test_a_stop_engages_where_the_closed_form_has_it():
    branch = mc.continue_equilibria(pendulum_with_stops(0.5), "M", bounds=(-5.0, 5.0))
    lower, upper = branch.of_kind("CO")
    assert (lower.note, upper.note) == ("lower limit of q engages", "upper limit of q engages")
    assert lower["M"] == pytest.approx(moment(LOWER, 0.5), abs=1e-7)
    assert upper["M"] == pytest.approx(moment(UPPER, 0.5), abs=1e-7)
    assert branch.status == "at bound"


def test_a_stop_is_as_stiff_as_mujoco_makes_it():
    mechanism = pendulum_with_stops(0.5)
    (point,) = mc.continue_equilibria(mechanism, "M", bounds=(-5.0, 5.0)).at(M=4.0)
    inverse_weight = float(mechanism.simulation_model().dof_invweight0[0])
    stop = STIFFNESS / ((1.0 - IMPEDANCE) * inverse_weight)
    assert 4.0 - moment(point["q"], 0.5) == pytest.approx(stop * (point["q"] - UPPER), rel=1e-6)


def test_a_branch_that_turns_back_as_a_stop_engages_is_a_non_smooth_fold():
    branch = mc.continue_equilibria(pendulum_with_stops(2.0), "M", bounds=(-3.0, 3.0))
    upper = branch.of_kind("CO")[-1] if branch["q"][-1] > 0 else branch.of_kind("CO")[0]
    assert upper.note == "upper limit of q engages; M turns back: a non-smooth fold"
    assert upper["M"] == pytest.approx(moment(UPPER, 2.0), abs=1e-7)


def test_accelerations_vanish_at_equilibria_on_a_stop():
    mechanism = pendulum_with_stops(0.5)
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-5.0, 5.0))
    on_stop = np.flatnonzero(branch["q"] > UPPER)
    assert len(on_stop) > 3
    for i in on_stop:
        assert abs(mechanism.acceleration(branch.states[i], np.zeros(1), branch.row(i).parameters)[0]) < 1e-6


def test_a_ball_rests_on_the_floor_where_contact_carries_its_weight():
    mechanism = mc.Mechanism.from_xml(
        """<mujoco model="ball"><option gravity="0 0 -9.81"/><worldbody>
        <geom name="floor" type="plane" size="1 1 1"/>
        <body pos="0 0 0.0999"><joint name="z" type="slide" axis="0 0 1"/><geom name="ball" size="0.1" mass="2"/></body>
        </worldbody></mujoco>"""
    )
    point = mc.find_equilibrium(mechanism)
    assert point.stability == "stable"
    assert abs(mechanism.acceleration(point.state, np.zeros(1))[0]) < 1e-6
    assert mechanism.active(point.state, mechanism.values()) == {"contact of floor and ball"}


def test_a_loop_closed_by_connect_bends_like_a_bush_of_its_effective_stiffness():
    bars = """<body><joint name="q1" axis="0 -1 0" stiffness="5" damping="0.1"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.02" mass="1" contype="0" conaffinity="0"/>
      <body pos="0 0 0.5"><joint name="q2" axis="0 -1 0" damping="0.1"/>
        <geom type="capsule" fromto="0 0 0 1 0 0" size="0.02" mass="1" contype="0" conaffinity="0"/>
        <body pos="1 0 0"><joint name="q3" axis="0 -1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02" mass="1" contype="0" conaffinity="0"/>
          <site name="end" pos="0 0 -0.5"/></body></body></body>"""

    def four_bar(closure: str, actuators: str = "") -> str:
        return f"""<mujoco model="four_bar"><worldbody><site name="G" pos="1 0 0"/>{bars}</worldbody>{closure}
        <actuator><general name="M" joint="q1"/>{actuators}</actuator></mujoco>"""

    connect = '<equality><connect site1="end" site2="G" solref="-1e5 -1e3" solimp="0.9 0.9 0.001 0.5 2"/></equality>'
    native = mc.Mechanism.from_xml(four_bar(connect))
    model = native.simulation_model()
    sites = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, n) for n in ("end", "G")]
    weight = sum(float(model.body_invweight0[model.site_bodyid[s], 0]) for s in sites)
    stiffness = 1e5 / ((1.0 - IMPEDANCE) * weight)
    axes = {"x": "1 0 0", "z": "0 0 1"}
    elements = "".join(
        f'<general name="bush_{a}" site="end" refsite="G" gear="{g} 0 0 0" gainprm="0" biastype="affine" '
        f'biasprm="0 {-stiffness!r} -10"/>'
        for a, g in axes.items()
    )
    bushed = mc.Mechanism.from_xml(four_bar("", elements))
    folds = [
        [p["M"] for p in mc.continue_equilibria(m, "M", bounds=(-30.0, 30.0), max_points=300).of_kind("LP")]
        for m in (native, bushed)
    ]
    assert len(folds[0]) >= 2
    assert folds[0] == pytest.approx(folds[1], rel=1e-6)
