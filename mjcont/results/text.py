"""Readable tables in plain text: of parameters, and what `mjcont inspect` prints."""

from __future__ import annotations

import math

from mjcont.results.quantities import Parameter


def table(rows: list[list[str]]) -> list[str]:
    """Return lines with aligned columns; the first row is the heading."""
    widths = [max(len(r[k]) for r in rows) for k in range(len(rows[0]))]
    return ["  " + "  ".join(c.ljust(w) for c, w in zip(r, widths, strict=True)).rstrip() for r in rows]


def number(value: float, unit: str) -> str:
    """Return a number as shown; angles in degrees."""
    if not math.isfinite(value):
        return "-" if value < 0 else "+"
    return f"{math.degrees(value) if unit == 'rad' else value:.6g}"


def unit_shown(unit: str) -> str:
    """Return the unit in which a number is shown."""
    return "deg" if unit == "rad" else unit


class ParameterTable(dict[str, Parameter]):
    """Parameters by name; printed, a table of values, bounds, what a change costs, and what each acts on."""

    def __str__(self) -> str:
        """Return the table."""
        rows = [["name", "value", "unit", "from", "to", "a change costs", "acts on"]]
        for p in self.values():
            cells = [number(v, p.unit) for v in (p.value, *p.bounds)]
            rows.append([p.name, cells[0], unit_shown(p.unit), cells[1], cells[2], p.cost, p.acts_on])
        return "\n".join(table(rows))

    __repr__ = __str__
