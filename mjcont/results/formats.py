"""Every format of result files: `load` reads each by the kind that its file states."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import h5py

from mjcont.arguments import checked
from mjcont.errors import MjcontError, ResultFileError, ResultWarning, warn
from mjcont.outside.sealing import Damaged, opened, refuse_broken_seal
from mjcont.results import histories, loadpaths, sweeps
from mjcont.results.branchfiles import read_branch
from mjcont.results.files import FORMAT_VERSION, Unfit, read_problem
from mjcont.results.model import Model
from mjcont.results.orbits.files import GROUP, read_cycles

# What h5py, json and our own reading raise on files with parts missing or overwritten.
_DAMAGED = (
    LookupError, ValueError, TypeError, AttributeError, ArithmeticError, AssertionError, OSError, RuntimeError,
    MemoryError, MjcontError, Damaged,
)
Reader = Callable[[h5py.File, Any], Any]
# A branch states the kind of its curve instead: "equilibria", "LP locus", "cycles", ...
READERS: Mapping[str, Reader] = {
    histories.KIND: histories.read,
    loadpaths.KIND: loadpaths.read,
    sweeps.KIND: sweeps.read,
}


@checked
def load(path: str | Path, problem: Model | None = None) -> Any:
    """Read a result; a Mechanism is rebuilt from the MJCF in the file unless `problem` is given.

    Raises
    ------
    ResultFileError
        If the file does not exist, is no mjcont result, or has a newer format.
    """
    path = Path(path)
    if not path.is_file():
        raise ResultFileError(f"result file '{path}': no such file")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ResultFileError(f"result file '{path}' cannot be read: {error.strerror or error}") from error
    try:
        f, sealed = opened(data)
    except OSError as error:
        raise ResultFileError(f"result file '{path}' is not an HDF5 file") from error
    except Damaged as error:
        raise ResultFileError(f"result file '{path}' is incomplete or damaged: {error}") from error
    with f:
        try:
            found = _read(f, problem, sealed)
        except Unfit as error:
            raise ResultFileError(f"result file '{path}'{error}") from error
        except _DAMAGED as error:
            raise ResultFileError(f"result file '{path}' is incomplete or damaged: {error}") from error
    if not sealed:
        warn(
            f"result file '{path}' has no checksums (an older mjcont wrote it): damaged numbers would not be noticed",
            ResultWarning,
        )
    return found


def _read(f: h5py.File, problem: Model | None, sealed: bool) -> Any:
    if f.attrs.get("format") != "mjcont":
        raise Unfit(" was not written by mjcont")
    version = int(f.attrs["format_version"])
    if version > FORMAT_VERSION:
        raise Unfit(f" has format version {version}; this mjcont reads up to {FORMAT_VERSION}: upgrade mjcont")
    if not sealed:
        refuse_broken_seal(f)
    read: Reader = READERS.get(str(f.attrs["kind"]), read_cycles if GROUP in f else read_branch)
    return read(f, read_problem(f, problem))
