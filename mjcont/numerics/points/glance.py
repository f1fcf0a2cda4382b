"""A glance at many pieces of a curve at once: between which of its points nothing lies, as `look` would find by itself.

Direction and orientation are the same at both ends, no eigenvalue reaches the axis between them as far as matrices and
eigenvalues tell (`abreast`), and none strays from what they tell. What is not so clear is left to `look`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mjcont.numerics.equations.algebra import eigenvectors, inverses
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.balance import PROBE, places_between
from mjcont.numerics.points.events import cubic
from mjcont.numerics.points.looking import CALM
from mjcont.numerics.spectra.abreast import Probe, Tracks, coefficients, singular_at, within
from mjcont.numerics.spectra.spectrum import first_order_spectra, pair_counts
from mjcont.numerics.spectra.stability import SPECTRUM
from mjcont.numerics.spectra.tracks import DEFECTIVE, FEW, eigenvalue_noise, vanishes
from mjcont.numerics.step.arclength import BEFORE, CurvePoint


def glance(system: System, chain: Sequence[CurvePoint], settings: Settings) -> None:
    """Note between which successive points of a curve of equilibria nothing lies, and what their spectra are.

    For smooth systems of first order that are evaluated side by side; of others nothing is noted.
    """
    problem = system.problem
    fits = len(system.free) == 1 and not (system.conditions or problem.second_order or problem.nonsmooth)
    if not (fits and problem.n < FEW and problem.side_by_side(system.names[0])) or len(chain) < 2:
        return
    before = BEFORE.get(chain[0])
    nodes = list(chain) if before is None else [before, *chain]
    jacs = np.array([p.local.raw_jac for p in nodes])
    if not np.isfinite(jacs).all():
        return
    glimpse = _Glimpse(system, nodes, jacs, settings)
    for point, spectrum in zip(nodes, glimpse.spectra, strict=True):
        if not SPECTRUM.known(point):
            SPECTRUM.put(point, spectrum)
    for i in np.flatnonzero(glimpse.calm()).tolist():
        CALM.put(nodes[i + 2], nodes[i + 1])


class _Glimpse:
    """Points of a curve side by side: the pieces from the second point on have a point before them."""

    def __init__(self, system: System, nodes: Sequence[CurvePoint], jacs: Array, settings: Settings) -> None:
        self.system, self.settings, self.jacs = system, settings, jacs
        self.s = np.array([p.s for p in nodes])
        self.states, self.coordinates = np.array([p.x for p in nodes]), np.array([p.y for p in nodes])
        self.tangents, self.signs = np.array([p.tangent for p in nodes]), np.array([p.sign for p in nodes])
        self.values, self.right = eigenvectors(jacs)
        self.values = self.values.astype(complex)
        self.rows = inverses(self.right)  # left vectors, conjugate, with w* v = 1
        self.spectra = first_order_spectra(jacs, self.values)

    def calm(self) -> Array:
        """Return for each piece with a point before it whether nothing lies within, (m - 2,)."""
        lengths = np.diff(self.s)
        along, pairs = self.tangents[:, self.system.n], self._pairs()
        unstable = np.array([s.n_unstable for s in self.spectra])
        same = (along[1:] * along[:-1] > 0.0) & (self.signs[1:] * self.signs[:-1] > 0.0)
        same &= (np.diff(pairs) == 0) & (np.abs(np.diff(unstable)) <= 1)
        clear = self._clear()
        found: Array = (same & clear[1:] & clear[:-1])[1:] & (lengths[1:] > 0.0) & (lengths[:-1] > 0.0)
        chosen = np.flatnonzero(found)
        if len(chosen):
            found[chosen] = self._nothing(chosen + 1)
        return found

    def _pairs(self) -> Array:
        """Return the number of pairs of eigenvalues with positive sum at each point."""
        ev, noise = (np.array([getattr(s, name) for s in self.spectra]) for name in ("eigenvalues", "noise"))
        return pair_counts(ev, noise)

    def _clear(self) -> Array:
        """Return at which points no eigenvalue vanishes, and all can be told apart."""
        lengths = np.sqrt((np.abs(self.rows) ** 2).sum(axis=2))
        found: Array = (lengths < 1.0 / DEFECTIVE).all(axis=1) & ~vanishes(self.values, self.jacs).any(axis=1)
        return found

    def _nothing(self, starts: Array) -> Array:
        """Return which pieces, by their first points, no eigenvalue reaches the axis in or strays to it."""
        around = starts[:, None] + np.array([-1, 0, 1])
        lengths = self.s[starts + 1] - self.s[starts]
        parts = coefficients((self.s[around] - self.s[starts][:, None]) / lengths[:, None], self.jacs[around])
        followed = Tracks.matched(
            self._end(starts, parts[:, 1]), self._end(starts + 1, parts[:, 1] + 2.0 * parts[:, 2])
        )
        found = np.logical_not(within(singular_at(parts)).any(axis=1) | followed.near.any(axis=1))
        counts = np.where(found, np.maximum(places_between(lengths, self.settings.ds_max), 0.0), 0.0).astype(int)
        pieces = np.repeat(np.arange(len(starts)), counts)
        if len(pieces):
            firsts = np.repeat(np.cumsum(counts) - counts, counts)
            t = (np.arange(len(pieces)) - firsts + 1.0) / (counts[pieces] + 1.0)
            found[pieces[self._strays(starts[pieces], t, parts[pieces], followed.chosen(pieces)) > 1.0]] = False
        return found

    def _end(self, points: Array, changes: Array) -> tuple[Array, Array, Array, Array]:
        """Return eigenvalues at points, and their slopes for matrices that change by so much."""
        slopes = ((self.rows[points] @ changes) * self.right[points].transpose(0, 2, 1)).sum(axis=2)
        values = self.values[points]
        return values, slopes, np.isfinite(slopes), eigenvalue_noise(values, self.jacs[points])

    def _strays(self, starts: Array, t: Array, parts: Array, followed: Tracks) -> Array:
        """Return by how much an eigenvalue strays at places in pieces."""
        system, ends = self.system, starts + 1
        probe = Probe.of(self.right[starts], self.rows[starts], None, system.problem.state_scale, parts)
        chords = system.chords(self.states, self.coordinates)[starts]
        lengths = (self.s[ends] - self.s[starts])[:, None]
        steps = cubic(t[:, None], chords, lengths * self.tangents[starts], lengths * self.tangents[ends])
        states, coordinates = system.move_each(self.states[starts], self.coordinates[starts], steps)

        def beside(step: float) -> Array:
            return system.residuals_at(system.problem.retract_each(states, step * probe.vector), coordinates)

        ahead = beside(PROBE)
        shares = probe.strays(ahead / PROBE, t, followed)
        if (shares > 1.0).any():  # f is nearly zero at the place itself; the other side makes sure
            shares = np.minimum(shares, probe.strays((ahead - beside(-PROBE)) / (2.0 * PROBE), t, followed))
        return shares
