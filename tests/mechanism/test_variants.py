"""Variants of a mechanism in one batch: each has the forces at its own values, whatever is beside it."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

LENGTH = "spec:site:B_1.pos[0]"
RADIUS = "spec:geom:pin_A.size[0]"


@pytest.fixture(scope="module")
def mechanism() -> mc.Mechanism:
    found = mc.Mechanism.from_xml("overcentre")
    for name in (LENGTH, RADIUS):
        found.parameter(name)
    return found


def states(mechanism: mc.Mechanism, count: int) -> np.ndarray:
    return mechanism.qpos0 + 0.1 * np.random.default_rng(1).normal(size=(count, 4, mechanism.nq))


def test_forces_of_variants_are_those_at_their_values(mechanism: mc.Mechanism) -> None:
    values = [mechanism.values(v) for v in ({"m_1": 1.3, "k_j": 2e3}, {LENGTH: 0.52}, {"load_factor": 0.5}, {})]
    variants, x = mechanism.variants(values, ("F",)), states(mechanism, 3)
    loads = np.linspace(-20.0, 20.0, 12).reshape(3, 4, 1)
    chosen = np.array([0, 1, 3])
    found = variants.residuals(chosen, x, loads)
    for k, variant in enumerate(chosen):
        for i in range(4):
            own = {**values[variant], "F": float(loads[k, i, 0])}
            np.testing.assert_allclose(found[k, i], mechanism.residual(x[k, i], own), rtol=1e-12, atol=1e-11)


def test_a_variant_is_the_same_to_the_bit_beside_others(mechanism: mc.Mechanism) -> None:
    values = [mechanism.values({"m_1": 1.0 + 0.1 * i, LENGTH: 0.5 + 0.01 * i}) for i in range(5)]
    x, loads = states(mechanism, 5), np.full((5, 4, 1), 7.0)
    together = mechanism.variants(values, ("F",)).residuals(np.arange(5), x, loads).copy()
    for i in range(5):
        alone = mechanism.variants(values[i : i + 1], ("F",)).residuals(np.array([0]), x[i : i + 1], loads[i : i + 1])
        np.testing.assert_array_equal(alone[0], together[i])


def test_a_variant_that_does_not_compile_or_has_a_load_beyond_numbers_has_no_forces(mechanism: mc.Mechanism) -> None:
    values = [mechanism.values(), {**mechanism.values(), RADIUS: -1.0}, mechanism.values()]
    loads = np.full((3, 4, 1), 5.0)
    loads[2] = np.nan
    found = mechanism.variants(values, ("F",)).residuals(np.arange(3), states(mechanism, 3), loads)
    assert np.isfinite(found[0]).all()
    assert np.isnan(found[1:]).all()


def test_evaluations_of_variants_are_counted(mechanism: mc.Mechanism) -> None:
    variants, before = mechanism.variants([mechanism.values()] * 3, ("F",)), mechanism.evaluations
    variants.residuals(np.array([0, 2]), states(mechanism, 2), np.zeros((2, 4, 1)))
    assert mechanism.evaluations == before + 8
