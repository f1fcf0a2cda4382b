"""Figure 8: joint stiffness and the equilibria of the nose gear near uplock.

Overcentre angle theta_ov (a) at the three folds of figure 7 against the joint stiffness k_j, the same in all joints;
(b) at equilibrium against the retraction force F_ret, within theta_1 < -20 deg, for the stiffnesses that grey lines
mark in (a). Stars: cusps. Diamonds: turns without a cusp (w . f_F_ret = 0), beyond which the thin line goes on as
another fold. In (b) light grey: above overcentre; dark grey: below; solid: stable; dashed: unstable; circles: folds,
named if stiff joints have them too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np
from _gear import add_legend, angle_of, draw_sides

import mjcont as mc
from mjcont.drawing.axes import axis_label, readable
from mjcont.drawing.plotting import draw_curve, mark, new_figure, pieces, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins
from mjcont.results.points import show

BOUNDS = (-40.0, 60.0)  # F_ret in N
WINDOW = np.radians(-20.0)  # theta_1 near uplock lies below
SPAN = (100.0, 1e8)  # k_j in N/m
STIFFNESS = (1e4, 1e5, 1e6)
KEYFRAMES = ("uplock_above", "uplock_below")


@dataclass(frozen=True)
class FoldCurve:
    """A fold's curve in (F_ret, k_j): the part of its locus from stiff joints to where another fold's begins.

    There w . f_F_ret = 0: the locus turns back to stiffer joints without a cusp.
    """

    locus: mc.Branch

    @property
    def rows(self) -> slice:
        """The rows that are this fold's."""
        turns, start = [p.index for p in self.locus.of_kind("BP")], self.locus.start_index
        first = max((i for i in turns if i < start), default=0)
        return slice(first, min((i for i in turns if i > start), default=len(self.locus) - 1) + 1)

    def of_kind(self, kind: str) -> list[mc.SpecialPoint]:
        """Return the special points of a kind on this part, from stiff joints on."""
        found = [p for p in self.locus.of_kind(kind) if self.rows.start <= p.index < self.rows.stop]
        return found if self.rows.start == 0 else found[::-1]

    @property
    def turns(self) -> list[mc.SpecialPoint]:
        """Where a slice's number of folds on this part changes."""
        return [*self.of_kind("CP"), *self.of_kind("BP")]

    def stiffest(self, name: str) -> float:
        """Return a column at the stiff end."""
        return float(self.locus[name][0 if self.rows.start == 0 else -1])


@dataclass(frozen=True)
class Slice:
    """The equilibria near uplock at one stiffness, beside the curves of the folds FP1, FP2, FP3."""

    k_j: float
    curves: Sequence[FoldCurve]
    branches: Sequence[mc.Branch]

    @classmethod
    def of(cls, curves: Sequence[FoldCurve], k_j: float) -> Slice:
        """Follow the branches through all folds met at k_j, each once."""
        starts = [p for c in curves for p in _at(c.locus.of_kind("UZ"), k_j)]
        diagram = mc.bifurcation_diagram(starts[0].problem, "F_ret", BOUNDS, starts, zeros={"theta_ov": 0.0})
        return cls(k_j, curves, [whole(b) for b in diagram])

    @property
    def named(self) -> list[mc.SpecialPoint]:
        """FP1, FP2, FP3 at this stiffness: the first met when stiff joints are softened."""
        return [_at(c.of_kind("UZ"), self.k_j)[0] for c in self.curves]

    @property
    def folds(self) -> list[mc.SpecialPoint]:
        """All folds near uplock, by falling theta_ov."""
        found = [p for b in self.branches for p in b.of_kind("LP") if p["theta_1"] < WINDOW]
        return sorted(found, key=lambda p: -p["theta_ov"])

    @property
    def foreign(self) -> list[mc.SpecialPoint]:
        """The folds that lie on none of the three loci."""
        known = [p["theta_ov"] for c in self.curves for p in _at(c.locus.of_kind("UZ"), self.k_j)]
        return [p for p in self.folds if min(abs(p["theta_ov"] - t) for t in known) > 1e-6]

    @property
    def crossings(self) -> list[mc.SpecialPoint]:
        """Equilibria near uplock at overcentre."""
        return [p for b in self.branches for p in b.of_kind("UZ") if p["theta_1"] < WINDOW]

    @property
    def stability(self) -> list[list[str]]:
        """Stability along each branch near uplock; stretches that are marginal to rounding count with their sides."""
        found = []
        for b in self.branches:
            near = inside(b)
            words = [word for word, first, last in pieces(b) if near[first : last + 1].any() and word != "marginal"]
            found.append([word for word, _ in groupby(words)])
        return sorted(found)


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    folds = stiff_folds(mc.Mechanism.from_xml("nose_gear_full"))
    curves = softened(folds)
    slices = [Slice.of(curves, k) for k in STIFFNESS]
    _draw(slices, out)
    write_twins(out, "fig08", *(b for piece in slices for b in piece.branches), *(c.locus for c in curves))
    soft, middle, stiff = slices
    return [_turns(soft.curves), _single(soft.curves), _additional(soft, stiff), _wrong(slices), _same(middle, stiff)]


def _at(points: Sequence[mc.SpecialPoint], k_j: float) -> list[mc.SpecialPoint]:
    """Return those of some points that lie at a stiffness."""
    return [p for p in points if abs(p["k_j"] / k_j - 1.0) < 1e-9]


def inside(branch: mc.Branch) -> Array:
    """Return which rows lie near uplock, (N,)."""
    return np.asarray(branch["theta_1"] < WINDOW)


def stiff_folds(gear: mc.Mechanism) -> list[mc.SpecialPoint]:
    """Return the folds near uplock at the model's own stiffness, FP1, FP2, FP3 by falling theta_ov."""
    diagram = mc.bifurcation_diagram(gear, "F_ret", BOUNDS, {"F_ret": 20.0}, keyframes=KEYFRAMES)
    found = [p for b in diagram for p in whole(b).of_kind("LP") if p["theta_1"] < WINDOW]
    return sorted(found, key=lambda p: -p["theta_ov"])


def softened(folds: Sequence[mc.SpecialPoint]) -> list[FoldCurve]:
    """Return the curves of folds in stiffness."""
    loci = [mc.continue_special(p, "k_j", SPAN, zeros={"k_j": STIFFNESS}, ds_max=0.03) for p in folds]
    return [FoldCurve(whole(locus)) for locus in loci]


def _draw(slices: Sequence[Slice], out: Path) -> None:
    figure, axes = new_figure(2, 3, (9.6, 6.0))
    for i, (ax, curve) in enumerate(zip(axes[0], slices[0].curves, strict=True), 1):
        k_j, theta = curve.locus["k_j"], np.degrees(curve.locus["theta_ov"])
        draw_curve(ax, k_j, theta, [("stable", 0, len(k_j) - 1)], color="0.6", width=0.8)
        draw_curve(ax, k_j, theta, [("stable", curve.rows.start, curve.rows.stop - 1)], color="black")
        for p in curve.turns:
            mark(ax, p["k_j"], angle_of(p), p.kind)
        for k in STIFFNESS:
            ax.axvline(k, color="0.75", linewidth=1.2, zorder=0.5)
        low, high = theta[curve.rows].min(), theta[curve.rows].max()
        pad = 0.15 * (high - low)
        ax.set(xscale="log", xlim=SPAN, ylim=(low - pad, high + pad))
        ax.set(xlabel=axis_label("k_j", "N/m"), ylabel=axis_label("theta_ov", "deg"))
        set_panel_title(ax, f"(a{i})  FP$_{i}$")
    for i, (ax, s) in enumerate(zip(axes[1], slices, strict=True), 1):
        for b in s.branches:
            draw_sides(ax, b, np.where(inside(b), b["F_ret"], np.nan), np.degrees(b["theta_ov"]))
        for p in s.folds:
            names = [f"FP$_{j}$" for j, q in enumerate(s.named, 1) if abs(q["theta_ov"] - p["theta_ov"]) < 1e-6]
            mark(ax, p["F_ret"], angle_of(p), "LP", *names)
        ax.set(xlim=BOUNDS, ylim=(-90, 90), yticks=range(-90, 91, 30))
        ax.set(xlabel=axis_label("F_ret", "N"), ylabel=axis_label("theta_ov", "deg"))
        set_panel_title(ax, f"(b{i})  {readable('k_j')} = {show(s.k_j, 'N/m', 3)}")
    add_legend(axes[1, 1], loc="lower left", handlelength=1.0, handletextpad=0.5, borderaxespad=0.1)
    save_figure(figure, out / "fig08.png")


def _turns(curves: Sequence[FoldCurve]) -> Finding:
    names = {"CP": "cusp", "BP": "no cusp"}
    shown = [
        f"FP{i} turns at " + ", ".join(f"{p['k_j']:.1f} N/m, {angle_of(p):+.2f} deg ({names[p.kind]})" for p in c.turns)
        for i, c in enumerate(curves, 1)
    ]
    joined = abs(curves[0].turns[-1]["k_j"] / curves[1].turns[-1]["k_j"] - 1)
    beyond = np.degrees(curves[2].locus["theta_ov"][-1 if curves[2].rows.start == 0 else 0])
    return Finding(
        "At low stiffness, 1e2 to 1e4 N/m, the curves of the folds change greatly: some have cusps, and a slice may "
        "meet them several times (in the paper those of FP1 and FP3).",
        f"{'; '.join(shown)}. Those of FP1 and FP2 end at one point (k_j agrees to {joined:.0e}): between their turns "
        f"a slice meets each of them twice. That of FP3 has no cusp; its locus turns back to a fourth fold, outside "
        f"the window in stiff joints ({beyond:.3f} deg at {SPAN[1]:.0e} N/m)",
        [[p.kind for p in c.turns] for c in curves] == [["CP", "BP"], ["CP", "BP"], ["BP"]] and joined < 1e-6
        and all(1e2 < p["k_j"] < 1.1e4 for c in curves for p in c.turns),
    )


def _single(curves: Sequence[FoldCurve]) -> Finding:
    last = max(p["k_j"] for c in curves for p in c.turns)
    counts = [
        int(np.count_nonzero(np.diff(np.sign(np.log(c.locus["k_j"][c.rows] / k))))) for c in curves
        for k in np.geomspace(1.001 * last, SPAN[1] / 1.001, 50)
    ]
    return Finding(
        "In stiff joints, from 1e5 N/m on at the latest, a slice meets each fold's curve once.",
        f"once from k_j = {last:.0f} N/m on, the last turn, to {SPAN[1]:.0e} N/m, where the curves were ended",
        set(counts) == {1} and last < 1e5,
    )


def _additional(soft: Slice, stiff: Slice) -> Finding:
    (foreign,) = soft.foreign
    span = (0.9 * soft.k_j, 10.0 * soft.k_j)
    locus = mc.continue_special(foreign, "k_j", {"k_j": span, "F_ret": (-1e4, 1e4)}, direction=1)
    shown = ", ".join(f"{angle_of(p):+.3f} deg ({p['F_ret']:.4f} N)" for p in soft.folds)
    return Finding(
        "At 1e4 N/m there are folds that the stiff mechanism does not have, one of them on none of the curves (a).",
        f"{len(soft.folds)} folds in (b1): {shown}; {len(stiff.folds)} in (b3). On none of the curves: the one at "
        f"{angle_of(foreign):+.3f} deg, where the links pass overcentre by stretching the joints, so that its force "
        f"grows with k_j, to {locus['F_ret'][-1]:.0f} N at {locus['k_j'][-1]:.0e} N/m",
        len(soft.folds) > len(stiff.folds) == 3 and soft.k_j < locus["k_j"][-1] and locus["F_ret"][-1] < BOUNDS[0],
    )


def _wrong(slices: Sequence[Slice]) -> Finding:
    count = [len(s.crossings) for s in slices]
    points = ", ".join(f"{p['F_ret']:.2f} N" for p in slices[0].crossings)
    locked = [max(p["F_ret"] for p in _locked_ends(s)) for s in slices]
    return Finding(
        "Joints of 1e4 N/m dominate the picture and give the wrong behaviour; 1e5 N/m gives the right one.",
        f"at 1e4 N/m a curve passes overcentre near uplock (at {points}), and the equilibria below overcentre that are "
        f"stable from FP2 on end at {locked[0]:.2f} N; at 1e5 and 1e6 N/m none passes ({count[1]} and {count[2]} "
        f"points) and they go on to the bound of {locked[1]:.0f} N",
        count[0] > 0 and count[1:] == [0, 0] and locked[0] < BOUNDS[1] == locked[1] == locked[2],
    )


def _locked_ends(s: Slice) -> list[mc.Point]:
    """Return the ends of the stable piece that begins at FP2."""
    for b in s.branches:
        for word, first, last in pieces(b):
            theta = b["theta_ov"][[first, last]]
            if word == "stable" and np.abs(theta - s.named[1]["theta_ov"]).min() < 1e-6:
                return [b.row(first), b.row(last)]
    return []


def _same(middle: Slice, stiff: Slice) -> Finding:
    shifts = [
        (abs(a["F_ret"] - b["F_ret"]), abs(angle_of(a) - angle_of(b)))
        for a, b in zip(middle.named, stiff.named, strict=True)
    ]
    rest = [(abs(p["F_ret"] / c.stiffest("F_ret") - 1), abs(angle_of(p) - np.degrees(c.stiffest("theta_ov"))))
            for p, c in zip(stiff.named, stiff.curves, strict=True)]
    shown = [f"FP{i} by {f:.3f} N and {t:.2f} deg" for i, (f, t) in enumerate(shifts, 1)]
    return Finding(
        "From 1e5 to 1e6 N/m very little changes, and 1e6 N/m is sufficient.",
        f"the same folds and stability; {', '.join(shown)}. From 1e6 to {SPAN[1]:.0e} N/m they move by at most "
        f"{100 * max(f for f, _ in rest):.2f} % in F_ret and {max(t for _, t in rest):.3f} deg",
        middle.stability == stiff.stability and max(t for _, t in shifts) < 1.0
        and max(f for f, _ in rest) < 0.01 and max(t for _, t in rest) < 0.1,
    )


if __name__ == "__main__":
    run_script(main)
