"""Eigenvalues that stability could do without wait: nothing but reading them computes them."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace

import numpy as np
import pytest
from problems.mechanisms import branch_of
from problems.reference import BOUNDS, START

import mjcont as mc
from mjcont.results.branch import sliced
from mjcont.results.spectra import Spectra


@pytest.fixture
def branch():
    """A branch of which nobody has read anything."""
    return mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F", BOUNDS, {"F": START})


@pytest.fixture(scope="module")
def expected():
    return branch_of("overcentre").eigenvalues


@pytest.mark.slow
def test_eigenvalues_are_computed_once_where_they_are_read(branch, expected):
    before = branch.problem.evaluations
    assert np.array_equal(branch.eigenvalues, expected)
    read = branch.problem.evaluations
    assert read > before
    assert branch.eigenvalues is branch.eigenvalues
    assert branch.problem.evaluations == read


def test_a_row_that_is_read_has_its_eigenvalues_and_no_others_are_computed(branch, expected):
    waiting = branch.spectra.missing()
    assert np.array_equal(branch.row(waiting[3]).eigenvalues, expected[waiting[3]])
    assert branch.spectra.missing() == [i for i in waiting if i != waiting[3]]


def test_the_summary_special_points_copies_and_saving_compute_nothing(branch, tmp_path):
    before = branch.problem.evaluations
    assert "LP1" in str(branch)
    assert len(branch.special_points) == 2
    changed = replace(branch, notes=["read again"])
    branch.save(tmp_path / "branch.h5")
    assert branch.problem.evaluations == before
    assert changed.spectra.missing()


@pytest.mark.slow
def test_a_loaded_branch_computes_what_nobody_had_read(branch, expected, tmp_path):
    loaded = mc.load(branch.save(tmp_path / "branch.h5"))
    assert loaded.problem.evaluations == 0
    assert np.array_equal(loaded.eigenvalues, expected)


@pytest.mark.slow
def test_eigenvalues_read_before_a_branch_is_saved_are_in_its_file(branch, expected, tmp_path):
    assert not np.isnan(branch.eigenvalues).any()
    loaded = mc.load(branch.save(tmp_path / "branch.h5"))
    assert np.array_equal(loaded.eigenvalues, expected)
    assert loaded.problem.evaluations == 0


def test_a_part_of_a_branch_computes_its_own(branch, expected):
    part = sliced(branch, 5, 9)
    assert np.array_equal(part.eigenvalues, expected[5:10])
    assert set(branch.spectra.missing()).isdisjoint(range(5, 10))
    assert branch.spectra.missing()


@pytest.mark.slow
def test_a_longer_branch_computes_those_of_both_parts_where_they_are_read(expected):
    mechanism = mc.Mechanism.from_xml("overcentre")
    short = mc.continue_equilibria(mechanism, "F", (20.0, BOUNDS[1]), {"F": START})
    longer = mc.extend(short, BOUNDS, ends=["last"] if short["F"][-1] < short["F"][0] else ["first"])
    own = len(longer.spectra.missing())
    assert own > len(short.spectra.missing())
    assert not np.isnan(longer.eigenvalues).any()


@pytest.mark.slow
def test_a_branch_is_copied_and_pickled_with_all_its_eigenvalues(branch, expected):
    assert np.array_equal(copy.copy(branch).eigenvalues, expected)
    alone = replace(branch, problem=None)
    assert np.array_equal(pickle.loads(pickle.dumps(alone)).eigenvalues, expected)


TWO_MASSES = """<mujoco><option gravity="0 0 0"/>
  <worldbody>
    <body><joint name="a" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
    <body><joint name="b" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="4" diaginertia="1 1 1"/></body>
  </worldbody>
  <tendon><fixed name="spring" stiffness="100" damping="0.5" springlength="0">
    <joint joint="a" coef="-1"/><joint joint="b" coef="1"/></fixed></tendon>
  <actuator><general name="T" tendon="spring"/></actuator>
</mujoco>"""


@pytest.mark.slow
def test_a_motion_that_was_held_is_held_where_eigenvalues_are_read_after_loading(tmp_path):
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(TWO_MASSES), "T", bounds=(-1.0, 1.0))
    waiting = replace(branch, spectra=Spectra([branch.spectra.row(0), *[None] * (len(branch) - 1)]))
    loaded = mc.load(waiting.save(tmp_path / "branch.h5"))
    assert len(loaded.spectra.missing()) == len(branch) - 1
    np.testing.assert_allclose(loaded.eigenvalues, branch.eigenvalues, rtol=1e-6)
    assert loaded.eigenvalues.real.max() < -0.1
