"""Controls that hold poses of models that none of us wrote, against MuJoCo's own inverse dynamics of the same files."""

from __future__ import annotations

import pytest
from problems.inverse import unbalanced
from problems.thirdparty import WHEELS, unpacked

import mjcont as mc

pytestmark = pytest.mark.thirdparty

if any(not unpacked(p).is_dir() for p in WHEELS):
    pytest.skip("models of other packages are not there: make test-thirdparty", allow_module_level=True)

SOURCE = unpacked("playground") / "mujoco_playground" / "_src"
SPOT = SOURCE / "locomotion" / "spot" / "xmls" / "scene_mjx_feetonly_flat_terrain.xml"
GO1 = SOURCE / "locomotion" / "go1" / "xmls" / "scene_mjx_feetonly_flat_terrain.xml"
HAND = SOURCE / "manipulation" / "leap_hand" / "xmls" / "leap_rh_mjx.xml"
ALOHA = SOURCE / "manipulation" / "aloha" / "xmls" / "mjx_aloha.xml"
ACROBOT = SOURCE / "dm_control_suite" / "xmls" / "acrobot.xml"
BENT = {"waist": 0.3, "shoulder": -0.5, "elbow": 0.6, "forearm_roll": 0.2, "wrist_angle": 0.4, "wrist_rotate": -0.3}


@pytest.mark.filterwarnings("ignore::mjcont.errors.ModelWarning")
@pytest.mark.parametrize(
    ("path", "pose"),
    [(SPOT, "home"), (GO1, "home"), (HAND, None), (ALOHA, {f"left/{n}": v for n, v in BENT.items()})],
    ids=["on four feet", "on four feet, saturated at first", "a hand", "an arm whose fingers are free"],
)
def test_the_controls_found_are_what_inverse_dynamics_ask_for(path, pose):
    mechanism = mc.Mechanism.from_xml(path)
    found = mc.hold(mechanism, mechanism.qpos0 if pose is None else pose)
    assert found.status == "held", found.message
    left, size = unbalanced(mechanism, found)
    assert left < 1e-5 * size


@pytest.mark.filterwarnings("ignore::mjcont.errors.ModelWarning")
def test_what_is_left_over_is_what_inverse_dynamics_ask_for_beyond_the_actuators():
    for path, x in ((ACROBOT, [0.5, 0.2]), (ALOHA, None)):
        mechanism = mc.Mechanism.from_xml(path)
        found = mc.hold(mechanism, mechanism.qpos0 if x is None else x)
        assert found.status in ("not held", "beyond range")
        left, _ = unbalanced(mechanism, found)
        assert left == pytest.approx(max(abs(v) for v in found.left.values()), rel=1e-6)
