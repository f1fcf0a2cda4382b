"""Retraction and unlock force of the nose gear over gravity angle and load factor.

The cusp of the fold FP1, followed over gravity angles of -30 to +30 deg and load factors of 0.5 to 2.5, its worst
cases, and FP1 itself without unlock force. (a) F_ul at the cusp. (b) F_ret at the cusp; star: its largest value.
(c) F_ret at FP1. Triangles: largest and smallest node. (d, e) The cusp's two forces as surfaces. (f) F_ul at the cusp
for some load factors; dashed: rigid pins in closed form. All curves meet where gravity acts along the locklinks.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from _gear import ANGLES, LOAD_FACTORS
from _loci import Case
from _rigid_gear import RigidGear

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import COLORS, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script

ANGLE_RANGE = (np.radians(-30.0), np.radians(30.0))
LOAD_RANGE = (0.5, 2.5)
BOX = {"gravity_angle": ANGLE_RANGE, "load_factor": LOAD_RANGE}
NEAR = np.radians(0.5)  # half the width of the fine grid about a worst case
CLOSE = 0.01  # a bush gives 2.6 mm, 0.4 % of d_H, under the largest of its forces, 2.6 kN


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed; `near` is F_ret at the cusp beside its worst case, over gravity angle."""

    rigid: RigidGear
    cusps: mc.SpecialMap
    folds: mc.SpecialMap
    retraction: mc.WorstCase
    unlock: mc.WorstCase
    fold: mc.WorstCase
    near: mc.SpecialMap
    slopes: dict[float, float]

    @property
    def angles(self) -> Array:
        """The map's gravity angles in rad, as a column."""
        return np.asarray(self.cusps.axes["gravity_angle"])[:, None]

    @property
    def loads(self) -> Array:
        """The map's load factors."""
        return np.asarray(self.cusps.axes["load_factor"])


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "load_map.png")
    return findings(study)


def findings(study: Study) -> list[Finding]:
    """Return a study's findings."""
    return [_exists(study), _worst_retraction(study), _worst_unlock(study), _worst_fold(study), _conclusion(study),
            _locklinks(study), _strut(study), _critical(study)]


def compute(angles: int = 13, loads: int = 9) -> Study:
    """Compute the maps on a grid of so many values, and the worst cases."""
    gear = mc.Mechanism.from_xml("nose_gear")
    case = Case.of(gear, 1.0, 0.0)
    grid = {"gravity_angle": np.linspace(*ANGLE_RANGE, angles), "load_factor": np.linspace(*LOAD_RANGE, loads)}
    retraction = mc.worst_case(case.cusp, BOX, quantity="F_ret")
    middle = retraction.parameters["gravity_angle"]
    slopes = {}
    for degrees in ANGLES:
        there = mc.follow_point(case.cusp, {"gravity_angle": np.radians(degrees)}).point
        slopes[degrees] = mc.sensitivities(there, "load_factor", quantities="F_ul")["F_ul", "load_factor"]
    return Study(
        rigid=RigidGear.of(gear.values()),
        cusps=mc.special_map(case.cusp, grid),
        folds=mc.special_map(case.fold, grid),
        retraction=retraction,
        unlock=mc.worst_case(case.cusp, BOX, quantity="F_ul", maximise=False),
        fold=mc.worst_case(case.fold, BOX, quantity="F_ret"),
        near=mc.special_map(retraction.point, {"gravity_angle": middle + np.linspace(-NEAR, NEAR, 11)}),
        slopes=slopes,
    )


# --- drawing


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(3, 2, (9.4, 11.4))
    panels = [(axes[0, 0], study.cusps, "F_ul", "(a)  F_ul at the cusp"),
              (axes[0, 1], study.cusps, "F_ret", "(b)  F_ret at the cusp"),
              (axes[1, 0], study.folds, "F_ret", "(c)  F_ret at FP$_1$, no unlock force")]
    for ax, found, quantity, title in panels:
        found.plot(quantity, ax=ax)
        ax.get_legend().remove()
        set_panel_title(ax, title)
    worst = study.retraction.parameters
    axes[0, 1].plot(np.degrees(worst["gravity_angle"]), worst["load_factor"], "*", color=COLORS[5], markersize=13.0,
                    markeredgecolor="white", clip_on=False, zorder=5)
    spots = {axes[1, 1]: ("F_ul", "(d)  F_ul at the cusp"), axes[2, 0]: ("F_ret", "(e)  F_ret at the cusp")}
    for ax, (quantity, title) in spots.items():
        spot = ax.get_subplotspec()
        ax.remove()
        surface = figure.add_subplot(spot, projection="3d")
        study.cusps.plot(quantity, kind="surface", ax=surface)
        set_panel_title(surface, title)
        if quantity == "F_ret":
            surface.zaxis.set_major_formatter(lambda value, _: f"{value / 1e3:.0f}")
            surface.set_zlabel(axis_label("F_ret", "kN"), labelpad=8)
    _draw_lines(axes[2, 1], study)
    save_figure(figure, path)


def _draw_lines(ax: Any, study: Study) -> None:
    angles = study.angles[:, 0]
    fine = np.linspace(*ANGLE_RANGE, 121)
    for i, color in zip(np.linspace(0, len(study.loads) - 1, 3).astype(int), COLORS, strict=False):
        load = study.loads[i]
        ax.plot(np.degrees(angles), study.cusps["F_ul"][:, i], "o", color=color, markersize=4.0, label=f"n = {load:g}")
        ax.plot(np.degrees(fine), study.rigid.unlock(fine, load), "--", color=color, linewidth=1.2)
    ax.axvline(np.degrees(study.rigid.neutral), color="#333333", linestyle=":", linewidth=1.0)
    ax.set(xlabel=axis_label("gravity_angle", "deg"), ylabel=f"{readable('F_ul')} at the cusp [N]")
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8, loc="upper left")
    set_panel_title(ax, "(f)  F_ul at the cusp; dashed: rigid pins")


# --- findings


def _where(worst: mc.WorstCase) -> str:
    at = worst.parameters
    return f"{np.degrees(at['gravity_angle']):.2f} deg and load factor {at['load_factor']:g}"


def _exists(study: Study) -> Finding:
    both = study.cusps.exists & study.folds.exists
    angle = np.degrees(study.cusps["theta_ov"])
    shape = " x ".join(map(str, both.shape))
    far = study.cusps.largest("theta_ov")
    return Finding(
        "Cusp and FP1 exist at every gravity angle and load factor looked at, the cusp above overcentre: a force "
        "measure has its threshold everywhere.",
        f"{int(both.sum())} of {both.size} nodes ({shape}); theta_ov at the cusp from {np.nanmin(angle):+.2f} to "
        f"{np.nanmax(angle):+.2f} deg, the latter at {np.degrees(far['gravity_angle']):.0f} deg and load factor "
        f"{far['load_factor']:g}",
        bool(both.all()) and bool(np.nanmin(angle) > 0.0),
    )


def _worst_retraction(study: Study) -> Finding:
    worst, grid = study.retraction, float(np.nanmax(study.cusps["F_ret"]))
    beside = study.near["F_ret"]
    inside = ANGLE_RANGE[0] < worst.parameters["gravity_angle"] < ANGLE_RANGE[1]
    return Finding(
        "The retraction force at the cusp is largest inside the range of gravity angles, not at the steepest descent.",
        f"{worst.value:.0f} N at {_where(worst)}; {worst.message}. Best node of the map: {grid:.0f} N; within "
        f"{np.degrees(NEAR):g} deg {len(beside)} angles give {np.nanmin(beside):.1f} to {np.nanmax(beside):.1f} N, the "
        f"largest in the middle",
        worst.status == "stationary" and inside and worst.active == {"load_factor": "high"} and worst.value >= grid
        and int(np.nanargmax(beside)) == len(beside) // 2,
    )


def _worst_unlock(study: Study) -> Finding:
    worst, grid = study.unlock, study.cusps["F_ul"]
    node = float(np.nanmin(grid))
    return Finding(
        "The unlock force at the cusp is largest in a corner: the steepest descent at the highest load factor.",
        f"{-worst.value:.2f} N at {_where(worst)}; {worst.message}. Over the map it takes {-np.nanmax(grid):.1f} to "
        f"{-node:.1f} N",
        worst.active == {"gravity_angle": "low", "load_factor": "high"} and abs(worst.value - node) < 1e-3,
    )


def _worst_fold(study: Study) -> Finding:
    worst, grid = study.fold, study.folds["F_ret"]
    rising = bool(np.all(np.diff(grid, axis=1) > 0))
    return Finding(
        "The force that retracts and locks the gear, F_ret at FP1, rises with load factor at every gravity angle, and "
        "is largest at the same end of the range.",
        f"{worst.value:.0f} N at {_where(worst)}, best node {np.nanmax(grid):.0f} N; from load factor "
        f"{study.loads[0]:g} to {study.loads[-1]:g} by {np.min(grid[:, -1] / grid[:, 0]):.2f} to "
        f"{np.max(grid[:, -1] / grid[:, 0]):.2f}",
        rising and worst.value >= np.nanmax(grid) - 1.0 and worst.parameters["load_factor"] == LOAD_RANGE[1],
    )


def _conclusion(study: Study) -> Finding:
    ends = {d: float(s * (LOAD_FACTORS[-1] - LOAD_FACTORS[0])) for d, s in study.slopes.items()}
    size = abs(float(np.nanmean(study.cusps["F_ul"])))
    descent, level, climb = (ends[d] for d in ANGLES)
    shown = ", ".join(f"{-v:+.1f} N at {d:+.0f} deg" for d, v in ends.items())
    return Finding(
        "Higher load factors need less unlock force at two of the paper's three angles, and have little effect at the "
        "third, -20 deg.",
        f"by the derivative at load factor 1, from {LOAD_FACTORS[0]:g} to {LOAD_FACTORS[-1]:g}: {shown}",
        abs(descent) < 0.01 * size and level > 0.05 * size and climb > level,
    )


def _locklinks(study: Study) -> Finding:
    exact = study.rigid.unlock(study.angles, study.loads)
    apart = float(np.nanmax(np.abs(study.cusps["F_ul"] / exact - 1.0)))
    change = study.cusps["F_ul"][:, -1] - study.cusps["F_ul"][:, 0]
    crossing = float(np.interp(0.0, change, study.angles[:, 0]))
    return Finding(
        "Why: at the cusp the unlock force carries the spring and the weight of the locklinks alone, so load moves it "
        "in proportion to the part of gravity that is square to them, and not at all where gravity acts along them.",
        f"rigid pins in closed form, F_ul = {study.rigid.spring:.1f} N + n ({study.rigid.weight[1]:.2f} cos + "
        f"{study.rigid.weight[0]:.2f} sin) N, agree with the map to {100 * apart:.2f} %. Gravity acts along the "
        f"locklinks at {np.degrees(study.rigid.neutral):.2f} deg; on the map load factors {study.loads[0]:g} and "
        f"{study.loads[-1]:g} need the same force at {np.degrees(crossing):.2f} deg",
        apart < CLOSE and bool(np.all(np.diff(change) > 0)) and abs(crossing - study.rigid.neutral) < np.radians(2.0),
    )


def _strut(study: Study) -> Finding:
    apart = float(np.nanmax(np.abs(study.cusps["F_ret"] / study.rigid.retraction(study.angles, study.loads) - 1.0)))
    at = study.retraction.parameters["gravity_angle"]
    return Finding(
        "The retraction force at the cusp carries the weight of the whole gear about D: proportional to load factor, "
        "largest where gravity is square to the strut, but for the drag stays.",
        f"rigid pins in closed form agree to {100 * apart:.2f} %, with the largest force at "
        f"{np.degrees(study.rigid.steepest):.2f} deg (found: {np.degrees(at):.2f} deg; square to the strut alone: "
        f"{-90.0 - np.degrees(study.rigid.theta_1):.2f} deg)",
        apart < CLOSE and abs(study.rigid.steepest - at) < np.radians(1.0),
    )


def _critical(study: Study) -> Finding:
    kept = [w.parameters for w in (study.retraction, study.unlock, study.fold)]
    steep = study.cusps["F_ul"][0]
    small = float(steep[0] - steep[-1])
    return Finding(
        "A critical design case arises nose-down under high positive g, as the paper suggests: for both actuators, but "
        "for the unlock actuator by little.",
        f"all three worst cases lie at load factor {LOAD_RANGE[1]:g}, between "
        f"{np.degrees(min(k['gravity_angle'] for k in kept)):.1f} and "
        f"{np.degrees(max(k['gravity_angle'] for k in kept)):.1f} deg. At {np.degrees(ANGLE_RANGE[0]):.0f} deg load "
        f"factor {study.loads[-1]:g} instead of {study.loads[0]:g} asks for {small:.1f} N more unlock force "
        f"({100 * small / -steep[0]:.1f} %), and for {study.cusps['F_ret'][0, -1] / study.cusps['F_ret'][0, 0]:.2f} "
        f"times the retraction force. Quasi-static, nose gear of our parameters, no air loads",
        all(k["load_factor"] == LOAD_RANGE[1] and k["gravity_angle"] < np.radians(-20.0) for k in kept)
        and 0.0 < small < 0.1 * -steep[0],
    )


if __name__ == "__main__":
    run_script(main)
