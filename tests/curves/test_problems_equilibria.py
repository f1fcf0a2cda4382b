"""Equilibria of vector fields whose special points are known in closed form or from the literature.

Sources: AUTO-07p manual (demos ab and pp2); MatCont manual (adaptx); Kuznetsov, Elements of Applied Bifurcation
Theory, 3rd ed. (the cusp, and the normalisation of coefficients: |q| = |v| = 1, l1 = Re g21 / (2 omega)); Guckenheimer
and Holmes, Nonlinear Oscillations, Dynamical Systems, and Bifurcations of Vector Fields, equation (3.4.11) (the first
Lyapunov coefficient of a planar system). Numbers with many digits that no formula gives were solved with 30 digits.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy.linalg
from problems.fields import (
    TUBE,
    branch_of_ab,
    branch_of_adaptx,
    branch_of_bratu,
    branch_of_brusselator,
    branch_of_cusp,
    bratu,
    diagram_of_pp2,
    tube,
)
from scipy import sparse
from scipy.optimize import brentq

import mjcont as mc

ROOT_3 = 3.0**0.5


# -- the problems ---------------------------------------------------------------------------------------------


def found(branch):
    """Return kind, parameter and nothing else of every special point, in order."""
    ((name, _),) = branch.free.items()
    return [(p.kind, p[name]) for p in branch.special_points]


def planar_lyapunov(jac, second, third):
    """Return l1 of a planar system at a Hopf point from its derivatives, equation (3.4.11), scaled to |q| = 1.

    `second(u, v)` and `third(u, v, w)` are its multilinear forms of second and third derivatives.
    """
    values, vectors = np.linalg.eig(jac)
    q = vectors[:, np.argmax(values.imag)]
    omega = float(values.imag.max())
    basis = np.column_stack([q.real, -q.imag])
    back = np.linalg.inv(basis)
    x, y = basis.T

    def b(u, v):
        return back @ second(u, v)

    def c(u, v, w):
        return back @ third(u, v, w)

    (fxx, gxx), (fxy, gxy), (fyy, gyy) = b(x, x), b(x, y), b(y, y)
    cubic = c(x, x, x)[0] + c(x, y, y)[0] + c(x, x, y)[1] + c(y, y, y)[1]
    squares = fxy * (fxx + fyy) - gxy * (gxx + gyy) - fxx * gxx + fyy * gyy
    # (3.4.11) gives 16 a for basis (x, y) with |x + i y| = 1; q z + c.c. has twice that amplitude
    return 4.0 * (cubic + squares / omega) / 16.0 / omega


# -- ab -------------------------------------------------------------------------------------------------------


def ab_parameter(u, B):
    return u / (1.0 - u) * math.exp(-B * u / 4.0)


def ab_folds(B):
    """Return u at the folds, u (1 - u) = 4 / B."""
    root = math.sqrt(max(1.0 - 16.0 / B, 0.0))
    return [(1.0 - root) / 2.0, (1.0 + root) / 2.0] if B > 16.0 else []


def ab_hopfs(B):
    """Return u at the Hopf points, -1 / (1 - u) + B u - 4 = 0."""
    root = math.sqrt((B + 4.0) ** 2 - 20.0 * B)
    return [(B + 4.0 - root) / (2.0 * B), (B + 4.0 + root) / (2.0 * B)]


def ab_derivatives(u, B):
    """Return Jacobian, second and third form at the equilibrium with a given u; r = D (1 - u) exp(v) = u there."""
    r_u, r_v = -u / (1.0 - u), u
    gain = np.array([1.0, B])

    def second(a, b):
        return gain * (r_u * (a[0] * b[1] + a[1] * b[0]) + r_v * a[1] * b[1])

    def third(a, b, c):
        mixed = a[0] * b[1] * c[1] + a[1] * b[0] * c[1] + a[1] * b[1] * c[0]
        return gain * (r_u * mixed + r_v * a[1] * b[1] * c[1])

    return np.array([[r_u - 1.0, r_v], [B * r_u, B * r_v - 4.0]]), second, third


@pytest.mark.parametrize("B", [18.0, 14.0])
def test_ab_has_the_folds_and_hopf_points_of_its_closed_form_and_no_others(B):
    expected = [("LP", u) for u in ab_folds(B)] + [("HB", u) for u in ab_hopfs(B)]
    expected = [(kind, ab_parameter(u, B)) for kind, u in sorted(expected, key=lambda e: e[1])]
    branch = branch_of_ab(B)
    assert [kind for kind, _ in found(branch)] == [kind for kind, _ in expected]
    assert [D for _, D in found(branch)] == pytest.approx([D for _, D in expected], rel=1e-10)


def test_ab_has_the_published_special_points_at_B_18():
    expected = [0.111153484189864, 0.111565080074215, 0.0995741367357279, 0.183834607985987]
    assert [D for _, D in found(branch_of_ab(18.0))] == pytest.approx(expected, rel=1e-10)


def test_ab_has_the_published_special_points_at_B_14():
    expected = [0.165042045323561, 0.336550498888431]
    assert [D for _, D in found(branch_of_ab(14.0))] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("B", [18.0, 14.0])
def test_ab_has_the_hopf_frequencies_of_its_closed_form(B):
    expected = [math.sqrt(np.linalg.det(ab_derivatives(u, B)[0])) for u in ab_hopfs(B)]
    assert [p.coefficients["omega"] for p in branch_of_ab(B).of_kind("HB")] == pytest.approx(expected, rel=1e-9)


def test_ab_has_the_published_hopf_frequencies_at_B_18():
    frequencies = [p.coefficients["omega"] for p in branch_of_ab(18.0).of_kind("HB")]
    assert frequencies == pytest.approx([0.544708097526, 5.80545373666], rel=1e-10)


@pytest.mark.parametrize("B", [18.0, 14.0])
def test_ab_has_the_first_lyapunov_coefficients_of_guckenheimer_and_holmes(B):
    expected = [planar_lyapunov(*ab_derivatives(u, B)) for u in ab_hopfs(B)]
    assert [p.coefficients["l1"] for p in branch_of_ab(B).of_kind("HB")] == pytest.approx(expected, rel=1e-6)


def test_ab_has_a_subcritical_and_a_supercritical_hopf_point_at_B_18():
    types = [p.coefficients["type"] for p in branch_of_ab(18.0).of_kind("HB")]
    assert types == ["subcritical", "supercritical"]


def test_ab_has_the_fold_coefficients_of_its_closed_form():
    for p, u in zip(branch_of_ab(18.0).of_kind("LP"), ab_folds(18.0), strict=True):
        jac, second, _ = ab_derivatives(u, 18.0)
        v, w = scipy.linalg.null_space(jac)[:, 0], scipy.linalg.null_space(jac.T)[:, 0]
        v *= math.copysign(1.0, v @ p.vectors["v"])
        assert p.coefficients["a"] == pytest.approx(0.5 * w @ second(v, v) / (w @ v), rel=1e-6)


def test_every_point_of_ab_lies_on_its_closed_form():
    branch = branch_of_ab(18.0)
    u = branch["u"]
    assert branch["v"] == pytest.approx(4.5 * u, abs=1e-9)
    assert branch["D"] == pytest.approx(u / (1.0 - u) * np.exp(-4.5 * u), abs=1e-10)


def test_stability_of_ab_changes_at_its_hopf_points_alone():
    branch = branch_of_ab(18.0)
    first, last = (p.index for p in branch.of_kind("HB"))
    row = np.arange(len(branch))
    regular = np.array([not label for label in branch.labels])
    between = (row > first) & (row < last)
    assert set(branch.stability[between & regular]) == {"unstable"}
    assert set(branch.stability[~between & regular]) == {"stable"}


# -- pp2 ------------------------------------------------------------------------------------------------------


def pp2_fold():
    """Return (u, p) of the fold without predators, d/du of 3 u (1 - u) / (1 - exp(-5 u)) = 0."""

    def slope(u):
        return (1.0 - 2.0 * u) * (1.0 - math.exp(-5.0 * u)) - 5.0 * u * (1.0 - u) * math.exp(-5.0 * u)

    u = brentq(slope, 0.1, 0.9, xtol=1e-15)
    return u, 3.0 * u * (1.0 - u) / (1.0 - math.exp(-5.0 * u))


PP2_HOPF = 1.0 / (3.0 - 8.0 * math.exp(-5.0 / 3.0))


def distinct(diagram):
    """Return (kind, parameter) of the special points of all branches, each once: a BP stands on several."""
    points = {(p.kind, round(p["p"], 9), round(p["u"], 9), round(p["v"], 9)) for p in diagram.special_points}
    return sorted((kind, p) for kind, p, _, _ in points)


@pytest.mark.slow
def test_pp2_has_the_special_points_of_its_closed_form_and_no_others():
    fold, crossing = pp2_fold()[1], (2.0 / 3.0) / (1.0 - math.exp(-5.0 / 3.0))
    expected = [("BP", 0.6), ("BP", crossing), ("HB", PP2_HOPF), ("LP", fold)]
    assert [kind for kind, _ in distinct(diagram_of_pp2())] == [kind for kind, _ in expected]
    assert [p for _, p in distinct(diagram_of_pp2())] == pytest.approx([p for _, p in expected], abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "expected"),
    [("LP", 0.832929322234157), ("HB", 0.671593847478832), ("BP", 0.6), ("BP", 0.821904345373991)],
)
def test_pp2_has_the_published_special_points_to_1e_10(kind, expected):
    near = [p for p in diagram_of_pp2().special_points if p.kind == kind and abs(p["p"] - expected) < 1e-3]
    assert near
    assert [p["p"] for p in near] == pytest.approx([expected] * len(near), rel=1e-10)


@pytest.mark.slow
def test_pp2_has_three_branches_each_reported_once():
    assert len(diagram_of_pp2()) == 3


def test_each_branch_point_of_pp2_stands_on_two_branches():
    points = [round(p["p"], 9) for p in diagram_of_pp2().special_points if p.kind == "BP"]
    assert sorted(points) == [0.6, 0.6, *[round(0.821904345373991, 9)] * 2]


def test_the_branch_points_of_pp2_are_transcritical():
    types = {p.coefficients["type"] for p in diagram_of_pp2().special_points if p.kind == "BP"}
    assert types == {"transcritical"}


def test_the_fold_of_pp2_lies_where_its_closed_form_has_it():
    (fold,) = [p for p in diagram_of_pp2().special_points if p.kind == "LP"]
    assert fold["u"] == pytest.approx(0.411161560751072, rel=1e-10)
    assert fold["v"] == pytest.approx(0.0, abs=1e-10)


def test_the_fold_coefficient_of_pp2_is_half_the_second_derivative_of_the_prey_equation():
    (fold,) = [p for p in diagram_of_pp2().special_points if p.kind == "LP"]
    u, p = pp2_fold()
    expected = 0.5 * (-6.0 + 25.0 * p * math.exp(-5.0 * u))
    assert fold.coefficients["a"] == pytest.approx(math.copysign(1.0, fold.vectors["v"][0]) * expected, rel=1e-6)


def test_the_hopf_frequency_of_pp2_is_the_root_of_the_predators():
    (hopf,) = [p for p in diagram_of_pp2().special_points if p.kind == "HB"]
    predators = 2.0 - 3.0 * PP2_HOPF * (1.0 - math.exp(-5.0 / 3.0))
    assert hopf.coefficients["omega"] == pytest.approx(math.sqrt(predators), rel=1e-9)
    assert hopf.coefficients["omega"] == pytest.approx(0.604782221942, rel=1e-10)


def test_the_first_lyapunov_coefficient_of_pp2_is_the_published_one():
    (hopf,) = [p for p in diagram_of_pp2().special_points if p.kind == "HB"]
    assert hopf.coefficients["l1"] == pytest.approx(-0.709800607, rel=1e-6)


def test_the_first_lyapunov_coefficient_of_pp2_is_that_of_guckenheimer_and_holmes():
    (hopf,) = [p for p in diagram_of_pp2().special_points if p.kind == "HB"]
    kill = PP2_HOPF * math.exp(-5.0 / 3.0)
    v = 2.0 - 3.0 * PP2_HOPF * (1.0 - math.exp(-5.0 / 3.0))
    jac = np.array([[1.0 - v - 5.0 * kill, -1.0 / 3.0], [3.0 * v, 0.0]])

    def second(a, b):
        mixed = a[0] * b[1] + a[1] * b[0]
        return np.array([(-6.0 + 25.0 * kill) * a[0] * b[0] - mixed, 3.0 * mixed])

    def third(a, b, c):
        return np.array([-125.0 * kill * a[0] * b[0] * c[0], 0.0])

    assert hopf.coefficients["l1"] == pytest.approx(planar_lyapunov(jac, second, third), rel=1e-6)


# -- cusp normal form -----------------------------------------------------------------------------------------


def test_the_cusp_normal_form_has_two_folds_and_nothing_else():
    expected = 2.0 / (3.0 * ROOT_3)
    assert [kind for kind, _ in found(branch_of_cusp())] == ["LP", "LP"]
    assert [mu for _, mu in found(branch_of_cusp())] == pytest.approx([expected, -expected], rel=1e-10)


def test_the_folds_of_the_cusp_normal_form_lie_at_one_over_root_three():
    assert [p["x"] for p in branch_of_cusp().of_kind("LP")] == pytest.approx([-1.0 / ROOT_3, 1.0 / ROOT_3], rel=1e-10)


def test_the_fold_coefficients_of_the_cusp_normal_form_are_minus_three_x():
    coefficients = [p.coefficients["a"] for p in branch_of_cusp().of_kind("LP")]
    assert coefficients == pytest.approx([ROOT_3, -ROOT_3], rel=1e-6)


# -- adaptx ---------------------------------------------------------------------------------------------------


def test_adaptx_has_one_hopf_point_at_alpha_1_and_nothing_else():
    ((kind, alpha),) = found(branch_of_adaptx())
    assert kind == "HB"
    assert alpha == pytest.approx(1.0, rel=1e-10)


def test_the_hopf_point_of_adaptx_has_its_published_frequency_and_coefficient():
    (hopf,) = branch_of_adaptx().special_points
    assert hopf.coefficients["omega"] == pytest.approx(1.0, rel=1e-10)
    assert hopf.coefficients["l1"] == pytest.approx(-0.3, rel=1e-6)


# -- Brusselator ----------------------------------------------------------------------------------------------


def test_the_brusselator_has_one_hopf_point_at_1_plus_A_squared_and_nothing_else():
    ((kind, B),) = found(branch_of_brusselator())
    assert kind == "HB"
    assert B == pytest.approx(5.0, rel=1e-10)


def test_the_hopf_point_of_the_brusselator_has_frequency_A_and_coefficient_minus_one_sixth():
    (hopf,) = branch_of_brusselator().special_points
    assert hopf["x"] == pytest.approx(2.0, rel=1e-10)
    assert hopf.coefficients["omega"] == pytest.approx(2.0, rel=1e-10)
    assert hopf.coefficients["l1"] == pytest.approx(-1.0 / 6.0, rel=1e-6)


# -- Brusselator with diffusion ---------------------------------------------------------------------------------


@pytest.mark.long
def test_the_brusselator_with_diffusion_has_a_hopf_point_for_each_of_its_waves():
    n, (a, d_x, d_y) = 20, TUBE.values()
    mu = np.array([4.0 * (n + 1) ** 2 * math.sin(k * math.pi / (2 * (n + 1))) ** 2 for k in (1, 2, 3)])
    branch = mc.continue_equilibria(tube(n), "B", bounds=(1.0, 6.2))
    assert [kind for kind, _ in found(branch)] == ["HB", "HB", "HB"]
    assert [B for _, B in found(branch)] == pytest.approx(1.0 + a**2 + (d_x + d_y) * mu, rel=1e-10)
    # each wave's matrix is [[g, A^2], [-B, -g]] at its Hopf point
    g = a**2 + d_y * mu
    squares = a**2 * (1.0 + a**2 + (d_x + d_y) * mu) - g**2
    assert [p.coefficients["omega"] for p in branch.special_points] == pytest.approx(np.sqrt(squares), rel=1e-9)


# -- Bratu ----------------------------------------------------------------------------------------------------

BRATU_FOLDS = {100: 3.5136515062589, 1000: 3.513828894680}


@pytest.fixture
def no_large_dense_algebra(monkeypatch):
    """Fail when a dense solver, factorisation or conversion meets a matrix of hundreds of rows and columns."""

    def small_only(name, function):
        def checked(*args, **kwargs):
            for a in args:
                size = getattr(a, "shape", ())
                assert len(size) < 2 or min(size) < 300, f"{name} was called with a matrix of shape {size}"
            return function(*args, **kwargs)

        return checked

    dense = [
        (np.linalg, ["solve", "svd", "eig", "eigvals", "eigh", "eigvalsh", "inv", "det", "lstsq", "qr", "cholesky"]),
        (scipy.linalg, ["solve", "svd", "eig", "eigvals", "eigh", "eigvalsh", "inv", "lu_factor", "qr", "cholesky"]),
        (scipy.linalg.lapack, ["dgetrf", "dgesv"]),
        (sparse.csc_matrix, ["toarray", "todense"]),
        (sparse.csc_array, ["toarray", "todense"]),
    ]
    for owner, names in dense:
        for name in names:
            monkeypatch.setattr(owner, name, small_only(name, getattr(owner, name)))


@pytest.mark.slow
@pytest.mark.parametrize("n", BRATU_FOLDS)
def test_bratu_has_one_fold_where_its_differences_have_it(n):
    branch = branch_of_bratu(n)
    ((kind, la),) = found(branch)
    assert kind == "LP"
    assert la == pytest.approx(BRATU_FOLDS[n], rel=1e-10)


@pytest.mark.slow
def test_bratu_with_1000_points_lies_near_its_limit():
    (fold,) = branch_of_bratu(1000).special_points
    assert fold["la"] == pytest.approx(3.51383071912516, rel=1e-6)
    assert fold["largest"] == pytest.approx(1.18684216863439, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("n", BRATU_FOLDS)
def test_bratu_is_stable_up_to_the_fold_and_has_one_unstable_mode_beyond(n):
    branch = branch_of_bratu(n)
    (fold,) = branch.special_points
    assert set(branch.n_unstable[: fold.index]) == {0}
    assert set(branch.n_unstable[fold.index + 1 :]) == {1}


@pytest.mark.slow
def test_following_a_sparse_problem_of_1000_unknowns_over_its_fold_needs_no_dense_algebra(no_large_dense_algebra):
    branch = branch_of_bratu.__wrapped__(1000)
    assert [p.kind for p in branch.special_points] == ["LP"]


@pytest.mark.slow
def test_a_sparse_problem_of_1000_unknowns_comes_to_rest_without_dense_algebra(no_large_dense_algebra):
    point = mc.find_equilibrium(bratu(1000), {"la": 3.0})
    assert point.stability == "stable"
