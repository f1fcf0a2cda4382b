"""Modes against closed forms, and against the matrix of the accelerations by differences of its own."""

import math

import numpy as np
import pytest
from scipy.linalg import eig

import mjcont as mc

G, LENGTH = 9.81, 0.7

# two equal point masses on massless rods
DOUBLE_PENDULUM = f"""<mujoco model="double"><option gravity="0 0 -{G}"/><worldbody>
<body><joint name="a" type="hinge" axis="0 1 0"/>
<inertial pos="0 0 -{LENGTH}" mass="1.3" diaginertia="1e-12 1e-12 1e-12"/>
<geom type="capsule" fromto="0 0 0 0 0 -{LENGTH}" size="0.01" mass="0" contype="0" conaffinity="0"/>
<body pos="0 0 -{LENGTH}"><joint name="b" type="hinge" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 0 0 -{LENGTH}" size="0.01" mass="0" contype="0" conaffinity="0"/>
<inertial pos="0 0 -{LENGTH}" mass="1.3" diaginertia="1e-12 1e-12 1e-12"/></body></body></worldbody></mujoco>"""


def chain(n: int, k: float, m: float, damping: float) -> str:
    """Return n masses in a row between walls, joined by springs k and dampers: coordinates are absolute."""
    bodies = "".join(
        f'<body name="b{i}"><joint name="x{i}" type="slide" axis="1 0 0"/>'
        f'<inertial pos="0 0 0" mass="{m}" diaginertia="1 1 1"/></body>'
        for i in range(n)
    )
    ends = "".join(
        f'<fixed name="t{i}" stiffness="{k}" damping="{damping}">'
        + (f'<joint joint="x{i - 1}" coef="-1"/>' if i else "")
        + (f'<joint joint="x{i}" coef="1"/>' if i < n else "")
        + "</fixed>"
        for i in range(n + 1)
    )
    return (f'<mujoco model="chain"><option gravity="0 0 0"/><worldbody>{bodies}</worldbody>'
            f"<tendon>{ends}</tendon></mujoco>")


BALL = """<mujoco model="ball"><option gravity="0 0 0"/><worldbody><body>
<joint type="ball" stiffness="3" damping="0.02"/><inertial pos="0 0 0" mass="1" diaginertia="0.2 0.3 0.4"/>
</body></worldbody></mujoco>"""


def loaded(tmp_path, text):
    path = tmp_path / "model.xml"
    path.write_text(text)
    return mc.Mechanism.from_xml(path)


def modes_of(tmp_path, text, **start):
    return mc.modes(mc.find_equilibrium(loaded(tmp_path, text), **start))


def test_a_double_pendulum_has_the_frequencies_of_the_textbook(tmp_path):
    # omega^2 = (2 -+ sqrt 2) g / l, absolute angles 1 : +-sqrt 2 (Landau, Lifshitz, Mechanics, section 23)
    modes = modes_of(tmp_path, DOUBLE_PENDULUM)
    omega = np.sqrt(np.array([2 - math.sqrt(2), 2 + math.sqrt(2)]) * G / LENGTH)
    assert 2 * math.pi * modes.frequencies == pytest.approx(omega, rel=1e-8)
    relative = [m.shape[1] / m.shape[0] for m in modes]
    assert relative == pytest.approx([math.sqrt(2) - 1, -math.sqrt(2) - 1], rel=1e-7)


@pytest.mark.parametrize("n", [1, 5])
def test_a_chain_of_masses_has_the_damped_frequencies_of_its_closed_form(tmp_path, n):
    k, m, c = 40.0, 2.0, 0.3
    modes = modes_of(tmp_path, chain(n, k, m, c))
    natural = 2 * math.sqrt(k / m) * np.sin(np.arange(1, n + 1) * math.pi / (2 * (n + 1)))
    ratio = natural * c / (2 * k)  # damping in proportion to stiffness
    assert [mode.natural_omega for mode in modes] == pytest.approx(natural, rel=1e-9)
    assert modes.damping_ratios == pytest.approx(ratio, rel=1e-8)
    assert 2 * math.pi * modes.frequencies == pytest.approx(natural * np.sqrt(1 - ratio**2), rel=1e-9)
    i = np.arange(1, n + 1)
    for number, mode in enumerate(modes, 1):
        sine = np.sin(number * i * math.pi / (n + 1)) * math.sqrt(2.0 / (m * (n + 1)))  # unit modal mass
        sine *= np.sign(sine[np.flatnonzero(np.abs(sine) > 0.999999 * np.abs(sine).max())[0]])
        np.testing.assert_allclose(mode.shape, sine, atol=1e-8)


def test_a_ball_joint_turns_about_each_axis_of_inertia(tmp_path):
    modes = modes_of(tmp_path, BALL)
    inertia = np.array([0.4, 0.3, 0.2])
    assert [m.natural_omega for m in modes] == pytest.approx(np.sqrt(3.0 / inertia), rel=1e-8)
    assert modes.damping_ratios == pytest.approx(0.02 / (2 * np.sqrt(3.0 * inertia)), rel=1e-7)
    assert [int(np.argmax(np.abs(m.shape))) for m in modes] == [2, 1, 0]
    moved = modes[0].displaced(amplitude=0.2)  # a turn by 0.2 rad about z
    np.testing.assert_allclose(np.abs(moved), [math.cos(0.1), 0, 0, math.sin(0.1)], atol=1e-8)


def test_a_pendulum_on_its_head_grows_and_decays_without_swinging(tmp_path):
    modes = modes_of(tmp_path, DOUBLE_PENDULUM, state=[math.pi, 0.0])
    rates = np.sqrt(np.array([2 - math.sqrt(2), 2 + math.sqrt(2)]) * G / LENGTH)
    assert modes.eigenvalues == pytest.approx([-rates[0], rates[0], -rates[1], rates[1]], rel=1e-8)
    assert [m.kind for m in modes] == ["decays", "grows"] * 2
    assert "2 of them grow; the equilibrium is unstable" in str(modes)


@pytest.mark.slow
def test_flutter_is_named_with_its_frequency_at_the_hopf_load():
    rods = mc.Mechanism.from_xml("ziegler_rods")
    hopf = mc.continue_equilibria(rods, "P", bounds=(1.4, 2.2), start={"P": 1.4}).point("HB1")
    slow = mc.modes(hopf)[0]
    assert slow.omega == pytest.approx(0.816496580927726, rel=1e-7)
    assert abs(slow.damping_ratio) < 1e-8
    beyond = mc.modes(mc.find_equilibrium(rods, {"P": 1.8}))
    assert [m.kind for m in beyond] == ["flutters", "oscillates"]


@pytest.mark.parametrize(
    ("name", "start"), [("overcentre", {"F": 30.0}), ("nose_gear", {"F_ret": 4e5}), ("ziegler_rods", {"P": 1.8})]
)
def test_eigenvalues_and_shapes_are_those_of_differences_of_the_accelerations(name, start):
    mechanism = mc.Mechanism.from_xml(name)
    rest = mc.find_equilibrium(mechanism, start)
    n, h = mechanism.n, 1e-4
    jac = np.zeros((2 * n, 2 * n))
    jac[:n, n:] = np.eye(n)
    for i in range(2 * n):
        for offset, weight in ((-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12)):
            step = np.zeros(2 * n)
            step[i] = offset * h
            state = mechanism.retract(rest.state, step[:n])
            jac[n:, i] += weight / h * mechanism.acceleration(state, step[n:], rest.parameters)
    values, vectors = eig(jac)
    for mode in mc.modes(rest):
        k = int(np.argmin(np.abs(values - mode.eigenvalue)))
        assert values[k] == pytest.approx(mode.eigenvalue, rel=1e-6)
        theirs = vectors[:n, k] / np.linalg.norm(vectors[:n, k])
        assert abs(np.vdot(theirs, mode.shape)) == pytest.approx(np.linalg.norm(mode.shape), rel=1e-8)


def test_a_vector_field_has_modes(tmp_path):
    spring = mc.VectorField(lambda u, p: np.array([u[1], -p["k"] * u[0] - 0.2 * u[1]]), [0.0, 0.0], {"k": 4.0})
    (mode,) = mc.modes(mc.find_equilibrium(spring, {"k": 4.0}))
    assert mode.natural_omega == pytest.approx(2.0, rel=1e-8)
    assert mode.damping_ratio == pytest.approx(0.05, rel=1e-7)


def test_a_motion_that_nothing_opposes_is_neutral(tmp_path):
    text = chain(1, 0.0, 2.0, 0.0)
    mode = modes_of(tmp_path, text)[0]
    assert mode.kind == "neutral"


def test_one_cycle_of_a_mode_closes_and_moves_with_its_speeds(tmp_path):
    mode = modes_of(tmp_path, chain(3, 40.0, 2.0, 0.3))[1]
    history = mode.history(401, amplitude=0.1)
    np.testing.assert_allclose(history.states[0], history.states[-1], atol=1e-12)
    assert history["time"][-1] == pytest.approx(1 / mode.frequency)
    assert np.abs(history.states).max() == pytest.approx(0.1, rel=1e-12)
    rates = np.gradient(history.states, history["time"], axis=0)
    np.testing.assert_allclose(rates[1:-1], history.velocities[1:-1], atol=1e-3 * np.abs(rates).max())


@pytest.mark.slow
def test_modes_are_drawn_animated_and_written(tmp_path):
    modes = mc.modes(mc.find_equilibrium(mc.Mechanism.from_xml("overcentre"), {"F": 30.0}))
    figure = modes.plot([1, 2])
    assert [ax.get_title(loc="left").split(":")[0] for ax in figure.axes] == ["mode 1", "mode 2"]
    assert mc.animate(modes[0], tmp_path / "mode.gif", seconds=0.2).stat().st_size > 1000
    lines = modes.to_csv(tmp_path / "modes.csv").read_text().splitlines()
    assert len(lines) == 1 + len(modes)


def test_what_is_no_equilibrium_has_no_modes():
    with pytest.raises(mc.MjcontError, match="point must be a Point, got the dict"):
        mc.modes({"F": 30.0})
    modes = mc.modes(mc.find_equilibrium(mc.Mechanism.from_xml("ziegler_rods"), {"P": 1.0}))
    with pytest.raises(mc.MjcontError, match="there is no mode 3: the modes of this equilibrium are 1 to 2"):
        modes.plot([3])
