"""Figure 12: loci of the fold FP1 in both actuator forces at load factor 1.

F_ret against F_ul at FP1 for gravity angles of -20, 0 and +20 deg. (a) The first gear, nose_gear; stars: cusps. (b) The
cusp at 0 deg, magnified: beside it the locus turns a second time, where w . f_F_ret = 0 (w: left null vector). (c) The
gear that locks, nose_gear_locking: from FP1 without unlock force over its cusp, that turn, and the cusp at which it
meets FP2, to FP2 without unlock force.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from _gear import FIRST, LOCKING, Slice, angle_of, load_case
from _loci import (
    REFERENCE,
    Case,
    cases,
    found_cusps,
    least_favourable,
    loci_figure,
    separates,
    spread,
)

import mjcont as mc
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins

_LOCKED = ("stable", "unstable", "stable")


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear, second = (mc.Mechanism.from_xml(name) for name in (FIRST, LOCKING))
    loci, locking = cases(gear, 1.0), cases(second, 1.0)
    loci_figure(loci, locking, out / "fig12.png")
    write_twins(out, "fig12", *(case.locus for case in (*loci, *locking)))
    return [
        found_cusps(loci),
        found_cusps(locking),
        separates(loci),
        _slices(gear, loci),
        _apart(second, locking[1]),
        least_favourable(loci),
        least_favourable(locking),
        _spreads(loci, locking),
        _by_hand(loci[1]),
        _by_hand(locking[1]),
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
        FIRST,
    )


def _apart(gear: mc.Mechanism, case: Case, away: float = 0.1) -> Finding:
    turn, cusp = case.exchange["F_ul"], case.cusp["F_ul"]
    weak, between, strong = (
        Slice.of(gear, load_case(1.0, 0.0, force)).structure for force in (turn + away, cusp + away, cusp - away)
    )
    return Finding(
        "Unlock forces stronger than at the cusp arrange the equilibria as in figure 11 (b), weak ones as in (a): as "
        "F_ret rises, the curve below overcentre loses its stability, or the one above does.",
        f"so at 0 deg for forces stronger than {-cusp:.1f} N, and weaker than {-turn:.1f} N, where w . f_F_ret = 0. On "
        f"this gear these two points lie apart: for forces between them both curves lose their stability, and there "
        f"are rests near overcentre as well. Slices {away:g} N off the two points",
        weak == [("above", "stable", "unstable"), ("below", *_LOCKED)]
        and between == [("above", *_LOCKED), ("below", *_LOCKED, "unstable")]
        and strong == [("above", "stable"), ("below", *_LOCKED, "unstable")],
        LOCKING,
    )


def _spreads(loci: Sequence[Case], locking: Sequence[Case]) -> Finding:
    force, unlock = (100 * spread([c.cusp[n] for c in loci]) for n in ("F_ret", "F_ul"))
    other, small = (100 * spread([c.cusp[n] for c in locking]) for n in ("F_ret", "F_ul"))
    return Finding(
        "From -20 to +20 deg the retraction force at the cusp changes by almost 35 %, the unlock force by less than "
        "10 %.",
        f"{force:.1f} % and {unlock:.1f} % of the largest. Of the gear that locks {other:.1f} %, a little more than "
        f"35, and {small:.1f} %",
        33.0 < force < 35.0 and unlock < 10.0 and small < 10.0,
        FIRST,
    )


def _by_hand(case: Case) -> Finding:
    points = {"FP1": case.fold, "FP1 at -500 N": case.unlocked, "cusp": case.cusp}
    off = [(abs(points[n]["F_ret"] / f - 1), abs(points[n]["F_ul"] - u), abs(angle_of(points[n]) - a))
           for n, (u, f, a) in REFERENCE[case.model].items()]
    force, unlock, angle = (max(column) for column in zip(*off, strict=True))
    return Finding(
        "FP1 and the cusp at 0 deg agree with energies of the links and bushes written out by hand, solved without "
        "MuJoCo.",
        f"F_ret within {force:.0e} (relative), F_ul within {unlock:.0e} N, theta_ov within {angle:.0e} deg",
        force < 1e-7 and unlock < 5e-4 and angle < 1e-4,
        case.model,
    )


if __name__ == "__main__":
    run_script(main)
