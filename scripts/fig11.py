"""Figure 11: the crucial fold FP1 for three aircraft attitudes, without and with unlock force.

theta_ov against F_ret around uplock (theta_1 < -45 deg): (a) without unlock force, (b) with 500 N (F_ul = -500 N:
the actuator pulls); gravity angle (1) -20 deg, a descending aircraft, (2) 0 deg, (3) +20 deg, a climbing one. (a, b)
The first gear, nose_gear, with one fold; (c, d) the same of the gear that locks, nose_gear_locking, with three. Light
grey: above overcentre; dark grey: below. Solid: stable; dashed: unstable.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _gear import (
    ANGLES,
    FIRST,
    LOCKING,
    NAMES,
    PANELS,
    UNLOCK,
    Slice,
    add_legend,
    angle_of,
    load_case,
    signed,
)

import mjcont as mc
from mjcont.drawing.axes import axis_label
from mjcont.drawing.plotting import new_figure, save_figure, set_panel_title
from mjcont.motion.histories import simulate
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    found, drawn = [], []
    for model in (FIRST, LOCKING):
        gear = mc.Mechanism.from_xml(model)
        rows = [[Slice.of(gear, load_case(1.0, angle, force)) for angle in ANGLES] for force in (0.0, UNLOCK)]
        drawn += rows
        found += [_moves(*rows), _same_fold(*rows), _unlocks(*rows), _less_force(*rows)]
    _draw(drawn, out)
    write_twins(out, "fig11", *(b for row in drawn for piece in row for b in piece.branches))
    return found


def _draw(rows: list[list[Slice]], out: Path) -> None:
    figure, axes = new_figure(4, 3, (9.6, 10.8), sharey=True, sharex="row")
    for line, row, letter in zip(axes, rows, "abcd", strict=True):
        for ax, piece, number, angle in zip(line, row, PANELS, ANGLES, strict=True):
            piece.draw(ax)
            force = f"{-piece.load['F_ul']:g} N" if piece.load["F_ul"] else "no unlock force"
            set_panel_title(ax, f"({letter}{number})  {signed(angle)}, {force}")
            ax.set(xlim=(300, 800) if piece.gear.name == FIRST else (250, 750), ylim=(-75, 75))
            low, high = ax.get_xlim()
            ax.set(xticks=np.arange(100.0 * np.floor(low / 100.0) + 100.0, high, 100.0))  # none where panels meet
            ax.set(xlabel=axis_label("F_ret", "kN") if letter in "bd" else "")
            ax.set(ylabel=f"{NAMES[piece.gear.name]}: {axis_label('theta_ov', 'deg')}" if number == PANELS[0] else "")
    add_legend(axes[0, 2], loc="upper right")
    save_figure(figure, out / "fig11.png")


def _moves(locked: list[Slice], unlocked: list[Slice]) -> Finding:
    shown = [f"{signed(a)}: theta_ov = {angle_of(s.fold):+.3f} and {angle_of(u.fold):+.3f} deg"
             for a, s, u in zip(ANGLES, locked, unlocked, strict=True)]
    model = locked[0].gear.name
    below = ("below", "stable") if model == FIRST else ("below", "stable", "unstable", "stable")
    return Finding(
        "At every attitude the unlock actuator moves FP1 from the curve above overcentre to the one below.",
        f"without and with 500 N, {'; '.join(shown)}. {_others(locked, unlocked)}",
        all(s.fold["theta_ov"] > 0 > u.fold["theta_ov"] for s, u in zip(locked, unlocked, strict=True))
        and all(s.structure == [("above", "stable", "unstable"), below] for s in locked)
        and all(u.structure == [("above", "stable"), (*below, "unstable")] for u in unlocked),
        model,
    )


def _others(locked: list[Slice], unlocked: list[Slice]) -> str:
    """Return a sentence on the folds beside FP1."""
    if len(locked[0].folds) == 1:
        return "It is the only fold in each panel"
    return (
        f"{len(locked[0].folds)} folds in each panel; at 0 deg FP2 moves from {locked[1].folds[1]['F_ret']:.1f} to "
        f"{unlocked[1].folds[1]['F_ret']:.1f} N, close to FP1 at {unlocked[1].fold['F_ret']:.1f} N"
    )


def _same_fold(locked: list[Slice], unlocked: list[Slice]) -> Finding:
    folds = [u.fold["F_ret"] for u in unlocked]
    loci = [s.followed("F_ul", UNLOCK, 0.0) for s in locked]
    moved = [locus["F_ret"][np.flatnonzero(locus["F_ul"] == UNLOCK)[0]] for locus in loci]
    off = [abs(m / f - 1) for f, m in zip(folds, moved, strict=True)]
    return Finding(
        "The fold with unlock force is the one without, moved.",
        f"following FP1 from no unlock force to 500 N gives F_ret = {', '.join(f'{f:.3f}' for f in folds)} N, the "
        f"folds of the slices, within {max(off):.0e} (relative)",
        max(off) < 1e-9,
        locked[0].gear.name,
    )


def _unlocks(locked: list[Slice], unlocked: list[Slice]) -> Finding:
    shown, right = [], []
    duration = 60.0 if locked[0].gear.name == FIRST else 30.0  # the second comes to rest sooner
    for angle, s, u in zip(ANGLES, locked, unlocked, strict=True):
        # the second gear is locked at forces above FP2 only: without unlock force F_ret is raised past FP1 there
        raised, force = (1.01 * piece.fold["F_ret"] for piece in ((u if len(u.folds) == 1 else s), u))
        ends = []
        for piece, at, start in ((u, force, u.fold), (s, raised, _locked(s, raised))):
            motion = simulate(piece.gear, {"F_ret": at}, duration=duration, start=start)
            ends.append(np.degrees(motion["theta_ov"][-1]))
        rests = [angle_of(p) for b in u.branches for p in b.at(F_ret=force) if p.stability == "stable"]
        shown.append(f"{signed(angle)}: {ends[0]:+.2f} deg, without unlock force {ends[1]:+.2f} deg")
        right.append(min(abs(ends[0] - r) for r in rests) < 0.01 and ends[0] > 0 > ends[1])
    where = "" if len(locked[0].folds) == 1 else ", without unlock force of FP1 there,"
    return Finding(
        "With the unlock force the gear leaves the locked position when F_ret is raised past FP1; without it the gear "
        "stays locked.",
        f"simulated for {duration:g} s from below overcentre at 1.01 times the force of FP1 with 500 N{where} theta_ov "
        f"comes to {'; '.join(shown)}",
        all(right),
        locked[0].gear.name,
    )


def _locked(piece: Slice, force: float) -> mc.Point:
    """Return the locked gear's rest: of those below overcentre the one nearest to it."""
    return max((p for p in piece.at(force) if p["theta_ov"] < 0 and p.stability == "stable"),
               key=lambda p: p["theta_ov"])


def _less_force(*rows: list[Slice]) -> Finding:
    shown, falling = [], []
    low, high = np.radians([ANGLES[0], ANGLES[-1]])
    for row in rows:
        locus = row[1].followed("gravity_angle", low, high)
        falling.append(bool(np.all(np.diff(locus["F_ret"]) < 0) and np.all(np.diff(locus["gravity_angle"]) > 0)))
        forces = [s.fold["F_ret"] for s in row]
        falling.append(np.allclose(locus["F_ret"][[0, -1]], [forces[0], forces[-1]], rtol=1e-9, atol=0))
        shown.append(f"{abs(row[0].load['F_ul']):g} N: {', '.join(f'{f:.1f}' for f in forces)} N")
    return Finding(
        "The retraction force at FP1 falls as the gravity angle rises from -20 deg (descending) to +20 deg (climbing): "
        "descent is the least favourable case.",
        f"F_ret at -20, 0, +20 deg with an unlock force of {'; '.join(shown)}; it falls all along FP1's curve in "
        f"gravity angle, which joins the three slices",
        all(falling),
        rows[0][0].gear.name,
    )


if __name__ == "__main__":
    run_script(main)
