"""A field that takes many states at once, as the columns of u."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

STATES = np.array([[0.1, 0.2], [0.3, -0.4], [0.5, 0.6], [-0.7, 0.8]])


def reactor(u, p):
    rate = p["D"] * (1.0 - u[0]) * np.exp(u[1])
    return [-u[0] + rate, -4.0 * u[1] + p["B"] * rate]


def field(function=reactor, vectorized=True, **more):
    return mc.VectorField(function, [0.0, 0.0], {"D": 0.1, "B": 18.0}, vectorized=vectorized, **more)


class Heard:
    """A function that remembers the shapes of the states that it was given."""

    def __init__(self, function=reactor):
        self.function, self.shapes = function, []

    def __call__(self, u, p):
        self.shapes.append(np.shape(u))
        return self.function(u, p)


def test_states_with_parameters_of_their_own_are_what_each_is_by_itself():
    values = [{"D": 0.1 * k, "B": 18.0} for k in range(4)]
    single = field(vectorized=False).rates(STATES, values, [0.0] * 4)
    assert field().rates(STATES, values, [0.0] * 4) == pytest.approx(single, rel=1e-14)


def test_many_states_are_one_call_and_count_one_evaluation_each():
    heard = Heard()
    own = field(heard)
    own.residuals(STATES[0], own.values(), STATES)
    heard.shapes.clear()
    before = own.evaluations
    own.residuals(STATES[0], own.values(), STATES)
    assert heard.shapes == [(2, 4)]
    assert own.evaluations - before == 4


def test_parameters_are_numbers_where_they_agree_and_arrays_where_they_differ():
    seen = []

    def function(u, p):
        seen.append({name: np.shape(v) for name, v in p.items()})
        return reactor(u, p)

    field(function).rates(STATES, [{"D": 0.1 * k, "B": 18.0} for k in range(4)], [0.0] * 4)
    assert seen[-1] == {"D": (4,), "B": ()}


def test_entries_of_a_list_may_be_numbers():
    own = field(lambda u, p: [p["B"] - u[0], 1.0])
    assert own.residuals(STATES[0], own.values(), STATES)[:, 1].tolist() == [1.0] * 4


def test_time_comes_with_the_states():
    own = mc.VectorField(lambda u, p, t: [np.cos(t) - u[0]], [0.0], {"a": 1.0}, vectorized=True)
    times = [0.0, 1.0, 2.0]
    assert own.rates(np.zeros((3, 1)), [own.values()] * 3, times)[:, 0] == pytest.approx(np.cos(times))


@pytest.mark.slow
def test_the_curve_is_that_of_the_plain_function():
    curves = [mc.continue_equilibria(field(vectorized=v), "D", (0.0, 0.6)) for v in (True, False)]
    batched, plain = (curve.special_points for curve in curves)
    assert [p.kind for p in batched] == [p.kind for p in plain]
    assert [p["D"] for p in batched] == pytest.approx([p["D"] for p in plain], abs=1e-9)


def test_where_the_function_leaves_its_domain_the_other_states_keep_their_values():
    def function(u, p):
        if np.any(np.asarray(u[0]) > 0.4):
            raise ZeroDivisionError
        return [u[0] + 0.0 * u[1], u[1]]

    found = field(function).rates(STATES, [{"D": 0.1, "B": 18.0}] * 4, [0.0] * 4)
    assert np.isnan(found[2]).all()
    assert found[[0, 1, 3]] == pytest.approx(STATES[[0, 1, 3]])


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda u, p: np.zeros(2), r"declared vectorized and returned shape \(2,\) for u of shape \(2, 3\): "
                                   r"expected \(2, 3\)"),
        (lambda u, p: [u[0], u[1] if u.ndim == 1 else u[1][:2]],
         r"entries of shapes \(3,\), \(2,\) for 3 states at once: each must be a number or \(3,\)"),
        (lambda u, p: np.array([u[0] - np.sum(u), u[1]]), r"its columns are not what it returns for each state by "
                                                          r"itself: f\[0\] of column 0 is"),
        (lambda u, p: [u[0] if u[0] > 0 else -u[0], u[1]], r"declared vectorized, raised ValueError for u of shape "
                                                           r"\(2, 3\)"),
    ],
    ids=["one state", "entries", "mixed", "branches"],
)
def test_a_function_that_is_not_vectorized_is_found_out(function, words):
    own = field(function)
    for _ in range(2):  # it stays so
        with pytest.raises(mc.FunctionError, match=words):
            own.residuals(STATES[0], own.values(), STATES)


def test_states_as_rows_are_found_out_where_their_number_is_that_of_the_unknowns():
    own = mc.VectorField(lambda u, p: np.array([u[0] - p["a"], 2.0 * u[1], u[2]]).T, np.zeros(3), {"a": 1.0},
                         vectorized=True)
    with pytest.raises(mc.FunctionError, match="its columns are not"):
        own.residuals(np.zeros(3), own.values(), np.eye(3))


def test_a_function_that_refuses_states_beside_those_asked_for_is_left_in_peace():
    def wary(u, p):
        if np.any(u < 0.0):
            raise RuntimeError("no such amount")
        return p["D"] - u

    own = mc.VectorField(wary, [1e-3], {"D": 1e-3}, vectorized=True)
    assert own.residuals(np.array([1e-3]), own.values(), np.array([[0.0], [1e-3]]))[:, 0].tolist() == [0.0, -1e-3]


def test_a_wrong_kind_of_answer_is_refused():
    with pytest.raises(mc.ParameterError, match="vectorized must be True or False, got the str 'yes'"):
        field(vectorized="yes")
