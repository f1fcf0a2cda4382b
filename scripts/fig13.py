"""Figure 13: the equilibria around uplock at load factors 0.5 and 2.5.

theta_ov against F_ret around uplock (theta_1 < -45 deg), gravity angle 0, no unlock force: (a) 0.5 g, (b) 2.5 g; (1)
the first gear, nose_gear, (2) the gear that locks, nose_gear_locking, with three folds. Light grey: above overcentre;
dark grey: below. Solid: stable; dashed: unstable.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _gear import FIRST, LOAD_FACTORS, LOCKING, NAMES, Slice, add_legend, angle_of, load_case

import mjcont as mc
from mjcont.drawing.plotting import new_figure, save_figure, set_panel_title
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    first, locking = ([Slice.of(gear, load_case(n)) for n in LOAD_FACTORS]
                      for gear in map(mc.Mechanism.from_xml, (FIRST, LOCKING)))
    _draw(first, locking, out)
    write_twins(out, "fig13", *(b for piece in (*first, *locking) for b in piece.branches))
    found = [_same_structure(first), _same_structure(locking), _three_folds(first, locking)]
    for slices in (first, locking):
        locus = slices[0].followed("load_factor", LOAD_FACTORS[0], LOAD_FACTORS[-1])
        found += [_more_force(slices, locus), _more_retracted(slices, locus)]
    return found


def _draw(first: list[Slice], locking: list[Slice], out: Path) -> None:
    figure, axes = new_figure(2, 2, (9.6, 5.4), sharex=True, sharey=True)
    for column, slices, number in zip(axes.T, (first, locking), "12", strict=True):
        for ax, letter, piece in zip(column, "ab", (slices[0], slices[-1]), strict=True):
            piece.draw(ax)
            set_panel_title(ax, f"({letter}{number})  load factor {piece.load['load_factor']:g}, "
                                f"{NAMES[piece.gear.name]}")
            ax.set(xlim=(100, 1600), ylim=(-75, 75))
            ax.label_outer()
    add_legend(axes[0, 0], loc="upper right")
    save_figure(figure, out / "fig13.png")


def _same_structure(slices: list[Slice]) -> Finding:
    curves = [" ".join((side + " overcentre", *words)) for side, *words in slices[0].structure]
    return Finding(
        "The load factor changes the equilibria in quantity only: the same curves, stretched to larger retraction "
        "forces.",
        f"at load factors {', '.join(f'{n:g}' for n in LOAD_FACTORS)} around uplock alike: {'; '.join(curves)}",
        all(s.structure == slices[0].structure for s in slices),
        slices[0].gear.name,
    )


def _three_folds(first: list[Slice], locking: list[Slice]) -> Finding:
    shown = [
        f"load factor {n:g}: " + ", ".join(f"{p['F_ret'] / 1e3:.1f} kN ({angle_of(p):+.2f} deg)" for p in s.folds)
        for n, s in zip(LOAD_FACTORS, locking, strict=True)
    ]
    one, three = ({len(s.folds) for s in slices} for slices in (first, locking))
    angles = np.array([[angle_of(p) for p in s.folds] for s in locking if len(s.folds) == 3])
    return Finding(
        "These curves have three folds, and with more load they lie at other overcentre angles.",
        f"FP1, FP2 and FP3 at {'; '.join(shown)} (theta_ov in brackets). The first gear has FP1 only: as F_ret falls "
        f"it extends below overcentre without a fold",
        three == {3} and one == {1} and np.all(np.abs(np.diff(angles, axis=0)) > 0.3),
        LOCKING,
    )


def _more_force(slices: list[Slice], locus: mc.Branch) -> Finding:
    forces = [s.fold["F_ret"] for s in slices]
    ratio = forces[-1] / forces[0]
    return Finding(
        "The retraction force at FP1 grows by more than the load factor's ratio of 5 from (a) to (b).",
        f"F_ret = {', '.join(f'{f:.1f}' for f in forces)} N at load factors "
        f"{', '.join(f'{n:g}' for n in LOAD_FACTORS)}: by {ratio:.3f}, rising all along FP1's curve in load factor",
        ratio > 5.0 and np.all(np.diff(locus["F_ret"]) > 0) and abs(locus["F_ret"][-1] / forces[-1] - 1) < 1e-9,
        slices[0].gear.name,
    )


def _more_retracted(slices: list[Slice], locus: mc.Branch) -> Finding:
    shown = [f"theta_1 = {angle_of(s.fold, 'theta_1'):.3f}, theta_ov = {angle_of(s.fold):+.3f} deg" for s in slices]
    return Finding(
        "With more load FP1 lies at another overcentre angle, the gear more retracted there.",
        f"{'; '.join(shown)}; both fall all along FP1's curve in load factor",
        np.all(np.diff(locus["theta_1"]) < 0) and np.all(np.diff(locus["theta_ov"]) < 0),
        slices[0].gear.name,
    )


if __name__ == "__main__":
    run_script(main)
