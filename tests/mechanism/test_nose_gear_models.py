"""The nose gears in MJCF against planar links on linear springs, written out by hand in gears.py."""

from __future__ import annotations

from itertools import product

import mujoco
import numpy as np
import pytest
from problems.gears import BY_HAND, COORDINATES, PINS, POSES, all_coordinates, angle_of, gradient, turned

import mjcont as mc
from mjcont.models import loading

GEARS = tuple(BY_HAND)


def random_values(gear, rng):
    """Values for every parameter, each over a wide range."""
    p = {name: parameter.value * rng.uniform(0.5, 2.0) for name, parameter in gear.parameters.items()}
    top = gear.parameters["F_ret"].bounds[1]
    p |= {"F_ret": rng.uniform(0, top), "F_ul": rng.uniform(-500, 500), "k_j": 10 ** rng.uniform(3, 10)}
    return p | {"gravity_angle": rng.uniform(-1, 1), "load_factor": rng.uniform(0, 3)}


def random_state(gear, rng):
    """An assembled pose, pulled apart by centimetres and turned by up to half a radian."""
    q = gear.keyframes[rng.choice(POSES)].copy()
    rows = q.reshape(5, -1)
    rows[:, -1] += rng.uniform(-0.5, 0.5, 5)
    if rows.shape[1] == 3:
        rows[:, :2] += rng.uniform(-0.05, 0.05, (5, 2))
    return q


def random_cases(gear, count):
    rng = np.random.default_rng(20240607)
    return [(random_state(gear, rng), random_values(gear, rng), rng) for _ in range(count)]


def assert_equal_to(found, expected, relative):
    assert np.max(np.abs(found - expected)) <= relative * np.max(np.abs(expected))


@pytest.fixture(scope="module", params=GEARS)
def gear(request):
    return mc.Mechanism.from_xml(request.param)


@pytest.fixture(scope="module")
def small():
    return mc.Mechanism.from_xml("nose_gear")


@pytest.fixture
def by_hand(gear):
    """Return the gear as links written out by hand."""
    return BY_HAND[gear.name]


@pytest.fixture(scope="module")
def full():
    return mc.Mechanism.from_xml("nose_gear_full")


# -- forces ----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_forces_at_rest_are_those_of_the_independent_model(gear, by_hand):
    for q, p, _ in random_cases(gear, 50):
        assert_equal_to(gear.residual(q, p), by_hand.forces_at_rest(q, p), 1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("k_j", [1e6, 1e7, 1e8])
def test_forces_in_assembled_poses_are_those_of_the_independent_model(gear, by_hand, k_j):
    """With closed pins weights, spring and actuators are not drowned by the bushes."""
    for pose, n, degrees in product(POSES, (-1.0, 0.5, 1.0, 2.5), (-20.0, 0.0, 20.0)):
        load = {"load_factor": n, "gravity_angle": np.deg2rad(degrees), "F_ret": 1.0, "F_ul": -500.0, "k_j": k_j}
        q, p = gear.keyframes[pose], gear.values(load)
        assert_equal_to(gear.residual(q, p), by_hand.forces_at_rest(q, p), 1e-9)


@pytest.mark.slow
def test_accelerations_in_motion_are_those_of_the_independent_model(gear, by_hand):
    for q, p, rng in random_cases(gear, 20):
        v = rng.uniform(-1, 1, gear.n)
        found = by_hand.inertial_forces(q, v, gear.acceleration(q, v, p), p)
        expected = by_hand.forces_at_rest(q, p) + by_hand.damping_forces(q, v, p)
        assert_equal_to(found, expected, 1e-11)


def test_a_growing_retraction_force_turns_the_strut_clockwise(gear):
    q = gear.keyframes["downlock_above"]
    strut = [name for name, _ in gear.state_labels].index("theta_1")
    weak, strong = (gear.residual(q, gear.values({"F_ret": f}))[strut] for f in (1.0, 2.0))
    assert strong < weak


def test_a_positive_unlock_force_pushes_links_1_and_5_apart(gear, by_hand):
    q = gear.keyframes["uplock_above"]
    force = gear.residual(q, gear.values({"F_ul": 1.0})) - gear.residual(q, gear.values())
    assert force @ gradient(lambda at: by_hand.links(at).spring_length, q) > 0


# -- parameters and observables --------------------------------------------------------------------------------------


def test_degrees_of_freedom_are_5_with_two_bushes_and_15_with_seven(small, full):
    assert (small.n, full.n) == (5, 15)
    assert small.bushes == full.bushes == ["bush_C_x", "bush_C_z", "bush_H_x", "bush_H_z"]
    assert [name for name, unit in full.state_labels if unit == "m"] == [f"{a}_{p}" for p in PINS for a in "xz"]


def test_parameters_have_their_units_and_the_published_sets_values(small, full):
    common = {
        "F_ret": ("N", 0.0),
        "F_ul": ("N", 0.0),
        "k_j": ("N/m", 1e6),
        "gravity_angle": ("rad", 0.0),
        "load_factor": ("1", 1.0),
    }
    heavy = {"k_sp": ("N/m", 2000.0), "l_us": ("m", 0.892), "c_sp": ("N*s/m", 200.0), "c_j": ("N*s/m", 2000.0)}
    heavy |= {"c_D": ("N*m*s/rad", 2500.0), "r_ret": ("m", 0.055)}
    heavy |= {f"m_{i}": ("kg", m) for i, m in enumerate((1200.0, 60.0, 70.0, 2.5, 2.5, 600.0), 1)}
    light = {"k_sp": ("N/m", 1000.0), "l_us": ("m", 0.682), "c_sp": ("N*s/m", 1.0), "c_j": ("N*s/m", 1.0)}
    light |= {f"m_{i}": ("kg", m) for i, m in enumerate((2.0, 0.2, 0.2, 0.05, 0.05, 1.0), 1)}
    for gear, own in ((small, heavy), (full, light)):
        assert {p.name: (p.unit, p.value) for p in gear.parameters.values()} == common | own


def test_observables_have_names_and_units(gear):
    units = {name: o.unit for name, o in gear.observables.items()}
    expected = dict.fromkeys(("R_C_x", "R_C_z", "R_H_x", "R_H_z"), "N") | {"spring_length": "m"}
    expected |= dict.fromkeys(COORDINATES, "rad")
    if gear.n == 15:
        expected |= {f"{axis}_{pin}": "m" for axis in "xz" for pin in PINS}
    assert units == expected


def measured(gear, q, p, *names):
    return gear.measure(q[None], p, names)[0]


def test_angles_and_spring_length_are_those_between_the_bodies(gear):
    model = mujoco.MjModel.from_xml_path(str(loading.models_folder() / f"{gear.name}.xml"))
    data = mujoco.MjData(model)

    def along(body):
        """The direction from a link's first pin to its centre of gravity, as an angle."""
        return angle_of((data.body(body).xipos - data.body(body).xpos)[[0, 2]])

    for q, p, _ in random_cases(gear, 20):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        theta_1, theta_ov, length = measured(gear, q, p, "theta_1", "theta_ov", "spring_length")
        from_vertical, between_locklinks = along("strut") + np.pi / 2, along("locklink_H") - along("locklink_B")
        assert np.exp(1j * theta_1) == pytest.approx(np.exp(1j * from_vertical), abs=1e-12)
        assert np.exp(1j * theta_ov) == pytest.approx(np.exp(1j * between_locklinks), abs=1e-12)
        centres = data.body("strut").xipos, data.body("locklink_H").xipos
        assert length == pytest.approx(np.linalg.norm(centres[0] - centres[1]), rel=1e-12)


def test_loop_bush_forces_pull_the_links_ends_back_in_axes_of_the_strut(gear, by_hand):
    for q, p, _ in random_cases(gear, 20):
        m = by_hand.links(q)
        expected = [-p["k_j"] * turned(-m.angles[0], *gap) for gap in (m.gap_c, m.gap_h)]
        found = measured(gear, q, p, "R_C_x", "R_C_z", "R_H_x", "R_H_z")
        assert_equal_to(found, np.concatenate(expected), 1e-11)


# -- poses -----------------------------------------------------------------------------------------------------------


def test_keyframes_are_the_four_assembled_poses(gear, by_hand):
    assert set(gear.keyframes) == set(POSES)
    for name, q in gear.keyframes.items():
        rows = all_coordinates(q)
        assert not rows[:, :2].any()
        np.testing.assert_allclose(rows[:, 2], by_hand.assembled(name), rtol=0, atol=1e-14)


def test_keyframes_close_every_pin(gear, by_hand):
    for q in gear.keyframes.values():
        m = by_hand.links(q)
        assert np.hypot(*m.gap_c) < 1e-12
        assert np.hypot(*m.gap_h) < 1e-12
        assert np.abs(measured(gear, q, gear.values({"k_j": 1.0}), "R_C_x", "R_C_z", "R_H_x", "R_H_z")).max() < 1e-12


def test_the_strut_stands_at_the_published_angle_in_every_pose(gear, by_hand):
    for name, q in gear.keyframes.items():
        degrees = np.rad2deg(measured(gear, q, gear.values(), "theta_1")[0])
        assert degrees == pytest.approx(by_hand.strut[name.split("_")[0]], abs=0.005)


def test_below_overcentre_pin_e_lies_on_the_trunnion_side_of_the_line_b_h(gear, by_hand):
    for name, q in gear.keyframes.items():
        m = by_hand.links(q)
        h = turned(m.angles[0], *by_hand.h)

        def side(point, b=m.b, h=h):
            return np.sign((h - b)[0] * (point - b)[1] - (h - b)[1] * (point - b)[0])

        assert (side(m.e) == side(np.zeros(2))) == name.endswith("below")


def test_the_initial_pose_is_downlock_above(gear):
    np.testing.assert_allclose(gear.qpos0, gear.keyframes["downlock_above"], rtol=0, atol=1e-15)


# -- folds -----------------------------------------------------------------------------------------------------------
# Reference values: computed apart from MuJoCo from energies of planar links on linear bushes written out by hand,
# with analytic stiffness; folds and cusps solved as extended systems to residuals below 1e-12.


def degrees(point, name):
    return np.rad2deg(point.observables[name])


def nearest(branch, kind, theta_ov):
    return min(branch.of_kind(kind), key=lambda point: abs(degrees(point, "theta_ov") - theta_ov))


@pytest.fixture(scope="module")
def retraction(small):
    """The branch of the retracting gear."""
    return mc.continue_equilibria(small, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")


def test_the_retracting_gear_meets_its_fold_at_the_reference_values(retraction):
    (fold,) = retraction.special_points
    assert fold.kind == "LP"
    assert fold.parameters["F_ret"] == pytest.approx(474766.687, rel=2e-9)
    assert degrees(fold, "theta_ov") == pytest.approx(16.715341, abs=1e-6)
    assert degrees(fold, "theta_1") == pytest.approx(-59.556420, abs=1e-6)


def test_with_the_unlock_force_the_fold_lies_below_overcentre_at_the_reference_values(small):
    start = {"F_ret": 4.5e5, "F_ul": -500.0}
    branch = mc.continue_equilibria(small, "F_ret", bounds=(3e5, 8e5), start=start, keyframe="uplock_below")
    (fold,) = branch.of_kind("LP")
    assert fold.parameters["F_ret"] == pytest.approx(479994.765, rel=2e-9)
    assert degrees(fold, "theta_ov") == pytest.approx(-9.87745, abs=1e-5)
    assert degrees(fold, "theta_1") == pytest.approx(-60.19432, abs=1e-5)


@pytest.mark.slow
def test_the_fold_locus_has_its_cusp_at_the_reference_values(retraction):
    locus = mc.continue_special(retraction.point("LP1"), "F_ul", bounds=(-1000, 0))
    (cusp,) = locus.of_kind("CP")
    assert cusp.parameters["F_ul"] == pytest.approx(-411.808, abs=6e-4)
    assert cusp.parameters["F_ret"] == pytest.approx(484766.55, abs=6e-3)
    assert degrees(cusp, "theta_ov") == pytest.approx(0.4136, abs=6e-5)


FULL_FOLDS = [
    # k_j, keyframe and F_ret of the start, F_ret and theta_ov at the fold
    pytest.param(1e7, "uplock_above", 20, 31.911491, 49.76012, marks=pytest.mark.long),
    (1e6, "uplock_above", 20, 31.908243, 49.74206),
    pytest.param(1e5, "uplock_above", 20, 31.876335, 49.56242, marks=pytest.mark.long),
    pytest.param(1e7, "uplock_below", 30, 12.627488, -28.54791, marks=pytest.mark.long),
    (1e6, "uplock_below", 30, 12.650573, -28.49868),
    pytest.param(1e5, "uplock_below", 30, 12.877441, -28.00054, marks=pytest.mark.long),
    pytest.param(1e7, "uplock_below", 30, 20.817740, -62.91391, marks=pytest.mark.long),
    (1e6, "uplock_below", 30, 20.819855, -62.87242),
    pytest.param(1e5, "uplock_below", 30, 20.840860, -62.45803, marks=pytest.mark.long),
    (1e4, "uplock_above", 20, 19.314384, 0.28933),
]


@pytest.mark.slow
@pytest.mark.parametrize(("k_j", "keyframe", "start", "force", "theta_ov"), FULL_FOLDS)
def test_folds_of_the_gear_with_every_pin_a_bush_equal_the_reference(full, k_j, keyframe, start, force, theta_ov):
    branch = mc.continue_equilibria(
        full, "F_ret", bounds=(0, 60), start={"F_ret": start, "k_j": k_j}, keyframe=keyframe
    )
    fold = nearest(branch, "LP", theta_ov)
    assert fold.parameters["F_ret"] == pytest.approx(force, abs=6e-7)
    assert degrees(fold, "theta_ov") == pytest.approx(theta_ov, abs=6e-6)
