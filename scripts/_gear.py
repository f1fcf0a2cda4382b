"""What figures 10 to 15 share: load cases of the nose gear, its crucial fold FP1 and that fold's locus, drawing.

FP1 is the fold met when F_ret rises on the curve above overcentre near uplock. Its locus is followed in
(F_ret, F_ul). Drawing uses the paper's window around uplock and its greys: light above, dark below overcentre.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import mjcont as mc
from mjcont.drawing.plotting import (
    COLORS,
    GREY,
    LINE_STYLES,
    draw_curve,
    mark,
    new_figure,
    pieces,
    save_figure,
    set_panel_title,
)
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, whole

LOAD_FACTORS = (0.5, 1.0, 2.5)
ANGLES = (-20.0, 0.0, 20.0)  # deg
UNLOCK = -500.0  # N
PANELS = "123"
STARTS = (2.5e5, 6e5)  # N per unit of load factor: below and above FP1
DS_MAX = 0.02  # of slices, for smooth drawing; loci are found with default settings
ABOVE, BELOW = "#b0b0b0", "#454545"
# FP1 without and with unlock force and the cusp, level at load factor 1: energies of planar links on linear bushes
# written out by hand, folds and cusp solved as extended systems. F_ul, F_ret in N, theta_ov in deg; all digits good.
REFERENCE = {
    "FP1": (0.0, 474766.687, 16.715341),
    "FP1 at -500 N": (-500.0, 479994.765, -9.87745),
    "cusp": (-411.808, 484766.55, 0.4136),
}


def load_case(load_factor: float = 1.0, degrees: float = 0.0, f_ul: float = 0.0) -> dict[str, float]:
    """Return the parameters of a load case: load factor, gravity angle in deg, unlock force in N."""
    return {"load_factor": load_factor, "gravity_angle": np.radians(degrees), "F_ul": f_ul}


def angle_of(point: Mapping[str, float] | mc.Point, name: str = "theta_ov") -> float:
    """Return an angle of a point in deg."""
    return float(np.degrees(point[name]))


def signed(degrees: float) -> str:
    """Return a gravity angle to be read."""
    return f"{degrees:+.0f} deg" if degrees else "0 deg"


# --- one slice: the equilibria in F_ret near uplock


@dataclass(frozen=True)
class Slice:
    """The branches of equilibria in F_ret through the uplock poses, one load case."""

    gear: mc.Mechanism
    load: Mapping[str, float]
    branches: Sequence[mc.Branch]

    @classmethod
    def of(cls, gear: mc.Mechanism, load: Mapping[str, float]) -> Slice:
        """Follow the branches from both uplock poses at a small and a large retraction force, each once."""
        points = [
            mc.find_equilibrium(gear, {**load, "F_ret": force * load["load_factor"]}, keyframe=keyframe)
            for force in STARTS for keyframe in ("uplock_above", "uplock_below")
        ]
        diagram = mc.bifurcation_diagram(gear, "F_ret", starts=points, ds_max=DS_MAX)
        return cls(gear, load, [whole(b) for b in diagram])

    @property
    def force(self) -> float:
        """Lower end of the window in F_ret: the paper's 3e5 N at load factor 1."""
        return 3e5 * self.load["load_factor"]

    def inside(self, branch: mc.Branch) -> Array:
        """Return which rows lie in the window around uplock, theta_1 < -45 deg."""
        return np.asarray((branch["theta_1"] < np.radians(-45.0)) & (branch["F_ret"] > self.force))

    @property
    def folds(self) -> list[mc.SpecialPoint]:
        """The folds in the window."""
        return [p for b in self.branches for p in b.of_kind("LP") if self.inside(b)[p.index]]

    @property
    def fold(self) -> mc.SpecialPoint:
        """FP1, the only fold in the window."""
        (fold,) = self.folds
        return fold

    @property
    def structure(self) -> list[tuple[str, ...]]:
        """Side and stability along each branch in the window, from small F_ret: ("above", "stable", "unstable")."""
        found = []
        for b in self.branches:
            inside = self.inside(b)
            words = [w for w, first, last in pieces(b) if inside[first : last + 1].any()]
            rows = np.flatnonzero(inside & (b.stability == "stable"))
            if len(rows):
                first = rows[np.argmin(b["F_ret"][rows])]
                side = "above" if b["theta_ov"][first] > 0 else "below"
                found.append((side, *(words if words[0] == "stable" else words[::-1])))
        return sorted(found)

    def at(self, force: float) -> list[mc.Point]:
        """Return the equilibria at a retraction force near uplock."""
        return [p for b in self.branches for p in b.at(F_ret=force) if p["theta_1"] < np.radians(-45.0)]

    def draw(self, ax: Any, name: str = "FP$_1$") -> None:
        """Draw theta_ov against F_ret in the window, and FP1."""
        for b in self.branches:
            force = np.where(self.inside(b), b["F_ret"], np.nan)
            draw_sides(ax, b, force / 1e3, wrapped(b["theta_ov"]))
        mark(ax, self.fold["F_ret"] / 1e3, angle_of(self.fold), "LP", name)
        ax.set(xlabel="F_ret [kN]", ylabel="theta_ov [deg]")


def wrapped(angles: Array) -> Array:
    """Return angles in deg, in (-180, 180]."""
    return -((-np.degrees(angles) + 180.0) % 360.0 - 180.0)


def draw_sides(ax: Any, branch: mc.Branch, xs: Array, ys: Array) -> None:
    """Draw a branch (rows xs, ys), light grey above overcentre and dark grey below."""
    side = branch["theta_ov"][:-1] + branch["theta_ov"][1:] > 0
    turns = {int(i) for i in np.flatnonzero(np.abs(np.diff(ys)) > 180.0)}
    for above, color in ((True, ABOVE), (False, BELOW)):
        draw_curve(ax, xs, ys, list(_runs(pieces(branch), side == above)), color=color, width=2.0, breaks=turns)


def _runs(parts: Sequence[tuple[str, int, int]], wanted: Array) -> Iterator[tuple[str, int, int]]:
    """Yield what is left of pieces (word, first row, last row) on the wanted intervals."""
    for word, first, last in parts:
        marks = np.concatenate([[False], wanted[first:last], [False]]).astype(int)
        begins, ends = np.flatnonzero(np.diff(marks) == 1), np.flatnonzero(np.diff(marks) == -1)
        for a, b in zip(begins, ends, strict=True):
            yield word, first + int(a), first + int(b)


def add_legend(ax: Any, **options: Any) -> None:
    """Explain greys and line styles."""
    for color, text in ((ABOVE, "above overcentre"), (BELOW, "below overcentre")):
        ax.plot([], [], color=color, linewidth=2.0, label=text)
    for word in ("stable", "unstable"):
        ax.plot([], [], color=GREY, linestyle=LINE_STYLES[word], label=word)
    handles = [h for h in ax.lines if not str(h.get_label()).startswith("_")]
    ax.legend(handles=handles, frameon=True, framealpha=0.9, edgecolor="none", fontsize=8.0, **options)


# --- the locus of FP1


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
    def cusp(self) -> mc.SpecialPoint:
        """The only cusp of the locus."""
        (cusp,) = self.locus.of_kind("CP")
        return cusp

    @property
    def exchange(self) -> mc.SpecialPoint:
        """The only point with w . f_F_ret = 0: slices through it exchange branches."""
        (point,) = self.locus.of_kind("BP")
        return point

    @property
    def unlocked(self) -> mc.SpecialPoint:
        """FP1 at an unlock force of -500 N."""
        (point,) = self.locus.of_kind("UZ")
        return point

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
    ax.set(xlabel="F_ul [N]", ylabel="F_ret [kN]", xlim=(-1000.0, 0.0))


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
    ax.set(xlabel="F_ul from the cusp [mN]", ylabel="F_ret from the cusp [N]")


def loci_figure(gear: mc.Mechanism, loci: Sequence[Case], path: Path, *, panels: int = 2) -> Any:
    """Draw loci, and magnified the cusp at gravity angle 0; save unless there are more panels to draw."""
    figure, axes = new_figure(1, panels, (4.1 * panels, 3.6))
    draw_loci(axes[0], loci)
    set_panel_title(axes[0], f"(a)  FP$_1$ at load factor {loci[0].load_factor:g}")
    middle = next(i for i, c in enumerate(loci) if c.degrees == 0)
    draw_beak(axes[1], near_cusp(gear, loci[middle]), COLORS[middle])
    set_panel_title(axes[1], "(b)  the cusp at 0 deg, magnified")
    if panels == 2:
        save_figure(figure, path)
    return figure


# --- findings on loci, figures 12, 14 and 15


def found_cusps(loci: Sequence[Case]) -> Finding:
    """Find that every locus, in one run, passes its one cusp smoothly."""
    shown = [
        f"{c.name}: F_ul = {c.cusp['F_ul']:.3f} N, F_ret = {c.cusp['F_ret']:.1f} N, "
        f"theta_ov = {angle_of(c.cusp):+.4f} deg"
        for c in loci
    ]
    steepest = max(turning(c.locus) for c in loci)
    return Finding(
        "The locus of FP1 at each gravity angle has a cusp: a peak in the plane of the forces, smooth as a curve of "
        "states.",
        f"one run each with default settings, {min(len(c.locus) for c in loci)} to {max(len(c.locus) for c in loci)} "
        f"points. {'; '.join(shown)}. Neighbouring points turn by at most {steepest:.1f} deg",
        all(c.cusp.converged for c in loci) and steepest < 15.0,
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
    )
