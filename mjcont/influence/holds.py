"""The verb `hold`: which controls make a pose an equilibrium.

The pose is given by quantities g(x) = c: all coordinates but those in which bushes, constraints, stops and contacts
yield, or some observables. Controls u and the rest of the state solve f(x, u) = 0 with g(x) = c. With a basis R of the
null space of g_x and the left null space Q of f_x R, a Newton step asks of the controls

    Q' f_u du = -Q' (f + f_x dx_0),    g_x dx_0 = c - g,

which the shortest u within the ranges solves; the connections follow. What remains of f is what nothing balances.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import make_point
from mjcont.curves.continuation import hold_rigid_modes
from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.numerics.equations.differences import FOURTH_ORDER, jacobian_from_rows, jacobian_steps
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Local, equation_scale
from mjcont.numerics.search.leastnorm import Shortest, least_norm
from mjcont.results.choices.holds import Hold
from mjcont.results.model import Model
from mjcont.results.points import show
from mjcont.results.quantities import column_of, finite, finite_pair

# longest step of the state (scaled), most of them, and the step at which they end
_REACH, _MOST, _DONE = 0.2, 20, 1e-11
# least part of the load that is put on at once
_FINEST = 1e-2
# steps that no longer shorten once they are below this have met rounding
_NOISE = 1e-7
# forces: what is left counts as nothing below this part of those that act, or of the largest stiffness
_LEFT, _ROUNDING = 1e-7, 1e-12
# forces that a displacement so small (scaled) makes up for
_BALANCED = 1e-8
# singular values below this part of the largest: a motion that nothing resists
_FREE = 1e-11
# a control that changes forces by less than this part of what others do is saturated; values of it that are tried
_IDLE, _GRID = 1e-12, 25
# weight of a control's size beside what it makes yield
_SLIGHT = 1e-6
# a control without a range of its own: MuJoCo's largest number
_UNLIMITED = 1e9
_NAMED = 3


@checked
@np.errstate(all="ignore")
def hold(
    mechanism: Model,
    pose: str | Mapping[str, float] | Sequence[float] | np.ndarray,
    *,
    controls: Sequence[str] | Mapping[str, Any] | None = None,
    start: Mapping[str, float] | None = None,
    keyframe: str | None = None,
) -> Hold:
    """Return the controls of least norm that make a pose an equilibrium, with its stability; or why none do.

    Bushes, constraints, stops and contacts yield until they carry their load; every other coordinate of the pose is
    kept exactly.

    Parameters
    ----------
    mechanism : Mechanism or VectorField
    pose : a keyframe's name, a state (nq,), or a dict of joints and observables to values
        Of a dict the rest of the state is free: it comes to where it rests.
    controls : names, or a dict of name to (low, high), optional
        Any parameters; default all controls. Without (low, high) the range is the actuator's.
    start : dict of parameter values, optional
        The other parameters; default the model's.
    keyframe : str, optional
        Where the rest of a pose given as a dict is looked for; default the model's initial pose.

    Returns
    -------
    Hold

    Raises
    ------
    NameLookupError, ParameterError, BoundsError
        If a name is unknown, there is no control, a pose does not fit the model, or a range is none.
    """
    before = mechanism.evaluations
    names, low, high = _controls(mechanism, controls)
    values = mechanism.values(start)
    x0, wanted = _pose(mechanism, pose, keyframe)
    first = np.clip([values[n] for n in names], low, high)
    problem, _ = hold_rigid_modes(mechanism, x0, {**values, **dict(zip(names, first.tolist(), strict=True))})
    kept = _named(problem, wanted, values) if wanted else _coordinates(problem, x0, values)
    run = _Run(problem, values, names, low, high, kept)
    first = run.unsaturated(x0, first)
    found = run.solve(x0, first)
    if found.carried < 1.0 and len(names) > 1:
        run.gentle = True
        gentle = run.solve(x0, first)
        found = gentle if gentle.settled else found
    return _result(mechanism, run, found, x0, mechanism.evaluations - before)


def _controls(
    problem: Model, given: Sequence[str] | Mapping[str, Any] | None
) -> tuple[list[str], Array, Array]:
    """Return names and ranges of the controls, infinite where they have none."""
    if given is None:
        given = [p.name for p in problem.parameters.values() if p.kind == "control" or _setpoint(p)]
    names = list(dict.fromkeys([given] if isinstance(given, str) else given))
    if not names:
        said = "the model has no control: name parameters, such as controls=['F']"
        raise ParameterError(said if given is None or not isinstance(given, Mapping) else "name at least one control")
    low, high = np.full(len(names), -math.inf), np.full(len(names), math.inf)
    for i, name in enumerate(names):
        hard = problem.parameter(name).hard_bounds
        if problem.parameter(name).kind == "switch":
            raise ParameterError(f"'{name}' is a switch, 0 or 1: it cannot hold a pose")
        own = finite_pair(f"the range of {name}", given[name]) if isinstance(given, Mapping) else hard
        if own[0] < hard[0] or own[1] > hard[1]:
            raise BoundsError(f"the range ({own[0]:g}, {own[1]:g}) of {name} leaves {problem.parameter(name).limits}")
        low[i] = own[0] if own[0] > -_UNLIMITED else -math.inf
        high[i] = own[1] if own[1] < _UNLIMITED else math.inf
    return names, low, high


def _setpoint(parameter: Any) -> bool:
    return parameter.kind == "input" and any(t.field == "act" for t in parameter.targets)


def _pose(problem: Model, pose: Any, keyframe: str | None) -> tuple[Array, dict[str, float]]:
    """Return the state at which to begin, and the observables that are wanted: none if all of the state is."""
    if not isinstance(pose, Mapping):
        if keyframe is not None:
            raise ParameterError("keyframe goes with a pose given as a dict; this pose says all coordinates")
        name = pose if isinstance(pose, str) else None
        return problem.start_state(name, None if name is not None else pose), {}
    if not pose:
        raise ParameterError('a pose needs at least one joint or observable, such as {"theta_1": 0.5}')
    wanted = {}
    for name, value in pose.items():
        own = column_of(name, problem.observables)
        if own is None:
            raise unknown_name("joint or observable", name, problem.observables)
        wanted[own] = finite(f"the pose's {name}", value)
    return problem.start_state(keyframe), wanted


@dataclass(frozen=True, slots=True)
class _Kept:
    """What of the state is wanted: names, `misfit(x)` = c - g(x) (k,) and the gradient of g in scaled x, (k, n)."""

    names: Sequence[str]
    misfit: Callable[[Array], Array]
    gradient: Callable[[Array], Array]


def _coordinates(problem: Model, x0: Array, values: Mapping[str, float]) -> _Kept:
    """Keep every direction in which nothing yields that connects the mechanism's parts."""
    scale = problem.state_scale
    rows = problem.connections(x0, dict(values)) * scale
    rows = rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)
    _, sizes, right = np.linalg.svd(rows, full_matrices=True)
    fixed = right[int(np.sum(sizes > 1e-8 * sizes.max(initial=0.0))) :]
    return _Kept((), lambda x: -fixed @ (problem.difference(x, x0) / scale), lambda x: fixed)


def _named(problem: Model, wanted: Mapping[str, float], values: Mapping[str, float]) -> _Kept:
    """Keep some observables."""
    names, scale, here = list(wanted), problem.state_scale, dict(values)
    aims = np.array(list(wanted.values()))

    def gradient(x: Array) -> Array:
        states = np.array([problem.retract(x, s) for s in jacobian_steps(scale, FOURTH_ORDER)])
        found: Array = jacobian_from_rows(problem.measure(states, here, names), scale, FOURTH_ORDER) * scale
        return found

    return _Kept(names, lambda x: aims - problem.measure(x[None], here, names)[0], gradient)


@dataclass(frozen=True, slots=True)
class _Found:
    """Where the steps ended: the state, the controls, what is left of them, and whether they settled."""

    x: Array
    shortest: Shortest
    forces: Array
    tol: float
    misfit: float
    settled: bool
    carried: float = 1.0


class _Run:
    """Newton steps towards a pose that controls hold."""

    def __init__(
        self, problem: Model, values: Mapping[str, float], names: Sequence[str], low: Array, high: Array, kept: _Kept
    ) -> None:
        self.problem, self.values_given, self.names = problem, dict(values), list(names)
        self.low, self.high, self.kept = low, high, kept
        self.gentle = False  # whether what yields least is chosen, not what is shortest

    def values(self, u: Array) -> dict[str, float]:
        """Return all parameter values with the controls' in their places."""
        return {**self.values_given, **dict(zip(self.names, u.tolist(), strict=True))}

    def unsaturated(self, x: Array, u: Array) -> Array:
        """Return controls to begin with: of one that changes nothing where it is, a value at which it does."""
        acting = np.abs(self._local(x, u).par).max(axis=0, initial=0.0)
        found = u.copy()
        for i in np.flatnonzero(acting <= _IDLE * acting.max(initial=1.0)):
            if not np.isfinite([self.low[i], self.high[i]]).all():
                continue
            grid = np.linspace(self.low[i], self.high[i], _GRID)
            rows = [self.problem.residual(x, self.values(np.where(np.arange(len(u)) == i, g, u))) for g in grid]
            changes = np.linalg.norm(np.diff(rows, axis=0), axis=1)
            k = int(np.argmax(changes))
            found[i] = 0.5 * (grid[k] + grid[k + 1]) if changes[k] > 0.0 else u[i]
        return found

    def solve(self, x: Array, u: Array) -> _Found:
        """Return the state and controls near a pose, whose load is put on in steps where it is too much for one."""
        whole = self._settled(x, u, 0.0, np.zeros(len(x)), np.zeros(0))
        if whole.settled and self._near(whole.x, x):
            return whole
        first = self._balanced(x, u)
        load, misfit = self.problem.residual(x, self.values(first)), self.kept.misfit(x)
        found, done, step = whole, 0.0, 0.25
        at, v = x, first
        while done < 1.0 and step > _FINEST:
            aim = min(1.0, done + step)
            found = self._settled(at, v, 1.0 - aim, load, misfit)
            if found.settled and self._near(found.x, at):
                at, v, done, step = found.x, found.shortest.u, aim, 1.5 * step
            else:
                step *= 0.5
        return found if done >= 1.0 else replace(found, settled=False, carried=done)

    def _near(self, x: Array, x0: Array) -> bool:
        return bool(np.abs(self.problem.difference(x, x0) / self.problem.state_scale).max() <= _REACH)

    def _balanced(self, x: Array, u: Array) -> Array:
        """Return the controls that would hold the pose if nothing yielded."""
        return self._step(self._local(x, u), u, 0.0, np.zeros(0), None)[1].u

    def _local(self, x: Array, u: Array) -> Local:
        return Local(self.problem, x, self.values(u), self.names, not self.problem.nonsmooth)

    def _settled(self, x: Array, u: Array, off: float, load: Array, misfit: Array) -> _Found:
        """Return where Newton steps lead with a part `off` of the first load and misfit taken away."""
        problem, scale, size, settled = self.problem, self.problem.state_scale, math.inf, False
        aim = misfit * off if len(misfit) else None
        for _ in range(_MOST):
            local = self._local(x, u)
            dx, shortest, tol = self._step(local, u, off, load, aim)
            last, size = size, float(np.linalg.norm(dx))
            if not (np.isfinite(size) and np.isfinite(shortest.u).all()):
                break
            part = min(1.0, _REACH / size) if size > 0.0 else 1.0
            if problem.nonsmooth:
                part = self._shortened(x, u, shortest.u, dx, part, (off, load, aim))
            change = shortest.u - u
            x, u = problem.retract(x, part * dx * scale), u + part * change
            size = max(size, float(np.linalg.norm(change)) / max(1.0, float(np.linalg.norm(u))))
            if size <= _DONE or (size < _NOISE and size > 0.5 * last):
                settled = True
                break
        forces = problem.residual(x, self.values(u)) * scale
        away = float(np.abs(self.kept.misfit(x)).max(initial=0.0))
        return _Found(x, replace(shortest, u=u), forces, tol, away, settled)

    def _step(
        self, local: Local, u: Array, off: float, load: Array, aim: Array | None
    ) -> tuple[Array, Shortest, float]:
        """Return the scaled step, the controls with what they leave, and below what that is nothing."""
        scale = self.problem.state_scale
        f, k, b = local.f * scale, scale[:, None] * local.jac, scale[:, None] * local.par
        if not (np.isfinite(f).all() and np.isfinite(k).all() and np.isfinite(b).all()):
            nothing = np.zeros(0)
            return np.full(len(f), math.nan), Shortest(u, nothing, u, nothing), 0.0
        rows = self.kept.gradient(local.x)
        move = np.linalg.pinv(rows, rcond=1e-9) @ (self.kept.misfit(local.x) - (0.0 if aim is None else aim))
        _, sizes, right = np.linalg.svd(rows, full_matrices=True)
        free = right[int(np.sum(sizes > 1e-9 * sizes.max(initial=0.0))) :].T
        left_vectors, sizes, right = np.linalg.svd(k @ free, full_matrices=True)
        rank = int(np.sum(sizes > _FREE * np.abs(k).max()))
        q = left_vectors[:, rank:]
        now = f + k @ move - (off * load * scale if off else 0.0)
        asked = q.T @ (b @ u - now)
        acting = max(float(np.linalg.norm(f - b @ u)), float(np.abs(b * u).max(initial=0.0)))
        tol = _LEFT * acting + _ROUNDING * float(np.abs(k).max())
        # how far what connects the parts yields: opened - compliance u
        compliance = left_vectors[:, :rank].T @ b / sizes[:rank, None]
        opened = -left_vectors[:, :rank].T @ (now - b @ u) / sizes[:rank]
        metric = None
        if self.gentle:
            floor = _SLIGHT * max(float(np.abs(compliance).max()), 1e-300) * np.eye(len(u))
            metric = np.vstack([-compliance, floor]), np.concatenate([opened, np.zeros(len(u))])
        shortest = least_norm(q.T @ b, asked, self.low, self.high, tol, metric)
        return move + free @ (right[:rank].T @ (opened - compliance @ shortest.u)), shortest, tol

    def _shortened(
        self, x: Array, u: Array, aim: Array, dx: Array, part: float, less: tuple[float, Array, Array | None]
    ) -> float:
        """Return the part of a step after which the next one is shorter: contacts open and close on the way."""
        problem, size = self.problem, float(np.linalg.norm(dx))
        while part > 0.03:
            v = u + part * (aim - u)
            there = self._local(problem.retract(x, part * dx * problem.state_scale), v)
            following, _, _ = self._step(there, v, *less)
            if float(np.linalg.norm(following)) <= (1.0 - 0.25 * part) * size or size < _NOISE:
                break
            part *= 0.5
        return part


def _result(model: Model, run: _Run, found: _Found, x0: Array, evaluations: int) -> Hold:
    problem, u = run.problem, found.shortest.u
    values, labels = run.values(u), problem.coordinates
    scale = problem.state_scale
    rest = problem.residual(found.x, values)
    controls = dict(zip(run.names, u.tolist(), strict=True))
    wanted = dict(zip(run.names, found.shortest.wanted.tolist(), strict=True))
    ends = zip(run.names, u, run.low, run.high, strict=True)
    at_limit = {n: "low" if v <= a else "high" for n, v, a, b in ends if v <= a or v >= b}
    moved = problem.difference(found.x, x0)
    shift = {label: float(d) for (label, _), d in zip(labels, moved, strict=True)}
    local = Local(problem, found.x, values, (), False)
    error = float(np.max(np.abs(rest) * equation_scale(local)))  # a displacement that would make up for it
    nothing = float(np.linalg.norm(found.forces)) <= found.tol or error <= _BALANCED
    if not found.settled or not found.misfit <= _NOISE:
        status = "not converged"
    elif nothing:
        status = "held"
    else:
        status = "beyond range" if np.linalg.norm(found.shortest.left_unbounded) <= found.tol else "not held"
    left = {}
    if status not in ("held", "not converged"):
        part = 1e-6 * float(np.abs(found.forces).max())
        order = np.argsort(-np.abs(found.forces), kind="stable")
        left = {labels[i][0]: float(rest[i]) for i in order if abs(rest[i] * scale[i]) > max(part, found.tol)}
    point = make_point(problem, found.x, values) if status == "held" else None
    message = _sentence(status, run, found, shift, left, point)
    return Hold(
        status == "held", status, message, controls, wanted, at_limit, point, found.x, x0, shift, left, model,
        evaluations,
    )


def _sentence(
    status: str, run: _Run, found: _Found, shift: Mapping[str, float], left: Mapping[str, float], point: Any
) -> str:
    units = dict(run.problem.coordinates)
    if status == "held":
        label, most = max(shift.items(), key=lambda item: abs(item[1]))
        moved = f"; it moves by {show(most, units[label], 3)} ({label}) to carry its load" if abs(most) > _NOISE else ""
        gentle = "; by controls that load it least: those of least norm make what connects its parts give way"
        return f"the pose is held, {point.stability}{'' if run.kept.names else moved}{gentle if run.gentle else ''}"
    if status == "not converged":
        why = "no state near it has these values" if run.kept.names else "what connects its parts gives way"
        return f"no controls were found for this pose: with {100.0 * found.carried:.0f} % of its load {why}"
    force = {"rad": "N m", "m": "N"}
    parts = [f"{n} is left with {show(v, force.get(units[n], ''), 4)}" for n, v in list(left.items())[:_NAMED]]
    more = len(left) - _NAMED
    said = ", ".join(parts) + (f", and {more} more" if more > 0 else "")
    if status == "beyond range":
        limits = zip(run.names, found.shortest.wanted, run.low, run.high, strict=True)
        over = [f"{n} = {show(float(v), run.problem.parameters[n].unit, 4)} (range {a:g} to {b:g})"
                for n, v, a, b in limits if v < a or v > b]
        return f"no controls within their ranges hold this pose: it takes {', '.join(over[:_NAMED])}; {said}"
    return f"no control holds this pose: {said}, which no control pushes"
