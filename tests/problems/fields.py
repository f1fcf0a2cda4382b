"""Vector fields whose special points are known: the sources stand in `test_problems_equilibria.py`."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from scipy import sparse

import mjcont as mc


def by_columns(f):
    """Return a function of states in columns from one of a single state."""

    def together(u, p):
        if u.ndim == 1:
            return f(u, p)
        own = [{k: float(np.broadcast_to(v, u.shape[1])[i]) for k, v in p.items()} for i in range(u.shape[1])]
        return np.array([f(x, v) for x, v in zip(u.T, own, strict=True)], dtype=float).T

    return together


def vectorized(field):
    """Return a field whose function takes many states at once."""
    values, names = {p.name: p.value for p in field.parameters.values()}, [name for name, _ in field.state_labels]
    f = by_columns(field.residual)
    return mc.VectorField(f, field.u0, values, names=names, name=field.name, vectorized=True)


def ab(B):
    """AUTO demo ab: an exothermic reaction in a stirred tank, sigma = 3."""

    def f(u, p):
        rate = p["D"] * (1.0 - u[0]) * math.exp(u[1])
        return [-u[0] + rate, -4.0 * u[1] + p["B"] * rate]

    return mc.VectorField(f, [0.0, 0.0], {"D": 0.0, "B": B}, names=["u", "v"], name="ab")


def pp2():
    """AUTO demo pp2: a predator, a prey, and harvesting p."""

    def f(u, p):
        prey = 3.0 * u[0] * (1.0 - u[0]) - u[0] * u[1] - p["p"] * (1.0 - math.exp(-5.0 * u[0]))
        return [prey, -u[1] + 3.0 * u[0] * u[1]]

    return mc.VectorField(f, [1.0, 0.0], {"p": 0.0}, names=["u", "v"], name="pp2")


def cusp():
    """Normal form of the cusp, x' = mu + la x - x^3."""

    def f(u, p):
        return [p["mu"] + p["la"] * u[0] - u[0] ** 3]

    return mc.VectorField(f, [-1.3247179572447460], {"mu": -1.0, "la": 1.0}, names=["x"], name="cusp")


def adaptx():
    """MatCont's adaptx: a feedback-control system of third order."""

    def f(u, p):
        return [u[1], u[2], -p["alpha"] * u[2] - p["beta"] * u[1] - u[0] + u[0] ** 2]

    return mc.VectorField(f, [0.0, 0.0, 0.0], {"alpha": 2.0, "beta": 1.0}, names=["x", "y", "z"], name="adaptx")


def brusselator():
    """Two reactants; the only equilibrium is (A, B / A)."""

    def f(u, p):
        return [p["A"] - (p["B"] + 1.0) * u[0] + u[0] ** 2 * u[1], p["B"] * u[0] - u[0] ** 2 * u[1]]

    return mc.VectorField(f, [2.0, 0.5], {"A": 2.0, "B": 1.0}, names=["x", "y"], name="brusselator")


def bratu(n):
    """u'' + la exp(u) = 0 with u = 0 at both ends, second-order differences at n points; the Jacobian is sparse."""
    ones = np.ones(n)
    laplacian = sparse.diags([ones[1:], -2.0 * ones, ones[1:]], [-1, 0, 1], format="csc") * (n + 1.0) ** 2

    def f(u, p):
        return laplacian @ u + p["la"] * np.exp(u)

    def jacobian(u, p):
        return laplacian + sparse.diags(p["la"] * np.exp(u))

    field = mc.VectorField(f, np.zeros(n), {"la": 0.0}, jacobian=jacobian, scale=np.full(n, math.sqrt(n)))
    field.observe("largest", lambda u, p: u.max())
    return field


TUBE = {"A": 2.0, "D_x": 0.008, "D_y": 0.004}


def tube(n):
    """The Brusselator with diffusion along a line, held at its equilibrium at both ends; the Jacobian is sparse."""
    ones, a = np.ones(n), TUBE["A"]
    laplacian = sparse.diags([ones[1:], -2.0 * ones, ones[1:]], [-1, 0, 1], format="csc") * (n + 1.0) ** 2
    ends = np.zeros(n)
    ends[[0, -1]] = (n + 1.0) ** 2

    def f(u, p):
        x, y = u[:n], u[n:]
        first = TUBE["D_x"] * (laplacian @ x + a * ends) + a - (p["B"] + 1.0) * x + x**2 * y
        return np.concatenate([first, TUBE["D_y"] * (laplacian @ y + p["B"] / a * ends) + p["B"] * x - x**2 * y])

    def jacobian(u, p):
        x, y = u[:n], u[n:]
        return sparse.bmat(
            [
                [TUBE["D_x"] * laplacian + sparse.diags(2.0 * x * y - p["B"] - 1.0), sparse.diags(x**2)],
                [sparse.diags(p["B"] - 2.0 * x * y), TUBE["D_y"] * laplacian - sparse.diags(x**2)],
            ],
            format="csc",
        )

    start = np.concatenate([np.full(n, a), np.full(n, 1.0 / a)])
    return mc.VectorField(f, start, {"B": 1.0}, jacobian=jacobian, scale=np.full(2 * n, math.sqrt(n)))


@cache
def branch_of_ab(B):
    return mc.continue_equilibria(ab(B), "D", bounds=(0.0, 0.6))


@cache
def diagram_of_pp2():
    return mc.bifurcation_diagram(pp2(), "p", bounds=(0.0, 1.2), max_size=3.0)


@cache
def branch_of_cusp():
    return mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0))


@cache
def branch_of_adaptx():
    return mc.continue_equilibria(adaptx(), "alpha", bounds=(0.1, 2.0))


@cache
def branch_of_brusselator():
    return mc.continue_equilibria(brusselator(), "B", bounds=(0.5, 8.0))


@cache
def branch_of_bratu(n):
    def stop(point):
        return "far enough beyond the fold" if point["largest"] > 2.0 else None

    return mc.continue_equilibria(bratu(n), "la", bounds=(0.0, 4.0), stop=stop, ds=0.1, ds_max=0.2)
