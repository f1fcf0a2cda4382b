"""The dynamic check beside periodic orbits, and beside rests of vector fields.

Motions that begin beside an orbit, at both sides along each coordinate, are followed for a period by an explicit
Runge-Kutta method; half their differences are the monodromy matrix, free of even terms. Its largest eigenvalue is held
against the largest multiplier. Of a free orbit the direction of motion is taken out, whose eigenvalue is 1.

Beside a rest, the difference of two motions along the critical eigenvector of J grows as p^H du, exactly at its rate.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.curves.collect import Amount
from mjcont.motion.integrating import follow
from mjcont.numerics.equations.algebra import dense
from mjcont.numerics.equations.problem import Array
from mjcont.oscillation.walks import flow_for
from mjcont.results.branch import Branch
from mjcont.results.certificates import CONFIRMED, CONTRADICTED, UNRESOLVED, Check
from mjcont.results.model import model_of
from mjcont.results.orbits import CycleBranch, Orbit

_RTOL, _E_FOLDS, _SAMPLES = 1e-9, 2.0, 64
# beside orbits disturbances are larger: differences of motions keep this much less of their digits
_LARGER = 100.0
# multipliers below this are nothing, as far as differences tell; what an orbit that closes is off by, relative
_NOTHING, _CLOSES = 1e-4, 1e-5


def check_of(
    branch: Branch, row: int, s: complex, rate: float, time: float, verdict: str, sentence: str
) -> Check:
    """Return the check of a row whose critical eigenvalue, or exponent, is s."""
    parameters = {name: float(branch[name][row]) for name in branch.free}
    word = str(branch.stability[row])
    return Check(row, branch.labels[row], parameters, word, s, float(rate), float(time), verdict, sentence)


def check_beside(
    branch: Branch, rows: Sequence[int], amplitude: float, tolerance: float, resolution: float, max_steps: int,
    progress: Amount | None = None,
) -> list[Check]:
    """Check rows of a curve of orbits, or of rests of a vector field."""
    checks = []
    for row in rows:
        if isinstance(branch, CycleBranch):
            checks.append(_check_orbit(branch, row, _LARGER * amplitude, tolerance, resolution, max_steps))
        else:
            checks.append(_check_rest(branch, row, amplitude, tolerance, resolution, max_steps))
        if progress is not None:
            progress(len(checks), len(rows))
    return checks


# -- beside orbits --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Beside:
    """What motions beside an orbit tell: the size of the largest multiplier, how far the orbit is from closing."""

    largest: float
    open: float


def _check_orbit(
    branch: CycleBranch, row: int, amplitude: float, tolerance: float, resolution: float, max_steps: int
) -> Check:
    orbit, word = branch.orbits[row], str(branch.stability[row])
    own = orbit.multipliers[orbit.own]
    largest = complex(own[np.argmax(np.abs(own))]) if len(own) else 0.0j
    size = max(abs(largest), 1e-300)
    s = complex(math.log(size), math.atan2(largest.imag, largest.real)) / orbit.period
    if word == "marginal" or abs(math.log(size)) < resolution:
        why = f"a multiplier is on the unit circle within its noise: |mu| = {size:.9g}"
        return check_of(branch, row, s, math.nan, 0.0, UNRESOLVED, why)
    found = _measure(orbit, amplitude, max_steps)
    if found is None:
        why = f"motions beside it were not followed through the period: they diverge, or take over {max_steps} steps"
        return check_of(branch, row, s, math.nan, 0.0, UNRESOLVED, why)
    rate = math.log(max(found.largest, 1e-300)) / orbit.period
    told = (f"motions beside it {'grow' if rate > 0 else 'shrink'} to {found.largest:.6g} of their size in a period, "
            f"the largest multiplier is {size:.6g}")
    same = (found.largest > 1.0) == (word == "unstable")
    close = abs(rate - s.real) <= tolerance * abs(s.real) or max(found.largest, size) < _NOTHING
    if found.open > _CLOSES * max(1.0, size):
        told += f"; the motion on it misses its start by {found.open:.1e}"
        close = False
    return check_of(branch, row, s, rate, orbit.period, CONFIRMED if same and close else CONTRADICTED, told)


def _measure(orbit: Orbit, amplitude: float, max_steps: int) -> _Beside | None:
    """Return what motions beside an orbit tell, None where they cannot be followed for a period."""
    flow = flow_for(model_of(orbit.problem, "the orbit"), orbit.forcing, orbit.chart)
    d, c, values = flow.d, flow.c, dict(orbit.parameters)
    sizes = np.maximum(flow.scale, np.ptp(orbit.path.s, axis=0))
    start = orbit.path.s[0]
    moved = np.concatenate([start[None], *(start + sign * amplitude * np.diag(sizes) for sign in (1.0, -1.0))])

    def field(t: float, y: Array) -> Array:
        states = y.reshape(-1, d)
        rates = flow.rates(states, np.full(len(states), t / orbit.period), values)
        found: Array = rates if flow.order == 1 else np.hstack([states[:, c:], rates])
        return found.ravel()

    with np.errstate(all="ignore"):
        ends = np.array([0.0, orbit.period])
        atol = _RTOL * np.tile(sizes, len(moved)) * amplitude
        run = follow(field, moved.ravel(), ends, _RTOL, atol, max_steps, stiff=False)
        if run.ended == "interrupted":
            raise KeyboardInterrupt
        if run.ended != "done":
            return None
        last = run.states[-1].reshape(-1, d)
        speed = field(0.0, start) / sizes
    shift = orbit.shift if len(orbit.shift) else np.zeros(d)
    monodromy = ((last[1 : d + 1] - last[d + 1 :]) / (2.0 * amplitude * sizes)).T
    if orbit.trivial >= 0:
        across = np.linalg.svd(speed[None])[2][1:]  # rows across the direction of motion
        monodromy = across @ monodromy @ across.T
    largest = float(np.abs(np.linalg.eigvals(monodromy)).max()) if len(monodromy) else 0.0
    return _Beside(largest, float(np.abs((last[0] - start - shift) / sizes).max()))


# -- beside rests of vector fields ----------------------------------------------------------------------------


def _check_rest(
    branch: Branch, row: int, amplitude: float, tolerance: float, resolution: float, max_steps: int
) -> Check:
    field = branch.model
    eigenvalues = branch.spectra.row(row)
    s = complex(eigenvalues[np.argmax(eigenvalues.real)])
    if branch.stability[row] == "marginal" or s.real == 0.0:
        return check_of(branch, row, s, math.nan, 0.0, UNRESOLVED,
                        "classified as marginal: the eigenvalue is on the axis within its noise")
    x, values = branch.states[row], field.values(branch.parameters_at(row))
    jac = dense(field.linearize(x, values, (), accurate=True).jac)
    found, right = np.linalg.eig(jac)
    k = int(np.argmin(np.abs(found - s)))
    left = np.linalg.svd((jac - found[k] * np.eye(len(x))).conj().T)[2][-1].conj()
    q = right[:, k].real if np.abs(right[:, k].real).max() > 1e-3 else right[:, k].imag
    q = amplitude * q / np.abs(q / field.typical).max()
    times = np.linspace(0.0, _E_FOLDS / abs(s.real), _SAMPLES + 1)
    n = len(x)

    def both(t: float, y: Array) -> Array:
        return np.concatenate([field.residual(y[:n], values), field.residual(y[n:], values)])

    with np.errstate(all="ignore"):
        atol = _RTOL * amplitude * np.tile(field.typical, 2)
        run = follow(both, np.concatenate([x + q, x - q]), times, _RTOL, atol, max_steps, stiff=False)
        if run.ended == "interrupted":
            raise KeyboardInterrupt
        away = np.log(np.abs(0.5 * (run.states[:, :n] - run.states[:, n:]) @ left.conj()))
    if len(away) < 3 or abs(s.real) * run.times[-1] < resolution or not np.isfinite(away).all():
        return check_of(branch, row, s, math.nan, run.times[-1], UNRESOLVED,
                        f"its motions were not followed for long enough: {max_steps} steps, or they diverge")
    rate = float(np.polyfit(run.times, away, 1)[0])
    told = (f"motions {'grow' if rate > 0 else 'decay'} at {rate:.6g} /s over {run.times[-1]:.3g} s, the eigenvalue's "
            f"real part is {s.real:.6g} /s")
    same = (rate > 0) == (branch.stability[row] == "unstable")
    close = abs(rate - s.real) <= tolerance * abs(s.real)
    return check_of(branch, row, s, rate, run.times[-1], CONFIRMED if same and close else CONTRADICTED, told)
