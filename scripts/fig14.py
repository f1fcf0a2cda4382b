"""Figure 14: loci of the fold FP1 in both actuator forces at load factor 0.5.

F_ret against F_ul at FP1 for gravity angles of -20, 0 and +20 deg. (a) Stars: cusps. (b) The cusp at 0 deg,
magnified: beside it the locus turns a second time, where w . f_F_ret = 0 (w: left null vector).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from _gear import Case, cases, found_cusps, least_favourable, loci_figure, separates, spread

import mjcont as mc
from mjcont.paper.reproduce import Finding, run_script


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    gear = mc.Mechanism.from_xml("nose_gear")
    loci, level = cases(gear, 0.5), cases(gear, 1.0)
    loci_figure(gear, loci, out / "fig14.png")
    return [found_cusps(loci), separates(loci), least_favourable(loci), _proportional(loci, level)]


def _proportional(loci: Sequence[Case], level: Sequence[Case]) -> Finding:
    force, full = (100 * spread([c.cusp["F_ret"] for c in cs]) for cs in (loci, level))
    unlock, full_unlock = (100 * spread([c.cusp["F_ul"] for c in cs]) for cs in (loci, level))
    return Finding(
        "In proportion the gravity angle changes the loci as at load factor 1, the unlock force at the cusp slightly.",
        f"between -20 and +20 deg F_ret at the cusp differs by {force:.1f} % ({full:.1f} % at load factor 1), the "
        f"unlock force by {unlock:.1f} % ({full_unlock:.1f} %)",
        abs(force - full) < 1.0 and unlock < 10.0 and full_unlock < 10.0,
    )


if __name__ == "__main__":
    run_script(main)
