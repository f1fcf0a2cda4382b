"""Where loci start and end, and what is said where one cannot be followed."""

from __future__ import annotations

import itertools
import math
from functools import cache

import numpy as np
import pytest
from problems.fields import ab, branch_of_ab
from problems.loci import folds_of_ab, hopfs_of_ab, kinds, only

import mjcont as mc

# -- starts and ends ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_user_zeros_on_a_locus_are_located_to_1e_10():
    locus = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(15.0, 30.0), zeros={"u": 0.2})
    points = locus.of_kind("UZ")
    assert [p["u"] for p in points] == pytest.approx([0.2], rel=1e-10)
    assert [p["B"] for p in points] == pytest.approx([25.0], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("direction", [1, -1])
def test_a_locus_in_one_direction_first_moves_its_new_parameter_that_way(direction):
    point = branch_of_ab(18.0).point("LP1")
    locus = mc.continue_special(point, "B", bounds=(15.0, 22.0), direction=direction)
    away = locus["B"][locus.start_index + 1 :] if direction > 0 else locus["B"][: locus.start_index][::-1]
    assert locus["B"][locus.start_index] == pytest.approx(18.0, rel=1e-10)
    assert (away[0] - 18.0) * direction > 0


def test_a_locus_ends_at_a_kind_of_point_that_is_named():
    locus = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(8.0, 40.0), end_at=["CP"], direction=-1)
    assert locus.status == "at special point"
    assert kinds(locus) == ["CP"]


def test_a_locus_keeps_the_bounds_of_the_first_parameter_unless_others_are_given():
    point = branch_of_ab(18.0).point("LP1")
    assert mc.continue_special(point, "B", bounds=(17.0, 19.0)).free["D"] == (0.0, 0.6)
    wider = mc.continue_special(point, "B", bounds={"B": (17.0, 19.0), "D": (0.0, 1.0)})
    assert wider.free["D"] == (0.0, 1.0)


@pytest.mark.long
def test_the_same_locus_is_the_same_to_the_bit():
    once, again = (mc.continue_special(branch_of_ab(18.0).point("HB2"), "B", bounds=(10.0, 20.0)) for _ in range(2))
    assert np.array_equal(once.states, again.states)
    assert np.array_equal(once["D"], again["D"])
    assert [p.coefficients for p in once.special_points] == [p.coefficients for p in again.special_points]


@pytest.mark.long
def test_points_of_a_locus_do_not_depend_on_the_step():
    fine = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(8.0, 40.0), ds_max=0.01)
    assert len(fine) > 1.5 * len(folds_of_ab())
    for a, b in zip(fine.special_points, folds_of_ab().special_points, strict=True):
        assert a.label == b.label
        assert [a["D"], a["B"]] == pytest.approx([b["D"], b["B"]], rel=1e-9)


# -- mistakes -----------------------------------------------------------------------------------------------------


@cache
def marked_ab():
    return mc.continue_equilibria(ab(18.0), "D", bounds=(0.0, 0.1), zeros={"u": 0.1})


def test_a_user_zero_has_no_curve_to_follow():
    with pytest.raises(mc.MjcontError, match=r"kind UZ has no curve to follow.*LP, HB, BP, CP, BT, ZH"):
        mc.continue_special(marked_ab().point("UZ1"), "B")


def test_a_parameter_that_is_free_already_cannot_be_freed():
    with pytest.raises(mc.ParameterError, match="D is already free on the curve of LP1"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "D")


def test_bounds_of_a_parameter_that_is_not_free_are_refused():
    bounds = {"B": (8.0, 40.0), "C": (0.0, 1.0)}
    with pytest.raises(mc.ParameterError, match=r"bounds are given for 'C', which is not free here\. Free: D, B"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds)


def test_bounds_that_exclude_the_special_point_are_refused():
    with pytest.raises(mc.BoundsError, match=r"LP1 has B = 18, outside the bounds 20 \.\. 30"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (20.0, 30.0))


@pytest.mark.parametrize("bounds", [(30.0, 10.0), (8.0, math.inf), (8.0, 8.0)])
def test_bounds_of_a_locus_that_are_no_increasing_finite_pair_are_refused(bounds):
    with pytest.raises(mc.BoundsError, match="bounds of B must be finite with low < high"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds)


def test_an_unknown_parameter_of_a_locus_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'b'.*B"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "b")


def test_an_unknown_option_of_a_locus_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'dsmax'.*Did you mean ds_max"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), dsmax=0.1)


def test_a_direction_of_a_locus_other_than_up_or_down_is_refused():
    with pytest.raises(mc.ParameterError, match=r"direction must be None, \+1 or -1, got 0"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), direction=0)


def test_an_unknown_kind_to_end_at_is_refused():
    with pytest.raises(mc.MjcontError, match="XX"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), end_at=["XX"])


@pytest.mark.slow
def test_a_generalised_hopf_point_has_no_curve_to_follow():
    with pytest.raises(mc.MjcontError, match="kind GH has no curve to follow"):
        mc.continue_special(only(hopfs_of_ab(), "GH"), "B")


@pytest.mark.slow
def test_special_points_stand_in_order_along_a_locus():
    rows = [p.index for p in folds_of_ab().special_points]
    assert all(a < b for a, b in itertools.pairwise(rows))
