"""Mechanisms and what is computed with them: free as soon as nothing refers to them."""

import gc
import weakref

import pytest

import mjcont as mc


@pytest.fixture
def without_collector():
    """Cycles stay: what is freed here is freed by itself."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()


@pytest.mark.slow
def test_a_mechanism_and_its_branches_go_when_nothing_refers_to_them(without_collector) -> None:
    mechanism = mc.Mechanism.from_xml("von_mises_truss")
    branch = mc.continue_equilibria(mechanism, "P", bounds=(-200.0, 200.0), keyframe="unloaded")
    assert len(branch.eigenvalues) == len(branch)
    watched = [weakref.ref(mechanism), weakref.ref(mechanism.copy())]
    del mechanism, branch
    assert [w() for w in watched] == [None, None]
