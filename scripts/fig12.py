"""Figure 12: loci of the fold FP1 in both actuator forces at load factor 1.

F_ret against F_ul at FP1 for gravity angles of -20, 0 and +20 deg. (a) Stars: cusps. (b) The cusp at 0 deg,
magnified: beside it the locus turns a second time, where w . f_F_ret = 0 (w: left null vector).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from _gear import (
    REFERENCE,
    Case,
    Slice,
    angle_of,
    cases,
    found_cusps,
    least_favourable,
    load_case,
    loci_figure,
    separates,
    spread,
)

import mjcont as mc
from mjcont.paper.reproduce import Finding, run_script


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear")
    loci = cases(gear, 1.0)
    loci_figure(gear, loci, out / "fig12.png")
    return [
        found_cusps(loci),
        separates(loci),
        _slices(gear, loci),
        least_favourable(loci),
        _spreads(loci),
        _by_hand(loci[1]),
    ]


def _slices(gear: mc.Mechanism, loci: Sequence[Case], away: float = 0.1) -> Finding:
    weaker, stronger = (
        [Slice.of(gear, load_case(1.0, c.degrees, c.cusp["F_ul"] + sign * away)).structure for c in loci]
        for sign in (1.0, -1.0)
    )
    return Finding(
        "On the two sides of the cusp the equilibria are arranged as in figure 11 (a) and (b): as F_ret rises, the "
        "curve above overcentre loses its stability, or the one below does.",
        f"so in slices with unlock forces {away:g} N weaker and {away:g} N stronger than at the cusps",
        all(s == [("above", "stable", "unstable"), ("below", "stable")] for s in weaker)
        and all(s == [("above", "stable"), ("below", "stable", "unstable")] for s in stronger),
    )


def _spreads(loci: Sequence[Case]) -> Finding:
    force, unlock = (100 * spread([c.cusp[n] for c in loci]) for n in ("F_ret", "F_ul"))
    return Finding(
        "From -20 to +20 deg the retraction force at the cusp changes by almost 35 %, the unlock force by less than "
        "10 %.",
        f"{force:.1f} % and {unlock:.1f} % of the largest",
        33.0 < force < 35.0 and unlock < 10.0,
    )


def _by_hand(case: Case) -> Finding:
    points = {"FP1": case.fold, "FP1 at -500 N": case.unlocked, "cusp": case.cusp}
    off = [(abs(points[n]["F_ret"] / f - 1), abs(points[n]["F_ul"] - u), abs(angle_of(points[n]) - a))
           for n, (u, f, a) in REFERENCE.items()]
    force, unlock, angle = (max(column) for column in zip(*off, strict=True))
    return Finding(
        "FP1 and the cusp at 0 deg agree with energies of the links and bushes written out by hand, solved without "
        "MuJoCo.",
        f"F_ret within {force:.0e} (relative), F_ul within {unlock:.0e} N, theta_ov within {angle:.0e} deg",
        force < 1e-7 and unlock < 5e-4 and angle < 1e-4,
    )


if __name__ == "__main__":
    run_script(main)
