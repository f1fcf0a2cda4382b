"""Gradients of conditions by a few Jacobians are those by differences in every unknown."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse

import mjcont as mc
from mjcont.numerics.equations.defining import BranchPoint, Fold, Hopf
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.onfolds import DoubleZero, FoldCoefficient, Transversality
from mjcont.numerics.equations.system import System

N = 7
RNG = np.random.default_rng(0)
A, B = RNG.standard_normal((2, N, N))
LOAD, STATE = RNG.standard_normal((2, N))


def f(u, p):
    return A @ u + np.sin(B @ u) * p["p"] + p["q"] * u**2 * np.exp(-u) + LOAD * p["p"] ** 2


def jacobian(u, p):
    return A + p["p"] * np.cos(B @ u)[:, None] * B + np.diag(p["q"] * (2.0 * u - u**2) * np.exp(-u))


def field(thin):
    def given(u, p):
        return sparse.csc_matrix(jacobian(u, p)) if thin else jacobian(u, p)

    return mc.VectorField(f, np.zeros(N), {"p": 0.5, "q": 1.0}, jacobian=given, scale=np.linspace(0.5, 2.0, N))


CONDITIONS = {
    "fold": lambda local, free: [Fold(local)],
    "cusp": lambda local, free: [Fold(local), FoldCoefficient(Fold(local), local)],
    "double zero": lambda local, free: [Fold(local), DoubleZero(Fold(local), local)],
    "transversality": lambda local, free: [Fold(local), Transversality(Fold(local), local)],
    "Hopf": lambda local, free: [Hopf(local, 2.0)],
    "neutral saddle": lambda local, free: [Hopf(local, -2.0)],
    "branch point": lambda local, free: [BranchPoint(local, free)],
}


@pytest.mark.parametrize("thin", [True, False], ids=["sparse", "dense"])
@pytest.mark.parametrize("low", [-1.0, 1e-3, 0.5], ids=["linear", "logarithmic", "on its bound"])
@pytest.mark.parametrize("name", CONDITIONS)
def test_a_gradient_is_that_by_differences(name, low, thin):
    problem, free = field(thin), [Free("p", low, 3.0), Free("q", 1e-3, 3.0)]
    plain = System(problem, problem.values(), free, (), accurate=True)
    at = plain.local(0.3 * STATE, plain.start_y())
    system = System(problem, problem.values(), free, CONDITIONS[name](at, free[0]), accurate=True)
    y, condition = system.start_y(), system.conditions[-1]
    local = system.local(0.3 * STATE, y)
    found, differences = condition.gradient(local, system, y), system.gradients([condition], local, y)
    tolerance = 3e-3 if low == 0.5 else 3e-5  # one-sided differences are of first order
    assert found == pytest.approx(differences[:, : found.shape[1]], abs=tolerance * np.abs(differences).max())


def test_a_gradient_costs_as_many_evaluations_whatever_the_number_of_unknowns():
    spent = []
    for n in (20, 200):
        line = sparse.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [1, 0, -1], format="csc")
        problem = mc.VectorField(
            lambda u, p, line=line: line @ u + p["p"] * np.exp(u), np.zeros(n), {"p": 0.1},
            jacobian=lambda u, p, line=line: line + sparse.diags(p["p"] * np.exp(u)),
        )  # fmt: skip
        plain = System(problem, problem.values(), [Free("p", 0.0, 1.0)], (), accurate=True)
        local = plain.local(np.zeros(n), plain.start_y())
        for condition in (Fold(local), Hopf(local, 1.0), BranchPoint(local, plain.free[0])):
            system = System(problem, problem.values(), plain.free, [condition], accurate=True)
            before = problem.evaluations
            condition.gradient(local, system, system.start_y())
            spent.append(problem.evaluations - before)
    assert spent[:3] == spent[3:]
    assert max(spent) <= 100
