"""Planar chains of random bars, springs and closures: whatever comes, a branch ends with a truthful status."""

import numpy as np
import pytest
from problems.random_linkage import linkage

import mjcont as mc

STATUSES = {"at bound", "closed", "step too small", "max points", "runs off"}


def check(seed: int) -> None:
    """Follow a linkage's equilibria and hold what is found against the model itself."""
    mechanism = mc.Mechanism.from_xml(linkage(seed))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-30.0, 30.0), max_points=400)
    assert {word for word, _ in branch.ends} <= STATUSES
    assert all(sentence for _, sentence in branch.ends)
    assert branch.residuals.max() < 1e-10
    assert all(p.converged and p.tolerance < 1e-8 for p in branch.special_points)
    for i in range(0, len(branch), max(len(branch) // 10, 1)):
        values = mechanism.values(branch.row(i).parameters)
        forces = mechanism.residual(branch.states[i], values)
        stiffest = np.abs(mechanism.linearize(branch.states[i], values, ()).jac).max()
        assert np.abs(forces).max() < 1e-12 * stiffest  # what rounding of the angles alone would load the bush with


@pytest.mark.parametrize("seed", range(20))
def test_a_random_linkage_is_followed_to_a_truthful_end(seed):
    check(seed)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(20, 200))
def test_two_hundred_random_linkages_are_followed_to_a_truthful_end(seed):
    check(seed)
