"""Timing: medians over repeated, interleaved runs, so that what else the machine does hits all alike."""

from __future__ import annotations

import platform
import statistics
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any


def medians(
    runs: Mapping[str, Callable[[], float]], repeats: int, tell: Callable[[str], None] = lambda word: None
) -> tuple[dict[str, float], dict[str, str]]:
    """Return the median of each run's figures over interleaved repeats, and why other runs have none.

    Every run is called once a round, after a round that is not counted; one that raises is not called again. `tell`
    takes a word on each round.
    """
    found: dict[str, list[float]] = {name: [] for name in runs}
    failed: dict[str, str] = {}
    for turn in range(repeats + 1):
        tell(f"round {turn} of {repeats}" if turn else "first round, not counted")
        for name, run in runs.items():
            if name in failed:
                continue
            try:
                figure = run()
            except Exception as error:  # the other runs' figures are kept
                failed[name] = f"{type(error).__name__}: {' '.join(str(error).split())}"
                continue
            if turn:
                found[name].append(figure)
    return {name: statistics.median(values) for name, values in found.items() if name not in failed}, failed


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
