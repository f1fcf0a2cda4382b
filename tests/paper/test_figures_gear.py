"""Figures 10 to 15: what the nose gear's crucial fold does in nine load cases, and the figures' findings.

Source: Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section IV. Reference
values: energies of planar links on linear bushes written out by hand, folds and cusp solved as extended systems.
"""

from __future__ import annotations

import importlib
import sys
from functools import cache

import numpy as np
import pytest
from problems.marks import long
from problems.pictures import meeting, watched

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))
_gear = importlib.import_module("_gear")
_loci = importlib.import_module("_loci")

LOADS = (0.5, 1.0, 2.5)
ANGLES = (-20.0, 0.0, 20.0)
QUICK = ((1.0, 0.0), (2.5, -20.0))
NINE = pytest.mark.parametrize(
    ("load_factor", "degrees"), [(n, a) if (n, a) in QUICK else long(n, a) for n in LOADS for a in ANGLES]
)


@pytest.fixture(scope="module")
def case():
    """Return a function: FP1 and its locus at a load factor and gravity angle (computed once each)."""
    gear = mc.Mechanism.from_xml("nose_gear")
    return cache(lambda load_factor, degrees: _loci.Case.of(gear, load_factor, degrees))


@pytest.fixture(scope="module")
def cusps(case):
    """Return a function: F_ul or F_ret at the cusps of one load factor, by rising gravity angle."""
    return lambda name, load_factor: np.array([case(load_factor, a).cusp[name] for a in ANGLES])


def degrees_of(point, name):
    return float(np.degrees(point[name]))


@pytest.mark.slow
def test_fp1_equals_the_reference(case):
    fold = case(1.0, 0.0).fold
    assert fold["F_ret"] == pytest.approx(474766.687, rel=1e-8)
    assert degrees_of(fold, "theta_ov") == pytest.approx(16.715341, abs=1e-6)
    assert degrees_of(fold, "theta_1") == pytest.approx(-59.556420, abs=1e-6)


@pytest.mark.slow
def test_fp1_under_500_newton_equals_the_reference(case):
    fold = case(1.0, 0.0).unlocked
    assert fold["F_ul"] == pytest.approx(-500.0, abs=1e-9)
    assert fold["F_ret"] == pytest.approx(479994.765, rel=1e-8)
    assert degrees_of(fold, "theta_ov") == pytest.approx(-9.87745, abs=1e-5)
    assert degrees_of(fold, "theta_1") == pytest.approx(-60.19432, abs=1e-5)


def test_cusp_equals_the_reference(case):
    cusp = case(1.0, 0.0).cusp
    assert cusp["F_ul"] == pytest.approx(-411.808, abs=5e-4)
    assert cusp["F_ret"] == pytest.approx(484766.55, abs=5e-3)
    assert degrees_of(cusp, "theta_ov") == pytest.approx(0.4136, abs=5e-5)


def test_point_where_slices_exchange_branches_equals_the_reference(case):
    point = case(1.0, 0.0).exchange
    assert point["F_ul"] == pytest.approx(-411.80426, abs=5e-6)
    assert point["F_ret"] == pytest.approx(484758.25, abs=5e-3)
    assert degrees_of(point, "theta_ov") == pytest.approx(-0.02692, abs=5e-6)


@pytest.mark.slow
@NINE
def test_fp1_lies_above_overcentre_without_unlock_force_and_below_with_500_newton(case, load_factor, degrees):
    found = case(load_factor, degrees)
    assert found.fold["theta_ov"] > 0 > found.unlocked["theta_ov"]


@pytest.mark.slow
@NINE
def test_every_locus_has_one_cusp_and_one_exchange_beside_it(case, load_factor, degrees):
    found = case(load_factor, degrees)
    assert [p.kind for p in found.locus.special_points] == ["UZ", "BP", "CP"]
    assert found.cusp.converged and found.cusp.tolerance < 1e-8
    assert 0 < found.exchange["F_ul"] - found.cusp["F_ul"] < 0.1


@NINE
def test_every_locus_is_smooth_through_its_cusp(case, load_factor, degrees):
    assert _loci.turning(case(load_factor, degrees).locus) < 15.0


@NINE
def test_a_locus_takes_few_points(case, load_factor, degrees):
    reached = []
    fold = case(load_factor, degrees).fold
    mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0), progress=lambda count, special: reached.append(count))
    assert max(reached) < 120


@NINE
def test_the_folds_of_a_locus_lie_above_overcentre_on_one_side_of_the_cusp_and_below_on_the_other(
    case, load_factor, degrees
):
    found = case(load_factor, degrees)
    force, angle = found.locus["F_ul"], found.locus["theta_ov"]
    assert np.all(angle[force > found.exchange["F_ul"]] > 0)
    assert np.all(angle[force < found.cusp["F_ul"]] < 0)


@pytest.mark.slow
@pytest.mark.parametrize("load_factor", LOADS)
def test_retraction_force_at_fp1_falls_as_gravity_angle_rises(case, load_factor):
    loci = [case(load_factor, a) for a in ANGLES]
    assert np.all(np.diff([c.fold["F_ret"] for c in loci]) < 0)
    assert np.all(np.diff([c.unlocked["F_ret"] for c in loci]) < 0)


@pytest.mark.slow
@pytest.mark.parametrize("load_factor", LOADS)
def test_the_steepest_descent_limits_both_forces(cusps, load_factor):
    assert np.all(np.diff(cusps("F_ret", load_factor)) < 0)
    assert np.all(np.diff(cusps("F_ul", load_factor)) > 0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "load_factor", "share"),
    [("F_ret", 1.0, 0.344), ("F_ul", 1.0, 0.084), ("F_ret", 0.5, 0.345), ("F_ul", 0.5, 0.042), ("F_ul", 2.5, 0.208)],
)
def test_spread_of_the_cusps(cusps, name, load_factor, share):
    assert _loci.spread(cusps(name, load_factor)) == pytest.approx(share, abs=5e-4)


@pytest.mark.slow
def test_high_load_needs_less_unlock_force_but_in_steep_descent(cusps):
    ratio = cusps("F_ul", 2.5) / cusps("F_ul", 0.5)
    assert ratio[0] == pytest.approx(1.0, abs=0.01)
    assert np.all(ratio[1:] < 0.95)


@pytest.mark.slow
def test_retraction_force_grows_more_than_fivefold_with_load(case):
    assert case(2.5, 0.0).fold["F_ret"] / case(0.5, 0.0).fold["F_ret"] == pytest.approx(5.118, abs=5e-4)


def test_angles_are_wrapped_for_drawing():
    assert _gear.wrapped(np.radians([-180.0, 180.0, 190.0, -350.0])) == pytest.approx([180.0, 180.0, -170.0, 10.0])


def test_spread_is_relative_to_the_largest_magnitude():
    assert _loci.spread([-4.0, -5.0, -4.5]) == pytest.approx(0.2)


@pytest.mark.long
@pytest.mark.parametrize(
    ("load_factor", "force", "unlock"), [(0.5, 0.356, 0.050), (1.0, 0.355, 0.097), (2.5, None, 0.207)]
)
def test_spread_of_the_cusps_of_the_gear_that_locks(load_factor, force, unlock):
    loci = _loci.cases(mc.Mechanism.from_xml("nose_gear_locking"), load_factor)
    assert _loci.spread([c.cusp["F_ul"] for c in loci]) == pytest.approx(unlock, abs=5e-4)
    assert force is None or _loci.spread([c.cusp["F_ret"] for c in loci]) == pytest.approx(force, abs=5e-4)


@pytest.mark.long
def test_the_locus_of_the_gear_that_locks_leads_over_a_second_cusp_to_fp2():
    found = _loci.Case.of(mc.Mechanism.from_xml("nose_gear_locking"), 1.0, 0.0)
    assert found.second_cusp["F_ul"] < -500.0
    assert found.unlocked["F_ret"] == pytest.approx(414608.168, rel=1e-7)
    other = 0 if found.locus.start_index else -1
    assert found.locus["F_ul"][other] == pytest.approx(0.0, abs=1e-9)
    assert found.locus["F_ret"][other] == pytest.approx(450322.109, rel=1e-7)


def findings_hold(figure, out, monkeypatch):
    script = load_script(scripts_folder() / f"fig{figure}.py")
    figures = watched(monkeypatch, script)
    findings = script.main(out)
    assert (out / f"fig{figure}.png").stat().st_size > 10_000
    assert [meeting(f) for f in figures] == [[]]
    assert [f.claim for f in findings if not f.holds] == []
    return len(findings)


@pytest.mark.long
def test_findings_of_figure_14(tmp_path, monkeypatch):
    assert findings_hold("14", tmp_path, monkeypatch) == 7


@pytest.mark.long
@pytest.mark.parametrize(
    ("figure", "count"), [("06", 1), ("09", 4), ("10", 10), ("11", 8), ("12", 10), ("13", 7), ("15", 12)]
)
def test_findings_of_the_other_figures(figure, count, tmp_path, monkeypatch):
    assert findings_hold(figure, tmp_path, monkeypatch) == count
