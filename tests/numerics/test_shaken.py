"""Special points, statuses, stability and ends must not turn on rounding: everything again under noise as large.

`make test-shaken` runs ten seeds; a fast part with two of them belongs to `make test`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest
from problems.shaken_paper import PAPER, SHIPPED
from problems.shaken_problems import PROBLEMS
from problems.shaking import shaken
from problems.signatures import Signature, differences, signature

import mjcont as mc

JOBS = {**PROBLEMS, **PAPER, **{f"study {name}": job for name, job in SHIPPED.items()}}
SEEDS = range(10)
FAST_SEEDS = (0, 1)
FAST = (
    "ab at B = 18", "pp2", "adaptx", "bratu", "isola of radius 0.001", "imperfect pitchfork -0.001", "two folds, 1e-05",
    "two oscillations 0.0001 apart", "circle and two lines", "two modes", "folds of ab", "conic +1",
    "Hopf points of ab", "ab, side by side",
    *(f"network {seed}" for seed in range(3)), *(f"linkage {seed}" for seed in range(5)),
    "overcentre, k_j = 1000", "truss", "column, pushed aside", "Ziegler's column, b = 0.1",
    "pendulum between stops, g = 2", "cable", "toggle clamp", "figures 2 and 3", "figure 5",
    "figures 12, 14, 15: 1 g, 0 deg", "study overcentre",
)


@cache
def unshaken(name: str) -> Signature:
    """Return what is found without noise, computed once."""
    return signature(JOBS[name]())


def _cases() -> Iterator[Any]:
    for name in JOBS:
        for seed in SEEDS:
            marks = [pytest.mark.shaken, pytest.mark.xdist_group(name)]  # one worker computes it without noise
            marks += [pytest.mark.fast] if name in FAST and seed in FAST_SEEDS else []
            yield pytest.param(name, seed, marks=marks, id=f"{name}-seed{seed}")


@pytest.mark.parametrize(("name", "seed"), list(_cases()))
def test_noise_as_large_as_rounding_changes_no_special_point_status_stability_or_end(name: str, seed: int) -> None:
    with shaken(seed):
        found = signature(JOBS[name]())
    assert differences(unshaken(name), found) == []


def test_what_belongs_to_the_fast_part_exists() -> None:
    assert set(FAST) <= JOBS.keys()


@pytest.mark.slow
def test_a_signature_tells_a_lost_point_from_a_moved_one() -> None:
    plain = unshaken("ab at B = 18")
    lost = {name: value for name, value in plain.items() if "LP2" not in name}
    assert any("LP2" in sentence for sentence in differences(plain, lost))
    assert differences(plain, plain) == []


@pytest.mark.slow
def test_a_start_comes_to_the_same_rest_under_noise() -> None:
    gear = mc.Mechanism.from_xml("nose_gear_locking")
    load = {"gravity_angle": np.radians(-20.0), "F_ul": -500.0, "F_ret": 2.5e5}
    rest = mc.find_equilibrium(gear, load, keyframe="uplock_below")
    assert rest.stability == "stable"
    for seed in SEEDS:
        with shaken(seed):
            found = mc.find_equilibrium(gear, load, keyframe="uplock_below")
        assert found["theta_ov"] == pytest.approx(rest["theta_ov"], abs=1e-8)
