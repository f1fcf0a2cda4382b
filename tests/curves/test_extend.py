"""Longer branches: a branch that was cut short and extended equals one that was followed in one go."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from problems.fields import ab, branch_of_ab, cusp

import mjcont as mc

BOUNDS = (0.0, 0.6)


def found(branch):
    """Return kind and first parameter of every special point, in order."""
    name = next(iter(branch.free))
    return [(p.label, p[name]) for p in branch.special_points]


def assert_same_points(branch, expected):
    assert [label for label, _ in found(branch)] == [label for label, _ in found(expected)]
    assert [value for _, value in found(branch)] == pytest.approx([value for _, value in found(expected)], rel=1e-9)


@cache
def beginning_of_ab(points=10):
    return mc.continue_equilibria(ab(18.0), "D", bounds=BOUNDS, max_points=points)


@cache
def middle_of_ab(direction=None):
    """Return a few points of ab between its first Hopf point and its first fold, where D still grows."""
    middle = branch_of_ab(18.0).at(v=1.42)[0]
    return mc.continue_equilibria(ab(18.0), "D", bounds=BOUNDS, start=middle, max_points=6, direction=direction)


@cache
def folds_of_ab(**options):
    return mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(8.0, 40.0), **options)


# -- branches of equilibria -----------------------------------------------------------------------------------


def test_a_branch_that_was_cut_short_has_no_special_points_yet():
    assert beginning_of_ab().special_points == ()
    assert beginning_of_ab().status == "max points"


@pytest.mark.slow
def test_an_extended_branch_has_the_special_points_of_the_whole_run():
    assert_same_points(mc.extend(beginning_of_ab()), branch_of_ab(18.0))


@pytest.mark.slow
def test_an_extended_branch_reaches_both_bounds():
    branch = mc.extend(beginning_of_ab())
    assert list(branch["D"][[0, -1]]) == list(BOUNDS)
    assert branch.status == "at bound"


@pytest.mark.slow
def test_a_branch_extended_in_many_pieces_has_the_special_points_of_the_whole_run():
    branch = beginning_of_ab()
    for _ in range(30):
        if branch.status != "max points":
            break
        branch = mc.extend(branch, max_points=10)
    assert branch.status == "at bound"
    assert_same_points(branch, branch_of_ab(18.0))


@pytest.mark.slow
def test_extending_goes_on_from_both_ends():
    branch = mc.extend(middle_of_ab())
    assert_same_points(branch, branch_of_ab(18.0))
    assert list(branch["D"][[0, -1]]) == list(BOUNDS)


@pytest.mark.slow
def test_the_start_stays_marked_when_points_are_put_before_it():
    before, after = middle_of_ab(), mc.extend(middle_of_ab())
    assert after["D"][after.start_index] == before["D"][before.start_index]
    assert after.start == before.start


@pytest.mark.slow
@pytest.mark.parametrize(("end", "bound"), [("first", 0.0), ("last", 0.6)])
def test_only_the_end_that_is_named_is_extended(end, bound):
    branch = mc.extend(middle_of_ab(), ends=[end])
    row, other = (0, -1) if end == "first" else (-1, 0)
    assert branch["D"][row] == bound
    assert branch["D"][other] == middle_of_ab()["D"][other]
    assert branch.ends[row][0] == "at bound"
    assert branch.ends[other][0] == "max points"


@pytest.mark.slow
@pytest.mark.parametrize("direction", [1, -1])
def test_a_branch_in_one_direction_is_extended_to_both_sides(direction):
    short = middle_of_ab(direction)
    branch = mc.extend(short)
    assert branch["D"][branch.start_index] == short["D"][short.start_index]
    assert sorted(branch["D"][[0, -1]]) == pytest.approx(list(BOUNDS), abs=1e-12)
    assert sorted(p.kind for p in branch.special_points) == ["HB", "HB", "LP", "LP"]
    assert sorted(p["D"] for p in branch.special_points) == pytest.approx(
        sorted(p["D"] for p in branch_of_ab(18.0).special_points), rel=1e-9
    )


@pytest.mark.slow
@pytest.mark.parametrize("label", ["HB1", "LP1", "LP2", "HB2"])
def test_a_branch_that_starts_at_a_special_point_in_one_direction_is_extended_to_both_sides(label):
    point = branch_of_ab(18.0).point(label)
    short = mc.continue_equilibria(ab(18.0), "D", bounds=BOUNDS, start=point, max_points=6, direction=1)
    branch = mc.extend(short)
    assert sorted(branch["D"][[0, -1]]) == pytest.approx(list(BOUNDS), abs=1e-12)
    assert sorted(p.kind for p in branch.special_points) == ["HB", "HB", "LP", "LP"]


@pytest.mark.slow
def test_wider_bounds_lengthen_a_branch():
    narrow = mc.continue_equilibria(ab(18.0), "D", bounds=(0.0, 0.1))
    assert narrow.special_points == ()
    wide = mc.extend(narrow, BOUNDS)
    assert_same_points(wide, branch_of_ab(18.0))
    assert dict(wide.free) == {"D": BOUNDS}


@pytest.mark.slow
def test_extending_keeps_the_points_that_are_there():
    wide = mc.extend(beginning_of_ab())
    size = len(beginning_of_ab())
    assert np.array_equal(wide.states[:size], beginning_of_ab().states)
    assert np.array_equal(wide["D"][:size], beginning_of_ab()["D"])


@pytest.mark.slow
def test_extending_does_not_change_the_branch_it_is_given():
    branch = beginning_of_ab()
    size, ends = len(branch), list(branch.ends)
    mc.extend(branch)
    assert len(branch) == size
    assert list(branch.ends) == ends


def test_a_branch_at_its_bounds_is_not_extended_without_wider_ones():
    branch = mc.extend(branch_of_ab(18.0))
    assert len(branch) == len(branch_of_ab(18.0))
    assert found(branch) == found(branch_of_ab(18.0))


@pytest.mark.slow
def test_points_follow_each_other_without_a_gap_where_an_extension_begins():
    branch = mc.extend(middle_of_ab())
    steps = np.linalg.norm(np.diff(branch.states, axis=0), axis=1)
    assert 0.0 < steps.min()
    assert steps.max() < 2.0 * np.linalg.norm(np.diff(branch_of_ab(18.0).states, axis=0), axis=1).max()


@pytest.mark.slow
def test_every_special_point_stands_in_its_row():
    branch = mc.extend(middle_of_ab())
    for p in branch.special_points:
        assert np.array_equal(branch.states[p.index], p.state)
        assert branch["D"][p.index] == p["D"]


@pytest.mark.slow
def test_a_mechanism_s_branch_is_extended(overcentre, overcentre_branch):
    short = mc.continue_equilibria(overcentre, "F", bounds=(-50.0, 60.0), start={"F": 50.0}, max_points=8)
    assert_same_points(mc.extend(short), overcentre_branch())


@pytest.mark.slow
def test_an_extended_branch_goes_on_looking_for_the_user_zeros_it_was_made_with():
    short = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), zeros={"x": 0.25}, max_points=5)
    whole = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), zeros={"x": 0.25})
    assert_same_points(mc.extend(short), whole)


@pytest.mark.slow
def test_an_interrupted_branch_is_extended_to_the_whole():
    def interrupt(count, special):
        if count == 20:
            raise KeyboardInterrupt

    short = mc.continue_equilibria(ab(18.0), "D", bounds=BOUNDS, progress=interrupt)
    assert short.interrupted
    assert_same_points(mc.extend(short), branch_of_ab(18.0))


def test_extend_is_still_a_function_after_it_was_used():
    mc.extend(beginning_of_ab(), max_points=2)
    assert callable(mc.extend)


# -- files ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_branch_that_was_saved_and_loaded_is_extended_to_the_bit_like_the_original(tmp_path):
    loaded = mc.load(beginning_of_ab().save(tmp_path / "short.h5"), problem=ab(18.0))
    one, other = mc.extend(loaded), mc.extend(beginning_of_ab())
    assert np.array_equal(one.states, other.states)
    assert found(one) == found(other)


@pytest.mark.slow
def test_a_mechanism_s_branch_that_was_saved_and_loaded_is_extended(tmp_path, overcentre, overcentre_branch):
    short = mc.continue_equilibria(overcentre, "F", bounds=(-50.0, 60.0), start={"F": 50.0}, max_points=8)
    loaded = mc.load(short.save(tmp_path / "short.h5"))
    assert_same_points(mc.extend(loaded), overcentre_branch())


@pytest.mark.slow
def test_a_locus_that_was_saved_and_loaded_is_extended(tmp_path):
    loaded = mc.load(folds_of_ab(max_points=6).save(tmp_path / "folds.h5"), problem=ab(18.0))
    assert_same_points(mc.extend(loaded), folds_of_ab())


# -- loci -----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_fold_curve_that_was_cut_short_is_extended_to_the_whole():
    short = folds_of_ab(max_points=6)
    assert short.special_points == ()
    assert_same_points(mc.extend(short), folds_of_ab())


@pytest.mark.slow
def test_a_fold_curve_is_extended_into_wider_bounds():
    short = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(17.0, 20.0))
    assert short.special_points == ()
    assert_same_points(mc.extend(short, {"B": (8.0, 40.0)}), folds_of_ab())


@pytest.mark.slow
def test_an_extended_fold_curve_obeys_its_closed_form():
    locus = mc.extend(folds_of_ab(max_points=6))
    assert locus["u"] * (1.0 - locus["u"]) == pytest.approx(4.0 / locus["B"], abs=1e-8)


@pytest.mark.long
def test_a_hopf_curve_that_was_cut_short_is_extended_to_the_whole_and_no_further():
    point = branch_of_ab(18.0).point("HB2")
    short = mc.continue_special(point, "B", bounds=(8.0, 24.0), max_points=6)
    whole = mc.continue_special(point, "B", bounds=(8.0, 24.0))
    locus = mc.extend(short)
    assert_same_points(locus, whole)
    assert locus["u"].min() == pytest.approx(0.25, abs=1e-8)


@pytest.mark.slow
def test_a_hopf_curve_that_ended_at_its_bogdanov_takens_point_stays_as_it_is():
    whole = mc.continue_special(branch_of_ab(18.0).point("HB2"), "B", bounds=(8.0, 24.0))
    locus = mc.extend(whole, max_points=10)
    assert len(locus) == len(whole)
    assert [word for word, _ in locus.ends] == [word for word, _ in whole.ends]


@pytest.mark.slow
def test_a_curve_of_cusps_is_extended():
    def f(u, p):
        return [p["mu"] + p["la"] * u[0] + p["e"] * u[0] ** 2 - u[0] ** 3]

    field = mc.VectorField(f, [-1.2098], {"mu": -1.0, "la": 1.0, "e": 0.3}, names=["x"])
    branch = mc.continue_equilibria(field, "mu", bounds=(-2.0, 2.0))
    folds = mc.continue_special(branch.point("LP1"), "la", bounds=(-2.0, 2.0))
    short = mc.continue_special(folds.point("CP1"), "e", bounds=(-2.0, 2.0), max_points=4)
    locus = mc.extend(short)
    assert sorted(locus["e"][[0, -1]]) == pytest.approx([-2.0, 2.0], abs=1e-12)
    assert locus["mu"] == pytest.approx(locus["e"] ** 3 / 27.0, abs=1e-8)


# -- mistakes -------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_closed_branch_has_no_ends_to_extend():
    field = mc.VectorField(lambda u, p: [u[0] ** 2 + p["la"] ** 2 - 1.0], [-1.0], {"la": 0.0})
    closed = mc.continue_equilibria(field, "la", bounds=(-2.0, 2.0))
    with pytest.raises(mc.MjcontError, match="the branch is closed: it has no ends to extend"):
        mc.extend(closed)


def test_a_branch_that_was_loaded_without_its_problem_is_not_extended(tmp_path):
    loaded = mc.load(beginning_of_ab().save(tmp_path / "short.h5"))
    with pytest.raises(mc.MjcontError, match=r"loaded without its problem: mc\.load\(path, problem=\.\.\.\)"):
        mc.extend(loaded)


def test_ends_other_than_first_and_last_are_refused():
    with pytest.raises(mc.ParameterError, match="ends must be among first, last; got 'left'"):
        mc.extend(beginning_of_ab(), ends=["left"])


def test_a_locus_wants_its_bounds_by_name():
    with pytest.raises(mc.ParameterError, match=r"several parameters are free \(D, B\): give bounds as a mapping"):
        mc.extend(folds_of_ab(max_points=6), (8.0, 50.0))


def test_bounds_of_a_parameter_that_is_not_free_on_the_branch_are_refused():
    with pytest.raises(mc.ParameterError, match=r"'B' is not free on this branch\. Free: D"):
        mc.extend(beginning_of_ab(), {"B": (8.0, 40.0)})


def test_bounds_that_do_not_increase_are_refused():
    with pytest.raises(mc.BoundsError, match="bounds of D must be finite with low < high"):
        mc.extend(beginning_of_ab(), (0.6, 0.0))


@pytest.mark.parametrize("bounds", [(0.2, 0.6), (-math.inf, 0.6)])
def test_bounds_that_leave_out_what_is_there_are_refused(bounds):
    with pytest.raises(mc.BoundsError):
        mc.extend(beginning_of_ab(), bounds)


def test_an_unknown_option_of_an_extension_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'dsmax'.*Did you mean ds_max"):
        mc.extend(beginning_of_ab(), dsmax=0.1)


@pytest.mark.slow
def test_a_cusp_s_branch_keeps_the_options_it_was_made_with():
    short = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), max_points=5, ds_max=0.01, direction=1)
    branch = mc.extend(short)
    assert np.abs(np.diff(branch["x"])).max() < 0.011
