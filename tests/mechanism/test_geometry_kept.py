"""Parameters that edit the spec: what stays as it was, what files carry, and what is said of wrong input."""

import math

import mujoco
import numpy as np
import pytest
from problems.rods import (
    DAMPING,
    DECLARED,
    GRAVITY,
    LENGTH,
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

# -- what stays, what is stored ------------------------------------------------------------------------------


def test_keyframes_and_controls_survive():
    mechanism = with_function()
    assert mechanism.start_state("leaning") == pytest.approx([0.4])
    point = mc.find_equilibrium(mechanism, {"length": 0.2, "torque": 0.3}, keyframe="leaning")
    theta = point.state[0]
    balance = 0.3 + weight_moment(0.2) * math.sin(theta) - STIFFNESS * (theta - REST)
    assert balance == pytest.approx(0.0, abs=1e-10)


def test_a_time_history_swings_with_the_recompiled_inertia():
    mechanism = rod(rest=0.0)
    history = mc.simulate(
        mechanism, {"length": 0.2}, 2.0, state=[0.01], integrator="RK4", timestep=5e-4, samples=4000
    )
    t, theta = history["time"], history["hip"]
    stiffness, decay = STIFFNESS - weight_moment(0.2), DAMPING / (2.0 * inertia(0.2))
    omega = math.sqrt(stiffness / inertia(0.2) - decay**2)
    expected = 0.01 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    assert theta == pytest.approx(expected, abs=2e-5)


def test_a_history_that_leaves_what_compiles_is_an_error_with_the_time():
    mechanism = rod("")
    radius = mechanism.declare("radius", "spec:geom:rod.size[0]", unit="m")
    with pytest.raises(mc.ParameterError, match=r"at t = 0\.1.* s the model does not compile at radius = "):
        mc.simulate(mechanism, {"radius": lambda t: radius.value * (1.0 - t / 0.1)}, 1.0)


@pytest.mark.slow
def test_a_parameter_by_path_is_rebuilt_from_a_result_file(tmp_path):
    name = "spec:geom:rod.fromto[5]"
    branch = mc.continue_equilibria(rod(""), name, bounds=(0.1, 0.4))
    loaded = mc.load(branch.save(tmp_path / "length.h5"))
    found = loaded.at(**{name: 0.25})[0]
    theta = found.state[0]
    assert weight_moment(0.25) * math.sin(theta) == pytest.approx(STIFFNESS * (theta - REST), rel=1e-9)


@pytest.mark.slow
def test_a_parameter_by_function_asks_for_the_mechanism_when_its_file_is_loaded(tmp_path):
    mechanism = with_function()
    path = mc.continue_equilibria(mechanism, "length", bounds=(0.1, 0.4)).save(tmp_path / "length.h5")
    with pytest.raises(mc.ResultFileError, match=r"'length' is the Python function set_length.* problem=mechanism"):
        mc.load(path)
    assert mc.load(path, problem=mechanism).at(length=0.25)[0]["length"] == 0.25


def test_a_spec_of_ones_own_is_edited_in_a_copy():
    spec = mujoco.MjSpec.from_string(ROD.format(declarations="", rest=3))
    mechanism = mc.Mechanism.from_spec(spec)
    spec.geom("rod").fromto[5] = 0.9
    mechanism.declare("length", function=set_length, value=LENGTH)
    found = mechanism.pencil(np.zeros(1), mechanism.values({"length": 0.5}), np.zeros((1, 1))).mass[0, 0]
    assert found == pytest.approx(inertia(0.5), rel=1e-13)
    assert spec.geom("rod").fromto[5] == 0.9


def test_meshes_beside_the_model_are_found_when_it_is_compiled_again(tmp_path, monkeypatch):
    (tmp_path / "meshes").mkdir()
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "meshes" / "corner.obj").write_text(corners)
    (tmp_path / "part.xml").write_text("<mujoco><option density='0'/></mujoco>")
    (tmp_path / "model.xml").write_text(
        "<mujoco><compiler meshdir='meshes'/><include file='part.xml'/><asset><mesh file='corner.obj'/></asset>"
        "<worldbody><body><joint name='j'/><geom name='g' type='mesh' mesh='corner'/></body></worldbody></mujoco>"
    )
    monkeypatch.chdir(tmp_path)
    mechanism = mc.Mechanism.from_xml("model.xml")
    monkeypatch.chdir("/")
    density = mechanism.parameter("spec:geom:g.density")
    q = np.zeros(1)
    one, two = (
        mechanism.pencil(q, mechanism.values({density.name: v}), np.zeros((1, 1))).mass[0, 0] for v in (1000, 2000)
    )
    assert two == pytest.approx(2.0 * one, rel=1e-12)


def test_the_table_of_parameters_says_what_a_change_costs():
    mechanism = rod()
    mechanism.declare("m", "body:rod.mass", unit="kg")
    mechanism.declare("k", "joint:hip.stiffness")
    costs = {name: p.cost for name, p in mechanism.parameters.items()}
    assert costs["torque"] == "nothing"
    assert costs["gravity_angle"] == costs["k"] == "field"
    assert costs["m"] == "field + constants"
    assert costs["length"] == "recompile"
    line = next(line for line in str(mechanism.parameters).splitlines() if line.split()[0] == "length")
    assert line.split() == ["length", "0.3", "m", "0.1", "0.6", "recompile", *DECLARED.split(" : ")[1][:-3].split()]
    assert str(mechanism.parameters) in str(mechanism)


def test_a_copy_with_held_modes_follows_a_parameter_that_is_declared_later():
    mechanism = mc.Mechanism.from_xml("""
    <mujoco><worldbody><body><joint type="slide" axis="0 0 1"/><geom name="ball" size="0.1" density="1000"/></body>
    </worldbody></mujoco>""")
    copy = mechanism.holding(())
    mechanism.declare("radius", "spec:geom:ball.size[0]", bounds=(0.05, 0.3))
    weight = 1000.0 * 4.0 / 3.0 * math.pi * 0.2**3 * GRAVITY
    assert copy.residual(np.zeros(1), copy.values({"radius": 0.2})) == pytest.approx([-weight])


# -- wrong input ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("spec:geom:rod.sise[0]", r"unknown attribute of a geom in the spec 'sise'\. Did you mean size\? Valid: "),
        ("spec:geom:rods.size[0]", r"matches no geom of the model\. Its geom names: rod\."),
        ("spec:light:sun.pos[0]", r"unknown object in a spec path 'light'.*Valid: actuator, body, equality, geom"),
        ("spec:geom:rod.size[3]", r"index 3 is outside 0\.\.2"),
        ("spec:geom:rod.density[0]", r"density is a number, without an index"),
        ("spec:geom:rod.mass", r"the XML of geom 'rod' gives no mass; use density"),
        ("spec:geom:rod.pos[2]", r"geom 'rod' is placed by fromto; use fromto\[0\]"),
        ("spec:geom:rod.euler[1]", r"the XML of geom 'rod' gives no euler; use fromto"),
        ("spec:body:rod.ipos[2]", r"gives no ipos; use the body's geoms"),
        ("spec:geom:rod.size[1]", r"changes nothing in the compiled model: .*fromto over size\[1\]"),
        ("spec:body:rod.mass", r"changes nothing in the compiled model: .*without <inertial>"),
        ("spec:geom:rod.size", r"its targets disagree .* an index such as \[0\]"),
        ("spec:geom:rod", r"an attribute is missing, as in spec:geom:rod\.pos\[0\]"),
        ("spec:geom.size[0]", r"expected object:name\.attribute\[index\]\*factor\+offset"),
    ],
)
def test_a_path_that_cannot_be_used_is_an_error_that_says_what_can(path, message):
    with pytest.raises((mc.ParameterError, mc.NameLookupError), match=message):
        rod("").parameter(path)


def add_a_ball(spec, value):
    if value > LENGTH:
        spec.body("rod").add_geom(name="ball", size=[value, 0, 0])


def set_other(spec, value):
    spec.geom("rods").size[0] = value


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"function": add_a_ball, "value": LENGTH}, mc.ModelError, "'p' changes the structure .* ngeom is 2, not 1"),
        ({"function": set_length, "value": 0.4}, mc.ParameterError, "at its value 0.4 .* the model as loaded"),
        ({"function": set_length}, mc.ParameterError, "a function needs value="),
        ({"function": set_other, "value": 1.0}, mc.ParameterError, "its function failed at p = 1: AttributeError"),
        ({"value": 1.0}, mc.ParameterError, "value= goes with function="),
        ({}, mc.ParameterError, "give at least one target"),
    ],
)
def test_a_declaration_that_cannot_be_used_is_an_error_that_names_the_parameter(options, error, message):
    with pytest.raises(error, match=message):
        rod("").declare("p", **options)


def test_paths_and_a_function_together_are_an_error():
    with pytest.raises(mc.ParameterError, match="either paths or a function"):
        rod("").declare("p", "spec:geom:rod.density", function=set_length, value=LENGTH)


def test_targets_in_the_spec_and_in_fields_together_are_an_error():
    with pytest.raises(mc.ParameterError, match=r"mixes targets in the spec with others \(joint:hip\.stiffness\)"):
        rod("").declare("p", "spec:geom:rod.density", "joint:hip.stiffness")


def test_a_compiled_model_has_no_spec():
    model = mujoco.MjModel.from_xml_string(ROD.format(declarations="", rest=3))
    with pytest.raises(mc.ParameterError, match="a compiled model does not carry: .*from_xml or Mechanism.from_spec"):
        mc.Mechanism.from_model(model).parameter("spec:geom:rod.density")


def test_a_value_at_which_the_model_does_not_compile_is_an_error():
    with pytest.raises(mc.ParameterError, match=r"does not compile at length = 0: .*fromto"):
        mc.find_equilibrium(rod(), {"length": 0.0})


def test_a_mass_cannot_be_varied_by_its_field_where_the_geometry_has_changed_it():
    mechanism = rod()
    mechanism.declare("m", "body:rod.mass")
    with pytest.raises(mc.ParameterError, match=r"'m' cannot be varied while 'length' has another value"):
        mc.continue_equilibria(mechanism, "m", start={"length": 0.4})
    assert len(mc.continue_equilibria(mechanism, "m", bounds=(0.3, 0.5))) > 3
