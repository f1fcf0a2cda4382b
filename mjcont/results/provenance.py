"""Where a result comes from: the versions of what computed it, and its model."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib import metadata
from typing import Any


@cache
def _versions() -> tuple[tuple[str, str], ...]:
    """Return the versions of what results depend on."""
    found = [(name, metadata.version(name)) for name in ("mujoco", "numpy", "scipy")]
    try:
        return (*found, ("mjcont", metadata.version("mjcont")))
    except metadata.PackageNotFoundError:
        return (*found, ("mjcont", "not installed"))


def provenance(problem: Any) -> dict[str, str]:
    """Return versions and the model's hash."""
    versions = dict(_versions())
    mjcf = getattr(problem, "mjcf", None)
    if mjcf is not None:
        versions["model_sha256"] = hashlib.sha256(mjcf.encode()).hexdigest()
    return versions
