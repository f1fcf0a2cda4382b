"""Figure 1: the overcentre mechanism.

The mechanism above, at and below overcentre: at the folds of its equilibria and between them (k_j = 1000 N/m). Upper
row: overcentre; lower row: overcentre_paper, the set of figures 2 to 5, whose links and spring are longer.
Blue: link 1; green: link 2; orange: the spring; red: the force F; rings: elastic joints.
"""

from pathlib import Path

import numpy as np
from _overcentre import BOUNDS, MODEL

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into `out` and return its findings."""
    figure, axes = new_figure(2, 3, (7.8, 4.4))
    models = {name: mc.Mechanism.from_xml(name) for name in ("overcentre", MODEL)}
    branches = [mc.continue_equilibria(m, "F", bounds=BOUNDS, start={"F": BOUNDS[1]}) for m in models.values()]
    findings = [_drawn(name, branch, row) for name, branch, row in zip(models, branches, axes, strict=True)]
    save_figure(figure, out / "fig01.png")
    write_twins(out, "fig01", *branches)
    return findings


def _drawn(name: str, branch: mc.Branch, axes: np.ndarray) -> Finding:
    below, above = branch.of_kind("LP")
    (overcentre,) = branch.at(theta_1=0.0)
    poses = {"above overcentre, at its fold": above, "overcentre": overcentre, "below overcentre, at its fold": below}
    mc.draw_poses(branch.problem, poses, axes=axes)
    angles = ", ".join(f"{np.degrees(p['theta_1']):+.2f} deg" for p in poses.values())
    return Finding(
        "Lowering F takes the mechanism from above to below overcentre; at overcentre both links are horizontal.",
        f"theta_1 = {angles} at F = {above['F']:.3f}, {overcentre['F']:.3f} and {below['F']:.3f} N; "
        f"at overcentre theta_2 = {np.degrees(overcentre['theta_2']):+.3f} deg, since the joints give",
        above["theta_1"] > 0 > below["theta_1"] and abs(np.degrees(overcentre["theta_2"])) < 1.0,
        name,
    )


if __name__ == "__main__":
    run_script(main)
