"""Models with equalities, limits and contacts, against closed forms."""

import math

import mujoco
import numpy as np
import pytest
from problems.marks import long
from problems.stops import DAMPING, IMPEDANCE, LOWER, STIFFNESS, UPPER, pendulum_with_stops

import mjcont as mc


def moment(q: float, gravity: float) -> float:
    """Return the moment that holds the pendulum at q between the stops."""
    return q - gravity * math.sin(q)


@pytest.mark.slow
def test_a_stop_engages_where_the_closed_form_has_it():
    branch = mc.continue_equilibria(pendulum_with_stops(0.5), "M", bounds=(-5.0, 5.0))
    lower, upper = branch.of_kind("CO")
    assert (lower.note, upper.note) == ("lower limit of q engages", "upper limit of q engages")
    assert lower["M"] == pytest.approx(moment(LOWER, 0.5), abs=1e-7)
    assert upper["M"] == pytest.approx(moment(UPPER, 0.5), abs=1e-7)
    assert branch.status == "at bound"


@pytest.mark.slow
def test_a_stop_is_as_stiff_as_mujoco_makes_it():
    mechanism = pendulum_with_stops(0.5)
    (point,) = mc.continue_equilibria(mechanism, "M", bounds=(-5.0, 5.0)).at(M=4.0)
    inverse_weight = float(mechanism.simulation_model().dof_invweight0[0])
    stop = STIFFNESS / ((1.0 - IMPEDANCE) * inverse_weight)
    assert 4.0 - moment(point["q"], 0.5) == pytest.approx(stop * (point["q"] - UPPER), rel=1e-6)


@pytest.mark.slow
def test_a_branch_that_turns_back_as_a_stop_engages_is_a_non_smooth_fold():
    branch = mc.continue_equilibria(pendulum_with_stops(2.0), "M", bounds=(-3.0, 3.0))
    upper = branch.of_kind("CO")[-1] if branch["q"][-1] > 0 else branch.of_kind("CO")[0]
    assert upper.note == "upper limit of q engages; M turns back: a non-smooth fold"
    assert upper["M"] == pytest.approx(moment(UPPER, 2.0), abs=1e-7)


@pytest.mark.slow
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


@pytest.mark.slow
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


STIFF = 'condim="1" solref="-1e6 -2000" solimp="0.9 0.9 0.001 0.5 2"'


@pytest.fixture(scope="module", params=['type="plane" size="1 1 1"', long('type="box" size="1 1 0.1" pos="0 0 -0.1"')])
def tumbling(request):
    """A box of 2 kg and half-width 0.1 m on a floor, turned by a moment M."""
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco model="box"><option gravity="0 0 -9.81"/><worldbody><geom name="floor" {request.param}/>
        <body pos="0 0 0.1"><joint name="x" type="slide" axis="1 0 0" stiffness="50" damping="5"/>
        <joint name="z" type="slide" axis="0 0 1" damping="5"/><joint name="q" axis="0 1 0" damping="1"/>
        <geom name="box" type="box" size="0.1 0.1 0.1" mass="2"/></body></worldbody>
        <contact><pair geom1="box" geom2="floor" {STIFF}/></contact>
        <actuator><general name="M" joint="q"/></actuator></mujoco>"""
    )
    return mc.continue_equilibria(mechanism, "M", bounds=(-3.0, 3.0))


def test_a_box_tips_where_two_of_its_four_contacts_release(tumbling):
    tips = tumbling.of_kind("CO")
    assert len(tips) >= 4
    for p in tips:
        assert abs(p["M"]) == pytest.approx(2.0 * 9.81 * 0.1, rel=1e-5)
        assert p.note.startswith("contact 3 of floor and box ")
        assert p.note.endswith("M turns back: a non-smooth fold")


def test_a_tipping_box_balances_on_its_edge_and_falls(tumbling):
    tilts = np.mod(tumbling["q"], math.pi / 2.0)
    on_edge = np.flatnonzero((tilts > 0.01) & (tilts < math.pi / 2.0 - 0.01))
    assert len(on_edge) > 30
    for i in on_edge:
        lever = 0.1 * (math.cos(tilts[i]) - math.sin(tilts[i]))
        assert tumbling["M"][i] == pytest.approx(2.0 * 9.81 * lever, abs=1e-4)
        assert tumbling.row(i).stability == "unstable"


def test_a_ball_that_is_lifted_leaves_the_floor_when_its_weight_is_carried():
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco model="ball"><option gravity="0 0 -9.81"/><worldbody>
        <geom name="floor" type="plane" size="1 1 1"/><body pos="0 0 0.1">
        <joint name="z" type="slide" axis="0 0 1" damping="5" stiffness="100" springref="0"/>
        <geom name="ball" size="0.1" mass="2"/></body></worldbody>
        <contact><pair geom1="ball" geom2="floor" {STIFF}/></contact>
        <actuator><general name="F" joint="z"/></actuator></mujoco>"""
    )
    branch = mc.continue_equilibria(mechanism, "F", bounds=(0.0, 40.0))
    (corner,) = branch.of_kind("CO")
    assert corner.note == "contact of floor and ball releases"
    assert corner["F"] == pytest.approx(2.0 * 9.81, abs=1e-6)
    free = branch["F"] > 20.0
    assert branch["z"][free] == pytest.approx((branch["F"][free] - 2.0 * 9.81) / 100.0, abs=1e-8)


def test_a_ball_on_the_floor_moves_as_its_contact_has_it():
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco model="ball"><option gravity="0 0 -9.81"/><worldbody>
        <geom name="floor" type="plane" size="1 1 1"/><body pos="0 0 0.1">
        <joint name="z" type="slide" axis="0 0 1"/><geom name="ball" size="0.1" mass="2"/></body></worldbody>
        <contact><pair geom1="ball" geom2="floor" {STIFF}/></contact></mujoco>"""
    )
    point = mc.find_equilibrium(mechanism)
    # m a = -(a + b v / d + k r / d) / R with 1 / R = d / ((1 - d) A): a velocity of 1 m/s would lift the ball
    weight = float(mechanism.simulation_model().body_invweight0[1, 0])
    ratio = IMPEDANCE / ((1.0 - IMPEDANCE) * weight * 2.0)
    expected = np.roots([1.0 + ratio, ratio * 2000.0 / IMPEDANCE, ratio * 1e6 / IMPEDANCE])
    assert np.sort(point.eigenvalues.real) == pytest.approx(np.sort(expected), rel=1e-4)


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "discrete"])
def test_the_load_on_a_stop_is_read_as_it_is_at_rest_whatever_the_integrator(integrator):
    soft = f'solreflimit="{-STIFFNESS} {-DAMPING}" solimplimit="{IMPEDANCE} {IMPEDANCE} 0.001 0.5 2"'
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco model="stop"><compiler angle="radian"/>
        <option gravity="0 0 0" integrator="{integrator}" timestep="0.01"/>
        <worldbody><body><joint name="q" axis="0 1 0" stiffness="50" damping="5" range="-1 {UPPER}" {soft}/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-6 1e-6 1e-6"/></body></worldbody>
        <actuator><general name="M" joint="q"/></actuator>
        <sensor><jointlimitfrc name="load" joint="q"/></sensor></mujoco>"""
    )
    (point,) = mc.continue_equilibria(mechanism, "M", bounds=(0.0, 100.0)).at(M=80.0)
    assert point["load"] == pytest.approx(80.0 - 50.0 * point["q"], rel=1e-7)
    assert point["load"] > 50.0
