"""Numbers with which nothing can be computed are refused, by the name of what has them, where they are known first."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc

ROD = """<mujoco><option gravity="0 0 -9.81"/><worldbody><body name="rod">
<joint name="q" axis="0 1 0" stiffness="2" damping=".1" springref="0"/>
<geom name="tip" size=".1" pos=".3 0 0" mass="1"/></body></worldbody>
<actuator><motor name="M" joint="q" gear="1"/></actuator><keyframe><key name="up" qpos="0.5"/></keyframe></mujoco>"""

WRONG = {
    'stiffness="2"': ['stiffness="{}"', "stiffness.* of joint 'q' is {}"],
    'damping=".1"': ['damping="{}"', "damping of joint 'q' is {}"],
    'springref="0"': ['springref="{}"', "spring of joint 'q' is {}"],
    'gravity="0 0 -9.81"': ['gravity="0 0 {}"', r"gravity\[2\] is {}"],
    'gear="1"': ['gear="{}"', r"gear\[0\] of actuator 'M' is {}"],
    'qpos="0.5"': ['qpos="{}"', r"qpos.* of key 'up' is {}"],
}


@pytest.mark.parametrize("number", ["nan", "inf"])
@pytest.mark.parametrize("where", WRONG)
def test_a_model_with_such_a_number_is_refused_by_its_element(where: str, number: str) -> None:
    written, message = WRONG[where]
    with pytest.raises(mc.ModelError, match=message.format(number)):
        mc.Mechanism.from_xml(ROD.replace(where, written.format(number)))


@pytest.mark.parametrize(
    ("mass", "value"), [('mass="inf"', "inf"), ('mass="1e300"', r"\d.*e.\d+")]
)
def test_a_body_of_infinite_mass_is_refused(mass: str, value: str) -> None:
    with pytest.raises(mc.ModelError, match=f"of body 'rod' is {value}: it must be a number within"):
        mc.Mechanism.from_xml(ROD.replace('mass="1"', mass))


def test_a_compiled_model_in_which_a_joint_moves_nothing_is_refused():
    model = mujoco.MjModel.from_xml_string(ROD)
    model.body_mass[:] = 0.0
    model.body_inertia[:] = 0.0
    with pytest.raises(mc.ModelError, match="joint 'q' moves nothing that has mass or inertia"):
        mc.Mechanism.from_model(model)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e300])
@pytest.mark.parametrize("name", ["M", "load_factor", "joint:q.stiffness", "body:rod.mass"])
def test_a_value_that_is_no_number_is_refused_by_its_parameter(name: str, value: float) -> None:
    mechanism = mc.Mechanism.from_xml(ROD)

    def branch(mechanism: mc.Mechanism, start: dict[str, float]) -> mc.Branch:
        return mc.continue_equilibria(mechanism, "gravity_angle", start=start)

    for verb in (mc.find_equilibrium, mc.find_equilibria, branch):
        with pytest.raises(mc.MjcontError, match=name):
            verb(mechanism, {name: value})


@pytest.mark.parametrize("bounds", [(math.nan, 1.0), (0.0, math.inf), (-1e300, 1e300)])
@pytest.mark.parametrize("problem", ["mechanism", "field"])
def test_bounds_that_are_no_numbers_are_refused(problem: str, bounds: tuple[float, float]) -> None:
    field = mc.VectorField(lambda u, p: [p["a"] - u[0]], [0.0], {"a": 0.5})
    what, name = (mc.Mechanism.from_xml(ROD), "load_factor") if problem == "mechanism" else (field, "a")
    with pytest.raises(mc.BoundsError, match=f"bounds of {name} must be finite with low < high"):
        mc.continue_equilibria(what, name, bounds=bounds)


def test_declared_bounds_that_are_infinite_are_refused_where_they_are_used():
    mechanism = mc.Mechanism.from_xml(ROD)
    mechanism.declare("k", "joint:q.stiffness", bounds=(1.0, math.inf))
    with pytest.raises(mc.BoundsError, match="bounds of k must be finite"):
        mc.continue_equilibria(mechanism, "k")


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e300])
def test_a_start_that_is_no_number_is_refused_by_its_coordinate(value: float) -> None:
    field = mc.VectorField(lambda u, p: [p["a"] - u[0]], [0.0], {"a": 0.5}, names=["height"])
    with pytest.raises(mc.ParameterError, match="state: q must be a finite number"):
        mc.continue_equilibria(mc.Mechanism.from_xml(ROD), "M", bounds=(-1, 1), state=[value])
    with pytest.raises(mc.ParameterError, match="state: height must be a finite number"):
        mc.continue_equilibria(field, "a", bounds=(0, 1), state=[value])


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e300])
def test_a_vector_field_whose_parameter_is_no_number_is_refused(value: float) -> None:
    with pytest.raises(mc.ParameterError, match="parameter 'a': the value must be a finite number"):
        mc.VectorField(lambda u, p: [p["a"] - u[0]], [0.0], {"a": value})


@pytest.mark.parametrize("path", ["body:rod.mass", "body:rod.inertia[0]", "joint:q.armature"])
def test_masses_and_inertias_stay_positive(path: str) -> None:
    mechanism = mc.Mechanism.from_xml(ROD)
    why = "the range .* in which masses and inertias are positive"
    with pytest.raises(mc.BoundsError, match=rf"bounds \(-1, 1\) .* leave {why}"):
        mc.continue_equilibria(mechanism, path, bounds=(-1, 1))
    with pytest.raises(mc.BoundsError, match=f"= -1 lies outside {why}"):
        mc.find_equilibrium(mechanism, {path: -1.0})


def test_a_range_of_masses_that_ends_at_zero_is_refused():
    with pytest.raises(mc.BoundsError, match=r"bounds \(0, 1\) of body:rod.mass leave .* masses .* positive"):
        mc.continue_equilibria(mc.Mechanism.from_xml(ROD), "body:rod.mass", bounds=(0, 1))


def test_a_mass_down_to_almost_nothing_is_followed():
    # weight m g cos(angle) at 0.3 m against the spring: k q = 0.3 m g cos(q)
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(ROD), "body:rod.mass", bounds=(1e-9, 1.0))
    assert branch.status == "at bound"
    q, mass = branch["q"], branch["body:rod.mass"]
    np.testing.assert_allclose(2.0 * q, 0.3 * 9.81 * mass * np.cos(q), atol=1e-12)


@pytest.mark.slow
def test_a_spec_that_compiles_to_such_a_number_ends_the_curve():
    mechanism = mc.Mechanism.from_xml(ROD)

    def law(spec: mujoco.MjSpec, value: float) -> None:
        spec.joint("q").stiffness[0] = 2.0 / value if value > 0.5 else math.inf

    mechanism.declare("softness", bounds=(0.1, 2.0), function=law, value=1.0)
    branch = mc.continue_equilibria(mechanism, "softness")
    assert branch.status == "step too small"
    assert "stiffness" in branch.message
    assert branch["softness"].min() == pytest.approx(0.5, abs=3e-3)  # derivatives look 2e-3 ahead
