"""Loads that change slowly: jumps at folds and corners, and where they land."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import mjcont as mc

# folds of the overcentre at k_j = 1000 N/m, computed from hand-written energies: F in N
UPPER_FOLD, LOWER_FOLD = 15.162603207, 24.077406008
# FP1 of the nose gear without and with an unlock force of -500 N, and the fold near downlock: F_ret in N
FP1, FP1_UNLOCKED = 474766.687, 479994.765


@pytest.fixture(scope="module")
def overcentre():
    return mc.Mechanism.from_xml("overcentre")


@pytest.fixture(scope="module")
def branch(overcentre):
    return mc.continue_equilibria(overcentre, "F", bounds=(-50.0, 50.0), start={"F": 50.0})


@pytest.fixture(scope="module")
def cycle(branch):
    return mc.load_path(branch, "F", [50.0, -50.0, 50.0])


@pytest.fixture(scope="module")
def gear():
    return mc.Mechanism.from_xml("nose_gear")


def test_the_overcentre_jumps_at_the_folds_of_the_reference(cycle):
    assert [j.before["F"] for j in cycle.jumps] == pytest.approx([UPPER_FOLD, LOWER_FOLD], rel=0, abs=1e-9)
    assert [(j.label, j.kind) for j in cycle.jumps] == [("LP1", "LP"), ("LP2", "LP")]
    assert cycle.done


def test_it_lands_at_rest_on_the_other_stable_piece_at_the_same_load(overcentre, branch, cycle):
    for jump in cycle.jumps:
        after = jump.after
        assert after["F"] == jump.before["F"]
        assert after.stability == "stable"
        assert np.abs(overcentre.residual(after.state, after.parameters)).max() < 1e-10
        assert jump.before["theta_1"] * after["theta_1"] < 0
        nearest = min(abs(p["theta_1"] - after["theta_1"]) for p in branch.at(F=after["F"]))
        assert nearest < 1e-9


@pytest.mark.slow
def test_motion_and_creep_land_at_the_same_rest(branch, cycle):
    creeping = mc.load_path(branch, "F", [50.0, -50.0, 50.0], landing="creep")
    for a, b in zip(cycle.jumps, creeping.jumps, strict=True):
        assert a.after["theta_1"] == pytest.approx(b.after["theta_1"], abs=1e-9)
        assert math.isnan(b.time)
    assert creeping.evaluations < 0.5 * cycle.evaluations


def test_the_path_costs_a_fifth_of_a_history_of_one_cycle_in_360_s(overcentre, cycle):
    steps = 360.0 / overcentre.simulation_model().opt.timestep
    assert cycle.evaluations < 0.2 * steps


@pytest.mark.long
def test_a_slow_history_is_where_the_jumps_have_landed(overcentre, branch, cycle):
    history = mc.simulate(overcentre, {"F": lambda t: 50.0 * math.cos(math.radians(t))}, 360.0,
                          branch.at(F=50.0)[0])
    falling = history["time"] < 180.0
    for rows, jump in ((falling, cycle.jumps[0]), (~falling, cycle.jumps[1])):
        # 25 s after the load has passed the fold, the load compared being that of the history there
        beyond = history["F"][rows] - jump.before["F"]
        passed = history["time"][rows][np.argmax(beyond < 0 if rows[0] else beyond > 0)]
        late = rows & (history["time"] > passed + 25.0) & (history["time"] < passed + 60.0)
        force = float(history["F"][late].mean())
        rest = [p["theta_1"] for p in branch.at(F=force) if p["theta_1"] * jump.after["theta_1"] > 0]
        assert len(rest) == 1
        assert history["theta_1"][late].mean() == pytest.approx(rest[0], abs=math.radians(2.0))


def test_the_columns_run_along_the_whole_path(cycle):
    force = cycle["F"]
    assert (force[0], force[-1]) == (50.0, 50.0)
    assert force.min() == -50.0
    for jump in cycle.jumps:
        assert force[jump.index] == force[jump.index + 1] == jump.before["F"]
    assert len(cycle["theta_1"]) == len(cycle.states) == len(cycle)


@pytest.mark.slow
def test_a_light_damper_gives_a_status_and_keeps_the_path_up_to_the_fold(overcentre):
    path = mc.load_path(overcentre, "F", [50.0, 0.0], {"c_sp": 0.01}, max_time=20.0)
    assert path.status == "no rest"
    assert "not at rest after" in path.message
    assert 'landing="creep" lands without inertia' in path.message
    assert path.jump("LP1").after is None
    assert path.final["F"] == pytest.approx(UPPER_FOLD, abs=1e-8)


# -- the nose gear ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_gear_passes_overcentre_at_fp1_and_stays_below_until_it_extends(gear):
    path = mc.load_path(gear, "F_ret", [4e5, 6e5, 3e4], keyframe="uplock_above")
    lock, extend = path.jumps
    assert lock.before["F_ret"] == pytest.approx(FP1, abs=1e-3)
    assert lock.before["theta_ov"] > 0 > lock.after["theta_ov"]
    assert extend.before["F_ret"] == pytest.approx(39.7e3, rel=1e-3)
    between = path["theta_ov"][lock.index + 1 : extend.index + 1]
    assert np.all(between < 0)


@pytest.mark.slow
def test_the_gear_unlocks_at_fp1_of_the_lower_branch_under_the_unlock_force(gear):
    path = mc.load_path(
        gear, [{"F_ret": 4e5, "F_ul": 0.0}, {"F_ul": -500.0}, {"F_ret": 6e5}], keyframe="uplock_below"
    )
    (unlock,) = path.jumps
    assert unlock.before["F_ret"] == pytest.approx(FP1_UNLOCKED, abs=1e-3)
    assert unlock.before["theta_ov"] < 0 < unlock.after["theta_ov"]
    assert {s.leg for s in path.segments} == {0, 1}


@pytest.mark.slow
def test_two_parameters_change_together_along_a_straight_leg(gear):
    path = mc.load_path(gear, [{"F_ret": 4e5, "F_ul": -450.0}, {"F_ret": 5e5, "F_ul": -550.0}],
                        keyframe="uplock_below")
    (unlock,) = path.jumps
    assert path["F_ul"][: unlock.index] == pytest.approx(-450.0 - 100.0 * (path["F_ret"][: unlock.index] - 4e5) / 1e5)
    # the point is a fold in F_ret alone, too
    here = mc.continue_equilibria(gear, "F_ret", start={"F_ret": 4e5, "F_ul": unlock.before["F_ul"]},
                                  keyframe="uplock_below")
    assert min(abs(p["F_ret"] - unlock.before["F_ret"]) for p in here.of_kind("LP")) < 1e-2


# -- closed forms -----------------------------------------------------------------------------------------------

K, L0, A = 1000.0, 1.25, 1.0


def truss_load(z):
    return 2.0 * K * z * (L0 / math.hypot(A, z) - 1.0)


def test_the_truss_snaps_at_its_closed_form_and_lands_where_it_bears_that_load():
    path = mc.load_path(mc.Mechanism.from_xml("von_mises_truss"), "P", [0.0, 300.0])
    (snap,) = path.jumps
    largest = 2.0 * K * L0 * (1.0 - (A / L0) ** (2.0 / 3.0)) ** 1.5
    below = brentq(lambda z: truss_load(z) - largest, -2.0, -0.75, xtol=1e-14)
    assert snap.before["P"] == pytest.approx(largest, rel=1e-9)
    assert snap.after["z"] == pytest.approx(below, abs=1e-8)
    before = brentq(lambda z: z**2 + A**2 - (A**2 * L0) ** (2.0 / 3.0), 0.1, 0.7)

    def energy(z):
        return K * (math.hypot(A, z) - L0) ** 2 + largest * z

    assert snap.energy == pytest.approx(energy(before) - energy(below), rel=1e-8)


@pytest.mark.slow
def test_the_toggle_clamp_opens_where_its_stop_unloads_and_closes_onto_it():
    path = mc.load_path(mc.Mechanism.from_xml("toggle_clamp"), "M", [20.0, -20.0, 20.0], keyframe="closed")
    opens, closes = path.jumps
    assert (opens.kind, closes.kind) == ("CO", "LP")
    strut = math.sqrt(0.1**2 + 0.3**2 - 0.06 * math.cos(math.radians(3.0)))
    moment = 2e5 * (strut - 0.202) * 0.03 * math.sin(math.radians(3.0)) / strut
    assert opens.before["M"] == pytest.approx(moment, rel=1e-6)
    assert opens.after["theta"] < math.radians(-5.0)
    assert closes.after["theta"] == pytest.approx(math.radians(3.0), abs=1e-3)
    assert closes.energy is None
    assert "stop" in closes.energy_note


@pytest.mark.slow
def test_a_vector_field_jumps_at_its_fold_to_the_other_root():
    field = mc.VectorField(lambda u, p: [p["a"] + u[0] - u[0] ** 3], [-1.3], {"a": -1.0})
    path = mc.load_path(field, "a", [-1.0, 1.0, -1.0])
    up, down = path.jumps
    assert up.before["a"] == pytest.approx(2.0 / math.sqrt(27.0), abs=1e-10)
    assert up.after["u[0]"] == pytest.approx(2.0 / math.sqrt(3.0), abs=1e-9)
    assert down.after["u[0]"] == pytest.approx(-2.0 / math.sqrt(3.0), abs=1e-9)
    assert up.energy is None
    assert up.energy_note == "a vector field has no potential energy"


def test_a_rest_lost_to_an_oscillation_ends_the_path_at_the_hopf_point():
    field = mc.VectorField(
        lambda u, p: [u[1], (p["m"] - u[0] ** 2) * u[1] - u[0]], [0.0, 0.0], {"m": -1.0}
    )
    path = mc.load_path(field, "m", [-1.0, 1.0], max_time=100.0)
    assert path.status == "no rest"
    assert path.jump("HB1").before["m"] == pytest.approx(0.0, abs=1e-10)
    assert "oscillation" in path.message
    assert "creep" not in path.message


def test_a_motion_that_runs_to_infinity_in_finite_time_ends_the_path_as_diverged():
    field = mc.VectorField(lambda u, p: [p["a"] + u[0] ** 2], [-1.0], {"a": -1.0})
    path = mc.load_path(field, "a", [-1.0, 1.0])
    assert path.status == "diverged"
    assert path.final["a"] == pytest.approx(0.0, abs=1e-10)


# -- files, pictures, messages ----------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_path_survives_its_file(cycle, tmp_path):
    loaded = mc.load(cycle.save(tmp_path / "path.h5"))
    assert str(loaded) == str(cycle)
    assert np.array_equal(loaded["theta_1"], cycle["theta_1"])
    assert loaded.jumps[0].after["theta_1"] == pytest.approx(cycle.jumps[0].after["theta_1"], abs=1e-12)


@pytest.mark.slow
def test_a_damaged_file_of_a_path_is_refused(cycle, tmp_path):
    import h5py

    file = cycle.save(tmp_path / "path.h5")
    with h5py.File(file, "a") as f:
        del f["segments/1/states"]
    with pytest.raises(mc.ResultFileError, match="incomplete or damaged"):
        mc.load(file)


def test_the_diagram_of_a_path_has_an_arrow_for_each_segment_and_jump(branch, cycle):
    ax = mc.plot(branch, cycle, x="F", y="theta_1")
    arrows = [t for t in ax.texts if getattr(t, "arrow_patch", None) is not None]
    assert len(arrows) == len(cycle.segments) + len(cycle.jumps)
    jump = cycle.jumps[0]
    ends = [(t.xyann[0], t.xy[0]) for t in arrows]
    assert (jump.before["F"], jump.after["F"]) in ends


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("F", [50.0]), "at least two different loads"),
        (("F", ["x", 50.0]), "must be a list of numbers"),
        (("F", None), "needs the values of F"),
        (("G", [0.0, 1.0]), "unknown parameter 'G'"),
        (("F", [50.0, math.nan]), "finite number"),
        (([{"F": 50.0}, 3.0],), "list of dicts"),
        (("F", [20.0, 50.0]), "2 stable points where the path begins"),
        (("F", [70.0, 50.0]), "no stable point at F = 70 N"),
    ],
)
def test_wrong_paths_are_named(branch, arguments, message):
    with pytest.raises(mc.MjcontError, match=message):
        mc.load_path(branch, *arguments)


def test_a_path_cannot_begin_at_an_unstable_point(overcentre, branch):
    unstable = next(p for p in branch.at(F=20.0) if p.n_unstable)
    with pytest.raises(mc.StartError, match="unstable equilibrium"):
        mc.load_path(overcentre, "F", [20.0, 30.0], unstable)


def test_an_unknown_landing_is_refused(branch):
    with pytest.raises(mc.ParameterError, match="motion, creep"):
        mc.load_path(branch, "F", [50.0, 0.0], landing="fly")
