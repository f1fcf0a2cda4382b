"""Retraction, uplock, unlock and extension of the nose gear as controllers, and what becomes of many runs.

A sequence has phases: HOLD (stowed), RAISE (forces grow), FALL (F_ret returns to the hold), EXTEND (to none). Both
actuators' laws go through the same phases, by the same rules from the same observations, each with a memory of its own.
Arrays have one entry a run.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from _gusts import Aircraft, Gust, one_minus_cos

import mjcont as mc
from mjcont.drawing.plotting import COLORS
from mjcont.numerics.equations.problem import Array

RETRACTION_RATE = 2.0e4  # N/s: a retraction in about 25 s; the strut swings at about 2 rad/s
UNLOCK_RATE = 1.0e3  # N/s: a valve that opens within half a second
THRESHOLD = np.radians(5.0)  # a proximity sensor that sees the locklinks just past overcentre
DWELL = 1.0  # s at full unlock force before F_ret falls, twice as long as that force takes to build up
PATIENCE = 9.0  # s that position control waits for its sensor: as long as F_ret takes to its capacity
SETTLE = 3.0  # s in the hold after unlocking, before the gear is let down
BEGIN = 1.0  # s
DURATION = 21.0  # s: begin, patience, fall from capacity and some time to settle
CONTROL_STEP = 0.05  # s: a controller of 20 Hz, quick beside the strut
TIMESTEP = 0.002  # s
SAMPLES = 420  # every 0.05 s
# Before a whole sequence's unlocking: retract with the downlock pulled open, lock above the fold, go to the hold.
DOWNLOCK_PULL = 1000.0  # N: the actuator's limit; 700 N pulls the locklinks overcentre, but not clear of the fold
WHOLE_BEGIN, WHOLE_DURATION = 40.0, 85.0  # s
PULLED = (1.0, 1.0 + DOWNLOCK_PULL / UNLOCK_RATE, 15.0, 15.0 + DOWNLOCK_PULL / UNLOCK_RATE)

HOLD, RAISE, FALL, EXTEND = range(4)
MEASURES = ("position", "force", "scheduled")
OUTCOMES = ("unlocked", "stuck", "re-locked", "let go")


@dataclass(frozen=True, slots=True)
class Plan:
    """The retraction forces of a gear's sequence, in N.

    Attributes
    ----------
    stowed : the gear rests there both locked and unlocked, so that it shows what it has become.
    overtravel : 3 % above the cusp; the unlock force moves the one rest that is left there across overcentre.
    capacity : 20 % above the cusp, where a force that waits for a position stops growing.
    release : 5 % below the fold without unlock force; released above that, the gear has no rest unlocked.
    lowest : theta_ov in rad below which the stowed gear has let go of its lock.
    """

    stowed: float
    overtravel: float
    capacity: float
    release: float
    lowest: float = -np.inf

    @property
    def schedule(self) -> tuple[float, float, float, float]:
        """Times in s at which F_ret starts to grow, has grown, starts to fall, and is at the hold."""
        return (3.0, 3.0 + self.overtravel / RETRACTION_RATE, 32.0,
                32.0 + (self.overtravel - self.stowed) / RETRACTION_RATE)


PLANS = {
    "nose_gear": Plan(4.0e5, 5.0e5, 5.8e5, 4.5e5),
    # the hold is 4 % above FP2; a gear that lets go comes to rest near -49 deg
    "nose_gear_locking": Plan(4.7e5, 5.3e5, 6.2e5, 4.88e5, np.radians(-30.0)),
}


@dataclass(slots=True)
class Sequencer:
    """The phases and forces of many runs.

    Attributes
    ----------
    plan : the gear's retraction forces.
    measure : "position" ends the pull when theta_ov passes THRESHOLD, F_ul and F_ret then fall together; "scheduled"
        does so too but keeps F_ul until F_ret is below `release`; "force" asks for F_ret and F_ul only.
    unlock : (m,) size of the unlock force in N.
    fall : rate in N/s at which F_ret falls after unlocking; a number or (m,).
    release : F_ret in N below which F_ul is released, where it waits for that; a number or (m,), default the plan's.
    whole : whether retraction and uplock come before, and extension after.
    """

    plan: Plan
    measure: str
    unlock: Array
    fall: Any = RETRACTION_RATE
    release: Any = None
    whole: bool = False
    phase: Array = field(init=False)
    f_ret: Array = field(init=False)
    f_ul: Array = field(init=False)
    waited: Array = field(init=False)

    def __post_init__(self) -> None:
        """Begin in the hold, or extended."""
        m = len(self.unlock)
        self.release = self.plan.release if self.release is None else self.release
        self.phase, self.waited = np.full(m, HOLD), np.zeros(m)
        self.f_ret, self.f_ul = np.full(m, 0.0 if self.whole else self.plan.stowed), np.zeros(m)

    def step(self, time: float, theta_ov: Array) -> None:
        """Go on by one control step."""
        begin = WHOLE_BEGIN if self.whole else BEGIN
        if time < begin - 0.5 * CONTROL_STEP:
            if self.whole:
                high, hold = self.plan.overtravel, self.plan.stowed
                self.f_ret[:] = np.interp(time, self.plan.schedule, (0.0, high, high, hold))
                self.f_ul[:] = np.interp(time, PULLED, (0.0, -DOWNLOCK_PULL, -DOWNLOCK_PULL, 0.0))
            return
        self.phase = np.maximum(self.phase, RAISE)
        ready = self._ready(theta_ov, time - begin)
        self.phase = np.where((self.phase == RAISE) & ready, FALL, self.phase)
        self._move(self._pulling())
        if self.whole:
            stowed = (self.phase == FALL) & (self.f_ret <= self.plan.stowed) & (self.f_ul == 0.0)
            self.waited = np.where(stowed, self.waited + CONTROL_STEP, self.waited)
            self.phase = np.where(stowed & (self.waited > SETTLE), EXTEND, self.phase)

    def _ready(self, theta_ov: Array, since: float) -> Array:
        """Return where the measure says unlocked, or patience ends."""
        if self.measure != "force":
            return np.asarray((theta_ov > THRESHOLD) | (since > PATIENCE))
        full = (self.phase == RAISE) & (self.f_ret >= self.plan.overtravel) & (-self.f_ul >= self.unlock)
        self.waited = np.where(full, self.waited + CONTROL_STEP, self.waited)
        done = (self.phase == RAISE) & (self.waited >= DWELL)
        self.waited = np.where(done, 0.0, self.waited)
        return np.asarray(done)

    def _pulling(self) -> Array:
        """Return where the unlock actuator pulls."""
        raising, falling = self.phase == RAISE, self.phase == FALL
        if self.measure == "position":
            return raising
        kept = falling & (self.f_ret > self.release)
        if self.measure == "scheduled":
            return raising | kept
        return np.asarray((raising & (self.f_ret >= self.plan.overtravel)) | kept)

    def _move(self, pulling: Array) -> None:
        ceiling = self.plan.overtravel if self.measure == "force" else self.plan.capacity
        target = np.select([self.phase == RAISE, self.phase == EXTEND], [ceiling, 0.0], self.plan.stowed)
        rate = np.where(self.phase == FALL, self.fall, RETRACTION_RATE)
        self.f_ret = _towards(self.f_ret, target, rate * CONTROL_STEP)
        self.f_ul = _towards(self.f_ul, np.where(pulling, -self.unlock, 0.0), UNLOCK_RATE * CONTROL_STEP)


def _towards(value: Array, target: Array, most: Any) -> Array:
    return np.asarray(value + np.clip(target - value, -most, most))


@dataclass(slots=True)
class Law:
    """What one actuator, F_ret or F_ul, does in a sequence."""

    actuator: str
    sequencer: Sequencer
    vectorised: bool = True

    def __call__(self, time: float, observed: Mapping[str, Any]) -> Array:
        """Return its force in every run."""
        self.sequencer.step(time, np.atleast_1d(observed["theta_ov"]))
        return self.sequencer.f_ret if self.actuator == "F_ret" else self.sequencer.f_ul


@dataclass(frozen=True, slots=True)
class Runs:
    """Runs of one measure: unlock forces (m,), histories, and outcomes as places in OUTCOMES, (m,)."""

    plan: Plan
    measure: str
    unlock: Array
    histories: Sequence[mc.History]

    @property
    def outcomes(self) -> Array:
        """Return what became of each run: judged in the hold, by the side of overcentre."""
        found = []
        for h in self.histories:
            theta = h["theta_ov"]
            passed = bool(np.any(theta > THRESHOLD))
            found.append(0 if theta[-1] > 0 else 3 if theta[-1] < self.plan.lowest else 2 if passed else 1)
        return np.array(found)

    @property
    def peaks(self) -> Array:
        """Return the largest retraction force of each run, (m,)."""
        return np.array([h["F_ret"].max() for h in self.histories])

    @property
    def highest(self) -> Array:
        """Return the largest theta_ov of each run in rad, (m,)."""
        return np.array([h["theta_ov"].max() for h in self.histories])


def unlock_runs(
    start: mc.Point,
    measure: str,
    unlock: Array,
    gusts: Sequence[Gust | None] | None = None,
    *,
    fall: Any = RETRACTION_RATE,
    release: Any = None,
    timestep: float = TIMESTEP,
) -> Runs:
    """Return runs of the unlocking alone from the stowed gear, one for each unlock force (m,) and gust."""
    unlock = np.asarray(unlock, dtype=float)
    plan = PLANS[start.problem.name]
    laws = {a: Law(a, Sequencer(plan, measure, unlock, fall, release)) for a in ("F_ret", "F_ul")}
    felt = gusts if gusts is not None else [None] * len(unlock)
    cases = [{"inputs": {**laws, **(g.inputs if g else {})}, "start": start} for g in felt]
    options = {"timestep": timestep, "control_step": CONTROL_STEP, "samples": SAMPLES}
    return Runs(plan, measure, unlock, mc.simulate_many(start.problem, cases, DURATION, **options))  # type: ignore[arg-type]


def whole_runs(gear: mc.Mechanism, measure: str, unlock: Array, gusts: Sequence[Gust | None]) -> Runs:
    """Return runs of retraction, uplock, unlocking and extension, from the gear locked down."""
    start = mc.find_equilibrium(gear, keyframe="downlock_below")
    unlock, plan = np.asarray(unlock, dtype=float), PLANS[gear.name]
    laws = {a: Law(a, Sequencer(plan, measure, unlock, whole=True)) for a in ("F_ret", "F_ul")}
    cases = [{"inputs": {**laws, **(g.inputs if g else {})}, "start": start} for g in gusts]
    histories = mc.simulate_many(
        gear, cases, WHOLE_DURATION, timestep=TIMESTEP, control_step=CONTROL_STEP, samples=1700
    )
    return Runs(plan, measure, unlock, histories)


@dataclass(frozen=True, slots=True)
class Chart:
    """Outcomes over peak gust velocity (a,) and unlock force (b,): the worst over arrival times.

    Attributes
    ----------
    outcomes : (a, b, c) places in OUTCOMES, for every arrival.
    peaks : (a, b, c) largest retraction force in N.
    """

    measure: str
    velocities: Array
    unlock: Array
    arrivals: Sequence[float]
    outcomes: Array
    peaks: Array

    @property
    def unlocked(self) -> Array:
        """Return the fraction of arrival times at which the gear unlocks, (a, b)."""
        return np.asarray(np.mean(self.outcomes == 0, axis=2))

    @property
    def needed(self) -> Array:
        """Return the least unlock force from which every run unlocks, (a,); NaN where none does."""
        found = []
        for row in self.unlocked == 1.0:
            bad = np.flatnonzero(~row)
            first = bad[-1] + 1 if len(bad) else 0
            found.append(self.unlock[first] if first < len(self.unlock) else np.nan)
        return np.array(found)


def chart(
    start: mc.Point,
    measure: str,
    velocities: Array,
    unlock: Array,
    arrivals: Sequence[float],
    gradient: float,
    aircraft: Aircraft,
    timestep: float = TIMESTEP,
) -> Chart:
    """Run every combination of gust velocity, unlock force and arrival time in one batch."""
    times = np.arange(0.0, DURATION + 0.01, 0.02)
    gusts = [[one_minus_cos(times, v, gradient, t, aircraft) for t in arrivals] for v in velocities.tolist()]
    shape = (len(velocities), len(unlock), len(arrivals))
    each = [gusts[i][k] for i, _, k in np.ndindex(shape)]
    forces = np.broadcast_to(unlock[None, :, None], shape).ravel()
    runs = unlock_runs(start, measure, forces, each, timestep=timestep)
    return Chart(
        measure, velocities, unlock, arrivals, runs.outcomes.reshape(shape), runs.peaks.reshape(shape)
    )


def draw_chart(figure: Any, ax: Any, chart: Chart, limit: float) -> None:
    """Draw the part of arrival times that ends unlocked, and the unlock force that statics asks for."""
    mesh = ax.pcolormesh(chart.velocities, chart.unlock, chart.unlocked.T, cmap="Blues", vmin=0.0, vmax=1.0,
                         shading="nearest", edgecolors="white", linewidth=0.4)
    ax.axhline(limit, color=COLORS[1], linestyle="--", linewidth=1.4)
    ax.grid(False)
    ax.set(xlabel="peak gust velocity [m/s], up positive", ylabel="unlock force [N]")
    figure.colorbar(mesh, ax=ax)


def counts(outcomes: Array) -> str:
    """Return how many runs had which outcome."""
    found = [(int(np.sum(outcomes == k)), name) for k, name in enumerate(OUTCOMES)]
    return ", ".join(f"{n} {name}" for n, name in found if n)
