"""Derivatives of special points in every parameter: closed forms, and the points solved for again.

Solving again uses the defining systems and Newton's method of the loci, with no adjoint in it: fourth-order
differences of points at four values of the parameter, whose steps move the point by about 1e-3 of itself.
"""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from problems.fields import branch_of_ab, branch_of_brusselator
from problems.reference import PARAMETERS, rigid_folds
from problems.ziegler import column_branch

import mjcont as mc
from mjcont.curves.loci import CODIMENSION, locus_system
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import solve

WEIGHTS = {1: 2.0 / 3.0, -1: -2.0 / 3.0, 2: -1.0 / 12.0, -2: 1.0 / 12.0}


def solved_again(point, name, value):
    """Return the point's own parameters where its defining system is solved with another value of `name`."""
    free = [Free(n, *point.free[n]) for n in list(point.free)[: CODIMENSION[point.kind]]]
    values = {**point.problem.values(point.parameters), name: value}
    system = locus_system(replace(point, parameters=values), point.kind, free)
    found = solve(system, point.state, system.start_y())
    assert not found.failure, (name, found.failure)
    return system.values(found.y)


def differences(point, name, step):
    """Return fourth-order differences of the point's own parameters."""
    point.problem.parameter(name)
    value = point.problem.values(point.parameters)[name]
    ends = {o: solved_again(point, name, value + o * step) for o in WEIGHTS}
    return {q: sum(w * ends[o][q] for o, w in WEIGHTS.items()) / step for q in point.free}


def step_for(found, name):
    """Return a step that moves the point's parameters by 1e-3 of themselves, `name` by 5e-4 at most."""
    size = abs(found.values[name]) or 0.1
    per = max(abs(found[q, name]) * size / abs(found.values[q]) for q in found.quantities)
    return min(5e-4, 1e-3 / max(per, 1e-9)) * size


def check(point, names, rel=1e-5, tiny=1e-7):
    """Compare with differences, relative to the derivative or (elasticities below `tiny`) to the quantity itself."""
    problem = point.problem
    found = mc.sensitivities(point, names)
    before = problem.evaluations
    for name in names:
        size = abs(found.values[name]) or 0.1
        for quantity, value in differences(point, name, step_for(found, name)).items():
            absolute = tiny * abs(found.values[quantity]) / size
            assert found[quantity, name] == pytest.approx(value, rel=rel, abs=absolute), (name, quantity)
    centred = (problem.evaluations - before) / 2.0  # two of the four points
    assert found.evaluations < 0.05 * centred
    return found


# -- the nose gears and the overcentre against points solved again ----------------------------------------------

NO_EFFECT = ("c_j", "c_D", "c_sp")
GEOMETRY = (
    "site:C_1.pos[0]",
    "site:C_1.pos[2]",
    "site:H_1.pos[2]",
    "site:cg_1.pos[2]",
    "site:cg_5.pos[0]",
    "body:strut.ipos[2]",
    "body:wheels.pos[2]",
    "body:upper_sidestay.pos[0]",
    "body:upper_sidestay.pos[2]",
    "body:lower_sidestay.pos[0]",
    "body:locklink_H.pos[0]",
)


def names_for(point, geometry):
    declared = [n for n in point.problem.parameters if ":" not in n]
    return [n for n in declared if n not in point.free and n not in NO_EFFECT] + list(geometry)


@cache
def gear_fold():
    gear = mc.Mechanism.from_xml("nose_gear")
    start = {"F_ret": 4e5, "gravity_angle": math.radians(-5.0)}
    return mc.continue_equilibria(
        gear, "F_ret", bounds=(3e5, 8e5), start=start, keyframe="uplock_above"
    ).point("LP1")


@cache
def gear_cusp():
    return mc.continue_special(gear_fold(), "F_ul", bounds=(-1000.0, 0.0)).point("CP1")


@cache
def full_gear_fold():
    gear = mc.Mechanism.from_xml("nose_gear_full")
    branch = mc.continue_equilibria(gear, "F_ret", start={"F_ret": 50.0}, keyframe="uplock_above")
    return min(branch.of_kind("LP"), key=lambda p: abs(math.degrees(p["theta_ov"]) + 28.5))


@cache
def full_gear_cusp():
    return mc.continue_special(full_gear_fold(), "k_j", bounds=(300.0, 1e7)).of_kind("CP")[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "point",
    [gear_fold, *(pytest.param(p, marks=pytest.mark.long) for p in (gear_cusp, full_gear_fold, full_gear_cusp))],
    ids=lambda p: p.__name__,
)
def test_gears_fold_and_cusp_move_with_20_parameters_as_points_solved_again_do(point):
    names = names_for(point(), GEOMETRY)
    assert len(names) >= 20
    check(point(), names)


@cache
def overcentre_fold():
    overcentre = mc.Mechanism.from_xml("overcentre")
    start = {"F": 50.0, "gravity_angle": 0.1}
    return mc.continue_equilibria(overcentre, "F", bounds=(-50.0, 60.0), start=start).point("LP1")


@cache
def overcentre_cusp():
    return mc.continue_special(overcentre_fold(), "l_us", bounds=(0.2, 1.5)).point("CP1")


@pytest.mark.slow
@pytest.mark.parametrize(
    "point", [overcentre_fold, pytest.param(overcentre_cusp, marks=pytest.mark.long)], ids=lambda p: p.__name__
)
def test_overcentres_fold_and_cusp_move_with_12_parameters_as_points_solved_again_do(point):
    sites = [f"site:{s}.pos[{i}]" for s in ("A_1", "B_1", "B_2", "C_2") for i in (0, 2)]
    names = names_for(point(), sites)
    assert len(names) >= 12
    check(point(), names)


@pytest.mark.long
def test_the_gears_cusp_moves_with_8_parameters_as_points_solved_again_do():
    check(gear_cusp(), ["m_1", "k_j", "k_sp", "l_us", "gravity_angle", "load_factor", *GEOMETRY[1:3]])


@pytest.mark.slow
def test_dampers_do_not_move_the_gears_cusp_at_all():
    assert not mc.sensitivities(gear_cusp(), NO_EFFECT).derivatives.any()


@pytest.mark.slow
def test_the_gears_unlock_force_does_not_depend_on_the_lever_of_the_retraction_actuator():
    found = mc.sensitivities(gear_cusp(), "r_ret")
    assert abs(found["F_ul", "r_ret"]) < 1e-8 * abs(found.values["F_ul"])
    product = found.values["F_ret"] / found.values["r_ret"]  # the moment F_ret r_ret stays
    assert found["F_ret", "r_ret"] == pytest.approx(-product, rel=1e-9)


# -- closed forms -----------------------------------------------------------------------------------------------


@cache
def truss_branch(**values):
    truss = mc.Mechanism.from_xml("von_mises_truss")
    keyframe = "steep" if "a" in values else None
    return mc.continue_equilibria(truss, "P", bounds=(-2000.0, 2000.0), start=values, keyframe=keyframe)


def test_the_snap_load_of_von_mises_truss_varies_as_its_closed_form():
    k, rest, a = 1000.0, 1.25, 1.0
    fold = max(truss_branch().of_kind("LP"), key=lambda p: p["P"])
    found = mc.sensitivities(fold, ["k", "L0", "a"])
    ratio = (a / rest) ** (2.0 / 3.0)
    load = 2.0 * k * rest * (1.0 - ratio) ** 1.5
    by_a = -2.0 * k * rest / a * ratio * math.sqrt(1.0 - ratio)
    expected = {"k": load / k, "L0": (load - a * by_a) / rest, "a": by_a}  # the load is homogeneous in L0 and a
    assert found["P"] == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
def test_the_overcentres_folds_vary_as_the_closed_form_with_rigid_pins():
    overcentre = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(overcentre, "F", bounds=(-50.0, 60.0), start={"F": 50.0, "k_j": 1e7})
    for fold, (_, angle) in zip(sorted(branch.of_kind("LP"), key=lambda p: p["F"]), rigid_folds(), strict=True):
        found = mc.sensitivities(fold, ["k_sp", "l_us", "m_1", "m_2", "load_factor"])["F"]
        stretch = math.cos(angle) - PARAMETERS["l_us"]
        expected = {
            "k_sp": -2.0 * stretch * math.tan(angle),
            "l_us": 2.0 * PARAMETERS["k_sp"] * math.tan(angle),
            "m_1": 9.81,
            "m_2": 9.81,
            "load_factor": 2.0 * 9.81,
        }
        assert found == pytest.approx(expected, rel=1e-4)


def test_the_hopf_point_of_the_brusselator_and_its_frequency_vary_as_their_closed_forms():
    hopf = branch_of_brusselator().of_kind("HB")[0]  # B = 1 + A^2, omega = A
    found = mc.sensitivities(hopf, "A", quantities=["B", "omega", "x", "y"])
    expected = {"B": 4.0, "omega": 1.0, "x": 1.0, "y": 0.75}  # x = A, y = B / A = 1 / A + A
    assert found["A"] == pytest.approx(expected, rel=1e-7)


def exothermic():
    """The reaction of AUTO's demo ab with a free rate of cooling: its cusp has u = 1/2, B = 4 (1 + beta)."""

    def f(u, p):
        rate = p["D"] * (1.0 - u[0]) * math.exp(u[1])
        return [-u[0] + rate, -(1.0 + p["beta"]) * u[1] + p["B"] * rate]

    return mc.VectorField(f, [0.0, 0.0], {"D": 0.0, "B": 18.0, "beta": 3.0}, names=["u", "v"])


@pytest.mark.slow
def test_the_cusp_of_the_exothermic_reaction_varies_as_its_closed_form():
    fold = mc.continue_equilibria(exothermic(), "D", bounds=(0.0, 0.6)).point("LP1")
    cusp = mc.continue_special(fold, "B", bounds=(8.0, 40.0)).point("CP1")
    found = mc.sensitivities(cusp, "beta", quantities=["B", "D", "u", "v"])["beta"]
    assert found == pytest.approx({"B": 4.0, "D": 0.0, "u": 0.0, "v": 0.0}, rel=1e-7, abs=1e-7)


@pytest.mark.slow
def test_the_bogdanov_takens_point_of_the_exothermic_reaction_varies_as_its_closed_form():
    fold = mc.continue_equilibria(exothermic(), "D", bounds=(0.0, 0.6)).point("LP1")
    (point,) = mc.continue_special(fold, "B", bounds=(8.0, 40.0)).of_kind("BT")
    found = mc.sensitivities(point, "beta")["beta"]  # B = (1 + beta)^3 / beta, D = exp(-(1 + beta) / beta) / beta
    assert found == pytest.approx({"B": 80.0 / 9.0, "D": -2.0 / 27.0 * math.exp(-4.0 / 3.0)}, rel=1e-7)


@pytest.mark.parametrize("b", [0.1, 0.5, 1.0])
def test_the_flutter_load_of_zieglers_column_varies_with_its_dampers_as_its_closed_form(b):
    (hopf,) = column_branch(b).special_points  # P = 41 / 28 + b^2 / 2, omega^2 = 2 / 7
    found = mc.sensitivities(hopf, "joint:*.damping", quantities=["P", "omega"])["joint:*.damping"]
    assert found == pytest.approx({"P": b, "omega": 0.0}, rel=1e-7, abs=1e-7)


@pytest.mark.slow
def test_where_the_gears_fold_curve_turns_moves_as_the_point_followed_does():
    """Beside the cusp, w . f_F_ret = 0."""
    (turning,) = mc.continue_special(gear_fold(), "F_ul", bounds=(-1000.0, 0.0)).of_kind("BP")
    found = mc.sensitivities(turning, "gravity_angle")
    at, h = found.values["gravity_angle"], 1e-3
    ends = [mc.follow_point(turning, {"gravity_angle": at + s * h}).point for s in (1.0, -1.0)]
    for name in ("F_ret", "F_ul"):
        centred = (ends[0][name] - ends[1][name]) / (2.0 * h)
        assert found[name, "gravity_angle"] == pytest.approx(centred, rel=1e-5)


def test_the_fold_of_ab_and_its_state_vary_as_their_closed_forms():
    fold = branch_of_ab(18.0).point("LP1")  # D = u / (1 - u) exp(-B u / 4), u (1 - u) = 4 / B
    u = fold["u"]
    assert mc.sensitivities(fold, "B")["D", "B"] == pytest.approx(-u / 4.0 * fold["D"], rel=1e-9)
    by_B = -4.0 / 18.0**2 / (1.0 - 2.0 * u)
    assert mc.sensitivities(fold, "B", quantities="u")["u", "B"] == pytest.approx(by_B, rel=1e-7)


def test_an_equilibrium_moves_as_the_root_of_its_equation():
    square = mc.VectorField(lambda u, p: [p["p"] - u[0] ** 2], [1.0], {"p": 4.0}, names=["x"])
    point = mc.find_equilibrium(square, {"p": 4.0})
    assert mc.sensitivities(point)["x", "p"] == pytest.approx(0.25, rel=1e-9)


def test_a_user_zero_moves_so_that_its_column_keeps_its_value():
    branch = mc.continue_equilibria(exothermic(), "D", bounds=(0.0, 0.6), zeros={"u": 0.1})
    zero = branch.of_kind("UZ")[0]  # D (1 - u) exp(B u / (1 + beta)) = u
    found = mc.sensitivities(zero, ["B", "beta"])["D"]
    expected = {"B": -zero["D"] * 0.1 / 4.0, "beta": zero["D"] * 18.0 * 0.1 / 16.0}
    assert found == pytest.approx(expected, rel=1e-8)


def test_a_branch_point_that_persists_has_derivatives_and_one_that_breaks_has_none():
    points = truss_branch(a=0.35).of_kind("BP")
    found = mc.sensitivities(points[0], ["k", "H"])
    assert found["P", "k"] == pytest.approx(points[0]["P"] / 1000.0, rel=1e-7)
    assert math.isnan(found["P", "H"])
    assert any("H breaks the branch point" in n for n in found.notes)


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0])
def test_what_breaks_a_branch_point_does_not_depend_on_the_axes(angle):
    """A pitchfork x (mu - c - x^2) = 0 seen through a rotation: c moves it, tilt breaks it, idle does nothing."""
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

    def f(u, p):
        x, y = turn.T @ u
        return turn @ [x * (p["mu"] - p["c"] - x**2) + p["tilt"], p["c"] ** 2 - y]

    field = mc.VectorField(f, turn @ [0.0, 0.09], {"mu": 0.0, "c": 0.3, "tilt": 0.0, "idle": 1.0})
    point = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0)).point("BP1")
    found = mc.sensitivities(point, ["c", "tilt", "idle"])
    assert found["mu", "c"] == pytest.approx(1.0, rel=1e-8)
    assert found["mu", "idle"] == pytest.approx(0.0, abs=1e-9)
    assert math.isnan(found["mu", "tilt"])


@pytest.mark.slow
def test_a_user_zero_on_a_fold_curve_is_a_fold_with_the_second_parameter_held():
    locus = mc.continue_special(gear_fold(), "F_ul", bounds=(-1000.0, 0.0), zeros={"F_ul": -500.0})
    found = mc.sensitivities(locus.of_kind("UZ")[0], ["F_ul", "m_1"])
    assert found.quantities == ("F_ret",) and set(found["F_ret"]) == {"F_ul", "m_1"}


# -- how it reads -----------------------------------------------------------------------------------------------


def test_all_parameters_but_the_points_own_are_the_default():
    found = mc.sensitivities(gear_cusp())
    assert set(found.parameters) >= {"m_1", "k_j", "gravity_angle"}
    assert not {"F_ret", "F_ul"} & set(found.parameters)


def test_the_table_has_the_most_influential_parameter_first_and_angles_in_degrees():
    found = mc.sensitivities(gear_fold(), ["k_j", "m_1", "gravity_angle"])
    lines = str(found).splitlines()
    assert [line.split()[0] for line in lines[2:]] == ["gravity_angle", "m_1", "k_j"]
    slope = found["F_ret", "gravity_angle"] * math.radians(1.0)
    assert f"{slope:.6g} N/deg" in lines[2]


def test_a_prediction_of_the_first_order_is_right_to_the_second():
    found = mc.sensitivities(gear_fold(), "m_1")
    again = solved_again(gear_fold(), "m_1", 1212.0)["F_ret"]
    first = found.predict({"m_1": 12.0})["F_ret"]
    assert first == pytest.approx(again, rel=1e-5)
    assert abs(again - gear_fold()["F_ret"]) > 1e-3 * again


def test_the_csv_has_the_derivatives(tmp_path):
    found = mc.sensitivities(gear_fold(), ["m_1", "k_j"])
    rows = list(csv.reader(found.to_csv(tmp_path / "s.csv").read_text().splitlines()))
    assert rows[0][4] == "d F_ret [N / unit]"
    assert [float(r[4]) for r in rows[1:]] == list(found.derivatives[:, 0])


def test_the_chart_has_a_bar_for_each_parameter_as_long_as_its_tolerance_makes_it():
    found = mc.sensitivities(gear_fold(), ["m_1", "m_6", "c_j"], tolerances={"m_1": 50.0})
    axes = found.plot(tolerances={"m_6": 1.0})
    widths = sorted(abs(bar.get_width()) for bar in axes.patches)
    expected = sorted([50.0 * found["F_ret", "m_1"], found["F_ret", "m_6"]] * 2)
    assert widths == pytest.approx(expected, rel=1e-12)


def test_the_key_of_a_chart_covers_no_bar():
    found = mc.sensitivities(gear_fold(), ["m_1", "m_2", "m_3"])
    axes = found.plot(tolerances={n: abs(1.0 / found["F_ret", n]) for n in found.parameters})  # bars of one length
    key = axes.get_legend().get_window_extent()
    assert len(axes.patches) == 6
    assert not any(key.overlaps(bar.get_window_extent()) for bar in axes.patches)


def test_a_parameter_of_the_point_itself_is_refused():
    with pytest.raises(mc.ParameterError, match="F_ul is free at CP1"):
        mc.sensitivities(gear_cusp(), ["m_1", "F_ul"])


def test_a_path_to_a_field_that_a_changed_parameter_sets_is_refused():
    other = replace(gear_fold(), parameters={**gear_fold().parameters, "m_1": 1300.0})
    with pytest.raises(mc.ParameterError, match="same field of the model as m_1"):
        mc.sensitivities(other, "body:strut.mass")


def test_a_guess_is_refused():
    guess = replace(gear_fold(), converged=False)
    with pytest.raises(mc.MjcontError, match="LP1 did not converge"):
        mc.sensitivities(guess)


def test_unknown_names_list_the_valid_ones():
    with pytest.raises(mc.NameLookupError, match="Did you mean m_1"):
        mc.sensitivities(gear_fold(), "m_11")
    with pytest.raises(mc.NameLookupError, match="unknown quantity 'theta'"):
        mc.sensitivities(gear_fold(), "m_1", quantities="theta")
    with pytest.raises(mc.NameLookupError, match="unknown parameter 'k_sp'"):
        mc.sensitivities(gear_fold(), "m_1", tolerances={"k_sp": 1.0})


def test_a_tolerance_must_be_positive():
    with pytest.raises(mc.ParameterError, match="must be positive"):
        mc.sensitivities(gear_fold(), "m_1", tolerances={"m_1": 0.0})


def test_a_control_at_the_end_of_its_range_is_differenced_inwards(pendulum_xml):
    actuator = '<motor name="push" joint="hip" ctrlrange="0 2" ctrllimited="true"/>'
    rod = mc.Mechanism.from_xml(pendulum_xml(joint='stiffness="20"', actuator=actuator))
    for end in (0.0, 2.0):
        point = mc.find_equilibrium(rod, {"push": end})
        # hip: 20 q - 9.81 sin q = -push or push: dq / dpush = 1 / (20 - 9.81 cos q)
        slope = 1.0 / (20.0 - 9.81 * math.cos(point["hip"]))
        assert abs(mc.sensitivities(point, "push")["hip", "push"]) == pytest.approx(slope, rel=1e-7)
