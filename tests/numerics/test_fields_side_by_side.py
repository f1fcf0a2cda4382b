"""Vectorized fields take long steps with points side by side: the curves and special points are those of one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import fields
from problems.knownfields import run

import mjcont as mc

CURVES = {
    "ab": (lambda: fields.ab(8.0), "D", (0.0, 0.6)),
    "cusp": (fields.cusp, "mu", (-1.0, 1.0)),
    "adaptx": (fields.adaptx, "alpha", (0.1, 2.0)),
    "brusselator": (fields.brusselator, "B", (0.5, 8.0)),
}


def both(name):
    """Return the branch of a field that is evaluated one by one, and that of the same one vectorized."""
    make, parameter, bounds = CURVES[name]
    return [mc.continue_equilibria(f, parameter, bounds) for f in (make(), fields.vectorized(make()))]


@pytest.mark.slow
@pytest.mark.parametrize("name", CURVES)
def test_a_vectorized_field_has_the_special_points_of_the_same_field_one_by_one(name):
    alone, together = both(name)
    assert [p.label for p in together.special_points] == [p.label for p in alone.special_points]
    for a, b in zip(alone.special_points, together.special_points, strict=True):
        assert b.state == pytest.approx(a.state, abs=1e-8)
        assert (b.stability, b.n_unstable) == (a.stability, a.n_unstable)
        assert b.coefficients.get("type") == a.coefficients.get("type")
    assert together.ends == alone.ends


@pytest.mark.slow
@pytest.mark.parametrize("seed", [45, 46, 84, 530, 531])
def test_pairs_of_points_inside_long_steps_are_found(seed):
    """Bumps of a growth rate that the ends of a step do not show; points 3e-5 apart, and two in one place."""
    assert run(seed, together=True) == []


@pytest.mark.fuzz
@pytest.mark.parametrize("first", range(0, 600, 20))
def test_many_random_fields_together_have_the_points_and_the_stability_that_they_are_known_to_have(first):
    assert {seed: found for seed in range(first, first + 20) if (found := run(seed, together=True))} == {}


@pytest.mark.slow
@pytest.mark.parametrize("vectorized", [False, True])
def test_a_curve_ends_where_its_function_does_whatever_is_evaluated_together(vectorized):
    """u = sqrt(1 - p) and its square: f has no value beyond p = 1, nor derivatives a difference step before it."""
    def f(u, p):
        return [np.sqrt(1.0 - p["p"] + 0.0 * u[0]) - u[0], u[0] ** 2 - u[1]]

    field = mc.VectorField(f, [1.0, 1.0], {"p": 0.0}, vectorized=vectorized)
    branch = mc.continue_equilibria(field, "p", (-1.0, 2.0))
    assert branch.ends[0][0] == "at bound" and branch.ends[1][0] == "step too small"
    assert 0.99 < branch["p"].max() <= 1.0
    assert branch["u[1]"] == pytest.approx(1.0 - branch["p"], abs=1e-9)
    assert not branch.special_points


def test_straight_lines_from_row_to_row_stay_close_to_the_curve_of_a_vectorized_field():
    """u = (p, p^2), p over a range of 2: a parabola in the plane of (sqrt(5) / 2) p and p^2, its rows a width w apart.

    A chord is w^2 / 4 above it, and less far away by the cosine of its slope.
    """
    field = mc.VectorField(lambda u, p: [p["p"] - u[0], u[0] ** 2 - u[1]], [0.0, 0.0], {"p": 0.0}, vectorized=True)
    branch = mc.continue_equilibria(field, "p", (-1.0, 1.0))
    p = branch["p"]
    assert branch["u[1]"] == pytest.approx(p**2, abs=1e-12)
    widths, slopes = np.diff(p), (p[1:] + p[:-1]) / math.sqrt(1.25)
    off = 0.25 * widths**2 / np.sqrt(1.0 + slopes**2)
    assert 1e-6 < off.max() < 3.05e-6


def test_a_diagram_of_the_reaction_takes_few_calls_and_evaluations():
    """491 rows with both Hopf points: at most 199 calls and 3,399 evaluations over five kernels of BLAS; 15 % more."""
    calls = []

    def f(u, p):
        calls.append(u.shape[1] if u.ndim == 2 else 1)
        rate = p["D"] * (1.0 - u[0]) * np.exp(u[1])
        return [-u[0] + rate, -4.0 * u[1] + p["B"] * rate]

    field = mc.VectorField(f, [0.0, 0.0], {"D": 0.0, "B": 14.0}, vectorized=True)
    branch = mc.continue_equilibria(field, "D", (0.0, 0.4), direction=1)
    assert [p.kind for p in branch.special_points] == ["HB", "HB"]
    assert len(branch) > 400
    assert len(calls) < 229 and sum(calls) < 3909
    assert sum(calls) == field.evaluations
