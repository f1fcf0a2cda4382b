"""A `Picture` drawn into axes: links, pins, springs and forces.

Marks scale with the picture, so that a small inset looks like a large drawing; line widths are in points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.picture import Force, Picture, Pin, Spring
from mjcont.drawing.shapes import Color, Shape
from mjcont.numerics.equations.problem import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INK, GROUND, FORCE, BUSH = "#26282b", "#8d9196", "#b02a4a", "#b4bac1"
# in parts of the picture's longer side
_ARROW, _HEAD, _MOMENT = 0.14, 0.034, 0.055
# of the longer side, the shorter one at least
_SLIM = 0.4
_PIN, _COIL = 0.010, 0.017


def padded(shown: Picture, margin: float) -> Array:
    """Return the box of a picture and its arrows, with a margin in parts of its longer side, (2, 2).

    A single rod would be a strip: the shorter side is some part of the longer one at least.
    """
    box = shown.box
    size = max(float((box[1] - box[0]).max()), 1e-9)
    every = np.concatenate([box, *(arrow(f, size) for f in shown.forces)])
    low, high = every.min(axis=0) - margin * size, every.max(axis=0) + margin * size
    short = np.maximum(_SLIM * (high - low).max() - (high - low), 0.0)
    return np.array([low - 0.5 * short, high + 0.5 * short])


def arrow(force: Force, unit: float) -> Array:
    """Return tail and tip of a force's arrow, (2, 2); the corners of the circle of a moment."""
    if force.turn:
        return force.at + _MOMENT * unit * np.array([[-1.0, -1.0], [1.0, 1.0]])
    tail = force.at - (_ARROW * unit * force.direction if force.into else 0.0)
    return np.array([tail, tail + _ARROW * unit * force.direction])


def render(ax: Axes, shown: Picture, box: Array, unit: float, *, color: Any = None, scale: float = 1.0) -> None:
    """Draw a picture; `box` (2, 2) is what the axes show, marks have their size at a longer side of `unit`.

    In one colour, a pose stands behind another: it has no forces.
    """
    from matplotlib.colors import to_rgba

    ink: Any = INK
    if color is not None:
        color = to_rgba(color)
        ink = _dark(color)
        springs = [replace(s, color=ink) for s in shown.springs]
        shown = replace(shown, springs=springs, forces=[])
    for k, shape in enumerate(shown.shapes):
        _draw_shape(ax, shape, color, scale, 2.0 + 0.5 * k / len(shown.shapes))
    for spring in shown.springs:
        _draw_spring(ax, spring, unit, scale)
    for pin in shown.pins:
        _draw_pin(ax, pin, unit, scale, ink)
        if _needs_support(pin, shown.shapes, unit):
            _draw_support(ax, pin, unit, scale)
    for force in shown.forces:
        _draw_force(ax, force, unit, scale)
    ax.set_aspect("equal")
    ax.axis("off")
    ax.margins(0.0)
    ax.update_datalim(box)
    ax.autoscale_view()


def _dark(color: Color) -> Color:
    return (*(0.55 * c for c in color[:3]), color[3])


def _trace(ax: Axes, path: Array) -> None:
    """Add a line that is not seen, from which labels keep away."""
    ax.plot(*path.T, linestyle="none", label="ink")


def _draw_shape(ax: Axes, shape: Shape, color: Any, scale: float, zorder: float) -> None:
    from matplotlib.patches import Polygon

    face = shape.color if color is None else color
    style: dict[str, Any] = {"facecolor": face, "edgecolor": _dark(face)}
    if shape.ground and len(shape.points) > 1:
        style = {"facecolor": "#ececec", "edgecolor": GROUND, "hatch": "/////"}
    outline = shape.outline
    ax.add_patch(Polygon(outline, closed=True, linewidth=0.7 * scale, zorder=zorder, joinstyle="round", **style))
    middle = outline.mean(axis=0)
    _trace(ax, np.concatenate([middle + part * (outline - middle) for part in (1.0, 0.6, 0.2)]))


def _draw_spring(ax: Axes, spring: Spring, unit: float, scale: float) -> None:
    path = spring.path if spring.coil is None else _coiled(spring.path, spring.coil, _COIL * unit)
    style: dict[str, Any] = {"color": spring.color, "zorder": 2.6}
    width = (0.9 if spring.coil is None else 1.3) * scale
    ax.plot(*path.T, linewidth=width, label="_spring", solid_joinstyle="miter", **style)
    ax.plot(*path[[0, -1]].T, marker="o", markersize=3.0 * scale, linestyle="none", label="_ends", **style)


def _coiled(path: Array, leg: int, half: float) -> Array:
    """Return the path with one leg as a zig-zag of a fixed number of coils, which are closer the shorter it is."""
    start, end = path[leg], path[leg + 1]
    length = max(float(np.linalg.norm(end - start)), 1e-12)
    along = (end - start) / length
    count = 12
    lead = min(max(0.15 * length, 0.5 * (length - 1.2 * count * half)), 0.35 * length)
    where = lead + (length - 2.0 * lead) * np.array([0.0, *((np.arange(count) + 0.5) / count), 1.0])
    side = half * np.array([0.0, *((-1.0) ** np.arange(count)), 0.0])
    coil = start + where[:, None] * along + side[:, None] * np.array([-along[1], along[0]])
    return np.concatenate([path[: leg + 1], coil, path[leg + 1 :]])


def _draw_pin(ax: Axes, pin: Pin, unit: float, scale: float, ink: Any) -> None:
    from matplotlib.patches import Circle

    radius = _PIN * unit
    style: dict[str, Any] = {"facecolor": "white", "edgecolor": ink, "linewidth": 0.9 * scale}
    if pin.elastic:
        if np.linalg.norm(pin.other - pin.at) > 2.0 * radius:
            gap = np.array([pin.at, pin.other])
            ax.plot(*gap.T, color=ink, linewidth=0.9 * scale, linestyle=":", zorder=2.65, label="_gap")
            ax.add_patch(Circle(tuple(pin.other), 0.7 * radius, zorder=2.66, **style))
        ax.add_patch(Circle(tuple(pin.at), 1.9 * radius, zorder=2.67, **{**style, "facecolor": BUSH}))
    ax.add_patch(Circle(tuple(pin.at), radius, zorder=2.7, **style))
    _trace(ax, pin.at + 1.5 * radius * np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, -1.0]]))


def _needs_support(pin: Pin, shapes: Sequence[Shape], unit: float) -> bool:
    """Whether a pin on the ground stands where the model shows no ground."""
    near = 2.0 * _PIN * unit
    grounds = [s.outline for s in shapes if s.ground and len(s.points) > 1]
    held = any(np.all((g.min(axis=0) - near < pin.at) & (pin.at < g.max(axis=0) + near)) for g in grounds)
    return pin.fixed and not held


def _draw_support(ax: Axes, pin: Pin, unit: float, scale: float) -> None:
    """Draw a foot on hatched ground below a pin."""
    from matplotlib.patches import Polygon

    at, size = pin.at, _PIN * unit
    foot = at + size * np.array([[-2.2, -3.6], [0.0, 0.0], [2.2, -3.6]])
    ground = at + size * np.array([[-3.4, -3.6], [3.4, -3.6], [3.4, -5.2], [-3.4, -5.2]])
    ax.add_patch(Polygon(ground, facecolor="none", edgecolor=GROUND, hatch="/////", linewidth=0.0, zorder=2.6))
    ax.add_patch(Polygon(foot, facecolor="white", edgecolor=INK, linewidth=0.9 * scale, zorder=2.6, joinstyle="round"))
    ax.plot(*ground[:2].T, color=INK, linewidth=0.9 * scale, zorder=2.61, label="_support")
    _trace(ax, np.concatenate([foot, ground]))


def _draw_force(ax: Axes, force: Force, unit: float, scale: float) -> None:
    from matplotlib.patches import Polygon

    size = _HEAD * unit
    if force.turn:
        turn = np.radians(np.linspace(-50.0, 230.0, 41))[:: force.turn]
        path = force.at + _MOMENT * unit * np.column_stack([np.cos(turn), np.sin(turn)])
        direction = force.turn * np.array([-np.sin(turn[-1]), np.cos(turn[-1])])
        tip = path[-1] + 0.5 * size * direction
    else:
        path, direction = arrow(force, unit), force.direction
        tip = path[1].copy()
        path[1] -= 0.8 * size * direction
    back, across = tip - size * direction, 0.35 * size * np.array([-direction[1], direction[0]])
    head = np.array([tip, back + across, back - across])
    ax.plot(*path.T, color=FORCE, linewidth=1.7 * scale, zorder=2.8, label="_force", solid_capstyle="butt")
    ax.add_patch(Polygon(head, facecolor=FORCE, edgecolor="none", zorder=2.8))
    _trace(ax, head)
