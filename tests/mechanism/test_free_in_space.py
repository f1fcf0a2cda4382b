"""Models that float in space: rigid-body modes are named, held, and spoil neither folds nor stability."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mjcont as mc

RIGID_MODES = [f"{kind} {axis}" for kind in ("translation along", "rotation about") for axis in "xyz"]


def truss(joint):
    """The truss of von Mises (a = 1, L0 = 1.25, k = 1000) on a base with or without a joint to the ground."""
    return f"""
    <mujoco model="truss">
      <option gravity="0 0 0"/>
      <statistic extent="1"/>
      <worldbody>
        <body name="base">
          {joint}
          <inertial pos="0 0 0" mass="3" diaginertia="1 2 2.5"/>
          <site name="left" pos="-1 0 0"/>
          <site name="right" pos="1 0 0"/>
          <body name="apex" pos="0 0 0.75">
            <joint name="x" type="slide" axis="1 0 0" damping="5"/>
            <joint name="z" type="slide" axis="0 0 1" damping="5" ref="0.75"/>
            <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.1"/>
            <site name="apex"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <spatial name="bar_left" stiffness="1000" springlength="1.25"><site site="left"/><site site="apex"/></spatial>
        <spatial name="bar_right" stiffness="1000" springlength="1.25"><site site="right"/><site site="apex"/></spatial>
      </tendon>
      <actuator><general name="P" joint="z" gear="-1"/></actuator>
    </mujoco>"""


def hexapod(joint):
    """Two bodies joined by six springs of different stiffness, pressed together along a seventh line by P."""
    low = np.radians([0, 110, 130, 235, 250, 355])
    high = np.radians([40, 75, 160, 200, 285, 320])
    lower = np.column_stack([np.cos(low), np.sin(low), np.zeros(6)])
    upper = np.column_stack([0.6 * np.cos(high), 0.6 * np.sin(high), -0.05 * np.arange(6)])
    rest = np.linalg.norm(upper + [0.0, 0.0, 0.5] - lower, axis=1)

    def sites(name, points):
        return "".join(f'<site name="{name}{i}" pos="{x} {y} {z}"/>' for i, (x, y, z) in enumerate(points))

    legs = "".join(
        f'<spatial name="leg_{i}" stiffness="{200 + 20 * i}" springlength="{rest[i]}" damping="3">'
        f'<site site="lower{i}"/><site site="upper{i}"/></spatial>'
        for i in range(6)
    )
    return f"""
    <mujoco model="hexapod">
      <option gravity="0 0 0"/>
      <statistic extent="1"/>
      <worldbody>
        <body name="lower">
          {joint}<inertial pos="0 0 0" mass="3" diaginertia="1 1.2 1.5"/>
          <site name="eye" pos="0 0 -0.5"/>{sites("lower", lower)}
        </body>
        <body name="upper" pos="0 0 0.5">
          <joint name="upper" type="free"/><inertial pos="0 0 0" mass="1" diaginertia="0.3 0.4 0.5"/>
          <site name="load" pos="0.05 0.1 0"/>{sites("upper", upper)}
        </body>
      </worldbody>
      <tendon>{legs}<spatial name="press"><site site="eye"/><site site="load"/></spatial></tendon>
      <actuator><general name="P" tendon="press" gear="-1"/></actuator>
      <sensor><framepos name="gap" objtype="body" objname="upper" reftype="body" refname="lower"/></sensor>
    </mujoco>"""


FREE = '<joint name="base" type="free"/>'
MODELS = {"truss": (truss, 300.0), "hexapod": (hexapod, 20.0)}


@pytest.fixture(scope="module", params=MODELS)
def pair(request):
    """A mechanism's branch in P held to the ground, and free in space."""
    model, bound = MODELS[request.param]
    return [
        mc.continue_equilibria(mc.Mechanism.from_xml(model(joint)), "P", bounds=(-bound, bound)) for joint in ("", FREE)
    ]


def test_the_zero_modes_of_a_free_mechanism_are_held_and_named(pair):
    held, free = pair
    assert not held.notes
    assert free.notes == (f"rigid-body zero modes held: {', '.join(RIGID_MODES)}",)


def test_a_free_mechanism_has_its_folds_at_the_loads_of_the_held_one(pair):
    held, free = pair
    assert [p.label for p in free.special_points] == [p.label for p in held.special_points]
    assert held.of_kind("LP")
    for a, b in zip(free.special_points, held.special_points, strict=True):
        assert a["P"] == pytest.approx(b["P"], rel=1e-9)


def test_a_free_mechanism_is_as_stable_as_the_held_one(pair):
    held, free = pair
    for a, b in zip(free.at(P=3.0), held.at(P=3.0), strict=True):
        assert (a.stability, a.n_unstable) == (b.stability, b.n_unstable)


def test_a_free_mechanism_has_the_internal_state_of_the_held_one(pair):
    held, free = pair
    names = [n for n in free.columns if n.startswith("gap") or n in ("x", "z")]
    assert names
    for a, b in zip(free.at(P=3.0), held.at(P=3.0), strict=True):
        assert [a[n] for n in names] == pytest.approx([b[n] for n in names], abs=1e-9)


@pytest.mark.slow
def test_a_free_truss_snaps_at_the_load_of_the_closed_form():
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(truss(FREE)), "P", bounds=(-300.0, 300.0))
    snap = 2.0 * 1000.0 * 1.25 * (1.0 - 0.8 ** (2.0 / 3.0)) ** 1.5
    assert [p["P"] for p in branch.of_kind("LP")] == pytest.approx([snap, -snap], rel=1e-10)


@pytest.mark.slow
def test_where_a_free_mechanism_starts_in_space_makes_no_difference():
    mechanism = mc.Mechanism.from_xml(truss(FREE))
    quat = np.array([0.5, -0.1, 0.7, 0.5])
    state = np.concatenate([[0.4, -2.0, 1.0], quat / np.linalg.norm(quat), [0.0, 0.75]])
    here = mc.continue_equilibria(mechanism, "P", bounds=(-300.0, 300.0))
    there = mc.continue_equilibria(mechanism, "P", bounds=(-300.0, 300.0), state=state)
    assert there.notes == here.notes
    assert [p["P"] for p in there.of_kind("LP")] == pytest.approx([p["P"] for p in here.of_kind("LP")], rel=1e-9)


@pytest.mark.slow
def test_the_stability_of_a_free_mechanism_changes_at_its_folds_and_nowhere_else():
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(hexapod(FREE)), "P", bounds=(-20.0, 20.0))
    for i in range(1, len(branch)):
        if not (branch.labels[i] or branch.labels[i - 1]):
            assert branch.n_unstable[i] == branch.n_unstable[i - 1]
    for p in branch.of_kind("LP"):
        before, after = branch["P"][p.index - 1], branch["P"][p.index + 1]
        assert (before - p["P"]) * (after - p["P"]) > 0


@pytest.mark.slow
def test_a_fold_of_a_free_mechanism_can_be_followed_from_a_file(tmp_path):
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(truss(FREE)), "P", bounds=(-300.0, 300.0))
    again = mc.load(branch.save(tmp_path / "truss.h5"))
    assert [p.stability for p in again.at(P=50.0)] == [p.stability for p in branch.at(P=50.0)]
    locus = mc.continue_special(again.point("LP1"), "tendon:bar_*.springlength", bounds=(1.1, 1.4))
    assert locus.status == "at bound"


TWO_MASSES = """
<mujoco model="two_masses">
  <option gravity="0 0 0"/>
  <statistic extent="1"/>
  <worldbody>
    <body name="a">
      <joint name="a" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
    </body>
    <body name="b" pos="1 0 0">
      <joint name="b" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="4" diaginertia="1 1 1"/>
    </body>
  </worldbody>
  <tendon>
    <fixed name="spring" stiffness="100" damping="0.5" springlength="0">
      <joint joint="a" coef="-1"/><joint joint="b" coef="1"/>
    </fixed>
  </tendon>
  <actuator><general name="T" tendon="spring"/><general name="F" joint="a"/></actuator>
</mujoco>"""


def test_two_masses_on_a_spring_part_by_the_load_over_the_stiffness():
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(TWO_MASSES), "T", bounds=(-1.0, 1.0))
    assert branch.notes == ("rigid-body zero modes held: translation along x",)
    assert branch["b"] - branch["a"] == pytest.approx(branch["T"] / 100.0, abs=1e-12)
    assert set(branch.stability) == {"stable"}


def test_two_masses_on_a_spring_vibrate_with_the_reduced_mass():
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(TWO_MASSES), "T", bounds=(-1.0, 1.0))
    reduced = 1.0 * 4.0 / 5.0
    rate = -0.5 / (2.0 * reduced) + 1j * math.sqrt(100.0 / reduced - (0.5 / (2.0 * reduced)) ** 2)
    assert np.abs(branch.eigenvalues[0] - rate).min() < 1e-6


def test_undamped_a_vibration_of_two_masses_is_marginal():
    undamped = TWO_MASSES.replace('damping="0.5" ', "")
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(undamped), "T", bounds=(-1.0, 1.0))
    assert set(branch.stability) == {"marginal"}


def test_a_load_that_pushes_a_free_mechanism_away_has_no_equilibria():
    mechanism = mc.Mechanism.from_xml(TWO_MASSES)
    with pytest.raises(mc.StartError, match="F pushes along the rigid-body mode 'translation along x'"):
        mc.continue_equilibria(mechanism, "F", bounds=(-1.0, 1.0))
