"""Rows between the points of a branch: chords stay as close to the curve as asked, at two evaluations a row."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.marks import long
from problems.mechanisms import branch_of, column, scaled
from problems.reference import BOUNDS, START
from problems.rowmodels import BALL, CROSSED

import mjcont as mc
from mjcont.curves.collect import ordered_rows, run_directions
from mjcont.curves.rows import curve_rows
from mjcont.curves.walkers import equilibrium_walker
from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System


def distances(points, polyline):
    """Return how far points (M, k) lie from the nearest of the straight lines between others (N, k)."""
    start, chord = polyline[:-1], np.diff(polyline, axis=0)
    square = np.maximum((chord**2).sum(axis=1), 1e-300)
    found = []
    for p in points:
        along = np.clip(((p - start) * chord).sum(axis=1) / square, 0.0, 1.0)
        found.append(np.sqrt((((start + along[:, None] * chord) - p) ** 2).sum(axis=1).min()))
    return np.array(found)


@pytest.mark.slow
@pytest.mark.parametrize("chord", [long(1e-4), 3e-6])
@pytest.mark.parametrize(
    ("model", "k_j"), [("overcentre", 1e3), ("overcentre", 1e6), ("nose_gear", 1e3), ("nose_gear_full", 1e3)]
)
def test_chords_stay_as_close_to_the_curve_as_asked(model, k_j, chord):
    fine = scaled(branch_of(model, chord / 30.0, k_j))[:: 7 if chord > 1e-5 else 41]
    assert distances(fine, scaled(branch_of(model, chord, k_j))).max() < 1.1 * chord


@pytest.mark.slow
@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full"])
def test_points_and_special_points_are_rows_whatever_lies_between(model):
    plain, fine = branch_of(model, math.inf), branch_of(model)
    assert len(fine) > 3 * len(plain)
    among = scaled(fine)
    for point in scaled(plain):
        assert np.abs(among - point).max(axis=1).min() < 1e-12
    assert [p.label for p in fine.special_points] == [p.label for p in plain.special_points]
    for a, b in zip(fine.special_points, plain.special_points, strict=True):
        assert fine.states[a.index] == pytest.approx(b.state, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full"])
def test_rows_follow_each_other_along_the_curve(model):
    chords = np.diff(scaled(branch_of(model)), axis=0)
    lengths = np.linalg.norm(chords, axis=1)
    assert lengths.max() < 0.055
    ahead = chords[lengths > 1e-6] / lengths[lengths > 1e-6, None]
    assert (ahead[1:] * ahead[:-1]).sum(axis=1).min() > math.cos(math.radians(3.0))


@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full"])
def test_rows_have_small_residuals(model):
    branch = branch_of(model)
    assert branch.residuals.max() < 1e-11
    found = [
        np.abs(branch.problem.residual(x, branch.parameters_at(i))).max() for i, x in enumerate(branch.states)
    ]
    assert max(found) < 8e-8  # N and N m: 1e-13 of loads of up to 800 kN


def test_a_straight_curve_needs_no_rows_between():
    mechanism = column(3)
    plain, fine = (mc.continue_equilibria(mechanism, "P", (0.0, 2.0), direction=1, chord=c) for c in (math.inf, 1e-8))
    assert len(fine) == len(plain)


@pytest.mark.slow
def test_a_row_costs_little_more_than_two_evaluations():
    counts = []
    for chord in (math.inf, 3e-7):
        mechanism = mc.Mechanism.from_xml("overcentre")
        branch = mc.continue_equilibria(mechanism, "F", BOUNDS, {"F": START}, chord=chord)
        counts.append((mechanism.evaluations, len(branch)))
    (walk, points), (evaluations, rows) = counts
    assert rows > 10 * points
    assert evaluations - walk < 2.2 * (rows - points)


def test_rows_of_a_mechanism_with_a_ball_joint_balance_its_forces():
    mechanism = mc.Mechanism.from_xml(BALL)
    plain, fine = (mc.continue_equilibria(mechanism, "P", (0.0, 3.0), direction=1, chord=c) for c in (math.inf, 1e-6))
    assert len(fine) > 5 * len(plain)
    assert np.linalg.norm(fine.states, axis=1) == pytest.approx(np.ones(len(fine)), abs=1e-14)
    for x, p in zip(fine.states, fine["P"], strict=True):
        # moment of the force about the joint against the spring: both along the axis of the turn
        angle = 2.0 * math.acos(min(x[0], 1.0))
        assert p * math.hypot(1.0, 0.3) * math.cos(angle) == pytest.approx(angle, abs=1e-10)
    assert np.diff(fine["P"]).min() > 0.0


TOO_SMALL = r"chord must be 1e-09 or more \(inf adds no rows\), got"


@pytest.mark.parametrize(
    ("chord", "said"), [(0.0, TOO_SMALL), (-1e-6, TOO_SMALL), (1e-12, TOO_SMALL), (math.nan, "chord must be a number")]
)
def test_a_chord_that_is_too_small_is_refused(chord, said):
    with pytest.raises(mc.ParameterError, match=said):
        mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START}, chord=chord)


def test_a_singular_matrix_costs_its_own_row_only():
    matrices = np.array([np.eye(3), np.zeros((3, 3)), 2.0 * np.eye(3)])
    found = inverses(matrices)
    assert np.isnan(found[1]).all()
    assert found[0] == pytest.approx(np.eye(3))
    assert found[2] == pytest.approx(0.5 * np.eye(3))


@pytest.mark.slow
def test_rows_that_do_not_settle_are_left_out_and_a_note_says_so(monkeypatch):
    plain, fine = branch_of("overcentre", math.inf), branch_of("overcentre")
    assert not fine.notes
    monkeypatch.setattr("mjcont.numerics.walk.between._ERROR", -1.0)  # no residual is that small
    branch = mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START})
    assert len(branch) == len(plain)
    missing = len(fine) - len(plain)
    assert branch.notes == (f"{missing} rows between points did not settle and are left out: chords are longer there",)


# -- stability ------------------------------------------------------------------------------------------------


def test_stability_changes_at_special_points_and_nowhere_else():
    branch = branch_of("overcentre")
    marks = [p.index for p in branch.special_points]
    for first, last in zip([0, *marks], [*marks, len(branch)], strict=True):
        inner = branch.stability[first + 1 : last]
        assert len(inner) > 50
        assert set(inner) == {inner[0]}
    assert list(branch.stability[marks]) == ["marginal", "marginal"]


@pytest.mark.parametrize("told", [True, False])
def test_rows_on_both_sides_of_a_double_crossing_have_the_stability_of_their_side(told):
    """Without the special point that tells where eigenvalues pass, rows between that disagree have spectra."""
    mechanism = mc.Mechanism.from_xml(CROSSED)
    x, values = mechanism.start_state(), mechanism.values({"P": 0.0})
    system = System(mechanism, values, [Free("P", 0.0, 2.0)])
    walker = equilibrium_walker(system, Settings(), {})
    (run,) = run_directions(walker, x, system.start_y(), (1.0,), None)
    assert [e.kind for e in run.special] == ["BP"]
    rows = curve_rows(system, [r for r in ordered_rows(run) if told or r[1] is None], 1e-6)
    loads, (words, counts, spectra) = rows.column(0), rows.stability(lambda special, s: (s.stability, s.n_unstable))
    assert len(rows) > 5 * len(run.points)
    own = [s is not None and p is None for s, p in zip(spectra, rows.points, strict=True)]
    assert any(own) is not told
    for p, word, count in zip(loads, words, counts, strict=True):
        if abs(p - 1.0) > 1e-6:
            assert (word, count) == (("stable", 0) if p < 1.0 else ("unstable", 2))


# -- ends -----------------------------------------------------------------------------------------------------


def test_a_branch_that_leaves_its_limits_ends_at_its_first_row_outside():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(
        mechanism, "F", BOUNDS, {"F": START}, direction=-1, limits={"theta_1": (-0.1, 10.0)}
    )
    assert branch.status == "stopped"
    outside = branch["theta_1"] < -0.1
    assert np.flatnonzero(outside).tolist() in ([0], [len(branch) - 1])


def test_an_interrupted_branch_holds_the_points_that_were_reached():
    def impatient(count, special):
        if count == 9:
            raise KeyboardInterrupt

    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", BOUNDS, {"F": START}, progress=impatient)
    assert branch.interrupted
    assert len(branch) == 10


def test_an_interrupt_while_rows_are_laid_keeps_the_points(monkeypatch):
    def interrupted(*arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr("mjcont.curves.rows.rows_between", interrupted)
    branch = mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START})
    assert branch.interrupted
    assert len(branch) == len(branch_of("overcentre", math.inf))
    assert [p.label for p in branch.special_points] == ["LP1", "LP2"]


@pytest.mark.slow
def test_what_a_branch_is_extended_by_has_rows_as_close():
    mechanism = mc.Mechanism.from_xml("overcentre")
    short = mc.continue_equilibria(mechanism, "F", (-20.0, 20.0), {"F": 15.0})
    longer = mc.extend(short, bounds=BOUNDS)
    fine = branch_of("overcentre", 1e-7)
    scale = mechanism.state_scale
    width = BOUNDS[1] - BOUNDS[0]
    points, polyline = (np.column_stack([b.states / scale, b["F"] / width]) for b in (fine, longer))
    assert distances(points[::29], polyline).max() < 1.1 * 3e-6
