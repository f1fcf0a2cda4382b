"""The right-hand side of `ab` compiled: what is left of a run's time is our own."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

SOURCE = Path(__file__).parent / "compiled.c"


def missing() -> str | None:
    """Return why nothing can be compiled here, or None."""
    return None if shutil.which("gcc") else "gcc is not there to compile the field"


@cache
def compiled() -> Callable[[np.ndarray, Mapping[str, Any]], np.ndarray]:
    """Return the function of states in columns, (2, m) or (2,), called through ctypes; built once."""
    library = Path(tempfile.mkdtemp(prefix="bench-field-")) / "field.so"
    build = ["gcc", "-O2", "-shared", "-fPIC", str(SOURCE), "-o", str(library), "-lm"]
    done = subprocess.run(build, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"gcc failed: {done.stderr[-2000:]}")
    function = ctypes.CDLL(str(library)).ab
    pointer, count = ctypes.c_void_p, ctypes.c_long
    function.argtypes, function.restype = [pointer, pointer, count, pointer, count, pointer, count], None

    def rhs(u: np.ndarray, p: Mapping[str, Any]) -> np.ndarray:
        states, f = np.ascontiguousarray(u, dtype=float), np.empty(u.shape)
        d, b = np.asarray(p["D"], dtype=float), np.asarray(p["B"], dtype=float)
        function(states.ctypes.data, d.ctypes.data, d.ndim, b.ctypes.data, b.ndim, f.ctypes.data, u.size // 2)
        return f

    return rhs
