"""Figure 9: the nose landing gear with two elastic joints.

The gear of Section IV (5 degrees of freedom, k_j = 1e6 N/m): locked down, retracted at the crucial fold FP1, at the
cusp of its locus, where it can be unlocked, and locked up. Rings: the elastic joints C and H; circles: rigid pins.
"""

from pathlib import Path

import numpy as np

import mjcont as mc
from mjcont.drawing.plotting import save_figure
from mjcont.paper.reproduce import Finding, run_script


def main(out: Path) -> list[Finding]:
    """Draw the figure into `out` and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(
        gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above"
    )
    fp1 = branch.point("LP1")
    cusp = mc.continue_special(fp1, "F_ul", bounds=(-1000, 0)).point("CP1")
    poses = {"downlock": "downlock_below", "FP1": fp1, "cusp": cusp, "uplock": "uplock_below"}
    save_figure(mc.draw_poses(gear, poses, cols=4, size=2.3), out / "fig09.png")
    force = mc.stiffness_study(gear, fp1, "k_j", 1e-3)
    angle = mc.stiffness_study(gear, fp1, "k_j", 1e-2, quantity="theta_ov")
    chosen = gear.parameters["k_j"].value
    off = abs(np.degrees(fp1["theta_ov"] - angle.limit))
    joints = len(gear.bushes) // 2
    return [
        Finding(
            "Two elastic joints make the gear an ordinary differential equation with five degrees of freedom.",
            f"{gear.n} degrees of freedom, {joints} elastic joints",
            gear.n == 5 and joints == 2,
        ),
        Finding(
            "A joint stiffness of 1e6 N/m is sufficient for this kind of mechanism.",
            f"FP1: {force}; {angle}; at {chosen:.0e} N/m theta_ov is off by {off:.2f} deg",
            force.converged_from is not None and force.converged_from < chosen and off < 1.0,
        ),
    ]


if __name__ == "__main__":
    run_script(main)
