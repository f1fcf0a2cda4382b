"""Named parameters: paths, declarations, what they write, and what is said when they do not fit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import reference
from problems.reference import GRAVITY, PARAMETERS

import mjcont as mc

# A hanging chain of two sliders with springs: paths, patterns and indices without geometry in the way.
SLIDERS = """
<mujoco model="sliders">
  <option gravity="0 0 -9.81"/>
  <custom>{declarations}</custom>
  <worldbody>
    <body name="left">
      <joint name="slide_left" type="slide" axis="0 0 1" stiffness="100"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
    </body>
    <body name="right">
      <joint name="slide_right" type="slide" axis="0 0 1" stiffness="50"/>
      <inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/>
    </body>
  </worldbody>
  <actuator><motor name="pull" joint="slide_left" ctrlrange="-5 20"/></actuator>
</mujoco>
"""


def sliders(*declarations):
    texts = "".join(f'<text name="mjcont/{name}" data="{data}"/>' for name, data in declarations)
    return mc.Mechanism.from_xml(SLIDERS.format(declarations=texts))


def spring_forces(mechanism, values, position=0.5):
    """Return the forces (2,) at rest with both sliders raised by `position`, weight taken off."""
    x = np.full(2, position)
    return mechanism.residual(x, mechanism.values(values)) + np.array([2.0, 3.0]) * GRAVITY


# -- paths ---------------------------------------------------------------------------------------------------


def test_a_path_sets_one_field_of_one_element():
    found = spring_forces(sliders(), {"joint:slide_left.stiffness": 40.0})
    assert found == pytest.approx([-20.0, -25.0], rel=1e-13)


def test_a_pattern_sets_every_element_that_it_matches():
    mechanism = sliders(("k", "unit=N/m : joint:slide_left.stiffness*2 joint:slide_right.stiffness"))
    mechanism.declare("all", "joint:slide_*.springref", unit="m")
    found = spring_forces(mechanism, {"all": 0.1})
    assert found == pytest.approx([-40.0, -20.0], rel=1e-13)


def test_several_targets_each_have_a_factor():
    mechanism = sliders(("k", "unit=N/m : joint:slide_left.stiffness*2 joint:slide_right.stiffness"))
    assert mechanism.parameter("k").value == 50.0
    assert spring_forces(mechanism, {"k": 10.0}) == pytest.approx([-10.0, -5.0], rel=1e-13)


def test_an_offset_is_added_to_factor_times_value():
    mechanism = sliders(("k", "unit=N/m : joint:slide_left.stiffness*10+20"))
    assert mechanism.parameter("k").value == pytest.approx(8.0)
    assert spring_forces(mechanism, {"k": 3.0})[0] == pytest.approx(-25.0, rel=1e-13)


def test_an_index_picks_one_entry_of_a_vector():
    mechanism = sliders()
    found = mechanism.residual(np.zeros(2), mechanism.values({"option:gravity[2]": -1.0}))
    assert found == pytest.approx([-2.0, -3.0], rel=1e-13)


def test_an_index_left_out_sets_every_entry(overcentre):
    q = overcentre.qpos0 + np.array([0.0, 0.0, 0.0, 0.3, 0.0, 0.0])
    found = overcentre.residual(q, overcentre.values({"tendon:spring.springlength": 0.2}))
    expected = overcentre.residual(q, overcentre.values({"l_us": 0.2}))
    assert np.array_equal(found, expected)


def test_a_control_is_a_parameter_by_the_name_of_its_actuator():
    assert spring_forces(sliders(), {"pull": 7.0}, 0.0) == pytest.approx([7.0, 0.0], abs=1e-13)


def test_a_declared_control_takes_unit_bounds_and_factor():
    mechanism = sliders(("lift", "unit=kN bounds=0,0.02 : control:pull*1000"))
    lift = mechanism.parameter("lift")
    assert (lift.unit, lift.bounds) == ("kN", (0.0, 0.02))
    assert spring_forces(mechanism, {"lift": 0.004}, 0.0)[0] == pytest.approx(4.0, abs=1e-13)


def test_a_control_with_an_offset_starts_where_the_control_is_zero():
    mechanism = sliders(("lift", "unit=N : control:pull*2+5"))
    assert mechanism.parameter("lift").value == -2.5
    assert spring_forces(mechanism, {}, 0.0)[0] == pytest.approx(0.0, abs=1e-13)
    assert spring_forces(mechanism, {"lift": 1.0}, 0.0)[0] == pytest.approx(7.0, abs=1e-13)


def test_bush_actuators_are_no_controls(overcentre):
    assert not any(name.startswith("bush_") for name in overcentre.parameters)
    assert overcentre.parameter("F").kind == "control"


def test_unit_and_bounds_come_from_the_declaration(overcentre):
    assert overcentre.parameter("k_j").unit == "N/m"
    assert overcentre.parameter("k_j").bounds == (1.0, 1e12)


@pytest.mark.parametrize(
    ("value", "bounds"), [(50.0, (5.0, 500.0)), (0.0, (-1.0, 1.0)), (-2.0, (-20.0, -0.2))]
)
def test_bounds_not_declared_span_a_decade_to_each_side(value, bounds):
    mechanism = mc.Mechanism.from_xml(
        SLIDERS.format(declarations="").replace('stiffness="50"', f'springref="{value}"')
    )
    assert mechanism.parameter("joint:slide_right.springref").bounds == pytest.approx(bounds)


# -- messages ------------------------------------------------------------------------------------------------


def test_a_pattern_that_matches_nothing_is_an_error_that_lists_the_names():
    with pytest.raises(mc.ParameterError, match=r"matches no joint .* names: slide_left, slide_right\."):
        sliders().parameter("joint:hinge_*.stiffness")


def test_targets_that_disagree_are_an_error_that_shows_their_values():
    with pytest.raises(mc.ParameterError, match=r"'k': its targets disagree .* from 50 to 100"):
        sliders(("k", "unit=N/m : joint:slide_*.stiffness"))


def test_an_unknown_attribute_is_an_error_with_close_matches():
    with pytest.raises(mc.NameLookupError, match=r"attribute of a joint 'stifness'\. Did you mean stiffness"):
        sliders().parameter("joint:slide_left.stifness")


@pytest.mark.parametrize("attribute", ["type", "dofadr", "bodyid"])
def test_an_attribute_that_is_no_real_number_is_unknown(attribute):
    with pytest.raises(mc.NameLookupError, match=rf"unknown attribute of a joint '{attribute}'"):
        sliders().parameter(f"joint:slide_left.{attribute}")


def test_an_attribute_left_out_is_an_error_with_an_example():
    with pytest.raises(
        mc.ParameterError, match=r"an attribute is missing, as in joint:slide_left\.stiffness"
    ):
        sliders().parameter("joint:slide_left")


def test_an_unknown_kind_of_object_is_an_error_with_close_matches():
    with pytest.raises(mc.NameLookupError, match=r"object in a target path 'joints'\. Did you mean joint\?"):
        sliders().parameter("joints:slide_left.stiffness")


def test_an_unknown_parameter_is_an_error_with_close_matches_and_all_names(overcentre):
    with pytest.raises(
        mc.NameLookupError, match=r"parameter 'k_spr'\. Did you mean k_sp\b.* Valid: F, c_j, "
    ):
        overcentre.parameter("k_spr")


def test_an_unknown_control_is_an_error_with_the_controls():
    with pytest.raises(mc.NameLookupError, match=r"unknown control 'push'\. .*Valid: pull\."):
        sliders().parameter("control:push")


def test_an_unknown_option_is_an_error_with_close_matches():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'gravty'\. Did you mean gravity\?"):
        sliders().parameter("option:gravty")


@pytest.mark.parametrize("option", ["integrator", "iterations", "disableflags"])
def test_an_option_that_is_no_real_number_is_unknown(option):
    with pytest.raises(mc.NameLookupError, match=f"unknown option '{option}'"):
        sliders().parameter(f"option:{option}")


@pytest.mark.parametrize("path", ["option:gravity[3]", "body:left.inertia[3]"])
def test_an_index_beyond_the_vector_is_an_error(path):
    with pytest.raises(mc.ParameterError, match=r"index 3 is outside 0\.\.2"):
        sliders().parameter(path)


@pytest.mark.parametrize("path", ["joint:slide_left.stiffness[", "joint:.stiffness", "joint:a.stiffness*x"])
def test_a_path_that_cannot_be_read_is_an_error_with_the_grammar(path):
    with pytest.raises(mc.ParameterError, match=r"expected object:name\.attribute\[index\]\*factor\+offset"):
        sliders().parameter(path)


def test_a_factor_of_zero_is_an_error():
    with pytest.raises(mc.ParameterError, match="the factor must not be zero"):
        sliders().parameter("joint:slide_left.stiffness*0")


def test_two_declarations_of_one_name_are_an_error():
    with pytest.raises(mc.ModelError, match="repeated name 'mjcont/k'"):
        sliders(("k", " : joint:slide_left.stiffness"), ("k", " : joint:slide_right.stiffness"))


@pytest.mark.parametrize("name", ["gravity_angle", "load_factor"])
def test_the_names_of_the_gravity_parameters_cannot_be_declared_again(name):
    with pytest.raises(mc.ParameterError, match=f"parameter '{name}' is declared twice"):
        sliders((name, " : joint:slide_left.stiffness"))


@pytest.mark.parametrize("name", ["k", "pull", "load_factor"])
def test_a_name_in_use_cannot_be_declared_from_python(name):
    mechanism = sliders(("k", " : joint:slide_left.stiffness"))
    with pytest.raises(mc.ParameterError, match=f"parameter '{name}' is declared twice"):
        mechanism.declare(name, "joint:slide_right.stiffness")


@pytest.mark.parametrize("bounds", ["1", "1,2,3", "low,high", "2,1", "1,1"])
def test_bounds_that_are_not_two_rising_numbers_are_an_error(bounds):
    with pytest.raises(
        mc.ParameterError, match=rf"bounds must be 'low,high' with low < high, got '{bounds}'"
    ):
        sliders(("k", f"unit=N/m bounds={bounds} : joint:slide_left.stiffness"))


def test_an_unknown_key_in_a_declaration_is_an_error_with_the_keys():
    with pytest.raises(mc.ParameterError, match=r"'k': unknown key 'range'\. Valid: unit, bounds\."):
        sliders(("k", "unit=N/m range=0,1 : joint:slide_left.stiffness"))


def test_a_declaration_without_a_colon_is_an_error_with_the_form():
    with pytest.raises(mc.ParameterError, match=r"'k': expected 'unit=\.\.\. bounds=lo,hi : targets'"):
        sliders(("k", "unit=N/m joint:slide_left.stiffness"))


def test_a_declaration_without_a_target_is_an_error():
    with pytest.raises(mc.ParameterError, match="'k': no target after ':'"):
        sliders(("k", "unit=N/m : "))


def test_a_declaration_with_a_wrong_path_names_the_parameter():
    with pytest.raises(mc.ParameterError, match=r"parameter 'k': unknown attribute of a joint 'stifness'"):
        sliders(("k", "unit=N/m : joint:slide_left.stifness"))


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_value_that_is_not_finite_is_an_error(value):
    with pytest.raises(mc.ParameterError, match="parameter 'pull': the value must be a finite number"):
        sliders().values({"pull": value})


def test_a_value_outside_the_ctrlrange_is_an_error():
    with pytest.raises(mc.BoundsError, match=r"pull = 21 lies outside the actuator's ctrlrange \[-5, 20\]"):
        sliders().values({"pull": 21.0})


def test_bounds_outside_the_ctrlrange_are_an_error():
    with pytest.raises(mc.BoundsError, match=r"bounds \(-6, 20\) of pull leave the actuator's ctrlrange"):
        mc.continue_equilibria(sliders(), "pull", bounds=(-6.0, 20.0))


def test_a_ctrlrange_that_the_model_does_not_clamp_is_no_limit():
    text = SLIDERS.format(declarations="")
    free = text.replace('<option gravity="0 0 -9.81"/>', '<option><flag clampctrl="disable"/></option>')
    assert free != text
    assert spring_forces(mc.Mechanism.from_xml(free), {"pull": 50.0}, 0.0)[0] == pytest.approx(
        50.0, abs=1e-12
    )


# -- mass and gravity ----------------------------------------------------------------------------------------


def test_inertia_scales_along_with_mass(overcentre):
    q = overcentre.qpos0 + 0.02
    values = overcentre.values({"m_1": 3.0})
    found = overcentre.pencil(q, values, np.zeros((6, 6))).mass
    assert found == pytest.approx(reference.mass({**PARAMETERS, "m_1": 3.0}), abs=1e-14)


def test_load_factor_and_gravity_angle_tilt_and_scale_gravity():
    mechanism = mc.Mechanism.from_xml(
        SLIDERS.format(declarations="").replace('axis="0 0 1"', 'axis="1 0 0"', 1)
    )
    n, angle = 2.5, math.radians(20.0)
    values = mechanism.values({"load_factor": n, "gravity_angle": angle})
    found = mechanism.residual(np.zeros(2), values) / [2.0, 3.0]
    expected = [-n * GRAVITY * math.sin(angle), -n * GRAVITY * math.cos(angle)]
    assert found == pytest.approx(expected, rel=1e-13)


def test_the_model_may_state_the_axis_about_which_gravity_turns():
    text = SLIDERS.format(declarations='<text name="mjcont/gravity_axis" data="0 -2 0"/>')
    mechanism = mc.Mechanism.from_xml(text.replace('axis="0 0 1"', 'axis="1 0 0"', 1))
    found = mechanism.residual(np.zeros(2), mechanism.values({"gravity_angle": math.radians(30.0)}))
    assert found == pytest.approx([GRAVITY, -3.0 * GRAVITY * math.cos(math.radians(30.0))], rel=1e-13)


@pytest.mark.parametrize("axis", ["0 0 0", "0 1", "up"])
def test_an_axis_of_gravity_that_is_no_vector_is_an_error(axis):
    with pytest.raises(mc.ParameterError, match="gravity_axis must be three numbers, not all zero"):
        sliders(("gravity_axis", axis))


# -- no memory -----------------------------------------------------------------------------------------------

CASES = [
    {},
    {"k_j": 2e4},
    {"m_1": 3.0, "load_factor": 2.0},
    {"gravity_angle": 0.3},
    {"l_us": 0.2, "F": 30.0, "m_2": 0.7},
    {"c_j": 5.0, "k_sp": 20.0},
    {"actuator:bush_A_x.biasprm[1]*-1": 55.0},
    {"k_j": 300.0, "actuator:bush_A_x.biasprm[1]*-1": 55.0},
    {"body:link_1.inertia[1]": 0.2},
    {"option:gravity[0]": 1.5, "load_factor": 0.5},
]


def test_results_are_the_same_to_the_bit_whatever_was_evaluated_before():
    q, v = reference.assembled_pose(0.9) + 0.03, np.linspace(-1.0, 1.0, 6)

    def evaluate(mechanism, case):
        values = mechanism.values(case)
        return [
            mechanism.acceleration(q, v, case),
            mechanism.linearize(q, values, ["F", "k_j"]).jac,
            mechanism.measure(q[None], values, ["R_A_x", "height"]),
        ]

    fresh = [evaluate(mc.Mechanism.from_xml("overcentre"), case) for case in CASES]
    used = mc.Mechanism.from_xml("overcentre")
    for index in np.random.default_rng(3).integers(0, len(CASES), 60):
        for found, expected in zip(evaluate(used, CASES[index]), fresh[index], strict=True):
            assert np.array_equal(found, expected), CASES[index]


def test_values_left_out_are_those_of_the_model_after_a_run(overcentre):
    overcentre.acceleration(overcentre.qpos0, np.zeros(6), {"k_j": 7.0, "F": 3.0})
    assert overcentre.values() == pytest.approx(PARAMETERS, rel=1e-15)


def test_a_residual_takes_what_is_left_out_from_the_model(overcentre):
    q = overcentre.qpos0 + 0.02
    expected = overcentre.residual(q, overcentre.values({"F": 3.0}))
    overcentre.residual(q, overcentre.values({"k_j": 7.0}))
    assert np.array_equal(overcentre.residual(q, {"F": 3.0}), expected)


def test_a_control_gets_a_unit_and_bounds_under_its_own_name(pendulum_xml):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(actuator='<motor name="drive" joint="hip"/>'))
    assert mechanism.parameters["drive"].unit == ""
    with pytest.raises(mc.ParameterError, match='declared twice: .* with the path "control:drive"'):
        mechanism.declare("drive", "actuator:drive.ctrl", unit="N*m")
    mechanism.declare("drive", "control:drive", unit="N*m", bounds=(-5.0, 5.0))
    branch = mc.continue_equilibria(mechanism, "drive")
    assert branch.unit("drive") == "N*m"
    assert [branch["drive"].min(), branch["drive"].max()] == [-5.0, 5.0]
    with pytest.raises(mc.ParameterError, match="declared twice"):
        mechanism.declare("drive", "control:drive", unit="N")
