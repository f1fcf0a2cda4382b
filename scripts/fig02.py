"""Figure 2: spring damping and the motion of the overcentre mechanism.

Angle of link 1 against the force F = 50 cos(t) N, t in degrees, which swings once from +50 N to -50 N and back in
360 s: (a) lightly and (b) heavily damped. Black: the equilibria, solid where stable, dashed where unstable, with folds
as circles. Model overcentre_paper, the set of figures 2 to 5.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _overcentre import BOUNDS, LABELS, equilibria, overcentre

import mjcont as mc
from mjcont.drawing.axes import readable
from mjcont.drawing.notes import place_labels
from mjcont.drawing.plotting import COLORS, new_figure, plot, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins

DAMPING = (0.01, 10.0)
CYCLE = 360.0  # s
NUMERICS = ({"timestep": 2e-3}, {"integrator": "RK4", "timestep": 5e-3})


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    mechanism = overcentre()
    branches = [equilibria(mechanism, c_sp=c) for c in DAMPING]
    light, heavy = histories = [cycle(b) for b in branches]
    _draw(branches, histories, out)
    write_twins(out, "fig02", *branches, *histories)
    return [
        _differ(branches, light, heavy),
        _loop(branches[0], light, heavy),
        _on_branches(branches, histories),
        _overshoot(branches[1], heavy),
        _numerics(branches[1], heavy),
    ]


def load(t: float) -> float:
    """Return F in N at a time in s."""
    return float(BOUNDS[1] * np.cos(np.radians(t * 360.0 / CYCLE)))


def cycle(branch: mc.Branch, **numerics: object) -> mc.History:
    """Return the motion under one cycle of the load, from rest at its largest force."""
    return mc.simulate(branch.problem, {"F": load}, CYCLE, branch.row(len(branch) - 1), samples=18_000, **numerics)


def passages(history: mc.History) -> Array:
    """Return time and force at every passage of theta_1 through zero, (N, 2)."""
    theta = history["theta_1"]
    i = np.flatnonzero(theta[:-1] * theta[1:] < 0)
    w = theta[i] / (theta[i] - theta[i + 1])
    return np.column_stack([(1 - w) * history[c][i] + w * history[c][i + 1] for c in ("time", "F")])


def first_passages(history: mc.History) -> Array:
    """Return time and force at the first passage as the load falls, and at the first as it rises, (2, 2)."""
    found = passages(history)
    rising = found[:, 0] > CYCLE / 2
    return np.array([found[~rising][0], found[rising][0]])


def overshoot(branch: mc.Branch, label: str, rate: float) -> float:
    """Return by how many N a load that changes at `rate` in N/s passes a fold before the mechanism is overcentre.

    The load starts where the mechanism can still follow it, ahead of the fold by a distance that scales with the
    overshoot to be expected from a slow passage through a fold, in proportion to rate^(2/3).
    """
    fold = branch.point(label)
    sign = -np.sign(fold["theta_1"])
    scale = rate ** (2 / 3)
    first = fold["F"] - 4.0 * sign * scale
    start = min((p for p in branch.at(F=first) if p.stability == "stable"), key=lambda p: sign * p["theta_1"])
    motion = mc.simulate(branch.problem, {"F": lambda t: first + sign * rate * t}, 12.0 * scale / rate, start)
    return float(sign * (passages(motion)[0, 1] - fold["F"]))


def _draw(branches: list[mc.Branch], histories: list[mc.History], out: Path) -> None:
    figure, axes = new_figure(1, 2, (7.2, 3.5), sharey=True)
    for ax, panel, branch, history in zip(axes, "ab", branches, histories, strict=True):
        rising = history["time"] >= CYCLE / 2
        for rows, color, name in ((~rising, COLORS[0], "F falls"), (rising, COLORS[1], "F rises")):
            ax.plot(history["F"][rows], np.degrees(history["theta_1"][rows]), color=color, linewidth=0.8, zorder=1.5,
                    label=name)
        plot(branch, x="F", y="theta_1", ax=ax, labels=LABELS, colors=["black"])
        set_panel_title(ax, f"({panel})  {readable('c_sp')} = {branch.fixed['c_sp']:g} N s/m")
        ax.set(xlim=BOUNDS, ylim=(-135, 135), yticks=range(-135, 136, 45))
        ax.legend(loc="upper left", frameon=False, fontsize=8.5)
        ax.label_outer()
        place_labels(ax)
    save_figure(figure, out / "fig02.png")


def _branch_angle(branch: mc.Branch, force: Array, *, upper: bool) -> Array:
    """Return theta_1 in rad on the stable piece above or below overcentre, where it exists."""
    lower_end, upper_end = branch.point("LP1").index, branch.point("LP2").index
    rows = slice(upper_end, None) if upper else slice(0, lower_end + 1)
    return np.asarray(np.interp(force, branch["F"][rows], branch["theta_1"][rows]))


def _swing(branch: mc.Branch, history: mc.History, after: float) -> float:
    """Return how far, in deg, theta_1 swings from the branch below overcentre some s after the first passage."""
    t = history["time"] - first_passages(history)[0, 0]
    rows = (t > after) & (t < 2 * after)
    away = history["theta_1"][rows] - _branch_angle(branch, history["F"][rows], upper=False)
    return float(np.degrees(np.abs(away).max()))


def _differ(branches: list[mc.Branch], light: mc.History, heavy: mc.History) -> Finding:
    swings = [_swing(b, h, 10.0) for b, h in zip(branches, (light, heavy), strict=True)]
    forces = [f"{first_passages(h)[0, 1]:.2f}" for h in (light, heavy)]
    return Finding(
        "Damping changes the motion greatly: lightly damped, the mechanism oscillates long after it has snapped.",
        f"as F falls, theta_1 first passes zero at {forces[0]} N (light) and {forces[1]} N (heavy); 10 s to 20 s later "
        f"it still swings by {swings[0]:.1f} deg (light) and {swings[1]:.2f} deg (heavy)",
        swings[0] > 10 * swings[1],
    )


def _loop(branch: mc.Branch, *histories: mc.History) -> Finding:
    force = 0.5 * (branch.point("LP1")["F"] + branch.point("LP2")["F"])
    found = []
    for h in histories:
        falling = h["time"] < CYCLE / 2
        found.append([
            float(np.degrees(np.interp(sign * force, sign * h["F"][rows], h["theta_1"][rows])))
            for rows, sign in ((falling, -1.0), (~falling, 1.0))
        ])
    shown = [f"{name}: {a:+.1f} and {b:+.1f} deg" for name, (a, b) in zip(("light", "heavy"), found, strict=True)]
    return Finding(
        "Both motions go round a hysteresis loop: at one force the mechanism is above overcentre as the load falls and "
        "below as it rises.",
        f"theta_1 at F = {force:.2f} N, falling and rising: {'; '.join(shown)}",
        all(a > 0 > b for a, b in found),
    )


def _on_branches(branches: list[mc.Branch], histories: list[mc.History]) -> Finding:
    means = []
    for branch, h in zip(branches, histories, strict=True):
        down, up = first_passages(h)[:, 0]
        t, force, theta = h["time"], h["F"], h["theta_1"]
        for rows, upper in ((t < down, True), ((t > down) & (t < up), False), (t > up, True)):
            away = theta[rows] - _branch_angle(branch, force[rows], upper=upper)
            means.append(float(np.degrees(away.mean())))
    shown = [", ".join(f"{m:+.2f}" for m in part) for part in (means[:3], means[3:])]
    return Finding(
        "Both follow the same equilibria, above overcentre, below, and above again, whatever the damping.",
        f"mean of theta_1 less that of the stable branch, before, between and after the passages: {shown[0]} deg "
        f"(light); {shown[1]} deg (heavy)",
        max(map(abs, means)) < 2.0,
    )


def _overshoot(branch: mc.Branch, heavy: mc.History) -> Finding:
    forces = first_passages(heavy)[:, 1]
    folds = [branch.point(label)["F"] for label in ("LP2", "LP1")]
    rates = [np.radians(360.0 / CYCLE) * np.sqrt(BOUNDS[1] ** 2 - f**2) for f in folds]
    swept = [abs(force - fold) for force, fold in zip(forces, folds, strict=True)]
    slower = [overshoot(branch, label, rate / 10) for label, rate in zip(("LP2", "LP1"), rates, strict=True)]
    powers = [np.log10(a / b) for a, b in zip(swept, slower, strict=True)]
    return Finding(
        "The folds are the forces for overcentring in the long run: a load that sweeps past them gets ahead of the "
        "mechanism, the less so the slower it is (in theory with the power 2/3 of its rate).",
        f"heavy damping: theta_1 = 0 at {forces[0]:.2f} N (fold {folds[0]:.2f} N) and {forces[1]:.2f} N (fold "
        f"{folds[1]:.2f} N); at a tenth of the rate the load is ahead by {slower[0]:.3f} and {slower[1]:.3f} N "
        f"instead of {swept[0]:.3f} and {swept[1]:.3f} N, powers {powers[0]:.3f} and {powers[1]:.3f}",
        forces[0] < folds[0] < folds[1] < forces[1] and all(0.62 < p < 0.70 for p in powers),
    )


def _numerics(branch: mc.Branch, heavy: mc.History) -> Finding:
    others = [cycle(branch, **n) for n in NUMERICS]
    apart = [float(np.abs(first_passages(h)[:, 1] - first_passages(heavy)[:, 1]).max()) for h in others]
    shown = [
        f"{d:.1e} N ({h.settings['integrator']}, {h.settings['timestep']:g} s)"
        for d, h in zip(apart, others, strict=True)
    ]
    return Finding(
        "The heavily damped motion does not depend on time step and integrator.",
        f"forces at the passages differ from those with {heavy.settings['integrator']} and a step of "
        f"{heavy.settings['timestep']:g} s by {' and '.join(shown)}",
        max(apart) < 0.01,
    )


if __name__ == "__main__":
    run_script(main)
