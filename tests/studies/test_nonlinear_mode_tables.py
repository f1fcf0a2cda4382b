"""`[[nonlinear_modes]]` in study files: what they store, and what is said of mistakes."""

from __future__ import annotations

import pytest
from problems.conservative import PENDULUM, period_of_pendulum

import mjcont as mc

MODES = """
version = 1
model = "pendulum.xml"

[[nonlinear_modes]]
name = "swing"
bounds = ["1 mJ", "5 J"]
csv = true
resonances = []
settings = { max_points = 60 }

[[nonlinear_modes]]
name = "onward"
point = "swing:last"
parameter = "frequency"
bounds = [0.5, 0.7]

[[plot]]
file = "energies.png"
x = "energy"
y = "frequency"
branches = ["swing"]
"""


def study(folder, text):
    (folder / "pendulum.xml").write_text(PENDULUM)
    path = folder / "study.toml"
    path.write_text(text)
    return path


@pytest.mark.slow
def test_a_study_stores_a_family_and_goes_on_from_it(tmp_path):
    swing, onward = mc.run_study(mc.load_study(study(tmp_path, MODES)), tmp_path / "out")
    assert swing.kind == "nonlinear modes" and swing["energy"][[0, -1]] == pytest.approx([1e-3, 5.0])
    assert swing["period"][-1] == pytest.approx(period_of_pendulum(5.0), rel=1e-9)
    assert onward.free == {"frequency": (0.5, 0.7)}
    for name in ("swing.h5", "swing.csv", "onward.h5", "energies.png"):
        assert (tmp_path / "out" / name).stat().st_size > 0
    stored = mc.load(tmp_path / "out" / "swing.h5")
    assert stored[-1].orbit.energy == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('bounds = ["1 mJ", "5 J"]\n', "", "this key is missing: the range of the energy"),
        ('bounds = ["1 mJ", "5 J"]', 'bounds = [0, 5]', "energies and frequencies are positive"),
        ('parameter = "frequency"', 'parameter = "theta"', "energy, frequency"),
        ("resonances = []", "resonances = [2]", "three or more"),
        ('point = "swing:last"', 'point = "swing:last"\nmode = 2', "leave this key out"),
    ],
)
def test_a_mistake_is_told_with_what_to_write(tmp_path, old, new, said):
    assert old in MODES
    with pytest.raises(mc.StudyError, match=said):
        mc.load_study(study(tmp_path, MODES.replace(old, new)))
