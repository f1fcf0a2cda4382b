"""A latch whose pawl holds a door's keeper by a contact, against hand-written statics and time histories."""

import math

import mujoco
import numpy as np
import pytest
from scipy.optimize import brentq

import mjcont as mc

ARM, ROLLER, GAP, FACE = 0.05, 0.006, 1e-3, math.radians(30.0)
SEAL, SPRING, WOUND = 400.0, 1.0, 1.0
TO_EDGE = 0.006  # along the face, from the roller's centre at rest
NORMAL = np.array([math.cos(FACE), math.sin(FACE)])
ALONG = np.array([-math.sin(FACE), math.cos(FACE)])


@pytest.fixture(scope="module")
def latch():
    return mc.Mechanism.from_xml("latch")


@pytest.fixture(scope="module")
def branch(latch):
    return mc.continue_equilibria(latch, "F", bounds=(-40.0, 60.0), start={"F": 0.0})


def stiffness(latch) -> tuple[float, float]:
    """Stiffness of contact and stop, by MuJoCo's definition of a constraint with constant impedance."""
    model = latch.simulation_model()
    contact = 2e6 / (0.1 * float(model.body_invweight0[1:, 0].sum()))
    return contact, 1e7 / (0.1 * float(model.dof_invweight0[1]))


def centre(theta: float) -> np.ndarray:
    """Centre of the roller, which is at the origin when the pawl is on its stop."""
    return ARM * np.array([1.0 - math.cos(theta), math.sin(theta)])


def contact_force(theta: float, stop: float, lift: float = 0.0) -> float:
    """Balance of moments on the pawl: spring and stop against the contact, normal to the face, and a lifting moment."""
    wound = SPRING * (WOUND + theta) + (stop * theta if theta < 0.0 else 0.0)
    return (wound - lift) / (ARM * math.sin(FACE + theta))


def door(theta: float, force: float, contact: float) -> float:
    """Way of the door at which the face touches the roller and yields by force / contact."""
    return GAP + (NORMAL @ centre(theta) + force / contact) / NORMAL[0]


def load(theta: float, contact: float, stop: float) -> float:
    """Balance of forces on the door: the load against seal and contact."""
    force = contact_force(theta, stop)
    return SEAL * door(theta, force, contact) + force * NORMAL[0]


def corners(branch, note: str) -> list:
    return [p for p in branch.of_kind("CO") if p.note.startswith(note)]


def latched(branch, force: float):
    """The equilibrium at a load in which the door is shut."""
    return min(branch.at(F=force), key=lambda p: p["x"])


def test_the_contact_begins_to_carry_where_the_gap_closes(latch, branch):
    _, stop = stiffness(latch)
    (engages,) = corners(branch, "contact of pawl and keeper engages")
    sag = -SPRING * WOUND / (stop + SPRING)
    assert engages["theta"] == pytest.approx(sag, rel=1e-6)
    assert engages["F"] == pytest.approx(SEAL * (GAP + NORMAL @ centre(sag) / NORMAL[0]), rel=1e-6)


def test_the_pawl_leaves_its_stop_at_the_release_load_of_the_statics(latch, branch):
    (release,) = corners(branch, "lower limit of theta releases")
    assert release["F"] == pytest.approx(load(0.0, *stiffness(latch)), rel=1e-6)


def test_the_release_is_a_non_smooth_fold_from_stable_to_unstable(latch, branch):
    (release,) = corners(branch, "lower limit of theta releases; F turns back: a non-smooth fold")
    contact, stop = stiffness(latch)
    assert load(1e-6, contact, stop) < load(0.0, contact, stop)  # the spring loses against the lever arm
    below = [p for p in branch.at(F=0.999 * release["F"]) if p["x"] < 2.0 * release["x"]]
    assert sorted((p["theta"] > 0.0, p.stability) for p in below) == [(False, "stable"), (True, "unstable")]


def test_every_row_on_the_face_obeys_the_statics(latch, branch):
    (engages,) = corners(branch, "contact of pawl and keeper engages")
    edge = corners(branch, "the stiffness jumps")[0]
    rows = [branch.row(i) for i in range(len(branch["F"]))]
    on_face = [p for p in rows if engages["x"] < p["x"] < edge["x"]]
    assert len(on_face) > 15
    for p in on_face:
        assert p["F"] == pytest.approx(load(p["theta"], *stiffness(latch)), rel=1e-5)


def test_the_contact_passes_from_face_to_edge_where_the_geometry_has_it(latch, branch):
    contact, stop = stiffness(latch)

    def beyond(theta: float) -> float:
        way = door(theta, contact_force(theta, stop), contact)
        return ALONG @ (centre(theta) - np.array([way, 0.0])) - TO_EDGE

    expected = brentq(beyond, 0.0, 0.3, xtol=1e-14)
    edge = corners(branch, "the stiffness jumps under contact of pawl and keeper")[0]
    assert edge["theta"] == pytest.approx(expected, abs=1e-5)
    assert edge["F"] == pytest.approx(load(expected, contact, stop), abs=1e-3)


def test_the_door_shuts_again_at_the_load_that_turns_the_contact_onto_the_back_of_the_keeper(latch, branch):
    contact, _ = stiffness(latch)

    def heights(theta: float) -> tuple[float, float, np.ndarray]:
        force = SPRING * (WOUND + theta) / (ARM * math.cos(FACE + theta))
        at_edge = -NORMAL * (ROLLER + GAP * NORMAL[0]) + ALONG * (TO_EDGE + ROLLER - force / contact)
        return (centre(theta) - at_edge)[1], force, centre(theta) - at_edge

    theta = brentq(lambda t: heights(t)[0], 0.0, 0.5, xtol=1e-14)
    _, force, way = heights(theta)
    shuts = corners(branch, "the stiffness jumps")[1]
    assert shuts.note.endswith("F turns back: a non-smooth fold")
    assert shuts["F"] == pytest.approx(SEAL * way[0] + force * ALONG[0], abs=1e-3)
    assert shuts["theta"] == pytest.approx(theta, abs=1e-5)


@pytest.mark.slow
def test_a_moment_on_the_pawl_releases_the_loaded_door_where_the_statics_say(latch):
    contact, stop = stiffness(latch)
    branch = mc.continue_equilibria(latch, "M", bounds=(0.0, 2.0), start={"F": 20.0})
    (release,) = corners(branch, "lower limit of theta releases")

    def surplus(moment: float) -> float:
        force = contact_force(0.0, stop, moment)
        return SEAL * door(0.0, force, contact) + force * NORMAL[0] - 20.0

    lift = brentq(surplus, 0.0, 1.0, xtol=1e-14)
    assert release["M"] == pytest.approx(lift, rel=1e-6)


def test_the_contact_force_at_rest_is_that_of_the_statics(latch, branch):
    point = latched(branch, 20.0)
    model = latch.simulation_model()
    data = mujoco.MjData(model)
    data.qpos[:], data.ctrl[:] = point.state, [20.0, 0.0]
    mujoco.mj_forward(model, data)
    force = np.zeros(6)
    mujoco.mj_contactForce(model, data, 0, force)
    assert data.ncon == 1
    assert force[0] == pytest.approx((20.0 - SEAL * point["x"]) / NORMAL[0], rel=1e-6)
    assert force[0] == pytest.approx(contact_force(point["theta"], stiffness(latch)[1]), rel=1e-6)
    assert force[1:] == pytest.approx(np.zeros(5), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("part", "opens"), [(0.995, False), (1.005, True)])
def test_the_door_holds_below_the_release_load_and_flies_open_above(latch, branch, part, opens):
    release = load(0.0, *stiffness(latch))
    ramp = ([0.0, 0.3, 0.8], [0.98 * release, part * release, part * release])
    start = latched(branch, 0.98 * release)
    history = mc.simulate(latch, {"F": ramp}, duration=0.8, start=start, integrator="implicitfast")
    assert (history["x"][-1] > 0.02) == opens
    assert opens or history["x"][-1] == pytest.approx(latched(branch, part * release)["x"], abs=1e-7)
