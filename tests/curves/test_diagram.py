"""Branch switching and whole diagrams, on equations whose branches are known curves."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from problems.crossings import HEIGHT, circle_and_line, circle_and_two_lines, pitchfork, transcritical, two_modes

import mjcont as mc

WIDTH = math.sqrt(1.0 - HEIGHT**2)


@cache
def branch_of(problem):
    return mc.continue_equilibria(problem(), "mu", bounds=(-1.0, 1.0))


@cache
def diagram_of(problem, low, high):
    return mc.bifurcation_diagram(problem(), "mu", bounds=(low, high))


def coordinates(point):
    return tuple(round(float(v), 6) + 0.0 for v in (point["mu"], *point.state))


# -- switching ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_switching_at_a_pitchfork_gives_the_straight_branch_and_the_parabola():
    straight, parabola = sorted(mc.switch_branches(branch_of(pitchfork).point("BP1")), key=lambda b: np.ptp(b["x"]))
    assert straight["x"] == pytest.approx(np.zeros(len(straight)), abs=1e-12)
    assert straight["mu"][[0, -1]] == pytest.approx([-1.0, 1.0], abs=1e-12)
    assert parabola["mu"] == pytest.approx(parabola["x"] ** 2, abs=1e-10)
    assert sorted(parabola["x"][[0, -1]]) == pytest.approx([-1.0, 1.0], rel=1e-10)


@pytest.mark.slow
def test_switching_at_a_transcritical_point_gives_both_lines():
    flat, slanted = sorted(mc.switch_branches(branch_of(transcritical).point("BP1")), key=lambda b: np.ptp(b["x"]))
    assert flat["x"] == pytest.approx(np.zeros(len(flat)), abs=1e-12)
    assert slanted["x"] == pytest.approx(slanted["mu"], abs=1e-10)
    assert slanted["mu"][[0, -1]] == pytest.approx([-1.0, 1.0], abs=1e-12)


@pytest.mark.slow
def test_stability_changes_hands_at_a_transcritical_point():
    for branch in mc.switch_branches(branch_of(transcritical).point("BP1")):
        on_zero = np.ptp(branch["x"]) < 1e-9
        before, after = branch["mu"] < -1e-6, branch["mu"] > 1e-6
        assert set(branch.stability[before]) == ({"stable"} if on_zero else {"unstable"})
        assert set(branch.stability[after]) == ({"unstable"} if on_zero else {"stable"})


@pytest.mark.slow
def test_a_switched_branch_carries_its_branch_point_in_its_place():
    for branch in mc.switch_branches(branch_of(transcritical).point("BP1")):
        (point,) = branch.special_points
        assert point.kind == "BP"
        assert point.index == branch.start_index
        assert branch["mu"][point.index - 1] < point["mu"] < branch["mu"][point.index + 1]


@pytest.mark.slow
def test_a_switched_branch_says_which_branch_point_it_comes_from():
    for branch in mc.switch_branches(branch_of(transcritical).point("BP1")):
        assert "through BP1" in branch.start


def test_switching_keeps_to_the_bounds_that_are_given():
    for branch in mc.switch_branches(branch_of(transcritical).point("BP1"), bounds=(-0.2, 0.4)):
        assert branch["mu"][[0, -1]] == pytest.approx([-0.2, 0.4], abs=1e-12)


@pytest.mark.slow
def test_the_halves_of_a_pitchfork_that_mirror_each_other_are_noted():
    branches = mc.switch_branches(branch_of(pitchfork).point("BP1"))
    notes = [b.notes for b in sorted(branches, key=lambda b: np.ptp(b["x"]))]
    assert notes == [(), ("its two halves are mirror images",)]


# -- diagrams -------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_diagram_of_a_circle_and_a_line_has_both_curves_once():
    diagram = diagram_of(circle_and_line, -2.0, 2.0)
    line, circle = diagram
    assert line["x"] == pytest.approx(np.full(len(line), HEIGHT), abs=1e-10)
    assert circle["x"] ** 2 + circle["mu"] ** 2 == pytest.approx(np.ones(len(circle)), abs=1e-10)
    assert circle.status == "closed"


@pytest.mark.slow
@pytest.mark.parametrize("row", [0, 1], ids=["line", "circle"])
def test_each_curve_carries_every_crossing_once(row):
    points = diagram_of(circle_and_line, -2.0, 2.0)[row].of_kind("BP")
    assert sorted(p["mu"] for p in points) == pytest.approx([-WIDTH, WIDTH], rel=1e-10)


def test_a_circle_entered_through_a_crossing_has_its_two_folds():
    circle = diagram_of(circle_and_line, -2.0, 2.0)[1]
    assert sorted(p["mu"] for p in circle.of_kind("LP")) == pytest.approx([-1.0, 1.0], rel=1e-10)


@pytest.mark.slow
def test_three_curves_that_all_cross_each_other_are_found_once_each():
    diagram = diagram_of(circle_and_two_lines, -2.0, 2.0)
    assert len(diagram) == 3
    half = 1.0 / math.sqrt(1.25)
    expected = [(-WIDTH, HEIGHT), (-half, -half / 2.0), (0.6, HEIGHT), (half, half / 2.0), (WIDTH, HEIGHT)]
    found = {coordinates(p) for p in diagram.special_points if p.kind == "BP"}
    assert np.array(sorted(found)) == pytest.approx(np.array(expected), abs=1e-6)


@pytest.mark.slow
def test_secondary_branches_are_followed_from_branches_that_were_switched_to():
    diagram = diagram_of(two_modes, 0.0, 4.5)
    found = {coordinates(p) for p in diagram.special_points if p.kind == "BP"}
    root = round(math.sqrt(2.0), 6)
    assert found == {(1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (3.0, root, 0.0), (3.0, -root, 0.0)}
    assert len(diagram) == 5


@pytest.mark.slow
def test_the_mixed_branches_of_two_modes_follow_their_closed_form():
    mixed = [b for b in diagram_of(two_modes, 0.0, 4.5) if np.ptp(b["x"]) > 0.1 and np.ptp(b["y"]) > 0.1]
    assert len(mixed) == 2
    for branch in mixed:
        x2, y2 = branch["x"] ** 2, branch["y"] ** 2
        assert branch["mu"] - 1.0 == pytest.approx(x2 + 0.5 * y2, abs=1e-9)
        assert branch["mu"] - 2.0 == pytest.approx(y2 + 0.5 * x2, abs=1e-9)


@pytest.mark.slow
def test_several_starts_on_one_branch_give_it_once():
    starts = [{"mu": -0.5}, {"mu": 0.5}, {"mu": -0.7}]
    diagram = mc.bifurcation_diagram(pitchfork(), "mu", bounds=(-1.0, 1.0), starts=starts)
    assert len(diagram) == 2


@pytest.mark.slow
def test_starts_on_branches_that_nothing_connects_give_both():
    field = mc.VectorField(
        lambda u, p: [-(u[0] ** 2 - 1.0) * (u[0] - 2.0 + 0.1 * p["mu"])], [1.0], {"mu": 0.0}, names=["x"]
    )
    low = mc.find_equilibrium(field, state=[-1.0])
    diagram = mc.bifurcation_diagram(field, "mu", bounds=(-1.0, 1.0), starts=[low, {"mu": 0.0}])
    assert [b["x"][0] for b in diagram] == pytest.approx([-1.0, 1.0], rel=1e-10)


@pytest.mark.slow
def test_a_diagram_is_indexed_and_iterated_by_branch():
    diagram = diagram_of(pitchfork, -1.0, 1.0)
    assert [diagram[i] for i in range(len(diagram))] == list(diagram)


def test_the_summary_of_a_diagram_has_that_of_every_branch():
    text = str(diagram_of(pitchfork, -1.0, 1.0))
    assert "2 branches" in text
    assert text.count("BP1 (branch point)") == 2


@pytest.mark.slow
def test_the_limit_on_the_number_of_branches_is_kept_and_noted():
    diagram = mc.bifurcation_diagram(two_modes(), "mu", bounds=(0.0, 4.5), max_branches=3)
    assert len(diagram) == 3
    assert diagram.notes == ("the limit of 3 branches was reached",)


def test_an_imperfect_pitchfork_has_only_the_branch_of_its_start():
    def f(u, p):
        return [p["mu"] * u[0] - u[0] ** 3 + 0.01]

    field = mc.VectorField(f, [0.01], {"mu": -1.0}, names=["x"])
    (branch,) = mc.bifurcation_diagram(field, "mu", bounds=(-1.0, 1.0))
    assert branch.special_points == ()
    assert np.all(branch["x"] > 0.0)


@pytest.mark.long
def test_the_same_diagram_is_the_same_to_the_bit():
    once, again = (mc.bifurcation_diagram(two_modes(), "mu", bounds=(0.0, 4.5)) for _ in range(2))
    for a, b in zip(once, again, strict=True):
        assert np.array_equal(a.states, b.states)
        assert np.array_equal(a["mu"], b["mu"])


@pytest.mark.slow
@pytest.mark.parametrize("ds_max", [0.1, 0.02])
def test_the_branches_of_a_diagram_do_not_depend_on_the_step(ds_max):
    diagram = mc.bifurcation_diagram(two_modes(), "mu", bounds=(0.0, 4.5), ds_max=ds_max)
    labels = [[p.label for p in b.special_points] for b in diagram]
    assert labels == [[p.label for p in b.special_points] for b in diagram_of(two_modes, 0.0, 4.5)]


# -- mistakes -------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_only_branch_points_have_branches_to_switch_to():
    field = mc.VectorField(lambda u, p: [p["mu"] - u[0] ** 2], [1.0], {"mu": 1.0})
    fold = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0)).point("LP1")
    with pytest.raises(mc.MjcontError, match="LP1 is no branch point of equilibria"):
        mc.switch_branches(fold)


@pytest.mark.slow
def test_a_branch_point_of_a_fold_curve_has_no_branches_to_switch_to():
    field = mc.VectorField(lambda u, p: [u[0] ** 2 + p["la"] ** 2 - p["mu"]], [1.0], {"la": 0.0, "mu": 1.0})
    branch = mc.continue_equilibria(field, "la", bounds=(-2.0, 2.0))
    locus = mc.continue_special(branch.point("LP1"), "mu", bounds=(-1.0, 2.0))
    with pytest.raises(mc.MjcontError, match="BP1 is no branch point of equilibria"):
        mc.switch_branches(locus.point("BP1"))


def test_bounds_to_switch_within_must_increase():
    with pytest.raises(mc.BoundsError, match="bounds of mu must be finite with low < high"):
        mc.switch_branches(branch_of(pitchfork).point("BP1"), bounds=(1.0, -1.0))


def test_bounds_to_switch_within_must_hold_the_branch_point():
    with pytest.raises(mc.BoundsError, match="BP1 has mu"):
        mc.switch_branches(branch_of(pitchfork).point("BP1"), bounds=(0.5, 1.0))


def test_an_unknown_option_of_a_diagram_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'dsmax'.*Did you mean ds_max"):
        mc.bifurcation_diagram(pitchfork(), "mu", bounds=(-1.0, 1.0), dsmax=0.1)


def test_an_unknown_parameter_of_a_diagram_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'nu'.*Valid: mu"):
        mc.bifurcation_diagram(pitchfork(), "nu", bounds=(-1.0, 1.0))


def test_an_unknown_keyframe_of_a_diagram_is_named():
    with pytest.raises(mc.NameLookupError, match="unknown keyframe 'up'"):
        mc.bifurcation_diagram(pitchfork(), "mu", bounds=(-1.0, 1.0), keyframes=["up"])


@pytest.mark.slow
def test_user_zeros_are_located_on_every_branch_of_a_diagram():
    field = mc.VectorField(lambda u, p: [p["a"] * u[0] - u[0] ** 3], [0.0], {"a": -0.5})
    diagram = mc.bifurcation_diagram(field, "a", (-1.0, 1.0), zeros={"a": (-0.25, 0.25)})
    assert len(diagram) == 2
    assert [sorted(p["a"] for p in b.of_kind("UZ")) for b in diagram] == [
        pytest.approx([-0.25, 0.25]), pytest.approx([0.25, 0.25])
    ]
