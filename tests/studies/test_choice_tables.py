"""The tables `[[holds]]` and `[[designs]]` of a study."""

from __future__ import annotations

import pytest

import mjcont as mc

STUDY = """
model = "overcentre"

[parameters]
k_j = "1 MN/m"

[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 60]
start = { F = 50 }

[[holds]]
name = "held"
pose = { theta_1 = "60 deg" }
controls = ["F"]

[[designs]]
name = "lock"
points = { upper = "equilibria:LP2" }
change = { k_sp = [1, 100], l_us = [0.1, 0.95] }
targets = ["upper.F == 14 N", "upper.theta_1 == 30 deg"]
xml = true
"""


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a study, with a part replaced, and returns its path."""

    def write(old="", new=""):
        assert old in STUDY
        path = tmp_path / "study.toml"
        path.write_text(STUDY.replace(old, new) if old else STUDY, encoding="utf-8")
        return path

    return write


@pytest.mark.slow
def test_a_study_holds_a_pose_and_designs_to_a_target(written, tmp_path):
    _, held, found = mc.run_study(mc.load_study(written()), tmp_path)
    assert held.held
    assert found.status == "met"
    assert [found["k_sp"], found["l_us"]] == pytest.approx([22.480269, 0.6495168], rel=1e-6)
    names = {p.name for p in tmp_path.iterdir()}
    assert {"held.csv", "lock.csv", "lock.png", "lock.xml"} <= names


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"upper.F == 14 N"', '"upper.F = 14"', r"designs\[0\].targets\[0\]: \"upper.F = 14\": expected a statement"),
        ('"upper.F == 14 N"', '"lower.F == 14"', "unknown point 'lower'"),
        ('"upper.F == 14 N"', '"upper.F == 14 m"', "'m' does not measure what 'N' does"),
        ('"equilibria:LP2"', '"equilibria:CP1"', "is no point of 'equilibria'"),
        ("xml = true", 'objective = "mass"', "name a point and a quantity"),
        ("xml = true", "scales = { F = 1 }", "F is not among the parameters of change"),
        ('pose = { theta_1 = "60 deg" }', 'pose = "upright"', "unknown keyframe 'upright'"),
        ('pose = { theta_1 = "60 deg" }', "pose = { knee = 1 }", "unknown observable 'knee'"),
        ('controls = ["F"]', 'controls = ["G"]', "unknown parameter 'G'"),
    ],
)
def test_mistakes_are_found_before_anything_is_computed(written, old, new, said):
    with pytest.raises(mc.StudyError, match=said):
        mc.load_study(written(old, new))
