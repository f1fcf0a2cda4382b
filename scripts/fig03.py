"""Figure 3: spring damping and the equilibria of the overcentre mechanism.

Angle of link 1 against the force F, (a) lightly and (b) heavily damped. Solid: stable; dashed: unstable;
circles: folds. Model overcentre_paper, the set of figures 2 to 5.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _overcentre import BOUNDS, FOLDS, LABELS, equilibria, overcentre

import mjcont as mc
from mjcont.drawing.axes import readable
from mjcont.drawing.plotting import new_figure, pieces, plot, save_figure, set_panel_title
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins

DAMPING = (0.01, 10.0)


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    mechanism = overcentre()
    branches = [equilibria(mechanism, ds_max=0.03, c_sp=c) for c in DAMPING]
    figure, axes = new_figure(1, 2, (7.2, 3.3), sharey=True)
    for ax, panel, branch in zip(axes, "ab", branches, strict=True):
        plot(branch, x="F", y="theta_1", ax=ax, labels=LABELS)
        set_panel_title(ax, f"({panel})  {readable('c_sp')} = {branch.fixed['c_sp']:g} N s/m")
        ax.set(xlim=BOUNDS, ylim=(-90, 90), yticks=range(-90, 91, 30))
        ax.label_outer()
    save_figure(figure, out / "fig03.png")
    write_twins(out, "fig03", *branches)
    return [_structure(branches), _same(*branches), _snaps(branches[0])]


def _structure(branches: list[mc.Branch]) -> Finding:
    stability = [[word for word, _, _ in pieces(b)] for b in branches]
    labels = [[p.label for p in b.special_points] for b in branches]
    shown = [
        f"c_sp = {b.fixed['c_sp']:g} N s/m: {', '.join(words)}; {_folds(b)}"
        for b, words in zip(branches, stability, strict=True)
    ]
    return Finding(
        "At both dampings the equilibria are stable, then unstable, then stable, with a fold at each change and no "
        "other bifurcation.",
        ". ".join(shown),
        all(s == ["stable", "unstable", "stable"] for s in stability) and all(k == ["LP1", "LP2"] for k in labels),
    )


def _folds(branch: mc.Branch) -> str:
    folds = [(name, branch.point(label)) for label, name in FOLDS.items()]
    return ", ".join(f"{n} at {p['F']:.6f} N, {np.degrees(p['theta_1']):+.6f} deg" for n, p in folds)


def _same(light: mc.Branch, heavy: mc.Branch) -> Finding:
    folds = [abs(light.point(f)[n] / heavy.point(f)[n] - 1) for f in FOLDS for n in ("F", "theta_1")]
    return Finding(
        "The two diagrams are identical: damping does not change the equilibria.",
        f"F and theta_1 at the folds differ by at most {max(folds):.1g} (relative)",
        max(folds) < 1e-10,
    )


def _snaps(branch: mc.Branch) -> Finding:
    upper, lower = branch.point("LP2"), branch.point("LP1")
    low, high = sorted((upper["F"], lower["F"]))
    between, below, above = (branch.at(F=f) for f in (0.5 * (low + high), 0.9 * low, 1.1 * high))
    stable = [p["theta_1"] for p in between if p.stability == "stable"]
    return Finding(
        "The folds are the forces at which the mechanism must pass overcentre: FP1 as F falls, FP2 as it rises.",
        f"{len(stable)} stable equilibria between {low:.4f} N (FP1) and {high:.4f} N (FP2), above and below "
        f"overcentre; only theta_1 = {np.degrees(below[0]['theta_1']):.1f} deg at {0.9 * low:.1f} N and "
        f"{np.degrees(above[0]['theta_1']):.1f} deg at {1.1 * high:.1f} N",
        len(stable) == 2 and min(stable) < 0 < max(stable) and len(below) == len(above) == 1
        and below[0]["theta_1"] < 0 < above[0]["theta_1"] and upper["theta_1"] > 0 > lower["theta_1"],
    )


if __name__ == "__main__":
    run_script(main)
