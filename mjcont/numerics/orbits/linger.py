"""Where an orbit lingers as its period grows without bound: the equilibrium of a homoclinic orbit, or none any more.

Near a homoclinic orbit the period grows like -log|p - p0| / lambda at an equilibrium with eigenvalues on both sides;
near a saddle-node on the cycle like |p - p0|^(-1/2), at a place where the equilibria are just gone. Orbits that
shrink to a double zero grow slow in proportion to their rates there.
"""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.algebra import eigenvalues, solve
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.path import Path

_STEPS, _SETTLED = 30, 1e-10
# an equilibrium farther from the orbit's slowest place than this part of its extent is another one
_NEAR = 0.1
# an orbit lingers where its speed is below this part of its mean
_SLOW = 0.05
# eigenvalues nearer to the axis than this part of the orbit's frequency are critical: the orbit is small, not zero
_CRITICAL = 0.03
# so many times longer than the first is an orbit where one that shrinks to a double zero is told from others, and so
# many rounds an eigenvalue makes meanwhile at most
_SLOWED, _ROUNDS = 10.0, 4.0
# an orbit smaller than the first, relative to its sizes, has shrunk to a point; that is no farther from its mean
SMALL, _BESIDE = 1e-5, 0.1


def lingering(flow: Flow, path: Path, values: Values, sizes: Array) -> str:
    """Return a clause on where an orbit is slowest: at which equilibrium, with its eigenvalues."""
    slowest, found = _slowest(flow, path, values, sizes)
    if found is None:
        return f"it lingers near ({_shown(flow, slowest)}), where there is no equilibrium any more"
    every = eigenvalues(first_order(flow, found, values))
    every = every[np.argsort(-every.real, kind="stable")]
    rates = ", ".join(f"{v.real:.4g}" if v.imag == 0.0 else f"{v.real:.4g}{v.imag:+.4g}i" for v in every)
    return f"it lingers at the equilibrium ({_shown(flow, found)}) with eigenvalues {rates} 1/s"


def may_linger(flow: Flow, path: Path, values: Values, sizes: Array) -> bool:
    """Whether an orbit may have a period that grows without bound: slow at a saddle, or where none is any more."""
    _, found = _slowest(flow, path, values, sizes)
    if found is None:
        speed = np.linalg.norm(path.slopes(path.mesh) / sizes, axis=1)
        return float(speed.min()) < _SLOW * float(speed.mean())
    rates = eigenvalues(first_order(flow, found, values))
    return bool(np.isfinite(rates).all() and rates.real.max() > 0.0 > rates.real.min())


def _slowest(flow: Flow, path: Path, values: Values, sizes: Array) -> tuple[Array, Array | None]:
    """Return where an orbit is slowest, and the equilibrium near that place, None where there is none."""
    speed = np.linalg.norm(path.slopes(path.mesh) / sizes, axis=1)
    slowest = path.s[int(np.argmin(speed))]
    found = _equilibrium(flow, slowest, values)
    if found is None or np.abs((found - slowest) / np.maximum(np.ptp(path.s, axis=0), sizes)).max() > _NEAR:
        return slowest, None
    return slowest, found


def deviation(orbits: Orbits, path: Path) -> Array:
    """Return an orbit's states at the mesh less their mean, relative to their sizes, (N + 1, d)."""
    mean = orbits.lengths @ (0.5 * (path.s[1:] + path.s[:-1]))
    found: Array = (path.s - mean - orbits.mesh[:, None] * orbits.shift) / orbits.sizes
    return found


def is_rest(orbits: Orbits, path: Path) -> bool:
    """Whether an orbit of a free period has shrunk to a point."""
    return orbits.own_period and bool(np.abs(deviation(orbits, path)).max() < SMALL)


def shrunk_to(orbits: Orbits, path: Path, values: Values, on_locus: bool) -> str:
    """Return the sentence on a curve whose orbits shrink to a point: what that is, told by its eigenvalues.

    Where equilibria fold there may be none any more beside a small orbit: then its mean tells.
    """
    mean = path.lengths @ (0.5 * (path.s[1:] + path.s[:-1]))
    found = _equilibrium(orbits.flow, mean, values)
    if found is None or not np.abs((found - mean) / orbits.sizes).max() <= _BESIDE:
        found = mean
    every, omega = eigenvalues(first_order(orbits.flow, found, values)), 2.0 * np.pi / path.period
    if not np.isfinite(every).all():
        return "the orbit shrinks to a point"
    critical = every[np.abs(every.real) < _CRITICAL * omega]
    zero = bool((np.abs(critical) < _CRITICAL * omega).any())
    pairs = int(np.count_nonzero(critical.imag > _CRITICAL * omega))
    other = "zero-Hopf point (ZH)" if zero else "double Hopf point (HH)" if pairs > 1 else ""
    return f"the orbit shrinks to a {other or ('generalised Hopf point (GH)' if on_locus else 'Hopf point (HB)')}"


def shrinks_slowly(orbits: Orbits, path: Path, values: Values, first: float) -> bool:
    """Whether an orbit shrinks to a double zero as its period grows beyond bounds, from a `first` one.

    Two eigenvalues of an equilibrium within it are small with its frequency; at one that it lingers at they are not.
    """
    if not path.period > _SLOWED * first:
        return False
    mean = path.lengths @ (0.5 * (path.s[1:] + path.s[:-1]))
    found = _equilibrium(orbits.flow, mean, values)
    if found is None or (np.abs(found - mean) > np.ptp(path.s, axis=0) + _NEAR * orbits.sizes).any():
        return False
    rates = np.sort(np.abs(eigenvalues(first_order(orbits.flow, found, values))))[:2]
    return len(rates) == 2 and bool(rates[1] < 2.0 * np.pi * min(_CRITICAL / first, _ROUNDS / path.period))


def first_order(flow: Flow, state: Array, values: Values) -> Array:
    """Return the matrix of the first-order form at a state (d,), (d, d)."""
    jac: Array = flow.derivatives(state[None], np.zeros(1), values, (), False).jac[0]
    if flow.order == 1:
        return jac
    upper = np.hstack([np.zeros((flow.c, flow.c)), np.eye(flow.c)])
    return np.vstack([upper, jac])


def _equilibrium(flow: Flow, state: Array, values: Values) -> Array | None:
    """Return the equilibrium (d,) that Newton's method finds from a state."""
    x = state.copy()
    x[flow.c :] = 0.0
    for _ in range(_STEPS):
        rates = flow.derivatives(x[None], np.zeros(1), values, (), False)
        step = -solve(rates.jac[0][:, : flow.c], rates.value[0])
        if not np.isfinite(step).all():
            return None
        x[: flow.c] += step
        if np.abs(step / flow.scale[: flow.c]).max() < _SETTLED:
            return x
    return None


def _shown(flow: Flow, state: Array) -> str:
    return ", ".join(f"{v:.4g}" for v in flow.shown(state))
