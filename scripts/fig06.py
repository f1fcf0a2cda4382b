"""Figure 6: the nose landing gear, with every joint elastic, and the gear that locks.

Upper row: the gear of Section III (15 degrees of freedom, k_j = 1e6 N/m) locked down and at the folds of its equilibria
near uplock. Lower rows: the gear that locks (nose_gear_locking, Section IV) locked down and at its three folds there.
Rings: elastic joints; titles: theta_ov; orange: the spring between strut and locklink; red: the forces.
"""

from pathlib import Path

import numpy as np
from _gear import LOCKING, Slice, angle_of, draw_both, load_case

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into `out` and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear_full")
    diagram = mc.bifurcation_diagram(
        gear, "F_ret", (0, 60), {"F_ret": 20.0}, keyframes=["uplock_above", "uplock_below"]
    )
    folds = [p for b in diagram for p in b.of_kind("LP") if np.degrees(p["theta_1"]) < -20.0]
    folds.sort(key=lambda p: -p["theta_ov"])
    near = Slice.of(mc.Mechanism.from_xml(LOCKING), load_case())
    figure, axes = new_figure(3, 4, (10.4, 8.8))
    poses = {f"fold at {angle_of(p):+.1f} deg": p for p in folds[:3]}
    mc.draw_poses(gear, {"downlock": "downlock_below", **poses}, axes=axes[0])
    poses = {f"FP{k} at {angle_of(p):+.1f} deg": p for k, p in enumerate(near.folds, 1)}
    draw_both(axes[1:], near.gear, {"downlock": "downlock_below", **poses})
    save_figure(figure, out / "fig06.png")
    write_twins(out, "fig06", *diagram, *near.branches)
    gap = max(abs(p[name]) for p in folds for name in gear.observables if name[:2] in ("x_", "z_"))
    return [
        Finding(
            "Stiff elastic joints hold the mechanism together: the pins hardly open.",
            f"at {len(folds)} folds with theta_1 < -20 deg no tree pin opens by more than {1e3 * gap:.3f} mm "
            f"at k_j = {gear.parameters['k_j'].value:.0e} N/m",
            len(folds) >= 3 and gap < 1e-3,
        )
    ]


if __name__ == "__main__":
    run_script(main)
