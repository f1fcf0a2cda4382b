"""One Mechanism in several threads, and results in other processes: the same numbers to the bit."""

import copy
import pickle
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from typing import Any

import mujoco
import numpy as np
import pytest

import mjcont as mc

STARTS = (48.0, 49.0, 50.0, 51.0)


def curve(mechanism: Any, value: float, **values: float) -> np.ndarray:
    branch = mc.continue_equilibria(mechanism, "F", bounds=(45.0, 55.0), start={"F": value, **values})
    return np.column_stack([branch["F"], branch.states, branch.eigenvalues.real])


def together(work: list[Callable[[], Any]]) -> list[Any]:
    """Return what each gives when all begin at once, in threads."""
    barrier = threading.Barrier(len(work))

    def run(one: Callable[[], Any]) -> Any:
        barrier.wait()
        return one()

    with ThreadPoolExecutor(len(work)) as pool:
        return list(pool.map(run, work))


@pytest.mark.slow
def test_one_mechanism_in_several_threads_gives_what_it_gives_in_one() -> None:
    alone = [curve(mc.Mechanism.from_xml("overcentre"), v, k_j=800.0 + v) for v in STARTS]
    shared = mc.Mechanism.from_xml("overcentre")
    found = together([lambda v=v: curve(shared, v, k_j=800.0 + v) for v in STARTS])
    for a, b in zip(alone, found, strict=True):
        np.testing.assert_array_equal(a, b)


def test_threads_may_declare_parameters_while_others_compute() -> None:
    shared = mc.Mechanism.from_xml("overcentre")
    body = mujoco.MjSpec.from_string(shared.mjcf).bodies[1].name
    paths = ("actuator:bush_C_z.biasprm[1]*-1", f"spec:body:{body}.mass")  # the second compiles the model anew
    work: list[Callable[[], Any]] = [lambda v=v: curve(shared, v) for v in STARTS[:2]]
    found = together([*work, *[lambda p=p: shared.parameter(p) for p in paths * 2]])
    np.testing.assert_allclose(found[0], curve(mc.Mechanism.from_xml("overcentre"), STARTS[0]), rtol=1e-9, atol=1e-9)
    assert found[2] is found[4]


def test_a_copy_has_declarations_of_its_own(overcentre) -> None:
    other = overcentre.copy()
    other.parameter("actuator:bush_C_z.biasprm[1]*-1")
    other.observe("twice", lambda model, data: 2.0 * data.qpos[0])
    assert "actuator:bush_C_z.biasprm[1]*-1" not in overcentre.parameters
    assert "twice" not in overcentre.observables
    np.testing.assert_array_equal(curve(other, 50.0)[:, 0], curve(overcentre, 50.0)[:, 0])


# -- other processes -------------------------------------------------------------------------------------------


def twice(model: Any, data: Any) -> float:
    return float(2.0 * data.qpos[0])


def test_a_mechanism_comes_back_with_what_was_declared_and_observed(overcentre) -> None:
    path = "actuator:bush_C_z.biasprm[1]*-1"
    overcentre.parameter(path)
    overcentre.observe("twice", twice, "m")
    again = pickle.loads(pickle.dumps(overcentre))
    assert list(again.parameters) == list(overcentre.parameters)
    assert list(again.observables) == list(overcentre.observables)
    np.testing.assert_array_equal(curve(again, 50.0, **{path: 900.0}), curve(overcentre, 50.0, **{path: 900.0}))


def test_a_mechanism_of_a_compiled_model_comes_back(overcentre) -> None:
    compiled = mc.Mechanism.from_model(mujoco.MjModel.from_xml_string(overcentre.mjcf))
    again = pickle.loads(pickle.dumps(compiled))
    np.testing.assert_array_equal(curve(again, 50.0), curve(compiled, 50.0))


def test_a_lambda_cannot_be_pickled_and_says_so(overcentre) -> None:
    overcentre.observe("twice", lambda model, data: 0.0)
    with pytest.raises((pickle.PicklingError, AttributeError), match="[Cc]an't (pickle|get local object)"):
        pickle.dumps(overcentre)


def test_a_shallow_copy_shares_and_a_deep_one_does_not(overcentre) -> None:
    assert copy.copy(overcentre).parameters is overcentre.parameters
    assert copy.deepcopy(overcentre).parameters is not overcentre.parameters


def results(mechanism: mc.Mechanism) -> dict[str, Any]:
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 60.0), start={"F": 50.0})
    fold = branch.point("LP1")
    return {
        "branch": branch,
        "point": fold,
        "locus": mc.continue_special(fold, "gravity_angle", bounds=(-0.05, 0.05)),
        "path": mc.load_path(mechanism, "F", [50.0, 40.0]),
        "history": mc.simulate(mechanism, {"F": 50.0}, duration=0.2),
        "equilibria": mc.find_equilibria(mechanism, {"F": 50.0}, starts=8),
        "sensitivities": mc.sensitivities(fold, ["k_j"]),
        "certificate": mc.verify_stability(branch, 2).certificate,
    }


@pytest.mark.slow
def test_results_of_every_kind_come_back_and_read_the_same() -> None:
    for name, result in results(mc.Mechanism.from_xml("overcentre")).items():
        again = pickle.loads(pickle.dumps(result))
        assert str(again) == str(result), name
        if hasattr(result, "problem"):
            assert again.problem.name == "overcentre"


@pytest.mark.slow
def test_any_executor_computes_with_mechanisms_and_results(overcentre, overcentre_branch) -> None:
    point = overcentre_branch().point("LP1")
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        there = pool.submit(curve, overcentre, 50.0).result()
        moved = pool.submit(mc.follow_point, point, {"k_j": 900.0}).result()
    np.testing.assert_array_equal(there, curve(overcentre, 50.0))
    assert moved.point["F"] == mc.follow_point(point, {"k_j": 900.0}).point["F"]
