"""What a case of a sweep costs in one process: cusps of the nose gear, folds of the overcentre mechanism."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mjcont as mc

GEARS = Path(__file__).parent.parent / "studies" / "gear_cusp_tolerances.toml"
_SCATTER = {
    "k_j": mc.Spread("lognormal", 0.1),
    "k_sp": mc.Spread("normal", 0.02, relative=True),
    "l_us": mc.Spread("uniform", 0.002, relative=True),
    "m_1": mc.Spread("truncated normal", 0.01, relative=True),
    "m_2": mc.Spread("truncated normal", 0.01, relative=True),
}


def cusps(count: int = 400) -> float:
    """Return the CPU time of a gear with 12 parameters, in ms: its cusp, the record and its share of the table."""
    study = mc.load_study(GEARS)
    return _each(count, lambda **how: mc.sweep(study, **how))


def folds(count: int = 2000) -> float:
    """Return the CPU time of an overcentre mechanism with 5 parameters, in ms: its fold and one observable."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    fold = mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 50.0), start={"F": 50.0}).point("LP1")
    asked: dict[str, Any] = {"design": "monte carlo", "cases": count, "record": ["fold.F", "fold.theta_1"]}
    return _each(count, lambda **how: mc.sweep({"fold": fold}, _SCATTER, **asked, **how))


def _each(count: int, sweep: Callable[..., Any]) -> float:
    """Return the CPU time in ms of each case after the first, the nominal case being there."""
    with tempfile.TemporaryDirectory() as folder:
        sweep(out=folder, limit=1, workers=1)
        began = time.process_time()
        sweep(out=folder, limit=count, workers=1)
        return 1e3 * (time.process_time() - began) / (count - 1)
