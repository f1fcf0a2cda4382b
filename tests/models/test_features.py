"""What is refused, and what is said about friction: messages, and equilibria that are those without friction."""

from __future__ import annotations

import math
import warnings

import mujoco
import numpy as np
import pytest

import mjcont as mc

DRY = {
    "joint": ({"joint": 'frictionloss="1"'}, "frictionloss of joint hip"),
    "tendon": (
        {"rest": '<tendon><fixed name="rope" frictionloss="1"><joint joint="hip" coef="1"/></fixed></tendon>'},
        "frictionloss of tendon rope",
    ),
}

# -- features that cannot be treated -------------------------------------------------------------------------

REFUSED = {
    "sleep": ({"flag": 'sleep="enable"'}, r'sleeping bodies make equilibria path dependent: remove <flag sleep'),
    "plastic spring": (
        {"joint": 'stiffness="1" springyield="0.1"'},
        r"plastic springs \(springyield\) make equilibria path dependent: set springyield to 0",
    ),
    "integral control": (
        {"actuator": '<pid name="drive" joint="hip" kp="5" ki="1"/>'},
        r"actuator 'drive' \(pid\) has a state: an integral.* Set ki and slewmax to 0",
    ),
    "slewing setpoint": (
        {"actuator": '<pid name="drive" joint="hip" kp="5" slewmax="1"/>'},
        r"actuator 'drive' \(pid\) has a state:.* Set ki and slewmax to 0",
    ),
    "motor with inductance": (
        {"actuator": '<dcmotor name="drive" joint="hip" resistance="1" motorconst="1" inductance="0.01"/>'},
        r"actuator 'drive' \(dcmotor\) has electrical.* Leave out what makes them \(inductance",
    ),
    "user dynamics": (
        {"actuator": '<general name="drive" joint="hip" dyntype="user" actdim="1"/>'},
        r"actuator 'drive' is of type user: its law is in a callback.* make it a motor",
    ),
    "user gain": (
        {"actuator": '<general name="drive" joint="hip" gaintype="user"/>'},
        r"actuator 'drive' is of type user: its law is in a callback.* make it a motor",
    ),
    "plugin with states": (
        {
            "actuator": '<plugin name="drive" joint="hip" plugin="mujoco.pid" actdim="1"><config key="ki" value="1"/>'
            '<config key="kp" value="5"/></plugin>',
            "rest": '<extension><plugin plugin="mujoco.pid"/></extension>',
        },
        r"actuator 'drive' has activation states of its own \(a plugin's.* leave out what makes them",
    ),
}


@pytest.mark.parametrize(("parts", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_a_feature_that_cannot_be_treated_is_refused_with_reason_and_remedy(pendulum_xml, parts, message):
    with pytest.raises(mc.ModelError, match=message):
        mc.Mechanism.from_xml(pendulum_xml(**parts))


def test_a_model_without_a_degree_of_freedom_is_refused_with_reason_and_remedy():
    with pytest.raises(mc.ModelError, match="no degree of freedom, so nothing in it can find a place .* add a joint"):
        mc.Mechanism.from_xml('<mujoco><worldbody><geom size="1"/></worldbody></mujoco>')


STATIC = {
    "pid without integral": ('<pid name="u" joint="hip" kp="5" input="pos"/>', lambda q: 5 * (0.4 - q)),
    "dcmotor without states": (
        '<dcmotor name="u" joint="hip" resistance="2" motorconst="3"/>',
        lambda q: 3 / 2 * 0.4,
    ),
}


@pytest.mark.parametrize(("actuator", "torque"), STATIC.values(), ids=STATIC.keys())
def test_what_remains_when_the_remedy_is_followed_is_treated(pendulum_xml, actuator, torque):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(actuator=actuator))
    found = mechanism.residual(np.array([0.3]), mechanism.values({"u": 0.4, "load_factor": 0.0}))
    assert found == pytest.approx([torque(0.3)], rel=1e-12)


# -- dry friction --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("parts", "named"), DRY.values(), ids=DRY.keys())
def test_dry_friction_is_left_out_with_a_warning_that_names_it(pendulum_xml, parts, named):
    with pytest.warns(mc.ModelWarning, match=rf"{named}\) carries no load at rest in MuJoCo, where it creeps") as said:
        mechanism = mc.Mechanism.from_xml(pendulum_xml(**parts))
    assert said[0].filename == __file__
    assert mechanism.notes == (str(said[0].message),)
    assert f"notes\n  {mechanism.notes[0]}" in str(mechanism)
    assert mechanism.residual(np.array([0.3]), mechanism.values()) == pytest.approx(9.81 * math.sin(0.3), rel=1e-12)


@pytest.mark.parametrize("source", ["spec", "model"])
def test_every_way_to_make_a_mechanism_has_the_choice(pendulum_xml, source):
    text = pendulum_xml(joint='frictionloss="1"')
    made, given = {
        "spec": (mc.Mechanism.from_spec, mujoco.MjSpec.from_string(text)),
        "model": (mc.Mechanism.from_model, mujoco.MjModel.from_xml_string(text)),
    }[source]
    with pytest.warns(mc.ModelWarning, match="joint hip") as said:
        made(given)
    assert said[0].filename == __file__
    with pytest.raises(mc.ModelError, match="joint hip"):
        made(given, friction="refuse")


@pytest.mark.parametrize(("parts", "named"), DRY.values(), ids=DRY.keys())
def test_dry_friction_is_refused_on_request_with_the_remedy(pendulum_xml, parts, named):
    with pytest.raises(mc.ModelError, match=rf"{named}\).*Remove it, or take .*friction=\"frictionless\""):
        mc.Mechanism.from_xml(pendulum_xml(**parts), friction="refuse")


def test_an_unknown_choice_lists_the_valid_ones(pendulum_xml):
    with pytest.raises(mc.ParameterError, match="unknown friction 'none'. Valid: frictionless, refuse"):
        mc.Mechanism.from_xml(pendulum_xml(), friction="none")


def test_time_histories_keep_dry_friction(pendulum_xml):
    with pytest.warns(mc.ModelWarning):
        mechanism = mc.Mechanism.from_xml(pendulum_xml(joint='frictionloss="20"'))
    history = mc.simulate(mechanism, duration=1.0, state=[0.3])
    assert abs(history["hip"][-1] - 0.3) < 0.05


def test_a_stored_branch_with_friction_loads_without_a_second_warning(pendulum_xml, tmp_path):
    text = pendulum_xml(joint='frictionloss="1" stiffness="20" damping="1"', actuator='<motor name="M" joint="hip"/>')
    with pytest.warns(mc.ModelWarning):
        mechanism = mc.Mechanism.from_xml(text)
    mc.continue_equilibria(mechanism, "M", bounds=(-2, 2)).save(tmp_path / "a.h5")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        branch = mc.load(tmp_path / "a.h5")
    assert 20 * branch["hip"] - 9.81 * np.sin(branch["hip"]) == pytest.approx(branch["M"], abs=1e-7)
    assert "joint hip" in branch.problem.notes[0]


# -- friction of contacts ------------------------------------------------------------------------------------


def resting_ball(condim: int, cone: str = "pyramidal", friction: str = "1 0.005 0.0001") -> mc.Mechanism:
    """A ball of 1 kg on a floor, pulled along it by a weak spring towards x = 0.2."""
    contact = f'condim="{condim}" friction="{friction}"'
    return mc.Mechanism.from_xml(
        f"""<mujoco model="ball"><option gravity="0 0 -9.81" cone="{cone}"/><worldbody>
        <geom name="floor" type="plane" size="2 2 0.1" {contact}/>
        <body pos="0 0 0.1"><joint name="x" type="slide" axis="1 0 0" stiffness="5" springref="0.2"/>
        <joint name="z" type="slide" axis="0 0 1"/><geom name="ball" size="0.1" mass="1" {contact}/></body>
        </worldbody></mujoco>"""
    )


def pencil(mechanism: mc.Mechanism, point: mc.Point):
    values = mechanism.values(point.parameters)
    return mechanism.pencil(point.state, values, mechanism.linearize(point.state, values, ()).jac)


@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("condim", [3, 4, 6])
def test_friction_of_a_contact_holds_nothing_at_rest(condim, cone):
    mechanism = resting_ball(condim, cone)
    point = mc.find_equilibrium(mechanism)
    assert point["x"] == pytest.approx(0.2, abs=1e-9)
    aside = point.state + [0.1, 0.0]
    assert mechanism.residual(aside, mechanism.values())[0] == pytest.approx(-0.5, rel=1e-9)


@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("condim", [1, 3, 4, 6])
def test_stability_on_a_frictional_contact_is_that_without_friction(condim, cone):
    mechanism = resting_ball(condim, cone)
    point = mc.find_equilibrium(mechanism)
    found = pencil(mechanism, point)
    assert (found.mass[0, 0], found.damping[0, 0]) == pytest.approx((1.0, 0.0), abs=1e-9)
    assert point.stability == "marginal"


def test_damping_along_the_normal_is_that_of_mujocos_contact():
    mechanism = resting_ball(1)
    point = mc.find_equilibrium(mechanism)
    found = pencil(mechanism, point)
    damping_per_mass = 2.0 / (0.95 * 0.02)  # solref (0.02, 1) at an impedance of 0.95
    depth = -point["z"]
    impedance = 0.9 + 0.05 * 2.0 * (depth / 1e-3) ** 2
    constraint_mass = found.mass[1, 1] - 1.0
    assert constraint_mass == pytest.approx(impedance / (1.0 - impedance), rel=1e-3)
    assert found.damping[1, 1] == pytest.approx(damping_per_mass * constraint_mass, rel=1e-3)


def test_friction_of_contacts_is_a_note_and_no_warning():
    (note,) = resting_ball(3).notes
    assert note.startswith("friction of contacts (floor on ball) carries no load at rest in MuJoCo")


FRICTIONLESS = {"condim 1": (1, "1 0.005 0.0001"), "no friction": (3, "0 0 0")}


@pytest.mark.parametrize(("condim", "friction"), FRICTIONLESS.values(), ids=FRICTIONLESS.keys())
def test_contacts_without_friction_need_no_note(condim, friction):
    assert resting_ball(condim, friction=friction).notes == ()


def test_friction_of_contacts_is_refused_on_request_with_the_remedy(pendulum_xml):
    text = pendulum_xml(world='<geom name="floor" type="plane" size="1 1 1"/>', body='<geom name="end" size="0.1"/>')
    with pytest.raises(mc.ModelError, match=r"friction of contacts \(floor on end\).*Give these geoms condim 1, or"):
        mc.Mechanism.from_xml(text, friction="refuse")


def test_friction_of_a_contact_pair_is_refused_on_request(pendulum_xml):
    text = pendulum_xml(
        world='<geom name="floor" type="plane" size="1 1 1" contype="0" conaffinity="0"/>',
        body='<geom name="end" size="0.1" contype="0" conaffinity="0"/>',
        rest='<contact><pair geom1="floor" geom2="end"/></contact>',
    )
    with pytest.raises(mc.ModelError, match=r"friction of contacts \((floor on end|end on floor)\)"):
        mc.Mechanism.from_xml(text, friction="refuse")


# -- the command and study files -----------------------------------------------------------------------------


@pytest.fixture
def study(pendulum_xml, tmp_path):
    """Return a function: a study of a pendulum with dry friction, with a line put in."""

    def write(line=""):
        motor = '<motor name="M" joint="hip"/>'
        text = pendulum_xml(joint='frictionloss="1" stiffness="20" damping="1"', actuator=motor)
        (tmp_path / "rod.xml").write_text(text, encoding="utf-8")
        branch = '[[branch]]\nname = "a"\nparameter = "M"\nbounds = [-1, 1]\n'
        (tmp_path / "rod.toml").write_text(f'model = "rod.xml"\n{line}\n{branch}', encoding="utf-8")
        return tmp_path / "rod.toml"

    return write


def run(*arguments):
    from mjcont.commands.cli import main

    return main([str(a) for a in arguments])


def test_the_command_says_what_it_leaves_out_in_one_line(study, tmp_path, capsys):
    assert run("run", study(), "-o", tmp_path / "out") == 0
    (line,) = [x for x in capsys.readouterr().err.splitlines() if "warning" in x]
    assert line.startswith("mjcont: warning: dry friction (frictionloss of joint hip) carries no load at rest")


@pytest.mark.parametrize("command", ["inspect", "run"])
def test_the_command_refuses_friction_on_request(study, tmp_path, capsys, command):
    model = study().with_suffix(".xml") if command == "inspect" else study()
    assert run(command, model, "--friction", "refuse") == 2
    assert "frictionloss of joint hip" in capsys.readouterr().err


def test_a_study_can_refuse_friction(study):
    with pytest.raises(mc.StudyError, match=r"model: dry friction \(frictionloss of joint hip\)"):
        mc.load_study(study('friction = "refuse"'))


def test_the_command_overrules_the_study(study, tmp_path):
    assert run("run", study('friction = "refuse"'), "-o", tmp_path / "out", "--friction", "frictionless", "-q") == 0


def test_a_wrong_choice_in_a_study_lists_the_valid_ones(study):
    with pytest.raises(mc.StudyError, match="friction: unknown choice 'none'.* Valid: frictionless, refuse"):
        mc.load_study(study('friction = "none"'))
