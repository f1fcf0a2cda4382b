"""The nose gear that stays locked: its folds and cusps, its assembly, and how stiff its bushes must be.

Values: computed apart from MuJoCo from energies of planar links on linear bushes written out by hand, with analytic
stiffness; folds and cusps solved as extended systems to residuals below 1e-12 (k_j = 1e8 N/m).
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from problems.gears import LOCKING

import mjcont as mc

LOADS = [(1.0, -20.0), (1.0, 0.0), (0.5, 0.0), (2.5, 0.0)]  # load factor, gravity angle in deg
EACH = pytest.mark.parametrize("load", [LOADS[0], *(pytest.param(load, marks=pytest.mark.long) for load in LOADS[1:])])
# by load: F_ret in N, theta_ov and theta_1 in deg of FP1, FP2 and FP3 without unlock force
FOLDS = {
    (1.0, -20.0): ((587560.448, 14.62676, -61.34410), (523846.013, -16.66378, -61.10600),
                   (566425.437, -41.54750, -56.50391)),
    (1.0, 0.0): ((514184.959, 14.38229, -61.37116), (450322.109, -16.70573, -61.10082),
                 (488375.711, -39.94156, -56.98281)),
    (0.5, 0.0): ((255595.662, 16.62202, -61.11355), (191848.469, -16.29484, -61.14897),
                 (245482.953, -43.16876, -55.96328)),
    (2.5, 0.0): ((1290792.132, 12.04978, -61.62218), (1225172.159, -18.48664, -60.88521),
                 (1234278.921, -32.24739, -58.76963)),
}
# F_ul, F_ret in N and theta_ov in deg of the cusp of FP1's locus
CUSPS = {
    (1.0, -20.0): (-186.6706, 589719.086, 9.50767),
    (1.0, 0.0): (-176.6099, 516281.514, 9.32043),
    (0.5, 0.0): (-188.1407, 257422.112, 10.47111),
    (2.5, 0.0): (-166.8150, 1293338.312, 8.07435),
}


def degrees(point, name):
    return float(np.degrees(point[name]))


@pytest.fixture(scope="module")
def gear():
    return mc.Mechanism.from_xml("nose_gear_locking")


@pytest.fixture(scope="module")
def folds(gear):
    """Return a function: the folds in the paper's window around uplock, by falling theta_ov (computed once each)."""

    @cache
    def found(load_factor, angle, f_ul=0.0):
        load = {"load_factor": load_factor, "gravity_angle": np.radians(angle), "F_ul": f_ul}
        starts = [(k, f * load_factor) for f in (2.5e5, 6e5) for k in ("uplock_above", "uplock_below")]
        points = [mc.find_equilibrium(gear, {**load, "F_ret": f}, keyframe=k) for k, f in starts]
        diagram = mc.bifurcation_diagram(gear, "F_ret", (0.0, 8e5 * load_factor), points)
        folds = [p for b in diagram for p in b.of_kind("LP")]
        near = [p for p in folds if p["F_ret"] > 2e5 * load_factor and degrees(p, "theta_1") < -45.0]
        return sorted(near, key=lambda p: -p["theta_ov"])

    return found


def assert_fold(fold, force, theta_ov, theta_1=None):
    assert fold["F_ret"] == pytest.approx(force, rel=1e-7)
    assert degrees(fold, "theta_ov") == pytest.approx(theta_ov, abs=1e-4)
    assert theta_1 is None or degrees(fold, "theta_1") == pytest.approx(theta_1, abs=1e-4)


@pytest.mark.slow
@EACH
def test_the_three_folds_around_uplock_equal_the_reference(folds, load):
    found = folds(*load)
    assert len(found) == 3
    for fold, expected in zip(found, FOLDS[load], strict=True):
        assert_fold(fold, *expected)


@pytest.mark.slow
def test_with_500_newton_fp1_and_the_minimum_beside_it_equal_the_reference(folds):
    fp1, fp2, _ = folds(1.0, 0.0, -500.0)
    assert_fold(fp1, 414608.168, -7.55755)
    assert_fold(fp2, 413839.374, -11.20767)


@pytest.mark.slow
@EACH
def test_the_cusp_of_the_first_folds_locus_equals_the_reference(folds, load):
    locus = mc.continue_special(folds(*load)[0], "F_ul", bounds=(-1000.0, 0.0))
    cusp = next(p for p in locus.of_kind("CP") if p["theta_ov"] > 0.0)
    f_ul, f_ret, theta_ov = CUSPS[load]
    assert cusp["F_ul"] == pytest.approx(f_ul, rel=1e-5)
    assert cusp["F_ret"] == pytest.approx(f_ret, rel=1e-7)
    assert degrees(cusp, "theta_ov") == pytest.approx(theta_ov, rel=1e-5)


def test_the_published_poses_have_their_pins_where_the_table_says(gear):
    table = {
        "uplock_above": ((-0.8254, 0.3051), (-1.1863, -0.2477)),
        "uplock_below": ((-0.8254, 0.3051), (-0.9557, -0.3421)),
        "downlock_above": ((-0.7242, -0.5000), (-0.4793, -1.1131)),
        "downlock_below": ((-0.7242, -0.5000), (-0.2695, -0.9787)),
    }
    for name, (b, e) in table.items():
        m = LOCKING.links(gear.keyframes[name])
        assert m.b == pytest.approx(b, abs=1e-4)
        assert m.e == pytest.approx(e, abs=1e-4)


@pytest.mark.slow
def test_the_gear_is_locked_between_fp2_and_infinity(gear, folds):
    """Stable below overcentre from FP2 up, unstable between FP2 and FP3, stable again where the gear extends."""
    _, fp2, fp3 = folds(1.0, 0.0)
    branch = mc.continue_equilibria(gear, "F_ret", (2e5, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")
    theta_ov = branch["theta_ov"]
    margin = np.radians(0.05)
    locked = (theta_ov > fp2["theta_ov"] + margin) & (theta_ov < 0.0)
    between = (theta_ov < fp2["theta_ov"] - margin) & (theta_ov > fp3["theta_ov"] + margin)
    assert np.all(branch.n_unstable[locked] == 0) and locked.sum() > 20
    assert np.all(branch.n_unstable[between] == 1) and between.sum() > 20
    assert np.all(branch.n_unstable[theta_ov < fp3["theta_ov"] - margin] == 0)
    assert branch["F_ret"][locked].min() >= fp2["F_ret"] * (1 - 1e-9)
