"""Timing: medians over repeated, interleaved runs, so that what else the machine does hits all alike."""

from __future__ import annotations

import platform
import statistics
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any


def interleaved(runs: Mapping[str, Callable[[], float]], repeats: int) -> dict[str, list[float]]:
    """Call every run once a round, after a round that is not counted, and return what each returned."""
    found: dict[str, list[float]] = {name: [] for name in runs}
    for name, run in runs.items():
        run()
        del found[name][:]
    for _ in range(repeats):
        for name, run in runs.items():
            found[name].append(run())
    return found


def medians(runs: Mapping[str, Callable[[], float]], repeats: int) -> dict[str, float]:
    """Return the median of each run's figures over interleaved repeats."""
    return {name: statistics.median(values) for name, values in interleaved(runs, repeats).items()}


def seconds(function: Callable[[], Any]) -> float:
    """Return how long a call takes, in s."""
    began = time.perf_counter()
    function()
    return time.perf_counter() - began


def machine() -> dict[str, str]:
    """Return processor, system, and versions of what is measured."""
    model = ""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "")
    except OSError:
        pass
    packages = {name: version(name) for name in ("mujoco", "numpy", "scipy")}
    return {"processor": model or platform.processor(), "system": platform.platform(terse=True),
            "python": platform.python_version(), **packages}
