"""The studies of the nose gear's forces over attitude and load, and within tolerances.

The rigid gear's closed forms are held against the cusps of the elastic gear, computed as extended systems from energies
written out by hand (docs/paper.md).
"""

from __future__ import annotations

import importlib
import sys

import numpy as np
import pytest

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))
RigidGear = importlib.import_module("_rigid_gear").RigidGear
GEAR = {"m_1": 1200.0, "m_2": 60.0, "m_3": 70.0, "m_4": 2.5, "m_5": 2.5, "m_6": 600.0, "k_sp": 2000.0, "l_us": 0.892,
        "r_ret": 0.055}


@pytest.fixture(scope="module")
def tolerances():
    """Return the study of tolerances."""
    return load_script(scripts_folder() / "tolerances.py")


@pytest.fixture(scope="module")
def few(tolerances):
    """Return twelve gears at three small factors."""
    return tolerances.compute(factors=(0.5, 1.0, 2.0), cases=12, workers=1)


def test_the_rigid_gear_is_in_line_where_the_model_is():
    assert np.degrees(RigidGear.of(GEAR).theta_1) == pytest.approx(-60.44, abs=0.005)


def test_the_rigid_gear_has_the_cusp_of_the_elastic_one_but_for_the_bushes():
    rigid = RigidGear.of(GEAR)
    assert rigid.unlock(0.0, 1.0) == pytest.approx(-411.808, rel=0.005)
    assert rigid.retraction(0.0, 1.0) == pytest.approx(484766.55, rel=0.005)


@pytest.mark.long
def test_stiffer_bushes_bring_the_unlock_force_to_that_of_rigid_pins():
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", start={"F_ret": 2.5e5}, keyframe="uplock_above")
    fold = next(p for p in branch.of_kind("LP") if p.index > branch.start_index)
    cusp = mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0)).point("CP1")
    exact = float(RigidGear.of(gear.values()).unlock(0.0, 1.0))
    apart = [abs(mc.follow_point(cusp, {"k_j": k}).point["F_ul"] - exact) for k in (1e6, 1e7, 1e8)]
    assert apart[1] < 0.15 * apart[0]
    assert apart[2] < 0.15 * apart[1]


@pytest.mark.long
def test_findings_of_the_load_map_on_a_coarse_grid():
    study = load_script(scripts_folder() / "load_map.py")
    findings = study.findings(study.compute(5, 3))
    assert all(f.holds for f in findings), [f.claim for f in findings if not f.holds]


@pytest.mark.long
def test_errors_of_the_linear_estimate_are_quadratic_case_by_case(few):
    at = {d.factor: d.found["F_ul"] - d.predicted["F_ul"] for d in few.draws}
    large = np.abs(at[2.0]) > 0.2 * np.abs(at[2.0]).max()
    assert at[2.0][large] / at[1.0][large] == pytest.approx(4.0, rel=0.1)
    assert at[1.0][large] / at[0.5][large] == pytest.approx(4.0, rel=0.1)


@pytest.mark.long
def test_shares_of_the_spring_are_those_of_its_law(few):
    # Rigid pins: F_ul = k_sp (l - l_us) + the locklinks' weight, so its slopes are (l - l_us) and -k_sp.
    rigid = RigidGear.of(GEAR)
    stiffness, length = rigid.spring / GEAR["k_sp"] * 0.01 * GEAR["k_sp"], GEAR["k_sp"] * 1e-3
    shares = few.shares("F_ul")
    assert shares["k_sp"] / shares["l_us"] == pytest.approx((stiffness / length) ** 2, rel=0.01)
    assert sum(shares.values()) == pytest.approx(1.0)


@pytest.mark.long
@pytest.mark.parametrize("name", ["load_map", "tolerances"])
def test_findings_of_the_studies(name, tmp_path):
    findings = load_script(scripts_folder() / f"{name}.py").main(tmp_path)
    assert all(f.holds for f in findings), [f.claim for f in findings if not f.holds]
    assert (tmp_path / f"{name}.png").stat().st_size > 50_000
