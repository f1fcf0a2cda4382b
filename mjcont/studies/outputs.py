"""Files of a study's results: what has no format of its own goes into CSV, SI and radians, and into pictures."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mjcont.outside.csvfiles import write_table
from mjcont.results.model import units

if TYPE_CHECKING:
    from mjcont.results.barriers import BarrierCurve
    from mjcont.results.certificates import Certificate
    from mjcont.results.histories import History
    from mjcont.results.maps import SpecialMap, WorstCase
    from mjcont.results.search import Equilibria


def _heads(names: Iterable[str], unit_of: dict[str, str]) -> list[str]:
    return [f"{n} [{unit_of[n]}]" if unit_of.get(n, "") not in ("", "1") else n for n in names]


def equilibria_csv(found: Equilibria, problem: Any, path: Path) -> Path:
    """Write a row an equilibrium: label, stability, energy, parameters, observables, state."""
    states = [f"state {n} [{u}]" if u not in ("", "1") else f"state {n}" for n, u in problem.state_labels]
    head = ["label", "mirror of", "stability", "unstable", "hits", "energy [J]"]
    head += [*_heads([*problem.parameters, *problem.observables], units(problem)), *states]
    rows = [
        [p.label, p.mirror_of, p.stability, p.n_unstable, p.hits, float(p.energy),
         *(float(p[n]) for n in (*problem.parameters, *problem.observables)), *(float(v) for v in p.state)]
        for p in found
    ]
    return write_table(path, head, rows)


def worst_case_csv(found: WorstCase, path: Path) -> Path:
    """Write a row an improvement, the last of them the extreme."""
    names = list(dict.fromkeys([*found.parameters, found.quantity]))
    last = {**found.parameters, found.quantity: found.value}
    rows = [*found.path, *([last] if not found.path or dict(found.path[-1]) != last else [])]
    return write_table(path, _heads(names, units(found.point.model)), [[float(r[n]) for n in names] for r in rows])


def map_csv(found: SpecialMap, path: Path) -> Path:
    """Write a row a node: the grid's parameters, the point's own, observables, and why it is not there."""
    names = [*(n for n in found.point.free if n not in found.axes), *found.point.observables]
    head = [*_heads([*found.axes, *names], units(found.point.model)), "message"]
    columns = [found[n] for n in names]
    rows = []
    for node in itertools.product(*(range(len(a)) for a in found.axes.values())):
        at = [float(a[i]) for a, i in zip(found.axes.values(), node, strict=True)]
        rows.append([*at, *(float(c[node]) for c in columns), str(found.messages[node])])
    return write_table(path, head, rows)


def certificate_csv(found: Certificate, path: Path) -> Path:
    """Write a row a point that was checked."""
    names = list(found.units)
    head = ["row", "label", *_heads(names, dict(found.units)), "stability", "Re s [1/s]", "Im s [1/s]", "rate [1/s]",
            "time [s]", "verdict", "sentence"]
    rows = [[c.index, c.label, *(float(c.parameters[n]) for n in names), c.stability, c.eigenvalue.real,
             c.eigenvalue.imag, float(c.rate), float(c.time), c.verdict, c.sentence] for c in found]
    return write_table(path, head, rows)


def barrier_csv(found: BarrierCurve, path: Path) -> Path:
    """Write a row a rest: the parameter, the barrier, and where the pass comes from."""
    head = ["row", *_heads([found.name], {found.name: found.unit}), "energy [J]", "message"]
    rows = [[int(r), float(v), float(e), b.message]
            for r, v, e, b in zip(found.rows, found.values, found.energy, found.barriers, strict=True)]
    return write_table(path, head, rows)


def draw_history(history: History, columns: Sequence[str], path: Path) -> Path:
    """Draw columns of a history against time, one below the other."""
    import numpy as np

    from mjcont.drawing.axes import axis_label, scaled
    from mjcont.drawing.plotting import COLORS, new_figure, save_figure

    figure, axes = new_figure(len(columns), 1, (5.2, 0.9 + 1.7 * len(columns)), sharex=True, squeeze=False)
    for i, (ax, name) in enumerate(zip(axes[:, 0], columns, strict=True)):
        unit = history.unit(name)
        ax.plot(history["time"], scaled(np.asarray(history[name]), unit), color=COLORS[i % len(COLORS)])
        ax.set_ylabel(axis_label(name, unit))
    axes[-1, 0].set_xlabel("time [s]")
    return save_figure(figure, path)
