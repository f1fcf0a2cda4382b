"""Whole jobs as a user meets them: starting, inspecting, the locus of figure 12, all figures."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time

import mjcont as mc
from benchmarks.cases import chain
from benchmarks.measure import seconds


def _output(*arguments: str) -> str:
    """Run a fresh interpreter and return what it prints.

    Raises
    ------
    RuntimeError
        If it fails, with its last line.
    """
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        lines = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise RuntimeError(f"status {done.returncode}: {lines[-1] if lines else 'no message'}")
    return done.stdout


def import_time() -> float:
    """Return what `import mjcont` adds to importing numpy and mujoco, in s."""
    code = (
        "import time, numpy, mujoco; t = time.perf_counter(); import mjcont; "
        "mjcont.continue_equilibria; mjcont.Mechanism; print(time.perf_counter() - t)"
    )
    return float(_output("-c", code))


def command(*arguments: str) -> float:
    """Return how long a mjcont command takes, in s."""
    return seconds(lambda: _output("-m", "mjcont", *arguments))


def inspect() -> float:
    """Return the time of `mjcont inspect` on the overcentre mechanism, in s."""
    return command("inspect", "overcentre")


def reproduce() -> float:
    """Return the time of all the paper's figures, in s."""
    with tempfile.TemporaryDirectory() as folder:
        return command("reproduce", "-o", folder)


def locus() -> float:
    """Return the time of the two-parameter locus of figure 12, its branch and cusp included, in s."""
    gear = mc.Mechanism.from_xml("nose_gear")

    def run() -> None:
        branch = mc.continue_equilibria(gear, "F_ret", (0.0, 8e5), {"F_ret": 2.5e5}, keyframe="uplock_above")
        fold = max(branch.of_kind("LP"), key=lambda p: p["F_ret"])
        mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0))

    return seconds(run)


def row(links: int) -> float:
    """Return the CPU time of a row of the chain's branch, in ms."""
    case = chain(links)
    began = time.process_time()
    rows = len(case.run())
    return 1e3 * (time.process_time() - began) / rows


def memory(links: int) -> float:
    """Return the peak memory of a process that computes the chain's branch, in MB."""
    code = (
        f"from benchmarks.cases import chain; chain({links}).run(); "
        "print(next(line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')))"
    )
    return float(_output("-c", code)) / 1024.0
