"""Two names that are one: an actuator called like its joint, a sensor or a component called like a parameter.

The parameter keeps the bare name; the observable says what it belongs to (`joint:elbow`). Where a result has no column
of the parameter's, the bare name means the observable, as it did before.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import mjcont as mc
from mjcont.studies.study import load_study, run_study

# without gravity both joints obey 3 q = u
ARM = """<mujoco model="arm"><option gravity="0 0 0"/><worldbody>
  <body><joint name="elbow" axis="0 1 0" stiffness="3" damping="1"/>
    <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/></body>
  <body pos="1 0 0"><joint name="wrist" axis="0 1 0" stiffness="3" damping="1"/>
    <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/></body></worldbody>
  <actuator><motor name="elbow" joint="elbow" ctrlrange="-1 1" ctrllimited="true"/>
    <motor name="wrist" joint="wrist" ctrlrange="-1 1" ctrllimited="true"/></actuator>
  <sensor>{sensor}</sensor></mujoco>"""


@pytest.fixture
def arm():
    return mc.Mechanism.from_xml(ARM.format(sensor=""))


def test_a_branch_has_both_columns_with_their_own_units(arm):
    branch = mc.continue_equilibria(arm, "elbow")
    assert [(c.name, c.unit) for c in branch.columns.values()] == [
        ("elbow", ""), ("joint:elbow", "rad"), ("joint:wrist", "rad")
    ]
    np.testing.assert_allclose(branch["joint:elbow"], branch["elbow"] / 3.0, atol=1e-12)
    assert "elbow: -1 .. 1 (bounds -1 .. 1)" in str(branch)


def test_a_point_knows_the_control_by_its_bare_name_and_the_joint_by_its_full_one(arm):
    point = mc.find_equilibrium(arm, {"elbow": 0.5})
    assert point["elbow"] == 0.5
    assert point["joint:elbow"] == pytest.approx(0.5 / 3.0)
    assert f"joint:elbow = {math.degrees(0.5 / 3.0):.7g} deg" in str(point)


def test_csv_files_and_axes_show_each_in_its_unit(arm, tmp_path):
    branch = mc.continue_equilibria(arm, "elbow")
    branch.to_csv(tmp_path / "elbow.csv")
    head, first = (tmp_path / "elbow.csv").read_text().splitlines()[:2]
    assert head.startswith("elbow,joint:elbow [deg],joint:wrist [deg],")
    assert [float(v) for v in first.split(",")[:2]] == pytest.approx([-1.0, math.degrees(-1 / 3)])
    axes = mc.plot(branch, x="elbow", y="joint:elbow")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("elbow", "joint:elbow [deg]")
    assert axes.get_xlim()[1] == pytest.approx(1.0, abs=0.2)


def test_both_columns_survive_a_file(arm, tmp_path):
    branch = mc.continue_equilibria(arm, "elbow")
    loaded = mc.load(branch.save(tmp_path / "elbow.h5"))
    np.testing.assert_array_equal(loaded["joint:elbow"], branch["joint:elbow"])


@pytest.mark.slow
def test_the_bare_name_means_the_joint_where_the_control_does_not_vary(arm):
    branch = mc.continue_equilibria(arm, "wrist", start={"elbow": 0.3}, zeros={"joint:wrist": 0.1})
    np.testing.assert_allclose(branch["elbow"], 0.1, atol=1e-12)
    (zero,) = branch.of_kind("UZ")
    assert zero["wrist"] == pytest.approx(0.3)
    assert len(mc.continue_equilibria(arm, "wrist", zeros={"elbow": 0.5}).of_kind("UZ")) == 0
    limited = mc.continue_equilibria(arm, "elbow", limits={"joint:elbow": (-0.2, 0.2)})
    assert [word for word, _ in limited.ends] == ["stopped", "stopped"]


@pytest.mark.slow
def test_a_region_of_a_search_is_one_of_joints(arm):
    inside = mc.find_equilibria(arm, {"elbow": 0.6}, region={"elbow": (0.1, 0.3), "joint:wrist": (-1, 1)}, starts=8)
    assert len(inside) == 1
    assert len(mc.find_equilibria(arm, {"elbow": 0.6}, region={"elbow": (0.3, 0.7)}, starts=8)) == 0


def test_a_point_is_found_where_the_joint_has_a_value(arm):
    (point,) = mc.continue_equilibria(arm, "elbow").at(**{"joint:elbow": 0.2})
    assert point["elbow"] == pytest.approx(0.6)


def test_a_sensor_called_like_a_control_is_told_apart():
    mechanism = mc.Mechanism.from_xml(ARM.format(sensor='<actuatorfrc name="elbow" actuator="elbow"/>'))
    point = mc.find_equilibrium(mechanism, {"elbow": 0.5})
    assert (point["elbow"], point["sensor:elbow"]) == (0.5, pytest.approx(0.5))
    assert point.units["sensor:elbow"] == "N*m"


def test_a_parameter_declared_with_a_joints_name_leaves_the_joint_its_column(arm):
    arm.declare("lower", "joint:elbow.stiffness")
    assert "joint:elbow" in arm.observables
    free = mc.Mechanism.from_xml(ARM.format(sensor="").replace('motor name="elbow"', 'motor name="M"'))
    free.declare("elbow", "joint:elbow.stiffness")
    point = mc.find_equilibrium(free, {"M": 0.3})
    assert (point["elbow"], point["joint:elbow"]) == (3.0, pytest.approx(0.1))


def test_an_observable_of_ones_own_needs_a_name_of_its_own(arm):
    with pytest.raises(mc.ParameterError, match="observable 'elbow': a parameter has this name"):
        arm.observe("elbow", lambda model, data: 0.0)


def test_a_component_called_like_a_parameter_is_told_apart():
    field = mc.VectorField(lambda u, p: [p["a"] - 2.0 * u[0]], [0.0], {"a": 0.0}, names=["a"])
    branch = mc.continue_equilibria(field, "a", bounds=(0.0, 1.0))
    np.testing.assert_allclose(branch["state:a"], branch["a"] / 2.0, atol=1e-12)


STUDY = """
model = "arm.xml"
[[branch]]
name = "bend"
parameter = "wrist"
start = { elbow = 0.3 }
zeros = { elbow = "10 deg" }
[[searches]]
name = "all"
region = { elbow = ["-90 deg", "90 deg"] }
[[histories]]
name = "swing"
duration = 0.01
columns = ["elbow"]
[[plot]]
file = "bend.png"
branches = ["bend"]
x = "wrist"
y = "elbow"
"""


@pytest.mark.slow
def test_a_study_that_used_the_bare_name_of_a_joint_stays_valid(tmp_path):
    (tmp_path / "arm.xml").write_text(ARM.format(sensor=""))
    (tmp_path / "study.toml").write_text(STUDY)
    results = run_study(load_study(tmp_path / "study.toml"), tmp_path / "out")
    (bend,) = [r for r in results if isinstance(r, mc.Branch)]
    np.testing.assert_allclose(bend["elbow"], 0.1, atol=1e-12)
    assert (tmp_path / "out" / "bend.png").is_file()
