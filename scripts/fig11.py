"""Figure 11: the crucial fold FP1 for three aircraft attitudes, without and with unlock force.

theta_ov against F_ret around uplock (theta_1 < -45 deg): (a) without unlock force, (b) with 500 N (F_ul = -500 N:
the actuator pulls); gravity angle (1) -20 deg, a descending aircraft, (2) 0 deg, (3) +20 deg, a climbing one. Light
grey: above overcentre; dark grey: below. Solid: stable; dashed: unstable.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _gear import ANGLES, PANELS, UNLOCK, Case, Slice, add_legend, angle_of, cases, load_case, signed

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure, set_panel_title
from mjcont.motion.histories import simulate
from mjcont.paper.reproduce import Finding, run_script, whole


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear")
    rows = [[Slice.of(gear, load_case(1.0, angle, force)) for angle in ANGLES] for force in (0.0, UNLOCK)]
    _draw(rows, out)
    return [
        _moves(*rows),
        _same_fold(rows[1], cases(gear, 1.0)),
        _unlocks(*rows),
        _less_force(*rows),
    ]


def _draw(rows: list[list[Slice]], out: Path) -> None:
    figure, axes = new_figure(2, 3, (9.6, 5.6), sharex=True, sharey=True)
    for row, letter in zip(range(2), "ab", strict=True):
        for ax, piece, number, angle in zip(axes[row], rows[row], PANELS, ANGLES, strict=True):
            piece.draw(ax)
            force = f"{-piece.load['F_ul']:g} N" if row else "no unlock force"
            set_panel_title(ax, f"({letter}{number})  {signed(angle)}, {force}")
            ax.set(xlim=(300, 800), ylim=(-75, 75))
            ax.label_outer()
    add_legend(axes[0, 2], loc="upper right")
    save_figure(figure, out / "fig11.png")


def _moves(locked: list[Slice], unlocked: list[Slice]) -> Finding:
    shown = [f"{signed(a)}: theta_ov = {angle_of(s.fold):+.3f} and {angle_of(u.fold):+.3f} deg"
             for a, s, u in zip(ANGLES, locked, unlocked, strict=True)]
    return Finding(
        "At every attitude the unlock actuator moves FP1 from the curve above overcentre to the one below.",
        f"without and with 500 N, {'; '.join(shown)}. It is the only fold in each panel",
        all(s.fold["theta_ov"] > 0 > u.fold["theta_ov"] for s, u in zip(locked, unlocked, strict=True))
        and all(s.structure == [("above", "stable", "unstable"), ("below", "stable")] for s in locked)
        and all(u.structure == [("above", "stable"), ("below", "stable", "unstable")] for u in unlocked),
    )


def _same_fold(unlocked: list[Slice], loci: list[Case]) -> Finding:
    folds = [u.fold["F_ret"] for u in unlocked]
    off = [abs(c.unlocked["F_ret"] / f - 1) for f, c in zip(folds, loci, strict=True)]
    return Finding(
        "The fold in (b) is the one of (a), moved.",
        f"following FP1 from no unlock force to 500 N gives F_ret = {', '.join(f'{f:.3f}' for f in folds)} N, the "
        f"folds of (b), within {max(off):.0e} (relative)",
        max(off) < 1e-9,
    )


def _unlocks(locked: list[Slice], unlocked: list[Slice]) -> Finding:
    shown, right = [], []
    for angle, s, u in zip(ANGLES, locked, unlocked, strict=True):
        force = 1.01 * u.fold["F_ret"]
        ends = []
        for piece, start in ((u, u.fold), (s, next(p for p in s.at(force) if p["theta_ov"] < 0))):
            motion = simulate(piece.gear, {"F_ret": force}, duration=60.0, start=start)
            ends.append(np.degrees(motion["theta_ov"][-1]))
        (only,) = (angle_of(p) for p in u.at(force) if p.stability == "stable")
        shown.append(f"{signed(angle)}: {ends[0]:+.2f} deg, without unlock force {ends[1]:+.2f} deg")
        right.append(abs(ends[0] - only) < 0.01 and ends[0] > 0 > ends[1])
    return Finding(
        "With the unlock force the gear leaves the locked position when F_ret is raised past FP1; without it the gear "
        "stays locked.",
        f"simulated for 60 s from below overcentre at 1.01 times the force of FP1 in (b), theta_ov comes to "
        f"{'; '.join(shown)}",
        all(right),
    )


def _less_force(*rows: list[Slice]) -> Finding:
    shown, falling = [], []
    low, high = np.radians([ANGLES[0], ANGLES[-1]])
    for row in rows:
        locus = whole(mc.continue_special(row[1].fold, "gravity_angle", bounds=(low, high)))
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
    )


if __name__ == "__main__":
    run_script(main)
