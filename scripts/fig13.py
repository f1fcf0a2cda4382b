"""Figure 13: the equilibria around uplock at load factors 0.5 and 2.5.

theta_ov against F_ret around uplock (theta_1 < -45 deg), gravity angle 0, no unlock force: (a) 0.5 g, (b) 2.5 g.
Light grey: above overcentre; dark grey: below. Solid: stable; dashed: unstable.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _gear import ANGLES, LOAD_FACTORS, Case, Slice, add_legend, angle_of, cases, load_case

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure, set_panel_title
from mjcont.paper.reproduce import Finding, run_script, whole


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear")
    slices = [Slice.of(gear, load_case(n)) for n in LOAD_FACTORS]
    locus = whole(mc.continue_special(slices[0].fold, "load_factor", bounds=(LOAD_FACTORS[0], LOAD_FACTORS[-1])))
    _draw(slices, out)
    return [
        _same_structure(slices),
        _three_folds(slices),
        _more_force(slices, locus),
        _more_retracted(slices, locus),
        _all_cases([c for n in LOAD_FACTORS for c in cases(gear, n)]),
    ]


def _draw(slices: list[Slice], out: Path) -> None:
    figure, axes = new_figure(2, 1, (6.0, 5.4), sharex=True, sharey=True)
    for ax, letter, piece in zip(axes, "ab", (slices[0], slices[-1]), strict=True):
        piece.draw(ax)
        set_panel_title(ax, f"({letter})  load factor {piece.load['load_factor']:g}")
        ax.set(xlim=(100, 1600), ylim=(-75, 75))
        ax.label_outer()
    add_legend(axes[0], loc="upper right")
    save_figure(figure, out / "fig13.png")


def _same_structure(slices: list[Slice]) -> Finding:
    curves = [" ".join((side + " overcentre", *words)) for side, *words in slices[0].structure]
    return Finding(
        "The load factor changes the equilibria in quantity only: the same curves, stretched to larger retraction "
        "forces.",
        f"at load factors {', '.join(f'{n:g}' for n in LOAD_FACTORS)} around uplock alike: {'; '.join(curves)}",
        all(s.structure == slices[0].structure for s in slices),
    )


def _three_folds(slices: list[Slice]) -> Finding:
    counts = [len(s.folds) for s in slices]
    return Finding(
        "These curves have three folds.",
        f"{', '.join(map(str, counts))} at load factors {', '.join(f'{n:g}' for n in LOAD_FACTORS)}: FP1 only. Nothing "
        f"but the spring and F_ret holds this model below overcentre: as F_ret falls the locked gear extends there "
        f"without a fold (figure 10)",
        set(counts) == {3},
    )


def _more_force(slices: list[Slice], locus: mc.Branch) -> Finding:
    forces = [s.fold["F_ret"] for s in slices]
    ratio = forces[-1] / forces[0]
    return Finding(
        "The retraction force at FP1 grows by more than the load factor's ratio of 5 from (a) to (b).",
        f"F_ret = {', '.join(f'{f:.1f}' for f in forces)} N at load factors "
        f"{', '.join(f'{n:g}' for n in LOAD_FACTORS)}: by {ratio:.3f}, rising all along FP1's curve in load factor",
        ratio > 5.0 and np.all(np.diff(locus["F_ret"]) > 0) and abs(locus["F_ret"][-1] / forces[-1] - 1) < 1e-9,
    )


def _more_retracted(slices: list[Slice], locus: mc.Branch) -> Finding:
    shown = [f"theta_1 = {angle_of(s.fold, 'theta_1'):.3f}, theta_ov = {angle_of(s.fold):+.3f} deg" for s in slices]
    return Finding(
        "With more load FP1 lies at another overcentre angle, the gear more retracted there.",
        f"{'; '.join(shown)}; both fall all along FP1's curve in load factor",
        np.all(np.diff(locus["theta_1"]) < 0) and np.all(np.diff(locus["theta_ov"]) < 0),
    )


def _all_cases(loci: list[Case]) -> Finding:
    above, below = ([angle_of(p) for p in points] for points in
                    ([c.fold for c in loci], [c.unlocked for c in loci]))
    return Finding(
        "At every load factor and attitude FP1 lies above overcentre without unlock force and below with 500 N.",
        f"{len(loci)} cases, load factors {', '.join(f'{n:g}' for n in LOAD_FACTORS)}, gravity angles "
        f"{', '.join(f'{a:g}' for a in ANGLES)} deg: theta_ov from {min(above):+.2f} to {max(above):+.2f} deg, with "
        f"500 N from {min(below):+.2f} to {max(below):+.2f} deg",
        min(above) > 0 > max(below),
    )


if __name__ == "__main__":
    run_script(main)
