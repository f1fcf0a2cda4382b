"""Helpers on branches of the classics."""

from __future__ import annotations

import itertools


def regular(branch):
    """Stability words of the rows that are no special points, each run of equal words once."""
    words = [s for s, label in zip(branch.stability, branch.labels, strict=True) if not label]
    return [word for word, _ in itertools.groupby(words)]
