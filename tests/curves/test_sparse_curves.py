"""Curves and special points of sparse fields, against closed forms and against the same fields with dense Jacobians."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.fields import far_from_normal
from scipy import sparse

import mjcont as mc
from mjcont.numerics.search.creep import creep

ON_A_GRID = 150


def chain(n, rate=1.0):
    """Return a stable matrix that couples neighbours: relaxation and diffusion."""
    return sparse.diags([np.ones(n - 1), np.full(n, -2.0 - rate), np.ones(n - 1)], [1, 0, -1], format="csc")


def with_tail(head, slope, u0, parameters, *, n=ON_A_GRID, thin=True, **options):
    """Return a field of a few components of its own, u' = head(u, p), that drive a chain of n others and feel it.

    The chain rests where the first component holds it; what it pulls back with, it pulls on the second one.
    """
    few, inner = len(u0), chain(n)
    down = sparse.csc_matrix((0.5 * np.ones(2), ([0, n - 1], [0, 0])), shape=(n, few))

    def f(u, p):
        return np.concatenate([head(u[:few], p), inner @ u[few:] + down @ u[:few] ** 2])

    def jacobian(u, p):
        found = sparse.bmat([[slope(u[:few], p), None], [down @ sparse.diags(2.0 * u[:few]), inner]], format="csc")
        return found if thin else found.toarray()

    start = np.concatenate([u0, np.zeros(n)])
    return mc.VectorField(f, start, parameters, jacobian=jacobian, **options)


def bautin(u, p):
    """Return the normal form of a generalised Hopf point at b1 = b2 = 0, turning with frequency 3."""
    r = u @ u
    growth = p["b1"] + p["b2"] * r - r**2
    return np.array([growth * u[0] - 3.0 * u[1], 3.0 * u[0] + growth * u[1]])


def bautin_slope(u, p):
    r = u @ u
    growth, bend = p["b1"] + p["b2"] * r - r**2, 2.0 * (p["b2"] - 2.0 * r)
    return growth * np.eye(2) + bend * np.outer(u, u) + 3.0 * np.array([[0.0, -1.0], [1.0, 0.0]])


@pytest.fixture(scope="module")
def bautin_branch():
    field = with_tail(bautin, bautin_slope, [0.0, 0.0], {"b1": -0.5, "b2": -0.4})
    return mc.continue_equilibria(field, "b1", bounds=(-1.0, 1.0))


@pytest.mark.slow
def test_a_hopf_point_of_a_sparse_field_has_its_frequency_and_coefficient(bautin_branch):
    (hopf,) = bautin_branch.special_points
    assert (hopf.kind, hopf["b1"]) == ("HB", pytest.approx(0.0, abs=1e-10))
    assert hopf.coefficients["omega"] == pytest.approx(3.0, rel=1e-10)
    # r' = b2 r^3 for amplitudes of q z + c.c. with |q| = 1: twice r^2, over omega
    assert hopf.coefficients["l1"] == pytest.approx(2.0 * -0.4 / 3.0, rel=1e-6)


@pytest.mark.slow
def test_stability_changes_at_the_hopf_point_and_is_known(bautin_branch):
    (hopf,) = bautin_branch.special_points
    assert set(bautin_branch.n_unstable[: hopf.index]) == {0}
    assert set(bautin_branch.n_unstable[hopf.index + 1 :]) == {2}
    assert bautin_branch.notes == ()


@pytest.mark.slow
def test_the_locus_of_a_sparse_hopf_point_has_its_generalised_one(bautin_branch):
    locus = mc.continue_special(bautin_branch.point("HB1"), "b2", bounds={"b1": (-1.0, 1.0), "b2": (-0.5, 0.5)})
    assert np.abs(locus["b1"]).max() < 1e-10
    (found,) = locus.special_points
    assert (found.kind, found["b2"]) == ("GH", pytest.approx(0.0, abs=1e-7))


@pytest.mark.slow
@pytest.mark.parametrize("n", [20, ON_A_GRID])
def test_a_pair_far_out_on_the_axis_that_passes_it_is_found_beside_slow_modes(n):
    slow = sparse.diags(-np.linspace(0.01, 1.0, n))

    def jacobian(u, p):
        return sparse.block_diag([slow, [[p["p"], -10.0], [10.0, p["p"]]]], format="csc")

    field = mc.VectorField(lambda u, p: jacobian(u, p) @ u, np.zeros(n + 2), {"p": -0.5}, jacobian=jacobian)
    branch = mc.continue_equilibria(field, "p", bounds=(-0.5, 0.5))
    (hopf,) = branch.special_points
    assert (hopf.kind, hopf["p"]) == ("HB", pytest.approx(0.0, abs=1e-10))
    assert hopf.coefficients["omega"] == pytest.approx(10.0, rel=1e-10)
    assert set(branch.n_unstable) == {0, 2} and branch.notes == ()


def takens(u, p):
    """Return the normal form of a Bogdanov-Takens point at b1 = b2 = 0: folds at b1 = 0, Hopf points at u = -b2."""
    return np.array([u[1], p["b1"] - u[0] ** 2 + u[1] * (p["b2"] + u[0])])


def takens_slope(u, p):
    return np.array([[0.0, 1.0], [-2.0 * u[0] + u[1], p["b2"] + u[0]]])


@pytest.fixture(scope="module", params=[True, False], ids=["sparse", "dense"])
def takens_branch(request):
    field = with_tail(takens, takens_slope, [1.0, 0.0], {"b1": 1.0, "b2": -0.3}, thin=request.param)
    return mc.continue_equilibria(field, "b1", bounds=(-0.5, 1.0), limits={"u[0]": (-1.0, 1.5)})


@pytest.mark.slow
def test_folds_and_hopf_points_of_a_sparse_field_are_those_of_the_dense_one(takens_branch):
    found = {p.kind: p for p in takens_branch.special_points}
    assert sorted(found) == ["HB", "LP"]
    assert found["LP"]["b1"] == pytest.approx(0.0, abs=1e-10)
    assert found["HB"]["b1"] == pytest.approx(0.09, rel=1e-9)
    assert found["HB"].coefficients["omega"] == pytest.approx(math.sqrt(0.6), rel=1e-9)


@pytest.mark.slow
def test_folds_and_hopf_points_vary_as_their_closed_forms(takens_branch):
    found = {p.kind: mc.sensitivities(p, ["b2"], quantities=["b1", "u[0]"])["b2"] for p in takens_branch.special_points}
    assert found["LP"] == pytest.approx({"b1": 0.0, "u[0]": 0.0}, abs=1e-8)
    assert found["HB"] == pytest.approx({"b1": -0.6, "u[0]": -1.0}, rel=1e-7)


@pytest.mark.slow
def test_the_locus_of_a_sparse_fold_has_its_double_zero(takens_branch):
    locus = mc.continue_special(takens_branch.of_kind("LP")[0], "b2", bounds={"b1": (-1.0, 1.0), "b2": (-0.5, 0.5)})
    found = [p for p in locus.special_points if p.kind == "BT"]
    assert [p["b2"] for p in found] == [pytest.approx(0.0, abs=1e-7)]
    # u1' = u2, u2' = -u1^2 + u1 u2: a = -1 and b = 1, for vectors at length one and a plane that the chain leaves alone
    assert found[0].coefficients["a"] / found[0].coefficients["b"] == pytest.approx(-1.0, rel=1e-6)


def cusp(u, p):
    return np.array([p["mu"] + p["nu"] * u[0] - u[0] ** 3 - 3.0 * (p["s"] - 0.2) * u[0] ** 2, -u[1]])


def cusp_slope(u, p):
    return np.diag([p["nu"] - 3.0 * u[0] ** 2 - 6.0 * (p["s"] - 0.2) * u[0], -1.0])


@pytest.mark.slow
def test_the_locus_of_a_sparse_fold_has_its_cusp():
    field = with_tail(cusp, cusp_slope, [1.5, 0.0], {"mu": 1.0, "nu": 1.0, "s": 0.2})
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))
    assert sorted(p["mu"] for p in branch.of_kind("LP")) == pytest.approx([-2.0 / 27.0**0.5, 2.0 / 27.0**0.5], rel=1e-9)
    locus = mc.continue_special(branch.point("LP1"), "nu", bounds={"mu": (-1.0, 1.0), "nu": (-0.5, 1.5)})
    (found,) = locus.special_points
    assert (found.kind, found["mu"], found["nu"]) == ("CP", pytest.approx(0.0, abs=1e-7), pytest.approx(0.0, abs=1e-7))
    # 3 s more of u^2 move the cusp to u = -s, where nu = -3 s^2
    moved = mc.sensitivities(found, ["s"], quantities=["nu", "u[0]"])["s"]
    assert moved == pytest.approx({"nu": 0.0, "u[0]": -1.0}, abs=1e-6)


@pytest.mark.parametrize("n", [1, 2])
def test_a_sparse_field_of_one_or_two_unknowns_has_its_fold(n):
    diagonal = [lambda u: -2.0 * u[0], lambda u: -1.0]
    field = mc.VectorField(
        lambda u, p: np.array([p["p"] - u[0] ** 2, -u[-1]][:n]), [0.5, 0.0][:n], {"p": 0.25},
        jacobian=lambda u, p: sparse.csc_matrix(np.diag([d(u) for d in diagonal[:n]])),
    )  # fmt: skip
    branch = mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0))
    (fold,) = branch.special_points
    assert (fold.kind, fold["p"]) == ("LP", pytest.approx(0.0, abs=1e-12))


@pytest.mark.slow
def test_a_pitchfork_of_a_sparse_field_is_found_with_its_coefficient():
    def head(u, p):
        return np.array([p["mu"] * u[0] - 2.0 * u[0] ** 3, -u[1]])

    def slope(u, p):
        return np.diag([p["mu"] - 6.0 * u[0] ** 2, -1.0])

    branch = mc.continue_equilibria(with_tail(head, slope, [0.0, 0.0], {"mu": -0.5}), "mu", bounds=(-1.0, 1.0))
    (found,) = branch.special_points
    assert (found.kind, found["mu"]) == ("BP", pytest.approx(0.0, abs=1e-10))
    assert found.coefficients["c"] == pytest.approx(-2.0, rel=1e-6)


def test_a_jacobian_that_leaves_its_domain_takes_no_square_of_memory():
    line = chain(5000)

    def jacobian(u, p):
        return line * math.sqrt(0.5 - p["p"])

    field = mc.VectorField(lambda u, p: line @ u + p["p"], np.zeros(5000), {"p": 0.0}, jacobian=jacobian)
    assert field.linearize(np.zeros(5000), {"p": 1.0}, ()).jac.nnz == 5000


def large_diffusion(n):
    line = chain(n)
    return mc.VectorField(lambda u, p: line @ u + p["p"], np.zeros(n), {"p": 0.0}, jacobian=lambda u, p: line)


def test_a_search_refuses_more_unknowns_than_dense_matrices_hold():
    with pytest.raises(mc.ParameterError, match=r"up to 1000 unknowns.*has 3000.*find_equilibrium"):
        mc.find_equilibria(large_diffusion(3000))


def test_a_creeping_motion_refuses_more_unknowns_than_modes_can_be_taken():
    field = large_diffusion(3000)
    assert "up to 1000 unknowns; there are 3000" in str(creep(field, np.ones(3000), field.values()).failure)


@pytest.mark.slow
def test_a_point_of_which_stability_is_not_known_says_so():
    n = 700
    jac = far_from_normal(n) - 5.0 * sparse.identity(n)
    field = mc.VectorField(lambda u, p: jac @ u + p["p"], np.zeros(n), {"p": 0.0}, jacobian=lambda u, p: jac)
    point = mc.find_equilibrium(field, {"p": 0.0})
    assert point.stability == "marginal"
    assert "stability is known for the nearest" in str(point)


@pytest.mark.slow
@pytest.mark.parametrize("n", [60, 240])
def test_rows_along_a_function_on_a_grid_do_not_depend_on_its_number_of_values(n):
    """u'' + la exp(u) = 0 has its fold at la = 3.5138 on fine grids (Ascher, Mattheij, Russell 1988)."""
    line = sparse.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [1, 0, -1], format="csc") * (n + 1.0) ** 2
    field = mc.VectorField(
        lambda u, p: line @ u + p["la"] * np.exp(u), np.zeros(n), {"la": 0.0},
        jacobian=lambda u, p: line + sparse.diags(p["la"] * np.exp(u)), bounds={"la": (0.0, 4.0)},
    )  # fmt: skip
    field.observe("largest", lambda u, p: u.max())
    branch = mc.continue_equilibria(field, "la", limits={"largest": (0.0, 2.0)})
    (fold,) = branch.special_points
    assert fold["la"] == pytest.approx(3.51383, rel=1e-3)
    assert 20 < len(branch) < 60
