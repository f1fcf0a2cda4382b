"""Between which points of a curve of many unknowns nothing happens, by proof and without their eigenvalues.

`inertia` proves that no eigenvalue reaches the axis along the matrices interpolated between two points; products of the
Jacobian with one vector, as in `balance`, that none strays from these. What is not proven is left to `balance`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.balance import PROBE, aside, places_between, strays_at
from mjcont.numerics.spectra.abreast import CHANGES, Probe, Tracks
from mjcont.numerics.spectra.inertia import Basis, slope
from mjcont.numerics.spectra.stability import COUNT
from mjcont.numerics.spectra.tracks import FEW, MANY, motion_at
from mjcont.numerics.step.arclength import BEFORE, CurvePoint
from mjcont.numerics.step.notes import Note

_BASIS = Note["_Based"]()
_SEEN = Note["_Seen"]()


@dataclass(frozen=True, slots=True)
class _Based:
    """A basis in which points are seen, and the product J r that shows whether an eigenvalue strays.

    Attributes
    ----------
    lengths : (N,) the lengths of the rows that take each eigenvalue's share out of it.
    """

    basis: Basis
    probe: Probe
    lengths: Array


@dataclass(frozen=True, slots=True)
class _Seen:
    """The matrix of a point in a basis, whether it has its inertia, and the product J r there, (n,)."""

    basis: Basis
    matrix: Array
    keeps: bool
    product: Array


def calm(system: System, old: CurvePoint, new: CurvePoint, settings: Settings) -> bool:
    """Return whether no eigenvalue reaches the axis between two points of a curve of equilibria, as far as is proven.

    The number of unstable eigenvalues at the second is noted then, in place of its spectrum.
    """
    problem, n = system.problem, system.n
    plain = len(system.free) == 1 and not (system.conditions or problem.second_order or problem.nonsmooth)
    if not (plain and FEW <= n <= MANY and new.s > old.s):
        return False
    if old.tangent[n] * new.tangent[n] <= 0.0 or old.sign * new.sign <= 0.0:
        return False
    before = BEFORE.get(old)
    nodes = [old, new] if before is None or not before.s < old.s else [before, old, new]
    if not all(isinstance(p.local.raw_jac, np.ndarray) for p in nodes) or not np.isfinite(new.local.raw_jac).all():
        return False
    for based in _bases(system, old, new):
        if _proven(system, nodes, based, settings):
            _BASIS.put(new, based)
            COUNT.put(new, based.basis.unstable)
            return True
    return False


def _bases(system: System, old: CurvePoint, new: CurvePoint) -> Iterator[_Based]:
    """Yield the bases in which a proof is tried: the one that served last, then that of the new point."""
    last = _BASIS.get(old)
    if last is not None:
        yield last
    motion = motion_at(new)
    own = None if motion is None or motion.modes is None else Basis.of(motion.modes)
    if own is not None:
        right, rows = own.complex
        none = np.zeros((1, 0, system.n, system.n))
        probe = Probe.of(right[None], rows[None], None, system.problem.state_scale, none)
        yield _Based(own, probe, np.sqrt((np.abs(probe.left[0]) ** 2).sum(axis=1)))


def _seen(point: CurvePoint, based: _Based) -> _Seen:
    known, basis = _SEEN.get(point), based.basis
    if known is None or known.basis is not basis:
        jac = point.local.raw_jac
        matrix = basis.seen(jac)
        known = _Seen(basis, matrix, basis.keeps(matrix), jac @ based.probe.vector[0])
        _SEEN.put(point, known)
    return known


def _proven(system: System, nodes: Sequence[CurvePoint], based: _Based, settings: Settings) -> bool:
    """Return whether the matrices between the last two of two or three points are proven to keep their inertia."""
    basis, (old, new) = based.basis, nodes[-2:]
    last, first = _seen(new, based), _seen(old, based)
    if not (last.keeps and first.keeps):
        return False
    product = last.product - first.product
    if len(nodes) > 2:
        before, place = _seen(nodes[0], based), (nodes[0].s - old.s) / (new.s - old.s)
        if not basis.keeps(first.matrix + 0.5 * slope(place, before.matrix, first.matrix, last.matrix)):
            return False
        product = slope(place, before.product, first.product, last.product)
    start, end = basis.values(first.matrix), basis.values(last.matrix)
    if not basis.sums_keep(start, end):
        return False
    along = np.array([first.product, product, last.product - first.product - product])
    count = int(places_between(new.s - old.s, settings.ds_max))
    t = (np.arange(count) + 1.0) / (count + 1.0)
    return count < 1 or not _strays(aside(system, old, new, based.probe.vector[0], t), based, along, t, (start, end))


def _strays(
    beside: Callable[[float], Array], based: _Based, along: Array, t: Array, values: tuple[Array, Array]
) -> bool:
    """Return whether an eigenvalue strays at parts t of a step from `values` at its ends; `along` tells J r there."""
    start, end = values
    apart = beside(PROBE) / PROBE - t[:, None] ** np.arange(3) @ along
    nearest = np.minimum(np.abs(start.real), np.abs(end.real))
    if (based.lengths * np.sqrt((apart**2).sum(axis=1).max()) <= CHANGES * nearest).all():
        return False  # whatever its direction
    secant, none, noise = end - start, np.zeros(len(start)), based.basis.noise
    followed = Tracks(start, end, secant, secant, none, noise).chosen(None)
    return bool((strays_at(beside, replace(based.probe, along=along[None]), t, followed) > 1.0).any())
