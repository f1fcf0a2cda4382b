"""Searches for every equilibrium at given parameters, against counts and values known beforehand."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import mjcont as mc
from mjcont.curves.search import find_equilibria
from mjcont.mechanism.energy import potential_energy
from mjcont.numerics.search.deflation import Deflation

_TURN = 2.0 * math.pi


def stages(count, coupling=0.0):
    """Return `count` bistable stages in a row: slides with spring force x - x^3, linear springs between neighbours."""
    bodies = "".join(
        f'<body name="stage{i}" pos="0 {i} 0"><joint name="x{i}" type="slide" axis="1 0 0" stiffness="-1 0 1" '
        'damping="1"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>'
        for i in range(count)
    )
    springs = "".join(
        f'<fixed stiffness="{coupling}" springlength="0"><joint joint="x{i}" coef="1"/>'
        f'<joint joint="x{i + 1}" coef="-1"/></fixed>'
        for i in range(count - 1)
    )
    return mc.Mechanism.from_xml(
        f'<mujoco model="stages"><option gravity="0 0 0"/><worldbody>{bodies}</worldbody>'
        f"<tendon>{springs}</tendon></mujoco>"
    )


def cubes(count):
    """Return `count` copies of x' = x - x^3."""
    return mc.VectorField(lambda u, p: p["a"] * u - u**3, np.zeros(count), {"a": 1.0})


def gear_with_gaps():
    gear = mc.Mechanism.from_xml("nose_gear")

    def gap(a, b):
        return lambda model, data: float(np.linalg.norm(data.site(a).xpos - data.site(b).xpos))

    gear.observe("gap_C", gap("C_1", "C_3"), "m")
    gear.observe("gap_H", gap("H_1", "H_5"), "m")
    return gear


CLOSED = {"gap_C": (0.0, 0.05), "gap_H": (0.0, 0.05)}


@pytest.fixture(scope="module")
def gear_search():
    return find_equilibria(gear_with_gaps(), {"F_ret": 4e5}, region=CLOSED)


# -- the nose gear ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_nose_gear_at_400_kN_has_ten_equilibria_with_closed_pins(gear_search):
    assert len(gear_search) == 10
    assert sorted(p.n_unstable for p in gear_search) == [0] * 5 + [1] * 5
    assert max(gear_search.column("gap_C").max(), gear_search.column("gap_H").max()) < 0.05


@pytest.mark.slow
def test_its_equilibria_with_torn_pins_are_counted_but_not_listed(gear_search):
    assert gear_search.account.everywhere == 64
    assert "10 equilibria found in the region (64 in all)" in gear_search.status


@pytest.mark.slow
def test_indices_of_the_gears_equilibria_add_up_to_zero(gear_search):
    assert gear_search.account.index_sum == 0


@pytest.mark.slow
def test_every_listed_equilibrium_of_the_gear_is_at_rest(gear_search):
    gear = gear_search[0].problem
    for p in gear_search:
        assert np.abs(gear.acceleration(p.state, np.zeros(gear.n), p.parameters)).max() < 1e-5


@pytest.mark.slow
def test_the_search_finds_what_the_uplock_keyframe_flows_to(gear_search):
    point = mc.find_equilibrium(gear_search[0].problem, {"F_ret": 4e5}, keyframe="uplock_above")
    turns = (gear_search[0].problem.difference(p.state, point.state) / _TURN for p in gear_search)
    assert min(np.abs(t - np.round(t)).max() for t in turns) < 1e-7


@pytest.mark.slow
@pytest.mark.long
def test_the_same_seed_gives_the_same_list_to_the_bit(gear_search):
    again = find_equilibria(gear_with_gaps(), {"F_ret": 4e5}, region=CLOSED)
    assert np.array_equal([p.state for p in again], [p.state for p in gear_search])


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("seed", [1, *(pytest.param(s, marks=pytest.mark.long) for s in (2, 3, 4))])
def test_another_seed_gives_the_same_equilibria_of_the_gear(gear_search, seed):
    other = find_equilibria(gear_with_gaps(), {"F_ret": 4e5}, region=CLOSED, seed=seed)
    assert np.abs(np.array([p.state for p in other]) - [p.state for p in gear_search]).max() < 1e-9


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_bushes_of_1e10_newton_a_metre_hide_no_equilibrium_of_the_gear_unless_the_index_sum_says_so(seed):
    found = find_equilibria(gear_with_gaps(), {"F_ret": 4e5, "k_j": 1e10}, region=CLOSED, seed=seed)
    assert (len(found) == 8) == (found.account.index_sum == 0)
    assert len(found) >= 7


# -- coupled bistable stages --------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 2, 3, *(pytest.param(n, marks=pytest.mark.long) for n in (4, 5))])
def test_n_weakly_coupled_bistable_stages_have_3_to_the_n_equilibria_2_to_the_n_of_them_stable(count):
    found = find_equilibria(stages(count, 0.02), max_solutions=300)
    assert len(found) == 3**count
    assert len(found.stable) == 2**count


@pytest.mark.slow
def test_uncoupled_stages_rest_at_every_combination_of_minus_one_zero_and_one():
    found = find_equilibria(stages(3))
    expected = sorted(itertools.product((-1.0, 0.0, 1.0), repeat=3))
    assert np.allclose(sorted(p.state.round(6).tolist() for p in found), expected, atol=1e-6)


def test_energies_of_uncoupled_stages_are_minus_a_quarter_for_each_in_a_well():
    for p in find_equilibria(stages(2)):
        assert p.energy == pytest.approx(-0.25 * np.count_nonzero(np.abs(p.state) > 0.5), abs=1e-9)


def test_symmetric_copies_name_the_first_of_their_kind():
    found = find_equilibria(stages(2, 0.05))
    kinds = [p for p in found if not p.mirror_of]
    assert len(found) == 9
    assert len(kinds) == 4  # both alike, opposite, one between its wells, both between
    twin = next(p for p in found if p.mirror_of == "E1")
    assert np.allclose(twin.state, -found.point("E1").state, atol=1e-8)


# -- angles ---------------------------------------------------------------------------------------------------------


def test_a_pendulum_has_two_equilibria_whatever_the_number_of_turns(pendulum_xml):
    found = find_equilibria(mc.Mechanism.from_xml(pendulum_xml(joint='damping="1"')))
    assert [p.stability for p in found] == ["stable", "unstable"]
    assert np.allclose(found.column("hip"), [math.pi, 0.0], atol=1e-8)
    assert np.allclose(found.column("energy"), [-9.81, 9.81])


def test_a_torsion_spring_makes_turns_count(pendulum_xml):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(joint='stiffness="0.2" damping="1"'))
    found = find_equilibria(mechanism, region={"hip": (-20.0, 20.0)})
    angles = np.linspace(-20.0, 20.0, 400_001)
    moment = 9.81 * np.sin(angles) - 0.2 * angles
    assert len(found) == np.count_nonzero(np.diff(np.sign(moment + 1e-12)))


def test_a_region_of_an_angle_chooses_the_turn(pendulum_xml):
    found = find_equilibria(mc.Mechanism.from_xml(pendulum_xml()), region={"hip": (2 * _TURN - 1, 2 * _TURN + 1)})
    assert np.allclose(found.column("hip"), [2 * _TURN])


@pytest.mark.slow
def test_a_free_body_on_bushes_rests_upright_and_in_three_half_turns():
    spots = {"a": "1 0 0", "b": "0 1 0", "c": "0 0 0.5"}
    bush = 'gaintype="fixed" gainprm="0" biastype="affine" biasprm="0 -1000 -100"'
    bushes = "".join(
        f'<general name="bush_{s}{i}" {bush} site="{s}" refsite="w{s}" gear="{axis} 0 0 0"/>'
        for s in spots
        for i, axis in enumerate(("1 0 0", "0 1 0", "0 0 1"))
    )
    mechanism = mc.Mechanism.from_xml(
        '<mujoco><worldbody>' + "".join(f'<site name="w{s}" pos="{at}"/>' for s, at in spots.items())
        + '<body><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 2 3"/>'
        + "".join(f'<site name="{s}" pos="{at}"/>' for s, at in spots.items())
        + f"</body></worldbody><actuator>{bushes}</actuator></mujoco>"
    )
    found = find_equilibria(mechanism)
    assert [p.n_unstable for p in found] == [0, 1, 2, 3]  # Wahba's problem: a Morse function on the rotations


# -- vector fields and regions ---------------------------------------------------------------------------------------


@pytest.mark.slow
def test_three_copies_of_a_cubic_have_27_equilibria_8_of_them_stable():
    found = find_equilibria(cubes(3))
    assert len(found) == 27
    assert len(found.stable) == 8
    assert all(math.isnan(p.energy) for p in found)


@pytest.mark.slow
def test_a_region_may_be_ranges_of_components_and_parameters():
    assert len(find_equilibria(cubes(2), region={"u[0]": (0.5, 2.0)})) == 3
    assert len(find_equilibria(cubes(2), region={"a": (2.0, 3.0)})) == 0


def test_a_region_may_be_a_function_of_the_point():
    found = find_equilibria(cubes(2), region=lambda point: point["u[0]"] + point["u[1]"] > 0.5)
    assert len(found) == 3


def test_a_jacobian_of_the_user_is_used():
    calls = []

    def jacobian(u, p):
        calls.append(1)
        return np.array([[2.0 * u[0]]])

    field = mc.VectorField(lambda u, p: u**2 - 1.0, [0.3], {"a": 0.0}, jacobian=jacobian)
    assert np.allclose(sorted(p.state[0] for p in find_equilibria(field)), [-1.0, 1.0])
    assert calls


@pytest.mark.slow
def test_a_problem_without_equilibria_says_so():
    found = find_equilibria(mc.VectorField(lambda u, p: 1.0 + u**2, [0.0], {"a": 0.0}))
    assert len(found) == 0
    assert found.status == "no equilibrium found: 0 of 600 starts converged"


def test_a_continuum_is_sampled_and_named():
    circle = mc.VectorField(lambda u, p: u * (1.0 - u @ u), [0.5, 0.0], {"a": 0.0})
    found = find_equilibria(circle)
    assert len(found) < 30
    assert "continuum" in found.status


# -- limits, progress, interrupts -------------------------------------------------------------------------------------


def test_the_limit_of_solutions_ends_a_search_and_is_told():
    found = find_equilibria(cubes(3), max_solutions=5)
    assert len(found) == 5
    assert "the limit of 5 equilibria was reached" in found.status


@pytest.mark.parametrize("limit", [{"max_starts": 40}, {"max_evaluations": 500}, {"max_seconds": 0.0}])
def test_other_limits_end_a_search_and_are_told(limit):
    assert "the limit of" in find_equilibria(cubes(4), **limit).status


def test_an_interrupt_returns_what_had_been_found():
    def stop(starts, found):
        if found.kind:
            raise KeyboardInterrupt

    found = find_equilibria(cubes(3), progress=stop)
    assert found.interrupted
    assert 1 <= len(found) < 27
    assert "interrupted" in found.status


def test_progress_hears_of_every_equilibrium_once():
    heard = []
    found = find_equilibria(cubes(2), progress=lambda starts, item: heard.append(item))
    assert sum(item.kind == "EQ" for item in heard) == len(found) == 9


@pytest.mark.slow
def test_the_result_prints_as_a_table_and_starts_a_diagram():
    found = find_equilibria(cubes(1))
    assert "E1" in str(found)
    assert "unstable" in str(found)
    diagram = mc.bifurcation_diagram(cubes(1), "a", bounds=(0.5, 2.0), starts=found)
    assert len(diagram) == 3


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"region": {"gap": (0, 1)}}, mc.NameLookupError, "unknown observable, joint or parameter 'gap'"),
        ({"region": {"a": (1, 0)}}, mc.BoundsError, "low < high"),
        ({"region": {"a": 3}}, mc.BoundsError, "two numbers"),
        ({"starts": 0}, mc.ParameterError, "starts must be at least 1"),
        ({"max_seconds": math.nan}, mc.ParameterError, "max_seconds must be a number of seconds, got nan"),
        ({"params": 3.0}, mc.ParameterError, "params must be a dict"),
    ],
)
def test_a_wrong_argument_is_named(arguments, error, words):
    with pytest.raises(error, match=words):
        find_equilibria(cubes(1), **arguments)


# -- parts ------------------------------------------------------------------------------------------------------------


def test_the_deflation_gradient_is_that_of_the_product_of_shifted_poles():
    roots = np.array([[0.2, 1.0], [-0.4, 0.3]])
    deflation = Deflation(lambda x: x[:, None] - roots[None], np.array([math.inf, _TURN]))

    def log_m(x):
        steps = x - roots
        squared = steps[:, 0] ** 2 + (2.0 * np.sin(steps[:, 1] / 2.0)) ** 2
        return np.sum(np.log(1.0 / squared + 1.0))

    x, h = np.array([0.7, -0.5]), 1e-6
    expected = [(log_m(x + h * e) - log_m(x - h * e)) / (2.0 * h) for e in np.eye(2)]
    assert np.allclose(deflation.log_gradient(x[None])[0], expected, rtol=1e-8)


def test_forces_are_minus_the_gradient_of_the_potential_energy():
    gear = mc.Mechanism.from_xml("nose_gear")
    values, x, h = gear.values({"F_ret": 0.0, "F_ul": 0.0}), gear.keyframes["uplock_above"] + 0.01, 1e-5
    rows = np.concatenate([x + h * np.eye(gear.n), x - h * np.eye(gear.n)])
    energies = potential_energy(gear, rows, values)
    gradient = (energies[: gear.n] - energies[gear.n :]) / (2.0 * h)
    assert np.allclose(gear.residual(x, values), -gradient, rtol=1e-6, atol=1e-2)
