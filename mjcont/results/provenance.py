"""Where a result comes from: the versions of what computed it, and its model."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib import metadata

from mjcont.results.model import Model


@cache
def _versions() -> tuple[tuple[str, str], ...]:
    """Return the versions of what results depend on."""
    found = [(name, metadata.version(name)) for name in ("mujoco", "numpy", "scipy")]
    try:
        return (*found, ("mjcont", metadata.version("mjcont")))
    except metadata.PackageNotFoundError:
        return (*found, ("mjcont", "not installed"))


def provenance(problem: Model | None) -> dict[str, str]:
    """Return versions and the model's hash."""
    versions = dict(_versions())
    if problem is not None and problem.mjcf is not None:
        versions["model_sha256"] = hashlib.sha256(problem.mjcf.encode()).hexdigest()
    return versions
