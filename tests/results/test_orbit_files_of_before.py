"""Files of orbits that were written before load, whatever becomes of the code: one small file of each kind."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import mjcont as mc

WRITTEN = Path(__file__).parent / "written" / "orbits"


def test_cycles_of_the_bautin_form_satisfy_its_closed_form():
    cycles = mc.load(WRITTEN / "vector_field_cycles.h5")
    r2 = np.array([o.at(0.0) @ o.at(0.0) for o in cycles.orbits])
    assert cycles["b1"] == pytest.approx(r2 * (r2 - 1.0), abs=1e-6)
    assert cycles["period"] == pytest.approx(np.full(len(r2), 2.0 * math.pi), rel=1e-6)
    assert cycles.point("LPC1")["b1"] == pytest.approx(-0.25, abs=1e-6)
    assert cycles.problem is None


def test_a_response_through_a_filter_comes_with_its_model_forcing_and_activations():
    curve = mc.load(WRITTEN / "filtered_response.h5")
    orbit = curve[0].orbit
    lagging = 0.5 * np.exp(0.3j) / (1.0 + 2j * math.pi * 0.7 * orbit.frequency)
    waves = lagging * np.exp(2j * math.pi * orbit.frequency * orbit.times)
    assert orbit.activations[:, 0] == pytest.approx(1.0 + waves.real, abs=1e-5)
    assert curve.problem.parameters["F"].kind == "control"
    (again,) = curve.at(frequency=0.5 * (curve["frequency"][0] + curve["frequency"][1]))
    assert again.orbit.activations.shape[1] == 1


@pytest.mark.parametrize("file", sorted(WRITTEN.parent.glob("*/*.h5")), ids=lambda p: p.stem)
def test_what_is_loaded_is_saved_and_loaded_again(file, tmp_path):
    result = mc.load(file)
    assert str(mc.load(result.save(tmp_path / file.name))) == str(result)
