"""What figures 10 to 13 share: the two nose gears, their load cases and the equilibria around uplock, drawing.

FP1 is the fold met when F_ret rises on the curve above overcentre near uplock. The first gear, nose_gear, has no other
there; the one that locks, nose_gear_locking, has two below overcentre: FP2, down to which it stays locked as F_ret
falls, and FP3. Drawing uses the paper's window around uplock and its greys: light above, dark below overcentre.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import mjcont as mc
from mjcont.drawing.axes import axis_label
from mjcont.drawing.plotting import GREY, LINE_STYLES, draw_curve, mark, pieces
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import whole

LOAD_FACTORS = (0.5, 1.0, 2.5)
ANGLES = (-20.0, 0.0, 20.0)  # deg
UNLOCK = -500.0  # N
PANELS = "123"
STARTS = (2.5e5, 4.5e5, 6e5)  # N per unit of load factor: below and above FP1, and at steep descent in between
DS_MAX = 0.02  # of slices, for smooth drawing; loci are found with default settings
ABOVE, BELOW = "#b0b0b0", "#454545"
FIRST, LOCKING = "nose_gear", "nose_gear_locking"
NAMES = {FIRST: "first gear", LOCKING: "gear that locks"}
# F_ret in N per unit of load factor around uplock: the paper's lower end for the first gear. The second one's FP1 with
# unlock force lies lower; far above its own forces it has folds that the gear with rigid pins has not.
WINDOWS = {FIRST: (3e5, np.inf), LOCKING: (2.5e5, 8e5)}


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
        """Follow the branches from rests near both uplock poses at small and large retraction forces, each once."""
        points = [
            mc.find_equilibrium(gear, {**load, "F_ret": force * load["load_factor"]}, keyframe=keyframe)
            for force in STARTS if gear.name == LOCKING or force != STARTS[1]
            for keyframe in ("uplock_above", "uplock_below")
        ]
        # unstable ones may be of those that elastic pins alone have, retracted beyond the dead centre
        points = [p for p in points if p.n_unstable == 0]
        high = min(WINDOWS[gear.name][1] * load["load_factor"], gear.parameters["F_ret"].bounds[1])
        diagram = mc.bifurcation_diagram(gear, "F_ret", (0.0, high), points, ds_max=DS_MAX)
        return cls(gear, load, [whole(b) for b in diagram])

    def inside(self, branch: mc.Branch) -> Array:
        """Return which rows lie in the window around uplock, theta_1 < -45 deg."""
        low = WINDOWS[self.gear.name][0] * self.load["load_factor"]
        return np.asarray((branch["theta_1"] < np.radians(-45.0)) & (branch["F_ret"] > low))

    @property
    def folds(self) -> list[mc.SpecialPoint]:
        """The folds in the window, FP1 first: by falling theta_ov."""
        found = [p for b in self.branches for p in b.of_kind("LP") if self.inside(b)[p.index]]
        return sorted(found, key=lambda p: -p["theta_ov"])

    @property
    def fold(self) -> mc.SpecialPoint:
        """FP1."""
        return self.folds[0]

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

    def followed(self, parameter: str, low: float, high: float) -> mc.Branch:
        """Return FP1 as a parameter varies; F_ret may leave the window."""
        bounds = {"F_ret": self.gear.parameters["F_ret"].bounds, parameter: (low, high)}
        return whole(mc.continue_special(self.fold, parameter, bounds))

    def at(self, force: float) -> list[mc.Point]:
        """Return the equilibria at a retraction force near uplock."""
        return [p for b in self.branches for p in b.at(F_ret=force) if p["theta_1"] < np.radians(-45.0)]

    def draw(self, ax: Any) -> None:
        """Draw theta_ov against F_ret in the window, and its folds."""
        for b in self.branches:
            force = np.where(self.inside(b), b["F_ret"], np.nan)
            draw_sides(ax, b, force / 1e3, wrapped(b["theta_ov"]))
        for k, fold in enumerate(self.folds, 1):
            mark(ax, fold["F_ret"] / 1e3, angle_of(fold), "LP", f"FP$_{k}$")
        ax.set(xlabel=axis_label("F_ret", "kN"), ylabel=axis_label("theta_ov", "deg"))


def draw_both(rows: Any, gear: mc.Mechanism, poses: Mapping[str, Any]) -> None:
    """Draw poses of the gear that locks in two rows of axes: whole, and its links alone."""
    mc.draw_poses(gear, poses, axes=rows[0])
    for ax, (title, pose) in zip(rows[1], poses.items(), strict=True):
        low, high = (-1.65, -0.05) if title.startswith("downlock") else (-0.75, 0.85)
        window = ((-1.75, low), (0.25, high))
        mc.draw_poses(gear, {f"{title}: links": pose}, axes=[ax], window=window, labels=("pins",))


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
