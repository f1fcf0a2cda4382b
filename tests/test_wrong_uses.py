"""Every verb given every wrong kind of thing in every place: a sentence of ours, never an error of Python's own."""

import inspect
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.arguments import checked


class Odd:
    """Something that no verb takes."""


WRONG: Mapping[str, Any] = {
    "None": None, "a number": 3, "a negative number": -1, "not a number": float("nan"), "words": "junk", "nothing": "",
    "a list of words": ["a"], "a dict of junk": {"junk": 1}, "numbers as names": {1: 2},
    "words as values": {"a": "x", "b": "x"}, "an object": Odd(), "a class": Odd, "bytes": b"x", "true": True,
    "a tuple": (1, 2, 3), "a matrix": np.zeros((2, 3)), "a complex number": 1j,
}


def cubic(u: Any, p: Any) -> list[Any]:
    return [p["a"] + p["b"] * u[0] - u[0] ** 3]


FIELD = mc.VectorField(cubic, [0.0], {"a": -1.0, "b": 1.0})
BRANCH = mc.continue_equilibria(FIELD, "a", (-1.0, 1.0))
FOLD = BRANCH.point("LP1")
TRUSS = mc.Mechanism.from_xml("von_mises_truss")
RESTS = mc.continue_equilibria(TRUSS, "P", (0.0, 1.0), max_points=2)
DIAGRAM = mc.Diagram([BRANCH])
MODES = mc.modes(RESTS[0])
HISTORY = mc.simulate(TRUSS, duration=0.02)
SPREAD = {"b": mc.Spread("normal", 0.01)}

# verbs with a right value for every argument that is tried; those that would take long are given little to do
USES: Mapping[str, tuple[Callable[..., Any], Mapping[str, Any]]] = {
    "from_xml": (mc.Mechanism.from_xml, {"source": "von_mises_truss", "friction": "refuse"}),
    "from_spec": (mc.Mechanism.from_spec, {"spec": mujoco.MjSpec.from_string(TRUSS.mjcf)}),
    "from_model": (mc.Mechanism.from_model, {"model": mujoco.MjModel.from_xml_string(TRUSS.mjcf)}),
    "VectorField": (mc.VectorField, {
        "function": cubic, "u0": [0.0], "parameters": {"a": 0.0, "b": 1.0}, "jacobian": None, "names": ["u"],
        "units": {"a": "m"}, "scale": [1.0], "bounds": {"a": (-1.0, 1.0)}, "name": "n", "period": None,
        "vectorized": False}),
    "continue_equilibria": (mc.continue_equilibria, {
        "problem": FIELD, "parameter": "a", "bounds": (-1.0, 1.0), "start": {"a": 0.0}, "state": None, "keyframe": None,
        "direction": None, "zeros": None, "limits": None, "max_points": 3}),
    "find_equilibrium": (mc.find_equilibrium, {"problem": FIELD, "start": {"a": 0.0}, "state": [0.1]}),
    "find_equilibria": (mc.find_equilibria, {
        "problem": FIELD, "params": {"a": 0.0}, "starts": 4, "seed": 0, "max_solutions": 2, "max_starts": 4}),
    "bifurcation_diagram": (mc.bifurcation_diagram, {
        "problem": FIELD, "parameter": "a", "bounds": (-1.0, 1.0), "starts": {"a": 0.0}, "max_branches": 1,
        "max_points": 3}),
    "switch_branches": (mc.switch_branches, {"point": FOLD, "bounds": (-1.0, 1.0)}),
    "extend": (mc.extend, {"branch": BRANCH, "bounds": (-2.0, 2.0), "max_points": 2}),
    "continue_special": (mc.continue_special, {
        "point": FOLD, "parameter": "b", "bounds": (0.5, 1.5), "direction": 1, "zeros": None, "max_points": 2}),
    "continue_cycles": (mc.continue_cycles, {"origin": FOLD, "parameter": "a", "bounds": (-1.0, 1.0), "max_points": 1}),
    "continue_response": (mc.continue_response, {
        "problem": FIELD, "parameter": "frequency", "bounds": (1.0, 1.2), "forcing": {"a": mc.Harmonic(0.1)},
        "start": {"b": -1.0}, "max_points": 1}),
    "Harmonic": (mc.Harmonic, {"amplitude": 1.0, "phase": 0.0, "harmonic": 1}),
    "Spread": (mc.Spread, {"kind": "normal", "width": 1.0, "relative": False, "centre": None, "cut": 3.0}),
    "Settings": (mc.Settings, {"ds": 0.01, "max_points": 3}),
    "sensitivities": (mc.sensitivities, {"point": FOLD, "parameters": ["b"], "quantities": "a", "tolerances": None}),
    "follow_point": (mc.follow_point, {"point": FOLD, "values": {"b": 1.1}}),
    "worst_case": (mc.worst_case, {
        "point": FOLD, "ranges": {"b": (0.9, 1.1)}, "quantity": "a", "maximise": True, "grid": None, "starts": None}),
    "special_map": (mc.special_map, {"point": FOLD, "grid": {"b": [0.9, 1.1]}}),
    "simulate": (mc.simulate, {
        "problem": TRUSS, "inputs": {"P": 1.0}, "duration": 0.02, "start": {"P": 0.0}, "state": None, "velocity": None,
        "timestep": None, "integrator": "discrete", "tol": None, "samples": 10, "until_rest": None}),
    "simulate a field": (mc.simulate, {"problem": FIELD, "inputs": {"a": 0.5}, "duration": 0.02, "start": {"a": 0.0}}),
    "simulate_many": (mc.simulate_many, {"mechanism": TRUSS, "cases": [{"inputs": {"P": 1.0}}], "duration": 0.02}),
    "verify_stability": (mc.verify_stability, {"branch": RESTS, "n": 1, "max_steps": 600, "rows": [0]}),
    "load_path": (mc.load_path, {
        "source": TRUSS, "parameter": "P", "path": [0.0, 1.0], "start": None, "landing": "motion", "max_jumps": 0}),
    "energy_barrier": (mc.energy_barrier, {"point": RESTS[0], "saddles": RESTS}),
    "modes": (mc.modes, {"point": RESTS[0]}),
    "transfer": (mc.transfer, {"point": RESTS[0], "input": "P", "output": ["z"], "frequencies": [1.0, 2.0]}),
    "plot": (mc.plot, {"*curves": BRANCH, "x": "a", "y": "u[0]", "title": "", "units": (), "legend": None}),
    "draw": (mc.draw, {"mechanism": TRUSS, "pose": None, "plane": None, "labels": False}),
    "load_study": (mc.load_study, {"path": "overcentre"}),
    "sweep": (mc.sweep, {"what": {"fold": FOLD}, "vary": SPREAD, "out": "here", "cases": 2, "seed": 1}),
    "bushed_xml": (mc.bushed_xml, {"model": "four_bar", "stiffness": 1e6}),
    "constraint_stiffness": (mc.constraint_stiffness, {"mechanism": TRUSS}),
    "branch.at": (BRANCH.at, {"a": 0.2}),
    "branch.point": (BRANCH.point, {"label": "LP1"}),
    "branch.row": (BRANCH.row, {"index": 1}),
    "branch.save": (BRANCH.save, {"path": "b.h5"}),
    "branch.to_csv": (BRANCH.to_csv, {"path": "b.csv"}),
    "branch[...]": (BRANCH.__getitem__, {"*name": "a"}),
    "point[...]": (FOLD.__getitem__, {"*name": "a"}),
    "history[...]": (HISTORY.__getitem__, {"*name": "z"}),
    "history.save": (HISTORY.save, {"path": "h.h5"}),
    "modes.mode": (MODES.mode, {"number": 1}),
    "parameter": (TRUSS.parameter, {"name": "P"}),
    "values": (TRUSS.values, {"given": {"P": 1.0}}),
    "values of a field": (FIELD.values, {"given": {"a": 1.0}}),
    "declare": (lambda **k: mc.Mechanism.from_xml("von_mises_truss").declare("own", k["path"], bounds=k["bounds"]),
                {"path": "joint:z.stiffness", "bounds": None}),
}


@pytest.mark.slow
@pytest.mark.parametrize("use", USES)
def test_a_wrong_kind_of_thing_is_told_in_a_sentence(use: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    verb, right = USES[use]
    raw = []
    for name in right:
        for what, value in WRONG.items():
            given = {**right, name: value}
            first = [given.pop(k) for k in list(given) if k.startswith("*")]
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    verb(*first, **given)
            except mc.MjcontError as error:
                assert str(error)
            except Exception as error:
                raw.append(f"{name} = {what}: {type(error).__name__}: {error}")
            plt.close("all")
    assert raw == []


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda: mc.continue_equilibria(FIELD, ["a", "b"], (0.0, 1.0)),
         "parameter must be a string, got the list ['a', 'b']"),
        (lambda: mc.continue_equilibria("overcentre", "F", (0.0, 1.0)),
         "problem must be a Mechanism or a VectorField, got the str 'overcentre': such as mc.Mechanism.from_xml("),
        (lambda: mc.continue_special(BRANCH, "b"), "must be a SpecialPoint, got the Branch: take one of a branch"),
        (lambda: mc.sensitivities(BRANCH), "point must be a Point, got the Branch: take one of a branch"),
        (lambda: mc.Mechanism.from_xml(mujoco.MjModel.from_xml_string(TRUSS.mjcf)),
         "got MjModel: Mechanism.from_model takes compiled models"),
        (lambda: mc.Mechanism.from_spec("overcentre"), "Mechanism.from_xml takes paths and text"),
        (lambda: mc.VectorField(cubic, [0.0, 1.0], {"a": 0.0, "b": 1.0}, scale=10.0),
         "scale must have shape (2,), got (): a number for each entry, such as np.full(2, 10)"),
        (lambda: mc.find_equilibrium(mc.VectorField(cubic, [0.0, 1.0], {"a": 0.0, "b": 1.0})),
         "returned shape (1,) for 2 unknowns"),
        (lambda: mc.simulate(FIELD, keyframe="up"), "keyframe is for a Mechanism: vector field is a vector field"),
        (lambda: BRANCH.at(a="5"), "Branch.at: a must be a number, got the str '5'"),
        (lambda: mc.Mechanism("overcentre"), "Mechanism: model must be an MjModel, got the str 'overcentre'"),
        (lambda: mc.add_bushes(TRUSS), "model must be a string, a path or an MjSpec, got the Mechanism"),
        (lambda: TRUSS.observe("sum", "x + z"), "Mechanism.observe: function must be a function, got the str 'x + z'"),
        (lambda: mc.sweep(FOLD, SPREAD, out="x"), 'returns, or {"fold": branch.point("LP1")}'),
        (lambda: DIAGRAM["LP1"], "Diagram[...]: index must be a whole number, got the str 'LP1'"),
        (lambda: HISTORY[3], 'a name is a string such as "F", got the int 3'),
        (lambda: BRANCH[10**6], "row 1000000 of "),
        (lambda: mc.plot("a.h5", x="F", y="z"),
         "plot takes branches one by one, as in plot(branch, locus, x=..., y=...); got a str"),
        (lambda: BRANCH.save(3), "a path is a string such as"),
    ],
)
def test_a_message_says_what_is_wanted_and_what_to_write(wrong: Callable[[], Any], words: str) -> None:
    with pytest.raises(mc.MjcontError) as error:
        wrong()
    assert words in str(error.value)


def test_what_is_missing_is_told_by_python_itself() -> None:
    with pytest.raises(TypeError, match=r"follow_point\(\) missing 1 required positional argument: 'values'"):
        mc.follow_point(FOLD)


def test_rows_come_one_by_one_and_from_the_end() -> None:
    assert BRANCH.row(-1)["a"] == BRANCH[len(BRANCH) - 1]["a"] == list(BRANCH)[-1]["a"]


def test_a_checked_function_keeps_its_signature_and_takes_numbers_of_numpy() -> None:
    @checked
    def verb(count: int, size: float, names: list[str] | None = None) -> float:
        """Say so."""
        return count * size

    assert verb(np.int64(3), np.float32(2.0)) == 6.0
    assert verb.__doc__ == "Say so."
    assert list(inspect.signature(verb).parameters) == ["count", "size", "names"]
    with pytest.raises(mc.ParameterError, match="names must be a list of strings, got the list"):
        verb(1, 1.0, [1])


@pytest.mark.slow
def test_a_curve_from_a_branch_point_of_its_own_says_what_follows_the_others() -> None:
    pitchfork = mc.VectorField(lambda u, p: [p["a"] * u[0] - u[0] ** 3], [0.0], {"a": -1.0})
    point = mc.continue_equilibria(pitchfork, "a", (-1.0, 1.0)).point("BP1")
    with pytest.warns(mc.BranchWarning, match=r"several branches meet in BP1, .* mc.switch_branches\(point\)"):
        mc.continue_equilibria(pitchfork, "a", (-1.0, 1.0), point)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(mc.bifurcation_diagram(pitchfork, "a", (-1.0, 1.0), point)) == 2


def test_a_warning_names_the_line_of_the_users_own_however_deep_it_arises() -> None:
    mechanism = mc.Mechanism.from_xml("overcentre")
    with pytest.warns(mc.RangeWarning) as said:
        mc.continue_equilibria(mechanism, "gravity_angle", (-20.0, 20.0), max_points=2)
    assert said[0].filename == __file__
