"""A nose wheel that shimmies, as the study beyond the paper has it: its Hopf curve in closed form, its folds."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder


@pytest.fixture(scope="module")
def shimmy():
    return load_script(scripts_folder() / "shimmy.py")


@pytest.fixture(scope="module")
def study(shimmy):
    return shimmy.compute(loads=(), checked=4)


@pytest.mark.slow
def test_rest_loses_stability_where_the_condition_of_hurwitz_says(shimmy, study):
    hopf = study.hopf
    assert hopf["F_z"] == pytest.approx(shimmy.hopf_load(hopf["V"]), rel=1e-8)


@pytest.mark.slow
def test_the_wheel_shimmies_below_the_speed_at_which_it_begins(study):
    begin, fold = study.rest.point("HB1"), study.cycles.point("LPC1")
    assert begin.coefficients["type"] == "subcritical"
    assert fold["V"] < begin["V"]
    assert set(study.cycles.stability[: fold.index]) != set(study.cycles.stability[fold.index + 1 :])


@pytest.mark.slow
@pytest.mark.long
def test_no_motion_stays_below_the_fold_and_a_large_one_does_above(shimmy, study):
    fold = study.cycles.point("LPC1")
    wheel = shimmy.nose_wheel()
    for speed, lasts in ((fold["V"] - 1.0, False), (fold["V"] + 1.0, True)):
        motion = mc.simulate(wheel, duration=2.5, start={"V": speed}, state=[np.radians(12.0), 0.0, 0.0])
        late = np.abs(motion["psi"][motion["time"] > 2.3]).max()
        assert (late > fold["psi.max"]) == lasts


@pytest.mark.slow
def test_all_findings_hold(shimmy, study):
    assert [f.claim for f in shimmy.findings(study) if not f.holds] == []
