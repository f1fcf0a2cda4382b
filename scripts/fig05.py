"""Figure 5: the overcentre mechanism on elastic joints compared with its closed form.

Angle of link 1 against the force F, (a) by continuation with joints of 100 N/m, (b) by equation (5) for rigid
joints, its spring term with the sign that follows from equation (4), and (c) both. Solid: stable; dashed: unstable;
circles: folds. Model overcentre_paper, the set of figures 2 to 5.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _overcentre import BOUNDS, FOLDS, LABELS, LINE_WIDTH, Rigid, curve, equilibria, farthest, overcentre, to_axes

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import (
    COLORS,
    draw_curve,
    mark,
    new_figure,
    pieces,
    plot,
    save_figure,
    set_panel_title,
    split_by_stability,
)
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    mechanism = overcentre()
    rigid = Rigid.of(mechanism)
    branches = {k: equilibria(mechanism, k_j=k) for k in (1e2, 1e3, 1e6)}
    _draw(branches[1e2], rigid, out)
    write_twins(out, "fig05", *branches.values())
    return [
        _same_structure(branches[1e2], rigid),
        _close_folds(branches[1e2], rigid),
        *_close_curves(branches, rigid),
        _sign(branches[1e6], rigid),
    ]


def _draw(elastic: mc.Branch, rigid: Rigid, out: Path) -> None:
    figure, axes = new_figure(1, 3, (9.6, 3.4), sharey=True)
    plot(elastic, x="F", y="theta_1", ax=axes[0], labels=LABELS)
    for ax in axes[1:]:
        force, theta = rigid.curve().T
        draw_curve(ax, force, np.degrees(theta), _rigid_pieces(rigid), color=COLORS[1])
    for label, name in LABELS.items():
        fold = rigid.fold(label)
        mark(axes[1], fold["F"], np.degrees(fold["theta_1"]), "LP", name, color=COLORS[1])
    axes[2].plot([], [], color=COLORS[1], label="closed form")
    plot(elastic, x="F", y="theta_1", ax=axes[2], labels=False, colors=COLORS, legend=["continuation"])
    titles = (f"(a)  continuation, {readable('k_j')} = {elastic.fixed['k_j']:g} N/m", "(b)  closed form, rigid joints",
              "(c)  both")
    for ax, title in zip(axes, titles, strict=True):
        ax.set(xlim=BOUNDS, ylim=(-90, 90), yticks=range(-90, 91, 30))
        ax.set(xlabel="F [N]", ylabel=axis_label("theta_1", "deg"))
        ax.label_outer()
        set_panel_title(ax, title)
    save_figure(figure, out / "fig05.png")


def _rigid_pieces(rigid: Rigid) -> list[tuple[str, int, int]]:
    """Return the pieces of the closed form: stable where F grows with theta_1, the one degree of freedom left."""
    force, theta = rigid.curve().T
    return split_by_stability(np.where(np.gradient(force, theta) > 0, "stable", "unstable"))


def _same_structure(elastic: mc.Branch, rigid: Rigid) -> Finding:
    words = [w for w, _, _ in pieces(elastic)]
    rigid_words = [w for w, _, _ in _rigid_pieces(rigid)]
    return Finding(
        "Elastic joints of 100 N/m do not change the structure: stable, unstable, stable, with a fold at each change.",
        f"continuation: {', '.join(words)}, folds {', '.join(p.label for p in elastic.special_points)}; "
        f"closed form: {', '.join(rigid_words)}",
        words == rigid_words and [p.label for p in elastic.special_points] == ["LP1", "LP2"],
    )


def _close_folds(elastic: mc.Branch, rigid: Rigid) -> Finding:
    away, shown = [], []
    for label, name in FOLDS.items():
        found, closed = elastic.point(label), rigid.fold(label)
        here, there = (np.array([p["F"], p["theta_1"]]) for p in (found, closed))
        away.append(float(np.linalg.norm(to_axes(here - there))))
        shown.append(
            f"{name}: {here[0]:.4f} N at {np.degrees(here[1]):.3f} deg, rigid {there[0]:.4f} N at "
            f"{np.degrees(there[1]):.3f} deg ({100 * away[-1]:.2f} % of the axes apart)"
        )
    return Finding(
        "At k_j = 100 N/m the folds are those of rigid joints, cos^3 theta_1 = l_us / L_1: nearer than a line is wide.",
        "; ".join(shown),
        max(away) < LINE_WIDTH,
    )


def _close_curves(branches: dict[float, mc.Branch], rigid: Rigid) -> list[Finding]:
    worst = {k_j: farthest(curve(branch), rigid.curve()) for k_j, branch in branches.items()}
    shown = [
        f"{100 * d:.3g} % at k_j = {k:g} N/m (F = {f:.1f} N, theta_1 = {np.degrees(t):.1f} deg)"
        for k, (d, f, t) in worst.items()
    ]
    return [
        Finding(
            "The curve at k_j = 100 N/m is identical to the analytical solution: nowhere further from it than a line "
            "is wide, 1 % of the axes.",
            f"at most {shown[0]}",
            worst[1e2][0] < LINE_WIDTH,
        ),
        Finding(
            "With stiffer joints the curve tends to the analytical solution, and is identical to the eye at 1000 N/m.",
            f"at most {shown[1]} and {shown[2]}",
            min(LINE_WIDTH, worst[1e2][0]) > worst[1e3][0] > worst[1e6][0],
        ),
    ]


def _sign(stiff: mc.Branch, rigid: Rigid) -> Finding:
    theta = stiff["theta_1"]
    middle = np.abs(theta) < np.radians(60)
    right, printed = (np.abs(stiff["F"] - rigid.force(theta, sign))[middle].max() for sign in (-1.0, 1.0))
    return Finding(
        "In equation (5) the spring term needs a minus sign for the spring law of equation (4).",
        f"against continuation at k_j = {stiff.fixed['k_j']:g} N/m, for |theta_1| < 60 deg, F is off by at most "
        f"{right:.1e} N with the minus sign and by {printed:.1f} N as printed",
        right < 1e-3 < printed,
    )


if __name__ == "__main__":
    run_script(main)
