"""The dynamic check of stability: motions beside equilibria grow and decay as their eigenvalues say."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mjcont as mc
from mjcont.results.spectra import Spectra

# model: parameter, bounds, start values, keyframe
CURVES = {
    "overcentre": ("F", (-50, 60), {"F": 50.0}, None),
    "overcentre_paper": ("F", (-50, 60), {"F": 50.0}, None),
    "overcentre_tree": ("F", (-50, 60), {"F": 50.0}, None),
    "nose_gear": ("F_ret", (3e5, 8e5), {"F_ret": 4e5}, "uplock_above"),
    "nose_gear_full": ("F_ret", (0, 60), {"F_ret": 20.0}, "uplock_above"),
    "four_bar": ("M", (-50, 50), {}, None),
    "rssr": ("M", (-50, 50), {}, None),
    "slider_crank": ("M", (-100, 100), {}, None),
    "watt_six_bar": ("M", (-100, 100), {}, None),
    "buckling_column": ("P", (0, 20), {}, "straight"),
    "tethered_body": ("B", (120, 300), {"B": 250.0}, "upright"),
    "toggle_clamp": ("M", (-40, 40), {}, "closed"),
    "von_mises_truss": ("P", (-2000, 2000), {}, "unloaded"),
}


def curve(name):
    parameter, bounds, start, keyframe = CURVES[name]
    mechanism = mc.Mechanism.from_xml(name)
    return mc.continue_equilibria(mechanism, parameter, bounds, start, keyframe=keyframe)


def assert_confirmed(branch, resolution):
    """Every point with a rate above the stated figure is confirmed within 5 %, and the others say why not."""
    for check in branch.certificate:
        assert check.verdict != "contradicted", check
        if check.verdict == "confirmed":
            assert abs(check.rate - check.eigenvalue.real) < 0.05 * abs(check.eigenvalue.real)
            assert (check.rate > 0) == (branch.stability[check.index] == "unstable")
            assert abs(check.eigenvalue.real) * check.time >= resolution
        else:
            assert math.isnan(check.rate)
            assert "marginal" in check.sentence or "corner" in check.sentence or "limit" in check.sentence


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four_bar", "tethered_body", "toggle_clamp", "von_mises_truss"])
def test_stable_points_decay_and_unstable_ones_grow_at_their_eigenvalues_rate(name):
    branch = mc.verify_stability(curve(name), 8)
    assert branch.certificate.holds
    assert {c.stability for c in branch.certificate.of("confirmed")} == {"stable", "unstable"}
    assert_confirmed(branch, 1e-3)


@pytest.mark.long
def test_no_point_of_any_model_is_contradicted():
    confirmed = 0
    for name in CURVES:
        branch = mc.verify_stability(curve(name), 24)
        assert_confirmed(branch, 1e-3)
        confirmed += len(branch.certificate.of("confirmed"))
    assert confirmed >= 200


def test_a_falling_pendulums_rate_is_the_root_of_its_equation(pendulum_xml):
    # I x'' + c x' = m g l x, with I = 1.01, c = 0.5, m g l = 9.81
    mechanism = mc.Mechanism.from_xml(pendulum_xml(joint='damping="0.5"', actuator='<motor name="M" joint="hip"/>'))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-1, 1))
    (check,) = mc.verify_stability(branch, rows=[branch.start_index]).certificate
    expected = (-0.5 + math.sqrt(0.25 + 4 * 1.01 * 9.81)) / (2 * 1.01)
    assert check.rate == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("damping", ["0.5 0.7", "0.5 0 0.7"])
def test_damping_at_rest_is_the_linear_term_of_a_nonlinear_damper(pendulum_xml, damping):
    actuator = '<motor name="M" joint="hip"/>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(joint=f'damping="{damping}"', actuator=actuator))
    assert mechanism.pencil(mechanism.qpos0, mechanism.values(), np.zeros((1, 1))).damping[0, 0] == pytest.approx(
        0.5, rel=1e-6
    )


def test_drag_in_a_fluid_is_linearised_at_rest(pendulum_xml):
    text = pendulum_xml(option='density="1000" viscosity="0.1"', actuator='<motor name="M" joint="hip"/>')
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(text), "M", bounds=(-1, 1))
    assert mc.verify_stability(branch, 3).certificate.holds


def test_damping_of_a_stop_is_that_of_the_stop_however_lightly_it_is_loaded():
    # the stop of the toggle clamp is a linear spring and damper while it bears: its dampers do not depend on the load
    branch = curve("toggle_clamp")
    on_stop = [branch.row(i) for i in range(len(branch)) if branch["theta"][i] > np.radians(3) + 1e-8]
    damping = [p.problem.pencil(p.state, p.parameters, np.zeros((1, 1))).damping[0, 0] for p in on_stop]
    np.testing.assert_allclose(damping, damping[0], rtol=1e-2)


def test_a_wrong_classification_is_contradicted():
    branch = curve("von_mises_truss")
    unstable = int(np.flatnonzero(branch.stability == "unstable")[2])
    lie = branch.stability.copy()
    lie[unstable] = "stable"
    wrong = mc.verify_stability(branch_with(branch, stability=lie), rows=[unstable])
    assert not wrong.certificate.holds
    assert wrong.certificate.checks[0].verdict == "contradicted"
    assert "motions grow at" in wrong.certificate.checks[0].sentence


@pytest.mark.slow
def test_a_wrong_eigenvalue_is_contradicted():
    branch = curve("von_mises_truss")
    wrong = mc.verify_stability(branch_with(branch, spectra=Spectra.of(1.1 * branch.eigenvalues)), 4)
    assert len(wrong.certificate.of("contradicted")) == 4


def branch_with(branch, **changes):
    from dataclasses import replace

    return replace(branch, **changes)


@pytest.mark.long
def test_points_too_slow_for_the_steps_allowed_are_unresolved_and_say_so():
    branch = curve("nose_gear_full")
    slow = [int(i) for i in np.flatnonzero(np.abs(branch.eigenvalues.real.max(axis=1)) < 1e-5)[:3]]
    certificate = mc.verify_stability(branch, rows=slow, max_steps=1000).certificate
    assert [c.verdict for c in certificate] == ["unresolved"] * 3
    assert all("marginal" in c.sentence for c in certificate)
    assert not certificate.holds


@pytest.mark.slow
def test_the_certificate_goes_with_the_branch_into_its_file_and_summary(tmp_path):
    branch = mc.verify_stability(curve("tethered_body"), 5)
    loaded = mc.load(branch.save(tmp_path / "branch.h5"))
    assert loaded.certificate.headline == branch.certificate.headline
    assert str(loaded.certificate) == str(branch.certificate)
    assert loaded.certificate.headline in str(loaded)
    assert mc.extend(loaded, (100, 320)).certificate is None


def test_rests_of_a_vector_field_are_checked_loci_and_wrong_rows_are_refused():
    ode = mc.VectorField(lambda u, p: [p["a"] - u[0] ** 2], [1.0], {"a": 1.0})
    assert mc.verify_stability(mc.continue_equilibria(ode, "a", bounds=(0.5, 2)), 2).certificate.holds
    branch = curve("von_mises_truss")
    with pytest.raises(mc.MjcontError, match="equilibria"):
        mc.verify_stability(mc.continue_special(branch.point("LP1"), "H", bounds=(-5, 5)))
    with pytest.raises(mc.ParameterError, match="row 1000 is not on the branch"):
        mc.verify_stability(branch, rows=[1000])
    with pytest.raises(mc.ParameterError, match="must be positive"):
        mc.verify_stability(branch, 0)
