"""Variants of which nothing can be computed, and a call of every routine for many side by side (`CASES`)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mjcont as mc
from mjcont.numerics.equations import algebra, differences, directions
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import OneByOne
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points import alongside, balance, bundle, calm, events, glance
from mjcont.numerics.search import leastnorm
from mjcont.numerics.spectra import abreast, inertia, spectrum, tracks
from mjcont.numerics.step import arclength
from problems.failing import FIELDS
from problems.fields import by_columns

# what fills the arrays that a routine is given, where it is not a plain number
FILLS = {"nan": math.nan, "infinite": math.inf, "zero": 0.0, "singular": 1.0, "huge": 1e300}
# numbers of rows, of unknowns and of free parameters: none, one and more of each, folds and cusps
SHAPES = [(0, 1, 1), (0, 2, 2), (1, 1, 2), (1, 2, 1), (1, 3, 2), (2, 1, 1), (2, 2, 2), (2, 3, 1)]


@dataclass(frozen=True)
class BadRows:
    """Arrays for some rows at once of one bad number, and variants of a bad field, one a row."""

    kind: str
    count: int
    n: int
    k: int

    @property
    def fill(self):
        return FILLS.get(self.kind, 2.0)

    def of(self, *shape):
        """Return an array of this shape for each row."""
        return np.full((self.count, *shape), self.fill)

    @property
    def v(self):
        return self.of(self.n)

    @property
    def along(self):
        return directions.Directions(np.ones(self.n))

    @cached_property
    def problem(self):
        return mc.VectorField(FIELDS[self.kind], np.zeros(self.n), {"p": 0.0, "q": 1.0})

    @property
    def members(self):
        return np.arange(self.count)

    @property
    def names(self):
        return ("p", "q")[:self.k]

    @property
    def variants(self):
        return OneByOne(self.problem, [self.problem.values()] * 2 * self.count, self.names)

    @property
    def placed(self):
        """The arguments of a bundle: points in one place, free parameters not bounded."""
        free = [[Free(name, -1.0, 1.0, bounded=False) for name in self.names]] * self.count
        return self.problem, self.variants, np.zeros((self.count, self.n)), free, np.zeros((self.count, self.k))

    def begun(self):
        made = bundle.Bundle(*self.placed)
        return made, *made.begin(self.members)

    def in_a_bundle(self):
        """Ask a bundle for everything that it has."""
        made, start, defined = self.begun()
        assert defined.shape == (self.count,)
        made.share(self.members, self.members)
        assert made.value(self.members, made.x, made.y).shape == (self.count, self.n + self.k)
        assert made.change(self.members, start, True).shape == (self.count, self.n + self.k)
        y, coefficient = made.finished(self.members, start, made.x, made.y)
        assert (y.shape, coefficient.shape) == ((self.count, self.k), (self.count,))
        made.moved(made.x, made.y, self.of(self.n + self.k))

    def linearized(self):
        made, start, _ = self.begun()
        there = made.linear(self.members, made.x, made.y)
        start.put(self.members, there.of(self.members))
        assert start.solved(start.value).shape == (self.count, self.n + self.k)
        assert start.sign.shape == (self.count,)

    def differences(self):
        """Take every derivative along bad vectors, of bad values of f."""
        u, n, along = self.v, self.n, self.along
        assert along.polar(u, u)[0].shape == (self.count, 6, n)
        steps = along.along(u), along.far(u), along.mixed(u), along.aside(u)
        rows = [self.of(*s.shape[1:]) for s in steps]
        pair = rows[0], rows[0]
        found = along.slope(rows[0], u), along.curvature(u, rows[0], u), along.thrice(rows[1], u)
        assert {a.shape for a in (*found, along.polarized(u, pair, u, u))} == {(self.count, n)}
        forms = along.form(rows[2], u), along.form(rows[2], u, u), along.third(rows[3], u)
        assert {a.shape for a in forms} == {(self.count, n, n)}

    @property
    def parts(self):
        """Coefficients of a polynomial of matrices along each piece."""
        return self.of(3, self.n, self.n)

    @property
    def tracks(self):
        """Bad eigenvalues along each piece."""
        end = self.v, self.v, self.v == 0.0, self.v
        return abreast.Tracks.matched(end, end)

    def probed(self):
        """Look at what products with bad matrices show, along bad vectors."""
        square, followed = self.of(self.n, self.n), self.tracks
        for mass in (None, square):
            probe = abreast.Probe.of(square, square, mass, np.ones(self.n), self.parts)
            assert probe.strays(self.v, np.full(self.count, 0.5), followed).shape == (self.count,)

    def chain(self, n):
        """Return a curve of a vectorized field of n unknowns, and points of it, all in one place."""
        field = mc.VectorField(by_columns(FIELDS[self.kind]), np.zeros(n), {"p": 0.0}, vectorized=True)
        curve = System(field, field.values(), [Free("p", -1.0, 1.0)])
        x, y, tangent = np.zeros(n), np.zeros(1), np.append(np.zeros(n), 1.0)
        return curve, [
            arclength.CurvePoint(x, y, tangent, 1.0, curve.local(x, y), None, 1e-3 * i) for i in range(3 * self.count)
        ]

    def glanced(self):
        """Glance at a curve."""
        glance.glance(*self.chain(self.n), Settings())

    def calmed(self):
        """Look for a proof that nothing happens between points of many unknowns."""
        curve, chain = self.chain(tracks.FEW)
        for old, new in zip(chain, chain[1:], strict=False):
            calm.calm(curve, old, new, Settings())
            arclength.follows(new, old)

    def seen(self):
        """See bad matrices in the basis of a good one, and take the basis of bad ones."""
        values, one = np.array([1.0 + 1j, 1.0 - 1j, -1.0]), np.eye(3, dtype=complex)
        right = np.array([[1.0, 1.0, 0.0], [1j, -1j, 0.0], [0.0, 0.0, 1.0]])
        good = tracks.Modes(one, values, right, right, np.zeros(3), np.ones(3, dtype=bool))
        basis, bad = inertia.Basis.of(good), np.full((3, 3), self.fill)
        seen = basis.seen(bad)
        assert not basis.keeps(seen)
        assert basis.values(seen).shape == (2,)
        basis.sums_keep(basis.values(seen), basis.values(-seen))
        worse = tracks.Modes(bad, np.full(3, self.fill + 0j), bad + 0j, bad + 0j, np.zeros(3), np.ones(3, dtype=bool))
        assert inertia.Basis.of(worse) is None

    def moved(self):
        found = alongside.move(*self.placed, self.members)
        assert found.x.shape == (self.count, self.n) and found.values.shape == (self.count, self.k)
        assert not found.reached.any()

    def shortest(self):
        """Look for the shortest of vectors with bad equations, with bad bounds and with a bad metric."""
        m, given = self.n, np.full
        ones, wide = np.ones(m), np.full(m, math.inf)
        a, b = given((self.count, m), self.fill), given(self.count, self.fill)
        good, one = np.ones((self.count, m)), np.ones(self.count)
        pairs, within = [(a, one), (good, b), (a, b)], (-ones, ones)
        bounds = [(-wide, wide), within, (0.0 * ones, 0.0 * ones), (ones, wide)]
        metrics = [(np.eye(m), given(m, self.fill)), (given((m, m), self.fill), ones)]
        asked = [(*pair, *bound, 1e-9, None) for pair in pairs for bound in bounds]
        asked += [(*pair, *within, 1e-9, metric) for pair in pairs for metric in metrics]
        asked += [(good, one, given(m, math.nan), ones, 1e-9, None), (good, one, -ones, given(m, math.nan), 1e-9, None)]
        for question in asked:
            found = leastnorm.least_norm(*question)
            assert found.u.shape == found.wanted.shape == (m,)
            assert found.left.shape == found.left_unbounded.shape == (self.count,)


CASES = {
    "abreast.Probe": BadRows.probed,
    "abreast.Tracks": lambda b: (b.tracks.near, b.tracks.at(0.5), b.tracks.chosen(b.members)),
    "abreast.coefficients": lambda b: abreast.coefficients(b.of(3), b.parts),
    "abreast.singular_at": lambda b: abreast.singular_at(b.parts),
    "abreast.within": lambda b: abreast.within(b.v + 0j),
    "algebra.determinant_signs": lambda b: algebra.determinant_signs(b.of(b.n, b.n)),
    "algebra.kernels": lambda b: algebra.kernels(b.of(b.n, b.n + 2)),
    "algebra.solve_each": lambda b: algebra.solve_each(b.of(b.n, b.n), b.v),
    "alongside.move": BadRows.moved,
    "bundle.Bundle": BadRows.in_a_bundle,
    "bundle.Linear": BadRows.linearized,
    "directions.Directions": BadRows.differences,
    "directions.corrected": lambda b: (
        directions.corrected(b.v, b.of(), b.v), directions.corrected(b.of(b.n, b.n), b.v, b.v)
    ),
    "directions.dot": lambda b: directions.dot(b.v, b.v),
    "directions.orient": lambda b: directions.orient(b.v),
    "directions.weighted": lambda b: directions.weighted(np.full(3, b.fill), b.of(3, b.n)),
    "balance.places_between": lambda b: balance.places_between(b.v, b.fill),
    "balance.aside": BadRows.calmed,
    "balance.strays_at": BadRows.calmed,
    "calm.calm": BadRows.calmed,
    "differences.jacobians_from_rows": lambda b: differences.jacobians_from_rows(
        b.of(4 * b.n, b.n), np.ones(b.n), differences.FOURTH_ORDER
    ),
    "events.cubic": lambda b: events.cubic(b.fill, b.v, b.v, b.v),
    "glance.glance": BadRows.glanced,
    "inertia.Basis": BadRows.seen,
    "inertia.slope": lambda b: inertia.slope(b.fill, b.v, b.v, b.v),
    "leastnorm.least_norm": BadRows.shortest,
    "problem.OneByOne": lambda b: b.variants.residuals(b.members, b.of(2, b.n), b.of(2, b.k)),
    "spectrum.first_order_spectra": lambda b: spectrum.first_order_spectra(b.of(b.n, b.n), b.v + 0j),
    "spectrum.pair_counts": lambda b: spectrum.pair_counts(b.v + 0j, b.v),
    "tracks.eigenvalue_noise": lambda b: tracks.eigenvalue_noise(b.v, b.of(b.n, b.n)),
    "tracks.vanishes": lambda b: tracks.vanishes(b.v, b.of(b.n, b.n)),
}
# records, and what others derive from
PLAIN = {"alongside.Moved", "leastnorm.Shortest", "problem.Variants"}
BAD = [BadRows(kind, count, n, k) for kind in FIELDS for count, n, k in SHAPES]
