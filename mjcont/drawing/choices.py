"""Pictures of designs: how far each parameter is changed, and the diagrams before and after."""

from __future__ import annotations

from typing import Any

import numpy as np

from mjcont.results.branch import Branch
from mjcont.results.choices.targets import Design
from mjcont.results.points import show


def draw_changes(found: Design, ax: Any) -> Any:
    """Draw every parameter's change in its scale, with its old and new value, and return the axes."""
    from mjcont.drawing.plotting import COLORS, new_figure

    names = list(found.parameters)
    axes = new_figure(1, 1, (5.6, 0.9 + 0.42 * len(names)))[1] if ax is None else ax
    changes = np.array([(found.parameters[n] - found.before[n]) / found.scales[n] for n in names])
    axes.barh(range(len(names)), changes, color=[COLORS[0] if c >= 0 else COLORS[1] for c in changes], height=0.6)
    axes.axvline(0.0, color="#333333", linewidth=0.8)
    units = [found.problem.parameters[n].unit for n in names]
    old, new = ([show(v[n], u, 4) for n, u in zip(names, units, strict=True)] for v in (found.before, found.parameters))
    axes.set_yticks(range(len(names)), [f"{n}: {a} to {b}" for n, a, b in zip(names, old, new, strict=True)])
    axes.invert_yaxis()
    axes.margins(x=0.1)
    axes.set_xlabel("change, in the parameter's scale")
    return axes


def draw_before_and_after(before: Branch, after: Branch, y: str, ax: Any) -> Any:
    """Draw the diagrams of both designs and return the axes."""
    from mjcont.drawing.plotting import plot

    x = next(iter(before.free))
    return plot(before, after, x=x, y=y, ax=ax)
