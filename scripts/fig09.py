"""Figure 9: the nose landing gear with two elastic joints.

Two gears of Section IV (5 degrees of freedom) locked down, retracted at the crucial fold FP1, at the cusp of its locus,
where it can be unlocked, and locked up. Upper row: the first one, nose_gear (k_j = 1e6 N/m); lower rows: the gear that
locks, nose_gear_locking (k_j = 1e8 N/m). Rings: the elastic joints C and H; circles: rigid pins.
"""

from pathlib import Path

import numpy as np
from _gear import FIRST, LOCKING, Slice, angle_of, draw_both, load_case
from _loci import Case

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins

SOFT = (1e6, 1e7)  # N/m, of the gear that locks; its own is 1e8


def main(out: Path) -> list[Finding]:
    """Draw the figure into `out` and return its findings."""
    first, locking = (Case.of(mc.Mechanism.from_xml(name), 1.0, 0.0) for name in (FIRST, LOCKING))
    figure, axes = new_figure(3, 4, (10.4, 8.8))
    poses, others = (
        {"downlock": "downlock_below", "FP1": c.fold, "cusp": c.cusp, "uplock": "uplock_below"}
        for c in (first, locking)
    )
    mc.draw_poses(first.locus.problem, poses, axes=axes[0])
    draw_both(axes[1:], locking.locus.problem, others)
    save_figure(figure, out / "fig09.png")
    write_twins(out, "fig09", first.locus, locking.locus)
    return [*(_freedom(c.locus.problem) for c in (first, locking)), _sufficient(first), _stiff(locking)]


def _freedom(gear: mc.Mechanism) -> Finding:
    joints = len(gear.bushes) // 2
    return Finding(
        "Two elastic joints make the gear an ordinary differential equation with five degrees of freedom.",
        f"{gear.n} degrees of freedom, {joints} elastic joints",
        gear.n == 5 and joints == 2,
        gear.name,
    )


def _sufficient(case: Case) -> Finding:
    gear, fp1 = case.locus.problem, case.fold
    force = mc.stiffness_study(gear, fp1, "k_j", 1e-3)
    angle = mc.stiffness_study(gear, fp1, "k_j", 1e-2, quantity="theta_ov")
    chosen = gear.parameters["k_j"].value
    off = abs(np.degrees(fp1["theta_ov"] - angle.limit))
    return Finding(
        "A joint stiffness of 1e6 N/m is sufficient for this kind of mechanism.",
        f"FP1: {force}; {angle}; at {chosen:.0e} N/m theta_ov is off by {off:.2f} deg",
        force.converged_from is not None and force.converged_from < chosen and off < 1.0,
        gear.name,
    )


def _stiff(case: Case) -> Finding:
    """Find what softer joints would do to the gear that locks; ten times stiffer ones stand for rigid joints."""
    gear = case.locus.problem
    chosen = gear.parameters["k_j"].value
    folds = {
        (k, f_ul): Slice.of(gear, {**load_case(f_ul=f_ul), "k_j": k}).folds
        for k in (*SOFT, chosen, 10.0 * chosen) for f_ul in (0.0, -500.0)
    }
    counts = {k: [len(folds[k, f]) for f in (0.0, -500.0)] for k, _ in folds}
    studies = [mc.stiffness_study(gear, p, "k_j", 1e-3) for p in folds[chosen, 0.0]]
    unlocked, rigid = (folds[k, -500.0][0] for k in (chosen, 10.0 * chosen))
    off = abs(angle_of(unlocked) - angle_of(rigid))
    lost = [k for k in SOFT if not any(abs(angle_of(p) - angle_of(rigid)) < 1.0 for p in folds[k, -500.0])]
    return Finding(
        "The gear that locks needs stiffer joints, 1e8 N/m: softer ones have folds near overcentre that rigid joints "
        "have not, though each of its three folds would be where it is.",
        "; ".join(f"FP{k}: {s}" for k, s in enumerate(studies, 1))
        + ". Folds around uplock without unlock force and with 500 N: "
        + ", ".join(f"{a} and {b} at {k:.0e} N/m" for k, (a, b) in counts.items())
        + f". At {' and '.join(f'{k:.0e}' for k in lost)} N/m FP1 at 500 N is gone; at {chosen:.0e} N/m it is "
        f"{off:.2f} deg from where it is at {10 * chosen:.0e} N/m",
        all(s.converged_from is not None and s.converged_from < chosen for s in studies)
        and counts[chosen] == counts[10.0 * chosen] == [3, 3]
        and all(min(counts[k]) > 3 for k in SOFT) and off < 0.5,
        gear.name,
    )


if __name__ == "__main__":
    run_script(main)
