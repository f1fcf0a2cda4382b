"""Rows between the points of loci and of load paths: special points and rests like any other, as close as asked."""

from __future__ import annotations

import csv
import math
from functools import cache

import numpy as np
import pytest

import mjcont as mc
from mjcont.numerics.equations.defining import Fold
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import solve
from mjcont.numerics.equations.system import Local, System


def reaction():
    """AUTO's demo ab with a cooling of 3, as a function of many states at once."""

    def f(u, p):
        rate = p["D"] * (1.0 - u[0]) * np.exp(u[1])
        return [-u[0] + rate, -4.0 * u[1] + p["B"] * rate]

    return mc.VectorField(f, [0.0, 0.0], {"D": 0.0, "B": 18.0}, names=["u", "v"], vectorized=True)


@cache
def locus_of_ab(kind, chord=3e-6):
    """Return the folds, or the Hopf points, of the vectorized reaction in D and B."""
    branch = mc.continue_equilibria(reaction(), "D", bounds=(0.0, 0.6))
    return mc.continue_special(branch.of_kind(kind)[-1], "B", bounds=(8.0, 24.0), chord=chord)


@cache
def locus_of_gear(chord=3e-6):
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", (0.0, 8e5), {"F_ret": 2.5e5}, keyframe="uplock_above")
    fold = max(branch.of_kind("LP"), key=lambda p: p["F_ret"])
    return mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0), chord=chord)


@pytest.mark.slow
def test_every_row_of_a_fold_curve_obeys_its_closed_form():
    locus = locus_of_ab("LP")
    u, B = locus["u"], locus["B"]
    assert len(locus) > 3 * len(locus_of_ab("LP", math.inf))
    assert u * (1.0 - u) == pytest.approx(4.0 / B, abs=1e-9)
    assert locus["D"] == pytest.approx(u / (1.0 - u) * np.exp(-B * u / 4.0), abs=1e-9)


@pytest.mark.slow
def test_every_row_of_a_hopf_curve_obeys_its_closed_form():
    locus = locus_of_ab("HB")
    u, B = locus["u"], locus["B"]
    assert len(locus) > 3 * len(locus_of_ab("HB", math.inf))
    assert -1.0 / (1.0 - u) + B * u - 4.0 == pytest.approx(0.0 * u, abs=1e-8)
    assert locus["D"] == pytest.approx(u / (1.0 - u) * np.exp(-B * u / 4.0), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["LP", "HB"])
def test_straight_lines_along_a_curve_of_special_points_stay_as_close_to_it_as_asked(kind):
    """A chord is farthest from the curve near its middle. Beyond its last points a locus has its end alone."""
    locus = locus_of_ab(kind)
    spans = np.array([0.6, 16.0, 1.0, 1.0])  # of the unknowns D, B, u, v
    rows = np.column_stack([locus["D"], locus["B"], locus["u"], locus["v"]])
    middle = 0.5 * (rows[1:] + rows[:-1])
    u = middle[:, 2]
    B = 4.0 / (u * (1.0 - u)) if kind == "LP" else (4.0 + 1.0 / (1.0 - u)) / u
    true = np.column_stack([u / (1.0 - u) * np.exp(-B * u / 4.0), B, u, B * u / 4.0])
    chords = np.diff(rows, axis=0) / spans
    lengths = np.linalg.norm(chords, axis=1, keepdims=True)
    off = (true - middle) / spans
    along = chords / np.maximum(lengths, 1e-12)
    aside = off - (off * along).sum(axis=1, keepdims=True) * along
    assert np.linalg.norm(aside, axis=1)[1:-1][lengths[1:-1, 0] > 1e-6].max() < 1.2 * 3e-6


@pytest.mark.slow
def test_points_and_special_points_of_a_locus_are_rows_whatever_lies_between():
    plain, fine = locus_of_gear(math.inf), locus_of_gear()
    assert len(fine) > 3 * len(plain)
    assert [(p.label, p["F_ret"], p["F_ul"]) for p in fine.special_points] == [
        (p.label, p["F_ret"], p["F_ul"]) for p in plain.special_points
    ]
    among = {tuple(x) for x in fine.states}
    assert all(tuple(x) in among for x in plain.states)
    assert fine.ends == plain.ends
    assert set(fine.stability) == {"marginal"}


@pytest.mark.slow
def test_rows_of_a_mechanisms_locus_are_folds_at_rest():
    locus = locus_of_gear()
    assert locus.residuals.max() < 1e-11
    for i in range(5, len(locus), 61):
        values, x = locus.parameters_at(i), locus.states[i]
        free = [Free("F_ret", 0.0, 8e5)]
        local = Local(locus.problem, x, values, ("F_ret",), True, ((0.0, 8e5),))
        fold = solve(system := System(locus.problem, values, free, [Fold(local)], accurate=True), x, system.start_y())
        assert fold.failure is None
        assert system.values(fold.y)["F_ret"] == pytest.approx(values["F_ret"], rel=1e-9)
        assert fold.x == pytest.approx(x, abs=1e-7)
        row = locus.row(i).eigenvalues
        assert np.abs(row).min() < 1e-4 * np.abs(row).max()


@pytest.mark.slow
def test_rows_between_cost_few_evaluations():
    costs, counts = [], []
    for chord in (math.inf, 3e-6):
        field = reaction()
        branch = mc.continue_equilibria(field, "D", bounds=(0.0, 0.6))
        before = field.evaluations
        counts.append(len(mc.continue_special(branch.of_kind("LP")[0], "B", bounds=(8.0, 24.0), chord=chord)))
        costs.append(field.evaluations - before)
    assert costs[1] - costs[0] < 3.5 * (counts[1] - counts[0])


@pytest.mark.slow
def test_a_curve_in_a_parameter_that_is_no_control_has_its_points_alone():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", (-50.0, 50.0), {"F": 50.0})
    found = [mc.continue_special(branch.point("LP1"), "k_j", bounds=(500.0, 2000.0), chord=c) for c in (3e-6, math.inf)]
    assert len(found[0]) == len(found[1])


@pytest.mark.slow
def test_the_table_of_a_locus_has_every_row(tmp_path):
    locus = locus_of_ab("LP")
    with locus.to_csv(tmp_path / "locus.csv").open() as file:
        rows = list(csv.reader(file))
    assert len([r for r in rows if r and not r[0].startswith("#")]) == len(locus) + 1


@pytest.mark.slow
def test_a_load_path_has_rows_between_its_points_that_rest():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 50.0), start={"F": 50.0})
    plain, fine = (mc.load_path(branch, "F", [50.0, -50.0], chord=c) for c in (math.inf, 3e-6))
    assert len(fine["F"]) > 3 * len(plain["F"])
    assert [j.before["F"] for j in fine.jumps] == pytest.approx([j.before["F"] for j in plain.jumps], abs=1e-9)
    assert fine["F"][fine.jumps[0].index] == pytest.approx(fine.jumps[0].before["F"], abs=1e-9)
    for segment in fine.segments:
        rows = segment.branch
        assert all(word != "unstable" for word in rows.stability)
        forces = [np.abs(mechanism.residual(x, rows.parameters_at(i))).max() for i, x in enumerate(rows.states)]
        assert max(forces) < 1e-9


@pytest.mark.slow
def test_a_load_path_in_two_controls_has_rows_between_its_points():
    gear = mc.Mechanism.from_xml("nose_gear")
    loads = [{"F_ret": 2.5e5, "F_ul": 0.0}, {"F_ret": 4e5, "F_ul": -300.0}]
    plain, fine = (mc.load_path(gear, loads, keyframe="uplock_above", chord=c) for c in (math.inf, 3e-6))
    assert fine.done and len(fine["F_ret"]) > len(plain["F_ret"])
    assert fine["F_ul"] == pytest.approx(-300.0 * (fine["F_ret"] - 2.5e5) / 1.5e5, abs=1e-9)
