"""Models of many degrees of freedom: forces in stages, and sparse matrices by their structure."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from problems.nets import Net

import mjcont as mc
from mjcont.mechanism.large.couplings import couplings
from mjcont.mechanism.large.stages import Stages

SMOOTH = ("overcentre", "nose_gear", "nose_gear_full", "buckling_column", "ziegler_rods", "tethered_body")


@pytest.fixture(scope="module")
def net():
    return Net(10, 12)


@pytest.fixture(scope="module")
def woven(net):
    return mc.Mechanism.from_xml(net.xml())


@pytest.fixture
def small_ones_are_sparse(monkeypatch):
    monkeypatch.setattr("mjcont.mechanism.large.couplings.MANY", 10)
    monkeypatch.setattr("mjcont.mechanism.large.couplings._PART", 0.5)


def some_state(mechanism, size=0.2, seed=1):
    step = size * np.random.default_rng(seed).normal(size=mechanism.n) * mechanism.state_scale
    return mechanism.retract(mechanism.qpos0, step)


def evaluated(mechanism):
    """A core of the mechanism, and MuJoCo's data after its own forward dynamics at a moving state."""
    core, x = mechanism._core, some_state(mechanism)
    core.writer.write(mechanism.parameters, mechanism.values())
    data = mujoco.MjData(core.model)
    core.writer.inputs.put(data)
    data.qpos[:], data.qvel[:] = x, np.cos(np.arange(mechanism.n))
    mujoco.mj_forward(core.model, data)
    return core, data


@pytest.mark.parametrize("name", SMOOTH)
def test_forces_in_stages_are_those_of_the_forward_dynamics_to_the_bit(name):
    core, data = evaluated(mc.Mechanism.from_xml(name))
    found = Stages(core.model).forces(data.qpos[None], data.qvel[None], core.writer)[0]
    assert np.array_equal(found, data.qfrc_smooth)


@pytest.mark.parametrize("name", SMOOTH)
def test_a_motion_leaves_what_the_inverse_dynamics_ask_for(name):
    core, data = evaluated(mc.Mechanism.from_xml(name))
    data.qacc[:] = np.sin(np.arange(core.model.nv))
    found = Stages(core.model).forces(data.qpos[None], data.qvel[None], core.writer, qacc=data.qacc[None])[0]
    mujoco.mj_inverse(core.model, data)
    assert found == pytest.approx(data.qfrc_actuator - data.qfrc_inverse, abs=1e-12 * np.abs(data.qfrc_inverse).max())


def test_a_model_that_moves_as_its_forces_ask_leaves_none():
    mechanism = mc.Mechanism.from_xml("overcentre")
    values, x = mechanism.values(), some_state(mechanism)
    speed = np.cos(np.arange(mechanism.n))
    pull = mechanism.acceleration(x, speed, values)
    left = mechanism.left_forces(x, values, np.zeros((1, mechanism.n)), speed[None], pull[None])
    assert np.abs(left).max() < 1e-9 * np.abs(mechanism.residual(x, values)).max()


# -- structure ----------------------------------------------------------------------------------------------------


def test_stiffness_of_a_net_is_that_of_its_springs_in_a_few_evaluations(net, woven):
    x, before = some_state(woven, 0.02), woven.evaluations
    found = woven.linearize(x, woven.values(), (), accurate=True)
    assert woven.evaluations - before < 150
    expected = net.stiffness(x)
    assert np.abs(found.jac.toarray() + expected).max() < 1e-8 * np.abs(expected).max()
    assert found.f == pytest.approx(net.forces(x), abs=1e-11 * np.abs(net.forces(x)).max())


@pytest.mark.slow
def test_mass_and_damping_of_a_net_are_sparse_and_those_of_its_parts(net, woven):
    x = some_state(woven, 0.02)
    pencil = woven.pencil(x, woven.values(), woven.linearize(x, woven.values(), ()).jac)
    assert pencil.mass.toarray() == pytest.approx(net.mass * np.eye(woven.n), rel=1e-12)
    assert np.abs(pencil.damping.toarray() - net.dampers(x)).max() < 1e-12


def branching(seed):
    """Random trees of hinges, slides and balls, tied by tendons, with actuators of all sorts."""
    rng = np.random.default_rng(seed)
    bodies, joints, sites = [], [], []
    for tree in range(40):
        text = ""
        for link in reversed(range(int(rng.integers(1, 5)))):
            name, kind = f"{tree}_{link}", str(rng.choice(["hinge", "slide", "ball"]))
            axis = "" if kind == "ball" else f' axis="{" ".join(map(str, rng.normal(size=3)))}"'
            joints += [] if kind == "ball" else [name]
            sites.append(name)
            text = (
                f'<body pos="{rng.normal()} {rng.normal()} {0.2 + rng.random()}">'
                f'<joint name="j{name}" type="{kind}"{axis} stiffness="{rng.random()}" damping="0.1"/>'
                f'<geom type="capsule" fromto="0 0 0 0.1 0 0.3" size="0.02"/><site name="s{name}" pos="0.1 0 0.3"/>'
                f"{text}</body>"
            )
        bodies.append(text)
    parts = []
    for i in range(25):
        a, b = rng.choice(sites, 2, replace=False)
        string = f'<site site="s{a}"/><site site="s{b}"/>'
        parts.append(f'<spatial name="t{i}" stiffness="20" springlength="0.1">{string}</spatial>')
    for i in range(10):
        a, b = rng.choice(joints, 2, replace=False)
        sums = f'<joint joint="j{a}" coef="1"/><joint joint="j{b}" coef="-2"/>'
        parts.append(f'<fixed name="f{i}" stiffness="5">{sums}</fixed>')
    pulls = ['<motor tendon="t3"/><position tendon="f2" kp="4"/>', f'<motor joint="j{joints[3]}"/>']
    for _ in range(10):
        a, b = rng.choice(sites, 2, replace=False)
        law = 'gear="1 2 0 0 0 1" biastype="affine" biasprm="1 -3 -1"'
        pulls.append(f'<general site="s{a}" refsite="s{b}" {law}/><motor site="s{b}" gear="0 0 1 0 0 0"/>')
    return (
        f'<mujoco><option><flag contact="disable"/></option><worldbody>{"".join(bodies)}</worldbody>'
        f"<tendon>{''.join(parts)}</tendon><actuator>{''.join(pulls)}</actuator></mujoco>"
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_nothing_acts_on_what_the_structure_leaves_out(seed, small_ones_are_sparse, monkeypatch):
    thin = mc.Mechanism.from_xml(branching(seed))
    monkeypatch.setattr("mjcont.mechanism.large.couplings.MANY", 300)
    full, x = thin.copy(), some_state(thin)
    values = {**full.values(), **{n: 0.3 for n, p in full.parameters.items() if p.kind == "control"}}
    found, expected = (m.linearize(x, values, ()).jac for m in (thin, full))
    assert isinstance(expected, np.ndarray) and found.nnz < 0.5 * full.n**2
    assert np.abs(found.toarray() - expected).max() < 1e-7 * np.abs(expected).max()
    pencil, whole = thin.pencil(x, values, found), full.pencil(x, values, expected)
    for name in ("mass", "damping"):
        assert getattr(pencil, name).toarray() == pytest.approx(getattr(whole, name), abs=1e-12)


def test_a_chain_is_full():
    links = '<body pos="0 0 0.1"><joint/><geom size="0.01"/>' * 320 + "</body>" * 320
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{links}</worldbody></mujoco>")
    assert couplings(model) is None


# -- contacts -----------------------------------------------------------------------------------------------------


def test_masses_that_could_touch_but_do_not_leave_matrices_as_they_are(small_ones_are_sparse):
    net = Net(4, 5)
    apart, touching = (mc.Mechanism.from_xml(net.xml(contact)) for contact in ("disable", "enable"))
    assert touching.constrained
    (a, before), (b, _) = ((m.linearize(apart.qpos0, m.values(), ()), m.evaluations) for m in (apart, touching))
    assert np.abs((a.jac - b.jac).toarray()).max() < 1e-9 * np.abs(a.jac).max()
    assert before < 2 * apart.n
    pencils = [m.pencil(apart.qpos0, m.values(), found.jac) for m, found in ((apart, a), (touching, b))]
    for name in ("mass", "damping"):
        one, other = (getattr(p, name).toarray() for p in pencils)
        assert np.array_equal(one, other)


@pytest.mark.slow
def test_masses_that_touch_act_on_each_other(small_ones_are_sparse, monkeypatch):
    net = Net(4, 5, rest=0.01)
    thin = mc.Mechanism.from_xml(net.xml("enable"))
    monkeypatch.setattr("mjcont.mechanism.large.couplings.MANY", 300)
    full = mc.Mechanism.from_xml(net.xml("enable"))
    x = full.qpos0.copy()
    x[0] += net.width - 0.008  # the first mass overlaps the one beside it by 2 mm
    assert full.active(x, full.values())
    found, expected = (m.linearize(x, m.values(), ()).jac for m in (thin, full))
    assert isinstance(expected, np.ndarray) and np.array_equal(found.toarray(), expected)
    pencil, whole = thin.pencil(x, thin.values(), found), full.pencil(x, full.values(), expected)
    assert np.array_equal(pencil.damping.toarray(), whole.damping)
