"""`max_seconds` holds to one evaluation, over starts, points and both directions together.

Time is that of a clock which every evaluation of f moves on by a second.
"""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc
from mjcont.numerics.equations import clock

LIMIT = 400.0


class Ticking:
    """A clock to put in the place of the module `time`."""

    def __init__(self):
        self.now = 0.0

    def monotonic(self):
        return self.now


@pytest.fixture
def ticking(monkeypatch):
    own = Ticking()
    monkeypatch.setattr(clock, "time", own)
    return own


@pytest.fixture
def field(ticking):
    """A long closed curve of equilibria."""

    def f(u, p):
        ticking.now += 1.0
        return [u[0] ** 2 + p["mu"] ** 2 - 1.0 + 0.1 * np.sin(7.0 * u[1]), u[1] - 0.2 * u[0]]

    return mc.VectorField(f, [1.0, 0.2], {"mu": 0.0}, names=["x", "y"])


@pytest.mark.parametrize("direction", [None, 1])
def test_a_branch_keeps_what_it_has_by_then(field, ticking, direction):
    branch = mc.continue_equilibria(field, "mu", bounds=(-2, 2), max_seconds=LIMIT, direction=direction)
    # what f is asked for where it is a point's own (its row in the result) may follow
    assert LIMIT < ticking.now <= LIMIT + 10.0
    assert branch.status == "max time"
    assert f"the limit of {LIMIT:g} s was reached" in branch.message
    assert len(branch) > 3


def test_a_limit_that_the_first_direction_uses_up_leaves_none_for_the_second(ticking):
    def f(u, p):
        ticking.now += 1.0
        return [p["mu"] - u[0] - u[0] ** 3]

    branch = mc.continue_equilibria(mc.VectorField(f, [0.0], {"mu": 0.0}), "mu", bounds=(-50, 50), max_seconds=100.0)
    assert [word for word, _ in branch.ends] == ["max time", "max time"]
    assert ticking.now <= 110.0


def test_a_start_that_takes_too_long_is_an_error(field, ticking):
    with pytest.raises(mc.StartError, match="the limit of 100 s was reached"):
        mc.continue_equilibria(field, "mu", bounds=(-2, 2), state=[500.0, 5.0], max_seconds=100.0)
    assert ticking.now <= 101.0


def test_a_search_keeps_what_it_has_by_then(field, ticking):
    found = mc.find_equilibria(field, starts=500, max_seconds=LIMIT)
    before = 10.0  # what is asked before the search begins
    assert LIMIT < ticking.now <= LIMIT + before + 1.0
    assert f"the limit of {LIMIT:g} s was reached" in found.status
    assert len(found) >= 1


def test_an_iterator_does_not_count_the_callers_own_time(field, ticking):
    points = 0
    for _ in mc.iterate_equilibria(field, "mu", bounds=(-2, 2), max_seconds=LIMIT):
        points += 1
    assert points > 3
    assert LIMIT < ticking.now <= LIMIT + 10.0
    mc.find_equilibrium(field)  # no limit is left behind


def test_a_diagram_is_limited_as_a_whole(field, ticking):
    diagram = mc.bifurcation_diagram(field, "mu", (-2.0, 2.0), max_seconds=LIMIT)
    assert ticking.now <= LIMIT + 20.0
    assert len(diagram.branches) == 1


def test_a_locus_is_limited(ticking):
    def f(u, p):
        ticking.now += 1.0
        return [p["mu"] + p["nu"] * u[0] - u[0] ** 3]

    cusp = mc.VectorField(f, [1.5], {"mu": 1.0, "nu": 1.0})
    fold = mc.continue_equilibria(cusp, "mu", bounds=(-2.0, 2.0), start={"mu": 2.0}).of_kind("LP")[0]
    began = ticking.now
    locus = mc.continue_special(fold, "nu", bounds=(0.1, 3.0), max_seconds=LIMIT)
    assert locus.status == "max time"
    assert ticking.now <= began + LIMIT + 60.0  # normal forms of the points that were found


def test_a_load_path_is_limited_as_a_whole(ticking):
    def f(u, p):
        ticking.now += 1.0
        return [p["mu"] - u[0] - u[0] ** 3]

    path = mc.load_path(mc.VectorField(f, [0.0], {"mu": 0.0}), "mu", [0.0, 30.0, 0.0], max_seconds=200.0)
    assert path.status == "max time"
    assert ticking.now <= 300.0


def test_without_a_limit_nothing_ends_early(field):
    assert mc.continue_equilibria(field, "mu", bounds=(-2.0, 2.0)).status == "closed"
