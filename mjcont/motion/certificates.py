"""The dynamic check of stability: motions beside an equilibrium grow or decay as its critical eigenvalue says.

Near an equilibrium M dq'' + C dq' + K dq = 0. For an eigenvalue s with right vector q and left vector p of
s^2 M + s C + K, the projection

    a(t) = p^H [(s M + C) dq + M dq']      obeys exactly      a' = s a,

whatever else moves. Two motions start at x + e q and x - e q; half their difference is free of the equilibrium's own
error and of even nonlinear terms. The slope of log |a| is the measured rate, held against Re s.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.curves.continuation import hold_rigid_modes
from mjcont.errors import MjcontError, ParameterError
from mjcont.mechanism.batches import load_side
from mjcont.mechanism.inputs import DataInputs
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.quiet import quiet, quiet_data
from mjcont.motion.beside import check_beside, check_of
from mjcont.motion.stepping import INTEGRATORS
from mjcont.numerics.equations.algebra import full, singular
from mjcont.numerics.equations.problem import Array, Pencil
from mjcont.numerics.spectra.spectrum import quadratic_eigenvalues
from mjcont.results.branch import Branch
from mjcont.results.certificates import CONFIRMED, CONTRADICTED, UNRESOLVED, Certificate, Check

_E_FOLDS = 2.0
_SAMPLES = 64
_LEAST_STEPS = 512
# |s| h of the fastest mode: half of what RK4 bears
_FASTEST = 1.4
# what RK4's own damping of an oscillation may take of the rate
_DAMPING_SHARE = 2e-3
_DEPENDENT = 1e-9
_SHRINKS = (1.0, 1e-1, 1e-2)


@dataclass(frozen=True, slots=True)
class _Probe:
    """A point with its critical mode, and how its motions are stepped."""

    index: int
    model: mujoco.MjModel
    inputs: Mapping[str, Array]
    x: Array
    pencil: Pencil
    s: complex
    left: Array
    position: Array
    velocity: Array
    step: float
    count: int

    @property
    def time(self) -> float:
        return self.step * self.count


@checked
def verify_stability(
    branch: Branch,
    n: int = 20,
    *,
    rows: Sequence[int] | None = None,
    amplitude: float = 1e-7,
    tolerance: float = 0.05,
    resolution: float = 1e-3,
    max_steps: int = 200_000,
    nthread: int | None = None,
    progress: Amount | None = None,
) -> Branch:
    """Check the stability of points of a branch by simulation; the branch returned carries the certificate.

    Beside an equilibrium motions grow or decay at the rate that its critical eigenvalue says, beside a periodic orbit
    as its largest multiplier says.

    Parameters
    ----------
    branch : Branch
        A curve of equilibria or of orbits, of a Mechanism or a VectorField.
    n : int
        Number of points, spread evenly over the rows; or give the `rows`.
    amplitude : float
        Of the disturbance along the critical eigenvector, in rad and in sizes of the model; less, down to a
        hundredth, where a limit or contact would begin or cease to carry load.
    tolerance : float
        Relative difference of growth rate and eigenvalue up to which a point is confirmed.
    resolution : float
        A point is unresolved if |Re s| times the time that `max_steps` reach is less.
    max_steps : int
        Steps per point. The step is set by the fastest mode and by the accuracy of the critical one.
    progress : called as progress(done, all), a point each.

    Returns
    -------
    Branch
        The same with `certificate`: counts, and a verdict and a sentence for every point.

    Raises
    ------
    MjcontError
        If the branch is a locus, or was loaded without its problem.
    """
    if branch.problem is None or not branch.rated:
        raise MjcontError("verify_stability needs a curve of equilibria or of orbits, loaded with its problem")
    if n < 1 or not amplitude > 0 or not tolerance > 0 or not resolution > 0:
        raise ParameterError("n, amplitude, tolerance and resolution must be positive")
    rows = _rows(branch, n, rows)
    if not isinstance(branch.problem, Mechanism) or branch.kind != "equilibria":
        checks = check_beside(branch, rows, amplitude, tolerance, resolution, max_steps, progress)
    else:
        options = amplitude, tolerance, resolution, max_steps, nthread, progress
        checks = _check_rests(branch, branch.problem, rows, *options)
    units = {name: branch.unit(name) for name in branch.free}
    certificate = Certificate(tuple(sorted(checks, key=lambda c: c.index)), tolerance, resolution, units)
    return replace(branch, certificate=certificate)


def _check_rests(
    branch: Branch,
    problem: Mechanism,
    rows: Sequence[int],
    amplitude: float,
    tolerance: float,
    resolution: float,
    max_steps: int,
    nthread: int | None,
    progress: Amount | None,
) -> list[Check]:
    """Check equilibria of a mechanism."""
    first = branch.row(0)
    mechanism, _ = hold_rigid_modes(problem, first.state, first.parameters)
    probes, checks = [], []
    for row in rows:
        found = _probe(mechanism, branch, row, amplitude, resolution, max_steps)
        if isinstance(found, Check):
            checks.append(found)
        else:
            probes.append(found)
    with quiet:
        for group in _groups(probes):
            rates = _measure(mechanism, group, nthread or os.cpu_count() or 1)
            if progress is not None:
                progress(len(checks) + len(group), len(rows))
            checks += [_judge(branch, p, *r, tolerance) for p, r in zip(group, rates, strict=True)]
    return checks


def _rows(branch: Branch, n: int, given: Sequence[int] | None) -> Sequence[int]:
    """Return the rows given, or n of them spread evenly."""
    if given is None:
        return sorted({round(i) for i in np.linspace(0, len(branch) - 1, min(n, len(branch)))})
    for row in given:
        if not 0 <= row < len(branch):
            raise ParameterError(f"row {row} is not on the branch: it has rows 0 to {len(branch) - 1}")
    return given


def _critical(branch: Branch, row: int) -> complex:
    eigenvalues = branch.spectra.row(row)
    return complex(eigenvalues[np.argmax(eigenvalues.real)])


def _check(branch: Branch, row: int, rate: float, time: float, verdict: str, sentence: str) -> Check:
    return check_of(branch, row, _critical(branch, row), rate, time, verdict, sentence)


def _probe(
    mechanism: Mechanism, branch: Branch, row: int, amplitude: float, resolution: float, max_steps: int
) -> _Probe | Check:
    """Return how to test a row, or the check of one that cannot be tested: unresolved, and why."""
    unresolved = partial(_check, branch, row, math.nan, 0.0, UNRESOLVED)
    if branch.stability[row] == "marginal":
        return unresolved("classified as marginal: the eigenvalue is on the axis within its noise")
    if branch.labels[row].startswith("CO"):
        return unresolved("a corner: a limit or contact begins or ceases to carry load here")
    point, stored = branch.row(row), _critical(branch, row)
    values, x = mechanism.values(point.parameters), point.state
    pencil = full(mechanism.pencil(x, values, mechanism.linearize(x, values, (), accurate=True).jac))
    assert pencil.mass is not None and pencil.damping is not None
    found = quadratic_eigenvalues(pencil.mass, pencil.damping, pencil.stiffness)
    s = complex(found[np.argmin(np.abs(found - stored))])
    if s.imag == 0.0 and stored.real == 0.0:
        return unresolved("the critical eigenvalue is zero")
    fastest = float(np.abs(found).max())
    step = min(_FASTEST / fastest, _accurate_step(stored))
    time = min(_E_FOLDS / abs(stored.real), step * max_steps)
    if abs(stored.real) * time < resolution:
        return unresolved(
            f"marginal in {time:.3g} s, the time that {max_steps} steps reach: |Re s| x time = "
            f"{abs(stored.real) * time:.1e}, below {resolution:g}"
        )
    count = max(math.ceil(time / step), _LEAST_STEPS)
    count += -count % _SAMPLES
    left, right = _vectors(pencil, s)
    model = mechanism.simulation_model()
    writer = mechanism.writer(model)
    writer.write(mechanism.parameters, values)
    model.opt.integrator = INTEGRATORS["RK4"]
    # the solver must find constraint forces far more exactly than the disturbance changes them
    model.opt.tolerance, model.opt.ls_tolerance, model.opt.iterations = 0.0, 1e-6, 100
    size = amplitude / float(np.abs(right / mechanism.state_scale).max())
    for shrink in _SHRINKS:
        q = shrink * size * right
        if _one_piece(mechanism, model, writer.inputs, x, q, s):
            v = (s * q).real
            return _Probe(row, model, writer.inputs.copies(), x, pencil, s, left, q.real, v, time / count, count)
    return unresolved("a limit or contact begins or ceases to carry load beside the point: its motions are not linear")


def _one_piece(mechanism: Mechanism, model: mujoco.MjModel, inputs: DataInputs, x: Array, q: Array, s: complex) -> bool:
    """Whether the same limits and contacts carry load throughout motions of the size of `q` and its growth."""
    if not mechanism.constrained:
        return True
    data, sides = quiet_data(model), set()
    inputs.put(data)
    for phase in (0.0, 1.0, 1.0j, -1.0, -1.0j):
        away = phase * math.exp(_E_FOLDS) * q
        data.qpos[:], data.qvel[:] = mechanism.retract(x, away.real), (s * away).real
        with quiet:
            mujoco.mj_forward(model, data)
        sides.add(load_side(model, data))
    return len(sides) == 1


def _accurate_step(s: complex) -> float:
    """Return the step at which RK4's damping of an oscillation, |s|^6 h^5 / 144, is a small share of its rate."""
    return float((144.0 * _DAMPING_SHARE * abs(s.real) / abs(s) ** 6) ** 0.2)


def _vectors(pencil: Pencil, s: complex) -> tuple[Array, Array]:
    """Return left and right vectors of an eigenvalue that see each other, also where it is double."""
    assert pencil.mass is not None and pencil.damping is not None
    mass, damping = pencil.mass, pencil.damping
    # rows and columns are scaled so that light and stiff coordinates weigh alike
    scale = 1.0 / np.sqrt(np.diag(mass))
    matrix = (s**2 * mass + s * damping + pencil.stiffness) * np.outer(scale, scale)
    u, sigma, vh = singular(matrix)
    kernel = np.flatnonzero(~(sigma > max(1e-7 * sigma[0], 10.0 * sigma[-1])))
    p, q = scale[:, None] * u[:, kernel], scale[:, None] * vh[kernel].conj().T
    if s.imag == 0.0:
        p, q = p.real, q.real
    seen = np.abs(p[:, -1].conj() @ (2.0 * s * mass + damping) @ q)
    if seen.max() > _DEPENDENT * seen.sum():
        return p[:, -1], q[:, int(np.argmax(seen))]
    return p[:, -1], q[:, -1]


def _groups(probes: Sequence[_Probe]) -> Iterator[list[_Probe]]:
    """Gather probes of about as many steps, each given the same number and a step of its own."""
    by_size: dict[int, list[_Probe]] = {}
    for probe in probes:
        by_size.setdefault(math.ceil(math.log2(probe.count)), []).append(probe)
    for group in by_size.values():
        count = max(p.count for p in group)
        yield [replace(p, count=count, step=p.time / count) for p in group]


def _measure(mechanism: Mechanism, group: Sequence[_Probe], nthread: int) -> list[tuple[float, str]]:
    """Return the growth rate of every probe, and what went wrong with it if anything did."""
    pairs = [(p, sign) for p in group for sign in (1.0, -1.0)]
    for p in group:
        p.model.opt.timestep = p.step
    batch = Batch(pairs[0][0].model, len(pairs), nthread=min(nthread, len(pairs)))
    batch.set_models([p.model for p, _ in pairs])
    batch.qpos = np.array([mechanism.retract(p.x, sign * p.position) for p, sign in pairs])
    batch.qvel = np.array([sign * p.velocity for p, sign in pairs])
    for name, rows in pairs[0][0].inputs.items():
        if rows.size:
            batch.bind(name)[:] = np.array([p.inputs[name] for p, _ in pairs])
    block = group[0].count // _SAMPLES
    logs = [[_log_projection(mechanism, p, batch.qpos[2 * i : 2 * i + 2], batch.qvel[2 * i : 2 * i + 2])]
            for i, p in enumerate(group)]
    for _ in range(_SAMPLES):
        batch.step(nstep=block)
        for i, p in enumerate(group):
            two = slice(2 * i, 2 * i + 2)
            logs[i].append(_log_projection(mechanism, p, batch.qpos[two], batch.qvel[two]))
    return [_slope(np.array(log), p) for log, p in zip(logs, group, strict=True)]


def _log_projection(mechanism: Mechanism, p: _Probe, qpos: Array, qvel: Array) -> float:
    """Return log |a| of half the difference between the two motions."""
    assert p.pencil.mass is not None and p.pencil.damping is not None
    if not (np.all(np.isfinite(qpos)) and np.all(np.isfinite(qvel))):
        return math.nan
    away = 0.5 * (mechanism.difference(qpos[0], p.x) - mechanism.difference(qpos[1], p.x))
    speed = 0.5 * (qvel[0] - qvel[1])
    part = p.left.conj() @ ((p.s * p.pencil.mass + p.pencil.damping) @ away + p.pencil.mass @ speed)
    return float(np.log(np.abs(part))) if part else -math.inf


def _slope(log: Array, p: _Probe) -> tuple[float, str]:
    """Return the slope of log |a| by least squares."""
    if not np.all(np.isfinite(log)):
        return math.nan, "the motions diverged or vanished"
    times = np.linspace(0.0, p.time, len(log))
    return float(np.polyfit(times, log, 1)[0]), ""


def _judge(branch: Branch, p: _Probe, rate: float, trouble: str, tolerance: float) -> Check:
    s = _critical(branch, p.index)
    if trouble:
        return _check(branch, p.index, rate, p.time, CONTRADICTED, trouble)
    grows = "grow" if rate > 0 else "decay"
    told = f"motions {grows} at {rate:.6g} /s over {p.time:.3g} s, the eigenvalue's real part is {s.real:.6g} /s"
    same = (rate > 0) == (branch.stability[p.index] == "unstable")
    close = abs(rate - s.real) <= tolerance * abs(s.real)
    return _check(branch, p.index, rate, p.time, CONFIRMED if same and close else CONTRADICTED, told)
