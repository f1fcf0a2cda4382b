"""Models whose meshes, textures, height fields or skins are not beside them.

Looks and contacts are left out with a note; masses are not. What is computed without a file that only shows a body is
what is computed with it.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.commands.cli import main

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
INERTIAL = '<inertial pos="0 0 1" mass="1" diaginertia="0.01 0.01 0.01"/>'
SHOWN = '<geom name="shell" type="mesh" mesh="tetrahedron" material="paint" contype="0" conaffinity="0"/>'
COLLIDING = '<geom name="shell" type="mesh" mesh="tetrahedron"/>'


def model(geom=SHOWN, inertial=INERTIAL, asset="", world="", rest="", compiler='meshdir="meshes" texturedir="looks"'):
    return f"""
    <mujoco model="pendulum">
      <compiler {compiler}/>
      <asset>
        <mesh file="tetrahedron.obj"/>
        <material name="paint"/>
        {asset}
      </asset>
      <worldbody>
        {world}
        <body name="rod">
          <joint name="hip" type="hinge" axis="0 -1 0" stiffness="1" damping="1"/>
          {inertial}
          {geom}
        </body>
      </worldbody>
      {rest}
    </mujoco>"""


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a model, with its mesh in `meshes` if that is asked for, and gives its path."""

    def write(text, mesh=None, name="pendulum.xml"):
        if mesh:
            (tmp_path / mesh).parent.mkdir(exist_ok=True)
            (tmp_path / mesh).write_text(TETRAHEDRON)
        (tmp_path / name).write_text(text)
        return tmp_path / name

    return write


def upright(mechanism):
    return mc.continue_equilibria(mechanism, "load_factor", bounds=(0.0, 0.2), start={"load_factor": 0.0})


def test_a_mesh_that_is_only_shown_is_left_out_with_a_note(written):
    mechanism = mc.Mechanism.from_xml(written(model()))
    assert mechanism.notes == ("1 file is not there: tetrahedron.obj; 1 geom is left out",)
    assert mechanism.notes[0] in str(mechanism)


def test_a_model_with_all_its_files_has_no_notes(written):
    mechanism = mc.Mechanism.from_xml(written(model(), mesh="meshes/tetrahedron.obj"))
    assert mechanism.notes == ()
    assert "notes" not in str(mechanism)


def test_the_pendulum_without_its_mesh_still_loses_stability_at_g_1(written):
    (point,) = upright(mc.Mechanism.from_xml(written(model()))).special_points
    assert point.kind == "BP"
    assert point["load_factor"] * 9.81 == pytest.approx(1.0, rel=1e-10)


def test_contacts_that_are_lost_are_named(written):
    mechanism = mc.Mechanism.from_xml(written(model(COLLIDING)))
    assert mechanism.notes[1] == "contacts of these geoms are not there: shell"


def test_an_unnamed_geom_that_collides_is_named_by_its_body(written):
    mechanism = mc.Mechanism.from_xml(written(model(COLLIDING.replace('name="shell"', ""))))
    assert mechanism.notes[1] == "contacts of these geoms are not there: one of body 'rod'"


def test_no_contacts_are_missed_where_they_are_disabled(written):
    off = '<option><flag contact="disable"/></option>'
    assert len(mc.Mechanism.from_xml(written(model(COLLIDING, rest=off))).notes) == 1


@pytest.mark.parametrize(
    ("geom", "inertial", "compiler"),
    [
        (SHOWN, "", ""),
        (COLLIDING.replace("/>", ' mass="2"/>'), '<geom name="bob" size="0.1"/>', ""),
        (SHOWN, INERTIAL, 'inertiafromgeom="true"'),
    ],
)
def test_a_moving_body_does_not_lose_its_mass(written, geom, inertial, compiler):
    with pytest.raises(mc.ModelError, match=r"mass from geoms.* rod \(tetrahedron.obj\)\. .*<inertial>"):
        mc.Mechanism.from_xml(written(model(geom, inertial, compiler=compiler)))


def test_a_part_fixed_to_another_may_lose_its_mass_with_a_note(written):
    part = '<body name="badge">' + SHOWN + "</body>"
    mechanism = mc.Mechanism.from_xml(written(model('<geom name="bob" size="0.1" pos="0 0 1" mass="1"/>' + part)))
    assert "the mass of these geoms is not there: of badge" in mechanism.notes[1]
    (point,) = upright(mechanism).special_points
    assert point["load_factor"] * 9.81 == pytest.approx(1.0, rel=1e-10)


@pytest.mark.parametrize("weightless", ['mass="0"', 'density="0"', 'group="3"'])
def test_a_geom_without_mass_may_be_missing(written, weightless):
    bob = '<geom name="bob" size="0.1" pos="0 0 1" mass="1"/>'
    only_first_groups = 'inertiagrouprange="0 2"'
    geom = SHOWN.replace("/>", f" {weightless}/>")
    mechanism = mc.Mechanism.from_xml(written(model(geom, bob, compiler=only_first_groups)))
    (point,) = upright(mechanism).special_points
    assert point["load_factor"] * 9.81 == pytest.approx(1.0, rel=1e-10)


def test_the_ground_needs_no_mass(written):
    world = '<body name="rock"><geom type="mesh" mesh="tetrahedron" contype="0" conaffinity="0"/></body>'
    assert mc.Mechanism.from_xml(written(model("", world=world))).notes == (
        "1 file is not there: tetrahedron.obj; 1 geom is left out",
    )


def test_textures_and_skins_are_left_out(written):
    asset = """
    <texture name="wood" type="2d" file="wood.png"/>
    <texture name="sky" type="cube" fileup="up.png" filedown="down.png"/>
    <material name="plank" texture="wood"/>
    <material name="dome" texture="sky"/>"""
    skin = '<deformable><skin name="hide" file="hide.skn"/></deformable>'
    geom = '<geom type="box" size="0.1 0.1 0.1" material="plank"/>'
    mechanism = mc.Mechanism.from_xml(written(model(geom, asset=asset, rest=skin)))
    assert mechanism.notes[1:] == (
        "2 files are not there: up.png, wood.png; what they cover is drawn plain",
        "1 file is not there: hide.skn; 1 skin is left out",
    )


def test_a_height_field_is_left_out_with_its_contacts(written):
    asset = '<hfield name="hills" file="hills.png" size="1 1 1 1"/>'
    world = '<geom name="ground" type="hfield" hfield="hills"/>'
    mechanism = mc.Mechanism.from_xml(written(model("", asset=asset, world=world)))
    assert "contacts of these geoms are not there: ground" in mechanism.notes
    assert mechanism.notes[0].startswith("2 files are not there: hills.png, tetrahedron.obj")


def test_sensors_and_pairs_of_a_geom_go_with_it(written):
    rest = """
    <sensor><contact name="touch" geom1="shell" geom2="bob" data="found"/></sensor>
    <contact><pair geom1="shell" geom2="bob"/></contact>"""
    world = '<geom name="bob" size="0.1" pos="3 0 0"/>'
    mechanism = mc.Mechanism.from_xml(written(model(SHOWN, world=world, rest=rest)))
    assert mechanism.notes[1:] == (
        "contacts of these geoms are not there: shell",
        "sensors of geoms left out are not there: touch",
    )
    assert "touch" not in mechanism.observables


@pytest.mark.slow
def test_a_saved_branch_reloads_with_its_notes(written, tmp_path):
    branch = upright(mc.Mechanism.from_xml(written(model(COLLIDING))))
    again = mc.load(branch.save(tmp_path / "branch.h5"))
    assert again.problem.notes == branch.problem.notes
    assert np.array_equal(again.problem.residual(branch.states[3], {"load_factor": 0.1}),
                          branch.problem.residual(branch.states[3], {"load_factor": 0.1}))


@pytest.mark.parametrize("strip", ["", 'strippath="true"'])
def test_a_saved_branch_finds_the_files_of_its_model_again(written, tmp_path, monkeypatch, strip):
    world = '<geom name="bob" size="0.1" pos="3 0 0"/>'
    path = written(model(COLLIDING, world=world, compiler=f'meshdir="meshes" {strip}'), mesh="meshes/tetrahedron.obj")
    branch = upright(mc.Mechanism.from_xml(path))
    saved = branch.save(tmp_path / "branch.h5")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    again = mc.load(saved)
    assert all(note.startswith("friction") for note in again.problem.notes)  # no file is missing
    assert again.problem.simulation_model().nmesh == 1


@pytest.mark.parametrize("compiler", ['meshdir="meshes"', 'assetdir="meshes"', 'assetdir="nowhere" meshdir="meshes"'])
def test_folders_of_the_compiler_are_searched(written, compiler):
    path = written(model(compiler=compiler), mesh="meshes/tetrahedron.obj")
    assert mc.Mechanism.from_xml(path).notes == ()


def test_a_model_that_includes_another_finds_its_files(written):
    written(model(), mesh="meshes/tetrahedron.obj")
    whole = written('<mujoco><include file="pendulum.xml"/></mujoco>', name="whole.xml")
    assert mc.Mechanism.from_xml(whole).notes == ()


def test_a_model_that_includes_another_drops_its_missing_files(written):
    written(model())
    whole = written('<mujoco><include file="pendulum.xml"/></mujoco>', name="whole.xml")
    mechanism = mc.Mechanism.from_xml(whole)
    assert mechanism.notes == ("1 file is not there: tetrahedron.obj; 1 geom is left out",)
    assert mc.Mechanism.from_xml(mechanism.mjcf).notes == mechanism.notes


def test_a_model_that_attaches_another_is_loaded(written):
    written(model(), mesh="meshes/tetrahedron.obj")
    text = """
    <mujoco model="pair">
      <asset><model name="part" file="pendulum.xml"/></asset>
      <worldbody>
        <frame pos="0 1 0"><attach model="part" body="rod" prefix="left_"/></frame>
        <frame pos="0 -1 0"><attach model="part" body="rod" prefix="right_"/></frame>
      </worldbody>
    </mujoco>"""
    mechanism = mc.Mechanism.from_xml(written(text, name="pair.xml"))
    assert {"left_hip", "right_hip"} <= mechanism.observables.keys()


def test_what_mujoco_warns_of_is_a_note(written):
    text = model("", '<geom size="0.1" mass="3"/>', compiler='settotalmass="2"').replace(
        '<mesh file="tetrahedron.obj"/>', ""
    )
    mechanism = mc.Mechanism.from_xml(written(text))
    (note,) = mechanism.notes
    assert note.startswith("MuJoCo: compiler attribute 'settotalmass'")
    assert mechanism.simulation_model().body_mass[1] == pytest.approx(2.0)


def test_inspect_says_what_is_missing(written, capsys):
    assert main(["inspect", str(written(model(COLLIDING)))]) == 0
    assert "contacts of these geoms are not there: shell" in capsys.readouterr().out


def test_inspect_refuses_a_lost_mass_in_one_line(written, capsys):
    assert main(["inspect", str(written(model(COLLIDING, "")))]) == 2
    assert capsys.readouterr().err.count("\n") == 1


# -- bushes and stiffnesses ------------------------------------------------------------------------------------------

TWO_BARS = """<mujoco model="bars"><asset><mesh name="shell" file="gone.stl"/></asset><worldbody>
  <body name="left"><joint name="a" axis="0 1 0" damping="1"/>
    <inertial pos=".5 0 0" mass="1" diaginertia=".1 .1 .1"/><geom type="mesh" mesh="shell"/></body>
  <body name="right" pos="2 0 0"><joint name="b" axis="0 1 0" damping="1"/>
    <inertial pos="-.5 0 0" mass="1" diaginertia=".1 .1 .1"/></body></worldbody>
  <equality><connect name="pin" body1="left" body2="right" anchor="1 0 0"/></equality></mujoco>"""
GONE = "1 file is not there: gone.stl; 1 geom is left out"
CONTACTS = "contacts of these geoms are not there: one of body 'left'"


def present():
    return TWO_BARS.replace('<geom type="mesh" mesh="shell"/>', "").replace('<mesh name="shell" file="gone.stl"/>', "")


@pytest.fixture
def bars(tmp_path):
    (tmp_path / "bars.xml").write_text(TWO_BARS)
    return tmp_path / "bars.xml"


def test_bushes_are_added_without_what_is_missing_and_its_text_stays_as_it_is(bars):
    with pytest.warns(mc.ModelWarning) as caught:
        text = mc.bushed_xml(bars, stiffness=1e6)
    assert [str(w.message) for w in caught] == [GONE, CONTACTS]
    assert '<mesh name="shell" file="gone.stl"/>' in text
    assert '<geom type="mesh" mesh="shell"/>' in text
    mechanism = mc.Mechanism.from_xml(text)
    assert mechanism.notes == (GONE, CONTACTS)
    assert mechanism.parameters["k_bush"].value == 1e6


@pytest.mark.parametrize("change", [mc.add_bushes, mc.set_constraint_stiffness])
def test_a_spec_with_bushes_or_stiffness_compiles_without_what_is_missing(bars, change):
    with pytest.warns(mc.ModelWarning) as caught:
        spec = change(bars, stiffness=1e6)
    assert [str(w.message) for w in caught] == [GONE, CONTACTS]
    mechanism, whole = mc.Mechanism.from_spec(spec), mc.Mechanism.from_spec(change(present(), stiffness=1e6))
    assert mechanism.notes == (GONE, CONTACTS)
    x = np.full(mechanism.n, 0.1)
    np.testing.assert_array_equal(mechanism.residual(x, mechanism.values()), whole.residual(x, whole.values()))


def test_what_an_included_text_names_stays_as_it_is(tmp_path):
    start, end = TWO_BARS.index("<asset>"), TWO_BARS.index("</asset>") + len("</asset>")
    (tmp_path / "parts.xml").write_text(f"<mujocoinclude>{TWO_BARS[start:end]}</mujocoinclude>")
    (tmp_path / "bars.xml").write_text(f'{TWO_BARS[:start]}<include file="parts.xml"/>{TWO_BARS[end:]}')
    with pytest.warns(mc.ModelWarning) as caught:
        text = mc.bushed_xml(tmp_path / "bars.xml")
    assert str(caught[0].message) == GONE
    assert '<mesh name="shell" file="gone.stl"/>' in text and "<include" not in text


def test_the_command_bush_says_what_is_missing_and_writes_it_as_it_is(bars, capsys):
    assert main(["bush", str(bars), "-o", str(bars.with_name("soft.xml"))]) == 0
    out = capsys.readouterr()
    assert GONE in out.out + out.err
    assert 'file="gone.stl"' in bars.with_name("soft.xml").read_text()


def test_files_beside_the_model_must_be_beside_the_text_that_is_written(bars, tmp_path, capsys):
    (tmp_path / "gone.stl").write_text("solid nothing\nendsolid\n")
    bars.write_text(TWO_BARS.replace("gone.stl", "here.obj"))
    (tmp_path / "here.obj").write_text(TETRAHEDRON)
    (tmp_path / "elsewhere").mkdir()
    assert main(["bush", str(bars), "-o", str(tmp_path / "elsewhere" / "soft.xml")]) != 0
    assert "files beside the model must be beside it, too" in capsys.readouterr().err


def test_a_spec_whose_mesh_is_missing_is_taken_without_it():
    mechanism = mc.Mechanism.from_spec(mujoco.MjSpec.from_string(TWO_BARS))
    assert mechanism.notes == (GONE, CONTACTS)
