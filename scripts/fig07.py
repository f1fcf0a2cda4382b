"""Figure 7: joint damping and the equilibria of the nose gear near uplock.

Overcentre angle theta_ov against the retraction force F_ret for two dampings of the joints, each joint elastic
(k_j = 1e6 N/m, 15 degrees of freedom), within theta_1 < -20 deg. Light grey: above overcentre; dark grey: below.
Solid: stable; dashed: unstable; circles: folds. The numbers of the folds are ours.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
from _gear import add_legend, angle_of, draw_sides

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import mark, new_figure, pieces, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins

BOUNDS = (0.0, 60.0)
DAMPING = (1.0, 1000.0)
KEYFRAMES = ("uplock_above", "uplock_below", "downlock_above", "downlock_below")
WINDOW = np.radians(-20.0)  # theta_1 near uplock lies below


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear_full")
    diagrams = [_branches(gear, c) for c in DAMPING]
    _draw(diagrams, out)
    write_twins(out, "fig07", *(b for branches in diagrams for b in branches))
    return [_same_curves(*diagrams), _same_stability(*diagrams), _no_hopf(diagrams), _uplocks(diagrams)]


def _branches(gear: mc.Mechanism, c_j: float) -> list[mc.Branch]:
    """Return the branches through the assembled poses, each once, that pass through the window."""
    start = {"F_ret": 20.0, "c_j": c_j}
    diagram = mc.bifurcation_diagram(gear, "F_ret", BOUNDS, start, keyframes=KEYFRAMES, ds_max=0.03)
    return [whole(b) for b in diagram if inside(b).any()]


def inside(branch: mc.Branch) -> Array:
    """Return which rows lie near uplock, (N,)."""
    return np.asarray(branch["theta_1"] < WINDOW)


def folds(branches: list[mc.Branch]) -> list[mc.SpecialPoint]:
    """Return the folds near uplock, FP1, FP2, ... by falling theta_ov."""
    found = [p for b in branches for p in b.of_kind("LP") if p["theta_1"] < WINDOW]
    return sorted(found, key=lambda p: -p["theta_ov"])


def _draw(diagrams: list[list[mc.Branch]], out: Path) -> None:
    figure, axes = new_figure(1, 2, (7.6, 3.7), sharey=True)
    for ax, panel, branches in zip(axes, "ab", diagrams, strict=True):
        for b in branches:
            draw_sides(ax, b, np.where(inside(b), b["F_ret"], np.nan), np.degrees(b["theta_ov"]))
        for i, p in enumerate(folds(branches), 1):
            mark(ax, p["F_ret"], angle_of(p), "LP", f"FP$_{i}$")
        set_panel_title(ax, f"({panel})  {readable('c_j')} = {branches[0].fixed['c_j']:g} N s/m")
        ax.set(xlim=BOUNDS, ylim=(-90, 90), yticks=range(-90, 91, 30))
        ax.set(xlabel=axis_label("F_ret", "N"), ylabel=axis_label("theta_ov", "deg"))
        ax.label_outer()
    add_legend(axes[1], loc="lower right")
    save_figure(figure, out / "fig07.png")


def _same_curves(light: list[mc.Branch], heavy: list[mc.Branch]) -> Finding:
    pairs = list(zip(folds(light), folds(heavy), strict=True))
    off = max(abs(a[n] / b[n] - 1) for a, b in pairs for n in ("F_ret", "theta_1", "theta_ov"))
    shown = [f"FP{i} {a['F_ret']:.6f} N, {angle_of(a):+.5f} deg" for i, (a, _) in enumerate(pairs, 1)]
    return Finding(
        "The two diagrams are the same: joint damping moves none of the folds near uplock.",
        f"{'; '.join(shown)}; F_ret and the angles differ by at most {off:.1g} (relative)",
        len(light) == len(heavy) and off < 1e-10,
    )


def _flips(branch: mc.Branch) -> tuple[list[str], list[float]]:
    """Return the stabilities near uplock in order, and theta_ov in deg of the folds at which they change.

    A stretch that rounding cannot tell from the axis (marginal) counts with what lies around it. NaN stands for a
    change with no fold, or several, between the rows it lies between.
    """
    near = inside(branch)
    rows = [(word, a, b) for word, a, b in pieces(branch) if word != "marginal" and near[a : b + 1].any()]
    words, at = [rows[0][0]], []
    for (before, _, last), (after, first, _) in pairwise(rows):
        if before != after:
            between = [p for p in branch.of_kind("LP") if last <= p.index <= first]
            words.append(after)
            at.append(angle_of(between[0]) if len(between) == 1 else np.nan)
    return words, at


def _same_stability(light: list[mc.Branch], heavy: list[mc.Branch]) -> Finding:
    found = [[_flips(b) for b in branches] for branches in (light, heavy)]
    words = [[w for w, _ in parts] for parts in found]
    folds_at = [np.array([theta for _, at in parts for theta in at]) for parts in found]
    apart = float(np.abs(folds_at[0] - folds_at[1]).max()) if words[0] == words[1] else np.inf
    shown = [
        f"{'above' if b['theta_ov'][b.start_index] > 0 else 'below'} overcentre {', '.join(w)}"
        for b, w in zip(light, words[0], strict=True)
    ]
    return Finding(
        "Nor does it change which equilibria are stable, judged by all 30 eigenvalues, not by the stiffness alone.",
        f"{'; '.join(shown)} in both panels; stability changes at the folds only, at angles that differ by {apart:.1g} "
        "deg",
        words[0] == words[1] and apart < 1e-8 and len(light[0].row(0).eigenvalues) == 2 * light[0].problem.n,
    )


def _no_hopf(diagrams: list[list[mc.Branch]]) -> Finding:
    kinds = [sorted({p.kind for b in branches for p in b.special_points}) for branches in diagrams]
    slowest = []
    for branches in diagrams:
        resting = [b.spectra.rows(np.flatnonzero(b.stability != "unstable").tolist()) for b in branches]
        eigenvalues = np.concatenate([e for rows in resting for e in rows])
        moving = eigenvalues[np.abs(eigenvalues.imag) > 1e-3]
        slowest.append(moving[np.argmax(moving.real)])
    shown = [f"c_j = {c:g}: {', '.join(k)}" for c, k in zip(DAMPING, kinds, strict=True)]
    return Finding(
        "There are folds and no other bifurcations: no oscillation sets in, although one is hardly damped at all.",
        f"kinds of special points found, {'; '.join(shown)}; the least damped oscillation of a stable equilibrium at "
        f"c_j = {DAMPING[0]:g} N s/m has Re = {slowest[0].real:.0e} 1/s at {abs(slowest[0].imag):.2f} rad/s",
        all(k == ["LP"] for k in kinds),
    )


def _uplocks(diagrams: list[list[mc.Branch]]) -> Finding:
    ends = []
    for branches in diagrams:
        fold = folds(branches)[0]
        motion = mc.simulate(fold.problem, {"F_ret": 1.01 * fold["F_ret"]}, 60.0, fold, timestep=2e-3)
        (rest,) = [p for b in branches for p in b.at(F_ret=1.01 * fold["F_ret"])
                   if p["theta_1"] < WINDOW and p.stability == "stable"]
        ends.append((np.degrees(motion["theta_ov"][-1]), angle_of(rest)))
    shown = [f"{a:.4f} deg (equilibrium: {b:.4f} deg) at c_j = {c:g}" for (a, b), c in zip(ends, DAMPING, strict=True)]
    return Finding(
        "The gear can uplock: a retraction force that rises past FP1, where the curve above overcentre loses its "
        "stability, takes it to the curve below.",
        f"let go at FP1 ({folds(diagrams[0])[0]['F_ret']:.3f} N) under 1 % more force, it settles within 60 s at "
        f"theta_ov = {'; '.join(shown)}, the only stable equilibrium near uplock at that force",
        all(b < 0 and abs(a - b) < 1e-3 for a, b in ends),
    )


if __name__ == "__main__":
    run_script(main)
