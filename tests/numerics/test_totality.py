"""Every numerical routine meets what it cannot compute (NaN, zero, singular, nothing at all), and returns."""

from __future__ import annotations

import importlib
import inspect
import pkgutil

import numpy as np
import pytest
from problems import failing, failing_orbits, failing_sparse, failing_variants
from problems.failing import BAD, CASES, Bad, walk

import mjcont as mc
import mjcont.numerics
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.points import events
from mjcont.numerics.search import leastnorm
from mjcont.numerics.spectra import stability
from mjcont.numerics.step.arclength import next_step
from mjcont.numerics.walk import guard, onebyone
from mjcont.numerics.walk.steps import Status, Step


def public_names():
    """Return the public functions and classes of the numerical modules."""
    for module in pkgutil.walk_packages(mjcont.numerics.__path__, "mjcont.numerics."):
        for name, item in vars(importlib.import_module(module.name)).items():
            own = getattr(item, "__module__", "") == module.name
            if own and not name.startswith("_") and (inspect.isfunction(item) or inspect.isclass(item)):
                yield f"{module.name.rpartition('.')[2]}.{name}"


def test_every_public_routine_of_the_numerics_is_made_to_fail():
    rooms = failing, failing_orbits, failing_sparse, failing_variants
    assert set(public_names()) == {name for room in rooms for name in (*room.CASES, *room.PLAIN)}


@pytest.mark.parametrize("name", CASES)
def test_a_routine_returns_where_it_can_compute_nothing(name):
    with np.errstate(all="ignore"):
        for bad in BAD:
            CASES[name](bad)


@pytest.mark.parametrize("name", failing_orbits.CASES)
def test_a_routine_for_orbits_returns_where_it_can_compute_nothing(name):
    with np.errstate(all="ignore"):
        for bad in failing_orbits.BAD:
            failing_orbits.CASES[name](bad)


@pytest.mark.parametrize("name", failing_sparse.CASES)
def test_a_routine_for_sparse_matrices_returns_where_it_can_compute_nothing(name):
    with np.errstate(all="ignore"):
        for bad in failing_sparse.BAD:
            failing_sparse.CASES[name](bad)


@pytest.mark.parametrize("name", failing_variants.CASES)
def test_a_routine_for_variants_returns_where_it_can_compute_nothing(name):
    with np.errstate(all="ignore"):
        for bad in failing_variants.BAD:
            failing_variants.CASES[name](bad)


# -- what is said -------------------------------------------------------------------------------------------------

def is_told(refused):
    """Whether something is refused, in words."""
    return isinstance(refused, Refused) and len(str(refused).split()) >= 3


UNDEFINED = [Bad(kind, n, s) for kind in ("nan", "infinite") for n in (1, 2, 3) for s in (False, True)]


@pytest.mark.parametrize("name", ["newton.correct", "newton.solve", "starts.find_start", "creep.creep"])
def test_a_solver_without_a_value_of_f_fails_with_a_sentence(name):
    with np.errstate(all="ignore"):
        assert all(is_told(CASES[name](bad).failure) for bad in UNDEFINED)


@pytest.mark.parametrize("name", ["arclength.advance", "arclength.first_point", "arclength.land"])
def test_a_step_without_a_value_of_f_is_refused_with_a_sentence(name):
    with np.errstate(all="ignore"):
        refused = [CASES[name](bad) for bad in UNDEFINED]
        assert all(is_told(r) and r.why is Why.UNDEFINED for r in refused)


def test_a_walk_without_a_value_of_f_ends_with_a_status():
    with np.errstate(all="ignore"):
        assert {walk(bad) for bad in UNDEFINED} == {Status.STEP_TOO_SMALL}


@pytest.mark.parametrize("bad", UNDEFINED, ids=str)
def test_a_pencil_without_eigenvalues_is_marginal_and_they_are_nan(bad):
    with np.errstate(all="ignore"):
        found = stability.local_spectrum(bad.local)
    assert (found.stability, found.n_unstable) == ("marginal", 0)
    assert np.isnan(found.eigenvalues).all() and len(found.eigenvalues) == bad.n


def test_a_solution_between_points_that_coincide_is_not_between_them():
    bad = Bad("zero", 2, False)
    assert events.within(bad.system, bad.point(), bad.point(), bad.corrected) is None


ONES = np.ones(2)


@pytest.mark.parametrize("question", [
    (np.full((1, 2), np.nan), ONES[:1], -ONES, ONES), (np.full((1, 2), np.inf), ONES[:1], -ONES, ONES),
    (ONES[None], np.full(1, np.nan), -ONES, ONES), (ONES[None], ONES[:1], np.nan * ONES, ONES),
    (ONES[None], ONES[:1], -ONES, np.nan * ONES), (ONES[None], ONES[:1], np.inf * ONES, np.inf * ONES),
])  # fmt: skip
def test_the_shortest_vector_is_nan_without_equations_or_bounds(question):
    found = leastnorm.least_norm(*question, 1e-9)
    assert np.isnan(np.concatenate([found.u, found.left, found.wanted, found.left_unbounded])).all()


def test_the_shortest_vector_is_nan_in_a_metric_of_less_than_full_rank():
    found = leastnorm.least_norm(ONES[None], ONES[:1], -ONES, ONES, 1e-9, (np.zeros((2, 2)), ONES))
    assert np.isnan(found.u).all() and np.isnan(found.wanted).all()


def test_an_error_that_nobody_expected_ends_a_curve_with_a_status_and_keeps_its_points(monkeypatch):
    def broken(self, leap):
        if leap.new.y[0] > 0.2:
            raise IndexError("list index out of range")
        return Step([leap.new], next_step(leap.h, leap.new, self.settings), leap.ending)

    monkeypatch.setattr(guard, "_raised", False)
    monkeypatch.setattr(onebyone.OneByOne, "looked", broken)
    line = mc.VectorField(lambda u, p: [u[0] - p["p"]], [0.0], {"p": 0.0})
    branch = mc.continue_equilibria(line, "p", bounds=(-1.0, 1.0))
    assert branch.ends[0][0] == "at bound"
    status, sentence = branch.ends[1]
    assert status == "failed"
    assert "IndexError: list index out of range" in sentence and "Please report this" in sentence
    assert 0.3 < branch["p"].max() <= 0.4  # the coordinate is half of p


def test_an_error_that_nobody_expected_is_raised_in_the_tests(monkeypatch):
    def broken(self, leap):
        raise IndexError("list index out of range")

    monkeypatch.setattr(onebyone.OneByOne, "looked", broken)
    line = mc.VectorField(lambda u, p: [u[0] - p["p"]], [0.0], {"p": 0.0})
    with pytest.raises(IndexError):
        mc.continue_equilibria(line, "p", bounds=(-1.0, 1.0))
