"""Neutral saddles, k = omega^2 < 0: the vector that borders a Hopf condition is no zero divisor of R[s]/(s^2 + k)."""

from __future__ import annotations

import numpy as np
import pytest

from mjcont.numerics.equations.defining import _generator


def null_space(k: float, angle: float, between: float) -> tuple[np.ndarray, np.ndarray]:
    """Return even and odd parts (3, 2) of an orthonormal basis, turned by an angle, of q0 + s q1 with q(+-a) ~ v+-."""
    a = np.sqrt(-k)
    one = np.array([1.0, 0.0, 0.0])
    other = np.array([np.cos(between), np.sin(between), 0.0])
    # q0 = (q(a) + q(-a)) / 2, q1 = (q(a) - q(-a)) / (2 a), with q(a) = one, q(-a) = 0 and the other way round
    columns = np.column_stack([np.append(one, one / a), np.append(other, -other / a)]) / 2.0
    basis = np.linalg.qr(columns)[0] @ np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return basis[:3], basis[3:]


@pytest.mark.parametrize("k", [-1e-8, -1e-2, -1.0, -9.0])
@pytest.mark.parametrize("between", [0.3, 1.2, 1.9])
def test_the_border_has_parts_along_both_real_eigenvectors(k, between):
    a = np.sqrt(-k)
    for angle in np.linspace(0.0, np.pi, 13):
        even, odd = null_space(k, angle, between)
        c = _generator(even, odd, k)
        for s in (a, -a):
            most = np.linalg.norm(even + s * odd, 2)
            assert np.linalg.norm((even + s * odd) @ c) > 0.7 * most


@pytest.mark.parametrize("k", [-2.0, -0.9, 1.0, 4.0])
def test_the_border_does_not_depend_on_the_basis_of_the_null_space(k):
    found = []
    for angle in np.linspace(0.1, 3.0, 9):
        even, odd = null_space(-abs(k), angle, 1.2)
        c = _generator(even, odd, k)
        q = np.append(even @ c, odd @ c)
        found.append(q * np.sign(q[0]))
    assert np.ptp(found, axis=0) == pytest.approx(0.0, abs=1e-12)


def test_the_border_passes_smoothly_through_k_0():
    for angle in np.linspace(0.0, 3.0, 7):
        even, odd = null_space(-1e-12, angle, 1e-6)
        below, above = (_generator(even, odd, k) for k in (-1e-12, 0.0))
        assert abs(below @ above) == pytest.approx(1.0, abs=1e-5)
