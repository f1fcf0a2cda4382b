"""The eigenvalues along a branch: those that stability needed are known, the others wait until somebody asks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.stability import spectra_at
from mjcont.results.model import Model, model_of


class Spectra:
    """The eigenvalues of a branch's rows.

    Parameters
    ----------
    known : (m,) complex array of each row, None where they are not known.
    compute : returns those of the rows asked for, which are known from then on.
    """

    def __init__(
        self, known: Sequence[Array | None], compute: Callable[[Sequence[int]], Sequence[Array]] | None = None
    ) -> None:
        self._known = list(known)
        self._compute = compute
        self._table: Array | None = None

    @classmethod
    def of(cls, table: Array, compute: Callable[[Sequence[int]], Sequence[Array]] | None = None) -> Spectra:
        """Return the spectra in a `table`."""
        rows = [row[~np.isnan(row)] for row in table]
        return cls([row if row.size else None for row in rows], compute)

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self._known)

    def missing(self, among: Sequence[int] | None = None) -> list[int]:
        """Return the rows, of all or `among` some, whose eigenvalues are not known."""
        return [i for i in (range(len(self)) if among is None else among) if self._known[i] is None]

    def rows(self, indices: Sequence[int]) -> list[Array]:
        """Return the eigenvalues of some rows, computing what is missing among them.

        Raises
        ------
        MjcontError
            If some are missing, and the branch was loaded from a file without its problem.
        """
        missing = self.missing(indices)
        if missing and self._compute is not None:
            for i, found in zip(missing, self._compute(missing), strict=True):
                self._known[i] = found
        known = [self._known[i] for i in indices]
        return [e if e is not None else np.zeros(0, dtype=complex) for e in known]

    def row(self, index: int) -> Array:
        """Return the eigenvalues of a row, computed if they are missing."""
        return self.rows([range(len(self))[index]])[0]

    def complete(self) -> Array:
        """Return the eigenvalues of all rows, (N, m), computing what is missing; NaN where a row has fewer."""
        if self._table is None:
            self.rows(range(len(self)))
            self._compute = None  # it holds the whole curve
            self._table = self.table()
        return self._table

    def table(self) -> Array:
        """Return the eigenvalues that are known, (N, m): NaN where a row has fewer, and all of a row that waits."""
        width = max((len(e) for e in self._known if e is not None), default=0)
        out = np.full((len(self), width), complex(np.nan, np.nan))
        for row, e in zip(out, self._known, strict=True):
            if e is not None:
                row[: len(e)] = e
        out.flags.writeable = False
        return out

    def part(self, first: int, last: int) -> Spectra:
        """Return the spectra of rows first .. last, which are computed here."""
        return Spectra(self._known[first : last + 1], lambda rows: self.rows([first + i for i in rows]))

    def followed_by(self, other: Spectra) -> Spectra:
        """Return these and another branch's, each computed where it was."""
        own = len(self)

        def compute(rows: Sequence[int]) -> list[Array]:
            front, back = [i for i in rows if i < own], [i - own for i in rows if i >= own]
            return [*self.rows(front), *other.rows(back)]

        return Spectra([*self._known, *other._known], compute)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy eigenvalues, all of them: what computes them does not travel."""
        return Spectra, (self.rows(range(len(self))),)


@dataclass(frozen=True, slots=True)
class Late:
    """Computes the eigenvalues of rows of a branch that stability could do without.

    Attributes
    ----------
    states : (N, nq).
    fixed : the parameters that do not vary.
    columns : (N,) values of each free parameter.
    free : their bounds.
    """

    problem: Model | None
    states: Array
    fixed: Mapping[str, float]
    columns: Mapping[str, Array]
    free: Mapping[str, tuple[float, float]]

    def __call__(self, rows: Sequence[int]) -> list[Array]:
        """Return the eigenvalues of rows."""
        problem = model_of(self.problem, "the branch")
        free = [{n: float(c[i]) for n, c in self.columns.items()} for i in rows]
        base = problem.values({**self.fixed, **free[0]})
        values = [{**base, **v} for v in free]
        return [s.eigenvalues for s in spectra_at(problem, self.states[list(rows)], values, self.free)]
