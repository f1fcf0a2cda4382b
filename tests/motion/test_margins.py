"""Energy barriers between a rest and the pass that guards it, against closed forms."""

import math

import numpy as np
import pytest
from problems.pictures import lengths
from scipy.optimize import brentq

import mjcont as mc

K, L0, A = 1000.0, 1.25, 1.0
SNAP = 2.0 * K * L0 * (1.0 - (A / L0) ** (2.0 / 3.0)) ** 1.5
Z_SNAP = math.sqrt((A**2 * L0) ** (2.0 / 3.0) - A**2)
FP1 = 474766.687  # N, the nose gear's fold above overcentre, from hand-written energies


def load(z):
    return 2.0 * K * z * (L0 / math.hypot(A, z) - 1.0)


def energy(z, p):
    return K * (math.hypot(A, z) - L0) ** 2 + p * z


def closed_form(p):
    """Barrier of the truss in its upper rest: energies of the two roots of its load on either side of the fold."""
    rest = brentq(lambda z: load(z) - p, Z_SNAP, 0.9, xtol=1e-15)
    saddle = brentq(lambda z: load(z) - p, 0.0, Z_SNAP, xtol=1e-15)
    return energy(saddle, p) - energy(rest, p)


@pytest.fixture(scope="module")
def truss():
    return mc.continue_equilibria(mc.Mechanism.from_xml("von_mises_truss"), "P", bounds=(0.0, 300.0))


def upper(branch, p):
    return max((q for q in branch.at(P=p) if q.stability == "stable"), key=lambda q: q["z"])


@pytest.mark.parametrize("p", [10.0, 60.0, 100.0, 125.0])
def test_the_barrier_of_the_truss_is_that_of_the_closed_form(truss, p):
    barrier = mc.energy_barrier(upper(truss, p), truss)
    assert barrier.energy == pytest.approx(closed_form(p), rel=1e-8)
    assert barrier.saddle.n_unstable == 1


def test_the_descent_beyond_the_pass_ends_in_the_inverted_truss(truss):
    barrier = mc.energy_barrier(upper(truss, 100.0), truss)
    inverted = brentq(lambda z: load(z) - 100.0, -1.2, -0.75)
    assert barrier.beyond == pytest.approx([0.0, inverted], abs=1e-6)


@pytest.mark.slow
def test_a_search_finds_the_pass_that_a_branch_holds(truss):
    rest = upper(truss, 100.0)
    assert mc.energy_barrier(rest).energy == pytest.approx(closed_form(100.0), rel=1e-8)


def test_the_barrier_vanishes_with_the_power_three_halves_of_the_distance_to_the_fold(truss):
    distances = np.array([1e-2, 1e-3]) * SNAP
    found = [mc.energy_barrier(upper(truss, SNAP - d), truss).energy for d in distances]
    assert math.log10(found[0] / found[1]) == pytest.approx(1.5, abs=5e-3)
    # (4/3) sqrt(2 / |P''|) d^(3/2), from the cubic that the potential is at the fold
    bend = -6.0 * K * L0 * A**2 * Z_SNAP / math.hypot(A, Z_SNAP) ** 5
    assert found[1] == pytest.approx(4.0 / 3.0 * math.sqrt(2.0 / abs(bend)) * distances[1] ** 1.5, rel=5e-3)


@pytest.mark.slow
def test_the_barrier_falls_along_the_branch_to_zero_at_the_fold(truss):
    curve = mc.barrier_along(truss, search=False)
    on_top = curve.energy[[b.rest["z"] >= Z_SNAP - 1e-9 for b in curve.barriers]]
    loads = curve.values[[b.rest["z"] >= Z_SNAP - 1e-9 for b in curve.barriers]]
    assert loads[-1] == pytest.approx(SNAP)
    assert on_top[-1] == 0.0
    assert np.all(np.diff(on_top) < 0)
    inside = loads < SNAP - 1e-3
    assert on_top[inside] == pytest.approx([closed_form(p) if p else energy(0.0, 0.0) for p in loads[inside]], rel=1e-6)


@pytest.mark.slow
def test_barriers_lie_some_way_apart_whatever_the_rows(truss):
    curve = mc.barrier_along(truss, search=False)
    stable = np.flatnonzero((truss.stability == "stable") | np.char.startswith(truss.labels, "LP"))
    assert len(curve.rows) < 0.7 * len(stable)
    assert {truss.start_index, *(p.index for p in truss.of_kind("LP"))} <= set(curve.rows.tolist())
    assert curve.rows[[0, -1]].tolist() == stable[[0, -1]].tolist()


@pytest.mark.slow
def test_barriers_are_drawn_as_a_line_a_stable_piece_of_the_branch(truss):
    whole = mc.continue_equilibria(truss.problem, "P", bounds=(-300.0, 300.0))
    curve = mc.barrier_along(whole, search=False)
    assert list(np.unique(curve.pieces)) == [0, 1]  # upright and inverted
    for piece in (0, 1):
        heights = [b.rest["z"] for b, n in zip(curve.barriers, curve.pieces, strict=True) if n == piece]
        assert (min(heights) > 0.0) != (max(heights) < 0.0)
    ax = curve.plot()
    ax.figure.draw_without_rendering()
    drawn = [length for piece in ("stable piece 1", "stable piece 2") for length in lengths(ax, piece)]
    assert len(drawn) == 2
    assert min(drawn) > 0.3 * ax.bbox.width
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["stable piece 1", "stable piece 2"]


@pytest.mark.slow
def test_a_pendulum_turns_over_past_a_barrier_of_twice_its_weight_times_length(pendulum_xml):
    pendulum = mc.Mechanism.from_xml(pendulum_xml(joint='damping="0.1"'))
    rest = mc.find_equilibrium(pendulum, state=[math.pi])
    barrier = mc.energy_barrier(rest)
    assert barrier.energy == pytest.approx(2.0 * 9.81)
    assert barrier.message.endswith("full turns apart")


@pytest.mark.long
def test_the_gear_above_overcentre_is_guarded_by_less_and_less_up_to_fp1():
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 6e5), start={"F_ret": 4e5}, keyframe="uplock_above")
    curve = mc.barrier_along(branch, search=False)
    stable = np.array([b.rest["theta_ov"] > 0 for b in curve.barriers])
    assert curve.values[stable][-1] == pytest.approx(FP1, abs=1e-3)
    energies = curve.energy[stable]
    assert energies[-1] == 0.0
    assert np.all(energies[:-1] > 0)
    near = (curve.values[stable] > 0.97 * FP1) & (energies > 0)
    slope = np.polyfit(np.log(FP1 - curve.values[stable][near]), np.log(energies[near]), 1)[0]
    assert slope == pytest.approx(1.5, abs=0.1)


@pytest.mark.long
def test_the_map_of_the_gear_agrees_with_single_barriers_and_ends_where_the_rest_does():
    gear = mc.Mechanism.from_xml("nose_gear")
    rest = mc.find_equilibrium(gear, {"F_ret": 4e5, "F_ul": 0.0}, keyframe="uplock_below")
    grid = {"F_ret": [4e5, 4.4e5, 4.9e5], "F_ul": [-500.0, -300.0, 0.0]}
    found = mc.barrier_map(rest, grid)
    assert np.isnan(found.energy[0, 2])  # beyond FP1 under the unlock force of -500 N
    for j, f_ul in enumerate(found.y):
        point = mc.find_equilibrium(gear, {"F_ret": 4e5, "F_ul": f_ul}, keyframe="uplock_below")
        assert found.energy[j, 0] == pytest.approx(mc.energy_barrier(point).energy, rel=1e-6)


@pytest.mark.slow
def test_a_follower_force_has_no_energy_barrier():
    gear = mc.Mechanism.from_xml("nose_gear_full")
    rest = mc.find_equilibrium(gear, {"F_ret": 10.0})
    with pytest.raises(mc.MjcontError, match="no potential: a force that follows the motion"):
        mc.energy_barrier(rest)


def test_a_vector_field_has_no_energy_barrier():
    field = mc.VectorField(lambda u, p: [p["a"] - u[0]], [0.0], {"a": 0.0})
    with pytest.raises(mc.MjcontError, match="a vector field has no potential energy"):
        mc.energy_barrier(mc.find_equilibrium(field))


def test_an_unstable_point_is_no_rest(truss):
    pass_ = next(p for p in truss.at(P=100.0) if p.n_unstable)
    with pytest.raises(mc.MjcontError, match="this point is unstable"):
        mc.energy_barrier(pass_)


def test_a_pass_at_another_load_is_refused(truss):
    pass_ = next(p for p in truss.at(P=90.0) if p.n_unstable)
    with pytest.raises(mc.ParameterError, match="their loads must agree"):
        mc.energy_barrier(upper(truss, 100.0), pass_)


def test_a_map_needs_two_parameters(truss):
    with pytest.raises(mc.ParameterError, match="two parameters"):
        mc.barrier_map(upper(truss, 100.0), {"P": [0.0, 1.0]})
