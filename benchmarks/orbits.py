"""Orbits, stability included, on one mesh in mjcont and in AUTO-07p: CPU time an orbit.

Mechanisms are forced and followed in frequency, van der Pol's oscillator, a plain field, in its parameter.
"""

from __future__ import annotations

import math
import os
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from scipy.interpolate import CubicSpline

import mjcont as mc
from benchmarks import auto_peer
from benchmarks.book import Missing
from benchmarks.measure import medians

INTERVALS, DEGREE, _SAMPLES, _DS = 20, 4, 80, 0.02
_CONSTANTS = """NDIM={n}, IPS=2, IRS=0, ILP=1, ICP=[1, 11], NTST=20, NCOL=4, IAD=0, ISP=2, ISW=1, IPLT=0, NBC=0, NINT=0,
NMX={most}, NPR={most}, MXBF=0, IID=0, ITMX=9, ITNW=7, NWTN=3, JAC=0, EPSL=1e-7, EPSU=1e-7, EPSS=1e-5,
DS={ds!r}, DSMIN=1e-8, DSMAX={ds!r}, IADS=1, UZSTOP={{1: [{low!r}, {high!r}]}}
"""


@dataclass(frozen=True, slots=True)
class Forced:
    """A mechanism under a harmonic force, followed in frequency: `low` to `high` in rad/s, other values in `start`."""

    model: str
    parameter: str
    amplitude: float
    start: dict[str, float]
    low: float
    high: float
    keyframe: str | None = None


CASES = {
    "overcentre": Forced("overcentre", "F", 5.0, {"k_j": 1e3, "F": 30.0}, 2.0, 2.6),
    "overcentre 1e+06": Forced("overcentre", "F", 5.0, {"k_j": 1e6, "F": 30.0}, 2.0, 2.6),
    "nose gear full": Forced("nose_gear_full", "F_ret", 1.0, {"F_ret": 20.0}, 2.0, 2.6, "uplock_above"),
}
FIELD = "van der Pol"


class ForcedRun:
    """One case, its mechanism made once."""

    peer_program = "forced"

    def __init__(self, case: Forced) -> None:
        self.case, self.mechanism = case, mc.Mechanism.from_xml(case.model)
        self.low, self.high, self.size = case.low, case.high, 2 * self.mechanism.n + 2

    def mjcont(self, note: Callable[[int], None] = lambda evaluations: None) -> tuple[float, mc.CycleBranch]:
        """Return CPU seconds an orbit after the first one, and the response."""
        case, turn = self.case, 2.0 * math.pi
        marks: list[float] = []

        def mark(count: int, special: int) -> None:
            marks.append(time.process_time())
            note(self.mechanism.evaluations)

        forcing = {case.parameter: mc.Harmonic(case.amplitude)}
        branch = mc.continue_response(
            self.mechanism, "frequency", (case.low / turn, case.high / turn), forcing, case.start,
            frequency=case.low / turn, keyframe=case.keyframe, direction=1, mesh=INTERVALS, degree=DEGREE,
            ds_max=_DS, progress=mark,
        )
        return (time.process_time() - marks[0]) / max(len(branch) - 1, 1), branch

    def prepare(self, folder: Path, first: mc.Orbit) -> None:
        """Write AUTO's model and start."""
        case, mechanism = self.case, self.mechanism
        model: Any = mechanism.simulation_model()
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
        parameters = mechanism.parameters
        mechanism.writer(model).write(parameters, {**mechanism.values(), **case.start})
        mujoco.mj_saveModel(model, str(folder / "model.mjb"))
        control = next(i for t in parameters[case.parameter].targets for i in t.index)
        head = f"{control} {case.start[case.parameter]!r} {case.amplitude!r} {case.low!r} {_SAMPLES}"
        _write_orbit(folder, head, first.times, np.hstack([first.states, first.velocities]), first.period)


class FieldRun:
    """Cycles of van der Pol's oscillator, a field in Python."""

    low, high = 1.0, 2.0
    peer_program, size = "cycle", 2

    def __init__(self) -> None:
        self.field = mc.VectorField(_van_der_pol, [2.0, 0.0], {"mu": self.low}, names=["x", "v"])

    def mjcont(self, note: Callable[[int], None] = lambda evaluations: None) -> tuple[float, mc.CycleBranch]:
        """Return CPU seconds an orbit after the first one, and the curve."""
        marks: list[float] = []

        def mark(count: int, special: int) -> None:
            marks.append(time.process_time())
            note(self.field.evaluations)

        branch = mc.continue_cycles(
            self.field, "mu", (self.low, self.high), direction=1, mesh=INTERVALS, degree=DEGREE, ds_max=_DS,
            progress=mark,
        )
        return (time.process_time() - marks[0]) / max(len(branch) - 1, 1), branch

    def prepare(self, folder: Path, first: mc.Orbit) -> None:
        """Write AUTO's start."""
        _write_orbit(folder, f"{self.low!r} {first.period!r} {_SAMPLES}", first.times, first.states, first.period)


def _van_der_pol(u: Any, p: Any) -> list[float]:
    return [u[1], p["mu"] * (1.0 - u[0] ** 2) * u[1] - u[0]]


def _write_orbit(folder: Path, head: str, times: Any, states: Any, period: float) -> None:
    at = times[0] + period * np.arange(_SAMPLES) / _SAMPLES
    rows = CubicSpline(times, states)(at).tolist()
    (folder / "orbit.txt").write_text(head + "\n" + "\n".join(" ".join(map(repr, row)) for row in rows))


class Peer:
    """The same curve in AUTO-07p, started from mjcont's first orbit."""

    def __init__(self, run: ForcedRun | FieldRun, first: mc.Orbit) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="bench-orbit-"))
        self.points = self.calls = 0
        self.program, self.size = auto_peer.built(run.peer_program), run.size
        self.low, self.high = run.low, run.high
        run.prepare(self.folder, first)

    def run(self) -> float:
        """Return CPU seconds an orbit."""
        constants = _CONSTANTS.format(n=self.size, most=60, ds=_DS, low=self.low - 0.01, high=self.high)
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        done = subprocess.run([str(self.program)], input=constants, capture_output=True, text=True, cwd=self.folder,
                              check=False, env=environment)
        words = done.stderr.split()
        if done.returncode or "seconds" not in words:
            raise RuntimeError(f"AUTO-07p stopped: {done.stdout[-500:]} {done.stderr[-500:]}")
        rows = [line.split() for line in (self.folder / "fort.7").read_text().splitlines()]
        points = sum(bool(cells) and cells[0] != "0" for cells in rows)
        if points < 3:
            raise RuntimeError("AUTO-07p found no orbits")
        self.points, self.calls = points, int(words[words.index("seconds") + 3])
        return float(words[words.index("seconds") + 1]) / points


def compare(name: str, repeats: int, tell: Callable[[str], None]) -> dict[str, Any]:
    """Return the medians of both, in ms of CPU an orbit, and their evaluations an orbit."""
    if (why := auto_peer.missing()) is not None:
        raise Missing(why)
    counts: list[int] = []
    run = FieldRun() if name == FIELD else ForcedRun(CASES[name])
    branch = run.mjcont(counts.append)[1]
    peer = Peer(run, branch.orbits[0])
    times, failed = medians({"mjcont": lambda: run.mjcont()[0], "AUTO": peer.run}, repeats, tell)
    if failed:
        raise RuntimeError("; ".join(f"{who}: {why}" for who, why in failed.items()))
    ours = statistics.median(after - before for before, after in pairwise(counts))
    evaluations = {"mjcont": ours, "AUTO": peer.calls / peer.points}
    return {**{who: 1e3 * value for who, value in times.items()}, "evaluations": evaluations}
