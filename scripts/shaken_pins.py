"""Elastic pins where the mechanism oscillates: how stiff, how damped, and what an oscillation does to a lock.

Overcentre mechanism and both gears near uplock under a harmonic F, F_ret and load factor, against the same linkages
with rigid pins (one equation, _rigid_linkage). (a) Largest difference of the swings about their means, relative to the
rigid one's, over k_j. (b) Small swings of the overcentre mechanism over the frequency, relative to that of the lowest
bush mode, for damping of that mode. (c) Amplitudes of F_ret under which the gear that locks, held 1 % above FP2, lets
go, over the frequency: folds of the response (LPC), and histories under a growing amplitude. (d) The same gear held 4 %
above FP2 swings towards dead centre: rigid pins whip the locklinks through, elastic ones give.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from _shaken import CASES, NAMES, Compared, Shaken, bush_mode, by_frequency, compare, held, rests, stiffened
from scipy.integrate import solve_ivp

import mjcont as mc
from mjcont.drawing.plotting import COLORS, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script

RATIOS = (0.0, 0.01, 0.1, 1.0)  # of the lowest bush mode's damping
HELD, HIGHER, FP2 = 4.55e5, 4.7e5, 450322.109  # N; FP2 computed apart from MuJoCo
DAMPINGS = (500.0, 2500.0)  # of the strut's hinge, N m s/rad: a fifth of the model's own, and that
FREQUENCIES = np.array([0.16, 0.2, 0.24, 0.26, 0.28, 0.3, 0.32, 0.36])  # Hz
FOLDS, GUSTS = (0.2, 0.24, 0.28), np.array([0.2, 0.24, 0.28, 0.32])  # Hz
TOPS = {"F_ret": 8e3, "load_factor": 0.018}  # to which amplitudes grow evenly
LASTS, TIMESTEP = 200.0, 2e-3  # s
BESIDE = (0.95, 1.05)  # amplitudes in units of a fold's
DEAD = (0.5, 15e3)  # Hz, N: what swings the gear, held 4 % above FP2, to dead centre, and its largest amplitude
SWEPT = np.geomspace(0.05, 2.0, 121)  # frequencies in units of the lowest bush mode's
SOFT = 1e4  # N/m, of the overcentre mechanism's pins there
AWAY = np.radians((-35.0, 20.0))  # rad: theta_ov outside has left the lock


@dataclass(frozen=True, slots=True)
class Escape:
    """The lock under a load that swings, with a damping of the strut's hinge.

    Attributes
    ----------
    load, damping : what swings; of the hinge.
    slow, ratio : frequency and damping ratio of the slow mode.
    static : the amplitude that reaches the static fold.
    frequencies, seen : Hz, and amplitudes at which histories of elastic pins let go, inf where they do not.
    folds : amplitudes of the folds of the rigid linkage's response by frequency.
    """

    load: str
    damping: float
    slow: float
    ratio: float
    static: float
    frequencies: Array
    seen: Array
    folds: Mapping[float, float]


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed; `curves` by damping ratio over `SWEPT`, `scaled` and `fixed` ratios, `damped` by c_j."""

    compared: list[Compared]
    curves: Mapping[float, Array]
    scaled: Mapping[float, float]
    fixed: float
    damped: Mapping[float, float]
    escapes: list[Escape]
    elastic_fold: float
    kept: Mapping[float, list[bool]]
    rigid_way: tuple[Array, Array]
    elastic_way: tuple[Array, Array]


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "shaken_pins.png")
    return findings(study)


def compute() -> Study:
    """Compute everything."""
    three = rests()
    compared = [compare(model, three[model], load) for model, (loads, *_) in CASES.items() for load in loads]
    soft, stiff = three["overcentre"], three["nose_gear_locking"]
    scaled = {k: bush_mode(stiffened(stiff, k_j=k, c_j=2e4 * np.sqrt(k / 1e8)))[1] for k in (1e7, 1e8, 1e9, 1e10)}
    escapes = [escape("F_ret", d, FREQUENCIES) for d in DAMPINGS] + [escape("load_factor", DAMPINGS[0], GUSTS)]
    kept = {e.damping: lets_go(held(HELD, c_D=e.damping), f, np.array(BESIDE) * e.folds[f])
            for e, f in zip(escapes[:2], (0.28, 0.24), strict=True)}
    fixed = bush_mode(stiffened(stiff, k_j=1e10))[1]
    curves = by_frequency(soft, SOFT, SWEPT, RATIOS)
    return Study(compared, curves, scaled, fixed, in_band(stiff), escapes, elastic_fold(), kept,
                 *dead_centre(stiff))


def in_band(shaken: Shaken) -> dict[float, float]:
    """Return how far F_ret's transfer function to theta_ov at 0.25 Hz is from the rigid one, by c_j."""
    exact = shaken.linkage.response(shaken.y, "F_ret", np.array([0.25]))
    return {c: float(np.abs(mc.transfer(stiffened(shaken, c_j=c), "F_ret", ["theta_ov"], [0.25])["theta_ov"] / exact
                            - 1.0)[0]) for c in (0.0, 2e4, 2e5, 1e6)}


def escape(load: str, damping: float, frequencies: Array) -> Escape:
    """Return at which amplitudes of a load the gear, held 1 % above FP2, lets go."""
    rest, top = held(HELD, c_D=damping), TOPS[load]
    shaken, slow = Shaken.of("nose_gear_locking", rest, "theta_ov", (-45.0, 40.0)), mc.modes(rest)[0]
    still = mc.continue_equilibria(rest.problem, load, (rest[load] * 0.97, rest[load] * 1.03), rest)
    static = min(abs(p[load] - rest[load]) for p in still.of_kind("LP"))
    folds = {}
    for f in FOLDS:
        curve = mc.continue_response(
            shaken.linkage.field(load), "amplitude", (0.0, top), start={"f": f, "amplitude": top / 80.0},
            state=[shaken.y, 0.0], direction=1, max_points=45)
        lost = [p["amplitude"] for p in curve.of_kind("LPC")]
        if lost:
            folds[f] = lost[0]
    seen = grown(rest, load, frequencies, top)
    return Escape(load, damping, slow.omega / (2.0 * np.pi), slow.damping_ratio, static, frequencies, seen, folds)


def elastic_fold() -> float:
    """Return the amplitude of F_ret at the fold of the elastic gear's own response, at 0.28 Hz, lightly damped."""
    rest = held(HELD, c_D=DAMPINGS[0])
    curve = mc.continue_response(
        rest.problem, "F_ret.amplitude", (0.0, TOPS["F_ret"]), {"F_ret": mc.Harmonic(1000.0)}, rest, frequency=0.28,
        state=rest.state, direction=1, max_points=40, stop=lambda row: row["F_ret.amplitude"] > 3e3)
    return float(next((p["F_ret.amplitude"] for p in curve.of_kind("LPC")), np.nan))


def grown(rest: mc.Point, load: str, frequencies: Array, top: float) -> Array:
    """Return the amplitudes, growing evenly to a top, at which theta_ov leaves the lock; inf where it does not."""
    times = np.linspace(0.0, LASTS, 40001)
    waves = [top * times / LASTS * np.cos(2.0 * np.pi * f * times) for f in frequencies]
    return _left(rest, load, times, waves) * top / LASTS


def lets_go(rest: mc.Point, frequency: float, amplitudes: Array) -> list[bool]:
    """Return whether theta_ov leaves the lock under amplitudes of F_ret that grow over a third of the time and stay."""
    times = np.linspace(0.0, LASTS, 40001)
    waves = [a * np.minimum(3.0 * times / LASTS, 1.0) * np.cos(2.0 * np.pi * frequency * times) for a in amplitudes]
    return np.isfinite(_left(rest, "F_ret", times, waves)).tolist()


def _left(rest: mc.Point, load: str, times: Array, waves: list[Array]) -> Array:
    """Return when theta_ov leaves the lock, in s, as waves are added to a load, inf where it does not."""
    cases = [{"inputs": {load: (times, rest[load] + wave)}, "start": rest} for wave in waves]
    runs = mc.simulate_many(rest.problem, cases, LASTS, samples=8000, timestep=TIMESTEP)
    outside = [(h["theta_ov"] < AWAY[0]) | (h["theta_ov"] > AWAY[1]) for h in runs]
    return np.array([h["time"][np.argmax(o)] if o.any() else np.inf for h, o in zip(runs, outside, strict=True)])


def dead_centre(shaken: Shaken) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Return amplitude and theta_ov under a growing one, with rigid pins until they leave the lock, and elastic."""
    (frequency, top), lasts, linkage = DEAD, 120.0, shaken.linkage

    def motion(t: float, u: Array) -> list[float]:
        force = HIGHER + top * t / lasts * np.cos(2.0 * np.pi * frequency * t)
        row, _ = linkage.table.at(u[0])
        return [u[1], linkage.force(u[0], F_ret=force) - row[1] * u[1]]

    def away(t: float, u: Array) -> float:
        return float(u[0] - linkage.way(AWAY[1]))

    away.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(motion, (0.0, lasts), [shaken.y, 0.0], method="LSODA", events=away, rtol=1e-7, atol=1e-8,
                    max_step=0.02)
    times = np.linspace(0.0, lasts, 24001)
    wave = HIGHER + top * times / lasts * np.cos(2.0 * np.pi * frequency * times)
    history = mc.simulate(shaken.rest.problem, {"F_ret": (times, wave)}, lasts, shaken.rest, samples=12000)
    return ((run.t * top / lasts, linkage.angle(run.y[0])), (history["time"] * top / lasts, history["theta_ov"]))


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(2, 2, (9.6, 7.4))
    ax = axes[0, 0]
    for i, c in enumerate(study.compared):
        ax.loglog(c.stiffness, c.apart, "-" if i % 2 == 0 else "--", color=COLORS[i // 2], linewidth=1.2,
                  label=f"{NAMES[c.model]}, {c.load}")
    ax.axhline(0.01, color="#888888", linewidth=0.8)
    ax.set(xlabel="k_j [N/m]", ylabel="difference / rigid amplitude")
    ax.legend(frameon=False, fontsize=7.5)
    set_panel_title(ax, "(a)  swings with elastic and rigid pins")
    ax = axes[0, 1]
    for i, (ratio, curve) in enumerate(study.curves.items()):
        ax.loglog(SWEPT, curve, color=COLORS[i], linewidth=1.2, label=f"bush mode damped by {ratio:g}")
    ax.set(xlabel="frequency / that of the lowest bush mode", ylabel="|H / H_rigid - 1|")
    ax.legend(frameon=False, fontsize=8)
    set_panel_title(ax, f"(b)  small swings of the overcentre, k_j = {SOFT:.0e} N/m")
    _draw_escapes(axes[1, 0], study.escapes[:2])
    ax = axes[1, 1]
    for (amplitude, angle), color, name in ((study.rigid_way, COLORS[1], "rigid pins"),
                                            (study.elastic_way, COLORS[0], "k_j = 1e8 N/m")):
        ax.plot(amplitude / 1e3, np.degrees(angle), color=color, linewidth=0.7, label=name)
    ax.axhline(0.0, color="#888888", linewidth=0.8)
    ax.set(xlabel="amplitude of F_ret, growing [kN]", ylabel="theta_ov [deg]")
    ax.legend(frameon=False, fontsize=8, loc="lower left")
    set_panel_title(ax, f"(d)  held by {HIGHER / 1e3:.0f} kN, shaken at {DEAD[0]:g} Hz")
    save_figure(figure, path)


def _draw_escapes(ax: Any, escapes: list[Escape]) -> None:
    for e, color in zip(escapes, COLORS, strict=False):
        ax.plot(e.frequencies, np.where(np.isfinite(e.seen), e.seen, np.nan) / 1e3, "o-", color=color, linewidth=0.8,
                label=f"lets go, c_D = {e.damping:g} N m s/rad")
        if e.folds:
            ax.plot(list(e.folds), np.array(list(e.folds.values())) / 1e3, "h", color=color, markersize=9,
                    markerfacecolor="none", label=f"LPC, c_D = {e.damping:g} N m s/rad")
    ax.axhline(escapes[0].static / 1e3, color="#333333", linestyle="--", linewidth=1.0, label="static fold")
    ax.set(xlabel="frequency [Hz]", ylabel="amplitude of F_ret [kN]", ylim=(0.0, None))
    ax.legend(frameon=False, fontsize=8)
    set_panel_title(ax, f"(c)  held by {HELD / 1e3:.0f} kN, 1 % above FP2")


def findings(study: Study) -> list[Finding]:
    """Return the study's findings."""
    light, own, gust = study.escapes
    rigid, elastic = study.rigid_way, study.elastic_way
    slopes = [c.slope for c in study.compared]
    needed = {c.model: max(d.needed() for d in study.compared if d.model == c.model) for c in study.compared}
    factors = [f for c in study.compared for f in c.factor]
    at = {r: [float(np.interp(x, SWEPT, curve)) for x in (0.1, 1.0)] for r, curve in study.curves.items()}
    least, late = int(np.argmin(light.seen)), float(np.min(own.seen))
    weak = int(np.argmin(gust.seen))
    fold = light.folds[0.28]
    whips = float(np.degrees(rigid[1][-1]))
    damped = list(study.damped.values())
    return [
        Finding("Responses with elastic pins are those with rigid ones, and differ by a part that falls as 1 / k_j",
                f"powers {min(slopes):.3f} to {max(slopes):.3f}; 1 % is reached at "
                + ", ".join(f"{k:.1e} N/m ({NAMES[m]})" for m, k in needed.items()),
                all(abs(s + 1.0) < 0.05 for s in slopes)),
        Finding("What is enough for equilibria need not be for oscillations: the locklinks' dead centre is near",
                f"first gear at its own k_j = 1e6 N/m: swings differ by {100 * study.compared[2].apart[0]:.0f} % and "
                f"{100 * study.compared[3].apart[0]:.0f} %; gear that locks at 1e8 N/m: "
                + " and ".join(f"{100 * _at(c, 1e8):.2f} %" for c in study.compared[4:]),
                min(c.apart[0] for c in study.compared[2:4]) > 0.1 > max(_at(c, 1e8) for c in study.compared[4:])),
        Finding("The rule: twice what doubling k_j changes in the transfer function at rest is what the pins change in "
                "the response",
                f"differences below a tenth are {min(factors):.2f} to {max(factors):.2f} times what is told",
                0.8 < min(factors) and max(factors) < 1.25),
        Finding("The lowest bush mode spoils what comes near its frequency, by its damping; a tenth of that is safe",
                "small swings differ by "
                + ", ".join(f"{100 * v[0]:.1f} % at a tenth of it and {v[1]:.3g}-fold at it (damped by {r:g})"
                            for r, v in at.items()),
                all(v[0] < 0.05 for v in at.values()) and at[0.01][1] > 2.0 * at[0.1][1] > 8.0 * at[1.0][1]),
        Finding("Damping that grows as the root of k_j damps the bush modes alike; the swing below them hardly notices",
                "damping ratio " + ", ".join(f"{z:.4f} ({k:.0e} N/m)" for k, z in study.scaled.items())
                + f", and {study.fixed:.4f} (1e+10 N/m) with the c_j of 1e+08; at 0.25 Hz the gear's swing differs "
                "from the rigid one by "
                + ", ".join(f"{100 * e:.3f} % (c_j = {c:g} N s/m)" for c, e in study.damped.items()),
                max(study.scaled.values()) < 1.5 * min(study.scaled.values()) and study.fixed < 0.2 * study.scaled[1e10]
                and np.ptp(damped) < 1e-4),
        Finding("An oscillation unlocks the gear below the static fold if the strut's hinge is lightly damped",
                f"static fold at {light.static:.0f} N; damping ratio {light.ratio:.3f}: lets go from "
                f"{light.seen[least]:.0f} N at {light.frequencies[least]:g} Hz, its swing being lost at the fold of "
                f"the response at {fold:.0f} N (rigid pins) and {study.elastic_fold:.0f} N (elastic); amplitudes kept "
                f"at {BESIDE[0]:g} and {BESIDE[1]:g} of that: {_told(study.kept[light.damping])}",
                fold < light.seen[least] < light.static and abs(study.elastic_fold / fold - 1.0) < 0.05
                and study.kept[light.damping] == [False, True]),
        Finding("So does a gust",
                f"load factor 1 + {gust.seen[weak]:.4f} cos at {gust.frequencies[weak]:g} Hz, where the static fold is "
                f"at 1 + {gust.static:.4f}; folds of the response at "
                + ", ".join(f"{a:.4f} ({f:g} Hz)" for f, a in gust.folds.items()),
                gust.seen[weak] < gust.static and min(gust.folds.values()) < gust.seen[weak]),
        Finding("With the model's own damping it does not: the static fold is the safe one",
                f"damping ratio {own.ratio:.3f}: lets go from {late:.0f} N on, static fold {own.static:.0f} N; a fold "
                f"of the response at {own.folds[0.24]:.0f} N (0.24 Hz) leads to a larger swing in the lock: kept at "
                f"{BESIDE[0]:g} and {BESIDE[1]:g} of that it {_told(study.kept[own.damping])}",
                late > own.static and not any(study.kept[own.damping])),
        Finding("At the locklinks' dead centre rigid pins mislead: they whip the locklinks through where elastic ones "
                "give, and the gear stays locked",
                f"rigid: {rigid[0][-1]:.0f} N, theta_ov {whips:+.0f} deg; k_j = 1e8 N/m: locked up to "
                f"{elastic[0][-1]:.0f} N, theta_ov up to {np.degrees(elastic[1].max()):.2f} deg",
                rigid[0][-1] < 0.7 * elastic[0][-1] and bool(np.all(elastic[1] < AWAY[1]))),
    ]


def _told(gone: list[bool]) -> str:
    return " and ".join("lets go" if g else "stays" for g in gone)


def _at(c: Compared, stiffness: float) -> float:
    return float(np.exp(np.interp(np.log(stiffness), np.log(c.stiffness), np.log(c.apart))))


if __name__ == "__main__":
    run_script(main)
