"""Readable text: tables of parameters, what `mjcont inspect` prints, and how results show themselves."""

from __future__ import annotations

import math
from html import escape

from mjcont.results.quantities import Parameter

_LONGEST = 160


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


class Shown:
    """A result whose repr is the first line of its summary; a notebook shows all of it, and completes its columns."""

    def __repr__(self) -> str:
        """Return the kind of result and the first line of its summary."""
        line = str(self).partition("\n")[0]
        return f"<{type(self).__name__} {line if len(line) <= _LONGEST else line[: _LONGEST - 3] + '...'}>"

    def _repr_html_(self) -> str:
        """Return the summary as a notebook shows it."""
        return f"<pre>{escape(str(self))}</pre>"

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names that [...] takes."""
        found: list[str] = []
        for each in ("columns", "fixed", "parameters", "observables"):
            found += [n for n in getattr(self, each, ()) if n not in found]
        return found
