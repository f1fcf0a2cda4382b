"""Special points followed to other parameter values, mapped over grids, and their worst cases over boxes."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import mjcont as mc

# -- plain functions with closed forms --------------------------------------------------------------------------


@cache
def hill_fold():
    """Fold of la - g(p, q) - x^2 at la = g, which has its largest value 1 at p = 0.3, q = -0.2."""

    def f(u, p):
        return [p["la"] - 1.0 + (p["p"] - 0.3) ** 2 + 2.0 * (p["q"] + 0.2) ** 2 - u[0] ** 2]

    hill = mc.VectorField(f, [1.0], {"la": 2.0, "p": 0.0, "q": 0.0}, names=["x"], name="hill")
    return mc.continue_equilibria(hill, "la", bounds=(-10.0, 5.0), start={"la": 2.0}).point("LP1")


@cache
def swallowtail():
    """The cusps of la + mu x + p x^2 - x^4: at x = -+sqrt(p / 6); both vanish where p = 0."""

    def f(u, p):
        x = u[0]
        return [p["la"] + p["mu"] * x + p["p"] * x**2 - x**4]

    tail = mc.VectorField(f, [1.2], {"la": 0.0, "mu": 0.0, "p": 1.0}, names=["x"], name="swallowtail")
    fold = mc.continue_equilibria(tail, "la", bounds=(-3.0, 3.0)).of_kind("LP")[0]
    return max(mc.continue_special(fold, "mu", bounds=(-3.0, 3.0)).of_kind("CP"), key=lambda p: p["x"])


@cache
def wave_fold(label="LP1"):
    """Folds of la - sin(x) - p x where cos(x) = -p: two in every turn, side by side as p approaches 1."""

    def f(u, p):
        return [p["la"] - math.sin(u[0]) - p["p"] * u[0]]

    wave = mc.VectorField(f, [0.0], {"la": 0.0, "p": 0.2}, names=["x"], name="wave")
    return mc.continue_equilibria(wave, "la", bounds=(-3.0, 3.0), limits={"x": (-6.0, 6.0)}).point(label)


# -- following --------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_fold_is_followed_to_where_its_closed_form_has_it():
    found = mc.follow_point(hill_fold(), {"p": -2.0, "q": 1.0})
    assert found.reached
    assert found.status == "reached"
    assert found.point["la"] == pytest.approx(1.0 - 2.3**2 - 2.0 * 1.2**2, rel=1e-12)
    assert found.point.parameters["p"] == -2.0


def test_a_followed_point_has_its_coefficient_and_label():
    found = mc.follow_point(hill_fold(), {"p": 1.0}).point
    assert (found.kind, found.label) == ("LP", "LP1")
    assert found.coefficients["a"] == pytest.approx(-1.0, rel=1e-9)
    assert found.converged
    assert found.tolerance < 1e-10


@pytest.mark.slow
def test_a_fold_never_jumps_to_the_one_beside_it():
    for label in ("LP1", "LP2", "LP3", "LP4"):
        fold = wave_fold(label)
        turn = round((fold["x"] - math.copysign(math.acos(-0.2), math.sin(fold["x"]))) / (2.0 * math.pi))
        found = mc.follow_point(fold, {"p": 0.995})
        assert found.reached, found.message
        x = math.copysign(math.acos(-0.995), math.sin(fold["x"])) + 2.0 * math.pi * turn
        assert found.point["x"] == pytest.approx(x, rel=1e-8)


@pytest.mark.slow
def test_folds_that_meet_cease_to_exist_where_they_do_with_a_sentence():
    found = mc.follow_point(wave_fold(), {"p": 1.5})
    assert not found.reached
    assert found.status == "ceased"
    assert "LP1 ceases to exist near p = " in found.message
    assert found.path[-1]["p"] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.slow
def test_cusps_that_annihilate_cease_to_exist_where_they_do():
    found = mc.follow_point(swallowtail(), {"p": -0.5})
    assert found.status == "ceased"
    assert found.point["p"] == pytest.approx(0.0, abs=1e-3)
    assert found.path[-1]["p"] >= 0.0


@pytest.mark.slow
def test_a_cusp_is_followed_to_where_its_closed_form_has_it():
    found = mc.follow_point(swallowtail(), {"p": 3.0})
    x = math.sqrt(0.5)  # mu = -2 p x + 4 x^3
    assert found.point["x"] == pytest.approx(x, rel=1e-8)
    assert found.point["mu"] == pytest.approx(-6.0 * x + 4.0 * x**3, rel=1e-9)


@pytest.mark.slow
def test_a_hopf_point_is_followed_with_its_frequency():
    def f(u, p):
        return [p["A"] - (p["B"] + 1.0) * u[0] + u[0] ** 2 * u[1], p["B"] * u[0] - u[0] ** 2 * u[1]]

    brusselator = mc.VectorField(f, [2.0, 0.5], {"A": 2.0, "B": 1.0})
    hopf = mc.continue_equilibria(brusselator, "B", bounds=(0.5, 8.0)).of_kind("HB")[0]
    found = mc.follow_point(hopf, {"A": 1.0}).point  # B = 1 + A^2, omega = A
    assert found["B"] == pytest.approx(2.0, rel=1e-9)
    assert found.coefficients["omega"] == pytest.approx(1.0, rel=1e-9)


@pytest.mark.slow
def test_a_branch_point_that_breaks_is_a_status():
    truss = mc.Mechanism.from_xml("von_mises_truss")
    branch = mc.continue_equilibria(truss, "P", bounds=(-2000.0, 2000.0), start={"a": 0.35}, keyframe="steep")
    found = mc.follow_point(branch.of_kind("BP")[0], {"H": 5.0})
    assert not found.reached
    kept = mc.follow_point(branch.of_kind("BP")[0], {"k": 2000.0})
    assert kept.point["P"] == pytest.approx(2.0 * branch.of_kind("BP")[0]["P"], rel=1e-8)


def test_mistakes_of_following_name_the_valid_choices():
    with pytest.raises(mc.ParameterError, match="la is free at LP1"):
        mc.follow_point(hill_fold(), {"la": 1.0})
    with pytest.raises(mc.NameLookupError, match="Valid: la, p, q"):
        mc.follow_point(hill_fold(), {"r": 1.0})
    with pytest.raises(mc.ParameterError, match="finite"):
        mc.follow_point(hill_fold(), {"p": math.nan})
    with pytest.raises(mc.ParameterError, match="at least one parameter"):
        mc.follow_point(hill_fold(), {})


# -- maps -------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_map_has_the_closed_form_at_every_node():
    p, q = np.linspace(-1.0, 1.0, 5), np.linspace(-0.5, 0.5, 4)
    found = mc.special_map(hill_fold(), {"p": p, "q": q})
    expected = 1.0 - (p[:, None] - 0.3) ** 2 - 2.0 * (q[None, :] + 0.2) ** 2
    assert found["la"] == pytest.approx(expected, rel=1e-10, abs=1e-10)
    assert found.exists.all()


@pytest.mark.slow
def test_a_map_is_empty_where_the_point_has_ceased_to_exist():
    found = mc.special_map(swallowtail(), {"p": [-0.4, -0.2, 0.2, 0.4, 1.0]})
    assert found.exists.tolist() == [False, False, True, True, True]
    assert np.isnan(found["mu"][:2]).all()
    assert "ceases to exist" in found.messages[1]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["contour", "surface"])
def test_a_map_is_drawn_over_its_grid(kind):
    found = mc.special_map(hill_fold(), {"p": [-1.0, 0.0, 1.0], "q": [-0.5, 0.5]})
    axes = found.plot("la", kind=kind)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("p", "q")
    axes.figure.canvas.draw()


def test_mistakes_of_maps_say_what_is_wrong():
    with pytest.raises(mc.ParameterError, match="increasing"):
        mc.special_map(hill_fold(), {"p": [1.0, 0.0]})
    with pytest.raises(mc.ParameterError, match="one or two parameters"):
        mc.special_map(hill_fold(), {})
    with pytest.raises(mc.NameLookupError, match="unknown kind of map"):
        mc.special_map(hill_fold(), {"p": [0.0, 1.0]}).plot(kind="pie")


# -- worst cases ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_largest_value_inside_the_box_is_found_from_every_corner():
    found = mc.worst_case(hill_fold(), {"p": (-2.0, 2.0), "q": (-1.0, 3.0)})
    assert found.value == pytest.approx(1.0, rel=1e-12)
    assert found.parameters == pytest.approx({"p": 0.3, "q": -0.2}, abs=1e-6)
    assert (found.status, found.active, found.starts) == ("stationary", {}, (5, 5))
    assert found.kkt < 1e-7


@pytest.mark.slow
def test_a_smallest_value_lies_in_the_farthest_corner_with_its_bounds_active():
    found = mc.worst_case(hill_fold(), {"p": (-2.0, 2.0), "q": (-1.0, 3.0)}, maximise=False, grid=5)
    assert found.parameters == {"p": -2.0, "q": 3.0}
    assert found.value == pytest.approx(1.0 - 2.3**2 - 2.0 * 3.2**2, rel=1e-10)
    assert found.active == {"p": "low", "q": "high"}
    assert "none better" in found.message


@pytest.mark.slow
def test_one_bound_is_active_where_the_largest_value_lies_on_an_edge():
    found = mc.worst_case(hill_fold(), {"p": (0.5, 2.0), "q": (-1.0, 3.0)})
    assert found.parameters == pytest.approx({"p": 0.5, "q": -0.2}, abs=1e-6)
    assert found.active == {"p": "low"}


@pytest.mark.long
def test_where_the_point_ceases_inside_the_box_the_extreme_lies_at_the_edge_of_its_existence():
    fold = next(f for f in map(wave_fold, ("LP1", "LP2", "LP3", "LP4")) if 0.0 < f["x"] < math.pi)
    found = mc.worst_case(fold, {"p": (0.0, 2.0)})  # la = sin(x) + p x, cos(x) = -p: largest at x = pi, where p = 1
    assert found.status == "at the edge"
    assert "LP" in found.message
    assert "ceases to exist" in found.message
    assert found.parameters["p"] == pytest.approx(1.0, abs=1e-2)
    assert found.value == pytest.approx(math.pi, rel=1e-2)


@pytest.mark.slow
def test_a_box_in_which_the_point_does_not_exist_is_a_status():
    found = mc.worst_case(swallowtail(), {"p": (-1.0, -0.5)})
    assert found.status == "not converged"
    assert "nothing in the box was reached" in found.message


@pytest.mark.slow
def test_a_box_of_five_parameters_needs_no_32_corners():
    def f(u, p):
        return [p["la"] + sum((i + 1) * p[f"p{i}"] for i in range(5)) - u[0] ** 2]

    many = mc.VectorField(f, [1.0], {"la": 1.0} | {f"p{i}": 0.0 for i in range(5)}, names=["x"])
    fold = mc.continue_equilibria(many, "la", bounds=(-50.0, 50.0)).point("LP1")
    found = mc.worst_case(fold, {f"p{i}": (-1.0, 1.0) for i in range(5)})
    assert found.value == pytest.approx(15.0, rel=1e-10)
    assert found.starts == (3, 3)


def test_mistakes_of_worst_cases_say_what_is_wrong():
    with pytest.raises(mc.BoundsError, match="low < high"):
        mc.worst_case(hill_fold(), {"p": (1.0, -1.0)})
    with pytest.raises(mc.BoundsError, match="two numbers"):
        mc.worst_case(hill_fold(), {"p": 3.0})
    with pytest.raises(mc.NameLookupError, match="unknown quantity 'load'"):
        mc.worst_case(hill_fold(), {"p": (0.0, 1.0)}, quantity="load")
    with pytest.raises(mc.BoundsError, match="outside its range"):
        mc.worst_case(hill_fold(), {"p": (0.0, 1.0)}, starts=[{"p": 2.0}])
    with pytest.raises(mc.ParameterError, match="at least one parameter with its range"):
        mc.worst_case(hill_fold(), {})


# -- the nose gear's cusp ---------------------------------------------------------------------------------------

REACH = math.radians(30.0)


@cache
def gear_cusp():
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")
    return mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1000.0, 0.0)).point("CP1")


@pytest.mark.slow
def test_the_gears_cusp_followed_is_the_one_found_from_scratch_at_another_load_case():
    load = {"load_factor": 2.5, "gravity_angle": math.radians(-20.0)}
    gear = gear_cusp().problem
    branch = mc.continue_equilibria(gear, "F_ret", start={**load, "F_ret": 6.25e5}, keyframe="uplock_above")
    fold = next(p for p in branch.of_kind("LP") if p.index > branch.start_index)
    fresh = mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0)).point("CP1")
    found = mc.follow_point(gear_cusp(), load).point
    assert [found["F_ret"], found["F_ul"]] == pytest.approx([fresh["F_ret"], fresh["F_ul"]], rel=1e-8)


@pytest.mark.slow
def test_the_gears_largest_unlock_force_is_at_the_steepest_descent_and_the_largest_load():
    box = {"gravity_angle": (-REACH, REACH), "load_factor": (0.5, 2.5)}
    middle = {n: sum(r) / 2.0 for n, r in box.items()}
    found = mc.worst_case(gear_cusp(), box, quantity="F_ul", maximise=False, starts=[middle])
    assert found.parameters == pytest.approx({"gravity_angle": -REACH, "load_factor": 2.5}, rel=1e-12)
    assert found.active == {"gravity_angle": "low", "load_factor": "high"}


@pytest.mark.long
def test_the_gears_largest_retraction_force_is_where_gravity_is_square_to_its_lever():
    """F_ret r_ret balances gravity's moment A cos + B sin at the cusp, largest where its derivative vanishes."""
    box = {"gravity_angle": (-REACH, REACH), "load_factor": (0.5, 2.5)}
    found = mc.worst_case(gear_cusp(), box, starts=[{"gravity_angle": 0.0, "load_factor": 1.0}])
    assert found.active == {"load_factor": "high"}
    line = mc.continue_special(found.point, "gravity_angle", bounds=(-REACH, -math.radians(28.0)), ds_max=0.01)
    top = int(np.argmax(line["F_ret"]))
    fit = np.polyfit(line["gravity_angle"][top - 1 : top + 2], line["F_ret"][top - 1 : top + 2], 2)
    assert found.parameters["gravity_angle"] == pytest.approx(-fit[1] / (2.0 * fit[0]), abs=1e-3)
    assert found.value >= line["F_ret"].max() * (1.0 - 1e-9)


@pytest.mark.long
def test_grids_confirm_the_gears_worst_cases():
    box = {"gravity_angle": (-REACH, REACH), "load_factor": (0.5, 2.5)}
    for quantity, maximise in (("F_ret", True), ("F_ul", False)):
        found = mc.worst_case(gear_cusp(), box, quantity=quantity, maximise=maximise, grid=9)
        assert found.starts == (5, 5)
        assert "a grid of 9 x 9 has none better" in found.message
