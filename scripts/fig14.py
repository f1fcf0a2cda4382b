"""Figure 14: loci of the fold FP1 in both actuator forces at load factor 0.5.

F_ret against F_ul at FP1 for gravity angles of -20, 0 and +20 deg, panels as in figure 12: (a) the first gear, (b) its
cusp at 0 deg, magnified, (c) the gear that locks.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from _gear import FIRST, LOCKING
from _loci import Case, cases, found_cusps, least_favourable, loci_figure, separates, spread

import mjcont as mc
from mjcont.paper.reproduce import Finding, run_script
from mjcont.paper.twins import write_twins


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    (loci, level), (locking, level_locking) = (
        [cases(mc.Mechanism.from_xml(name), n) for n in (0.5, 1.0)] for name in (FIRST, LOCKING)
    )
    loci_figure(loci, locking, out / "fig14.png")
    write_twins(out, "fig14", *(case.locus for case in (*loci, *locking)))
    return [
        found_cusps(loci),
        found_cusps(locking),
        separates(loci),
        least_favourable(loci),
        least_favourable(locking),
        _proportional(loci, level),
        _proportional(locking, level_locking),
    ]


def _proportional(loci: Sequence[Case], level: Sequence[Case]) -> Finding:
    force, full = (100 * spread([c.cusp["F_ret"] for c in cs]) for cs in (loci, level))
    unlock, full_unlock = (100 * spread([c.cusp["F_ul"] for c in cs]) for cs in (loci, level))
    return Finding(
        "In proportion the gravity angle changes the loci as at load factor 1, the unlock force at the cusp slightly.",
        f"between -20 and +20 deg F_ret at the cusp differs by {force:.1f} % ({full:.1f} % at load factor 1), the "
        f"unlock force by {unlock:.1f} % ({full_unlock:.1f} %)",
        abs(force - full) < 1.0 and unlock < 10.0 and full_unlock < 10.0,
        loci[0].model,
    )


if __name__ == "__main__":
    run_script(main)
