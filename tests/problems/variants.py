"""A small sweep of the overcentre mechanism, and what its folder holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import mjcont as mc
from mjcont.studies.study import Study

STUDY = """
model = "overcentre"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50, k_j = 1000 }
[sweep]
cases = 12
seed = 3
record = ["fold.F", "fold.theta_1"]
[[sweep.point]]
name = "fold"
branch = "equilibria"
label = "LP1"
[sweep.vary]
k_j = { lognormal = "10 %" }
gravity_angle = { uniform = "2 deg" }
load_factor = { "truncated normal" = "2 %" }
"""


def study(folder: Path, text: str = STUDY) -> Study:
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return mc.load_study(path)


def records(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (folder / "sweep.jsonl").read_text().splitlines()[1:]]


def same(one: Path, other: Path) -> bool:
    return all((one / f).read_bytes() == (other / f).read_bytes() for f in ("sweep.csv", "sweep.h5"))
