"""What figures 11 to 15 share: the locus of the nose gears' crucial fold FP1 in (F_ret, F_ul), and its cusp.

The locus of the first gear passes a cusp and, some mN away, a point with w . f_F_ret = 0 where slices exchange
branches. That of the gear that locks has these two apart, and goes on over a second cusp to FP2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from _gear import ANGLES, FIRST, LOCKING, NAMES, STARTS, UNLOCK, angle_of, load_case, signed

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import COLORS, draw_curve, mark, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, whole

# FP1 without and with unlock force and the cusp, level at load factor 1: energies of planar links on linear bushes
# written out by hand, folds and cusp solved as extended systems. F_ul, F_ret in N, theta_ov in deg; all digits good.
REFERENCE = {
    "nose_gear": {
        "FP1": (0.0, 474766.687, 16.715341),
        "FP1 at -500 N": (-500.0, 479994.765, -9.87745),
        "cusp": (-411.808, 484766.55, 0.4136),
    },
    "nose_gear_locking": {
        "FP1": (0.0, 514184.959, 14.38229),
        "FP1 at -500 N": (-500.0, 414608.168, -7.55755),
        "cusp": (-176.6099, 516281.514, 9.32043),
    },
}


@dataclass(frozen=True)
class Case:
    """FP1 without unlock force and its locus in (F_ret, F_ul), by default settings, at one load factor and angle."""

    load_factor: float
    degrees: float
    fold: mc.SpecialPoint
    locus: mc.Branch

    @classmethod
    def of(cls, gear: mc.Mechanism, load_factor: float, degrees: float) -> Case:
        """Find FP1 as F_ret rises from the pose uplock_above, and follow it."""
        fold = first_fold(gear, load_case(load_factor, degrees))
        locus = mc.continue_special(fold, "F_ul", bounds=(-1000.0, 0.0), zeros={"F_ul": UNLOCK})
        return cls(load_factor, degrees, fold, whole(locus))

    @property
    def model(self) -> str:
        """The gear's name."""
        return str(self.locus.problem.name)

    def _met(self, kind: str) -> list[mc.SpecialPoint]:
        """Return the points of a kind, by their distance along the locus from FP1 without unlock force."""
        return sorted(self.locus.of_kind(kind), key=lambda p: abs(p.index - self.locus.start_index))

    @property
    def cusp(self) -> mc.SpecialPoint:
        """The first cusp."""
        return self._met("CP")[0]

    @property
    def second_cusp(self) -> mc.SpecialPoint | None:
        """The cusp at which FP1 and FP2 of the gear that locks meet."""
        return next(iter(self._met("CP")[1:]), None)

    @property
    def exchange(self) -> mc.SpecialPoint:
        """The only point with w . f_F_ret = 0: slices through it exchange branches."""
        (point,) = self.locus.of_kind("BP")
        return point

    @property
    def unlocked(self) -> mc.SpecialPoint:
        """FP1 at an unlock force of -500 N."""
        return self._met("UZ")[0]

    @property
    def name(self) -> str:
        """The gravity angle, to be read."""
        return signed(self.degrees)


def first_fold(gear: mc.Mechanism, load: Mapping[str, float]) -> mc.SpecialPoint:
    """Return the first fold met as F_ret rises from the equilibrium of pose uplock_above."""
    start = {**load, "F_ret": STARTS[0] * load["load_factor"]}
    branch = mc.continue_equilibria(gear, "F_ret", start=start, keyframe="uplock_above")
    return next(p for p in branch.of_kind("LP") if p.index > branch.start_index)


def cases(gear: mc.Mechanism, load_factor: float) -> list[Case]:
    """Return the cases at one load factor, by rising gravity angle."""
    return [Case.of(gear, load_factor, degrees) for degrees in ANGLES]


def spread(values: Sequence[float]) -> float:
    """Return the difference of the largest and the smallest magnitude, relative to the largest."""
    sizes = np.abs(values)
    return float((sizes.max() - sizes.min()) / sizes.max())


def turning(branch: mc.Branch) -> float:
    """Return the largest angle in deg between chords of neighbouring points, in scaled states and parameters."""
    problem: Any = branch.problem
    moved = [problem.difference(b, a) / problem.state_scale for a, b in pairwise(branch.states)]
    scaled = [branch[n] / (high - low) for n, (low, high) in branch.free.items()]
    chords = np.column_stack([np.array(moved), np.diff(scaled).T])
    unit = chords / np.linalg.norm(chords, axis=1)[:, None]
    return float(np.degrees(np.arccos(np.clip(np.sum(unit[:-1] * unit[1:], axis=1), -1.0, 1.0))).max())


def near_cusp(gear: mc.Mechanism, case: Case) -> mc.Branch:
    """Return the locus within a few mN of its cusp, for a magnified view: narrow bounds make small steps."""
    reach = max(0.02, 8.0 * abs(case.cusp["F_ul"] - case.exchange["F_ul"]))
    low, high = case.cusp["F_ul"] - reach, case.cusp["F_ul"] + reach
    fold = first_fold(gear, load_case(case.load_factor, case.degrees, high))
    return whole(mc.continue_special(fold, "F_ul", bounds=(low, high), ds_max=0.01))


def draw_loci(ax: Any, loci: Sequence[Case]) -> None:
    """Draw the loci of FP1 with stars at their cusps."""
    for case, color in zip(loci, COLORS, strict=False):
        rows = [("stable", 0, len(case.locus) - 1)]
        draw_curve(ax, case.locus["F_ul"], case.locus["F_ret"] / 1e3, rows, color=color)
        mark(ax, case.cusp["F_ul"], case.cusp["F_ret"] / 1e3, "CP", case.name, color=color)
        if case.second_cusp is not None:
            mark(ax, case.second_cusp["F_ul"], case.second_cusp["F_ret"] / 1e3, "CP")
            start = case.locus.start_index
            for at, text in ((start, "FP$_1$"), (0 if start else len(case.locus) - 1, "FP$_2$")):
                mark(ax, case.locus["F_ul"][at], case.locus["F_ret"][at] / 1e3, "LP", text)
    ax.set(xlabel=axis_label("F_ul", "N"), ylabel=axis_label("F_ret", "kN"))
    ax.set(xlim=(-1000.0, 0.0) if loci[0].model == FIRST else (-650.0, 40.0))


def draw_beak(ax: Any, locus: mc.Branch, color: str) -> None:
    """Draw a locus around its cusp, in mN and N from there."""
    (cusp,), (exchange,) = locus.of_kind("CP"), locus.of_kind("BP")

    def away(column: str) -> Array:
        return locus[column] - cusp[column]

    draw_curve(ax, 1e3 * away("F_ul"), away("F_ret"), [("stable", 0, len(locus) - 1)], color=color)
    x, y = 1e3 * (exchange["F_ul"] - cusp["F_ul"]), exchange["F_ret"] - cusp["F_ret"]
    mark(ax, 0.0, 0.0, "CP", "CP")
    mark(ax, x, y, "BP", "w$\\cdot$f = 0")
    ax.set(xlim=(-5.0 * x, 5.0 * x), ylim=(5.0 * y, -y))
    ax.set(xlabel=f"{readable('F_ul')} from the cusp [mN]", ylabel=f"{readable('F_ret')} from the cusp [N]")


def loci_figure(loci: Sequence[Case], locking: Sequence[Case], path: Path, *, more: int = 0) -> Any:
    """Draw the loci of both gears, and magnified the first one's cusp at gravity angle 0.

    With `more` panels to draw the figure is two panels wide and not saved.
    """
    shape, size = ((2, 2), (8.2, 7.2)) if more else ((1, 3), (12.3, 3.6))
    figure, grid = new_figure(*shape, size)
    first, beak, second = np.ravel(grid)[:3]
    draw_loci(first, loci)
    set_panel_title(first, f"(a)  {NAMES[FIRST]}, load factor {loci[0].load_factor:g}")
    middle = next(i for i, c in enumerate(loci) if c.degrees == 0)
    draw_beak(beak, near_cusp(loci[middle].locus.problem, loci[middle]), COLORS[middle])
    set_panel_title(beak, "(b)  the cusp at 0 deg, magnified")
    draw_loci(second, locking)
    set_panel_title(second, f"(c)  {NAMES[LOCKING]}, load factor {loci[0].load_factor:g}")
    if not more:
        save_figure(figure, path)
    return figure


# --- findings on loci, figures 12, 14 and 15


def found_cusps(loci: Sequence[Case]) -> Finding:
    """Find that every locus, in one run, passes its one cusp, or its two, smoothly."""
    shown = [
        f"{c.name}: F_ul = {c.cusp['F_ul']:.3f} N, F_ret = {c.cusp['F_ret']:.1f} N, "
        f"theta_ov = {angle_of(c.cusp):+.4f} deg"
        for c in loci
    ]
    others = [c.second_cusp for c in loci if c.second_cusp is not None]
    if others:
        shown.append("a second one, where FP1 meets FP2, at F_ul = " + ", ".join(f"{p['F_ul']:.1f}" for p in others)
                     + " N")
    steepest = max(turning(c.locus) for c in loci)
    return Finding(
        "The locus of FP1 at each gravity angle has a cusp: a peak in the plane of the forces, smooth as a curve of "
        "states.",
        f"one run each with default settings, {min(len(c.locus) for c in loci)} to {max(len(c.locus) for c in loci)} "
        f"points. {'; '.join(shown)}. Neighbouring points turn by at most {steepest:.1f} deg",
        all(c.cusp.converged for c in loci) and all(p.converged for p in others) and steepest < 15.0,
        loci[0].model,
    )


def separates(loci: Sequence[Case]) -> Finding:
    """Find that the cusp divides the locus into folds above and folds below overcentre."""
    widths = [abs(c.cusp["F_ul"] - c.exchange["F_ul"]) for c in loci]
    right = []
    for c in loci:
        force, angle = c.locus["F_ul"], c.locus["theta_ov"]
        weak = force > max(c.cusp["F_ul"], c.exchange["F_ul"])
        strong = force < min(c.cusp["F_ul"], c.exchange["F_ul"])
        right += [np.all(angle[weak] > 0), np.all(angle[strong] < 0)]
    sides = [f"{np.degrees(c.exchange['theta_ov']):+.3f}" for c in loci]
    return Finding(
        "The cusp separates locked from unlocked: for unlock forces weaker than there FP1 lies above overcentre, for "
        "stronger ones below.",
        f"so on all {sum(len(c.locus) for c in loci)} points of the loci. The sign changes between the cusp and a "
        f"second turning point, where w . f_F_ret = 0 and slices exchange branches: {1e3 * min(widths):.1f} to "
        f"{1e3 * max(widths):.1f} mN away, theta_ov = {', '.join(sides)} deg",
        all(right) and max(widths) < 0.1 and all(c.cusp["theta_ov"] > 0 > c.exchange["theta_ov"] for c in loci),
        loci[0].model,
    )


def least_favourable(loci: Sequence[Case]) -> Finding:
    """Find that the steepest descent needs the largest forces."""
    forces = [c.cusp["F_ret"] for c in loci]
    unlock = [c.cusp["F_ul"] for c in loci]
    return Finding(
        "The steepest descent, -20 deg, sets the limit for both actuators: retraction and unlock force at the cusp "
        "grow as the gravity angle falls.",
        f"from {loci[-1].name} to {loci[0].name} F_ret rises from {forces[-1]:.0f} N to {forces[0]:.0f} N, the unlock "
        f"force from {-unlock[-1]:.2f} N to {-unlock[0]:.2f} N",
        np.all(np.diff(forces) < 0) and np.all(np.diff(unlock) > 0),
        loci[0].model,
    )
