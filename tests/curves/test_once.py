"""A special point is found once, also where a point of the curve lies on it to the last bit."""

from __future__ import annotations

import pytest
from problems.curves import labels, scalar

import mjcont as mc


@pytest.mark.slow
def test_a_fold_on_which_a_curve_starts_is_found_once():
    """u^2 = p at u = 0: the slope of the parameter there is zero to the last bit, or rounding of either sign."""
    for start in (0.0, 1e-18, -1e-18):
        branch = mc.continue_equilibria(scalar(lambda x, p: p["la"] - x**2, start, la=0.0), "la", bounds=(-1.0, 1.0))
        assert labels(branch) == ["LP1"]


@pytest.mark.parametrize("value", [-1.0, 0.5, 1.0])
def test_a_zero_at_the_start_or_on_a_bound_is_found_once(value):
    line = scalar(lambda x, p: p["la"] - x, 0.5, la=0.5)
    branch = mc.continue_equilibria(line, "la", bounds=(-1.0, 1.0), zeros={"x": value})
    assert [(p.label, p["la"]) for p in branch.special_points] == [("UZ1", pytest.approx(value, abs=1e-12))]


@pytest.mark.slow
def test_a_branch_point_on_which_a_point_lies_is_found_once():
    """The orientation vanishes there to the last bit; x (la - x) = 0 at la = 0, met by steps of a hundredth."""
    crossing = scalar(lambda x, p: x * (p["la"] - x), 0.0, la=-0.5)
    branch = mc.continue_equilibria(crossing, "la", bounds=(-1.0, 1.0), ds=0.01, ds_max=0.01)
    assert labels(branch) == ["BP1"]
    assert branch.point("BP1")["la"] == pytest.approx(0.0, abs=1e-10)
