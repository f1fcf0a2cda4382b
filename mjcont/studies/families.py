"""The table of a study on nonlinear modes: `[[nonlinear_modes]]`."""

from __future__ import annotations

from typing import Any

from mjcont.errors import unknown_name
from mjcont.studies import forms as f
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.keys import Context, Key, Kind, takes
from mjcont.studies.orbits import FAMILY, POSED, RESULT, orbit_settings
from mjcont.studies.schema import Table

# what a family may be followed in, with its unit
VARIES = {"energy": "J", "frequency": "Hz"}


@takes(f.choice(*VARIES))
def _parameter(table: Table, key: str, context: Context) -> str:
    del context
    name = table.text(key)
    if name not in VARIES:
        raise table.error(key, unknown_name("parameter of modes", name, VARIES))
    return name


@takes(f.PAIR)
def _bounds(table: Table, key: str, context: Context) -> tuple[float, float]:
    del context
    low, high = v.pair(table, key, VARIES.get(str(table.data.get("parameter", "energy")), "J"))
    if not low > 0.0:
        raise table.error(key, f"energies and frequencies are positive, got {low:g}")
    return low, high


@takes({"type": "array", "items": f.whole(3)})
def _resonances(table: Table, key: str, context: Context) -> tuple[int, ...]:
    del context
    given = table.data[key]
    if not isinstance(given, list) or not all(isinstance(n, int) and not isinstance(n, bool) and n > 2 for n in given):
        raise table.error(key, "expected a list of whole numbers of three or more, such as [3, 4]")
    return tuple(given)


def _check(found: dict[str, Any], table: Table, context: Context) -> None:
    if found["point"] is None:
        if found["bounds"] is None:
            raise table.error("bounds", f"this key is missing: the range of the {found['parameter'] or 'energy'}")
        found["start"] = {**context.common, **found["start"]}
        return
    for key in (*POSED, "mode"):
        if key in table.data:
            raise table.error(key, "'point' says where it starts: leave this key out")


NONLINEAR = Kind("nonlinear_modes", "Large motions without damping, one family for each mode (`continue_modes`).", {
    "name": RESULT,
    "mode": Key(v.whole(1), "Which of the modes that swing, the slowest first.", 1),
    "parameter": Key(_parameter, "What varies: `\"energy\"` or `\"frequency\"`.", "energy"),
    "bounds": Key(_bounds, "`[low, high]`, in J or Hz.", otherwise="needed, but for a point"),
    "point": Key(r.reference(FAMILY), "A BPC, PD, IR or another orbit of earlier nonlinear modes at which it begins.",
                 otherwise="rest at the start"),
    **POSED,
    "resonances": Key(_resonances, "Periods of the orbits that begin at internal resonances which are located.", (3, 4),
                      otherwise="`[3, 4]`"),
    "csv": Key(v.flag, "Whether to write NAME.csv: a row an orbit, angles in degrees.", False),
    "settings": orbit_settings(),
}, _check)
