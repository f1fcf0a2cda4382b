"""The document: what a page shows, plain data that strict JSON carries, with the numbers of the results to the bit."""

import json
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from problems.fields import branch_of_cusp

import mjcont as mc
from mjcont.explorer.arrays import packed, plain, unpacked
from mjcont.explorer.curves import JUMPING
from mjcont.explorer.document import FORMAT, VERSION, document_of
from mjcont.results.branch import Diagram


@pytest.fixture(scope="module")
def branch(overcentre_branch):
    return overcentre_branch(k_j=1e3)


@pytest.fixture(scope="module")
def document(branch):
    return document_of({"equilibria": branch})


def kept(curve, name):
    return unpacked(curve["columns"][name])


def test_a_document_is_strict_json_and_states_its_version(document):
    again = json.loads(json.dumps(document, allow_nan=False))
    assert (again["format"], again["version"]) == (FORMAT, VERSION)


def test_columns_are_those_of_the_branch_to_the_bit(document, branch):
    (curve,) = document["curves"]
    assert list(curve["columns"]) == list(branch.columns)
    assert all(np.array_equal(kept(curve, n), branch[n]) for n in branch.columns)


def test_special_points_carry_the_values_that_python_has(document, branch):
    for seen, point in zip(document["curves"][0]["specials"], branch.special_points, strict=True):
        assert (seen["label"], seen["row"]) == (point.label, point.index)
        assert seen["values"] == {**point.parameters, **point.observables}


def test_stability_is_told_by_signs(document, branch):
    codes = unpacked(document["curves"][0]["stability"])
    assert [("unstable", "marginal", "stable")[c + 1] for c in codes] == list(branch.stability)


def test_eigenvalues_of_every_row_travel_along(document, branch):
    table = unpacked(document["curves"][0]["eigenvalues"])
    assert np.allclose(table[..., 0] + 1j * table[..., 1], branch.eigenvalues, rtol=1e-6, equal_nan=True)


def test_angles_are_shown_in_degrees_and_large_forces_in_kilonewtons():
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 4e5), start={"F_ret": 3e5}, keyframe="uplock_above",
                                    direction=1, max_points=5)
    shown = document_of({"b": branch})["quantities"]
    assert (shown["theta_1"]["unit"], shown["F_ret"]["unit"]) == ("°", "kN")
    assert shown["theta_1"]["scale"] == pytest.approx(180.0 / np.pi)
    assert shown["F_ret"]["label"] == [["F", "ret", ""]]


def test_sliders_hold_what_the_branch_holds_in_units_that_read_well(document, branch):
    found = {s["name"]: s for s in document["sliders"]}
    stiffness = found["k_j"]
    assert (stiffness["value"], stiffness["shown"]["unit"]) == (branch.fixed["k_j"], "N/m")
    assert found["F"]["free"] and not stiffness["free"]
    assert all(s["lower"] < s["upper"] for s in found.values())


def test_a_plain_vector_field_has_no_scene_and_no_poses():
    document = document_of({"b": branch_of_cusp()})
    assert document["scene"] is None
    assert document["curves"][0]["poses"] is None


def test_every_branch_of_a_diagram_is_a_curve():
    diagram = Diagram([branch_of_cusp(), branch_of_cusp()])
    assert [c["id"] for c in document_of({"d": diagram})["curves"]] == ["d_1", "d_2"]


@pytest.mark.slow
def test_a_jump_of_a_load_path_is_rows_between_the_rest_lost_and_the_one_reached(branch):
    path = mc.load_path(branch, "F", [-50, 30], landing="creep")
    document = document_of({"path": path})
    (curve,) = document["curves"]
    codes, own = unpacked(curve["stability"]), unpacked(curve["own"])
    moving = np.flatnonzero(codes == JUMPING)
    (jump,) = path.jumps
    assert own[moving[0] - 1] == jump.index and own[moving[-1] + 1] == jump.index + 1
    assert np.array_equal(kept(curve, "height")[own >= 0], path["height"])
    heights = kept(curve, "height")[moving[0] - 1 : moving[-1] + 2]
    assert heights[0] < -0.6 and heights[-1] > 0.9


def test_orbits_travel_with_their_motion_also_where_a_force_drives_them():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mc.ResultWarning)  # an old file, without checksums
        response = mc.load(Path(__file__).parent.parent / "results" / "written" / "orbits" / "filtered_response.h5")
    (curve,) = document_of({"response": response})["curves"]
    motion, height = curve["orbit"], next(iter(response.orbits[0].reading.names))
    assert curve["kind"] == "orbits" and curve["poses"]["shape"][0] == len(response)
    rows = unpacked(motion["rows"])
    assert unpacked(motion["period"]) == pytest.approx(response["period"][rows])
    assert unpacked(motion["columns"][height]).max(axis=1) == pytest.approx(response[f"{height}.max"][rows], rel=1e-2)


def test_a_history_is_drawn_over_time_with_a_pose_a_sample(branch):
    history = mc.simulate(branch.model, {"F": 25.0}, duration=0.5, start=branch.point("LP1"))
    (curve,) = document_of({"h": history})["curves"]
    assert curve["axes"][0] == "time"
    assert curve["poses"]["shape"][0] == len(history)


def test_what_begins_on_a_branch_names_it(branch):
    found = mc.sensitivities(branch.point("LP1"), ["k_sp"])
    curves = document_of({"equilibria": branch, "influence": found})["curves"]
    assert curves[1]["parent"] == "equilibria"
    assert np.array_equal(unpacked(curves[1]["derivatives"]), found.derivatives)


def test_results_of_several_models_are_refused_by_their_names(branch):
    with pytest.raises(mc.MjcontError, match="one model, but 'equilibria' is of overcentre and 'other' of cusp"):
        document_of({"equilibria": branch, "other": branch_of_cusp()})


def test_another_version_of_a_model_is_another_model(branch):
    text = branch.problem.mjcf.replace("</mujoco>", "<!-- changed --></mujoco>")
    other = mc.continue_equilibria(mc.Mechanism.from_xml(text), "F", bounds=(-50, 50), start={"F": 50}, max_points=3)
    with pytest.raises(mc.MjcontError, match="of overcentre, another version of it: write a page for each"):
        document_of({"equilibria": branch, "changed": other})


def test_a_kind_of_result_that_is_not_shown_is_refused_with_those_that_are(branch):
    with pytest.raises(mc.MjcontError, match=r"shows no Modes: it takes .*Branch.*History"):
        document_of({"m": mc.modes(branch.point("LP1"))})


def test_arrays_come_back_as_they_were_with_what_is_no_number():
    values = np.array([[1.5, np.nan], [np.inf, -0.0]])
    assert np.array_equal(unpacked(packed(values)), values, equal_nan=True)


def test_numbers_that_json_does_not_have_are_none():
    assert plain({"a": float("nan"), "b": [np.float64(1.0), float("inf")]}) == {"a": None, "b": [1.0, None]}


def test_importing_mjcont_loads_none_of_the_explorer():
    script = "import mjcont, sys; print([m for m in sys.modules if m.startswith('mjcont.explorer')])"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout == "[]\n"
