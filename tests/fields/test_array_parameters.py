"""Parameters that are arrays: functions see them whole, everything else one entry at a time."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

GIVEN = {"a": 0.5, "k": [1.0, 2.0, 3.0]}


def f(u, p):
    return [p["a"] - np.sum(p["k"] * np.array([u[0], u[0] ** 2, u[0] ** 3]), axis=0)]


def field(function=f, given=GIVEN, **more):
    return mc.VectorField(function, [0.2], given, **more)


def test_entries_are_parameters_with_names_values_units_and_bounds():
    own = field(units={"k": "N/m", "k[2]": "N/m3"}, bounds={"k": (0.0, 9.0), "k[1]": (1.0, 5.0)})
    assert list(own.parameters) == ["a", "k[0]", "k[1]", "k[2]"]
    assert [p.value for p in own.parameters.values()] == [0.5, 1.0, 2.0, 3.0]
    assert [p.unit for p in own.parameters.values()] == ["", "N/m", "N/m", "N/m3"]
    assert [own.parameter(f"k[{i}]").bounds for i in range(3)] == [(0.0, 9.0), (1.0, 5.0), (0.0, 9.0)]


def test_an_entry_is_continued_while_the_others_keep_theirs():
    """x + 2 x^2 + k x^3 = a."""
    branch = mc.continue_equilibria(field(), "k[2]", (0.0, 6.0), start={"k[1]": 4.0})
    x, k = branch["u[0]"], branch["k[2]"]
    assert x + 4.0 * x**2 + k * x**3 == pytest.approx(np.full(len(k), 0.5), abs=1e-9)


@pytest.mark.parametrize("vectorized", [False, True])
def test_functions_see_the_array_whole(vectorized):
    shapes = []

    def function(u, p):
        shapes.append(np.shape(p["k"]))
        return f(u, p)

    own = field(function, vectorized=vectorized)
    rows = [{**own.values(), "k[1]": float(i)} for i in range(4)]
    found = own.rates(np.full((4, 1), 0.2), rows, [0.0] * 4)
    assert found[:, 0] == pytest.approx([0.5 - 0.2 - i * 0.04 - 3.0 * 0.008 for i in range(4)], rel=1e-14)
    assert shapes[-1] == ((3, 4) if vectorized else (3,))


def test_every_function_of_the_user_sees_it():
    seen = {}

    def told(what, value):
        def function(*args):
            seen[what] = np.shape(next(a for a in args if isinstance(a, dict))["k"])
            return value

        return function

    own = mc.VectorField(lambda u, p: [0.0], [0.2], {"k": [1.0, 2.0]}, jacobian=told("jacobian", [[0.0]]),
                         dfdp=told("dfdp", {"k": [[0.0, 0.0]]}), second=told("second", [0.0]),
                         third=told("third", [0.0]), period=told("period", 1.0), energy=told("energy", 0.0))
    own.observe("seen", told("observable", 1.0))
    values, x = own.values(), np.zeros(1)
    own.linearize(x, values, ("k[0]",))
    own.derivative_along(x, values, x, x)
    own.derivative_along(x, values, x, x, x)
    own.measure(x[None], values)
    own.period(values)
    own.energy(x, values)
    assert set(seen.values()) == {(2,)}
    assert len(seen) == 7


def test_slopes_of_an_array_are_columns():
    own = field(dfdp=lambda u, p: {"a": [1.0], "k": [[-u[0], -(u[0] ** 2), -(u[0] ** 3)]]})
    assert own.linearize(np.array([0.2]), own.values(), ("k[1]", "a")).par.tolist() == [[-(0.2**2), 1.0]]


def test_the_array_is_the_users_own():
    def spoils(u, p):
        p["k"][:] = 7.0
        return [u[0]]

    own = field(spoils)
    own.residual(np.array([0.2]), own.values())
    assert own.values()["k[0]"] == 1.0


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"k": np.zeros((2, 3))}, r"parameter 'k' must be a number or have shape \(k,\), got shape \(2, 3\)"),
        ({"k": []}, r"parameter 'k' must be a number or have shape \(k,\), got shape \(0,\)"),
        ({"k": [1.0, np.nan]}, r"parameter 'k\[1\]': the value must be a finite number, got nan"),
        ({"k": [1.0, "x"]}, r"parameter 'k\[0\]': the value must|parameter 'k\[1\]': the value must be a finite"),
        ({"k": [1.0], "k[0]": 2.0}, r"two parameters are called 'k\[0\]'"),
        ({"k": [[1.0], [1.0, 2.0]]}, r"parameter 'k' must be a number or have shape \(k,\)"),
    ],
)
def test_what_is_no_array_of_numbers_is_refused(given, words):
    with pytest.raises(mc.ParameterError, match=words):
        field(given=given)


def test_slopes_of_a_wrong_number_of_entries_show_both_shapes():
    own = field(dfdp=lambda u, p: {"k": [[1.0, 2.0]]})
    with pytest.raises(mc.FunctionError, match=r"dfdp\['k'\] of vector field returned shape \(1, 2\) for 1 unknowns: "
                                               r"expected \(1, 3\)"):
        own.linearize(np.zeros(1), own.values(), ("k[0]",))


def test_the_array_itself_is_no_parameter_and_entries_are_suggested():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'k'.*k\[0\]"):
        mc.continue_equilibria(field(), "k", (0.0, 1.0))
