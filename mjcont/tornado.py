"""Sensitivities shown: a table, a CSV file, a tornado chart."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont import csvfiles
from mjcont.branch import KIND_NAMES, SpecialPoint, show
from mjcont.errors import ParameterError
from mjcont.escapes import for_picture

if TYPE_CHECKING:
    from mjcont.adjoint import Sensitivities

_SEEN = 1e-4  # of the widest bar
_MORE, _LESS = "#1b4f8a", "#c4541a"


def table(s: Sensitivities) -> str:
    """Return the sensitivities as text, the most influential parameter first."""
    heads = ["parameter", "value", "tolerance"]
    for name in s.quantities:
        heads += [f"d {name}", "elasticity", "change"]
    rows = [heads]
    for name in s.ordered():
        i, unit = s.parameters.index(name), s.units[name]
        row = [name, show(s.values[name], unit, 6), "+-" + show(s.tolerances[name], unit, 3)]
        for j, quantity in enumerate(s.quantities):
            row += [_slope(s, i, j), _ratio(s.elasticities[i, j]), _signed(s.changes[i, j], s.units[quantity])]
        rows.append(row)
    widths = [max(len(r[c]) for r in rows) for c in range(len(heads))]
    lines = [headline(s)]
    for row in rows:
        lines.append(("  " + "  ".join([row[0].ljust(widths[0]), *(
            text.rjust(w) for text, w in zip(row[1:], widths[1:], strict=True))])).rstrip())
    return "\n".join([*lines, *(f"  note: {n}" for n in s.notes)])


def headline(s: Sensitivities) -> str:
    """Return what the derivatives are of."""
    p = s.point
    name = f"{p.label} ({KIND_NAMES.get(p.kind, p.kind)})" if isinstance(p, SpecialPoint) and p.kind else "equilibrium"
    shown = ", ".join(f"{q} = {show(s.values[q], s.units[q])}" for q in s.quantities)
    return f"{name} of {p.problem.name}: {shown}; {s.evaluations} evaluations"


def _slope(s: Sensitivities, i: int, j: int) -> str:
    """Return a derivative with its unit, per degree and in degrees for angles."""
    top, bottom = s.units[s.quantities[j]], s.units[s.parameters[i]]
    value = float(s.derivatives[i, j])
    value *= (math.degrees(1.0) if top == "rad" else 1.0) * (math.radians(1.0) if bottom == "rad" else 1.0)
    return f"{value:.6g} {per(top, bottom)}".rstrip()


def per(top: str, bottom: str) -> str:
    """Return the unit of a derivative as it is shown, degrees for radians: "N/kg", "N/(N/m)", "1/m"."""
    top, bottom = ("deg" if u == "rad" else u for u in (top, bottom))
    if bottom in ("", "1"):
        return "" if top == "1" else top
    return f"{top or '1'}/{f'({bottom})' if any(c in bottom for c in '/* ') else bottom}"


def _ratio(value: float) -> str:
    return f"{value:+.4g}" if math.isfinite(value) else "-"


def _signed(value: float, unit: str) -> str:
    text = show(abs(value), unit, 4)
    return text if value == 0 or not math.isfinite(value) else f"{'-' if value < 0 else '+'}{text}"


def write_table(s: Sensitivities, path: str | Path) -> Path:
    """Write sensitivities as CSV, SI and radians, a row a parameter."""
    head = ["parameter", "unit", "value", "tolerance"]
    for name in s.quantities:
        unit = s.units[name] or "1"
        head += [f"d {name} [{unit} / unit]", f"elasticity of {name}", f"change of {name} [{unit}]"]
    rows: list[list[Any]] = []
    for i, name in enumerate(s.parameters):
        rows.append([name, s.units[name] or "1", float(s.values[name]), float(s.tolerances[name])])
        for j in range(len(s.quantities)):
            rows[-1] += [float(a[i, j]) for a in (s.derivatives, s.elasticities, s.changes)]
    return csvfiles.write_table(path, head, rows)


def draw_tornado(s: Sensitivities, quantity: str, most: int, ax: Any) -> Any:
    """Draw a bar for each parameter from the change at minus its tolerance to that at plus, the widest on top."""
    from mjcont.plotting import new_figure

    if most < 1:
        raise ParameterError(f"most must be at least 1, got {most}")
    j = s.quantities.index(quantity)
    size = np.nan_to_num(np.abs(s.changes[:, j]))
    names = [n for n in s.ordered(quantity) if size[s.parameters.index(n)] > _SEEN * size.max(initial=0.0)][:most]
    unit = "deg" if s.units[quantity] == "rad" else s.units[quantity]
    factor = math.degrees(1.0) if s.units[quantity] == "rad" else 1.0
    axes = ax if ax is not None else new_figure(size=(6.2, 1.3 + 0.27 * max(len(names), 3)))[1]
    at = np.arange(len(names))[::-1]
    change = factor * np.array([s.changes[s.parameters.index(n), j] for n in names])
    axes.barh(at, change, height=0.62, color=_MORE, label="parameter up")
    axes.barh(at, -change, height=0.62, color=_LESS, hatch="////", edgecolor="white", linewidth=0.0,
              label="parameter down")
    axes.axvline(0.0, color="#333333", linewidth=0.8)
    labels = [f"{for_picture(n)}  \u00b1{show(s.tolerances[n], s.units[n], 3)}" for n in names]
    axes.set_yticks(at, labels)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel(f"change of {for_picture(quantity)}" + (f" [{unit}]" if unit not in ("", "1") else ""))
    rest = len(s.parameters) - len(names)
    title = f"{for_picture(quantity)} = {show(s.values[quantity], s.units[quantity], 6)}"
    axes.set_title(title + (f"   ({rest} more move it less or not)" if rest else ""), loc="left", fontsize=9.5)
    if names:
        axes.legend(loc="lower right", frameon=True, framealpha=0.9, edgecolor="none")
    return axes
