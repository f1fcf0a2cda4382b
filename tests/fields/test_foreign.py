"""Functions of CasADi and JAX: recognised by what they offer, with every derivative, on columns and on arrays.

By stand-ins with the same methods, and by the packages themselves where they are installed.
"""

from __future__ import annotations

import importlib.util
import sys

import numpy as np
import pytest
from problems import standins

import mjcont as mc

GIVEN = {"a": 2.0, "k": [1.0, 2.0, 3.0]}
U, V, W, Z = np.array([[0.5, 0.3], [1.0, 2.0], [0.3, -1.0], [2.0, 1.0]])


def f(u, p):
    a, k = p["a"], p["k"]
    return [a * u[0] - u[1] ** 3 + k[0], u[0] * (k[0] + k[1] + k[2]) - u[1] ** 2]


def installed(package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    return importlib.import_module(package)


def field(function, given=GIVEN, u0=U, **more):
    return mc.VectorField(function, u0, given, **more)


def casadi_standin(inputs):
    """The function f of u, a and k, or of u and all parameters, as CasADi's."""

    def compute(u, *others):
        named = dict(zip(list(inputs)[1:], others, strict=True))
        all_of_them = next((v for n, v in named.items() if n not in ("a", "k", "t")), None)
        a, k = (named["a"], named["k"]) if all_of_them is None else (all_of_them[:1], all_of_them[1:])
        m = max(v.shape[1] for v in (u, a, k))
        found = f(u, {"a": a[0], "k": k})
        return [np.array([np.broadcast_to(row, m) for row in found])]

    return standins.Casadi(compute, inputs, {"rates": 2})


def casadi_itself(inputs):
    ca = installed("casadi")
    symbols = {name: ca.SX.sym(name, size) for name, size in inputs.items()}
    u, *others = symbols.values()
    a, k = (symbols["a"], symbols["k"]) if "a" in symbols else (others[0][0], others[0][1:])
    rates = ca.vertcat(*f([u[0], u[1]], {"a": a, "k": [k[0], k[1], k[2]]}))
    return ca.Function("f", list(symbols.values()), [rates], list(symbols), ["rates"])


def jax_standin(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", standins.jax())
    return standins.Compiled(lambda u, p: np.array(f(u, p)))


def jax_itself():
    jax = installed("jax")
    jax.config.update("jax_enable_x64", True)
    return jax.jit(lambda u, p: jax.numpy.array(f(u, p)))


@pytest.fixture(params=["stand-in, by name", "stand-in, all at once", "CasADi, by name", "CasADi, all at once",
                        "JAX's stand-in", "JAX"])
def own(request, monkeypatch):
    """A field whose function is another package's."""
    inputs = {"u": 2, "k": 3, "a": 1} if "name" in request.param else {"u": 2, "q": 4}
    if "JAX" in request.param:
        return field(jax_standin(monkeypatch) if "stand-in" in request.param else jax_itself())
    return field((casadi_standin if "stand-in" in request.param else casadi_itself)(inputs))


def test_values_and_first_derivatives_are_those_of_the_plain_function(own):
    plain, values, wrt = field(f), own.values(), ("k[1]", "a", "k[0]")
    there, here = plain.linearize(U, values, wrt), own.linearize(U, values, wrt)
    assert here.f == pytest.approx(there.f, rel=1e-14)
    assert here.jac == pytest.approx(there.jac, abs=1e-9)
    assert here.par == pytest.approx(there.par, abs=1e-9)


def test_second_and_third_derivatives_come_with_it(own):
    values = own.values()
    assert own.derivative_along(U, values, V, W) == pytest.approx([-6.0 * 0.3 * V[1] * W[1], -2.0 * V[1] * W[1]], 1e-6)
    assert own.derivative_along(U, values, V, W, Z) == pytest.approx([-6.0 * V[1] * W[1] * Z[1], 0.0], abs=1e-4)


def test_many_states_with_parameters_of_their_own_are_what_each_is(own):
    states, rows = np.array([U, V, W]), [{**own.values(), "k[1]": float(i), "a": 2.0 - i} for i in range(3)]
    expected = field(f).rates(states, rows, [0.0] * 3)
    assert own.vectorized
    assert own.rates(states, rows, [0.0] * 3) == pytest.approx(expected, rel=1e-14)
    assert own.residuals(U, own.values(), np.eye(2)) == pytest.approx(
        field(f).residuals(U, own.values(), np.eye(2)), rel=1e-14
    )


def test_what_is_given_beside_it_takes_its_place():
    asked = []

    def jacobian(u, p):
        asked.append(1)
        return [[p["a"], -3.0 * u[1] ** 2], [6.0, -2.0 * u[1]]]

    own = field(casadi_standin({"u": 2, "k": 3, "a": 1}), jacobian=jacobian)
    own.linearize(U, own.values(), ())
    assert asked


def test_a_casadi_function_may_take_the_time():
    def compute(u, a, t):
        return [a * np.cos(t) - u]

    own = mc.VectorField(standins.Casadi(compute, {"u": 1, "a": 1, "t": 1}, {"f": 1}), [0.0], {"a": 2.0})
    assert own.timed
    assert own.rates(np.zeros((2, 1)), [own.values()] * 2, [0.0, 1.0])[:, 0] == pytest.approx([2.0, 2.0 * np.cos(1.0)])


def test_a_jax_function_may_take_the_time(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", standins.jax())
    function = standins.Compiled(lambda u, p, t: np.array([p["a"] * np.cos(t) - u[0]]))
    own = mc.VectorField(function, [0.0], {"a": 2.0})
    assert own.rates(np.zeros((2, 1)), [own.values()] * 2, [0.0, 1.0])[:, 0] == pytest.approx([2.0, 2.0 * np.cos(1.0)])


@pytest.mark.parametrize("make", [casadi_standin, casadi_itself], ids=["stand-in", "CasADi"])
@pytest.mark.parametrize(
    ("inputs", "given", "u0", "words"),
    [
        ({"u": 2, "k": 3, "a": 1}, GIVEN, [0.0, 0.0, 0.0],
         r"takes shape \(2, 1\), u0 has 3 unknowns: expected \(3, 1\)"),
        ({"u": 2, "k": 3, "a": 1}, {"a": 1.0, "k": [1.0, 2.0]}, U,
         "has an input 'k' of 3 numbers: expected 2"),
        ({"u": 2, "q": 4}, {"a": 1.0, "k": [1.0, 2.0]}, U,
         "has an input 'q' of 4 numbers: expected the name of a parameter .*, t, or one input with all 3 numbers"),
    ],
)
def test_inputs_that_do_not_fit_say_what_is_expected(make, inputs, given, u0, words):
    function = make(inputs)
    with pytest.raises(mc.ParameterError, match=words):
        field(function, given, u0)


def test_jax_with_32_bits_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", standins.jax(wide=False))
    with pytest.raises(mc.ParameterError, match=r'32 bits until .*: jax.config.update\("jax_enable_x64", True\)'):
        field(standins.Compiled(lambda u, p: u))


def test_a_function_with_such_methods_is_plain_where_there_is_no_jax(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", None)
    own = field(standins.Compiled(f))
    assert own.jacobian is None
    assert own.residual(U, own.values()) == pytest.approx(f(U, {"a": 2.0, "k": [1.0, 2.0, 3.0]}))


@pytest.mark.slow
def test_a_large_casadi_jacobian_with_few_entries_is_sparse():
    ca = installed("casadi")
    n = 300
    u, a = ca.SX.sym("u", n), ca.SX.sym("a")
    own = mc.VectorField(ca.Function("f", [u, a], [a - u**3 + ca.vertcat(u[1:], 0)], ["u", "a"], ["f"]), np.ones(n),
                         {"a": 0.5})
    jac = own.linearize(np.ones(n), own.values(), ()).jac
    assert jac.nnz == 2 * n - 1
    assert jac.diagonal() == pytest.approx(-3.0 * np.ones(n))
