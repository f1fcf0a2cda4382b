"""Unlocking the gear that locks under gusts: position and force measure, and what a stop is good for.

As the study of the first gear (unlocking), with the gear that locks (nose_gear_locking) and forces that suit it: stowed
under 470 kN, 4 % above FP2, raised to 530 kN, 3 % above the cusp. The sequence begins stowed and locked. (a) Still air
and a gust, force measure, 200 N. (b, c) How many of the gust's arrival times end unlocked; dashed: the unlock force at
the turn of FP1's locus, w . f_F_ret = 0. (d) Stowed without unlock force, largest theta_ov below overcentre in a gust:
without a stop under the hold of 470 kN, with the stop of nose_gear_stop under no retraction force at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from _gear import LOCKING
from _gusts import Aircraft, one_minus_cos
from _loci import Case
from _unlocking import (
    DURATION,
    OUTCOMES,
    PLANS,
    SAMPLES,
    TIMESTEP,
    Chart,
    Runs,
    chart,
    counts,
    draw_chart,
    unlock_runs,
)

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import COLORS, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script

PLAN = PLANS[LOCKING]
HIGH_LIFT_GUST = 7.62  # m/s, CS-25.345
GRADIENT = 107.0  # m, the longest of CS-25.341
ARRIVALS = (4.0, 6.0, 8.0)  # s
FORCES = np.array([10.0, 20.0, 50.0, 100.0, 200.0, 350.0, 500.0])  # N
SHOWN = 200.0  # N
AIRCRAFT = Aircraft()
TWO = ("position", "force")


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed; `held` and `stopped` are the stowed gears in gusts, without unlock force."""

    case: Case
    still: dict[str, Runs]
    charts: dict[str, Chart]
    fine: Chart
    shown: Runs
    velocities: Array
    held: Sequence[mc.History]
    stopped: Sequence[mc.History]


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "locking_gusts.png")
    return [_turn(study), _no_coupling(study), _gusts(study), _lets_go(study), _stop(study), _halving(study)]


def compute(velocities: int = 9, still: int = 13) -> Study:
    """Compute everything, each group of runs in one batch."""
    gear, stop = mc.Mechanism.from_xml(LOCKING), mc.Mechanism.from_xml("nose_gear_stop")
    case, stowed = Case.of(gear, 1.0, 0.0), _locked(gear, PLAN.stowed)
    near = -case.exchange["F_ul"] * np.linspace(0.94, 1.06, still)
    speeds = np.linspace(-HIGH_LIFT_GUST, HIGH_LIFT_GUST, velocities)
    times = np.arange(0.0, DURATION + 0.01, 0.02)
    gusts = [one_minus_cos(times, v, GRADIENT, ARRIVALS[0], AIRCRAFT) for v in speeds.tolist()]
    options: Any = (ARRIVALS, GRADIENT, AIRCRAFT)
    return Study(
        case=case,
        still={m: unlock_runs(stowed, m, near) for m in TWO},
        charts={m: chart(stowed, m, speeds, FORCES, *options) for m in TWO},
        fine=chart(stowed, "force", speeds[_rows(velocities)], FORCES, *options, timestep=TIMESTEP / 2.0),
        shown=unlock_runs(stowed, "force", np.full(3, SHOWN), [None, gusts[2], gusts[-3]]),
        velocities=speeds,
        held=_in_gusts(stowed, gusts),
        stopped=_in_gusts(_locked(stop, 0.0), gusts),
    )


def _rows(velocities: int) -> list[int]:
    """Return the gusts for which the time step is halved: the weakest three, and the two strongest."""
    middle = velocities // 2
    return [middle - 1, middle, middle + 1, 0, velocities - 1]


def _locked(gear: mc.Mechanism, force: float) -> mc.Point:
    """Return the locked gear's rest under a retraction force, followed from far above FP1."""
    branch = mc.continue_equilibria(gear, "F_ret", (0.0, 8e5), {"F_ret": 6e5}, keyframe="uplock_below")
    return max((p for p in branch.at(F_ret=force) if p.n_unstable == 0), key=lambda p: p["theta_ov"])


def _in_gusts(start: mc.Point, gusts: Sequence[Any]) -> Sequence[mc.History]:
    gear: Any = start.problem
    forces = {n: float(start[n]) for n in ("F_ret", "F_ul")}
    cases = [{"inputs": {**forces, **g.inputs}, "start": start} for g in gusts]
    # the model's own step and integrator: "discrete" would make the stop stiffer than it is
    options: Any = {"timestep": TIMESTEP} if gear.name == LOCKING else {"integrator": "model"}
    return mc.simulate_many(gear, cases, DURATION, samples=SAMPLES, **options)


# --- drawing


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(2, 2, (9.6, 7.2))
    names = ("still air", *(f"gust of {study.velocities[k]:+.1f} m/s" for k in (2, -3)))
    for h, color, name in zip(study.shown.histories, COLORS, names, strict=False):
        axes[0, 0].plot(h["time"], np.degrees(h["theta_ov"]), color=color, linewidth=1.2, label=name)
    axes[0, 0].axhline(0.0, color="#333333", linewidth=0.8)
    axes[0, 0].set(xlabel="time [s]", ylabel=axis_label("theta_ov", "deg"))
    axes[0, 0].legend(frameon=False, fontsize=8.0, loc="center right")
    set_panel_title(axes[0, 0], f"(a)  force measure, {SHOWN:g} N")
    limit = -study.case.exchange["F_ul"]
    for ax, panel, measure in zip((axes[0, 1], axes[1, 0]), "bc", TWO, strict=True):
        draw_chart(figure, ax, study.charts[measure], limit)
        ax.set(yscale="log", ylim=(8.0, 620.0))
        set_panel_title(ax, f"({panel})  {measure} measure: part unlocked")
    stowed = ((study.held, COLORS[0], "470 kN, no stop"), (study.stopped, COLORS[1], "no force, a stop"))
    for histories, color, name in stowed:
        axes[1, 1].plot(study.velocities, _lowest(histories), "o-", color=color, label=name)
    axes[1, 1].set(xlabel="peak gust velocity [m/s], up positive", ylabel=f"lowest {readable('theta_ov')} [deg]")
    axes[1, 1].legend(title="stowed under", frameon=False, fontsize=8.0, title_fontsize=8.0)
    set_panel_title(axes[1, 1], "(d)  locked, no unlock force")
    save_figure(figure, path)


def _lowest(histories: Sequence[mc.History]) -> Array:
    """Return the lowest theta_ov of each history in deg, a full turn at most."""
    return np.array([max(float(np.degrees(h["theta_ov"].min())), -180.0) for h in histories])


# --- findings


def _turn(study: Study) -> Finding:
    limit = -study.case.exchange["F_ul"]
    shown, right = [], []
    for m, runs in study.still.items():
        good = runs.outcomes == OUTCOMES.index("unlocked")
        first = int(np.argmax(good))
        low, high = float(runs.unlock[first - 1]), float(runs.unlock[first])
        shown.append(f"by {m} from {high:.2f} N on, not up to {low:.2f} N")
        right.append(first > 0 and bool(np.all(good[first:])))
        right.append(max(abs(low - limit), abs(high - limit)) < 0.03 * limit)
    return Finding(
        "In still air the turn of FP1's locus, w . f_F_ret = 0, tells which unlock force unlocks the moving gear: far "
        "less than at the cusp.",
        f"{'; '.join(shown)}. The turn: {limit:.3f} N; the cusp: {-study.case.cusp['F_ul']:.1f} N",
        all(right),
        LOCKING,
    )


def _no_coupling(study: Study) -> Finding:
    chart = study.charts["position"]
    row, middle = int(np.argmin(abs(FORCES - SHOWN))), len(chart.velocities) // 2
    peak = chart.peaks[middle, row, 0]
    fold = study.case.fold
    return Finding(
        "This gear's actuators do not couple as the first one's: the position measure unlocks in still air as well.",
        f"{counts(chart.outcomes[middle, 1:, 0])} for forces of {FORCES[1]:g} to {FORCES[-1]:g} N. The locked gear "
        f"opens at F_ret = {peak / 1e3:.0f} kN ({SHOWN:g} N), below FP1 at {fold['F_ret'] / 1e3:.1f} kN, and swings "
        f"far above overcentre; the first gear opens above its FP1, where F_ret drives it back",
        bool(np.all(chart.outcomes[middle, 1:] == 0)) and peak < fold["F_ret"],
        LOCKING,
    )


def _gusts(study: Study) -> Finding:
    shown, sure = [], {}
    for m, c in study.charts.items():
        sure[m] = [bool(np.all(row == 0)) for row in c.outcomes[:, 1:].reshape(len(c.velocities), -1)]
        speeds = ", ".join(f"{v:+.1f}" for v, s in zip(c.velocities, sure[m], strict=True) if s)
        shown.append(f"by {m} every force from {FORCES[1]:g} N on unlocks at every arrival time in gusts of {speeds} "
                     f"m/s; of all runs {counts(c.outcomes)}")
    middle = len(study.velocities) // 2
    return Finding(
        "Weak gusts do not matter, strong ones do, by either measure: the locked gear lets go when a gust loads it, "
        "and locks again, or passes the dead centre, when one unloads it.",
        "; ".join(shown),
        all(s[middle] and s[middle + 1] and not s[0] and not s[-1] for s in sure.values()),
        LOCKING,
    )


def _lets_go(study: Study) -> Finding:
    lowest = _lowest(study.held)
    gone = [f"{v:+.1f}" for v, low in zip(study.velocities, lowest, strict=True) if low < np.degrees(PLAN.lowest)]
    kept = [f"{v:+.1f}" for v, low in zip(study.velocities, lowest, strict=True) if low >= np.degrees(PLAN.lowest)]
    return Finding(
        "Without a stop the lock does not bear a gust: FP2 rises with the load factor, above the force that holds the "
        "gear.",
        f"stowed under {PLAN.stowed / 1e3:.0f} kN without unlock force, it leaves the lock in gusts of "
        f"{', '.join(gone)} m/s, not at {', '.join(kept)} m/s",
        bool(lowest[0] < np.degrees(PLAN.lowest)) and bool(lowest[len(lowest) // 2] > np.degrees(PLAN.lowest)),
        LOCKING,
    )


def _stop(study: Study) -> Finding:
    lowest = _lowest(study.stopped)
    highest = max(float(np.degrees(h["theta_ov"].max())) for h in study.stopped)
    return Finding(
        "With a stop it does, without any retraction force.",
        f"in all {len(lowest)} gusts theta_ov stays between {lowest.min():.2f} and {highest:.2f} deg",
        bool(lowest.min() > -6.0) and highest < 0.0,
        "nose_gear_stop",
    )


def _halving(study: Study) -> Finding:
    coarse = study.charts["force"].outcomes[_rows(len(study.velocities))]
    changed = (coarse == 0) != (study.fine.outcomes == 0)
    weak, strong = changed[:3], changed[3:]
    return Finding(
        "In still air and weak gusts the outcomes do not depend on the time step; in the strongest ones single runs "
        "do, which is why only parts of the arrival times are told.",
        f"halving it from {TIMESTEP * 1e3:g} ms changes whether it unlocks in {int(weak.sum())} of {weak.size} runs up "
        f"to {abs(study.velocities[_rows(len(study.velocities))[0]]):.1f} m/s, and in {int(strong.sum())} of "
        f"{strong.size} at {HIGH_LIFT_GUST} m/s, by the force measure",
        weak.sum() <= 0.02 * weak.size,
        LOCKING,
    )


if __name__ == "__main__":
    run_script(main)
