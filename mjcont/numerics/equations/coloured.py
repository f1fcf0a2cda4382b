"""Sparse Jacobians by differences: columns that share no row are moved together.

Source: Curtis, Powell, Reid, On the estimation of sparse Jacobian matrices, J. Inst. Maths Applics 13 (1974) 117; the
groups are those of a greedy colouring of the columns, those with most neighbours first (Coleman, More, SIAM J. Numer.
Anal. 20 (1983) 187).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.problem import Array, Stencil


@dataclass(frozen=True, slots=True)
class Coloured:
    """Where df/dx may have entries, and which columns are moved together.

    Attributes
    ----------
    pattern : (n_f, n) csc matrix.
    group : (n,) number of each column's group.
    """

    pattern: Any
    group: Array

    @classmethod
    def of(cls, pattern: Any) -> Coloured:
        """Return a pattern, a sparse matrix of any entries, with groups of columns."""
        ones = sparse.csc_matrix(pattern, copy=True)
        ones.sum_duplicates()
        ones.data = np.ones(ones.nnz, dtype=np.int32)
        beside = (ones.T @ ones).tocsc()
        group = np.full(ones.shape[1], -1)
        for j in np.argsort(-np.diff(beside.indptr), kind="stable").tolist():
            near = group[beside.indices[beside.indptr[j] : beside.indptr[j + 1]]]
            taken = np.zeros(len(near) + 1, dtype=bool)
            taken[near[(near >= 0) & (near <= len(near))]] = True
            group[j] = int(np.argmin(taken))
        return cls(ones, group)

    @property
    def groups(self) -> int:
        """How many groups there are."""
        return int(self.group.max(initial=-1)) + 1

    def steps(self, scale: Array, rule: Stencil) -> Array:
        """Return the tangent steps of all groups, (len(offsets) * groups, n)."""
        whole = np.zeros((self.groups, len(scale)))
        whole[self.group, np.arange(len(scale))] = rule.step * scale
        return np.concatenate([o * whole for o in rule.offsets])

    def jacobian(self, rows: Array, scale: Array, rule: Stencil) -> Any:
        """Combine f at `steps` into df/dx, sparse, with the pattern's entries, zeros among them."""
        blocks = rows.reshape(len(rule.offsets), self.groups, -1)
        slopes = np.tensordot(np.asarray(rule.weights), blocks, axes=1) / rule.step
        column = np.repeat(np.arange(len(scale)), np.diff(self.pattern.indptr))
        data = slopes[self.group[column], self.pattern.indices] / scale[column]
        return sparse.csc_matrix((data, self.pattern.indices, self.pattern.indptr), shape=self.pattern.shape)
