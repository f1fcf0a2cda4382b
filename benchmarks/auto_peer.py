"""The peer AUTO-07p: its compiled solver with a right-hand side in C that calls the same MuJoCo library."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

import mjcont as mc
from benchmarks.cases import Case

FOLDER = Path("/usr/lib/auto-07p")
SOURCES = Path(__file__).parent / "auto"
_CONSTANTS = """NDIM={n}, IPS=1, IRS=0, ILP=1, ICP=[1, 2], NTST=5, NCOL=4, IAD=3, ISP=1, ISW=1, IPLT=0, NBC=0, NINT=0,
NMX={most}, NPR={most}, MXBF=0, IID=0, ITMX=9, ITNW=7, NWTN=3, JAC=0, EPSL=1e-7, EPSU=1e-7, EPSS=1e-5,
DS={ds!r}, DSMIN=1e-8, DSMAX={ds_max!r}, IADS=1, THL={{1: {weight!r}}}, UZSTOP={{1: [{low!r}, {high!r}]}}
"""
_MOST = 40000


@dataclass(frozen=True, slots=True)
class AutoRun:
    """What AUTO computed: the seconds and evaluations from the first evaluation on, and its points.

    `curve` is (points, 2): the parameter and the watched state, in order along the branch.
    """

    seconds: float
    calls: int
    curve: np.ndarray

    @property
    def points(self) -> int:
        """Number of points."""
        return len(self.curve)


def missing() -> str | None:
    """Return why AUTO-07p cannot be run here, or None."""
    if not FOLDER.is_dir():
        return "AUTO-07p is not installed (Debian package auto-07p)"
    for tool in ("gcc", "gfortran"):
        if shutil.which(tool) is None:
            return f"AUTO-07p needs {tool} to build its problems"
    return None


@cache
def built(source: str) -> Path:
    """Build a problem and return its executable; it lives as long as this process."""
    folder = Path(tempfile.mkdtemp(prefix="bench-auto-"))
    package = Path(mujoco.__file__).parent
    library = next(package.glob("libmujoco.so*"))
    objects = sorted(str(p) for p in (FOLDER / "lib").glob("*.o"))
    program = folder / source
    _call(["gcc", "-O2", "-w", f"-I{package}/include", "-c", str(SOURCES / f"{source}.c"), "-o", f"{program}.o"])
    link = ["gfortran", "-O2", "-fopenmp", f"{program}.o", *objects, f"-L{FOLDER}/lib", "-lauto_c"]
    _call([*link, str(library), f"-Wl,-rpath,{package}", "-o", str(program)])
    return program


def _call(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{command[0]} failed: {done.stderr[-2000:]}")


class AutoPeer:
    """One case in AUTO: prepared once, run many times."""

    def __init__(self, case: Case, weight: float, ds_max: float) -> None:
        self.case = case
        self.folder = Path(tempfile.mkdtemp(prefix="bench-case-"))
        self.weight, self.ds_max = weight, ds_max
        plain = not isinstance(case.problem, mc.Mechanism)
        self.program = built("reaction" if plain else "mechanism")
        self.states = case.problem.n if plain else 2 * case.problem.n
        if not plain:
            self._prepare()

    def _prepare(self) -> None:
        """Write the model and the start."""
        case, mechanism = self.case, self.case.problem
        start = case.start
        model: Any = mechanism.simulation_model()
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
        writer = mechanism.writer(model)
        writer.write(mechanism.parameters, {**start.parameters, case.parameter: 0.0})
        mujoco.mj_saveModel(model, str(self.folder / "model.mjb"))
        control = next(i for t in mechanism.parameters[case.parameter].targets for i in t.index)
        numbers = " ".join(repr(float(v)) for v in start.state)
        watched = [name for name, _ in mechanism.state_labels].index(case.watched)
        text = f"{control} {watched} {start.parameters[case.parameter]!r} {numbers}\n"
        (self.folder / "start.txt").write_text(text)

    def run(self) -> AutoRun:
        """Compute the branch in the directions of the case."""
        signs = (1,) if self.case.direction == 1 else (-1, 1)
        runs = [self._direction(sign) for sign in signs]
        curve = np.concatenate([runs[0][2][::-1], runs[1][2][1:]]) if len(runs) > 1 else runs[0][2]
        return AutoRun(sum(r[0] for r in runs), sum(r[1] for r in runs), curve)

    def _direction(self, sign: int) -> tuple[float, int, np.ndarray]:
        low, high = self.case.bounds
        width = 0.01 * (high - low)
        constants = _CONSTANTS.format(
            n=self.states,
            most=_MOST,
            ds=0.1 * sign * self.ds_max,
            ds_max=self.ds_max,
            weight=self.weight**2,
            low=low - (width if low == 0.0 and self.case.direction is None else 1e-12 * width),
            high=high,
        )
        done = subprocess.run(
            [str(self.program)], input=constants, capture_output=True, text=True, cwd=self.folder, check=False
        )
        words = done.stderr.split()
        if done.returncode or "seconds" not in words:
            raise RuntimeError(f"AUTO-07p stopped: {done.stdout[-500:]} {done.stderr[-500:]}")
        at = words.index("seconds")
        return float(words[at + 1]), int(words[at + 3]), self._points()

    def _points(self) -> np.ndarray:
        """Read AUTO's table: branch, point, type, label, parameter, norm, the first states, the watched one."""
        rows = []
        for line in (self.folder / "fort.7").read_text().splitlines():
            cells = line.split()
            if cells and cells[0].lstrip("-") not in ("0", ""):
                rows.append([float(cells[4]), float(cells[-1])])
        return np.array(rows)
