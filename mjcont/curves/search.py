"""`find_equilibria`: every equilibrium at given parameter values that lies in a region, from no starting point.

Levenberg-Marquardt and Newton runs from quasi-random starts take turns with Newton runs on f deflated at the equilibria
known so far, from beside them, and with runs from mixtures of them, until nothing new turns up.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Found, Progress, make_point
from mjcont.curves.continuation import hold_rigid_modes
from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.mechanism.energy import potential_energy
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.newton import solve
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.starts import find_start
from mjcont.numerics.equations.system import System
from mjcont.numerics.search.coordinates import Coordinates, layout, with_turns
from mjcont.numerics.search.deflation import Deflation, newton
from mjcont.numerics.search.multistart import Many, Runs, levenberg_marquardt, spectral_step
from mjcont.results.model import Model
from mjcont.results.points import Point
from mjcont.results.quantities import column_of, meant
from mjcont.results.search import Account, Equilibria, gather, same_spectrum

Region = Mapping[str, tuple[float, float]] | Callable[[Point], bool]

_SAME = 1e-5
_CHUNK = 64
# a run that goes this many times beyond the range of the starts is given up
_BEYOND = 5.0
_HITS = 3
_BARREN = 8
# singular values of J, its rows scaled, below which an equilibrium is degenerate; so many of them are a continuum
_SINGULAR = 1e-9
_CONTINUUM = 20
_ROUNDS_FOR_NONE = 3
_UNEVEN, _MOST_UNKNOWNS = 1.0 / math.e, 1000


@checked
def find_equilibria(
    problem: Model,
    params: Mapping[str, float] | Point | None = None,
    *,
    region: Region | None = None,
    starts: int = 200,
    seed: int = 0,
    max_solutions: int = 200,
    max_starts: int | None = None,
    max_evaluations: int | None = None,
    max_seconds: float = math.inf,
    keyframes: bool = True,
    progress: Progress | None = None,
) -> Equilibria:
    """Return every equilibrium at given parameter values that lies in a region, from no starting point.

    Starts are drawn evenly over the region (angles over a full turn, slides over the model's extent, a vector field's
    components over three times their scale, where the region does not say otherwise). Further rounds of starts follow
    while equilibria still turn up. No search can prove that it has found all: `status` says what speaks for it.

    Parameters
    ----------
    problem : Mechanism or VectorField
    params : dict of parameter values, or a point of any result
        Other parameters keep the model's values.
    region : mapping of name to (low, high), or callable
        Ranges of joints, components, observables or parameters, or `region(point)` that returns whether an
        equilibrium counts; default everywhere.
    starts : number of quasi-random starts in each round.
    seed : seed of the starts: the same seed gives the same result.
    max_solutions, max_starts, max_evaluations, max_seconds : limits
        `max_starts` is 25 rounds unless given.
    keyframes : bool
        Whether the model's keyframes and initial pose are further starts.
    progress : callable, optional
        `progress(starts, found)` after each batch of starts, with an empty `found.kind`, and for each equilibrium.

    Returns
    -------
    Equilibria
        In order of energy; Ctrl-C returns what there is.

    Raises
    ------
    NameLookupError, ParameterError, BoundsError
        See their messages; also for more than 1000 unknowns. Finding none is no error but the result's status.
    """
    for name, number in (("starts", starts), ("max_solutions", max_solutions)):
        if number < 1:
            raise ParameterError(f"{name} must be at least 1, got {number}")
    search = _prepare(problem, _parameter_values(problem, params), region)
    most, spent = 25 * starts if max_starts is None else max_starts, search.problem.evaluations
    limits = _Limits(max_solutions, most, max_evaluations, max_seconds, spent)
    first = [problem.start_state(), *problem.keyframes.values()] if keyframes else []
    with np.errstate(all="ignore"), clock.limited(max_seconds):
        ended = search.run(first, starts, seed, limits, progress)
    energies = potential_energy(problem, np.array(search.kept), search.values)
    shown = tuple(name for name in search.ranges if name in problem.observables)
    return gather(problem, search.points, search.hits, energies, ended, search.account(), search.notes, shown)


def _prepare(problem: Model, values: dict[str, float], region: Region | None) -> _Search:
    """Return a search that has not begun."""
    if problem.n > _MOST_UNKNOWNS:
        raise ParameterError(
            f"find_equilibria takes dense matrices of many starts at once, of up to {_MOST_UNKNOWNS} unknowns; "
            f"{problem.name} has {problem.n}: use find_equilibrium from a state, and continue_equilibria from there"
        )
    ranges = _ranges(problem, region)
    home = problem.start_state()
    held, notes = hold_rigid_modes(problem, home, values)
    single = bool(notes) or problem.own_jacobian
    labels = problem.state_labels
    entries = {name.removeprefix("joint:").removeprefix("state:"): ends for name, ends in ranges.items()}
    coordinates = Coordinates(held, layout(labels, problem.typical, home, entries))
    search = _Search(held, values, coordinates, _many(held, values, coordinates, single), ranges, region, notes)
    search.learn_turns(labels)
    return search


def _parameter_values(problem: Model, params: Mapping[str, float] | Point | None) -> dict[str, float]:
    if params is not None and not isinstance(params, Mapping | Point):
        raise ParameterError(f"params must be a dict of parameter values or a point, got {type(params).__name__}")
    if isinstance(params, Point):
        params = {k: v for k, v in params.parameters.items() if k in problem.parameters or ":" in k}
    return problem.values(params)


def _ranges(problem: Model, region: Region | None) -> dict[str, tuple[float, float]]:
    """Return the checked ranges of a region; none for a callable."""
    if region is None or callable(region):
        return {}
    valid = [*problem.observables, *problem.parameters, *(name for name, _ in problem.state_labels)]
    ranges = {}
    for name, bounds in region.items():
        own = meant(name, (), problem.observables)
        if own not in valid:
            raise unknown_name("observable, joint or parameter", name, valid)
        try:
            low, high = (float(b) for b in bounds)
        except (TypeError, ValueError) as error:
            raise BoundsError(f"region: {name} must have two numbers (low, high), got {bounds!r}") from error
        if not low < high:
            raise BoundsError(f"region: {name} must have low < high, got ({low:g}, {high:g})")
        ranges[own] = (low, high)
    return ranges


def _many(problem: Model, values: Mapping[str, float], coordinates: Coordinates, single: bool) -> Many:
    return Many(problem, values, coordinates.flat, single, *coordinates.limits(_BEYOND))


@dataclass(frozen=True, slots=True)
class _Limits:
    """When a search must end, whatever it has found."""

    solutions: int
    starts: int
    evaluations: int | None
    seconds: float
    evaluations_before: int

    def __post_init__(self) -> None:
        """Refuse a time that is none."""
        if not self.seconds >= 0:
            raise ParameterError(f"max_seconds must be a number of seconds, got {self.seconds}")

    def reached(self, search: _Search) -> str:
        """Return a sentence if a limit is reached, else an empty string."""
        if search.degenerate >= _CONTINUUM and 2 * search.degenerate > len(search.roots):
            return "the equilibria form a continuum, of which these are samples"
        if len(search.points) >= self.solutions:
            return f"the limit of {self.solutions} equilibria was reached: there may be more"
        if self.evaluations is not None and search.problem.evaluations - self.evaluations_before >= self.evaluations:
            return f"the limit of {self.evaluations} evaluations was reached"
        return ""


@dataclass(slots=True)
class _Search:
    """What a search knows so far.

    `roots` are all equilibria, wrapped; `inside` holds the place of each among `points`, -1 outside the region.
    """

    problem: Model
    values: dict[str, float]
    coordinates: Coordinates
    many: Many
    ranges: Mapping[str, tuple[float, float]]
    region: Region | None
    notes: tuple[str, ...]
    roots: list[Array] = field(default_factory=list)
    inside: list[int] = field(default_factory=list)
    signs: list[float] = field(default_factory=list)
    points: list[Point] = field(default_factory=list)
    kept: list[Array] = field(default_factory=list)
    hits: list[int] = field(default_factory=list)
    found_at: list[int] = field(default_factory=list)
    drawn: int = 0
    converged: int = 0
    degenerate: int = 0

    def learn_turns(self, labels: Any) -> None:
        """Give a period to the angles whose full turns change nothing."""
        from scipy.stats import qmc

        # even points of symmetric ranges are often equilibria themselves, at which f is rounding
        cube = (qmc.Halton(self.problem.n, scramble=False).random(4)[1:] + _UNEVEN) % 1.0
        states = self.coordinates.draw(cube)
        slots = with_turns(self.coordinates.slots, labels, states, self.many.residuals)
        self.coordinates = Coordinates(self.problem, slots)
        self.many = _many(self.problem, self.values, self.coordinates, self.many.single)

    # -- the rounds ------------------------------------------------------------------------------------------

    def run(self, first: list[Array], starts: int, seed: int, limits: _Limits, progress: Progress | None) -> str:
        """Search until nothing new turns up or a limit is reached, and return how it ended."""
        from scipy.stats import qmc

        if seed < 0:
            raise ParameterError(f"seed must be a whole number from 0 on, got {seed}")
        sampler = qmc.Halton(self.problem.n, seed=seed)
        generator = np.random.default_rng(seed)
        rounds = barren = 0
        try:
            for x in first:
                self._flow(x, limits, progress)
            while not (ended := limits.reached(self)):
                rounds, known = rounds + 1, len(self.points)
                count = min(starts, limits.starts - self.drawn)
                if count <= 0:
                    return f"the limit of {limits.starts} starts was reached"
                drawn = self.coordinates.draw(sampler.random(count))
                self._try(drawn[::2], levenberg_marquardt, limits, progress, drawn=True)
                self._try(drawn[1::2], newton, limits, progress, drawn=True)
                if len(self.points) > known:
                    barren = 0
                known = len(self.points)
                if self.roots:
                    self._away_from_known(max(starts // (1 + barren), 1), generator, limits, progress)
                barren = 0 if len(self.points) > known else barren + 1
                if barren and self._enough(rounds, barren):
                    return limits.reached(self)
            return ended
        except clock.TimeUp:
            return f"the limit of {limits.seconds:g} s was reached"
        except KeyboardInterrupt:
            return "interrupted: this is what had been found"

    def _flow(self, x: Array, limits: _Limits, progress: Progress | None) -> None:
        """Search from a pose of the model's own: the equilibrium that it belongs or flows to."""
        start = find_start(self.problem, x, self.values)
        if start.failure is None and not limits.reached(self):
            where = self.coordinates.wrap(start.x[None])
            sign = spectral_step(*self.many.linearize(where))[2][0]
            self._add(where[0], float(sign), limits, progress)

    def _away_from_known(
        self, count: int, generator: np.random.Generator, limits: _Limits, progress: Progress | None
    ) -> None:
        """Search from beside the equilibria known, deflated, and from mixtures of them."""
        known = np.array(self.roots)
        chosen = known[generator.permutation(len(known))[:count]]
        beside = self.many.move(chosen, 1e-2 * generator.normal(size=(len(chosen), self.problem.n)))
        self._try(beside, self._deflated, limits, progress)
        mixed = self.coordinates.mix(np.array(self.roots), count, generator)
        self._try(mixed, levenberg_marquardt, limits, progress)

    def _deflated(self, many: Many, states: Array) -> Runs:
        known = np.array(self.roots)
        deflation = Deflation(lambda x: self.coordinates.steps(x, known), self.coordinates.periods)
        return newton(many, states, deflation)

    def _enough(self, rounds: int, barren: int) -> bool:
        """Whether everything speaks for the list being complete; `barren` is the number of rounds without news."""
        if not self.points:
            return rounds >= _ROUNDS_FOR_NONE
        settled = min(self.hits) >= _HITS or barren >= _BARREN
        return settled and not self.fresh and self.index_sum in (None, 0)

    @property
    def fresh(self) -> int:
        """Number of equilibria in the region that were new in the last quarter of the starts."""
        return sum(at > 0.75 * self.drawn for at in self.found_at)

    @property
    def index_sum(self) -> int | None:
        """Sum of the signs of det(-J) over all equilibria where it must vanish, else None.

        Where every coordinate is an angle with full turns, the states form a torus, whose Euler characteristic is
        zero (Poincare-Hopf), as long as no equilibrium is degenerate and no range of an angle is searched less.
        """
        slots = self.coordinates.slots
        if len(self.coordinates.turning) < len(slots) or any(column_of(s.name, self.ranges) for s in slots):
            return None
        return int(round(sum(self.signs)))

    def account(self) -> Account:
        """Return the numbers that the status sentence tells."""
        return Account(
            self.drawn, self.converged, self.fresh, len(self.roots), self.degenerate, self.index_sum,
            self.region is not None,
        )

    # -- one batch of starts -----------------------------------------------------------------------------------

    def _try(
        self,
        states: Array,
        method: Callable[[Many, Array], Runs],
        limits: _Limits,
        progress: Progress | None,
        drawn: bool = False,
    ) -> None:
        for i in range(0, len(states), _CHUNK):
            if limits.reached(self):
                return
            part = states[i : i + _CHUNK]
            runs = method(self.many, part)
            self.drawn += len(part) * drawn
            self.converged += int(runs.converged.sum()) * drawn
            where = self.coordinates.wrap(runs.states)
            for k in np.flatnonzero(runs.converged):
                place = self._add(where[k], float(runs.sign[k]), limits, progress)
                if place >= 0:
                    self.hits[place] += drawn
                if limits.reached(self):
                    return
            if progress is not None:
                progress(self.drawn, Found("", {}, {}))

    def _add(self, x: Array, sign: float, limits: _Limits, progress: Progress | None) -> int:
        """Note an equilibrium, and return its place in the result, -1 if it has none."""
        if self.roots:
            apart = np.max(np.abs(self.coordinates.steps(x[None], np.array(self.roots))[0]), axis=1)
            nearest = int(np.argmin(apart))
            if apart[nearest] < _SAME:
                return self.inside[nearest]
        if len(self.points) >= limits.solutions:
            return -1
        refined = solve(System(self.problem, self.values, ()), x, np.zeros(0), reach=0.01)
        if refined.failure is not None:
            return -1
        # the index of f as a field on the states is the sign of det(-J)
        place = self._keep(self.coordinates.wrap(refined.x[None])[0], progress)
        self.roots.append(x)
        self.signs.append(sign * (-1.0) ** self.problem.n)
        self.inside.append(place)
        sigma = spectral_step(*self.many.linearize(refined.x[None]))[1][0]
        self.degenerate += bool(sigma[-1] <= _SINGULAR * sigma[0])
        return place

    def _keep(self, x: Array, progress: Progress | None) -> int:
        """Add an equilibrium to the result if it lies in the region, and return its place there or -1."""
        names = [n for n in self.ranges if n in self.problem.observables]
        if names:
            measured = self.problem.measure(x[None], self.values, names)[0]
            if not all(self.ranges[n][0] <= v <= self.ranges[n][1] for n, v in zip(names, measured, strict=True)):
                return -1
        entries = {s.name: float(x[s.column]) for s in self.coordinates.slots if s.width == 1} | self.values
        if not all(low <= entries[n] <= high for n, (low, high) in self.ranges.items() if n not in names):
            return -1
        point = make_point(self.problem, x, self.values)
        if callable(self.region) and not self.region(point):
            return -1
        if self.notes and (copy := self._rigid_copy(point)) >= 0:
            return copy
        self.points.append(point)
        self.kept.append(x)
        self.hits.append(0)
        self.found_at.append(self.drawn)
        if progress is not None:
            progress(self.drawn, Found("EQ", {}, point.observables))
        return len(self.points) - 1

    def _rigid_copy(self, point: Point) -> int:
        """Return the place of an equilibrium that is the same in another place along held modes, -1 if there is none.

        Motions of parts change coordinates in proportion; with motions of the whole model the spectrum tells.
        """
        straight = self.problem.holds_straight()
        for i, other in enumerate(self.points):
            if same_spectrum(point, other) and (not straight or self._apart_by_modes_only(point.state, other.state)):
                return i
        return -1

    def _apart_by_modes_only(self, x: Array, y: Array) -> bool:
        step = self.coordinates.steps(x[None], y[None])[0, 0] * self.problem.state_scale
        rest = self.problem.admissible(y, step) / self.problem.state_scale
        return bool(np.abs(rest).max() < _SAME)
