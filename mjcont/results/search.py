"""What a search for equilibria returns: the equilibria in order of energy, symmetric copies named, and a status."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Any, overload

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.spectrum import Spectrum
from mjcont.results.model import Model, units
from mjcont.results.points import Point, show
from mjcont.results.text import Cells, Shown, Tabular

_SAME_ENERGY = 1e-7
_SAME_EIGENVALUE = 1e-5
_SHOWN = 6


@dataclass(frozen=True, slots=True, repr=False)
class Equilibrium(Point):
    """An equilibrium that a search has found.

    Attributes
    ----------
    label : "E1", "E2", ... in order of energy.
    energy : potential energy of gravity, springs and bushes, in J; NaN for a vector field.
    mirror_of : label of the first equilibrium with equal energy and eigenvalues but another state, or empty.
    hits : number of starts, drawn by chance, that led to it.
    """

    label: str = ""
    energy: float = math.nan
    mirror_of: str = ""
    hits: int = 0

    def __str__(self) -> str:
        """Return label, stability, energy and observables."""
        energy = "" if math.isnan(self.energy) else f", {self.energy:.7g} J"
        mirror = f", mirror of {self.mirror_of}" if self.mirror_of else ""
        return f"{self.label}{mirror}{energy}: {Point.__str__(self)}"


@dataclass(frozen=True, slots=True)
class Account:
    """What a search did.

    Attributes
    ----------
    starts, converged : number of starts drawn by chance, and of those that reached an equilibrium anywhere.
    fresh : equilibria of the region that were new in the last quarter of these starts.
    everywhere : number of equilibria, those outside the region included.
    degenerate : number of those whose J is singular.
    index_sum : sum of the signs of det(-J) over all of them where it must vanish, else None.
    bounded : whether a region was given.
    """

    starts: int
    converged: int
    fresh: int
    everywhere: int
    degenerate: int
    index_sum: int | None
    bounded: bool


@dataclass(frozen=True, slots=True, repr=False)
class Equilibria(Tabular, Shown, Sequence[Equilibrium]):
    """The equilibria that a search has found, in order of energy.

    Attributes
    ----------
    problem : the model.
    points : tuple of Equilibrium
    account : what the search did.
    ended : why it ended early, or empty.
    notes : sentences on the problem.
    shown : observables that the table shows first: those of the region.
    """

    problem: Model
    points: tuple[Equilibrium, ...]
    account: Account
    ended: str = ""
    notes: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()

    def __len__(self) -> int:
        """Return the number of equilibria."""
        return len(self.points)

    def __iter__(self) -> Iterator[Equilibrium]:
        """Iterate over the equilibria."""
        return iter(self.points)

    @overload
    def __getitem__(self, index: int) -> Equilibrium: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Equilibrium, ...]: ...
    @checked
    def __getitem__(self, index: int | slice) -> Equilibrium | tuple[Equilibrium, ...]:
        """Return an equilibrium, or several."""
        return self.points[index]

    def point(self, label: str) -> Equilibrium:
        """Return the equilibrium with a label such as "E1"."""
        for p in self.points:
            if p.label == label:
                return p
        raise unknown_name("equilibrium", label, [p.label for p in self.points])

    def column(self, name: str) -> Array:
        """Return a parameter, an observable or "energy" of every equilibrium, SI and radians."""
        return np.array([p.energy if name == "energy" else p[name] for p in self.points])

    def plot(self, x: str = "", y: str = "energy", *, ax: Any = None) -> Any:
        """Draw the equilibria by two columns (default the energy over an observable) and return the axes."""
        from mjcont.drawing.charts import draw_equilibria

        known = [*self.problem.parameters, *self.problem.observables, "energy"]
        names = (x or (*self.shown, *self.problem.observables)[0], y)
        for name in names:
            if name not in known:
                raise unknown_name("column", name, known)
        return draw_equilibria(self, *names, ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        words = {"label": "label", "mirror of": "mirror_of", "stability": "stability", "unstable": "n_unstable",
                 "hits": "hits"}
        yield from ((head, "", [getattr(p, name) for p in self.points]) for head, name in words.items())
        yield "energy", "J", self.column("energy")
        known = units(self.problem)
        yield from ((n, known[n], self.column(n)) for n in (*self.problem.parameters, *self.problem.observables))
        for i, (name, unit) in enumerate(self.problem.state_labels):
            yield f"state {name}", unit, np.array([p.state[i] for p in self.points])

    @property
    def stable(self) -> tuple[Equilibrium, ...]:
        """The equilibria that are stable."""
        return tuple(p for p in self.points if p.stability == "stable")

    @property
    def interrupted(self) -> bool:
        """Whether the user stopped the search."""
        return self.ended.startswith("interrupted")

    @property
    def status(self) -> str:
        """What the search did and what speaks for the list being complete, in sentences."""
        a = self.account
        count = f"{len(self)} equilibri{'um' if len(self) == 1 else 'a'}" if len(self) else "no equilibrium"
        where = f" in the region ({a.everywhere} in all)" if a.bounded else ""
        parts = [f"{count} found{where}: {a.converged} of {a.starts} starts converged"]
        if len(self):
            late = "none" if a.fresh == 0 else str(a.fresh)
            seldom = sum(p.hits < 2 for p in self.points)
            which = "each" if not seldom else f"all but {seldom}"
            parts.append(f"{late} of these new in the last quarter of the starts, {which} reached from several")
        if a.index_sum is not None and a.everywhere:
            parts.append(
                "their indices add up to 0, as they must"
                if a.index_sum == 0
                else f"their indices add up to {a.index_sum} instead of 0: some are missing or degenerate"
            )
        if a.degenerate:
            parts.append(f"{a.degenerate} of all are degenerate (singular stiffness)")
        return "; ".join([*parts, *([self.ended] if self.ended else [])])

    def __str__(self) -> str:
        """Return a table of the equilibria and the status."""
        lines = [f"{self.problem.name}: {self.status}"]
        if self.points:
            rows = _table(self.points, self.shown)
            widths = [max(len(r[k]) for r in rows) for k in range(len(rows[0]))]
            lines += ["  " + "  ".join(c.rjust(w) for c, w in zip(r, widths, strict=True)).rstrip() for r in rows]
        return "\n".join([*lines, *(f"  note: {n}" for n in self.notes)])


def _table(points: Sequence[Equilibrium], first: Sequence[str]) -> list[list[str]]:
    """Return the cells of the table that is printed, the heading first."""
    names = list(dict.fromkeys([*first, *points[0].observables]))[: max(_SHOWN, len(first))]
    with_energy = not all(math.isnan(p.energy) for p in points)
    with_mirror = any(p.mirror_of for p in points)
    head = ["", "stability", "unstable", *(["energy [J]"] if with_energy else []), *names]
    rows = [[*head, *(["mirror of"] if with_mirror else [])]]
    for p in points:
        cells = [p.label, p.stability, str(p.n_unstable), *([f"{p.energy:.6g}"] if with_energy else [])]
        cells += [show(p.observables[n], p.units.get(n, ""), 5) for n in names]
        rows.append([*cells, *([p.mirror_of] if with_mirror else [])])
    return rows


def same_spectrum(a: Point | Spectrum, b: Point | Spectrum) -> bool:
    """Whether two equilibria have equal eigenvalues, to what differences allow."""
    if len(a.eigenvalues) != len(b.eigenvalues):
        return False
    size = max(float(np.max(np.abs(a.eigenvalues), initial=0.0)), 1e-300)
    real = np.max(np.abs(np.sort(a.eigenvalues.real) - np.sort(b.eigenvalues.real)), initial=0.0)
    imag = np.max(np.abs(np.sort(a.eigenvalues.imag) - np.sort(b.eigenvalues.imag)), initial=0.0)
    return bool(max(real, imag) <= _SAME_EIGENVALUE * size)


def gather(
    problem: Model,
    points: Sequence[Point],
    hits: Sequence[int],
    energies: Array,
    ended: str,
    account: Account,
    notes: tuple[str, ...],
    shown: tuple[str, ...],
) -> Equilibria:
    """Return the result of a search: equilibria in order of energy, those of equal energy by their state."""
    span = float(np.ptp(energies)) if len(points) else 0.0
    tolerance = _SAME_ENERGY * max(span, float(np.max(np.abs(energies), initial=0.0)) * 1e-3, 1e-300)
    levels = np.round(energies / (10.0 * tolerance)) if np.all(np.isfinite(energies)) else np.zeros(len(points))
    order = sorted(range(len(points)), key=lambda i: (levels[i], *np.round(points[i].state, 6)))
    found: list[Equilibrium] = []
    for place, i in enumerate(order, 1):
        p, energy = points[i], float(energies[i])
        copies = (
            q.label
            for q in found
            if not q.mirror_of and not abs(q.energy - energy) > 10.0 * tolerance and same_spectrum(p, q)
        )
        common = {f.name: getattr(p, f.name) for f in fields(Point)}
        found.append(
            Equilibrium(**common, label=f"E{place}", energy=energy, mirror_of=next(copies, ""), hits=int(hits[i]))
        )
    return Equilibria(problem, tuple(found), account, ended, notes, shown)
