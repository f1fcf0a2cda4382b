"""Figure 15: loci of the fold FP1 in both actuator forces at load factor 2.5.

F_ret against F_ul at FP1 for gravity angles of -20, 0 and +20 deg, panels as in figure 12: (a) the first gear, (b) its
cusp at 0 deg, magnified, (c) the gear that locks. (d) Not in the paper: F_ul at the first gear's cusp as the gravity
angle varies, for three load factors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from _gear import ANGLES, FIRST, LOAD_FACTORS, LOCKING, angle_of
from _loci import Case, cases, found_cusps, least_favourable, loci_figure, separates, spread
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

import mjcont as mc
from mjcont.drawing.axes import readable
from mjcont.drawing.plotting import COLORS, draw_curve, mark, save_figure, set_panel_title
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins

REACH = np.radians(30.0)


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    found, locking = (
        {n: cases(gear, n) for n in LOAD_FACTORS} for gear in map(mc.Mechanism.from_xml, (FIRST, LOCKING))
    )
    loci = found[2.5]
    cusps = {n: _cusps(next(c for c in found[n] if c.degrees == 0)) for n in found}
    figure = loci_figure(loci, locking[2.5], out / "fig15.png", more=1)
    _draw_cusps(figure.axes[3], cusps, found)
    save_figure(figure, out / "fig15.png")
    write_twins(out, "fig15", *(case.locus for case in (*loci, *locking[2.5])))
    return [
        found_cusps(loci),
        found_cusps(locking[2.5]),
        separates(loci),
        least_favourable(loci),
        least_favourable(locking[2.5]),
        _varies(found),
        _varies(locking),
        _counter_intuitive(found[0.5], loci, 0.01),
        _counter_intuitive(locking[0.5], locking[2.5], 0.05),
        _gravity_aids(cusps),
        *(_all_cases([c for loci in by_load.values() for c in loci]) for by_load in (found, locking)),
    ]


def _cusps(case: Case) -> mc.Branch:
    return whole(mc.continue_special(case.cusp, "gravity_angle", bounds=(-REACH, REACH)))


def _draw_cusps(ax: Any, cusps: Mapping[float, mc.Branch], found: Mapping[float, Sequence[Case]]) -> None:
    for (n, locus), color in zip(cusps.items(), COLORS[3:], strict=False):
        angle, force = np.degrees(locus["gravity_angle"]), locus["F_ul"]
        draw_curve(ax, angle, force, [("stable", 0, len(locus) - 1)], color=color)
        for case in found[n]:
            text = f"{n:g}" if case.degrees > 0 else ""
            mark(ax, case.degrees, case.cusp["F_ul"], "CP", text, color=color)
    ax.set(xlabel="gravity angle [deg]", ylabel=f"{readable('F_ul')} at the cusp [N]", xlim=np.degrees([-REACH, REACH]))
    set_panel_title(ax, "(d)  cusps at load factors 0.5, 1, 2.5")


def _varies(found: Mapping[float, Sequence[Case]]) -> Finding:
    shares = {n: 100 * spread([c.cusp["F_ul"] for c in loci]) for n, loci in found.items()}
    return Finding(
        "At 2.5 g the unlock force at the cusp varies significantly with the gravity angle, unlike at 0.5 g.",
        f"from -20 to +20 deg by {', '.join(f'{s:.1f} % at load factor {n:g}' for n, s in shares.items())}",
        shares[0.5] < 10.0 and 20.0 < shares[2.5] < 22.0,
        found[0.5][0].model,
    )


def _counter_intuitive(light: Sequence[Case], heavy: Sequence[Case], same: float) -> Finding:
    pairs = [(-a.cusp["F_ul"], -b.cusp["F_ul"]) for a, b in zip(light, heavy, strict=True)]
    change = [b / a - 1 for a, b in pairs]
    shown = [f"{c.name}: {b:.1f} N instead of {a:.1f} N ({100 * d:+.1f} %)"
             for c, (a, b), d in zip(light, pairs, change, strict=True)]
    return Finding(
        "At 0 and +20 deg the higher load needs less unlock force than 0.5 g does; at -20 deg about the same.",
        "; ".join(shown),
        abs(change[0]) < same and change[1] < -0.05 and change[2] < -0.05,
        light[0].model,
    )


def _gravity_aids(cusps: Mapping[float, mc.Branch]) -> Finding:
    force = {n: CubicSpline(locus["gravity_angle"], locus["F_ul"]) for n, locus in cusps.items()}

    def difference(angle: float) -> float:
        return float(force[2.5](angle) - force[0.5](angle))

    crossing = np.degrees(brentq(difference, *np.radians(ANGLES[::2])))
    descent = [f"{-force[n](-REACH):.1f} N at {n:g}" for n in (0.5, 2.5)]
    return Finding(
        "Gravity aids unlocking at positive and small negative gravity angles, and works against it at about -20 deg "
        "and below.",
        f"along the cusps followed in gravity angle, load lowers the unlock force above {crossing:.1f} deg and raises "
        f"it below ({', '.join(descent)} at -30 deg)",
        -25.0 < crossing < -15.0 and difference(0.0) > 0 > difference(-REACH),
        FIRST,
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
        loci[0].model,
    )


if __name__ == "__main__":
    run_script(main)
