"""Figures 2, 4, 7 and 8: what damping and joint stiffness do to the mechanisms, and the figures' findings.

Source: Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section III. Reference
values of folds and cusps, computed apart from MuJoCo: energies of planar links on linear bushes, their stiffness by
analytic derivatives, folds and cusps solved as extended systems to residuals below 1e-12. Reference of motions: the
overcentre mechanism's equations of motion, written out by hand, integrated by SciPy.
"""

from __future__ import annotations

import sys
from functools import cache

import numpy as np
import pytest
from problems import reference
from problems.marks import long
from problems.pictures import meeting, watched
from problems.reference import PAPER, PAPER_FOLDS
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))

# k_j in N/m: F_ret in N and theta_ov in deg of the folds FP1, FP2 and FP3 of the gear with every pin a bush
GEAR_FOLDS = {
    1e7: ((31.911491, 49.76012), (12.627488, -28.54791), (20.817740, -62.91391)),
    1e6: ((31.908243, 49.74206), (12.650573, -28.49868), (20.819855, -62.87242)),
    1e5: ((31.876335, 49.56242), (12.877441, -28.00054), (20.840860, -62.45803)),
}


def degrees_of(point, name):
    return float(np.degrees(point[name]))


@cache
def script(figure):
    return load_script(scripts_folder() / f"fig{figure:02d}.py")


@pytest.mark.parametrize(
    ("figure", "holding"),
    [
        long(2, [True] * 5),
        long(4, [True] * 5),
        long(7, [True] * 4),
        long(8, [True] * 5),
    ],
)
def test_findings_of_the_mechanism_figures(figure, holding, tmp_path, monkeypatch):
    figures = watched(monkeypatch, script(figure))
    findings = script(figure).main(tmp_path)
    assert [f.holds for f in findings] == holding
    assert (tmp_path / f"fig{figure:02d}.png").stat().st_size > 10_000
    assert [meeting(f) for f in figures] == [[]]


@pytest.mark.slow
def test_no_texts_meet_in_figure_3(tmp_path, monkeypatch):
    figures = watched(monkeypatch, script(3))
    script(3).main(tmp_path)
    assert [meeting(f) for f in figures] == [[]]


@pytest.mark.parametrize("figure", [2, 3, 4, 5])
def test_the_captions_of_the_overcentre_figures_name_the_model_that_they_show(figure):
    assert f"Model {script(figure).overcentre().name}," in " ".join(script(figure).__doc__.split())


# -- the overcentre mechanism of figures 2 to 5 ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def heavy():
    """The equilibria of the heavily damped mechanism."""
    return script(2).equilibria(script(2).overcentre(), c_sp=10.0)


def test_two_curves_are_as_far_apart_as_the_farthest_point_of_either():
    short, long = (np.array([[0.0, 0.3], [force, 0.3]]) for force in (10.0, 30.0))
    assert script(4).farthest(short, long) == pytest.approx((0.2, 30.0, 0.3))
    assert script(4).farthest(long, short) == pytest.approx((0.2, 30.0, 0.3))


def test_what_lies_beyond_the_range_of_the_force_is_not_compared():
    short, long = (np.array([[0.0, 0.3], [40.0, 0.3], [force, 0.3]]) for force in (45.0, 60.0))
    assert script(4).farthest(short, long)[0] == pytest.approx(0.0, abs=1e-12)


def test_the_closed_form_of_the_figures_is_equation_5():
    rigid, theta_1 = script(5).Rigid.of(script(5).overcentre()), np.linspace(-1.2, 1.2, 25)
    assert rigid.force(theta_1) == pytest.approx(reference.rigid_force(theta_1, PAPER), rel=1e-12)
    for label, fold in zip(("LP2", "LP1"), reference.rigid_folds(PAPER), strict=True):
        assert tuple(rigid.fold(label).values()) == pytest.approx(fold, rel=1e-12)


def reference_passages(c_sp, duration):
    """The forces at which theta_1 passes zero under figure 2's load, from rest at 50 N, by a Runge-Kutta method."""
    p = PAPER | {"c_sp": c_sp}
    near = reference.equilibrium_at(0.0, p)[:2]
    for theta_1 in np.radians(np.arange(1.0, 62.0)):
        near = reference.equilibrium_at(theta_1, p, near)[:2]
    theta_1 = brentq(lambda at: reference.equilibrium_at(at, p, near)[1] - 50.0, *np.radians([61.0, 64.0]), xtol=1e-13)
    mass, damping = np.diag(reference.mass(p)), reference.damping(near[0], p)

    def load(t):
        return 50.0 * np.cos(np.radians(t))

    def motion(t, y):
        return np.concatenate([y[6:], (reference.forces(y[:6], p | {"F": load(t)}) - damping @ y[6:]) / mass])

    rest = np.concatenate([reference.equilibrium_at(theta_1, p, near)[0], np.zeros(6)])
    found = solve_ivp(motion, (0.0, duration), rest, "DOP853", rtol=1e-6, atol=1e-9, events=lambda t, y: y[2])
    return load(found.t_events[0])


@pytest.mark.long
def test_the_swept_load_takes_the_heavily_damped_mechanism_overcentre_where_it_does_by_hand(heavy):
    found = script(2).passages(script(2).cycle(heavy))[:, 1]
    assert found == pytest.approx(reference_passages(10.0, 360.0), abs=3e-3)


@pytest.mark.long
def test_the_swept_load_takes_the_lightly_damped_mechanism_overcentre_where_it_does_by_hand():
    light = script(2).equilibria(script(2).overcentre(), c_sp=0.01)
    motion = mc.simulate(light.problem, {"F": script(2).load}, 75.0, light.row(len(light) - 1), samples=7500)
    assert script(2).passages(motion)[:, 1] == pytest.approx(reference_passages(0.01, 75.0), abs=3e-3)


@pytest.mark.slow
def test_a_slower_load_gets_ahead_of_the_mechanism_by_less_with_the_power_two_thirds_of_its_rate(heavy):
    fast, slow = (script(2).overshoot(heavy, "LP2", rate) for rate in (0.84, 0.084))
    assert 0.62 < np.log10(fast / slow) < 0.70


@pytest.mark.slow
@pytest.mark.parametrize(("label", "which"), [("LP2", 0), ("LP1", 1)])
def test_folds_followed_to_soft_joints_equal_the_reference(heavy, label, which):
    locus = mc.continue_special(heavy.point(label), "k_j", (8.0, 1000.0))
    softest = locus.row(int(np.argmin(locus["k_j"])))
    force, theta_1 = PAPER_FOLDS[8.0][which]
    assert softest["k_j"] == pytest.approx(8.0, rel=1e-12)
    assert softest["F"] == pytest.approx(force, rel=1e-9)
    assert degrees_of(softest, "theta_1") == pytest.approx(theta_1, abs=1e-6)


# -- the nose gear with every pin a bush -----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def stiff_folds():
    """FP1, FP2 and FP3 at the model's own stiffness."""
    return script(8).stiff_folds(mc.Mechanism.from_xml("nose_gear_full"))


@pytest.fixture(scope="module")
def softened(stiff_folds):
    """The slice at 1e4 N/m with the curves of the three folds."""
    return script(8).Slice.of(script(8).softened(stiff_folds), 1e4)


def assert_folds(folds, expected):
    assert len(folds) == len(expected)
    for fold, (force, theta_ov) in zip(folds, expected, strict=True):
        assert fold["F_ret"] == pytest.approx(force, rel=1e-6, abs=6e-7)
        assert degrees_of(fold, "theta_ov") == pytest.approx(theta_ov, rel=1e-6, abs=6e-6)


@pytest.mark.long
def test_folds_of_the_gear_equal_the_reference_at_its_own_stiffness(stiff_folds):
    assert_folds(stiff_folds, GEAR_FOLDS[1e6])


@pytest.mark.long
@pytest.mark.parametrize("k_j", [1e7, 1e5])
def test_folds_of_the_gear_followed_to_another_stiffness_equal_the_reference(stiff_folds, k_j):
    span = (min(k_j, 1e6) / 1.1, max(k_j, 1e6) * 1.1)
    loci = [mc.continue_special(p, "k_j", span, zeros={"k_j": k_j}) for p in stiff_folds]
    assert_folds([p for locus in loci for p in locus.of_kind("UZ")], GEAR_FOLDS[k_j])


@pytest.mark.long
def test_the_curves_of_the_folds_turn_where_the_reference_does(softened):
    turns = [[(p.kind, p["k_j"], degrees_of(p, "theta_ov")) for p in c.turns] for c in softened.curves]
    joint = ("BP", 10688.0, -2.7)
    expected = [[("CP", 798.3, 26.8), joint], [("CP", 7855.0, -15.4), joint], [("BP", 1030.2, -28.5)]]
    assert [[kind for kind, _, _ in c] for c in turns] == [[kind for kind, _, _ in c] for c in expected]
    for found, known in zip(turns, expected, strict=True):
        assert [k for _, k, _ in found] == pytest.approx([k for _, k, _ in known], rel=5e-3)
        assert [t for _, _, t in found] == pytest.approx([t for _, _, t in known], abs=0.2)


@pytest.mark.long
def test_the_curve_of_the_third_fold_goes_on_to_the_fourth(softened):
    locus = softened.curves[2].locus
    ends = [locus.row(i) for i in (0, len(locus) - 1)]
    fourth = min(ends, key=lambda p: p["theta_ov"])
    assert fourth["k_j"] == pytest.approx(1e8, rel=1e-9)
    assert (fourth["F_ret"], degrees_of(fourth, "theta_ov")) == pytest.approx((16.232, -65.356), abs=6e-4)


@pytest.mark.long
def test_soft_joints_have_six_folds_near_uplock(softened):
    assert len(softened.folds) == 6
    assert_folds([p for p in softened.folds if abs(degrees_of(p, "theta_ov")) < 1.0], [(19.314384, 0.28933)])


@pytest.mark.long
def test_one_of_the_six_lies_on_none_of_the_curves(softened):
    (foreign,) = softened.foreign
    assert foreign["F_ret"] < 0.0 < softened.named[0]["F_ret"]
