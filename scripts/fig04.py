"""Figure 4: joint stiffness and the equilibria of the overcentre mechanism.

Angle of link 1 (a) at the folds against the joint stiffness k_j, where grey lines mark the stiffness of the panels
below and dotted lines the angle for rigid joints; upper right, not in the paper, its relative deviation from that
angle, and 1 %; (b) at equilibrium against the force F. Solid: stable; dashed: unstable; circles: folds. Model
overcentre_paper, the set of figures 2 to 5.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _overcentre import BOUNDS, FOLDS, LABELS, LINE_WIDTH, Rigid, curve, equilibria, farthest, overcentre, to_axes

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import GREY, new_figure, pieces, plot, save_figure, set_panel_title
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins

STIFFNESS = (10.0, 200.0, 1000.0)
SPAN = (8.0, 1e6)  # k_j in N/m


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    mechanism = overcentre()
    rigid = Rigid.of(mechanism)
    branches = [equilibria(mechanism, k_j=k) for k in STIFFNESS]
    studies = {
        (label, q): mc.stiffness_study(mechanism, branches[-1].point(label), "k_j", 0.01, bounds=SPAN, quantity=q,
                                       ds_max=0.02)
        for label in FOLDS
        for q in ("F", "theta_1")
    }
    for study in studies.values():
        whole(study.locus)
    _draw(branches, studies, out)
    write_twins(out, "fig04", *branches, *(studies[label, "F"].locus for label in FOLDS))
    return [
        _levels_off(studies, rigid),
        _same_structure(branches),
        _softest(*branches[:2]),
        _converging(branches),
        _identical(*branches[1:], rigid),
    ]


def _draw(branches: list[mc.Branch], studies: dict[tuple[str, str], mc.StiffnessStudy], out: Path) -> None:
    figure, axes = new_figure(2, 3, (9.6, 5.6))
    for ax, panel, label in zip(axes[0], ("a1", "a2"), FOLDS, strict=False):
        study = studies[label, "theta_1"]
        plot(study.locus, x="k_j", y="theta_1", ax=ax, colors=["black"], labels=False)
        ax.axhline(np.degrees(study.limit), color=GREY, linestyle=":", linewidth=1.0)
        set_panel_title(ax, f"({panel})  {LABELS[label]}")
        axes[0, 2].plot(study.locus["k_j"], study.deviation, label=LABELS[label], color="black",
                        linestyle="-" if panel == "a1" else "-.")
    axes[0, 2].axhline(study.tol, color=GREY, linestyle=":", linewidth=1.0)
    axes[0, 2].set(yscale="log", ylim=(1e-4, 1.5), xlabel=axis_label("k_j", "N/m"),
                   ylabel=f"deviation of {readable('theta_1')}")
    axes[0, 2].legend(frameon=False, fontsize=8.5)
    set_panel_title(axes[0, 2], "distance from rigid joints")
    for ax in axes[0]:
        for k in STIFFNESS:
            ax.axvline(k, color="0.75", linewidth=1.2, zorder=0.5)
        ax.set(xscale="log", xlim=(SPAN[0], 1e5))
    for i, (ax, branch) in enumerate(zip(axes[1], branches, strict=True), 1):
        plot(branch, x="F", y="theta_1", ax=ax, labels=LABELS)
        set_panel_title(ax, f"(b{i})  {readable('k_j')} = {branch.fixed['k_j']:g} N/m")
        ax.set(xlim=BOUNDS, ylim=(-90, 90), yticks=range(-90, 91, 30))
    save_figure(figure, out / "fig04.png")


def _levels_off(studies: dict[tuple[str, str], mc.StiffnessStudy], rigid: Rigid) -> Finding:
    shown, off = [], []
    for label, name in FOLDS.items():
        fold, angle, force = rigid.fold(label), studies[label, "theta_1"], studies[label, "F"]
        off += [abs(angle.limit / fold["theta_1"] - 1), abs(force.limit / fold["F"] - 1)]
        shown.append(
            f"{name} tends to {np.degrees(angle.limit):.5f} deg and {force.limit:.5f} N, within 1 % of that from "
            f"k_j = {angle.converged_from or np.nan:.0f} N/m (angle) and {force.converged_from or np.nan:.0f} N/m "
            "(force) on"
        )
    return Finding(
        "The joint stiffness moves the folds; their curves level off as it grows, towards the folds of the mechanism "
        "with rigid joints.",
        f"{'; '.join(shown)}; the closed form's folds differ by at most {max(off):.0e} (relative)",
        max(off) < 1e-6 and all(s.converged_from and np.all(np.diff(s.deviation[np.argsort(s.locus['k_j'])]) < 0)
                                for s in studies.values()),
    )


def _same_structure(branches: list[mc.Branch]) -> Finding:
    words = [[w for w, _, _ in pieces(b)] for b in branches]
    labels = [[p.label for p in b.special_points] for b in branches]
    shown = [
        f"k_j = {b.fixed['k_j']:g} N/m: {', '.join(w)}, folds at " + " and ".join(
            f"{b.point(label)['F']:.3f} N, {np.degrees(b.point(label)['theta_1']):.2f} deg" for label in FOLDS)
        for b, w in zip(branches, words, strict=True)
    ]
    return Finding(
        "At 10, 200 and 1000 N/m the structure is the same: no bifurcation is added, no stability changes.",
        "; ".join(shown),
        all(w == ["stable", "unstable", "stable"] for w in words) and all(k == ["LP1", "LP2"] for k in labels),
    )


def _bend(branch: mc.Branch) -> float:
    """Return how far the unstable piece strays from its chord, relative to the chord's length in the diagram."""
    z = to_axes(curve(branch))[branch.point("LP1").index : branch.point("LP2").index + 1]
    chord = z[-1] - z[0]
    aside = (z - z[0]) @ np.array([-chord[1], chord[0]]) / (chord @ chord)
    return float(np.abs(aside).max())


def _shape(branch: mc.Branch) -> tuple[float, float, float, float]:
    """Return spans in deg, of the lower branch, of its part below F = 0 and of the upper branch, and the bend in %."""
    theta = np.degrees(branch["theta_1"])
    lower = slice(0, branch.point("LP1").index + 1)
    unloaded = float(np.interp(0.0, branch["F"][lower], theta[lower]))
    rise = theta[-1] - theta[branch.point("LP2").index]
    return theta[lower][-1] - theta[0], unloaded - theta[0], rise, 100 * _bend(branch)


def _softest(soft: mc.Branch, stiff: mc.Branch) -> Finding:
    away = farthest(curve(soft), curve(stiff))[0]
    lower, unloaded, rise, bend = zip(_shape(soft), _shape(stiff), strict=True)
    flatter = lower[0] < lower[1] and unloaded[0] < unloaded[1]
    return Finding(
        "From 10 to 200 N/m the change is large, several times the width of a line: softer joints make the lower "
        "branch flatter and the unstable piece straighter, and stiffer ones turn the upper branch down about FP1.",
        f"k_j = {soft.fixed['k_j']:g} and {stiff.fixed['k_j']:g} N/m: up to {100 * away:.1f} % of the axes apart; the "
        f"lower branch spans {lower[0]:.1f} and {lower[1]:.1f} deg, of which {unloaded[0]:.1f} and {unloaded[1]:.1f} "
        f"deg below F = 0, the unstable piece strays {bend[0]:.2f} and {bend[1]:.2f} % from its chord, the upper "
        f"branch rises by {rise[0]:.1f} and {rise[1]:.1f} deg from FP1 to {BOUNDS[1]:g} N",
        away > 3 * LINE_WIDTH and flatter and bend[0] < bend[1] and rise[0] > rise[1],
    )


def _converging(branches: list[mc.Branch]) -> Finding:
    pairs = list(zip(branches[:-1], branches[1:], strict=True))
    shifts = [
        [abs(b.point(label)[q] - a.point(label)[q]) for label in FOLDS for q in ("F", "theta_1")] for a, b in pairs
    ]
    away = [farthest(curve(a), curve(b))[0] for a, b in pairs]
    shown = [
        f"{a.fixed['k_j']:g} to {b.fixed['k_j']:g} N/m: folds by {s[0]:.2f} and {s[2]:.2f} N, {np.degrees(s[1]):.2f} "
        f"and {np.degrees(s[3]):.2f} deg, the curve by at most {100 * d:.1f} % of the axes"
        for (a, b), s, d in zip(pairs, shifts, away, strict=True)
    ]
    return Finding(
        "The change from 200 to 1000 N/m is small compared with that from 10 to 200 N/m.",
        "; ".join(shown),
        all(5 * y < x for x, y in zip(*shifts, strict=True)) and 5 * away[1] < away[0],
    )


def _identical(middle: mc.Branch, stiff: mc.Branch, rigid: Rigid) -> Finding:
    found = {f"{stiff.fixed['k_j']:g} N/m": curve(stiff), "rigid joints": rigid.curve()}
    worst = {name: farthest(curve(middle), other) for name, other in found.items()}
    shown = [
        f"{100 * d:.2f} % of the axes from {name} (F = {f:.1f} N, theta_1 = {np.degrees(t):.1f} deg)"
        for name, (d, f, t) in worst.items()
    ]
    return Finding(
        "The curves at 200 and 1000 N/m or beyond cannot be told apart: nowhere further than a line is wide, 1 % of "
        "the axes.",
        f"that at {middle.fixed['k_j']:g} N/m lies at most {' and '.join(shown)}",
        max(d for d, _, _ in worst.values()) < LINE_WIDTH,
    )


if __name__ == "__main__":
    run_script(main)
