"""Observables: sensors, joint positions and functions, and what a mechanism prints of itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import reference
from problems.poses import random_rest
from problems.reference import PARAMETERS

import mjcont as mc

# -- observables ---------------------------------------------------------------------------------------------


def test_height_is_another_name_for_the_z_of_joint_b(overcentre):
    q, p = next(random_rest(1))
    found = overcentre.measure(q[None], overcentre.values(p), ["height", "joint_B[2]"])[0]
    assert found == pytest.approx([q[1] + 0.5 * math.sin(q[2])] * 2, rel=1e-13)
    assert overcentre.observable("height").unit == "m"


def test_every_joint_position_is_an_observable(overcentre):
    q, p = next(random_rest(1))
    names = ["x_1", "z_1", "theta_1", "x_2", "z_2", "theta_2"]
    assert overcentre.measure(q[None], overcentre.values(p), names)[0] == pytest.approx(q, abs=1e-15)
    assert [overcentre.observable(n).unit for n in names] == ["m", "m", "rad", "m", "m", "rad"]


def test_a_sensor_comes_before_the_joint_of_its_name(pendulum_xml):
    sensor = '<framepos name="tip" objtype="site" objname="tip"/><tendonpos name="hip" tendon="twice"/>'
    twice = '<tendon><fixed name="twice"><joint joint="hip" coef="2"/></fixed></tendon>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor, rest=twice))
    assert mechanism.measure(np.array([[0.3]]), mechanism.values(), ["hip"])[0, 0] == pytest.approx(0.6)


def test_a_vector_sensor_gives_one_observable_for_each_component(pendulum_xml):
    sensor = '<framepos name="top" objtype="site" objname="tip"/>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor))
    found = mechanism.measure(np.array([[0.3]]), mechanism.values(), ["top[0]", "top[1]", "top[2]"])[0]
    assert found == pytest.approx([-math.sin(0.3), 0.0, math.cos(0.3)], abs=1e-14)


SENSORS = {
    "jointpos": ('<jointpos name="s" joint="hip"/>', "rad"),
    "framepos": ('<framepos name="s" objtype="site" objname="tip"/>', "m"),
    "fixed tendon over hinges": ('<tendonpos name="s" tendon="turn"/>', "rad"),
    "spatial tendon": ('<tendonpos name="s" tendon="line"/>', "m"),
    "actuator on a hinge": ('<actuatorfrc name="s" actuator="torque"/>', "N*m"),
    "force": ('<force name="s" site="tip"/>', "N"),
    "torque": ('<torque name="s" site="tip"/>', "N*m"),
    "potential energy": ('<e_potential name="s"/>', "J"),
}


@pytest.mark.parametrize(("sensor", "unit"), SENSORS.values(), ids=SENSORS.keys())
def test_the_unit_of_an_observable_follows_the_type_of_its_sensor(pendulum_xml, sensor, unit):
    tendons = """<tendon><fixed name="turn"><joint joint="hip" coef="1"/></fixed>
      <spatial name="line"><site site="wall"/><site site="tip"/></spatial></tendon>"""
    mechanism = mc.Mechanism.from_xml(
        pendulum_xml(
            sensor=sensor,
            rest=tendons,
            world='<site name="wall"/>',
            actuator='<motor name="torque" joint="hip"/>',
        )
    )
    assert next(iter(mechanism.observables.values())).unit == unit


def test_cutoff_and_noise_of_a_sensor_are_ignored(pendulum_xml):
    sensor = '<jointpos name="angle" joint="hip" cutoff="0.2" noise="0.1"/>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor))
    assert mechanism.measure(np.array([[1.5]]), mechanism.values(), ["angle"])[0, 0] == 1.5


def test_a_python_function_is_an_observable(overcentre):
    overcentre.observe("gap_A", lambda model, data: float(np.linalg.norm(data.site("A_1").xpos)), "m")
    q, p = next(random_rest(1))
    found = overcentre.measure(q[None], overcentre.values(p), ["gap_A"])[0, 0]
    assert found == pytest.approx(np.hypot(*reference.gaps(q)[:2]), rel=1e-12)
    assert overcentre.observable("gap_A").unit == "m"


def test_an_observable_added_is_a_column_of_the_branch(overcentre):
    overcentre.observe("lean", lambda model, data: float(data.qpos[2] + data.qpos[5]), "rad")
    branch = mc.continue_equilibria(overcentre, "F", bounds=(45.0, 55.0), start={"F": 50.0})
    assert branch["lean"] == pytest.approx(branch["theta_1"] + branch["theta_2"], abs=1e-15)
    assert branch.unit("lean") == "rad"


def test_an_unknown_observable_is_an_error_with_close_matches(overcentre):
    with pytest.raises(mc.NameLookupError, match=r"observable 'thetta_1'\. Did you mean theta_1"):
        overcentre.observable("thetta_1")


def test_an_alias_of_an_unknown_sensor_is_an_error_with_close_matches(pendulum_xml):
    custom = '<text name="mjcont/lean" data="unit=rad : sensor:angel"/>'
    with pytest.raises(mc.NameLookupError, match=r"unknown sensor 'angel'\. Did you mean angle\?"):
        mc.Mechanism.from_xml(pendulum_xml(custom=custom, sensor='<jointpos name="angle" joint="hip"/>'))


def test_observables_follow_the_parameters(overcentre):
    q, p = next(random_rest(1))
    rows = [overcentre.values({"k_j": 10.0}), overcentre.values({"k_j": 40.0})]
    found = overcentre.measure(np.array([q, q]), rows, ["R_A_x"])[:, 0]
    assert found == pytest.approx([-10.0 * reference.gaps(q)[0], -40.0 * reference.gaps(q)[0]], rel=1e-12)


# -- what is printed -----------------------------------------------------------------------------------------


def test_printing_lists_freedoms_parameters_observables_and_starts(overcentre):
    text = str(overcentre)
    assert "overcentre: 6 degrees of freedom, 5 bush elements" in text
    lines = [line.split() for line in text.splitlines()]
    assert ["k_j", "1000", "N/m", "1", "1e+12", "field", "actuator:bush_*.biasprm[1]*-1"] in lines
    assert ["gravity_angle", "0", "deg", "-180", "180", "field", "gravity"] in lines
    assert ["theta_1", "60", "deg"] in lines
    assert ["height", "0.866025", "m"] in lines
    assert ["qpos0"] in lines


def test_all_parameters_of_the_reference_can_be_varied(overcentre):
    assert set(PARAMETERS) == set(overcentre.parameters)
