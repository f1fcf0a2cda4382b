"""The tests under every BLAS kernel that the processor can run, and with NumPy's own dispatch reduced.

NumPy and SciPy carry an OpenBLAS each, which chooses its kernel by the processor, or by OPENBLAS_CORETYPE. Each suite
runs in a child process with that set. Where the machine sets it already, kernels are left alone.

    python tests/kernels.py [pytest's arguments]
"""

from __future__ import annotations

import ctypes
import json
import os
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

CORETYPE, DISABLED = "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES"
X86 = ("Prescott", "Nehalem", "Sandybridge", "Haswell", "Zen", "SkylakeX", "Cooperlake", "SapphireRapids")
ARM = ("ARMV8", "CortexA57", "NeoverseN1", "NeoverseN2", "NeoverseV1", "VORTEX")
_ROOT = Path(__file__).resolve().parent.parent
_NAMES = [f"{prefix}openblas_get_corename{suffix}" for prefix in ("scipy_", "") for suffix in ("64_", "")]
_PROBE = "--probe"
_EVERY = "not long and not fuzz and not thirdparty and not shaken and not browser"
_SHARED = ("-n", "auto", "--dist", "loadfile", "--no-loadscope-reorder", "-m", _EVERY)


@dataclass(frozen=True)
class Case:
    """One run of the suite: its name, and the environment variables that make it."""

    name: str
    variables: Mapping[str, str]


@dataclass(frozen=True)
class Probe:
    """What a child process found: the kernel of each OpenBLAS by its package, NumPy's optional features in use."""

    kernels: Mapping[str, str]
    features: Sequence[str]

    @property
    def kernel(self) -> str:
        """The kernels, as one word where they are the same."""
        return "/".join(dict.fromkeys(self.kernels.values())) or "no OpenBLAS"


# -- in the child ---------------------------------------------------------------------------------------------


def libraries(package: str, site: Path) -> list[Path]:
    """Return the OpenBLAS libraries that a package carries."""
    folders = (site / f"{package}.libs", site / package / ".dylibs")
    return sorted(f for folder in folders if folder.is_dir() for f in folder.iterdir() if "openblas" in f.name.lower())


def corename(library: Path) -> str:
    """Return the kernel that a library of OpenBLAS has chosen, empty if it does not say."""
    loaded = ctypes.CDLL(str(library))
    for name in _NAMES:
        function = getattr(loaded, name, None)
        if function is not None:
            function.restype = ctypes.c_char_p
            return function().decode()
    return ""


def probe() -> Probe:
    """Return the kernels of this process, after both have factorised a matrix: a processor may lack an instruction."""
    import numpy as np
    import scipy.linalg

    matrix = np.random.default_rng(0).normal(size=(64, 64))
    np.linalg.svd(np.linalg.inv(matrix) @ matrix)
    scipy.linalg.lu_factor(matrix)
    site = Path(np.__file__).resolve().parent.parent
    found = {p: corename(f) for p in ("numpy", "scipy") for f in libraries(p, site)}
    umath = sys.modules["numpy._core._multiarray_umath"]
    features = [f for f in umath.__cpu_dispatch__ if umath.__cpu_features__.get(f)]
    return Probe(found, features)


# -- in the parent --------------------------------------------------------------------------------------------


def probed(variables: Mapping[str, str]) -> Probe | None:
    """Return what a child process with some variables finds, None where it dies: the processor cannot run that."""
    done = subprocess.run(
        [sys.executable, __file__, _PROBE], env={**os.environ, **variables}, capture_output=True, text=True, check=False
    )
    return Probe(**json.loads(done.stdout)) if done.returncode == 0 else None


def distinct(default: Probe, answers: Mapping[str, Probe | None]) -> list[str]:
    """Return the names that give kernels of their own, of those asked for: a build holds a few, others are aliases.

    A name that OpenBLAS does not know, or whose instructions it sees are missing, gives the machine's own kernel.
    """
    seen, found = {default.kernel}, []
    for name, answer in answers.items():
        if answer is not None and answer.kernel not in seen:
            seen.add(answer.kernel)
            found.append(name)
    return found


def cases(default: Probe, kernels: Iterable[str], preset: Mapping[str, str]) -> list[Case]:
    """Return the runs: as the machine has it, with other kernels, NumPy's dispatch reduced; what is preset stays."""
    found = [Case(f"{default.kernel}, as the machine has it", {})]
    if CORETYPE not in preset:
        found += [Case(name, {CORETYPE: name}) for name in kernels]
    if DISABLED not in preset and default.features:
        found.append(Case("NumPy without " + ", ".join(default.features), {DISABLED: " ".join(default.features)}))
    return found


def table(results: Sequence[tuple[Case, bool, str]]) -> str:
    """Return a line for each run: whether it passed, which, and pytest's last words."""
    width = max(len(case.name) for case, _, _ in results)
    return "\n".join(f"{'passed' if ok else 'FAILED'}  {case.name:{width}}  {said}" for case, ok, said in results)


def suite(case: Case, arguments: Sequence[str]) -> tuple[Case, bool, str]:
    """Run the tests in a child process, its output shown as it comes, and return how it went."""
    command = [sys.executable, "-m", "pytest", "-q", *(arguments or _SHARED)]
    said = ""
    with subprocess.Popen(
        command, cwd=_ROOT, env={**os.environ, **case.variables}, stdout=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        for line in child.stdout:
            print(line, end="", flush=True)
            said = line.strip() or said
    return case, child.returncode == 0, said


def main(arguments: Sequence[str]) -> int:
    """Run the suite in every way and say which passed; status 1 if one did not."""
    default = probed({})
    if default is None:
        print("kernels: NumPy and SciPy do not work here", file=sys.stderr)
        return 1
    for variable in (CORETYPE, DISABLED):
        if variable in os.environ:
            print(f"kernels: {variable}={os.environ[variable]} is set on this machine and stays as it is")
    asked = () if CORETYPE in os.environ else (*X86, *ARM)
    every = cases(default, distinct(default, {k: probed({CORETYPE: k}) for k in asked}), os.environ)
    print("kernels: " + "; ".join(case.name for case in every), flush=True)
    results = []
    for case in every:
        print(f"\n-- {case.name}", flush=True)
        results.append(suite(case, arguments))
    print("\n" + table(results))
    return 0 if all(ok for _, ok, _ in results) else 1


if __name__ == "__main__":
    if sys.argv[1:] == [_PROBE]:
        found = probe()
        print(json.dumps({"kernels": found.kernels, "features": found.features}))
    else:
        sys.exit(main(sys.argv[1:]))
