"""Names beside the parts of a picture, where nothing else is drawn."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing import notes
from mjcont.drawing.axes import readable
from mjcont.drawing.picture import Force, Picture, Spring
from mjcont.drawing.shapes import Shape
from mjcont.drawing.sketch import FORCE, INK, arrow
from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.text import Annotation

Labels = bool | Collection[str] | Mapping[str, str]
KINDS = ("pins", "forces", "springs", "links")
_AROUND = np.arange(16) * np.pi / 8
_DIRECTIONS = np.column_stack([np.cos(_AROUND), np.sin(_AROUND)])
_ALONG = (0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75)  # of a link's length, best first
_GAPS = (3.0, 6.0, 10.0, 15.0, 22.0, 30.0, 40.0)  # in points, as are all costs
_FAR = 16.0  # a label further away than this has a line to its place
_CLEARANCE, _NEXT, _TOUCH, _CLASH = 4.0, 1.0, 30.0, 60.0


def write_labels(ax: Axes, shown: Picture, unit: float, labels: Labels, scale: float) -> None:
    """Write the names that are wanted; axes and figure must have their final size."""
    from matplotlib.patheffects import Stroke

    # letters of straight lines such as F lose one where lines snap to pixels
    halo = [Stroke(linewidth=2.0 * scale, foreground="white", snap=False), Stroke(linewidth=0.0, snap=False)]
    ink = notes.drawn_points(ax)[::2]
    taken = [_rectangle(t) for t in ax.texts if t.get_text()]
    written = set()
    for kind, name, places, color in _names(shown, unit):
        text = _wanted(labels, kind, name)
        if not text or (kind, text) in written:
            continue
        written.add((kind, text))
        size = (9.5 if kind == "pins" and len(text) < 3 else 8.0) * scale
        note = ax.annotate(text, (0.0, 0.0), (0.0, 0.0), textcoords="offset points", ha="center", va="center",
                           fontsize=size, color=color, zorder=5, path_effects=halo)
        note.set_label(f"_{kind}")
        _place(ax, note, places, ink, taken)
        taken.append(_rectangle(note))


def _wanted(labels: Labels, kind: str, name: str) -> str:
    """Return what to write for a name; nothing where it is not wanted."""
    if isinstance(labels, bool):
        return readable(name) if labels else ""
    if isinstance(labels, Mapping):
        return str(labels[name]) if name in labels else readable(name)
    unknown = [k for k in ([labels] if isinstance(labels, str) else labels) if k not in KINDS]
    if unknown:
        raise unknown_name("kind of label", str(unknown[0]), KINDS)
    return readable(name) if kind in labels else ""


# -- what may be named, and where ------------------------------------------------------------------------------


def _names(shown: Picture, unit: float) -> list[tuple[str, str, Array, Any]]:
    """Return kind, name, places (K, 2), best first, and colour; those with the fewest places come first."""
    names: list[tuple[str, str, Array, Any]] = [("pins", p.name, p.at[None], INK) for p in shown.pins]
    for name in dict.fromkeys(f.name for f in shown.forces):
        places = [_force_places(f, unit) for f in shown.forces if f.name == name]
        names.append(("forces", name, np.concatenate(places), FORCE))
    names += [("springs", s.name, _spring_places(s), s.color) for s in shown.springs if s.coil is not None]
    largest: dict[str, Shape] = {}
    for shape in shown.shapes:
        if not shape.ground and (shape.body not in largest or _length(shape) > _length(largest[shape.body])):
            largest[shape.body] = shape
    names += [("links", b, _shape_places(s), tuple(0.7 * np.array(s.color[:3]))) for b, s in largest.items()]
    return names


def _force_places(force: Force, unit: float) -> Array:
    corners = arrow(force, unit)
    if force.turn:
        return corners.mean(axis=0) + 0.5 * (corners[1] - corners[0]) * _DIRECTIONS
    return corners[::-1] if not force.into else corners


def _spring_places(spring: Spring) -> Array:
    start, end = spring.path[spring.coil or 0], spring.path[(spring.coil or 0) + 1]
    return np.array([start + t * (end - start) for t in _ALONG])


def _shape_places(shape: Shape) -> Array:
    """Return places on both sides of a long shape, or around another."""
    if len(shape.points) != 2:
        return shape.outline[:: max(1, len(shape.outline) // 16)]
    start, end = shape.points
    along = (end - start) / max(float(np.linalg.norm(end - start)), 1e-12)
    side = shape.radius * np.array([-along[1], along[0]])
    return np.array([start + t * (end - start) + s * side for t in _ALONG for s in (1.0, -1.0)])


def _length(shape: Shape) -> float:
    return float(np.ptp(shape.outline, axis=0).max())


# -- placing -------------------------------------------------------------------------------------------------


def _rectangle(text: Any) -> Array:
    box = text.get_window_extent()
    return np.array([box.min, box.max])


def _place(ax: Axes, note: Annotation, places: Array, ink: Array, taken: Sequence[Array]) -> None:
    """Move a label beside the best of its places; obstacles are points (N, 2) and rectangles, in pixels."""
    figure = ax.get_figure(root=True)
    point = (figure.dpi if figure is not None else 72.0) / 72.0
    half, space = 0.5 * np.ptp(_rectangle(note), axis=0), 2.0 * point
    gaps = np.repeat(_GAPS, len(_DIRECTIONS))
    directions = np.tile(_DIRECTIONS, (len(_GAPS), 1))
    offsets = directions * (gaps * point + np.abs(directions) @ half)[:, None]
    best: tuple[float, int, int] = (np.inf, 0, 0)
    for k, anchor in enumerate(ax.transData.transform(places)):
        low, high = anchor + offsets - half, anchor + offsets + half
        near = ink[np.all(np.abs(ink - anchor) < np.abs(offsets).max() + half + _CLEARANCE * point, axis=1)]
        apart = np.maximum(np.maximum(low[:, None] - near, near - high[:, None]), 0.0)
        away = np.hypot(*apart.T).T.min(axis=1, initial=np.inf) / point
        clashes = sum((np.all((low < t[1] + space) & (high > t[0] - space), axis=1) for t in taken), np.zeros(len(low)))
        outside = np.any((low < ax.bbox.min) | (high > ax.bbox.max), axis=1)
        cost = gaps + 3.0 * np.maximum(_CLEARANCE - away, 0.0) + _TOUCH * (away <= 0.0)
        cost += _CLASH * (clashes + outside) + _NEXT * k
        first = int(np.argmin(cost))
        if cost[first] < best[0] - 1e-9:
            best = (float(cost[first]), k, first)
    _, k, chosen = best
    note.xy = (float(places[k, 0]), float(places[k, 1]))
    note.set_position(tuple(offsets[chosen] / point))
    if gaps[chosen] > _FAR:
        line = {"arrowstyle": "-", "color": note.get_color(), "linewidth": 0.6, "shrinkA": 0.0, "shrinkB": 0.0}
        ax.annotate("", note.xy, tuple(directions[chosen] * (gaps[chosen] - 1.0)), textcoords="offset points",
                    arrowprops=line, zorder=4.9)
