"""Unlocking the nose gear from uplock under gusts: position and force measure.

Time histories of the 5-DOF gear: retraction, uplock, unlocking and extension. Position measure: the unlock actuator
pulls until the locklinks pass a sensor just past overcentre, then both forces are released. Force measure: the
retraction force is raised past the cusp's, the unlock force to a set value; then the retraction force falls, and the
unlock force is released below the fold FP1. Scheduled: the position measure with that late release. Gusts act as
histories of load factor and gravity angle: the 1-cos gusts of CS-25.341 at its longest gradient distance, with the
7.62 m/s that CS-25.345 asks for with high-lift devices out, and turbulence with the first-order Dryden spectrum. (a,
b) Whole sequences. (c, d) How many of the gust's arrival times end unlocked; dashed: the cusp's unlock force. (e) The
retraction force that position control goes up to. (f) As (c), scheduled.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from _gear import angle_of
from _gusts import Aircraft, dryden, one_minus_cos
from _loci import Case
from _unlocking import (
    DURATION,
    MEASURES,
    PLANS,
    RETRACTION_RATE,
    THRESHOLD,
    TIMESTEP,
    WHOLE_BEGIN,
    WHOLE_DURATION,
    Chart,
    Runs,
    chart,
    counts,
    draw_chart,
    unlock_runs,
    whole_runs,
)

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import COLORS, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script

HIGH_LIFT_GUST = 7.62  # m/s, CS-25.345: the gear is let down with high-lift devices out
CRUISE_GUST = 17.07  # m/s, the reference of CS-25.341 at sea level
GRADIENT = 107.0  # m: the longest of CS-25.341, 2.4 s at approach speed; the strut's own period is 3 s
UNLOCK = 500.0  # N: a fifth more than the cusp asks for
SIGMA, SCALE = 1.5, 150.0  # m/s and m: moderate turbulence at 150 m, where the vertical scale is the height
ARRIVALS = (4.0, 6.0, 8.0)  # s: gusts whose peak meets the rise, the unlock force, and the fall of F_ret
RELEASES = (4.6e5, 4.5e5, 4.4e5, 4.3e5, 4.2e5, 4.1e5)  # N
AIRCRAFT = Aircraft()
PLAN = PLANS["nose_gear"]


@dataclass(frozen=True, slots=True)
class Size:
    """How many runs the study takes: gust velocities, unlock forces, still-air forces, turbulence seeds."""

    velocities: int = 9
    forces: int = 9
    still: int = 21
    seeds: int = 16
    halved: tuple[int, ...] = (0, 4, 8)


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed."""

    cusp: mc.SpecialPoint
    fold: mc.SpecialPoint
    still: dict[str, Runs]
    fast: Runs
    rates: Array
    late: Runs
    charts: dict[str, Chart]
    fine: Chart
    halved: tuple[int, ...]
    rough: dict[str, Runs]
    whole: dict[str, Runs]


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    return present(compute(Size()), out)


def present(study: Study, out: Path) -> list[Finding]:
    """Draw a study and return its findings."""
    _draw(study, out / "unlocking.png")
    return [_sequence(study), _quasi_static(study), _couples(study), _scheduling(study), _gusts(study),
            _turbulence(study), _peak(study), _halving(study)]


def compute(size: Size) -> Study:
    """Compute everything, each group of runs in one batch."""
    gear = mc.Mechanism.from_xml("nose_gear")
    case = Case.of(gear, 1.0, 0.0)
    stowed = mc.find_equilibrium(gear, {"F_ret": PLAN.stowed}, keyframe="uplock_below")
    limit = -case.cusp["F_ul"]
    near = limit + np.linspace(-10.0, 10.0, size.still)
    velocities = np.linspace(-HIGH_LIFT_GUST, HIGH_LIFT_GUST, size.velocities)
    forces = np.linspace(375.0, 575.0, size.forces)
    options: Any = (ARRIVALS, GRADIENT, AIRCRAFT)
    rates = RETRACTION_RATE * 2.0 ** np.arange(6)
    times = np.arange(0.0, DURATION + 0.01, 0.02)
    seeds = [dryden(times, SIGMA, SCALE, seed, AIRCRAFT) for seed in range(size.seeds)]
    rows = list(size.halved)
    return Study(
        cusp=case.cusp,
        fold=case.fold,
        still={m: unlock_runs(stowed, m, near) for m in MEASURES},
        fast=unlock_runs(stowed, "position", np.full(len(rates), UNLOCK), fall=rates),
        rates=rates,
        late=_late(stowed),
        charts={m: chart(stowed, m, velocities, forces, *options) for m in MEASURES},
        fine=chart(stowed, "force", velocities[rows], forces, *options, timestep=TIMESTEP / 2.0),
        halved=size.halved,
        rough={m: unlock_runs(stowed, m, np.full(size.seeds, UNLOCK), seeds) for m in MEASURES},
        whole=_whole(gear),
    )


def _late(stowed: mc.Point) -> Runs:
    """Return runs by the force measure in the strongest gust upwards, released at RELEASES, each arrival in turn."""
    times = np.arange(0.0, DURATION + 0.01, 0.02)
    gusts = [one_minus_cos(times, HIGH_LIFT_GUST, GRADIENT, t, AIRCRAFT) for t in ARRIVALS] * len(RELEASES)
    releases = np.repeat(RELEASES, len(ARRIVALS))
    return unlock_runs(stowed, "force", np.full(len(gusts), UNLOCK), gusts, release=releases)


def _whole(gear: mc.Mechanism) -> dict[str, Runs]:
    times = np.arange(0.0, WHOLE_DURATION + 0.01, 0.02)
    gust = one_minus_cos(times, -HIGH_LIFT_GUST, GRADIENT, WHOLE_BEGIN + ARRIVALS[1], AIRCRAFT)
    gusts = (None, gust, dryden(times, SIGMA, SCALE, 0, AIRCRAFT))
    return {m: whole_runs(gear, m, np.full(3, UNLOCK), gusts) for m in MEASURES[:2]}


# --- drawing


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(3, 2, (8.6, 9.6))
    for ax, panel, measure in zip(axes[0], "ab", MEASURES, strict=False):
        for h, color, name in zip(study.whole[measure].histories, COLORS, ("still air", "gust", "turbulence"),
                                  strict=False):
            ax.plot(h["time"], np.degrees(h["theta_ov"]), color=color, linewidth=1.1, label=name)
        ax.axhline(0.0, color="#333333", linewidth=0.8)
        ax.axvspan(WHOLE_BEGIN, WHOLE_BEGIN + 10.0, color="#eeeeee", zorder=0)
        ax.set(xlabel="time [s]", ylabel=axis_label("theta_ov", "deg"), ylim=(-80, 80))
        ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8, loc="lower left")
        set_panel_title(ax, f"({panel})  {measure} measure, {UNLOCK:g} N; shaded: unlocking")
    for ax, panel, measure in zip(axes[1], "cd", MEASURES, strict=False):
        draw_chart(figure, ax, study.charts[measure], -study.cusp["F_ul"])
        set_panel_title(ax, f"({panel})  {measure} measure: part unlocked")
    _draw_peaks(axes[2, 0], study)
    draw_chart(figure, axes[2, 1], study.charts["scheduled"], -study.cusp["F_ul"])
    set_panel_title(axes[2, 1], "(f)  position measure, scheduled: part unlocked")
    save_figure(figure, path)


def _draw_peaks(ax: Any, study: Study) -> None:
    chart = study.charts["position"]
    row = int(np.argmin(abs(chart.unlock - UNLOCK)))
    peaks = chart.peaks[:, row] / 1e3
    for k, color in zip(range(len(ARRIVALS)), COLORS, strict=False):
        ax.plot(chart.velocities, peaks[:, k], "o-", color=color, markersize=4.0,
                label=f"gust from {ARRIVALS[k]:g} s")
    ax.axhline(study.cusp["F_ret"] / 1e3, color="#333333", linestyle=":", label="cusp")
    ax.set(xlabel="peak gust velocity [m/s], up positive", ylabel=f"peak {readable('F_ret')} [kN]")
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8)
    set_panel_title(ax, f"(e)  peak retraction force, position measure, {chart.unlock[row]:.0f} N")


# --- findings


def _deg(history: mc.History, column: str, time: float) -> float:
    return float(np.degrees(np.interp(time, history["time"], history[column])))


def _sequence(study: Study) -> Finding:
    force, position = (study.whole[m].histories[0] for m in ("force", "position"))
    moments = (WHOLE_BEGIN - 20.0, WHOLE_BEGIN, WHOLE_BEGIN + 15.0, WHOLE_DURATION)
    shown = [(_deg(force, "theta_1", t), _deg(force, "theta_ov", t)) for t in moments]
    (_, up), (_, locked), (_, free), (end, down) = shown
    other = _deg(position, "theta_ov", moments[2])
    return Finding(
        "In still air the gear retracts above overcentre, locks up below, is unlocked by the force measure, and "
        "extends above overcentre to the downlock; by the position measure it comes down still locked.",
        f"theta_ov while retracting, stowed and after unlocking by force: {up:+.1f}, {locked:+.1f} and {free:+.1f} "
        f"deg; at the end theta_1 = {end:+.2f} deg, theta_ov = {down:+.1f} deg. By position theta_ov is {other:+.1f} "
        "deg after unlocking. A limit of the model: only the spring and F_ret hold the gear up, so a locked gear "
        "comes down, too",
        up > 0 > locked and free > 0 > down and abs(end) < 1.0 and other < 0,
    )


def _quasi_static(study: Study) -> Finding:
    runs, limit = study.still["force"], -study.cusp["F_ul"]
    good = runs.outcomes == 0
    first = int(np.argmax(good))
    low, high = (float(runs.unlock[first - 1]), float(runs.unlock[first])) if first else (np.nan, np.nan)
    return Finding(
        "The cusp tells which unlock force unlocks the moving gear in still air, by the force measure.",
        f"every force from {high:.1f} N on unlocks, none up to {low:.1f} N (cusp {limit:.1f} N, "
        f"theta_ov = {angle_of(study.cusp):+.2f} deg there)",
        bool(np.all(good[first:])) and first > 0 and max(abs(low - limit), abs(high - limit)) < 0.02 * limit,
    )


def _couples(study: Study) -> Finding:
    runs, chart = study.still["position"], study.charts["position"]
    calm = chart.outcomes[len(chart.velocities) // 2]
    unlocked = study.rates[study.fast.outcomes == 0]
    enough = f"from {unlocked.min() / 1e3:.0f} kN/s on" if len(unlocked) else "none"
    return Finding(
        "A position measure couples the actuators: past overcentre the retraction force drives the locklinks back when "
        "the unlock force is released.",
        f"in still air {counts(np.concatenate([runs.outcomes, calm[:, 0]]))}, for forces up to "
        f"{chart.unlock[-1]:.0f} N: the sensor sees {np.degrees(THRESHOLD):.0f} deg, but without unlock force the gear "
        f"rests above overcentre only beyond theta_ov = {angle_of(study.fold):.1f} deg and below F_ret = "
        f"{study.fold['F_ret'] / 1e3:.1f} kN. Rates of release of F_ret that would do at {UNLOCK:g} N, of "
        f"{study.rates[0] / 1e3:.0f} to {study.rates[-1] / 1e3:.0f} kN/s: {enough}",
        not np.any(runs.outcomes == 0) and not np.any(calm == 0),
    )


def _scheduling(study: Study) -> Finding:
    chart = study.charts["scheduled"]
    middle = len(chart.velocities) // 2
    needed = chart.needed[middle]
    above = chart.unlocked[middle][chart.unlock > 1.1 * -study.cusp["F_ul"]]
    return Finding(
        "Additional scheduling mends it: with the unlock force kept until the retraction force has fallen below the "
        "fold, the position measure unlocks as well.",
        f"in still air every unlock force from {needed:.0f} N on unlocks (tried every "
        f"{chart.unlock[1] - chart.unlock[0]:.0f} N)",
        bool(np.all(above == 1.0)),
    )


def _gusts(study: Study) -> Finding:
    chart, limit = study.charts["force"], -study.cusp["F_ul"]
    shown = []
    for v, n in zip(chart.velocities, chart.needed, strict=True):
        if np.isnan(n):
            worst = chart.outcomes[np.flatnonzero(chart.velocities == v)[0], -1]
            shown.append(f"{v:+.1f} m/s: not sure up to {chart.unlock[-1]:.0f} N ({counts(worst)} there)")
        else:
            shown.append(f"{v:+.1f} m/s: {n:.0f} N ({100.0 * (n / limit - 1.0):+.0f} %)")
    times = np.arange(0.0, DURATION, 0.02)
    felt = one_minus_cos(times, HIGH_LIFT_GUST, GRADIENT, 5.0, AIRCRAFT)
    late = np.sum(study.late.outcomes.reshape(len(RELEASES), -1) == 0, axis=1)
    releases = ", ".join(f"{n} at {force / 1e3:.0f} kN" for n, force in zip(late, RELEASES, strict=True))
    down = chart.needed[chart.velocities <= 0.0]
    return Finding(
        "A gust that unloads the gear after the unlock force has gone locks it again whatever the unlock force was: "
        "the margin on the cusp covers gusts downwards, but not those upwards, after which the load factor falls below "
        "1 and with it the fold.",
        f"unlock force from which every arrival time unlocks, and margin on {limit:.1f} N: {'; '.join(shown)}. A gust "
        f"of {HIGH_LIFT_GUST} m/s over {GRADIENT:.0f} m gives load factors of {felt.load_factor.min():.2f} to "
        f"{felt.load_factor.max():.2f}; up, at {UNLOCK:g} N, of {len(ARRIVALS)} arrival times unlock, by the "
        f"retraction force at release: {releases} (the cruise gust of the codes is {CRUISE_GUST} m/s)",
        bool(np.all(down < 1.15 * limit)) and bool(np.isnan(chart.needed[-1])),
    )


def _turbulence(study: Study) -> Finding:
    shown = [f"{m}: {counts(study.rough[m].outcomes)}" for m in MEASURES]
    unlocked = {m: int(np.sum(study.rough[m].outcomes == 0)) for m in MEASURES}
    return Finding(
        "In moderate turbulence the force measure unlocks more surely than the position measure.",
        f"of {len(study.rough['force'].unlock)} seeds at {UNLOCK:g} N, sigma = {SIGMA} m/s, L = {SCALE:.0f} m: "
        f"{'; '.join(shown)}",
        unlocked["force"] > unlocked["position"],
    )


def _peak(study: Study) -> Finding:
    chart = study.charts["position"]
    row = int(np.argmin(abs(chart.unlock - UNLOCK)))
    peaks, calm = chart.peaks[:, row], chart.peaks[len(chart.velocities) // 2, row, 0]
    (i, k), (j, m) = (np.unravel_index(f(peaks), peaks.shape) for f in (np.argmax, np.argmin))
    return Finding(
        "The peak retraction force depends on the disturbance: a gust changes what is needed to pass overcentre.",
        f"position measure at {chart.unlock[row]:.0f} N: {calm / 1e3:.1f} kN in still air, from "
        f"{peaks[j, m] / 1e3:.1f} kN ({chart.velocities[j]:+.1f} m/s, gust from {ARRIVALS[m]:g} s) to "
        f"{peaks[i, k] / 1e3:.1f} kN ({chart.velocities[i]:+.1f} m/s, from {ARRIVALS[k]:g} s). "
        f"By the force measure it is {PLAN.overtravel / 1e3:.0f} kN whatever the gust",
        bool(peaks.max() > 1.01 * calm),
    )


def _halving(study: Study) -> Finding:
    coarse = study.charts["force"].outcomes[list(study.halved)]
    changed = int(np.sum(coarse != study.fine.outcomes))
    return Finding(
        "The outcomes do not depend on the time step.",
        f"halving it from {TIMESTEP * 1e3:g} ms changes {changed} of {coarse.size} outcomes, by the force measure",
        changed <= 0.02 * coarse.size,
    )


if __name__ == "__main__":
    run_script(main)
