"""The stiffness of an equality constraint as a parameter, and what is said of mistakes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.equalities import CASES, CONNECT, SOLVERS, text_of

import mjcont as mc
from mjcont.models.loading import models_folder

# -- as a parameter --------------------------------------------------------------------------------------------------


def measured(mechanism, values, case):
    """Return the stiffness of a mechanism's constraint from its residual."""
    _, position, velocity, lever, *_ = CASES[case]
    moved = mechanism.qpos0.copy()
    moved[position] += 1e-4 / lever
    return -mechanism.residual(moved, mechanism.values(values))[velocity] / lever / 1e-4


@pytest.mark.parametrize("value", [1.0, 2.5e5, 1e10])
@pytest.mark.parametrize("solver", ['solref="-2e4 -100"', 'solref="0.05 0.7"', 'solref="0.001 1"'])
@pytest.mark.parametrize("case", CASES)
def test_the_parameter_is_the_stiffness_in_newtons_per_metre(case, solver, value):
    text = text_of(CASES[case][0], solver + ' solimp="0.8 0.8 0.01"')
    mechanism = mc.Mechanism.from_xml(text)
    parameter = mechanism.parameter("equality:eq.stiffness")
    assert parameter.unit == CASES[case][-1]
    assert parameter.value == pytest.approx(measured(mechanism, {}, case), rel=1e-9)
    assert measured(mechanism, {parameter.name: value}, case) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize("case", ["connect", "two hinges"])
def test_a_damping_ratio_stays_as_the_stiffness_changes(case):
    text = text_of(CASES[case][0], 'solref="0.05 0.7" solimp="0.8 0.8 0.01"')
    mechanism = mc.Mechanism.from_xml(text)
    loaded = mechanism.parameter("equality:eq.stiffness").value
    x, velocity = mechanism.qpos0, CASES[case][2]
    found = []
    for stiffness in (loaded, 4.0 * loaded, 1e8):
        values = mechanism.values({"equality:eq.stiffness": stiffness})
        pencil = mechanism.pencil(x, values, mechanism.linearize(x, values, ()).jac)
        found.append(pencil.damping[velocity, velocity] / math.sqrt(pencil.stiffness[velocity, velocity]))
    assert found == pytest.approx([found[0]] * 3, rel=1e-6)


def test_a_damping_in_the_direct_form_stays_as_it_is():
    mechanism = mc.Mechanism.from_xml("four_bar")
    x = mechanism.qpos0
    dampings = []
    for stiffness in (1e4, 1e8):
        values = mechanism.values({"equality:C.stiffness": stiffness})
        dampings.append(mechanism.pencil(x, values, mechanism.linearize(x, values, ()).jac).damping)
    np.testing.assert_allclose(dampings[0], dampings[1], rtol=1e-9, atol=1e-9)


def test_the_derivative_in_the_stiffness_is_that_of_differences():
    mechanism = mc.Mechanism.from_xml("four_bar")
    name = "equality:C.stiffness"
    mechanism.parameter(name)
    x = mechanism.qpos0 + [0.01, 0.0, -0.02]
    values = mechanism.values({name: 1e5})
    exact = mechanism.linearize(x, values, (name,)).par[:, 0]
    f = [mechanism.residual(x, mechanism.values({name: k})) for k in (0.9e5, 1.1e5)]
    np.testing.assert_allclose(exact, (f[1] - f[0]) / 0.2e5, rtol=1e-9)


def test_factors_and_declarations_in_the_xml_act_on_the_stiffness():
    text = (models_folder() / "four_bar.xml").read_text()
    text = text.replace("</custom>", '<text name="mjcont/soft" data="unit=kN/m : equality:C.stiffness*1e3"/></custom>')
    mechanism = mc.Mechanism.from_xml(text)
    assert mechanism.parameters["soft"].value == pytest.approx(mc.constraint_stiffness(mechanism)[0].stiffness / 1e3)
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=5, start={"soft": 50.0})
    assert "connect C is a spring of 5e+04 N/m at rest" in branch.notes


@pytest.mark.slow
def test_a_file_brings_the_parameter_back(tmp_path):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(1e5, 1e7))
    branch.save(tmp_path / "branch.h5")
    again = mc.load(tmp_path / "branch.h5")
    parameters = branch.row(0).parameters
    np.testing.assert_array_equal(
        again.problem.residual(again.states[0], again.problem.values(parameters)),
        mechanism.residual(branch.states[0], mechanism.values(parameters)),
    )


@pytest.mark.parametrize("stiffness", [1e3, 1e6])
def test_every_closure_can_be_given_one_stiffness(stiffness):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("watt_six_bar", stiffness))
    assert [s.stiffness for s in mc.constraint_stiffness(mechanism)] == pytest.approx([stiffness] * 2, rel=1e-12)
    assert mechanism.parameter("equality:*.stiffness").value == pytest.approx(stiffness)


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
@pytest.mark.parametrize("case", CASES)
def test_a_stiffness_given_to_any_equality_is_constant_and_critically_damped(case, solver):
    text = text_of(CASES[case][0], solver)
    (spring, *_) = mc.constraint_stiffness(mc.set_constraint_stiffness(text, 3e4, ["eq"]).compile())
    assert (spring.stiffness, spring.at(0.01)) == pytest.approx((3e4, 3e4), rel=1e-12)
    d = spring.solimp[0]
    # the manual: damping = 2 sqrt(stiffness) of the direct form is critical
    stiffness, damping = (v * (1 - d) * spring.weight for v in (spring.stiffness, spring.damping))
    assert damping == pytest.approx(2.0 * math.sqrt(stiffness), rel=1e-12)


# -- mistakes --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("equality", "solver", "more", "path", "message"),
    [
        (CONNECT, "", {}, "eq.stiffness", "depends on its gap.*solimp=\"0.9 0.9 0.001\".*set_constraint_stiffness"),
        (CONNECT, 'active="false" solimp="0.9 0.9 0.001"', {}, "eq.stiffness", "'eq' is not an active connect"),
        (CONNECT, 'solimp="0.9 0.9 1"', {"flag": 'diagexact="enable"'}, "eq.stiffness", "diagexact.*remove the flag"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eqq.stiffness", "matches no equality.*names: eq"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eq.stiffnes", "unknown attribute of a equality 'stiffnes'.*stiffness"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eq.stiffness[0]", "equality:NAME.stiffness has no index"),
    ],
)
def test_a_stiffness_that_cannot_be_set_is_an_error_that_says_what_to_do(equality, solver, more, path, message):
    text = text_of(equality, solver, **more)
    with pytest.raises(mc.MjcontError, match=message):
        mc.Mechanism.from_xml(text).parameter(f"equality:{path}")


def test_stiffnesses_that_differ_need_to_be_made_equal_first():
    with pytest.raises(mc.ParameterError, match="its targets disagree"):
        mc.Mechanism.from_xml("watt_six_bar").parameter("equality:*.stiffness")


def test_a_stiffness_must_be_positive():
    mechanism = mc.Mechanism.from_xml("four_bar")
    with pytest.raises(mc.BoundsError, match=r"equality:C.stiffness = -1 lies outside the positive numbers"):
        mechanism.values({"equality:C.stiffness": -1.0})
    with pytest.raises(mc.BoundsError, match=r"leave the positive numbers.*narrow the bounds"):
        mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(-1.0, 1e6))


@pytest.mark.parametrize(
    ("model", "arguments", "message"),
    [
        ("four_bar", {"stiffness": -1.0}, "must be a positive number"),
        ("four_bar", {"equalities": ["D"]}, "unknown equality 'D'. Valid: C."),
        ("overcentre", {}, "nothing to give stiffness"),
    ],
)
def test_a_mistake_in_giving_stiffness_is_an_error_that_names_the_choices(model, arguments, message):
    with pytest.raises(mc.MjcontError, match=message):
        mc.set_constraint_stiffness(model, **arguments)
