"""Bifurcation diagrams in matplotlib: line style by stability, marker by kind of special point, labels beside points.

Matplotlib is imported inside the functions, so that `import mjcont` stays quick; pyplot never is: figures are drawn
by the Agg canvas and need no display.
"""

from __future__ import annotations

import inspect
import io
import warnings
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.arguments import checked
from mjcont.drawing.axes import readable, show_axis, spread_ticks
from mjcont.drawing.loadpaths import draw_path
from mjcont.drawing.notes import LABEL, LEGEND, POINT, place_labels, place_legend, xy
from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import KINDS, name_of
from mjcont.outside.escapes import for_picture
from mjcont.outside.saving import write_file
from mjcont.results.branch import Branch, Diagram
from mjcont.results.loadpaths import LoadPath
from mjcont.results.points import SpecialPoint, show
from mjcont.results.quantities import column_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Line = tuple[Array, Array, Collection[int]]
COLORS = ("#1b4f8a", "#c4541a", "#2a7d5f", "#7b3fa0", "#8a6d1b", "#b02a4a", "#4d4d4d")
GREY = "#6e6e6e"
LINE_STYLES: Mapping[str, Any] = {"stable": "-", "unstable": (0, (4.5, 2.0)), "marginal": (0, (1.0, 1.4))}
MARKERS: Mapping[str, tuple[str, float]] = {k.code: k.marker for k in KINDS.values() if k.marker is not None}
_MARKER = ("p", 6.0)  # of any other kind
_STROKES = "x+1234|_"  # markers without a face
STYLE: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#333333",
    "axes.grid": True,
    "axes.linewidth": 0.8,
    "font.size": 9.0,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.5,
}


def new_figure(
    rows: int = 1, cols: int = 1, size: tuple[float, float] = (5.2, 3.8), **options: Any
) -> tuple[Figure, Any]:
    """Return a figure of `size` in inches, in the package's style, and its axes: one, or an array (rows, cols).

    `options` go to `Figure.subplots`.
    """
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        return figure, figure.subplots(rows, cols, **options)


def set_panel_title(ax: Axes, text: str) -> None:
    """Write a panel's title at its upper left."""
    ax.set_title(text, loc="left", fontsize=9.5)


@checked
def plot(
    *curves: Any,
    x: str = "",
    y: str = "",
    ax: Axes | None = None,
    degrees: bool = True,
    labels: bool | Mapping[str, str] = True,
    colors: Sequence[str] | None = None,
    legend: Sequence[str] | bool | None = None,
    wrap: bool = True,
    title: str = "",
    units: str | Sequence[str] = (),
    key: bool = False,
) -> Any:
    """Draw branches and loci: solid where stable, dashed where unstable, dotted where marginal; loci solid.

    Of orbits an observable is drawn by its largest and smallest value. A load path is a broad line with arrows.

    Parameters
    ----------
    *curves : Branch or LoadPath, or a Diagram or list of them; or one result of another kind, drawn as it draws itself.
    x, y : str
        Columns: parameters or observables; `y` of a curve of orbits may be an observable or one of its columns.
        By default an observable over the parameter.
    ax : matplotlib Axes, optional; default those of a new figure, which is `plot(...).figure`.
    degrees : whether angles are drawn in degrees.
    labels : bool, or mapping such as `{"LP1": "FP2"}` that renames some special points
    colors : sequence of matplotlib colours, one a branch, repeated if there are fewer.
    legend : sequence of str, or bool, optional
        Names of the branches, by default what differs between them; True also explains line styles, False is none.
    wrap : whether the line breaks where an angle jumps by more than half a turn.
    title : str, optional
    units : str or sequence of str, such as ("kN", "mm"): each is that of the axes that it fits.
    key : whether the legend explains line styles and markers.

    Raises
    ------
    NameLookupError
        If a branch has no such column; the message lists those it has.
    """
    if len(curves) == 1 and hasattr(curves[0], "plot") and not isinstance(curves[0], Branch | LoadPath | Diagram):
        return _of_its_own(curves[0], x=x, y=y, ax=ax)
    each = each_curve(curves)
    paths = [c for c in each if isinstance(c, LoadPath)]
    branches = [c for c in each if not isinstance(c, LoadPath)]
    _check(branches, legend, bool(paths))
    x, y = x or each[0].axes[0], y or each[0].axes[1]
    for path in paths:
        _ = path[x], path[y]
    # Everything is read before anything is drawn, so that an unknown column leaves the axes as they were.
    data = [_lines(b, x, y, degrees, wrap) for b in branches]
    own, ax = ax is None, ax if ax is not None else new_figure()[1]
    _draw_all(ax, branches, paths, data, (x, y), degrees, labels, colors, _names(branches, legend))
    for axis, name in ((ax.xaxis, x), (ax.yaxis, y)):
        show_axis(axis, name, _common_unit(each, name), units, degrees)
    if title:
        set_panel_title(ax, title)
    _explain(ax, branches, legend, key, own)
    return ax


def _of_its_own(result: Any, **options: Any) -> Any:
    """Let a result that is no curve draw itself."""
    given = {name: value for name, value in options.items() if value is not None and value != ""}
    takes = inspect.signature(result.plot).parameters
    for name in given:
        if name not in takes:
            what, known = type(result).__name__, ", ".join(takes) or "nothing"
            raise MjcontError(f"a {what} draws itself without '{name}'; {what}.plot takes {known}")
    return result.plot(**given)


def _draw_all(
    ax: Axes, branches: Sequence[Branch], paths: Sequence[LoadPath], data: Sequence[Sequence[Line]],
    axes: tuple[str, str], degrees: bool, labels: bool | Mapping[str, str], colors: Sequence[str] | None,
    names: Sequence[str],
) -> None:
    """Draw branches, each in a colour of its own under its name, and load paths over them."""
    drawn = sum(len(xy(line)) == 0 for line in ax.lines)
    palette = colors or [COLORS[(drawn + i) % len(COLORS)] for i in range(len(branches))]
    for i, (branch, name, lines) in enumerate(zip(branches, names, data, strict=True)):
        color = palette[i % len(palette)]
        # An empty line carries the branch's name: its first piece may be dashed, and it counts the colours used.
        ax.plot([], [], color=color, label=name or "_branch")
        _draw_branch(ax, branch, lines, labels, color)
    for i, path in enumerate(paths):
        color = (colors or COLORS[1:])[(len(branches) * bool(colors) + i) % len(colors or COLORS[1:])]
        draw_path(ax, path, *axes, degrees=degrees, color=color, labels=labels is not False and not branches)


def _draw_branch(
    ax: Axes, branch: Branch, lines: Sequence[Line], labels: bool | Mapping[str, str], color: str
) -> None:
    """Draw the lines that show a branch, its special points named on the first of them."""
    for k, (xs, ys, breaks) in enumerate(lines):
        draw_curve(ax, xs, ys, pieces(branch), color=color, breaks=breaks)
        draw_points(ax, xs, ys, branch.special_points, labels=labels if k == 0 else False, color=color)


def each_curve(curves: Iterable[Any]) -> list[Any]:
    """Return curves one by one: diagrams and lists of them are taken apart."""
    found: list[Any] = []
    for c in curves:
        plain = isinstance(c, Branch | LoadPath | str) or not isinstance(c, Iterable)
        found += [c] if plain else each_curve(c)
    return found


def _explain(
    ax: Axes, branches: Iterable[Branch], legend: Sequence[str] | bool | None, key: bool, own: bool
) -> None:
    """Add the legend, with the line styles on request, and what markers mean with a key; then place all names."""
    if legend is not False:
        _add_legend(ax, branches, legend is True, key)
    place_legend(ax, own)
    place_labels(ax)


def _add_legend(ax: Axes, branches: Iterable[Branch], styles: bool, key: bool) -> None:
    if styles or key:
        _explain_styles(ax, branches)
    if key:
        kinds = dict.fromkeys(p.kind for b in branches for p in b.special_points if p.kind != "EP")
        for kind in kinds:
            shape, size = MARKERS.get(kind, _MARKER)
            ax.plot([], [], marker=shape, markersize=size, linestyle="none", color=GREY if kind == "UZ" else "black",
                    label=f"{kind}: {name_of(kind)}")
    if any(not str(line.get_label()).startswith("_") for line in ax.lines):
        ax.legend(frameon=True, framealpha=0.85, edgecolor="none", fontsize=8.5, loc="upper right").set_label(LEGEND)


def _explain_styles(ax: Axes, branches: Iterable[Branch]) -> None:
    present = {w for b in branches if b.rated for w, _, _ in pieces(b)}
    for word in (w for w in LINE_STYLES if w in present):
        ax.plot([], [], color=GREY, linestyle=LINE_STYLES[word], label=word)


def pieces(branch: Branch) -> list[tuple[str, int, int]]:
    """Return (stability, first row, last row) of the pieces of a branch; neighbours share a row. Loci are one piece."""
    if not branch.rated:
        return [("stable", 0, len(branch) - 1)]
    return split_by_stability(branch.stability, {p.index for p in branch.special_points})


def split_by_stability(stability: Sequence[str] | Array, special: Collection[int] = ()) -> list[tuple[str, int, int]]:
    """Return (stability, first row, last row) of the pieces between rows of one stability.

    A marginal row that is special, or stands alone, only joins its neighbours. Where it cannot be told which
    side of a change an interval belongs to, it counts as unstable.
    """
    words = [str(w) for w in stability]
    last = len(words) - 1

    def marginal(i: int) -> bool:
        return 0 <= i <= last and words[i] == "marginal" and i not in special

    plain = [w if w != "marginal" or (marginal(i) and (marginal(i - 1) or marginal(i + 1))) else ""
             for i, w in enumerate(words)]
    found: list[tuple[str, int, int]] = []
    for i in range(last):
        sides = {w for w in plain[i : i + 2] if w}
        if len(sides) == 2:
            sides -= {"marginal"}
        word = sides.pop() if len(sides) == 1 else "unstable"
        if found and found[-1][0] == word:
            found[-1] = (word, found[-1][1], i + 1)
        else:
            found.append((word, i, i + 1))
    return found


def draw_curve(
    ax: Axes,
    xs: Array,
    ys: Array,
    parts: Iterable[tuple[str, int, int]],
    *,
    color: str,
    width: float = 1.6,
    breaks: Collection[int] = (),
) -> None:
    """Draw pieces (stability, first row, last row) of a curve; `breaks` are rows after which the line is cut."""
    for word, first, last in parts:
        cuts = [first - 1, *sorted(b for b in breaks if first <= b < last), last]
        for a, b in zip(cuts, cuts[1:], strict=False):
            rows = slice(a + 1, b + 1)
            # gaps hide what is drawn before, so that dashes of two curves that nearly coincide do not fill each other
            gaps: dict[str, Any] = {} if word == "stable" else {"gapcolor": ax.get_facecolor(), "zorder": 1.9}
            ax.plot(xs[rows], ys[rows], color=color, linestyle=LINE_STYLES[word], linewidth=width, label="_curve",
                    dash_capstyle="butt", solid_capstyle="butt", **gaps)
    if len(xs) == 1:
        ax.plot(xs, ys, color=color, marker=".", linestyle="none", label="_curve")


def draw_points(
    ax: Axes,
    xs: Array,
    ys: Array,
    points: Iterable[SpecialPoint],
    *,
    labels: bool | Mapping[str, str] = True,
    color: str = "black",
) -> None:
    """Draw special points (rows of xs, ys) and their labels; a point that did not converge is hollow."""
    for p in points:
        if p.kind == "EP":
            continue
        text = p.label if not isinstance(labels, Mapping) else labels.get(p.label, p.label)
        mark(ax, xs[p.index], ys[p.index], p.kind, text if labels is not False else "", color=color,
             hollow=not p.converged)


def mark(
    ax: Axes, x: float, y: float, kind: str = "LP", text: str = "", *, color: str = "black", hollow: bool = False
) -> None:
    """Draw one special point with its label, which `place_labels` moves off the curves."""
    shape, size = MARKERS.get(kind, _MARKER)
    ink = GREY if kind == "UZ" else "black"
    edge = ink if shape in _STROKES or hollow else "white"
    ax.plot([x], [y], marker=shape, markersize=size, linestyle="none", color=ink, zorder=4, label=POINT, gid=str(size),
            markerfacecolor="white" if hollow else ink, markeredgecolor=edge,
            markeredgewidth=1.3 if edge == ink else 0.6)
    if text:
        note = ax.annotate(text, (x, y), (0.0, 9.0), textcoords="offset points", ha="center", va="center",
                           fontsize=8.5, color=color, zorder=5)
        note.set_label(LABEL)


def save_figure(figure: Figure, path: str | Path, *, dpi: float = 200.0) -> Path:
    """Write a figure as PNG, SVG or PDF by the path's suffix, whole or not at all, the same bytes every time.

    Raises
    ------
    MjcontError
        If the suffix is another one, or the folder does not exist.
    """
    import matplotlib

    path = Path(path)
    dates: dict[str, dict[str, Any]] = {
        ".png": {"Software": None},
        ".svg": {"Date": None},
        ".pdf": {"CreationDate": None},
    }
    if path.suffix.lower() not in dates:
        raise MjcontError(f"cannot write a figure as '{path.name}': the suffix must be one of {', '.join(dates)}")
    metadata = dates[path.suffix.lower()]

    picture = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "mjcont"}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from")  # a box stands for it
        try:
            figure.draw_without_rendering()
            for ax in figure.axes:
                spread_ticks(ax)
                place_legend(ax)
                place_labels(ax)
            figure.savefig(picture, format=path.suffix.lower()[1:], dpi=dpi, metadata=metadata)
        except ValueError as error:  # a text between $ is drawn as a formula
            raise MjcontError(f"cannot draw {path}: {' '.join(str(error).split())}") from error
    return write_file(path, picture.getvalue())


def _check(branches: Sequence[Any], legend: Sequence[str] | bool | None, paths: bool = False) -> None:
    if not branches and not paths:
        raise MjcontError("plot needs at least one branch")
    for b in branches:
        if not isinstance(b, Branch):
            what = type(b).__name__
            raise MjcontError(f"plot takes branches one by one, as in plot(branch, locus, x=..., y=...); got a {what}")
    if isinstance(legend, str) or (isinstance(legend, Sequence) and len(legend) != len(branches)):
        count = len(branches)
        raise MjcontError(f"legend must be a list with a name for each branch ({count} in all), got {legend!r}")


def _lines(branch: Branch, x: str, y: str, degrees: bool, wrap: bool) -> list[Line]:
    """Return the lines that show a branch: xs, ys, and the rows after which they are cut."""
    xs = _column(branch, x, degrees)
    return [(xs, _column(branch, n, degrees), _breaks(branch, (x, n)) if wrap else ()) for n in branch.drawn(y)]


def _unit(branch: Branch, name: str) -> str:
    """Return the unit of a column, also of a parameter that the branch holds fixed."""
    name = branch.drawn(name)[0]
    own = column_of(name, branch.columns)
    if own is not None or branch.problem is None:
        return branch.units.get(own or name, "")
    return str(branch.model.parameter(name).unit)


def _column(branch: Branch, name: str, degrees: bool) -> Array:
    values = branch[name]
    return np.degrees(values) if degrees and _unit(branch, name) == "rad" else values


def _breaks(branch: Branch, names: Iterable[str]) -> set[int]:
    """Return the rows after which an angle jumps by more than half a turn."""
    angles = [branch[n] for n in names if _unit(branch, n) == "rad"]
    return {int(i) for a in angles for i in np.flatnonzero(np.abs(np.diff(a)) > np.pi)}


def _common_unit(curves: Iterable[Branch | LoadPath], name: str) -> str:
    units = (c.unit(name) if isinstance(c, LoadPath) else _unit(c, name) for c in curves)
    return next((u for u in units if u not in ("", "1")), "")


def _names(branches: Sequence[Branch], legend: Sequence[str] | bool | None) -> list[str]:
    """Return the branches' names for the legend: those given, or what differs between them."""
    if isinstance(legend, Sequence):
        return list(legend)
    if legend is False or (legend is None and len(branches) < 2):
        return [""] * len(branches)
    common = set.intersection(*(set(b.fixed) for b in branches))
    differing = [n for n in branches[0].fixed if n in common and len({b.fixed[n] for b in branches}) > 1]
    names = []
    for i, b in enumerate(branches):
        parts = [b.kind] if len({c.kind for c in branches}) > 1 else []
        parts += [f"{readable(n)} = {show(b.fixed[n], _unit(b, n), 4).replace('*', ' ')}" for n in differing]
        own = for_picture(b.name) if len({c.name for c in branches}) == len(branches) else f"branch {i + 1}"
        parts = parts or [own]
        names.append(", ".join(parts))
    return names
