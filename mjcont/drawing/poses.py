"""Poses of planar mechanisms in matplotlib: one, several side by side, or small ones beside a diagram's points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.arguments import checked
from mjcont.drawing import notes, plotting
from mjcont.drawing.labels import Labels, write_labels
from mjcont.drawing.picture import Picture, Pose, picture
from mjcont.drawing.sketch import padded, render
from mjcont.errors import MjcontError, unknown_name
from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.problem import Array
from mjcont.results.branch import Branch
from mjcont.results.points import Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARGIN, _TIGHT = 0.06, 0.025  # around a picture, with and without room for labels, in parts of its longer side
_TITLE = 11.0  # height of an inset's title, in points


@checked
def draw(
    mechanism: Mechanism,
    pose: Pose = None,
    ax: Axes | None = None,
    *,
    labels: Labels = True,
    plane: str | None = None,
    inputs: Mapping[str, float] | None = None,
    color: Any = None,
    scale: float = 1.0,
) -> Axes:
    """Draw a planar mechanism at a pose: links, pins, springs and forces, in the colours of its XML.

    A white circle is a rigid pin, one in a grey ring a bush; hatched shapes are fixed to the ground. Arrows show
    directions of forces, not sizes.

    Parameters
    ----------
    mechanism : Mechanism
    pose : Point, (nq,) array, keyframe name or None
        A point brings its parameters; None is the model's initial pose.
    ax : matplotlib Axes, optional
        Where to draw, on top of what is there; default a new figure, which is `draw(...).figure`.
    labels : bool, collection or mapping
        What to name: all, nothing, some of "pins", "forces", "springs" and "links"; a mapping such as
        `{"theta_1": "D"}` renames, and leaves out what it maps to "".
    plane : str, optional
        The horizontal and the vertical axis, such as "xz" or "-xz"; default from the model's joints.
    inputs : mapping of parameter to value, optional
        Values that decide which way the forces point. A force of unknown size points in its positive direction; one
        that is known to be zero, as at a point, is left out.
    color : matplotlib colour, optional
        One colour for links, springs and pins, without forces: a pose in the background, drawn first.
    scale : float
        Factor on text and line widths.

    Raises
    ------
    MjcontError
        If the model does not move in a plane, or not in the one given.
    """
    shown = picture(mechanism, pose, plane=plane, inputs=inputs)
    box = padded(shown, _MARGIN if labels else _TIGHT)
    if ax is None:
        width, height = _fitted(box, 5.0)
        _, ax = plotting.new_figure(size=(width, height))
    render(ax, shown, box, _size(box), color=color, scale=scale)
    _settle(ax)
    write_labels(ax, shown, _size(box), labels, scale)
    return ax


@checked
def draw_poses(
    mechanism: Mechanism,
    poses: Mapping[str, Pose],
    *,
    axes: Sequence[Axes] | None = None,
    window: tuple[tuple[float, float], tuple[float, float]] | None = None,
    cols: int = 4,
    labels: Labels = ("pins", "forces"),
    plane: str | None = None,
    size: float = 2.3,
) -> Figure:
    """Draw several poses side by side, to one scale, each with its title.

    Parameters
    ----------
    mechanism : Mechanism
    poses : mapping of title to Point, (nq,) array or keyframe name
    axes : sequence of matplotlib Axes, optional
        Where to draw, one a pose, so that a figure may show several mechanisms; default a new figure.
    window : ((low, low), (high, high)), optional
        The part of the plane that is shown, in m; default all of every pose.
    cols : int
        Poses a row, in a new figure.
    labels, plane
        As for `draw`.
    size : float
        Longer side of a pose in inches, in a new figure.

    Raises
    ------
    MjcontError
        If there is no pose or there are too few axes, or the model does not move in a plane.
    """
    if not poses:
        raise MjcontError("draw_poses needs at least one pose")
    shown = [picture(mechanism, pose, plane=plane) for pose in poses.values()]
    boxes = np.array([padded(s, _MARGIN if labels else _TIGHT) for s in shown])
    box = np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]) if window is None else np.array(window)
    if axes is None:
        cols = max(1, min(cols, len(shown)))
        rows = -(-len(shown) // cols)
        width, height = _fitted(box, size)
        grid = plotting.new_figure(rows, cols, (cols * width, rows * (height + 0.3)), squeeze=False)[1]
        axes = list(grid.flat)
    if len(axes) < len(shown):
        raise MjcontError(f"draw_poses needs an axes for each of {len(shown)} poses, got {len(axes)}")
    for ax in axes[len(shown) :]:
        ax.axis("off")
    for ax, title, pose in zip(axes, poses, shown, strict=False):
        plotting.set_panel_title(ax, title)
        render(ax, pose, box, _size(box), scale=0.85)
        if window is not None:
            ax.set(xlim=box[:, 0], ylim=box[:, 1])
    figure: Any = axes[0].get_figure(root=True)
    figure.draw_without_rendering()
    for ax, pose in zip(axes, shown, strict=False):
        write_labels(ax, pose, _size(box), labels, 0.85)
    return figure


@checked
def add_poses(
    ax: Axes,
    points: Branch | Mapping[str, Point],
    labels: Sequence[str] | Mapping[str, str] | None = None,
    *,
    x: str,
    y: str,
    size: float = 0.2,
    degrees: bool = True,
    plane: str | None = None,
) -> list[Axes]:
    """Draw small poses into a diagram, where it is empty, each with a line to its point.

    Points outside the diagram's limits are left out.

    Parameters
    ----------
    ax : matplotlib Axes
        A diagram, as `plot` returns it; set its limits before.
    points : Branch, or mapping of title to Point
    labels : sequence of str, or mapping of str to str
        Labels of a branch's special points, or titles of the mapping; default all. A mapping such as
        `{"LP1": "FP2"}` gives them other titles.
    x, y : str
        What the diagram's axes show: parameters or observables.
    size : float
        Longer side of a pose, as a fraction of the diagram's width.
    degrees : bool
        Whether the diagram shows angles in degrees.
    plane
        As for `draw`.

    Returns
    -------
    list of Axes
        Those of the poses.

    Raises
    ------
    NameLookupError
        If there is no point of that label, or a point has no such parameter or observable.
    MjcontError
        If a point belongs to no mechanism, or its mechanism does not move in a plane.
    """
    chosen = _chosen(points, labels)
    shown = [picture(mechanism_of(p), p, plane=plane) for p in chosen.values()]
    places = [(_coordinate(p, x, degrees), _coordinate(p, y, degrees)) for p in chosen.values()]
    _settle(ax)
    boxes = [padded(s, _TIGHT) for s in shown]
    unit = max((_size(b) for b in boxes), default=1.0)
    extents = [size * ax.bbox.width / unit * (b[1] - b[0]) for b in boxes]
    visible = [k for k, place in enumerate(places) if ax.bbox.contains(*ax.transData.transform(place))]
    insets = {}
    # those with a good place at hand first, so that no other takes it
    for k in sorted(visible, key=lambda k: _empty_place(ax, places[k], extents[k])[1]):
        insets[k] = _free_axes(ax, list(chosen)[k], places[k], shown[k], extents[k], boxes[k])
        render(insets[k], shown[k], boxes[k], unit, scale=0.6)
    notes.place_labels(ax)
    return [insets[k] for k in visible]


def _settle(ax: Axes) -> None:
    """Give the axes the size and the limits that they will be drawn with."""
    figure = ax.get_figure(root=True)
    if figure is not None:
        figure.draw_without_rendering()


def _free_axes(ax: Axes, title: str, place: tuple[float, float], pose: Picture, extent: Array, box: Array) -> Axes:
    """Return new axes for a pose that takes `extent` pixels and shows `box`, with a line to its point."""
    anchor = ax.transData.transform(place)
    low, _ = _empty_place(ax, place, extent)
    drawn = low + extent * (np.concatenate([s.outline for s in pose.shapes]) - box[0]) / (box[1] - box[0])
    end = drawn[np.linalg.norm(drawn - anchor, axis=1).argmin()]
    fraction = ax.transAxes.inverted().transform
    corner, span = fraction(low), fraction(low + extent) - fraction(low)
    inset = ax.inset_axes((*corner, *span), zorder=3)
    inset.text(0.5, 1.0, title, transform=inset.transAxes, ha="center", va="bottom", fontsize=7.5)
    line = {"arrowstyle": "-", "color": plotting.GREY, "linewidth": 0.7, "shrinkA": 2.0, "shrinkB": 4.0}
    ax.annotate("", place, tuple(fraction(end)), textcoords="axes fraction", arrowprops=line)
    # not seen: labels and further poses keep away from these
    for path in (np.array([anchor, end]), _grid(low, low + _with_title(ax, extent))):
        ax.plot(*fraction(path).T, transform=ax.transAxes, linestyle="none", label="ink")
    return inset


def _chosen(points: Branch | Mapping[str, Point], labels: Sequence[str] | Mapping[str, str] | None) -> dict[str, Point]:
    """Return points by title."""
    if isinstance(points, Branch):
        every: dict[str, Point] = {p.label: p for p in points.special_points if p.kind != "EP"}
    else:
        every = dict(points)
    names = list(every) if labels is None else list(labels)
    for name in names:
        if name not in every:
            raise unknown_name("special point" if isinstance(points, Branch) else "pose", name, every)
    return {(labels[n] if isinstance(labels, Mapping) else n): every[n] for n in names}


def mechanism_of(point: Point) -> Mechanism:
    """Return the mechanism of a point; an MjcontError where it has none."""
    if not isinstance(point.problem, Mechanism):
        raise MjcontError("a point without a Mechanism has no pose to draw: load its result file with its model")
    return point.problem


def _coordinate(point: Point, name: str, degrees: bool) -> float:
    value = point[name]
    unit = point.units.get(name) or mechanism_of(point).parameter(name).unit
    return float(np.degrees(value)) if degrees and unit == "rad" else value


def _size(box: Array) -> float:
    return float((box[1] - box[0]).max())


def _fitted(box: Array, side: float) -> tuple[float, float]:
    """Return width and height of a box scaled so that the longer one is `side`."""
    width, height = side / _size(box) * (box[1] - box[0])
    return float(width), float(height)


# -- where a diagram is empty --------------------------------------------------------------------------------


def _grid(low: Array, high: Array, step: float = 4.0) -> Array:
    """Return points all over a rectangle in pixels, (N, 2)."""
    sides = [np.linspace(a, b, max(2, int((b - a) / step))) for a, b in zip(low, high, strict=True)]
    return np.stack(np.meshgrid(*sides), axis=-1).reshape(-1, 2)


def _obstacles(ax: Axes) -> Array:
    """Return points in pixels on all that stands in a diagram, (N, 2)."""
    legend = ax.get_legend()
    boxes = [t.get_window_extent() for t in ax.texts if t.get_text()]
    boxes += [legend.get_window_extent()] if legend is not None else []
    return np.concatenate([notes.drawn_points(ax), *(_grid(np.array(b.min), np.array(b.max)) for b in boxes)])


def _with_title(ax: Axes, extent: Array) -> Array:
    """Return the size of a pose with its title, in pixels."""
    figure = ax.get_figure(root=True)
    return extent + [0.0, _TITLE * (figure.dpi if figure is not None else 72.0) / 72.0]


def _empty_place(ax: Axes, place: tuple[float, float], size: Array) -> tuple[Array, float]:
    """Return the lower left corner, in pixels, of the best place for a pose, empty and near its point; and its cost."""
    ink, edge = _obstacles(ax), 0.01 * ax.bbox.width
    anchor, extent = ax.transData.transform(place), _with_title(ax, size)
    first = np.array(ax.bbox.min) + edge
    last = np.maximum(first, np.array(ax.bbox.max) - edge - extent)
    best, cost = first, np.inf
    for low in _grid(first, last, 10.0):
        inside = int(np.all((ink > low - edge) & (ink < low + extent + edge), axis=1).sum())
        end = np.clip(anchor, low, low + extent)
        total = 2.0 * (inside > 0) + inside / 100.0 + float(np.linalg.norm(end - anchor)) / ax.bbox.width
        if total < cost - 1e-9:
            far = float(np.linalg.norm(end - anchor))
            # the curve through the point itself is left at its first few pixels
            parts = np.linspace(min(3.0 * edge / max(far, 1e-9), 1.0), 1.0, 16)[:, None]
            leader = anchor + parts * (end - anchor)
            crossed = np.min(np.linalg.norm(leader[:, None] - ink, axis=-1), axis=1) < 0.5 * edge
            total += 0.3 * bool(crossed.any()) + 0.08 * int(crossed.sum())
        if total < cost - 1e-9:
            best, cost = low, total
    return best, cost
