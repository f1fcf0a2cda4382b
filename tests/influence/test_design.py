"""Designs that meet targets with the least change: closed forms, and an independent root of the bush energies."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from problems.reference import PARAMETERS, equilibrium_at
from scipy.optimize import brentq, root

import mjcont as mc

# -- a fold and a cusp in closed form ---------------------------------------------------------------------------


@cache
def hill_fold(p=0.0):
    """Fold of la - g(p, q) - x^2 at la = g = 1 - (p - 0.3)^2 - 2 (q + 0.2)^2."""

    def f(u, p):
        return [p["la"] - 1.0 + (p["p"] - 0.3) ** 2 + 2.0 * (p["q"] + 0.2) ** 2 - u[0] ** 2]

    hill = mc.VectorField(f, [1.0], {"la": 2.0, "p": 0.0, "q": 0.0}, names=["x"], name="hill")
    return mc.continue_equilibria(hill, "la", bounds=(-10.0, 5.0), start={"la": 2.0, "p": p}).point("LP1")


@cache
def swallowtail():
    """A cusp of la + mu x + p x^2 - x^4, at x = sqrt(p / 6) and mu = -4/3 p x: it ceases to exist at p = 0."""

    def f(u, p):
        return [p["la"] + p["mu"] * u[0] + p["p"] * u[0] ** 2 - u[0] ** 4]

    tail = mc.VectorField(f, [1.2], {"la": 0.0, "mu": 0.0, "p": 1.0}, names=["x"], name="swallowtail")
    fold = mc.continue_equilibria(tail, "la", bounds=(-3.0, 3.0)).of_kind("LP")[0]
    return max(mc.continue_special(fold, "mu", bounds=(-3.0, 3.0)).of_kind("CP"), key=lambda p: p["x"])


WIDE = {"p": (-5.0, 5.0), "q": (-5.0, 5.0)}


def hill_design(*targets, change=WIDE, **options):
    fold = hill_fold(options.pop("today", 0.0))
    return mc.design(fold, change, targets, **{"scales": dict.fromkeys(change, 1.0)} | options)


def test_the_least_change_is_along_the_gradient_of_the_target():
    found = hill_design("LP1.la == 0.5")
    p, q = found["p"], found["q"]
    assert found.status == "met"
    assert 1.0 - (p - 0.3) ** 2 - 2.0 * (q + 0.2) ** 2 == pytest.approx(0.5, rel=1e-9)
    assert p * -4.0 * (q + 0.2) == pytest.approx(q * -2.0 * (p - 0.3), rel=1e-6)
    assert found.kkt < 1e-6
    assert found.objective == pytest.approx(p**2 + q**2, rel=1e-12)


def test_today_is_kept_where_it_meets_a_limit():
    found = hill_design("LP1.la <= 0.9")
    assert found.parameters == {"p": 0.0, "q": 0.0}
    assert not found.active


@pytest.mark.slow
def test_a_multiplier_is_the_change_of_the_objective_with_the_target():
    low, middle, high = (hill_design(f"LP1.la == {v}") for v in (0.499, 0.5, 0.501))
    (row,) = middle.active
    assert row.multiplier == pytest.approx((high.objective - low.objective) / 0.002, rel=1e-4)


def test_what_a_little_more_costs_is_said_in_the_parameter_that_changes_most():
    row = hill_design("LP1.la == 0.5").active[0]
    assert row.cost.startswith("0.001 less costs 0.00")
    assert row.cost.endswith(" of q")


@pytest.mark.slow
def test_an_objective_may_be_a_quantity_or_a_function():
    highest = hill_design("LP1.x <= 1", objective="-LP1.la")
    assert highest.parameters == pytest.approx({"p": 0.3, "q": -0.2}, abs=1e-6)
    own = hill_design("LP1.la == 0.5", objective=lambda d: (d["p"] - 1.0) ** 2 + d["q"] ** 4)
    assert own.kkt < 1e-6
    assert own.conditions[0].after == pytest.approx(0.5, rel=1e-9)


def test_bounds_hold_and_are_named():
    found = hill_design("LP1.la == 0.5", change={"p": (-0.5, 5.0), "q": (-0.1, 0.1)})
    assert found.at_bound == {"q": "high"}
    assert found["q"] == 0.1
    assert found["p"] == pytest.approx(0.3 - math.sqrt(0.32), rel=1e-9)
    assert "with q at its high bound" in found.message


def test_a_limit_holds_over_every_load_case():
    winds = [{"q": q} for q in (-0.5, 0.0, 0.5)]
    found = hill_design("LP1.la >= -0.02 over wind", change={"p": (-2.0, 2.0)}, cases={"wind": winds})
    assert found["p"] == pytest.approx(0.1, abs=1e-9)
    assert [c.load["q"] for c in found.active] == [0.5]


@pytest.mark.slow
def test_a_limit_holds_everywhere_in_a_box_also_where_its_worst_is_inside():
    box = {"wind": {"q": (-0.5, 0.5)}}
    found = hill_design("LP1.la <= 0.96 over wind", change={"p": (-2.0, 2.0)}, cases=box, today=0.2)
    assert found["p"] == pytest.approx(0.1, abs=1e-6)
    assert found.active[0].load["q"] == pytest.approx(-0.2, abs=1e-3)


@pytest.mark.slow
def test_a_target_out_of_reach_ends_at_the_nearest_and_is_named():
    found = hill_design("LP1.la == 2")
    assert (found.status, found.met) == ("conflict", False)
    assert found.message == "LP1.la == 2 cannot be met: the nearest design has LP1.la = 1"
    assert found.parameters == pytest.approx({"p": 0.3, "q": -0.2}, abs=1e-4)


@pytest.mark.slow
def test_where_a_point_ceases_to_exist_the_step_is_cut_and_said():
    """The cusp is there for p > 0 only, and smaller p is better."""
    found = mc.design({"CP": swallowtail()}, {"p": (-1.0, 2.0)}, "CP.x <= 5", objective="p")
    assert found.status == "at the edge"
    assert 0.0 < found["p"] < 0.05
    assert "ceases to exist" in found.cuts[0]


def test_starts_are_counted_that_end_at_one_design():
    found = hill_design("LP1.la == 0.5", starts=[{"p": 0.1, "q": 0.2}, {"p": -0.2, "q": 0.3}])
    assert found.starts == (2, 2)


@pytest.mark.slow
def test_points_and_diagrams_are_there_before_and_after():
    found = hill_design("LP1.la == 0.5")
    assert found.points_before["LP1"]["la"] == pytest.approx(0.83, rel=1e-9)
    assert found.points["LP1"]["la"] == pytest.approx(0.5, rel=1e-9)
    before, after = found.diagrams()
    assert [b.point("LP1")["la"] for b in (before, after)] == pytest.approx([0.83, 0.5], rel=1e-8)


@pytest.mark.slow
def test_a_design_is_drawn_and_is_a_table(tmp_path):
    found = hill_design("LP1.la == 0.5")
    assert found.plot().get_xlabel() == "change, in the parameter's scale"
    assert found.plot("LP1", "x").get_ylabel() == "x"
    lines = found.to_csv(tmp_path / "design.csv").read_text().splitlines()
    assert [line.split(",")[0] for line in lines] == ["parameter", "p", "q"]
    assert "LP1.la == 0.5" in str(found)


@pytest.mark.parametrize(
    ("target", "options", "error", "said"),
    [
        ("LP1.la", {}, mc.ParameterError, "expected a statement"),
        ("LP2.la == 1", {}, mc.NameLookupError, "unknown point 'LP2'"),
        ("LP1.mu == 1", {}, mc.NameLookupError, "unknown quantity of LP1 'mu'"),
        ("LP1.la == 1 furlong", {}, mc.ParameterError, "unknown unit 'furlong'"),
        ("LP1.la <= 1 over gusts", {}, mc.NameLookupError, "unknown set of load cases 'gusts'"),
        ("|LP1.la| >= 1", {}, mc.ParameterError, "written with <="),
        ("LP1.la == 1", {"change": {"la": (0.0, 1.0)}}, mc.ParameterError, "la is free at LP1"),
        ("LP1.la == 1", {"change": {"p": (1.0, 2.0)}}, mc.BoundsError, "p is 0 today, outside its bounds"),
        ("LP1.la == 1", {"change": {}}, mc.ParameterError, "at least one parameter"),
        ("LP1.la == 1", {"starts": [{"p": 9.0}]}, mc.BoundsError, "a start has p = 9"),
        ("LP1.la == 1", {"objective": "mass"}, mc.ParameterError, "name a point and a quantity"),
        ("LP1.la == 1 over w", {"cases": {"w": {"q": (0.0, 1.0)}}, "change": {"p": (-1.0, 1.0)}}, mc.ParameterError,
         "limits on special points only"),
    ],
)
def test_mistakes_name_the_valid_choices(target, options, error, said):
    with pytest.raises(error, match=said):
        hill_design(target, **{"scales": {}} | options)


# -- the overcentre mechanism -----------------------------------------------------------------------------------

SPRING = {"k_sp": (1.0, 100.0), "l_us": (0.1, 0.95)}


@cache
def overcentre_folds(stiffness):
    """The folds by label; LP2 is the upper one, above overcentre."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    start = {"F": 50.0, "k_j": stiffness}
    return mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 60.0), start=start).of_kind("LP")


def root_of_the_energies(stiffness, force, angle):
    """Return k_sp and l_us for which a force holds an angle where dF/dtheta_1 = 0: a fold, without mjcont."""

    def missing(v):
        _, f, slope = equilibrium_at(angle, {**PARAMETERS, "k_j": stiffness, "k_sp": v[0], "l_us": v[1]})
        return [f - force, slope]

    rigid = [(2.0 * 9.81 - force) / (2.0 * math.sin(angle) ** 3), math.cos(angle) ** 3]
    return root(missing, rigid, tol=1e-13).x


@pytest.mark.slow
def test_a_spring_puts_the_upper_fold_at_14_newtons_and_30_degrees():
    found = mc.design(overcentre_folds(1e6), SPRING, ["LP2.F == 14 N", "LP2.theta_1 == 30 deg"])
    assert found.status == "met"
    expected = root_of_the_energies(1e6, 14.0, math.radians(30.0))
    assert [found["k_sp"], found["l_us"]] == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
def test_with_stiff_bushes_that_spring_is_the_rigid_linkages():
    found = mc.design(overcentre_folds(1e8), SPRING, ["LP2.F == 14 N", "LP2.theta_1 == 30 deg"])
    assert found["l_us"] == pytest.approx(math.cos(math.radians(30.0)) ** 3, rel=1e-6)
    assert found["k_sp"] == pytest.approx(5.62 / (2.0 * math.sin(math.radians(30.0)) ** 3), rel=1e-6)


@pytest.mark.slow
def test_folds_whose_mean_is_not_the_weight_exclude_each_other():
    """With rigid pins the folds lie symmetrically about 19.62 N; 12 N and 26 N do not."""
    found = mc.design(overcentre_folds(1e6), SPRING, ["LP2.F == 12 N", "LP1.F == 26 N"])
    assert (found.status, found.met) == ("conflict", False)
    assert found.message.startswith("LP2.F == 12 N and LP1.F == 26 N exclude each other: the nearest design has ")
    upper, lower = (c.after for c in found.conditions)
    assert upper + lower == pytest.approx(2.0 * 19.62, rel=1e-4)
    weights = np.array([1.0 / 12.0**2, 1.0 / 26.0**2])  # least squares of relative misses along upper + lower = 39.24
    best = (weights[0] * 12.0 + weights[1] * (39.24 - 26.0)) / weights.sum()
    assert upper == pytest.approx(best, rel=1e-4)


@pytest.mark.slow
def test_a_length_in_the_spec_is_designed_and_written(tmp_path):
    """A rod on a spring leans where k hip = n m g (l / 2) sin(hip), its mass that of a capsule of its length."""
    text = """<mujoco><worldbody><!-- a rod --><body name="rod">
      <joint name="hip" type="hinge" axis="0 -1 0" stiffness="2"/>
      <geom name="rod" type="capsule" fromto="0 0 0 0 0 0.4" size="0.01" density="3000"/></body></worldbody></mujoco>"""
    rod = mc.Mechanism.from_xml(text)
    rod.declare("length", "spec:geom:rod.fromto[5]", unit="m", bounds=(0.1, 1.0))
    rest = mc.find_equilibrium(rod, {"load_factor": 4.0}, state=[1.0])
    found = mc.design({"rest": rest}, {"length": (0.2, 0.8)}, "rest.hip == 60 deg")

    def unbalanced(v):
        mass = 3000.0 * math.pi * 0.01**2 * (v + 4.0 / 3.0 * 0.01)
        return 2.0 * math.pi / 3.0 - 4.0 * mass * 9.81 * 0.5 * v * math.sin(math.pi / 3.0)

    assert found["length"] == pytest.approx(brentq(unbalanced, 0.1, 1.0, xtol=1e-14), rel=1e-8)
    written = found.to_xml(tmp_path / "rod.xml").read_text(encoding="utf-8")
    assert written == text.replace("0 0 0 0 0 0.4", f"0 0 0 0 0 {found['length']!r}")


@pytest.mark.slow
def test_a_point_that_ceases_beside_the_target_ends_the_design_there():
    """At 8 N/m both folds meet where the spring is longer and stiffer by a little."""
    found = mc.design(overcentre_folds(8.0), SPRING, "LP2.F == 16.5 N")
    assert found.status == "at the edge"
    assert "LP2 ceases to exist near k_sp" in found.cuts[-1]
    assert 16.5 < found.conditions[0].after < found.conditions[0].before


def test_a_pose_of_a_rest_is_a_target():
    mechanism = mc.Mechanism.from_xml("overcentre")
    rest = mc.find_equilibrium(mechanism, {"F": 18.0})
    found = mc.design({"rest": rest}, {"F": (-50.0, 50.0)}, "rest.theta_1 == 60 deg")
    held = mc.hold(mechanism, {"theta_1": math.radians(60.0)}, controls=["F"])
    assert found["F"] == pytest.approx(held.controls["F"], rel=1e-9)


@pytest.mark.slow
def test_the_energy_that_dislodges_a_rest_is_a_target():
    mechanism = mc.Mechanism.from_xml("overcentre")
    rest = mc.find_equilibrium(mechanism, {"F": 18.0})
    today = mc.energy_barrier(rest).energy
    found = mc.design({"rest": rest}, {"k_sp": (5.0, 20.0)}, f"rest.barrier >= {1.5 * today} J")
    again = mc.find_equilibrium(mechanism, {"F": 18.0, "k_sp": found["k_sp"]})
    assert mc.energy_barrier(again).energy == pytest.approx(1.5 * today, rel=1e-7)
