"""A special point as the solution of its defining system: the system, the point again from a solution, and moving it.

`follow_point` moves a special point to other parameter values: steps along the straight line to them, predicted by
the point's derivative and corrected on its defining system, accepted only where prediction and solution agree.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import make_point
from mjcont.curves.continuation import hold_rigid_modes
from mjcont.curves.loci import CODIMENSION, followed_as
from mjcont.curves.walkers import monitor_of
from mjcont.errors import MjcontError, ParameterError
from mjcont.numerics.equations.bordered import Factored, oriented
from mjcont.numerics.equations.defining import Fold
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import Corrected, known_to, solve
from mjcont.numerics.equations.onfolds import Transversality
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points import normalform
from mjcont.numerics.points.alongside import AGREE, CLOSE, REACH
from mjcont.numerics.points.events import ScalarZero
from mjcont.numerics.points.kinds import CONTINUABLE, KINDS, conditions_of, name_of
from mjcont.results.maps import FollowedPoint
from mjcont.results.orbits import OrbitPoint, SpecialOrbit
from mjcont.results.points import Point, SpecialPoint, show

# a system, and the state and y that solve it
Solution = tuple[System, Array, Array]
SUPPORTED = (*CONTINUABLE, "UZ")
_SHORTEST = 1e-4  # of the way
_STEEPER = 3.0
_NEWTON = 6


def defining_kind(point: Point) -> str:
    """Return the kind of defining system of a point: "" for an equilibrium with nothing to solve for.

    Raises
    ------
    MjcontError
        If its kind has no defining system here, it did not converge, or it came without its problem.
    """
    if point.problem is None:
        raise MjcontError("the point was loaded without its problem: mc.load(path, problem=...)")
    if isinstance(point, OrbitPoint | SpecialOrbit):
        raise MjcontError("the point is a periodic orbit: this is for equilibria and their special points")
    if not isinstance(point, SpecialPoint) or point.kind in ("", "EP"):
        return ""
    if not point.converged:
        raise MjcontError(f"{point.label} did not converge, it is a guess{': ' + point.note if point.note else ''}")
    turning = point.kind == "BP" and point.curve == "LP locus"
    kind = "turning" if turning else followed_as(point)
    if kind not in (*SUPPORTED, "turning"):
        raise MjcontError(
            f"{point.label}, a {name_of(point.kind)}, has no regular defining system. "
            f"Valid kinds: {', '.join(SUPPORTED)}, and plain equilibria."
        )
    return kind


def point_system(point: Point) -> System:
    """Return the square system that a point solves, with borders from the point itself."""
    kind, problem = defining_kind(point), point.model
    values = problem.values(point.parameters)
    problem, _ = hold_rigid_modes(problem, point.state, values)
    if not kind or not isinstance(point, SpecialPoint):
        return System(problem, values, (), (), accurate=True)
    free = [Free(n, *bounds, problem.parameter(n).unit, False) for n, bounds in point.free.items()]
    free = free[: CODIMENSION.get(kind, len(free))]
    plain = System(problem, values, free)
    local = Local(problem, point.state, values, plain.names, True, plain.ranges)
    conditions: Sequence[Any]
    if kind == "UZ":
        name = str(point.coefficients["monitor"]).rpartition(" = ")[0]
        conditions = [ScalarZero(monitor_of(problem, name, point[name]))]
    elif kind == "turning":
        fold = Fold(local)
        conditions = [fold, Transversality(fold, local)]
    else:
        omega = point.coefficients.get("omega")
        conditions = conditions_of(kind, local, plain, None if omega is None else float(omega) ** 2)
    return System(problem, values, free, conditions, accurate=True)


def located_point(like: SpecialPoint, system: System, c: Corrected) -> SpecialPoint:
    """Return a solution of the defining system as a special point, with its coefficients."""
    values, kind = system.values(c.y), defining_kind(like)
    local = system.local(c.x, c.y)
    coefficients, vectors = dict(like.coefficients), dict(like.vectors)
    if kind in ("LP", "CP"):
        v, w = system.conditions[0].physical(local)  # type: ignore[attr-defined]
        v = oriented(v / np.linalg.norm(v))
        w = w / (w @ v) if abs(w @ v) > 1e-12 * np.linalg.norm(w) else w / np.linalg.norm(w)
        function = normalform.fold_coefficient if kind == "LP" else normalform.cusp_coefficient
        coefficients = {KINDS[kind].coefficients[0]: function(local, v, w)}
        vectors = {"v": v, "w": w}
    elif kind == "HB":
        omega = math.sqrt(system.conditions[0].square(c.y[-1:]))  # type: ignore[attr-defined]
        l1 = normalform.lyapunov(system.problem, c.x, values, omega).l1
        coefficients = {"omega": omega, "l1": l1, "type": "supercritical" if l1 < 0 else "subcritical"}
    elif kind != "UZ":
        coefficients, vectors = {k: v for k, v in coefficients.items() if k == "omega"}, {}
    p = make_point(like.model, c.x, values, like.kind)
    own = point_names(like)
    free = {n: around(like.model.parameters[n], b, values[n]) if n in own else b for n, b in like.free.items()}
    return replace(
        like, parameters=p.parameters, observables=p.observables, state=p.state, eigenvalues=p.eigenvalues,
        n_unstable=p.n_unstable, stability=p.stability, tolerance=known_to(system, c), coefficients=coefficients,
        vectors=vectors, units=p.units, free=free,
    )


def around(parameter: Any, bounds: tuple[float, float], value: float) -> tuple[float, float]:
    """Return bounds that contain a value with room beside it: those given, or widened to that side."""
    (low, high), hard = bounds, parameter.hard_bounds
    room = 0.5 * (high - low)
    if value < low:
        low = max(value - room, hard[0])
    if value > high:
        high = min(value + room, hard[1])
    return low, high


def within(parameter: Any, value: float) -> bool:
    """Whether there is a model at a value that a parameter was solved for."""
    low, high = parameter.hard_bounds
    return bool(low <= value <= high)


def check_targets(point: SpecialPoint, targets: Mapping[str, float]) -> dict[str, float]:
    """Return the values to which parameters are moved, as floats.

    Raises
    ------
    MjcontError, ParameterError, NameLookupError, BoundsError
        If the point cannot be moved, a name is unknown or the point's own, or a value does not fit it.
    """
    if not defining_kind(point) or not isinstance(point, SpecialPoint):
        raise MjcontError("only special points can be followed; equilibria are: mc.continue_equilibria(...)")
    if not targets:
        raise ParameterError("name at least one parameter to move")
    for name in targets:
        check_not_own(point, name)
    values = point.model.values({**point.parameters, **targets})
    for name in targets:
        check_alone(point, name)
    return {name: values[name] for name in targets}


def check_not_own(point: Point, name: str) -> None:
    """Raise a ParameterError if the point's defining system solves for a parameter."""
    point.model.parameter(name)
    if name in point_names(point):
        what = f"{name} is free at {called(point)}, whose defining system solves for it"
        raise ParameterError(f"{what}: name other parameters")


def called(point: Point) -> str:
    """Return what sentences call a point."""
    return point.label if isinstance(point, SpecialPoint) and point.label else "the point"


def point_names(point: Point) -> tuple[str, ...]:
    """Return the parameters that a point's defining system solves for."""
    if not isinstance(point, SpecialPoint) or not (kind := defining_kind(point)):
        return ()
    return tuple(point.free)[: CODIMENSION.get(kind, len(point.free))]


def check_alone(point: Point, name: str) -> None:
    """Raise a ParameterError if another parameter that has been changed acts on the same field of the model."""
    parameters = point.model.parameters
    mine = parameters[name]
    if mine.kind == "gravity":
        return
    for other in parameters.values():
        changed = point.parameters.get(other.name, other.value) != other.value or other.name in point_names(point)
        if other.name != name and changed and not mine.entries.isdisjoint(other.entries):
            raise ParameterError(
                f"{name} acts on the same field of the model as {other.name}, which decides there: name {other.name}"
            )


@checked
def follow_point(
    point: SpecialPoint, values: Mapping[str, float], *, shortest: float = _SHORTEST, most: int = 400
) -> FollowedPoint:
    """Move a special point to other parameter values.

    Parameters
    ----------
    point : SpecialPoint
        An LP, HB, CP, BT, ZH, user zero, or a branch point that persists.
    values : mapping of str to float
        Target values, SI and radians; parameters not named stay.
    shortest : float
        Fraction of the way below which steps are given up.
    most : int
        Steps after which to stop.

    Returns
    -------
    FollowedPoint
        Whether and where it arrived. That it ceases to exist on the way is a status with a sentence.

    Raises
    ------
    MjcontError
        See `check_targets`.
    """
    targets = check_targets(point, values)
    start = {n: point.model.values(point.parameters)[n] for n in targets}
    before = point.model.evaluations
    walk = Walk(point, start, targets)
    status, message = walk.run(shortest, most)
    moved = walk.point if walk.t > 0.0 else point
    return FollowedPoint(
        moved, status == "reached", status, message, tuple(walk.path), point.model.evaluations - before
    )


class Walk:
    """A point on its way from one set of parameter values to another, at the fraction t.

    `solution` is where its defining system is solved at the start, by default the point itself.
    """

    def __init__(
        self, point: Point, start: Mapping[str, float], targets: Mapping[str, float], solution: Solution | None = None
    ) -> None:
        self.like, self.start, self.targets = point, dict(start), dict(targets)
        if solution is None:
            system = point_system(point)
            solution = system, point.state, system.start_y()
        self.label, self.kind = called(point), point.kind if isinstance(point, SpecialPoint) else "rest"
        self.system, self.x, self.y = solution
        self.t = 0.0
        self.path: list[dict[str, float]] = []
        self.least, self.speed = math.inf, 0.0
        self.reason: Refused | None = None
        self._c: Corrected | None = None

    @property
    def point(self) -> SpecialPoint:
        """The special point at t."""
        assert self._c is not None and isinstance(self.like, SpecialPoint)
        return located_point(self.like, self.system, self._c)

    def at(self, t: float) -> System:
        """Return the defining system at a fraction of the way, with the present borders."""
        s = self.system
        moved = {n: (1.0 - t) * a + t * self.targets[n] for n, a in self.start.items()}
        return System(s.problem, {**s.base, **moved}, s.free, s.conditions, accurate=True)

    @property
    def corrected(self) -> Corrected | None:
        """The solution at t, None at the start."""
        return self._c

    def _record(self) -> None:
        values = self.system.values(self.y)
        self.path.append({n: values[n] for n in (*self.targets, *self.system.names)})

    def _tangent(self, system: System, t: float, x: Array, y: Array) -> tuple[Array, float]:
        """Return d(x, y)/dt in scaled unknowns and the orientation of the system there."""
        local = system.local(x, y)
        h = 1e-4
        ends = [self.at(t + s * h) for s in (1.0, -1.0)]
        g = [e.residual(e.local(x, y), y) for e in ends]
        lu = Factored(system.jacobian(local, y))
        return -lu.solve((g[0] - g[1]) / (2.0 * h)), lu.sign

    def run(self, shortest: float, most: int) -> tuple[str, str]:
        """Walk to t = 1 and return status and sentence."""
        self._record()
        tangent, sign = self._tangent(self.system, 0.0, self.x, self.y)
        if not np.all(np.isfinite(tangent)):
            return "stuck", f"{self.label} could not be followed: its defining system is singular there"
        dt, failed = 1.0, False
        for _ in range(most):
            self.speed = float(np.linalg.norm(tangent))
            self.least = min(self.least, self.speed)
            dt = min(dt, 1.0 - self.t, REACH / self.speed if self.speed > 0 else 1.0)
            if dt < shortest:
                return self._lost()
            done = self._step(dt, tangent, sign)
            if done is None:
                dt, failed = 0.5 * dt, True
                continue
            tangent, sign = done
            bound = self._beyond()
            if bound:
                return "at bound", bound
            if self.t >= 1.0 - 1e-12:
                return "reached", f"{self.label} followed to {self._where()}"
            dt, failed = dt if failed else 2.0 * dt, False
        return "stuck", f"{self.label} was given up after {most} steps at {self._where()}"

    def _step(self, dt: float, tangent: Array, sign: float) -> tuple[Array, float] | None:
        """Take a step if prediction, solution and the derivatives at both ends agree."""
        t = 1.0 if self.t + dt > 1.0 - 1e-12 else self.t + dt
        system = self.at(t)
        x, y = system.move(self.x, self.y, dt * tangent)
        with np.errstate(all="ignore"):
            c = solve(system, x, y, most=_NEWTON)
            if c.failure is not None or not np.all(np.isfinite(c.y)) or not self._exists(system, c):
                self.reason = c.failure
                return None
            moved = system.difference(c.x, c.y, self.x, self.y)
            size, off = np.linalg.norm(moved), np.linalg.norm(moved - dt * tangent)
            if off > AGREE * size + CLOSE:
                self.reason = Refused(Why.OTHER_BRANCH, "the solution found is not the one predicted")
                return None
            after, new_sign = self._tangent(system, t, c.x, c.y)
        bent = np.linalg.norm(moved - 0.5 * dt * (tangent + after))
        turned = new_sign * sign < 0 and not any(k.direction is not None for k in system.conditions)
        if not bent <= 0.5 * AGREE * size + CLOSE or turned:
            self.reason = Refused(Why.OTHER_BRANCH, "the solution found is not on the same curve")
            return None
        self.t, self.x, self.y, self.system, self._c = t, c.x, c.y, system, c
        system.update(system.local(c.x, c.y), c.y)
        self._record()
        return after, new_sign

    @staticmethod
    def _exists(system: System, c: Corrected) -> bool:
        """Whether a solution is a point of its kind: a branch point not unfolded, a Hopf point no neutral saddle."""
        at = len(system.free)
        for condition in system.conditions:
            if not condition.exists(c.y[at : at + len(condition.aux)]):
                return False
            at += len(condition.aux)
        return True

    def _beyond(self) -> str:
        for name, value in self.path[-1].items():
            p = self.like.model.parameters[name]
            if name in self.system.names and not within(p, value):
                return f"{self.label} leaves the actuator's ctrlrange: {name} = {show(value, p.unit)}"
        return ""

    def _where(self) -> str:
        units = self.like.model.parameters
        return ", ".join(f"{n} = {show(self.path[-1][n], units[n].unit, 5)}" for n in self.targets)

    def _lost(self) -> tuple[str, str]:
        label, where = self.label, self._where()
        other = self.reason is not None and self.reason.why is Why.OTHER_BRANCH
        if self.speed > _STEEPER * self.least or other:
            return "ceased", f"{label} ceases to exist near {where}: it meets another {self.kind} and both vanish"
        return "stuck", f"{label} could not be followed beyond {where}: {self.reason or 'steps became too short'}"
