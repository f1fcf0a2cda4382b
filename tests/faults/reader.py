"""A process that reads damaged files and says how that ended, a line each: it may crash or hang, the tests not."""

from __future__ import annotations

import hashlib
import json
import sys
import traceback
import warnings
from pathlib import Path
from typing import Any

import numpy as np

import mjcont as mc
from mjcont.results.formats import load
from mjcont.studies.study import check_study, run_study


def fingerprint(result: Any) -> str:
    """Return a digest of all numbers and words of a result."""
    found = hashlib.sha256(str(result).encode())
    parts = [getattr(result, n, None) for n in ("states", "velocities", "eigenvalues", "residuals", "n_unstable")]
    parts += [c.values for c in getattr(result, "columns", {}).values()]
    for segment in getattr(result, "segments", ()):
        found.update(fingerprint(segment.branch).encode())
    for p in getattr(result, "special_points", ()):
        found.update(repr((p.label, sorted(p.coefficients.items()), p.tolerance, p.index)).encode())
        parts += list(p.vectors.values())
    for part in parts:
        if part is not None:
            found.update(np.ascontiguousarray(part).tobytes())
    return found.hexdigest()


def read_result(path: str, given: Any) -> str:
    """Load a result."""
    return fingerprint(load(path))


def read_journal(path: str, given: Any) -> str:
    """Go on with a sweep."""
    return fingerprint(mc.sweep(mc.load_study(given), out=Path(path).parent, workers=1))


def read_study(path: str, given: Any) -> str:
    """Check a study and, where nothing is wrong, run it."""
    study, problems = check_study(path)
    if problems:
        raise mc.StudyError(problems[0])
    run_study(study, given)
    return ""


def read_model(path: str, given: Any) -> str:
    """Load a model, describe it, and look for a rest."""
    mechanism = mc.Mechanism.from_xml(path)
    str(mechanism)
    mc.find_equilibrium(mechanism)
    return ""


def main() -> None:
    """Answer each line {kind, path, given} with {end, detail}."""
    warnings.simplefilter("ignore")
    kinds = {"result": read_result, "journal": read_journal, "study": read_study, "model": read_model}
    for line in sys.stdin:
        asked = json.loads(line)
        try:
            answer = {"end": "read", "detail": kinds[asked["kind"]](asked["path"], asked.get("given"))}
        except mc.MjcontError as error:
            answer = {"end": "refused", "detail": str(error)}
        except BaseException:
            answer = {"end": "traceback", "detail": traceback.format_exc()}
        sys.__stdout__.write(json.dumps(answer) + "\n")
        sys.__stdout__.flush()


if __name__ == "__main__":
    main()
