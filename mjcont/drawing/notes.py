"""Labels of special points, markers and legends, moved off curves and each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.numerics.equations.problem import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

# what marks a text as a label, a line as a special point's marker, a legend as one that may be moved
LABEL, POINT, LEGEND = "_special point", "_point", "_legend"
# Where a label is tried, best first: beside, above, below, then slanting; gaps and clearance in points.
_SIXTEENTHS = (0, 8, 4, 12, 2, 6, 10, 14, 1, 7, 9, 15, 3, 5, 11, 13)
_DIRECTIONS = [np.array([np.cos(k * np.pi / 8), np.sin(k * np.pi / 8)]) for k in _SIXTEENTHS]
_GAPS = (5.0, 9.0, 14.0, 20.0)
_CLEARANCE = 5.0
# closer than this, in points, markers lie on each other; each further one is a ring so much wider
_TOGETHER, _WIDER = 3.0, 5.0
_PLACES: Any = ("upper right", "upper left", "lower right", "lower left", "center right", "center left", "upper center",
           "lower center")


def place_legend(ax: Axes, widen: bool = False) -> None:
    """Move a legend of ours where nothing is drawn; where no such place is and `widen`, beside the axes."""
    legend, figure = ax.get_legend(), ax.get_figure(root=True)
    if legend is None or figure is None or legend.get_label() != LEGEND:
        return
    if widen:
        figure.draw_without_rendering()
    ink, covered = drawn_points(ax), []
    for place in _PLACES:
        legend.set_loc(place)
        box = legend.get_window_extent().padded(2.0)
        covered.append(int(np.count_nonzero(np.all((ink > box.min) & (ink < box.max), axis=1))))
        if not covered[-1]:
            return
    legend.set_loc(_PLACES[int(np.argmin(covered))])
    if widen:
        size = figure.get_size_inches()
        figure.set_size_inches(size[0] + legend.get_window_extent().width / figure.dpi + 0.1, size[1])
        legend.set_loc("upper left")
        legend.set_bbox_to_anchor((1.01, 1.0))
        legend.set_label("_legend beside")
        figure.draw_without_rendering()


def _tell_apart(ax: Axes) -> None:
    """Draw markers of other kinds at one place as rings around the first."""
    figure = ax.get_figure(root=True)
    near = _TOGETHER * (figure.dpi if figure is not None else 72.0) / 72.0
    places: list[tuple[Array, list[str]]] = []
    for line in (line for line in ax.lines if line.get_label() == POINT):
        at = ax.transData.transform(xy(line))[0]
        shapes = next((s for p, s in places if np.hypot(*(p - at)) < near), None)
        if shapes is None:
            places.append((at, shapes := []))
        shape = str(line.get_marker())
        if shape not in shapes:
            shapes.append(shape)
        rank = shapes.index(shape)
        line.set_markersize(float(line.get_gid() or 6.0) + _WIDER * rank)
        if rank:
            line.set(markerfacecolor="none", markeredgecolor=line.get_color(), markeredgewidth=1.2)


def place_labels(ax: Axes) -> None:
    """Move the labels of special points off curves, markers and each other; call it again after changing limits."""
    notes = [t for t in ax.texts if t.get_label() == LABEL and t.get_visible()]
    if not notes:
        return
    ax.get_xlim(), ax.get_ylim()  # noqa: B018 - reading the limits makes matplotlib settle them
    figure = ax.get_figure(root=True)
    point = (figure.dpi if figure is not None else 72.0) / 72.0
    _tell_apart(ax)
    ink, frame = drawn_points(ax), ax.bbox
    legend = ax.get_legend()
    taken: list[Array] = [legend.get_window_extent().get_points()] if legend is not None else []
    for note in notes:
        extent = note.get_window_extent()
        half = 0.5 * np.array([extent.width, extent.height])
        anchor = ax.transData.transform(note.xy)  # type: ignore[attr-defined]
        if not frame.contains(*anchor):
            continue
        best, cost = np.zeros(2), np.inf
        for gap in _GAPS:
            for d in _DIRECTIONS:
                offset = d * (gap * point + half @ np.abs(d))
                low, high = anchor + offset - half, anchor + offset + half
                away = np.hypot(*np.maximum(np.maximum(low - ink, ink - high), 0.0).T).min(initial=np.inf) / point
                clashes = sum(bool(np.all(low < b[1]) and np.all(b[0] < high)) for b in taken)
                outside = bool(np.any(low < frame.min) or np.any(high > frame.max))
                total = gap + 3.0 * max(_CLEARANCE - away, 0.0) + 10.0 * (away <= 0.0) + 40.0 * (clashes + outside)
                if total < cost - 1e-9:
                    best, cost = offset, total
        note.set_position(tuple(best / point))
        taken.append(anchor + best + half * np.array([[-1.0], [1.0]]))


def xy(line: Line2D) -> Array:
    """Return the points of a line, (N, 2)."""
    return np.asarray(line.get_xydata(), dtype=float).reshape(-1, 2)


def drawn_points(ax: Axes) -> Array:
    """Return points every two pixels along everything drawn as a line or a bar, (N, 2), in pixels."""
    points = [np.empty((0, 2))]
    drawn = [line.get_transform().transform(xy(line)) for line in ax.lines if line.get_visible()]
    drawn += [np.asarray(bar.get_transform().transform_path(bar.get_path()).vertices) for bar in ax.patches]
    for outline in drawn:
        pixels = outline[np.isfinite(outline).all(axis=1)]
        if len(pixels):
            s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(pixels, axis=0).T))])
            along = np.linspace(0.0, s[-1], min(int(s[-1] / 2.0) + 2, 20_000))
            points.append(np.column_stack([np.interp(along, s, pixels[:, k]) for k in range(2)]))
    return np.concatenate(points)
