"""Parameter values written into the attributes of an MJCF text, comments and everything else kept to the letter."""

from __future__ import annotations

import difflib

import pytest

import mjcont as mc
from mjcont.mechanism.written.edit import rewritten


def changed(mechanism, values):
    """Return the lines of the text that the values change: the new ones, stripped."""
    for name in values:
        mechanism.parameter(name)
    new = rewritten(mechanism, values)
    lines = difflib.ndiff(mechanism.mjcf.splitlines(), new.splitlines())
    return [line[2:].strip() for line in lines if line.startswith("+ ")]


@pytest.fixture(scope="module")
def gear():
    return mc.Mechanism.from_xml("nose_gear")


@pytest.mark.parametrize(
    ("values", "parts"),
    [
        ({"k_sp": 2100.0, "l_us": 0.9}, ['springlength="0.9" stiffness="2100" damping="200"']),
        ({"r_ret": 0.06}, ['name="F_ret" joint="theta_1" gear="-0.06"']),
        ({"body:upper_sidestay.pos[0]": -1.55}, ['name="upper_sidestay" pos="-1.55 0 0.007" euler="0 32.5307331']),
        ({"m_6": 300.0}, ['<inertial pos="0 0 0" mass="300" diaginertia="0 0 0"/>']),
        ({"c_D": 2000.0}, ['ref="-0.424301885572637" damping="2000"/>']),
        ({"joint:theta_2.springref": 0.1}, ['ref="-32.53073311073303" springref="5.729577951308233"/>']),
        ({"option:gravity[2]": -9.0}, ['gravity="0 0 -9"']),
        ({"spec:geom:tyre_left.size[0]": 0.4}, ['fromto="0 -0.25 0 0 -0.11 0" size="0.4"/>']),
        ({"k_j": 2e6}, [f'name="bush_{pin}_{axis}"' for pin in "CH" for axis in "xz"]),
    ],
    ids=lambda v: next(iter(v)) if isinstance(v, dict) else "",
)
def test_only_the_attributes_of_what_changes_are_written(gear, values, parts):
    lines = changed(gear, values)
    assert len(lines) == len(parts)
    for line, part in zip(lines, parts, strict=True):
        assert part in line


def test_the_model_written_has_the_values(gear):
    values = {"k_sp": 2123.456789012345, "m_1": 1300.0, "k_j": 3e6, "l_us": 1.0 / 3.0}
    again = mc.Mechanism.from_xml(rewritten(gear, values))
    assert {n: again.parameters[n].value for n in values} == pytest.approx(values, rel=1e-14)


def test_nothing_changes_at_the_models_own_values(gear):
    assert rewritten(gear, {"k_sp": 2000.0}) == gear.mjcf


def test_comments_and_quotes_of_other_kinds_stay(pendulum_xml):
    text = pendulum_xml(joint="stiffness='2'  damping = \"0.5\"", world='<!-- <joint name="hip" stiffness="9"/> -->')
    mechanism = mc.Mechanism.from_xml(text)
    mechanism.parameter("joint:hip.stiffness")
    assert rewritten(mechanism, {"joint:hip.stiffness": 3.0}) == text.replace("stiffness='2'", "stiffness='3'")


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"F_ret": 1.0}, "F_ret = 1 cannot be written into the MJCF: a control is no part of a model"),
        ({"load_factor": 2.0}, "gravity's turn and factor are no attributes"),
    ],
)
def test_what_is_no_attribute_is_refused_with_the_reason(gear, values, said):
    with pytest.raises(mc.ParameterError, match=said):
        rewritten(gear, values)


def test_a_mass_that_follows_from_geoms_is_refused_with_what_to_declare_instead():
    text = """<mujoco><worldbody><body name="rod"><joint name="hip" axis="0 1 0"/>
      <geom name="rod" type="capsule" fromto="0 0 0 0 0 1" size="0.05"/></body></worldbody></mujoco>"""
    rod = mc.Mechanism.from_xml(text)
    rod.parameter("body:rod.mass")
    with pytest.raises(mc.ParameterError, match="declare the density of its geoms"):
        rewritten(rod, {"body:rod.mass": 9.0})


def test_a_place_inside_a_frame_is_refused_with_what_to_declare_instead():
    mechanism = mc.Mechanism.from_xml("overcentre")
    mechanism.parameter("site:B_1.pos[0]")
    with pytest.raises(mc.ModelError, match=r"its site_pos differs .*declare them as in spec:site:NAME.pos"):
        rewritten(mechanism, {"site:B_1.pos[0]": 0.27})


def test_a_function_of_the_spec_is_refused():
    mechanism = mc.Mechanism.from_xml("overcentre")

    def heavier(spec, value):
        spec.body("link_1").mass = value

    mechanism.declare("weight", function=heavier, value=1.0, bounds=(0.5, 2.0))
    with pytest.raises(mc.ParameterError, match="a Python function makes the edit"):
        rewritten(mechanism, {"weight": 1.5})
