"""Long steps and the points inside: as true as those reached one by one, and nothing between is missed."""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
from problems import reference
from problems.marks import long
from problems.mechanisms import branch_of, column, scaled
from problems.reference import BOUNDS, START

import mjcont as mc
from mjcont.numerics.spectra.spectrum import quadratic_eigenvalues

SPACING = {"ds_max": 0.05, "angle": math.radians(5.0)}


# -- the points ----------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("k_j", [1e3, 1e6])
def test_every_point_balances_the_forces_written_by_hand(k_j):
    branch = branch_of("overcentre", k_j=k_j)
    for q, load in zip(branch.states, branch["F"], strict=True):
        found = reference.forces(q, {**branch.fixed, "F": load})
        assert np.abs(found).max() < 1e-9 + 1e-15 * k_j


@pytest.mark.slow
@pytest.mark.parametrize("k_j", [1e3, 1e6])
def test_points_lie_as_close_as_the_steps_ask(k_j):
    chords = np.diff(scaled(branch_of("overcentre", math.inf, k_j)), axis=0)
    lengths = np.linalg.norm(chords, axis=1)
    assert lengths.max() < 1.15 * SPACING["ds_max"]
    chords = chords[lengths > 1e-4] / lengths[lengths > 1e-4, None]
    assert np.arccos(np.min(np.sum(chords[1:] * chords[:-1], axis=1))) < 3.0 * SPACING["angle"]


@pytest.mark.slow
@pytest.mark.parametrize(("model", "parameter"), [("overcentre", "F"), ("nose_gear", "F_ret")])
def test_steps_filled_together_lead_to_the_curve_of_steps_filled_one_by_one(model, parameter, monkeypatch):
    together = branch_of(model, math.inf)
    monkeypatch.setattr("mjcont.numerics.walk.filled._AHEAD", 0)
    values = {p: together.parameters_at(together.start_index)[p] for p in together.problem.parameters}
    start, bounds = together.states[together.start_index], together.free[parameter]
    alone = mc.continue_equilibria(together.problem, parameter, bounds, values, state=start, chord=math.inf)
    assert [p.label for p in alone.special_points] == [p.label for p in together.special_points]
    for a, b in zip(alone.special_points, together.special_points, strict=True):
        assert a.state == pytest.approx(b.state, abs=1e-8)
    assert alone.ends == together.ends
    assert 0.8 < len(alone) / len(together) < 1.25


# -- stability and eigenvalues --------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full"])
def test_stability_is_that_of_the_eigenvalues_at_every_tenth_point(model):
    branch = branch_of(model)
    name = next(iter(branch.free))
    for i in range(0, len(branch), 10):
        values = {**branch.fixed, name: branch[name][i]}
        problem, x = branch.problem, branch.states[i]
        pencil = problem.pencil(x, values, problem.linearize(x, values, ()).jac)
        real = quadratic_eigenvalues(pencil.mass, pencil.damping, pencil.stiffness).real
        if branch.stability[i] != "marginal" and np.abs(real).min() > 1e-6:
            assert branch.n_unstable[i] == np.count_nonzero(real > 0)
            assert branch.stability[i] == ("unstable" if np.any(real > 0) else "stable")


@pytest.mark.slow
def test_eigenvalues_read_late_are_those_of_the_points():
    branch = branch_of("overcentre")
    for i in range(0, len(branch), 25):
        values = {**branch.fixed, "F": branch["F"][i]}
        jac = branch.problem.linearize(branch.states[i], values, ()).jac
        pencil = branch.problem.pencil(branch.states[i], values, jac)
        expected = quadratic_eigenvalues(pencil.mass, pencil.damping, pencil.stiffness)
        distance = np.abs(branch.eigenvalues[i][:, None] - expected)
        matched = scipy.optimize.linear_sum_assignment(distance)
        assert distance[matched].max() < 1e-7 * np.abs(expected).max()


# -- nothing is missed -----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("force", [-411.7, *map(long, (-411.8, -411.806)), -411.8079])
def test_two_folds_close_to_their_cusp_are_both_found(force):
    gear = mc.Mechanism.from_xml("nose_gear")
    start = {"F_ret": 4e5, "F_ul": force, "gravity_angle": 0.0}
    kinds, places = [], []
    for options in ({}, {"ds_max": 0.01}):
        branch = mc.continue_equilibria(gear, "F_ret", (0.0, 8e5), start, keyframe="uplock_above", **options)
        kinds.append([p.kind for p in branch.special_points])
        places.append(sorted(p["F_ret"] for p in branch.special_points))
    assert kinds[0] == kinds[1]
    assert places[0] == pytest.approx(places[1], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("start", "ds_max"), [(382736.1, 0.04172445), (427981.5, 0.02848422), (371706.8, 0.04431817), (4e5, 0.01)]
)
def test_a_pair_of_folds_is_found_wherever_the_points_beside_it_lie(start, ds_max):
    """A point 1e-3 beyond the pair, where the slope is small: the cubic from the point before has its least there."""
    gear = mc.Mechanism.from_xml("nose_gear")
    values = {"F_ret": start, "F_ul": -411.8079, "gravity_angle": 0.0}
    branch = mc.continue_equilibria(gear, "F_ret", (0.0, 8e5), values, keyframe="uplock_above", ds_max=ds_max)
    assert [p.kind for p in branch.special_points] == ["LP"] * 3


def slide(stiffness):
    """Return a mass on a slide between a spring and a slanting tendon: P = K z + 100 z (1 - 1.2 / r)."""
    return mc.Mechanism.from_xml(
        '<mujoco><option gravity="0 0 0"/><worldbody><site name="l" pos="-1 0 0"/><body><joint name="z" type="slide" '
        f'axis="0 0 1" stiffness="{stiffness}" damping="1"/><geom size=".1" mass="1"/><site name="s"/></body>'
        '</worldbody><tendon><spatial stiffness="100" springlength="1.2"><site site="l"/><site site="s"/></spatial>'
        '</tendon><actuator><motor name="P" joint="z"/></actuator></mujoco>'
    )


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [19.99, 20.0, 20.001, 20.01])
def test_a_first_step_without_points_inside_may_be_refused(stiffness):
    """K = 20 has a cusp at z = 0; the curve is known in closed form on both sides of it."""
    mechanism = slide(stiffness)
    for start in (-40.0, -10.0, 5.0, 35.0):
        branch = mc.continue_equilibria(mechanism, "P", bounds=(-50.0, 50.0), start={"P": start})
        z = branch.states[:, 0]
        load = stiffness * z + 100.0 * z * (1.0 - 1.2 / np.hypot(1.0, z))
        assert branch["P"] == pytest.approx(load, abs=1e-9)
        assert len(branch.of_kind("LP")) == (2 if stiffness < 20.0 else 0)


@pytest.mark.slow
@pytest.mark.parametrize("links", [2, 4, 7])
def test_all_buckling_loads_within_one_long_step_are_found(links):
    """Along the straight column K is affine in P, so the loads are eigenvalues of a pencil (no step is involved)."""
    mechanism = column(links)
    x = mechanism.start_state()
    free, loaded = (-mechanism.linearize(x, mechanism.values({"P": p}), ()).jac for p in (0.0, 1.0))
    loads = np.sort(1.0 / scipy.linalg.eigvalsh(free - loaded, free))
    bound = 1.1 * loads[-1]
    branch = mc.continue_equilibria(mechanism, "P", (0.0, bound), direction=1)
    assert [p["P"] for p in branch.of_kind("BP")] == pytest.approx(loads, rel=1e-8)
    assert [p.kind for p in branch.special_points] == ["BP"] * links
    assert branch.n_unstable[-1] == links


# -- driven from outside ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_user_s_stop_is_asked_at_every_point():
    seen = []

    def stop(point):
        seen.append(point["F"])
        return "far enough" if abs(point["F"]) < 10.0 else None

    branch = mc.continue_equilibria(
        mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START}, direction=-1, stop=stop, chord=math.inf
    )
    regular = [f for f, label in zip(branch["F"], branch.labels, strict=True) if not label]
    assert sorted(seen) == pytest.approx(sorted(regular), abs=0.0)
    assert branch.status == "stopped"


@pytest.mark.parametrize("most", [2, 7, 20, 33])
def test_the_limit_of_points_counts_those_inside_steps(most):
    branch = mc.continue_equilibria(
        mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START}, direction=-1, max_points=most, chord=math.inf
    )
    assert branch.status == "max points"
    assert len(branch) - len(branch.special_points) == most


@pytest.mark.slow
def test_the_iterator_yields_the_points_of_the_branch():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", BOUNDS, {"F": START}, direction=-1, chord=math.inf)
    points = list(mc.iterate_equilibria(mechanism, "F", BOUNDS, {"F": START}, direction=-1))
    assert [p["F"] for p in points] == pytest.approx(branch["F"][::-1], abs=1e-12)


@pytest.mark.slow
def test_user_zeros_inside_long_steps_are_located():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", BOUNDS, {"F": START}, zeros={"theta_1": 0.1})
    assert np.all(np.diff(branch["theta_1"]) > 0)  # passed once, then
    (found,) = branch.of_kind("UZ")
    assert found["theta_1"] == pytest.approx(0.1, abs=1e-10)


# -- what makes it cheap --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_observables_read_side_by_side_are_those_read_one_by_one():
    branch = branch_of("nose_gear")
    values = [{**branch.fixed, "F_ret": f} for f in branch["F_ret"]]
    one_by_one = branch.problem.measure(branch.states, values)
    together = branch.problem.measure_along(branch.states, values[0], {"F_ret": branch["F_ret"]})
    assert together == pytest.approx(one_by_one, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full"])
def test_the_damping_matrix_of_the_dampers_is_that_of_differences(model):
    branch = branch_of(model)
    problem, name = branch.problem, next(iter(branch.free))
    for i in (0, len(branch) // 2):
        x, values = branch.states[i], {**branch.fixed, name: branch[name][i]}
        found = problem.pencil(x, values, np.zeros((problem.n, problem.n))).damping
        steps = np.zeros((2 * problem.n, 2 * problem.n))
        steps[: problem.n, problem.n :] = np.eye(problem.n)
        steps[problem.n :, problem.n :] = -np.eye(problem.n)
        rows = problem.first_order(x, values, steps)[:, problem.n :]
        mass = problem.pencil(x, values, np.zeros((problem.n, problem.n))).mass
        expected = -mass @ ((rows[: problem.n] - rows[problem.n :]) / 2.0).T
        assert found == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())
