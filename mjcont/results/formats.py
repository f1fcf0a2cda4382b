"""Every format of result files: `load` reads each by the kind that its file states."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import h5py

from mjcont.errors import MjcontError, ResultFileError
from mjcont.results import histories, loadpaths, sweeps
from mjcont.results.branchfiles import read_branch
from mjcont.results.files import FORMAT_VERSION, read_problem
from mjcont.results.model import Model

# What h5py, json and our own reading raise on files with parts missing or overwritten.
_DAMAGED = (KeyError, IndexError, ValueError, TypeError, AttributeError, OSError, RuntimeError, MjcontError)
Reader = Callable[[h5py.File, Any], Any]
# A branch states the kind of its curve instead: "equilibria", "LP locus", ...
READERS: Mapping[str, Reader] = {
    histories.KIND: histories.read,
    loadpaths.KIND: loadpaths.read,
    sweeps.KIND: sweeps.read,
}


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
        f = h5py.File(path, "r")
    except OSError as error:
        raise ResultFileError(f"result file '{path}' is not an HDF5 file") from error
    with f:
        try:
            if f.attrs.get("format") != "mjcont":
                raise ResultFileError(f"result file '{path}' was not written by mjcont")
            version = int(f.attrs["format_version"])
            if version > FORMAT_VERSION:
                raise ResultFileError(
                    f"result file '{path}' has format version {version}; this mjcont reads up to "
                    f"{FORMAT_VERSION}: upgrade mjcont"
                )
            read: Reader = READERS.get(str(f.attrs["kind"]), read_branch)
            return read(f, read_problem(f, problem))
        except ResultFileError:
            raise
        except _DAMAGED as error:
            raise ResultFileError(f"result file '{path}' is incomplete or damaged: {error}") from error
