"""What the contract of a problem promises: the abstract methods are enough, and refusals are told by their reason."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import mjcont as mc
from mjcont.numerics.equations.differences import CENTRED
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Equations, Linearization, Pencil
from mjcont.numerics.equations.refusals import Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.kinds import CONTINUABLE, KINDS, found_on
from mjcont.numerics.step.arclength import first_point
from mjcont.results.model import Model
from mjcont.results.quantities import Observable, Parameter


class Parabola(Model):
    """f = p - x^2 with nothing but what must be there: a fold at x = 0, p = 0."""

    n, second_order, evaluations = 1, False, 0
    state_scale = np.ones(1)
    name, state_labels = "parabola", [("x", "")]

    def __init__(self, failure=""):
        self.parameters = {"p": Parameter("p", "", 1.0, (-1.0, 1.0), "field")}
        self.observables = {"x": Observable("x", "", lambda values, x: float(x[0]))}
        self.keyframes, self.reason = {}, failure

    failure = property(lambda self: self.reason)

    def values(self, given=None):
        return {"p": 1.0} | {k: float(v) for k, v in (given or {}).items()}

    def start_state(self, keyframe=None, state=None):
        return np.ones(1) if state is None else np.array(state, dtype=float)

    def residual(self, x, values):
        self.evaluations += 1
        return np.array([values["p"] - x[0] ** 2]) if not self.reason else np.array([np.nan])

    def residuals(self, x, values, steps):
        return np.array([self.residual(x + s, values) for s in steps])

    def linearize(self, x, values, wrt, *, accurate=False, ranges=()):
        return Linearization(self.residual(x, values), np.array([[-2.0 * x[0]]]), np.ones((1, len(wrt))))

    def parameter_stencil(self, name, value, bounds=None):
        return CENTRED, CENTRED.step

    def pencil(self, x, values, jac):
        return Pencil(None, None, -jac)

    def first_order(self, x, values, steps):
        return self.residuals(x, values, steps)

    def measure(self, states, values, names=None):
        return np.array(states)


def test_a_model_of_abstract_methods_alone_is_followed_round_its_fold():
    branch = mc.continue_equilibria(Parabola(), "p")
    (fold,) = branch.special_points
    assert (fold.kind, fold["p"], fold["x"]) == ("LP", pytest.approx(0.0, abs=1e-12), pytest.approx(0.0, abs=1e-6))
    assert branch.status == "at bound"


def test_a_problem_that_leaves_out_a_method_is_refused_when_it_is_made():
    missing = type("Unfinished", (Parabola,), {"residual": Equations.residual})
    with pytest.raises(TypeError, match="residual"):
        missing()


def test_every_capability_has_a_default_and_a_sentence():
    for name, member in vars(Equations).items():
        if not name.startswith("_"):
            assert inspect.getdoc(member), name


def test_a_value_that_is_not_there_is_refused_with_the_reason_of_the_problem():
    system = System(Parabola("no model compiles there"), {"p": 1.0}, [Free("p", -1.0, 1.0)])
    refused = first_point(system, np.ones(1), system.start_y(), 1.0, Settings())
    assert (refused.why, str(refused)) == (Why.UNDEFINED, "no model compiles there")


def test_each_kind_that_is_followed_has_conditions_and_as_many_parameters_as_they_solve_for():
    system = System(Parabola(), {"p": 0.0}, [Free("p", -1.0, 1.0)])
    assert CONTINUABLE == tuple(k.code for k in KINDS.values() if k.conditions is not None)
    for code in CONTINUABLE:
        conditions = KINDS[code].conditions(system.local(np.zeros(1), np.zeros(1)), system, 1.0)
        added = sum(c.count - len(c.aux) for c in conditions)
        assert added == KINDS[code].codimension, code


def test_what_is_found_on_a_branch_and_not_on_a_locus_has_codimension_one():
    assert {c for c in found_on("branch") if c not in found_on("locus")} == {"LP", "HB"}
