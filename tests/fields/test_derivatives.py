"""Derivatives that the user gives: the shapes they may have, what they are for, and what is said of wrong ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import LinearOperator

import mjcont as mc

U, P = np.array([0.4, -0.3]), {"a": 0.7, "b": 1.3}


def f(u, p):
    return [p["a"] * np.exp(u[0]) - u[1] ** 3, p["b"] * u[0] * u[1] - p["a"]]


def jacobian(u, p):
    return np.array([[p["a"] * np.exp(u[0]), -3.0 * u[1] ** 2], [p["b"] * u[1], p["b"] * u[0]]])


def dfdp(u, p):
    return {"a": [np.exp(u[0]), -1.0], "b": [0.0, u[0] * u[1]]}


def second(u, p, v, w):
    return [p["a"] * np.exp(u[0]) * v[0] * w[0] - 6.0 * u[1] * v[1] * w[1], p["b"] * (v[0] * w[1] + v[1] * w[0])]


def third(u, p, v, w, z):
    return [p["a"] * np.exp(u[0]) * v[0] * w[0] * z[0] - 6.0 * v[1] * w[1] * z[1], 0.0]


def field(**given):
    return mc.VectorField(f, U, P, names=["x", "y"], name="hill", **given)


class Products:
    """An operator that has no more than a shape and products."""

    shape = (2, 2)

    def __init__(self, matrix):
        self.matrix = matrix

    def matvec(self, v):
        return self.matrix @ v


# -- what may be given ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind",
    [
        lambda j: j,
        lambda j: j.tolist(),
        sparse.csr_matrix,
        sparse.coo_array,
        Products,
        lambda j: LinearOperator((2, 2), matvec=lambda v: j @ v, dtype=float),
    ],
    ids=["array", "lists", "matrix", "sparse array", "products", "operator"],
)
def test_a_jacobian_of_any_kind_is_the_matrix(kind):
    jac = field(jacobian=lambda u, p: kind(jacobian(u, p))).linearize(U, P, ()).jac
    assert (jac.toarray() if sparse.issparse(jac) else jac) == pytest.approx(jacobian(U, P), rel=1e-15)


def test_an_operators_product_takes_one_product():
    asked = []

    def operator(u, p):
        return LinearOperator((2, 2), matvec=lambda v: asked.append(1) or jacobian(u, p) @ v, dtype=float)

    own = field(jacobian=operator)
    found = own.derivative_along(U, P, np.array([1.0, 2.0]))
    assert found == pytest.approx(jacobian(U, P) @ [1.0, 2.0], rel=1e-15)
    assert len(asked) == 1


@pytest.mark.parametrize("given", [dfdp, lambda u, p: np.column_stack([dfdp(u, p)["a"], dfdp(u, p)["b"]])])
def test_slopes_are_a_mapping_or_a_matrix_in_the_order_of_parameters(given):
    par = field(dfdp=given).linearize(U, P, ("b", "a")).par
    assert par == pytest.approx(np.column_stack([dfdp(U, P)["b"], dfdp(U, P)["a"]]), rel=1e-15)


def test_slopes_that_a_mapping_leaves_out_are_differences():
    par = field(dfdp=lambda u, p: {"a": dfdp(u, p)["a"]}).linearize(U, P, ("a", "b")).par
    assert par[:, 1] == pytest.approx(dfdp(U, P)["b"], abs=1e-9)


def test_given_slopes_cost_no_evaluations_after_the_first_point():
    own = field(jacobian=jacobian, dfdp=dfdp)
    own.linearize(U, P, ("a", "b"))
    before = own.evaluations
    own.linearize(U, P, ("a", "b"))
    assert own.evaluations - before == 1


def test_where_a_derivative_leaves_its_domain_it_is_no_number():
    def nowhere(*args):
        raise ZeroDivisionError

    own = field(jacobian=nowhere, dfdp=nowhere, second=nowhere)
    found = own.linearize(U, P, ("a",))
    assert np.isnan(found.jac).all()
    assert np.isnan(found.par).all()
    assert np.isnan(own.derivative_along(U, P, U, U)).all()


# -- what they are for ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_curve_with_all_derivatives_has_the_points_of_one_without():
    plain = mc.continue_equilibria(field(), "a", (0.0, 2.0))
    exact = mc.continue_equilibria(field(jacobian=jacobian, dfdp=dfdp, second=second, third=third), "a", (0.0, 2.0))
    assert [p.kind for p in exact.special_points] == [p.kind for p in plain.special_points] != []
    for one, other in zip(exact.special_points, plain.special_points, strict=True):
        assert one["a"] == pytest.approx(other["a"], abs=1e-8)


def test_a_fold_coefficient_is_that_of_the_second_derivative_that_was_given():
    asked = []

    def bend(u, p, v, w):
        asked.append((v, w))
        return [2.0 * v[0] * w[0]]

    own = mc.VectorField(lambda u, p: [p["a"] + u[0] ** 2], [-1.0], {"a": -1.0}, second=bend)
    fold = mc.continue_equilibria(own, "a", (-1.0, 1.0)).point("LP1")
    assert fold.coefficients["a"] == 1.0  # w f_xx v v / 2, to the bit
    assert asked


def test_a_lyapunov_coefficient_is_exact_with_second_and_third_derivatives():
    """x' = a x - y - x (x^2 + y^2), y' = x + a y - y (x^2 + y^2): l1 = -2 for |q| = 1, as C(q, q, q*) = -4 q."""

    def f(u, p):
        r = u @ u
        return [p["a"] * u[0] - u[1] - u[0] * r, u[0] + p["a"] * u[1] - u[1] * r]

    def jacobian(u, p):
        turn = np.array([[p["a"], -1.0], [1.0, p["a"]]])
        return turn - (u @ u) * np.eye(2) - 2.0 * np.outer(u, u)

    def second(u, p, v, w):
        return -2.0 * ((u @ w) * v + (v @ w) * u + (u @ v) * w)

    def third(u, p, v, w, z):
        return -2.0 * ((z @ w) * v + (v @ w) * z + (z @ v) * w)

    own = mc.VectorField(f, np.zeros(2), {"a": -1.0}, jacobian=jacobian, second=second, third=third)
    own.check_derivatives([0.3, -0.2])
    hopf = mc.continue_equilibria(own, "a", (-1.0, 1.0)).point("HB1")
    assert hopf.coefficients["l1"] == pytest.approx(-2.0, rel=1e-13)


# -- wrong shapes --------------------------------------------------------------------------------------------------


def operator_of(shape):
    return LinearOperator(shape, matvec=lambda v: np.zeros(shape[0]), dtype=float)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"jacobian": lambda u, p: np.zeros((2, 3))},
         r"jacobian of hill returned shape \(2, 3\) for 2 unknowns: expected \(2, 2\)"),
        ({"jacobian": lambda u, p: sparse.eye(3)},
         r"jacobian of hill returned shape \(3, 3\) for 2 unknowns: expected \(2, 2\)"),
        ({"jacobian": lambda u, p: operator_of((2, 4))},
         r"jacobian of hill returned shape \(2, 4\) for 2 unknowns: expected \(2, 2\)"),
        ({"jacobian": lambda u, p: Products(np.zeros((3, 2)))},
         r"product with the jacobian of hill returned shape \(3,\) for 2 unknowns: expected \(2,\)"),
        ({"jacobian": lambda u, p: [[1.0], [1.0, 2.0]]}, "jacobian of hill returned no array of numbers"),
        ({"jacobian": lambda u, p: "junk"}, "jacobian of hill returned no array of numbers"),
        ({"jacobian": lambda u, p: u[5]}, "the jacobian of hill raised IndexError"),
        ({"dfdp": lambda u, p: np.zeros((2, 1))},
         r"dfdp of hill returned shape \(2, 1\) for 2 unknowns and 2 parameters \(a, b\), or a mapping of names to "
         r"\(2,\): expected \(2, 2\)"),
        ({"dfdp": lambda u, p: {"a": [1.0, 2.0, 3.0]}},
         r"dfdp\['a'\] of hill returned shape \(3,\) for 2 unknowns: expected \(2,\)"),
        ({"dfdp": lambda u, p: {"A": [1.0, 2.0]}}, r"has 'A', which is no parameter. Did you mean a\? Valid: a, b"),
    ],
)
def test_a_derivative_of_a_wrong_shape_shows_both(given, words):
    with pytest.raises(mc.FunctionError, match=words):
        field(**given).linearize(U, P, ("a",))


@pytest.mark.parametrize("what", ["second", "third"])
def test_a_form_of_a_wrong_shape_shows_both(what):
    own = field(**{what: lambda u, p, *along: np.eye(2)})
    with pytest.raises(mc.FunctionError, match=rf"{what} of hill returned shape \(2, 2\) .*: expected \(2,\)"):
        own.derivative_along(U, P, *[U] * (2 if what == "second" else 3))


def test_an_operator_of_many_unknowns_is_refused_in_favour_of_a_sparse_matrix():
    n = 3000
    own = mc.VectorField(lambda u, p: p["a"] - u, np.zeros(n), {"a": 1.0}, jacobian=lambda u, p: operator_of((n, n)))
    with pytest.raises(mc.FunctionError, match="operator for 3000 unknowns: up to 2000 .* return scipy.sparse instead"):
        own.linearize(np.zeros(n), {"a": 1.0}, ())


# -- wrong numbers -------------------------------------------------------------------------------------------------


def wrong(what, i, j):
    """Return df/du or df/dp with one entry off by a hundredth."""

    def function(u, p):
        found = jacobian(u, p) if what == "jacobian" else np.array(list(dfdp(u, p).values())).T
        found[i, j] += 0.01
        return found

    return function


@pytest.mark.parametrize(("i", "j"), [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_a_wrong_jacobian_is_found_out_at_the_first_point_and_the_entry_named(i, j):
    words = rf"the jacobian of hill is off: d f\[{i}\] / d {'xy'[j]} is .*, by differences of f"
    with pytest.raises(mc.FunctionError, match=words):
        field(jacobian=wrong("jacobian", i, j)).linearize(U, P, ())


@pytest.mark.parametrize(("i", "name"), [(0, "a"), (1, "a"), (0, "b"), (1, "b")])
def test_a_wrong_slope_is_found_out_at_the_first_point_and_the_entry_named(i, name):
    with pytest.raises(mc.FunctionError, match=rf"the dfdp of hill is off: d f\[{i}\] / d {name} is "):
        field(dfdp=wrong("dfdp", i, "ab".index(name))).linearize(U, P, ("a", "b"))


def test_a_wrong_entry_among_a_hundred_unknowns_is_found_out_and_named():
    n = 100
    coupling = np.cos(np.arange(n)[:, None] * np.arange(n)) / n

    def jacobian(u, p):
        found = coupling - np.diag(3.0 * u**2)
        found[17, 71] *= 1.1
        return found

    own = mc.VectorField(lambda u, p: coupling @ u - u**3 + p["a"], np.ones(n), {"a": 1.0}, jacobian=jacobian)
    with pytest.raises(mc.FunctionError, match=r"d f\[17\] / d u\[71\] is"):
        own.linearize(np.ones(n), {"a": 1.0}, ())
    assert own.evaluations < 400  # fewer than a Jacobian by differences


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"second": lambda u, p, v, w: 0.5 * np.array(second(u, p, v, w))},
         r"the second derivative of hill is off: f\[[01]\] of D2f\[v, w\]"),
        ({"third": lambda u, p, v, w, z: -np.array(third(u, p, v, w, z))},
         r"the third derivative of hill is off: f\[0\] of D3f\[v, w, z\]"),
    ],
)
def test_a_wrong_form_is_found_out_where_it_is_first_used(given, words):
    own = field(**given)
    with pytest.raises(mc.FunctionError, match=words):
        own.derivative_along(U, P, *[U] * (2 if "second" in given else 3))
    with pytest.raises(mc.FunctionError, match=words):
        own.check_derivatives()


def test_right_derivatives_pass():
    field(jacobian=jacobian, dfdp=dfdp, second=second, third=third).check_derivatives(U, {"a": 0.5})


def test_an_entry_that_the_first_point_does_not_show_is_found_by_the_whole_check():
    """The missing term vanishes at the first point, u = 0."""
    own = mc.VectorField(lambda u, p: [p["a"] - u[0] + u[0] ** 2], [0.0], {"a": 0.0}, jacobian=lambda u, p: [[-1.0]])
    own.linearize(np.zeros(1), {"a": 0.0}, ())
    with pytest.raises(mc.FunctionError, match=r"d f\[0\] / d u\[0\] is -1, by differences of f -0.5"):
        own.check_derivatives([0.25])


def test_a_function_that_refuses_states_beside_the_curve_is_left_in_peace():
    def wary(u, p):
        if u[0] < 0.0:
            raise RuntimeError("no such amount")
        return [p["a"] - u[0]]

    own = mc.VectorField(wary, [1e-3], {"a": 1e-3}, jacobian=lambda u, p: [[-1.0]])
    own.linearize(np.array([1e-3]), own.values(), ())


@pytest.mark.parametrize(
    ("f", "jacobian", "u"),
    [
        (lambda u, p: [max(u[0], 0.0) - p["a"]], lambda u, p: [[1.0 if u[0] >= 0.0 else 0.0]], 0.0),
        (lambda u, p: [u[0] ** 0.5 - p["a"]], lambda u, p: [[0.5 / u[0] ** 0.5]], 1e-3),
        (lambda u, p: [1e9 * (u[0] - p["a"]) + np.cos(u[0])], lambda u, p: [[1e9 - np.sin(u[0])]], 0.5),
        (lambda u, p: [np.sin(1e4 * u[0]) - p["a"]], lambda u, p: [[1e4 * np.cos(1e4 * u[0])]], 0.3),
        (lambda u, p: [np.tanh(u[0] / 1e-6) - p["a"]], lambda u, p: [[1e6 / np.cosh(u[0] / 1e-6) ** 2]], 1e-7),
    ],
    ids=["at a kink", "near the domain's end", "stiff", "fast", "steep"],
)
def test_a_right_derivative_that_differences_do_not_resolve_is_not_refused(f, jacobian, u):
    own = mc.VectorField(f, [u], {"a": 0.5}, jacobian=jacobian)
    with np.errstate(all="ignore"):
        own.linearize(np.array([u]), {"a": 0.5}, ())


# -- what is no number of full precision --------------------------------------------------------------------------

SLIPS = {
    "returned nothing": lambda found: None,
    "returned complex numbers": lambda found: np.asarray(found) + 0.5j,
    "returned float32": lambda found: np.asarray(found, dtype=np.float32),
}


@pytest.mark.parametrize("said", SLIPS)
def test_a_function_that_returns_no_doubles_is_told(said):
    slip = SLIPS[said]
    with pytest.raises(mc.FunctionError, match=f"the function of hill {said}"):
        mc.VectorField(lambda u, p: slip(f(u, p)), U, P, name="hill").residual(U, P)


@pytest.mark.parametrize("said", SLIPS)
@pytest.mark.parametrize("kind", [np.array, sparse.csr_array], ids=["dense", "sparse"])
def test_a_jacobian_that_returns_no_doubles_is_told(said, kind):
    def own(u, p):
        found = SLIPS[said](jacobian(u, p))
        return None if found is None else kind(found)

    with pytest.raises(mc.FunctionError, match=f"the jacobian of hill {said}"):
        field(jacobian=own).linearize(U, P, ())


@pytest.mark.parametrize("what", ["second", "third"])
def test_a_form_without_a_return_is_told(what):
    along = np.eye(2)[[0, 1, 0][: 2 if what == "second" else 3]]
    with pytest.raises(mc.FunctionError, match=f"the {what} of hill returned nothing"):
        field(**{what: lambda *args: None}).derivative_along(U, P, *along)
