"""Shimmy of a nose wheel: speed and load at which it begins, its cycles, and how far below they still last.

A wheel that yaws by psi on a strut with stiffness, damping and smoothed dry friction, and a tyre whose lateral
deflection y relaxes over the distance sigma. (a) Rest and cycles over speed: the wheel begins to shimmy at HB1, and
stops only below LPC1. (b) Where that is for other loads: Hopf curve (dashed: closed form), and folds of the cycles.
(c) Cycles at some speeds. (d) A small and a large disturbance at a speed between.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import mjcont as mc
from mjcont.drawing.plotting import COLORS, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array, Values
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins

# The equations are those of G. Somieski, Shimmy analysis of a simple aircraft nose landing gear model using different
# mathematical methods, Aerospace Science and Technology 1 (1997) 545-555, with smooth tyre curves and smoothed dry
# friction. The numbers are this project's own.
WHEEL = {
    "V": 20.0,        # speed, m/s
    "F_z": 9000.0,    # vertical load, N
    "c": 1e5,         # stiffness of the strut in yaw, N m/rad
    "k": 10.0,        # damping, N m s/rad
    "M_f": 30.0,      # dry friction, N m
    "w_f": 2.0,       # rate at which three quarters of it act, rad/s
    "kappa": 270.0,   # damping by the width of the tread, times the speed, N m^2/rad
    "I": 1.0,         # moment of inertia in yaw, kg m^2
    "e": 0.1,         # caster, m
    "a": 0.1,         # half the length of contact, m
    "sigma": 0.3,     # relaxation length, m
    "c_F": 20.0,      # side force per load and slip angle, 1/rad
    "c_M": 2.0,       # aligning moment per load and slip angle, m/rad
}
SATURATES = math.radians(5.0)  # slip angle at which the tyre's force does
SPEEDS, LOADS = (1.0, 80.0), (2000.0, 16000.0)


def nose_wheel() -> mc.VectorField:
    """Return the wheel: yaw psi, its rate, and the tyre's lateral deflection y."""

    def motion(u: Array, p: Values) -> list[float]:
        psi, rate, y = u
        slip = math.atan(y / p["sigma"])
        force = p["c_F"] * p["F_z"] * SATURATES * math.tanh(slip / SATURATES)
        moment = p["c_M"] * p["F_z"] * slip / math.cosh(slip / SATURATES) ** 2
        friction = p["M_f"] * math.tanh(rate / p["w_f"])
        yaw = -p["c"] * psi - (p["k"] + p["kappa"] / p["V"]) * rate - friction - moment - p["e"] * force
        return [rate, yaw / p["I"], p["V"] * psi + (p["e"] - p["a"]) * rate - p["V"] / p["sigma"] * y]

    units = {"psi": "rad", "rate": "rad/s", "y": "m", "V": "m/s", "F_z": "N"}
    return mc.VectorField(motion, [0.0, 0.0, 0.0], WHEEL, names=["psi", "rate", "y"], units=units,
                          scale=[0.1, 30.0, 0.03], bounds={"V": SPEEDS, "F_z": LOADS}, name="nose wheel")


def hopf_load(speed: Array) -> Array:
    """Return the load at which rest loses stability at a speed, (n,): Hurwitz's condition a2 a1 = a0 of the cubic."""
    p, r = WHEEL, speed / WHEEL["sigma"]
    damping = (p["k"] + p["M_f"] / p["w_f"] + p["kappa"] / speed) / p["I"]
    stiffness = p["c"] / p["I"]
    needed = (damping + r) * (stiffness + damping * r) - stiffness * r
    found: Array = needed / (speed - (damping + r) * (p["e"] - p["a"])) * p["sigma"] * p["I"] / (
        p["c_M"] + p["e"] * p["c_F"])
    return found


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed: rest and cycles over speed, the Hopf curve, folds of cycles by load, two motions."""

    rest: mc.Branch
    cycles: mc.CycleBranch
    hopf: mc.Branch
    folds: dict[float, float]
    small: mc.History
    large: mc.History


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "shimmy.png")
    write_twins(out, "shimmy", study.rest, study.cycles, study.hopf)
    return findings(study)


def compute(loads: tuple[float, ...] = (6000.0, 12000.0), checked: int = 8) -> Study:
    """Compute the cycles at the wheel's own load, and the folds of those at other loads."""
    wheel, own = nose_wheel(), WHEEL["F_z"]
    rest, cycles = _over_speed(wheel, own)
    folds = {own: cycles.point("LPC1")["V"]}
    for load in loads:
        folds[load] = _over_speed(wheel, load)[1].point("LPC1")["V"]
    between = 0.5 * (cycles.point("LPC1")["V"] + rest.point("HB1")["V"])
    small, large = (
        mc.simulate(wheel, duration=3.0, start={"V": between}, state=[np.radians(by), 0.0, 0.0]) for by in (0.5, 10.0)
    )
    hopf = mc.continue_special(rest.point("HB1"), "F_z", LOADS)
    return Study(rest, mc.verify_stability(cycles, n=checked), hopf, dict(sorted(folds.items())), small, large)


def _over_speed(wheel: mc.VectorField, load: float) -> tuple[mc.Branch, mc.CycleBranch]:
    rest = mc.continue_equilibria(wheel, "V", SPEEDS, start={"V": SPEEDS[0], "F_z": load})
    return rest, mc.continue_cycles(rest.point("HB1"))


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(2, 2, (9.4, 7.0))
    mc.plot(study.rest, study.cycles, x="V", y="psi", ax=axes[0, 0])
    set_panel_title(axes[0, 0], "(a)  yaw: rest, and largest and smallest on cycles")
    mc.plot(study.hopf, x="V", y="F_z", ax=axes[0, 1], legend=["rest loses stability"])
    speeds = np.linspace(15.0, SPEEDS[1], 200)
    axes[0, 1].plot(speeds, hopf_load(speeds), "--", color="#333333", linewidth=1.0, label="closed form")
    axes[0, 1].plot(list(study.folds.values()), list(study.folds), "h", color=COLORS[1], label="cycles end (LPC)")
    axes[0, 1].set(xlim=(15.0, SPEEDS[1]), ylim=LOADS)
    axes[0, 1].legend(frameon=False, fontsize=8)
    set_panel_title(axes[0, 1], "(b)  speed and load at which shimmy begins and ends")
    mc.plot_orbits(study.cycles, x="psi", y="y", n=9, ax=axes[1, 0])
    set_panel_title(axes[1, 0], "(c)  cycles; dashed: unstable")
    for history, color, name in ((study.large, COLORS[1], "by 10 deg"), (study.small, COLORS[0], "by 0.5 deg")):
        axes[1, 1].plot(history["time"], np.degrees(history["psi"]), color=color, linewidth=0.8, label=name)
    axes[1, 1].set(xlabel="time [s]", ylabel="psi [deg]", ylim=(-24.0, 30.0))
    axes[1, 1].legend(frameon=False, fontsize=8, loc="upper right", ncols=2)
    set_panel_title(axes[1, 1], f"(d)  motions at {study.small['V'][0]:.1f} m/s, disturbed")
    save_figure(figure, path)


def findings(study: Study) -> list[Finding]:
    """Return the study's findings."""
    begin, fold = study.rest.point("HB1"), study.cycles.point("LPC1")
    exact = float(np.abs(hopf_load(study.hopf["V"]) / study.hopf["F_z"] - 1.0).max())
    certificate: Any = study.cycles.certificate
    late, grown = (float(np.abs(h["psi"][h["time"] > 2.8]).max()) for h in (study.small, study.large))
    lasts = {load: float(np.interp(load, *_sorted(study.hopf))) - speed for load, speed in study.folds.items()}
    return [
        Finding("The wheel begins to shimmy, hard, where Hurwitz's condition says",
                f"subcritical Hopf point at {begin['V']:.4f} m/s; the Hopf curve differs from the closed form by "
                f"{exact:.1e}", begin.coefficients["type"] == "subcritical" and exact < 1e-6),
        Finding("Once it shimmies it does so down to a lower speed",
                f"fold of cycles at {fold['V']:.4f} m/s, {np.degrees(fold['psi.max']):.2f} deg",
                fold["V"] < begin["V"]),
        Finding("Between the two a small disturbance dies away and a large one grows into shimmy",
                f"after 2.8 s {np.degrees(late):.3f} deg and {np.degrees(grown):.1f} deg",
                late < np.radians(0.05) and grown > fold["psi.max"]),
        Finding("Motions beside the cycles grow and shrink as their multipliers say", certificate.headline,
                certificate.holds),
        Finding("At every load there is such a range of speeds",
                ", ".join(f"{load:g} N: {width:.2f} m/s" for load, width in lasts.items()),
                all(width > 0.0 for width in lasts.values())),
    ]


def _sorted(hopf: mc.Branch) -> tuple[Array, Array]:
    """Return loads in increasing order and the speeds of the Hopf curve there, its lower part."""
    low = hopf["V"] <= hopf["V"][np.argmin(hopf["F_z"])]
    order = np.argsort(hopf["F_z"][low])
    return hopf["F_z"][low][order], hopf["V"][low][order]


if __name__ == "__main__":
    run_script(main)
