"""A free parameter never leaves its bounds: in steps, between points, in differences, at special points."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest

import mjcont as mc
from mjcont.mechanism.evaluation import Evaluator
from mjcont.numerics.equations.differences import CENTRED, PARAMETER, kept_within
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.normalform import crossing
from mjcont.numerics.step.arclength import CurvePoint, Earlier, predict
from mjcont.numerics.step.hermite import node_windows
from mjcont.numerics.walk.interior import Gap, fill

Law = Callable[[Any, Any], list[float]]


def asked(law: Law, u0: list[float], parameters: dict[str, float], run: Callable[[mc.VectorField], Any]) -> Any:
    """Return what `run` returns, and all values of every parameter that it asks the field for."""
    seen: dict[str, list[float]] = {name: [] for name in parameters}

    def watched(u: Any, p: Any) -> list[float]:
        for name, values in seen.items():
            values.append(p[name])
        return law(u, p)

    return run(mc.VectorField(watched, u0, parameters)), {name: np.array(values) for name, values in seen.items()}


FOLD: Law = lambda u, p: [p["a"] - u[0] ** 2]  # noqa: E731
CUBIC: Law = lambda u, p: [p["a"] + u[0] - u[0] ** 3]  # noqa: E731
PITCHFORK: Law = lambda u, p: [p["a"] * u[0] - u[0] ** 3]  # noqa: E731
TRANSCRITICAL: Law = lambda u, p: [p["a"] * u[0] - u[0] ** 2]  # noqa: E731
LOGARITHM: Law = lambda u, p: [math.log(p["a"]) - u[0]]  # noqa: E731
SPIRAL: Law = lambda u, p: [  # noqa: E731
    p["a"] * u[0] - u[1] - u[0] ** 3, u[0] + p["a"] * u[1] - u[1] ** 3
]
_FOLD = 2.0 / math.sqrt(27.0)  # of the cubic

CURVES = {
    "a fold inside": (CUBIC, [-1.2], -0.528, (-0.6, 0.6)),
    "a fold on the bound": (FOLD, [0.5], 0.25, (0.0, 1.0)),
    "a fold just inside": (CUBIC, [1.2], 0.528, (-_FOLD - 1e-6, 0.6)),
    "a fold just beyond": (CUBIC, [1.2], 0.528, (-_FOLD + 1e-6, 0.6)),
    "decades": (FOLD, [0.5], 0.25, (1e-6, 1.0)),
    "a branch point on the bound": (PITCHFORK, [0.0], -0.5, (-1.0, 0.0)),
    "a Hopf point inside": (SPIRAL, [0.0, 0.0], -0.5, (-1.0, 0.4)),
    "a start on the bound": (FOLD, [1.0], 1.0, (0.1, 1.0)),
    "a pole at the bound": (LOGARITHM, [math.log(0.25)], 0.25, (1e-3, 1.0)),
}


@pytest.mark.parametrize("name", CURVES)
def test_no_value_beyond_the_bounds_is_asked_for_along_a_curve(name: str) -> None:
    law, u0, start, (low, high) = CURVES[name]
    branch, seen = asked(law, u0, {"a": start}, lambda f: mc.continue_equilibria(f, "a", bounds=(low, high)))
    assert seen["a"].min() >= low
    assert seen["a"].max() <= high
    assert {end[0] for end in branch.ends} == {"at bound"}
    for end in branch["a"][[0, -1]]:
        assert min(abs(end - low), abs(end - high)) <= 1e-14 * (high - low)


@pytest.mark.parametrize(("bounds", "at"), [((-1.0, 0.0), 0.0), ((0.0, 1.0), 0.0), ((-1.0, 0.0), -1e-3)])
@pytest.mark.parametrize(("law", "kind"), [(PITCHFORK, "pitchfork"), (TRANSCRITICAL, "transcritical")])
def test_branches_through_a_point_on_a_bound_are_told_from_within(
    law: Law, kind: str, bounds: tuple[float, float], at: float
) -> None:
    def run(field: mc.VectorField) -> Any:
        system = System(field, field.values({"a": at}), [Free("a", *bounds)])
        slope = system.free[0].slope(at)
        return crossing(system.local(np.zeros(1), system.start_y()), np.eye(2), np.ones(1), slope)

    found, seen = asked(law, [0.0], {"a": at}, run)
    assert found.kind == kind
    assert len(found.tangents) == 2
    assert bounds[0] <= seen["a"].min() <= seen["a"].max() <= bounds[1]


@pytest.mark.parametrize(("low", "folds"), [(-_FOLD - 1e-6, 2), (-_FOLD + 1e-6, 0), (-_FOLD + 1e-4, 0)])
def test_the_bound_decides_whether_a_curve_turns_at_a_fold_beside_it(low: float, folds: int) -> None:
    field = mc.VectorField(CUBIC, [1.2], {"a": 0.528})
    branch = mc.continue_equilibria(field, "a", bounds=(low, 0.6))
    assert len(branch.of_kind("LP")) == folds


@pytest.mark.slow
def test_no_value_beyond_either_pair_of_bounds_is_asked_for_along_a_locus():
    def run(field: mc.VectorField) -> mc.Branch:
        branch = mc.continue_equilibria(field, "a", bounds=(-0.6, 0.6))
        return mc.continue_special(branch.point("LP1"), "b", bounds=(0.0, 1.2))

    locus, seen = asked(lambda u, p: [p["a"] + p["b"] * u[0] - u[0] ** 3], [-1.2], {"a": -0.528, "b": 1.0}, run)
    assert seen["a"].min() >= -0.6
    assert seen["a"].max() <= 0.6
    assert seen["b"].min() >= 0.0
    assert seen["b"].max() <= 1.2
    assert locus.point("CP1")["b"] == pytest.approx(0.0, abs=1e-10)


def requests(monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, float]]:
    """Return a list that gets the least and the largest control of every evaluation."""
    seen: list[tuple[float, float]] = []
    evaluate = Evaluator.forces

    def watched(self: Evaluator, qpos: Any, qvel: Any = None, ctrl: Any = None) -> Any:
        given = self.writer.inputs.ctrl if ctrl is None else ctrl
        seen.append((float(given.min()), float(given.max())))
        return evaluate(self, qpos, qvel, ctrl)

    monkeypatch.setattr(Evaluator, "forces", watched)
    return seen


@pytest.mark.slow
def test_the_gear_is_never_asked_for_a_force_beyond_its_bounds(monkeypatch):
    # the points before the longest steps lie close together here
    gear = mc.Mechanism.from_xml("nose_gear")
    others = {"load_factor": 1.0, "F_ul": 0.0}
    seen = requests(monkeypatch)
    branch = mc.continue_equilibria(
        gear, "F_ret", bounds=(0.0, 2e6), start={"F_ret": 6e5, **others}, keyframe="uplock_above",
        ds_max=0.0571754, chord=3.6013e-06, angle=0.074057, angle_max=0.222171, ds=0.011624992,
    )  # fmt: skip
    assert branch.status == "at bound"
    assert min(low for low, _ in seen) >= 0.0
    assert max(high for _, high in seen) <= 2e6


@pytest.mark.parametrize("path", [[{"F": -20.0}, {"F": 20.0}], [{"F": 0.0, "k_j": 1e3}, {"F": 15.0, "k_j": 1e4}]])
def test_a_load_path_asks_for_no_load_beyond_its_ends(monkeypatch, path):
    mechanism = mc.Mechanism.from_xml("overcentre")
    seen = requests(monkeypatch)
    found = mc.load_path(mechanism, path, start={"F": path[0]["F"]})
    ends = sorted(p["F"] for p in path)
    assert len(found.segments)
    assert min(low for low, _ in seen) >= min(ends[0], 0.0)
    assert max(high for _, high in seen) <= max(ends[1], 0.0)


@pytest.mark.parametrize("rule", [CENTRED, PARAMETER], ids=["two points", "four points"])
@pytest.mark.parametrize("value", [0.0, 1e-9, 1e-4, 0.3, 1.0 - 1e-9, 1.0])
@pytest.mark.parametrize("step", [1e-3, 0.2, 5.0])
def test_difference_rules_within_bounds_are_exact_for_lines_and_stay_inside(rule, value, step):
    inside, h = kept_within(rule, step, value, (0.0, 1.0))
    places = np.array([value + o * h for o in inside.offsets])
    assert places.min() >= -1e-15
    assert places.max() <= 1.0 + 1e-15
    assert np.dot(inside.weights, 3.0 * places - 1.0) / h == pytest.approx(3.0, rel=1e-9)


def test_a_one_sided_rule_is_of_the_order_of_the_centred_one():
    inside, h = kept_within(PARAMETER, 0.1, 0.0, (0.0, 1.0))
    places = np.array([o * h for o in inside.offsets])
    assert h > 0
    assert np.dot(inside.weights, (1.0 + places) ** 4) / h == pytest.approx(4.0, rel=1e-12)


def test_a_value_beyond_the_bounds_keeps_its_rule():
    assert kept_within(PARAMETER, 0.1, 2.0, (0.0, 1.0)) == (PARAMETER, 0.1)


@pytest.mark.parametrize("cluster", [0.02, 0.2])
def test_a_gap_is_interpolated_through_no_cluster(cluster: float) -> None:
    s = np.array([0.0, 1e-9, 2e-9, 1e-3, 1.0, 1.0 + 1e-9, 2.0])
    windows, sizes = node_windows(s, np.array([3, 5]), 6, cluster)
    for gap in (3, 5):
        nodes = np.sort(s[windows[gap, : sizes[gap]]])
        assert {s[gap], s[gap + 1]} <= set(nodes)
        assert np.diff(nodes).min() >= cluster * (s[gap + 1] - s[gap])


def curve_point(s: float, y: float, slope: float, past: tuple[Earlier, ...]) -> CurvePoint:
    """Return a point (u, a) = (s, y) of a curve whose tangent has a given slope."""
    tangent = np.array([1.0, slope]) / math.hypot(1.0, slope)
    jac = np.array([[-slope, 1.0]])
    return CurvePoint(np.array([s]), np.array([y]), tangent, 1.0, cast(Any, None), jac, s, past=past)


def test_a_polynomial_that_swings_is_refused_before_anything_is_evaluated():
    # the slope at the point before is what noise makes of it: the quintic through the three is off by some lengths
    field = mc.VectorField(lambda u, p: [p["a"]], [0.0], {"a": 0.0})
    system = System(field, {"a": 0.0}, [Free("a", -10.0, 10.0)])
    before = Earlier(-0.03, np.array([-0.03, 0.0]), np.array([-1e3, 1.0]), np.array([[0.0, 1.0]]))
    old = curve_point(0.0, 0.0, 0.0, (before,))
    new = curve_point(1.0, 0.0, 0.0, (Earlier(0.0, np.array([-1.0, 0.0]), old.tangent, old.jac), before))
    (refused,) = fill(system, [Gap(old, new, 3)], Settings(), exact=False)
    assert isinstance(refused, Refused)
    assert refused.why is Why.SWINGS
    assert refused.message == "the polynomial through the points around the step swings"
    assert field.evaluations == 0


@pytest.mark.parametrize("exact", [False, True])
def test_steps_without_points_inside_need_none(exact: bool) -> None:
    field = mc.VectorField(lambda u, p: [p["a"]], [0.0], {"a": 0.0})
    system = System(field, {"a": 0.0}, [Free("a", -10.0, 10.0)])
    old = curve_point(0.0, 0.0, 0.0, ())
    new = curve_point(1.0, 0.0, 0.0, (Earlier(0.0, np.array([-1.0, 0.0]), old.tangent, old.jac),))
    assert [i.points for i in fill(system, [Gap(old, new, 0)], Settings(), exact=exact)] == [[]]  # type: ignore[union-attr]


def test_a_long_prediction_that_swings_goes_through_fewer_points():
    before = Earlier(-0.03, np.array([-0.03, 0.0]), np.array([-1e3, 1.0]), np.array([[0.0, 1.0]]))
    assert predict(curve_point(0.0, 0.0, 0.0, (before,)), 0.5, steady=True) == pytest.approx([0.5, 0.0])
