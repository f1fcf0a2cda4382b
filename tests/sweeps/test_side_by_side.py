"""Cases of a sweep side by side: what one after the other gives, and to the bit whatever is beside them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from problems.variants import STUDY, records, study

import mjcont as mc
from mjcont.influence.alongside import Fellows, Place
from mjcont.mechanism.batches import ModelVariants
from mjcont.sweeps import jobs
from mjcont.sweeps.jobs import NOMINAL, Item, run_items

LOADS = {"load_factor": 1.02, "gravity_angle": 0.01}


def moved(point: mc.SpecialPoint, targets: list[dict[str, float]], read: tuple[str, ...] = ()) -> list[Place | None]:
    fellows = Fellows.of(point, read)
    assert fellows is not None
    return fellows.moved([Place(point.parameters, point.state, point.free)] * len(targets), targets)


def agrees(place: Place | None, point: mc.SpecialPoint, angle: str, second: float = 1e-6) -> None:
    """Assert that a place is that of a point that was followed alone.

    Its state is to what that leaves open of it, its coefficient to `second`: rounding of second differences.
    """
    assert place is not None
    for name in point.free:
        assert place[name] == pytest.approx(point[name], rel=1e-9)
    left_open = max(1e-9, 3.0 * point.tolerance)
    assert place[angle] == pytest.approx(point[angle], abs=left_open)
    np.testing.assert_allclose(place.state, point.state, atol=left_open)
    for name, value in point.coefficients.items():
        assert place.coefficients[name] == pytest.approx(value, rel=second)


def overcentre(**start: float) -> mc.SpecialPoint:
    mechanism = mc.Mechanism.from_xml("overcentre")
    return mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 50.0), start={"F": 50.0, **start}).point("LP1")


@pytest.mark.slow
@pytest.mark.parametrize(("stiffness", "second"), [(1e3, 1e-8), (1e6, 1e-6), (1e8, 1e-3)])
def test_folds_of_the_overcentre_are_those_that_are_followed_alone(stiffness: float, second: float) -> None:
    fold = overcentre(k_j=stiffness)
    targets = [{"k_sp": 10.3, "l_us": 0.498}, {"m_1": 1.01, "m_2": 0.98, **LOADS}, {"k_j": 1.2 * stiffness}]
    for target, place in zip(targets, moved(fold, targets, ("theta_1",)), strict=True):
        agrees(place, mc.follow_point(fold, target).point, "theta_1", second)


@pytest.mark.slow
def test_cusps_of_the_gear_are_those_that_are_followed_alone() -> None:
    gear = mc.Mechanism.from_xml("nose_gear")
    start = {"F_ret": 4e5}
    branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start=start, keyframe="uplock_above")
    cusp = mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1e3, 0.0)).point("CP1")
    targets = [{"k_sp": 2040.0, "l_us": 0.8932, "m_1": 1190.0}, {"site:H_1.pos[2]": -0.6455, "k_j": 1.1e6}, LOADS]
    for target, place in zip(targets, moved(cusp, targets, ("theta_ov",)), strict=True):
        agrees(place, mc.follow_point(cusp, target).point, "theta_ov")


@pytest.mark.slow
def test_geometry_that_is_compiled_anew_is_moved_side_by_side() -> None:
    fold, end = overcentre(), "spec:site:B_1.pos[0]"
    targets = [{end: 0.501, "m_1": 1.02}, {end: 0.499}]
    for target, place in zip(targets, moved(fold, targets, ("theta_1",)), strict=True):
        agrees(place, mc.follow_point(fold, target).point, "theta_1")


def without_time(found: list[dict[str, Any]]) -> dict[int, dict[str, Any]]:
    return {r["case"]: {k: v for k, v in r.items() if k not in ("seconds", "sha256")} for r in found}


@pytest.mark.slow
def test_a_case_is_the_same_to_the_bit_whatever_is_beside_it_and_in_its_task(tmp_path: Path) -> None:
    table = mc.sweep(study(tmp_path), out=tmp_path, workers=1)
    stored = without_time(records(tmp_path))
    job = json.loads((tmp_path / "sweep.jsonl").read_text().splitlines()[0])["job"]
    items = [
        Item(i, tuple(table[n][i] for n in table.varied), p, None if p == NOMINAL else stored[p]["points"])
        for i, p in enumerate(table.starts.tolist())
    ]
    for size in (1, 2, 5):
        for first in range(0, len(items), size):
            for case, record in without_time(run_items(job, items[first : first + size])).items():
                assert record == stored[case]


@pytest.mark.slow
def test_a_variant_without_the_fold_fails_with_its_sentence_and_leaves_the_others_as_they_are(tmp_path: Path) -> None:
    text = STUDY.replace("cases = 12\nseed = 3", 'design = "list"').split("k_j = {")[0]
    values = {"few": "[900, 1100]", "all": "[900, 5, 1100]"}
    tables = {}
    for name, k in values.items():
        folder = tmp_path / name
        folder.mkdir()
        tables[name] = mc.sweep(study(folder, text + f"k_j = {{ values = {k} }}\n"), out=folder, workers=1)
    ((case, sentence),) = tables["all"].failed
    assert case == 1
    fold = overcentre(k_j=1000.0)
    assert sentence == f"fold: {mc.follow_point(fold, {'k_j': 5.0}).message}"
    np.testing.assert_array_equal(tables["all"]["fold.F"][[0, 2]], tables["few"]["fold.F"])


@pytest.mark.slow
def test_points_of_models_that_are_smooth_in_pieces_are_moved_one_by_one(tmp_path: Path) -> None:
    clamp = mc.Mechanism.from_xml("toggle_clamp")
    branch = mc.continue_equilibria(clamp, "M", bounds=(-30.0, 30.0), start={"M": 20.0}, keyframe="closed")
    fold = branch.of_kind("LP")[0]
    assert Fellows.of(fold) is None  # its stop is a limit
    table = mc.sweep({"fold": fold}, {"k": [1.01 * fold["k"]]}, design="list", out=tmp_path, workers=1)
    assert table["fold.M"][0] == mc.follow_point(fold, {"k": 1.01 * fold["k"]}).point["M"]


def test_a_model_with_large_meshes_is_not_copied_for_many_variants() -> None:
    kept = ModelVariants(lambda: (None, None), 10**9, {}, lambda count: None)  # type: ignore[arg-type, return-value]
    assert kept.most == 1
    assert mc.Mechanism.from_xml("overcentre").together(("F",)) > 1


@pytest.mark.slow
def test_cases_that_settle_side_by_side_are_not_followed_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("followed alone")

    monkeypatch.setattr(jobs, "follow_point", refuse)
    assert not mc.sweep(study(tmp_path), out=tmp_path, limit=4, workers=1).failed


def test_points_that_are_only_guessed_or_solve_for_a_field_are_not_moved_side_by_side() -> None:
    truss = mc.Mechanism.from_xml("von_mises_truss")
    fold = mc.continue_equilibria(truss, "P", bounds=(-50.0, 300.0)).point("LP1")
    assert Fellows.of(fold) is not None
    assert Fellows.of(replace(fold, converged=False)) is None
    assert Fellows.of(replace(fold, free={"k": (1.0, 1e4)})) is None
