"""Parameters that edit the spec: held against closed forms, and against fields where a field does the same."""

import math

import numpy as np
import pytest
from problems.rods import (
    DAMPING,
    DECLARED,
    DENSITY,
    GRAVITY,
    LENGTH,
    RADIUS,
    REST,
    ROD,
    STIFFNESS,
    inertia,
    rod,
    set_length,
    weight_moment,
    with_function,
)

import mjcont as mc


def fold_angle():
    """tan(theta) = theta - rest, on the far side of the spring's rest: the fold, whatever the rod weighs."""
    theta = -0.3
    for _ in range(50):
        theta -= (math.tan(theta) - theta + REST) / math.tan(theta) ** 2
    return theta


BOTH = pytest.mark.parametrize("make", [rod, with_function], ids=["paths", "function"])


# -- mass, inertia, forces -----------------------------------------------------------------------------------


@BOTH
@pytest.mark.parametrize("length", [0.15, LENGTH, 0.5])
def test_a_length_changes_force_and_inertia_as_the_closed_form_does(make, length):
    mechanism = make()
    values, theta = mechanism.values({"length": length, "load_factor": 2.0}), 0.4
    torque = 2.0 * weight_moment(length) * math.sin(theta) - STIFFNESS * (theta - REST)
    assert mechanism.residual(np.array([theta]), values) == pytest.approx([torque], rel=1e-13)
    pencil = mechanism.pencil(np.array([theta]), values, np.zeros((1, 1)))
    assert pencil.mass[0, 0] == pytest.approx(inertia(length), rel=1e-13)
    assert pencil.damping[0, 0] == pytest.approx(DAMPING, rel=1e-12)


@BOTH
def test_the_derivative_in_a_length_is_that_of_the_closed_form(make):
    mechanism = make()
    theta, length = 0.4, 0.35
    found = mechanism.linearize(np.array([theta]), mechanism.values({"length": length}), ["length"])
    expected = 2.0 * weight_moment(length) / length * math.sin(theta)
    assert found.par[0, 0] == pytest.approx(expected, rel=1e-10)


def test_two_parameters_of_the_spec_act_together():
    mechanism = with_function()
    mechanism.declare("radius", "spec:geom:rod.size[0]", unit="m")
    values = mechanism.values({"length": 0.5, "radius": 0.03})
    found = mechanism.pencil(np.zeros(1), values, np.zeros((1, 1))).mass[0, 0]
    assert found == pytest.approx(inertia(0.5, 0.03), rel=1e-13)


def test_other_parameters_are_written_on_top_of_the_geometry():
    mechanism = rod()
    mechanism.declare("k", "joint:hip.stiffness")
    values = mechanism.values({"length": 0.5, "k": 7.0, "torque": 0.25, "gravity_angle": 0.3})
    expected = 0.25 + weight_moment(0.5) * math.sin(0.4 - 0.3) - 7.0 * (0.4 - REST)
    assert mechanism.residual(np.array([0.4]), values) == pytest.approx([expected], rel=1e-12)


def test_a_mass_given_by_its_field_overrides_that_of_the_geometry():
    mechanism = rod()
    mechanism.declare("m", "body:rod.mass")
    values = mechanism.values({"length": 0.5, "m": 2.0})
    found = mechanism.residual(np.array([0.4]), values)[0]
    expected = 2.0 * GRAVITY * 0.25 * math.sin(0.4) - STIFFNESS * (0.4 - REST)
    assert found == pytest.approx(expected, rel=1e-12)


def test_observables_follow_the_geometry():
    mechanism = rod()
    found = mechanism.measure(np.array([[math.pi / 2]]), mechanism.values({"length": 0.5}), ["tip[0]"])
    assert found[0, 0] == pytest.approx(0.5, rel=1e-14)


def test_angles_of_the_spec_are_radians_whatever_the_xml_says():
    mechanism = rod("")
    parameter = mechanism.declare("rest", "spec:joint:hip.springref", unit="rad")
    assert parameter.value == pytest.approx(REST, rel=1e-14)
    found = mechanism.residual(np.zeros(1), mechanism.values({"rest": 0.2}))
    assert found == pytest.approx([STIFFNESS * 0.2], rel=1e-13)


def test_factor_offset_and_pattern_are_those_of_field_paths():
    mechanism = rod("")
    parameter = mechanism.declare("half", "spec:geom:r*.fromto[5]*2+0.1", unit="m")
    assert parameter.value == pytest.approx(0.1, rel=1e-14)
    found = mechanism.pencil(np.zeros(1), mechanism.values({"half": 0.2}), np.zeros((1, 1))).mass[0, 0]
    assert found == pytest.approx(inertia(0.5), rel=1e-13)


@pytest.mark.slow
def test_results_are_the_same_to_the_bit_whatever_was_evaluated_before():
    cases = [{}, {"length": 0.5}, {"length": 0.2, "k": 3.0}, {"k": 3.0}, {"m": 2.0}, {"m": 2.0, "length": 0.45}]

    def make():
        mechanism = rod()
        mechanism.declare("k", "joint:hip.stiffness")
        mechanism.declare("m", "body:rod.mass")
        return mechanism

    def evaluate(mechanism, case):
        values = mechanism.values(case)
        return mechanism.linearize(np.array([0.4]), values, ["length", "torque"]), mechanism.measure(
            np.array([[0.4]]), values
        )

    fresh, used = [evaluate(make(), case) for case in cases], make()
    for index in np.random.default_rng(5).integers(0, len(cases), 40):
        line, measured = evaluate(used, cases[index])
        expected, expected_measured = fresh[index]
        assert np.array_equal(line.f, expected.f) and np.array_equal(line.jac, expected.jac)
        assert np.array_equal(line.par, expected.par)
        assert np.array_equal(measured, expected_measured)


def test_a_free_body_may_lose_its_symmetry():
    # a body with its centre of mass at its frame has a simpler mass matrix, whose layout must not stay
    text = """<mujoco><worldbody><body name="b"><joint type="slide" axis="1 0 0" stiffness="1"/>
      <joint type="slide" axis="0 0 1" stiffness="1"/><joint type="hinge" axis="0 1 0" stiffness="1"/>
      <geom name="g" type="capsule" size="0.02" fromto="-0.2 0 0 0.2 0 0"/></body></worldbody></mujoco>"""
    changed = mc.Mechanism.from_xml(text)
    values = changed.values({"load_factor": 1.0})
    changed.residual(changed.qpos0, values)
    end = changed.parameter("spec:geom:g.fromto[3]")
    fresh = mc.Mechanism.from_xml(text.replace("0.2 0 0\"", "0.35 0 0\""))
    q = np.array([0.1, 0.2, 0.3])
    found = changed.pencil(q, changed.values({end.name: 0.35}), np.zeros((3, 3))).mass
    assert found == pytest.approx(fresh.pencil(q, fresh.values(), np.zeros((3, 3))).mass, abs=1e-14)
    assert abs(found[2, 1]) > 0.01


def test_a_model_that_rests_on_a_stop_is_recompiled_as_well():
    through_spec, through_field = mc.Mechanism.from_xml("toggle_clamp"), mc.Mechanism.from_xml("toggle_clamp")
    through_spec.declare("C", "spec:site:C.pos[0]", unit="m")
    through_field.declare("C", "site:C.pos[0]", unit="m")
    for theta in (0.0524, 0.0):
        values = through_spec.values({"C": 0.301, "M": 3.0})
        expected = through_field.residual(np.array([theta]), values)
        assert through_spec.residual(np.array([theta]), values) == pytest.approx(expected, rel=1e-10)


@pytest.mark.slow
def test_a_floating_body_computed_before_keeps_its_branch_when_a_geometry_is_declared():
    text = """<mujoco><option gravity="0 0 0"/><worldbody><body name="hull"><freejoint/><geom name="hull" size="0.1"/>
      <body name="arm"><joint name="j" axis="0 1 0" stiffness="1"/>
      <geom name="arm" type="capsule" size="0.02" fromto="0 0 0 0.3 0 0"/></body></body></worldbody>
      <actuator><motor name="T" joint="j"/></actuator></mujoco>"""
    mechanism = mc.Mechanism.from_xml(text)
    branch = mc.continue_equilibria(mechanism, "T", bounds=(-0.5, 0.5))
    mechanism.declare("length", "spec:geom:arm.fromto[3]", unit="m", bounds=(0.2, 0.5))
    assert branch.problem.held
    start = branch.at(T=0.2)[0]
    assert start["j"] == pytest.approx(0.2, rel=1e-9)
    lengths = mc.continue_equilibria(branch.problem, "length", start=start)
    assert lengths["j"] == pytest.approx(0.2, rel=1e-9)  # no gravity: the arm's length moves nothing
    assert lengths["length"].max() == pytest.approx(0.5)


# -- curves --------------------------------------------------------------------------------------------------


@BOTH
def test_the_pitchfork_load_of_an_upright_rod_is_that_of_its_length(make):
    text = ROD.format(declarations=DECLARED if make is rod else "", rest=0)
    mechanism = mc.Mechanism.from_xml(text)
    if make is with_function:
        mechanism.declare("length", function=set_length, value=LENGTH)
    branch = mc.continue_equilibria(mechanism, "load_factor", bounds=(0, 10), start={"length": 0.4, "load_factor": 0})
    assert branch.point("BP1")["load_factor"] == pytest.approx(STIFFNESS / weight_moment(0.4), rel=1e-9)


@pytest.mark.slow
def test_the_pitchfork_length_of_an_upright_rod_is_where_its_spring_gives_way():
    branch = mc.continue_equilibria(rod(rest=0.0), "length", bounds=(0.1, 0.6), start={"length": 0.1})
    critical = math.sqrt(2.0 * STIFFNESS / (DENSITY * math.pi * RADIUS**2 * GRAVITY))
    assert branch.point("BP1")["length"] == pytest.approx(critical, rel=1e-9)


@pytest.mark.slow
@BOTH
def test_a_fold_followed_in_load_and_length_keeps_load_times_length_squared(make):
    mechanism = make()
    branch = mc.continue_equilibria(
        mechanism, "load_factor", bounds=(0, 10), start={"load_factor": 9.0}, state=[-2.5]
    )
    fold = branch.point("LP1")
    expected = STIFFNESS / (weight_moment(LENGTH) * math.cos(fold_angle()))
    assert fold["load_factor"] == pytest.approx(expected, rel=1e-9)
    locus = mc.continue_special(fold, "length", bounds=(0.2, 0.5))
    assert locus["length"].min() == pytest.approx(0.2) and locus["length"].max() == pytest.approx(0.5)
    assert locus["load_factor"] * locus["length"] ** 2 == pytest.approx(expected * LENGTH**2, rel=1e-8)
    assert locus["hip"] == pytest.approx(fold_angle(), abs=1e-7)


@pytest.mark.slow
def test_eigenvalues_are_those_of_the_recompiled_inertia():
    branch = mc.continue_equilibria(rod(), "length", bounds=(0.1, 0.6), start={"length": 0.1})
    for i in range(0, len(branch), 7):
        length, theta = branch["length"][i], branch["hip"][i]
        stiffness = STIFFNESS - weight_moment(length) * math.cos(theta)
        expected = np.roots([inertia(length), DAMPING, stiffness])
        assert sorted(branch.eigenvalues[i], key=lambda s: (s.real, s.imag)) == pytest.approx(
            sorted(expected, key=lambda s: (s.real, s.imag)), rel=1e-7
        )


@pytest.mark.long
def test_a_branch_in_a_length_of_the_overcentre_agrees_with_the_field_of_its_site():
    cosine, sine = 0.5, math.sqrt(3.0) / 2.0  # the frame of link 1 is turned, a site's field is in the body's
    through_spec, through_field = mc.Mechanism.from_xml("overcentre"), mc.Mechanism.from_xml("overcentre")
    through_spec.declare("B", "spec:site:B_1.pos[0]", unit="m", bounds=(0.3, 0.7))
    paths = (f"site:B_1.pos[0]*{cosine!r}", f"site:B_1.pos[2]*{sine!r}")
    through_field.declare("B", *paths, unit="m", bounds=(0.3, 0.7))
    points = []
    for mechanism in (through_spec, through_field):
        branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0, "B": 0.55})
        locus = mc.continue_special(branch.point("LP1"), "B", bounds=(0.45, 0.6))
        lengths = mc.continue_equilibria(mechanism, "B", bounds=(0.3, 0.7), start={"F": 10.0})
        points.append([*branch.special_points, locus.row(0), *lengths.at(B=0.35), *lengths.at(B=0.62)])
    pairs = list(zip(*points, strict=True))
    assert len(pairs) >= 5
    for one, other in pairs:
        assert one.state == pytest.approx(other.state, abs=1e-9)
        assert one["F"] == pytest.approx(other["F"], abs=1e-9 * 50.0)
        assert one["B"] == pytest.approx(other["B"], abs=1e-9)
        assert one.stability == other.stability


@pytest.mark.slow
def test_a_branch_that_meets_the_edge_of_what_compiles_ends_there_with_a_sentence():
    mechanism = rod("")
    mechanism.declare("radius", "spec:geom:rod.size[0]", unit="m")
    branch = mc.continue_equilibria(mechanism, "radius", bounds=(-0.01, 0.025))
    word, sentence = branch.ends[0]
    assert word == "step too small"
    assert "the model does not compile at radius = " in sentence
    assert 0.0 < branch["radius"].min() < 1e-3
    assert branch["radius"].max() == pytest.approx(0.025)


@pytest.mark.long
def test_a_branch_with_a_joint_limit_ends_at_the_edge_of_what_compiles():
    text = ROD.format(declarations="", rest=3).replace('name="hip"', 'name="hip" limited="true" range="-90 90"')
    mechanism = mc.Mechanism.from_xml(text)
    mechanism.declare("radius", "spec:geom:rod.size[0]", unit="m")
    branch = mc.continue_equilibria(mechanism, "radius", bounds=(-0.01, 0.02))
    assert mechanism.constrained
    assert "the model does not compile at radius = " in branch.ends[0][1]
    assert branch.special_points == ()


def test_a_start_at_the_very_edge_is_an_error_that_says_why():
    def widen(spec, value):
        spec.geom("rod").size[0] = RADIUS * (1.0 + math.sqrt(value))

    mechanism = rod("")
    mechanism.declare("width", function=widen, value=0.0, bounds=(-0.5, 1.0))
    with pytest.raises(mc.StartError, match="the function of 'width' has no value at width = -"):
        mc.continue_equilibria(mechanism, "width")


@pytest.mark.slow
def test_a_function_is_not_asked_for_values_beyond_the_bounds():
    asked = []

    def widen(spec, value):
        asked.append(value)
        spec.geom("rod").size[0] = RADIUS * (1.0 + math.sqrt(value) ** 3)

    mechanism = rod("")
    mechanism.declare("width", function=widen, value=0.0, bounds=(0.0, 1.0))
    del asked[:]  # a trial on both sides, when it was declared
    branch = mc.continue_equilibria(mechanism, "width")
    assert branch.status == "at bound"
    assert sorted(branch["width"][[0, -1]]) == pytest.approx([0.0, 1.0])
    assert min(asked) >= 0.0
    assert max(asked) <= 1.0


@pytest.mark.slow
def test_a_branch_that_meets_the_edge_of_a_function_ends_there_with_a_sentence():
    def taper(spec, value):
        spec.geom("rod").size[0] = RADIUS * math.sqrt(1.0 - value)

    mechanism = rod("")
    mechanism.declare("taper", function=taper, value=0.0, bounds=(-0.5, 2.0))
    branch = mc.continue_equilibria(mechanism, "taper")
    assert "the function of 'taper' has no value at taper = " in branch.ends[-1][1] or "compile" in branch.ends[-1][1]
    assert 0.9 < branch["taper"].max() < 1.0
