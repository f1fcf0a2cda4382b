"""Sparse matrices of which nothing can be computed, and a call of every routine for large problems (`CASES`)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from mjcont.numerics.equations import (
    algebra,
    bends,
    bordered,
    coloured,
    columns,
    differences,
    frozen,
    onfolds,
)
from mjcont.numerics.points import normalform, on_equilibria
from mjcont.numerics.spectra import large
from problems.failing import Bad

# entries of a matrix, on the diagonal and beside it
FILLS = {
    "nan": (math.nan, 0.0), "infinite": (math.inf, 0.0), "zero": (0.0, 0.0), "jordan": (0.0, 1.0),
    "huge": (1e300, -1e300), "tiny": (1e-300, 1e-300), "defective": (-1.0, 1e8),
}  # fmt: skip


@dataclass(frozen=True)
class BadMatrix:
    """A banded matrix with one number on the diagonal and one on each side, and a bad field of as few unknowns."""

    kind: str
    n: int

    @cached_property
    def matrix(self):
        on, beside = FILLS[self.kind]
        bands = [np.full(self.n, on), np.full(self.n - 1, beside), np.full(self.n - 1, -0.5 * beside)]
        return sparse.diags(bands[: 3 if self.n > 1 else 1], [0, 1, -1][: 3 if self.n > 1 else 1], format="csc")

    @cached_property
    def field(self):
        kind = {"tiny": "singular", "jordan": "constant", "defective": "zero"}.get(self.kind, self.kind)
        return Bad(kind, min(self.n, 2), sparse=True)


def on_fold(bad, build):
    """Return the values and gradient of a condition on a fold."""
    b, fold = bad.field, bad.field.fold()
    found = b.condition(lambda: build(fold, b.local))
    return found, build(fold, b.local).gradient(b.local, b.system, b.y)


def found(b, entries):
    """Return a matrix with these entries, by differences that are no numbers."""
    coloured_by = coloured.Coloured.of(sparse.csc_matrix(entries))
    rows = np.full((2 * coloured_by.groups, b.n), math.nan)
    return coloured_by.jacobian(rows, 0.0 * b.v, differences.SECOND_ORDER)


def moved(b, motion):
    """Return the forces of a motion."""
    return motion.forces(b.local, b.v[None], np.ones(1))


def slopes(b, motions):
    """Return the gradient of a condition whose left vectors are zero."""
    return frozen.gradient(b.local, b.system, b.y, motions, np.zeros((2, 2, b.n)))


def crossing(b, kernel):
    """Return the gradient of a branch point's conditions with this kernel."""
    return frozen.crossing(b.local, b.system, b.y, kernel, b.v)


CASES = {
    "algebra.right_singular": lambda m: algebra.right_singular(np.full((m.n + 2, 2), FILLS[m.kind][0])),
    "bends.bend": lambda m: bends.bend(m.field.local, m.field.system, m.field.y, m.field.v, m.field.v, order=2),
    "bends.bends_itself": lambda m: bends.bends_itself(m.field.local),
    "bends.reach_of": lambda m: bends.reach_of(m.field.local, math.nan * m.field.v),
    "bordered.null_pair": lambda m: bordered.null_pair(m.matrix.astype(complex)),
    "bordered.sparse_factors": lambda m: bordered.sparse_factors(m.matrix),
    "coloured.Coloured": lambda m: [found(m.field, part * m.field.sparse_jac) for part in (0.0, 1.0)],
    "columns.weighted": lambda m: columns.weighted(m.matrix, np.zeros(m.n), np.full(m.n, math.inf)),
    "frozen.parameter_slope": lambda m: frozen.parameter_slope(lambda at: float(at.f[0]), m.field.local, "p"),
    "frozen.hopf_motions": lambda m: frozen.hopf_motions(np.zeros((2, m.field.n)), math.nan, 0.0),
    "frozen.Motion": lambda m: moved(m.field, frozen.Motion(0.0 * m.field.v, m.field.v, m.field.v, 1.0)),
    "frozen.crossing": lambda m: crossing(m.field, np.zeros((m.field.n + 1, 2))),
    "frozen.gradient": lambda m: slopes(m.field, frozen.hopf_motions(np.zeros((2, m.field.n)), 0.0, 1.0)),
    "large.nearest": lambda m: [large.nearest(m.matrix, place) for place in (0.0, 1j, math.nan)],
    "large.positive_count": lambda m: large.positive_count(m.matrix),
    "large.rightmost": lambda m: [large.rightmost(m.matrix, symmetric) for symmetric in (False, True)],
    "normalform.bordered_solve": lambda m: normalform.bordered_solve(m.matrix, *np.ones((3, m.n))),
    "normalform.shifted": lambda m: normalform.shifted(m.matrix, math.nan),
    "normalform.solved": lambda m: normalform.solved(m.matrix, np.ones(m.n)),
    "on_equilibria.square_near": lambda m: on_equilibria.square_near(m.field.local, math.nan),
    "onfolds.FoldCoefficient": lambda m: on_fold(m, onfolds.FoldCoefficient),
    "onfolds.DoubleZero": lambda m: on_fold(m, onfolds.DoubleZero),
    "onfolds.Transversality": lambda m: on_fold(m, onfolds.Transversality),
}
PLAIN = {"large.Rightmost"}
BAD = [BadMatrix(kind, n) for kind in FILLS for n in (1, 2, 3, 140)]
