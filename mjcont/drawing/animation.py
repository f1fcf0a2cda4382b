"""Animations: a mechanism beside the moving point on its diagram.

The diagram is drawn once; for every frame only the mechanism, the point, its trail and the caption are drawn on top.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.arguments import checked
from mjcont.drawing import plotting
from mjcont.drawing.axes import show_axis, spread_ticks
from mjcont.drawing.frames import Frame, Result, Track, default_columns, frames_of, track_of
from mjcont.drawing.movies import check_movie, write_movie
from mjcont.drawing.offscreen import Offscreen
from mjcont.drawing.picture import Picture, pictured
from mjcont.drawing.shapes import Scene, plane_axes
from mjcont.drawing.sketch import padded, render
from mjcont.drawing.viewer import Stand
from mjcont.errors import MjcontError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.results.branch import Branch
from mjcont.results.histories import History
from mjcont.results.linear import Mode
from mjcont.results.orbits import Orbit, OrbitPoint, SpecialOrbit, orbit_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

Orbits = Orbit | OrbitPoint | SpecialOrbit
RENDERINGS = ("drawing", "mujoco")
_DPI = 100.0
_MOST_FRAMES, _SIDES = 5000, (64, 4096)
_SECONDS, _REAL_TIME = 8.0, (2.0, 20.0)
# samples of a period between which an animation moves in straight lines
_SMOOTH = 401
_TIGHT = 0.03
_MOVING = "#d1281f"


@checked
def animate(
    result: Result | Orbits | Mode,
    path: str | Path,
    x: str | None = None,
    y: str | None = None,
    *,
    on: Branch | Sequence[Branch] | None = None,
    fps: float = 25.0,
    seconds: float | None = None,
    size: tuple[int, int] = (800, 360),
    degrees: bool = True,
    plane: str | None = None,
    rendering: str = "drawing",
    camera: str | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Write an animation of a mechanism beside the moving point on its diagram, as GIF or MP4, and return its path.

    A history moves evenly in time. Along a branch, a locus or a load path the point moves evenly over the diagram; the
    motions of a load path's jumps are shown, each at its own pace. An orbit loops through its period without a seam,
    and so does a mode, its growth or decay left out.

    Parameters
    ----------
    result : History, Branch, LoadPath, Orbit, Mode or a point of a curve of orbits
    path : a .gif, or an .mp4 where ffmpeg is installed.
    x, y : str, optional
        Columns of the diagram. Default time against the first observable for a history, else the parameter against
        the first observable, for a locus its two parameters.
    on : what to draw the diagram of; default for a history x becomes the branch's parameter.
    fps, seconds : frames a second, and the animation's length
        Default real time for histories of 2 to 20 s, otherwise the nearer of these, and 8 s
        for branches and load paths.
    size, degrees, plane : width and height in pixels; whether angles are shown in degrees; as for `draw`.
    rendering : {"drawing", "mujoco"}
        How the mechanism is shown: drawn in its plane by matplotlib, or rendered by MuJoCo, which needs OpenGL.
    camera : with MuJoCo, the name of one of the model's cameras; default its free camera.
    progress : called as `progress(done, frames)`.

    Raises
    ------
    MjcontError, NameLookupError
        If the suffix, a number or the result is not one that can be shown, ffmpeg or OpenGL is missing, there is no
        such column, camera or rendering, or a drawing is asked of a mechanism that does not move in a plane.
    """
    path, beneath = Path(path), _branches(on)
    result, loops = _period(result)
    _check_options(fps, seconds, size, rendering, camera)
    check_movie(path, fps)
    columns = _columns(result, beneath, x, y)
    track = track_of(result, *columns)
    length = seconds if seconds is not None else _length(result)
    frames = frames_of(track, _count(length, fps) + loops)[: -1 if loops else None]
    actor: _Drawn | _Rendered = _Rendered(track, camera) if rendering == "mujoco" else _Drawn(track, frames, plane)
    try:
        stage = _Stage(result, beneath, track, columns, size, degrees, actor)
        stage.pace = _pace(result, length)
        return write_movie(path, lambda k: stage.image(frames[k], k), len(frames), fps, progress)
    finally:
        actor.close()


def _period(result: Result | Orbits | Mode) -> tuple[Result, bool]:
    """Return what is shown, of an orbit or a mode its history, and whether its last moment is its first."""
    if isinstance(result, Mode):
        return result.history(_SMOOTH), True
    return (orbit_of(result).history(_SMOOTH), True) if isinstance(result, Orbits) else (result, False)


def _columns(result: Result, beneath: Sequence[Branch], x: str | None, y: str | None) -> tuple[str, str]:
    """Return the columns of the diagram: those asked for, or the result's own."""
    chosen = default_columns(beneath[0] if beneath else result) if isinstance(result, Result) else ("", "")
    return x or chosen[0], y or chosen[1]


class _Drawn:
    """The mechanism as matplotlib draws it; one scale and one place for all frames."""

    def __init__(self, track: Track, frames: Sequence[Frame], plane: str | None) -> None:
        stand = Stand(track.problem)
        self._pictures: list[Picture] = []
        axes: tuple[Array, Array] | None = None
        for frame in frames:
            stand.pose(frame.state, frame.values)
            axes = axes or plane_axes(stand.model, stand.data, plane, track.problem.name)
            self._pictures.append(pictured(Scene(stand.model, stand.data, *axes), frame.values))
        boxes = np.array([padded(p, _TIGHT) for p in self._pictures])
        self._box = np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
        extent = self._box[1] - self._box[0]
        self._unit, self.aspect = float(extent.max()), float(extent[0] / extent[1])

    def attach(self, ax: Axes) -> None:
        """Draw into these axes from now on."""
        self._ax = ax
        ax.set(xlim=self._box[:, 0], ylim=self._box[:, 1], autoscale_on=False, aspect="equal")
        ax.axis("off")

    def artists(self, frame: Frame, k: int) -> list[Artist]:
        """Return what shows frame number k, from back to front."""
        ax = self._ax
        for artist in [*ax.patches, *ax.lines]:
            artist.remove()
        render(ax, self._pictures[k], self._box, self._unit)
        return sorted([*ax.patches, *ax.lines], key=operator.methodcaller("get_zorder"))

    def close(self) -> None:
        """Nothing to free."""


class _Rendered:
    """The mechanism as MuJoCo renders it."""

    aspect = 1.0

    def __init__(self, track: Track, camera: str | None) -> None:
        self._stand, self._camera = Stand(track.problem), camera
        self._stand.pose(track.states[0], track.values[0])
        self._screen: Offscreen | None = None

    def attach(self, ax: Axes) -> None:
        """Draw into these axes from now on."""
        ax.axis("off")
        width, height = (max(int(n), 1) for n in ax.bbox.size)
        self._screen = Offscreen(self._stand.model, width, height, self._camera)
        self._shown = ax.imshow(np.zeros((height, width, 3), np.uint8), aspect="auto", interpolation="none")

    def artists(self, frame: Frame, k: int) -> list[Artist]:
        """Return what shows a frame."""
        self._stand.pose(frame.state, frame.values)
        if self._screen is not None:
            self._shown.set_data(self._screen.image(self._stand.data))
        return [self._shown]

    def close(self) -> None:
        """Free what OpenGL holds."""
        if self._screen is not None:
            self._screen.close()


class _Stage:
    """A figure whose diagram is drawn once, with what is drawn on top of it for each frame."""

    def __init__(
        self, result: Result, on: Sequence[Branch], track: Track, columns: tuple[str, str], size: tuple[int, int],
        degrees: bool, actor: _Drawn | _Rendered,
    ) -> None:
        part = float(np.clip(actor.aspect * 0.85 * size[1] / size[0], 0.28, 0.55))
        shape = (size[0] / _DPI, size[1] / _DPI)
        self._figure, (left, right) = plotting.new_figure(1, 2, shape, width_ratios=[part, 1.0 - part])
        self._figure.set_dpi(_DPI)
        self._actor, self.pace = actor, ""
        self._scales = [math.degrees(1.0) if degrees and _unit(result, n) == "rad" else 1.0 for n in columns]
        self._xs, self._ys = self._scales[0] * track.x, self._scales[1] * track.y
        self._follows = not isinstance(result, Branch)
        _diagram(right, result, on, columns, degrees, (self._xs, self._ys))
        self._trail = right.plot([], [], color=_MOVING, linewidth=1.8, label="_trail", zorder=4)[0]
        self._dot = right.plot([], [], "o", color=_MOVING, markersize=8.0, markeredgecolor="white", zorder=6)[0]
        self._caption = self._figure.suptitle("Caption", x=0.02, ha="left", fontsize=9.5)
        self._figure.draw_without_rendering()
        self._figure.set_layout_engine("none")
        spread_ticks(right)
        plotting.place_labels(right)
        self._caption.set_text("")
        left.axis("off")
        canvas: Any = self._figure.canvas
        canvas.draw()
        actor.attach(left)
        left.apply_aspect()
        self._canvas, self._empty = canvas, canvas.copy_from_bbox(self._figure.bbox)

    def image(self, frame: Frame, k: int) -> Array:
        """Return frame number k, (height, width, 3) bytes."""
        here = (self._scales[0] * frame.x, self._scales[1] * frame.y)
        if self._follows:
            self._trail.set_data([*self._xs[: frame.row + 1], here[0]], [*self._ys[: frame.row + 1], here[1]])
        self._dot.set_data([here[0]], [here[1]])
        self._caption.set_text(frame.caption + self.pace)
        self._canvas.restore_region(self._empty)
        renderer = self._canvas.get_renderer()
        for artist in [*self._actor.artists(frame, k), self._trail, self._dot, self._caption]:
            artist.draw(renderer)
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()


def _diagram(
    ax: Axes, result: Result, on: Sequence[Branch], columns: tuple[str, str], degrees: bool, line: tuple[Array, Array]
) -> None:
    """Draw what stands still: branches, and all of the way that the point goes."""
    x, y = columns
    curves = [*on, *([] if isinstance(result, History) else [result])]
    if curves:
        plotting.plot(*curves, x=x, y=y, ax=ax, degrees=degrees, legend=False)
    if not isinstance(result, Branch):
        ax.plot(*line, color=plotting.GREY, linewidth=0.8, alpha=0.6, label="_way", zorder=1.5)
    if not curves:
        show_axis(ax.xaxis, x, _unit(result, x), (), degrees)
        show_axis(ax.yaxis, y, _unit(result, y), (), degrees)


def _unit(result: Result, name: str) -> str:
    if isinstance(result, Branch) and name in result.fixed:
        return str(result.model.parameter(name).unit)
    return result.unit(name)


def _branches(on: Branch | Sequence[Branch] | None) -> list[Branch]:
    branches = [on] if isinstance(on, Branch) else list(on if on is not None else [])
    for b in branches:
        if not isinstance(b, Branch):
            raise MjcontError(f"on takes a Branch, or several in a list, got a {type(b).__name__}")
    return branches


def _check_options(fps: float, seconds: float | None, size: Any, rendering: str, camera: str | None) -> None:
    for label, value in (("fps", fps), ("seconds", seconds)):
        if value is not None and not (value > 0 and math.isfinite(value)):
            raise MjcontError(f"{label} must be a positive number, got {value}")
    low, high = _SIDES
    if np.shape(size) != (2,) or not all(isinstance(n, int | np.integer) and low <= n <= high for n in size):
        raise MjcontError(f"size must be width and height in pixels, each a whole number from {low} to {high}: {size}")
    if rendering not in RENDERINGS:
        raise unknown_name("rendering", rendering, RENDERINGS)
    if camera is not None and rendering != "mujoco":
        raise MjcontError("a camera goes with rendering='mujoco'")


def _count(seconds: float, fps: float) -> int:
    count = max(2, round(seconds * fps))
    if count > _MOST_FRAMES:
        raise MjcontError(f"{seconds:g} s at {fps:g} frames a second are {count} frames, more than {_MOST_FRAMES}")
    return count


def _length(result: Result) -> float:
    """Return how long an animation takes unless told otherwise, in s."""
    if not isinstance(result, History):
        return _SECONDS
    return float(np.clip(result["time"][-1] - result["time"][0], *_REAL_TIME))


def _pace(result: Result, length: float) -> str:
    """Say how much faster or slower than real time a history is shown."""
    if not isinstance(result, History):
        return ""
    ratio = float(result["time"][-1] - result["time"][0]) / length
    if abs(ratio - 1.0) < 0.01:
        return ""
    return f" ({ratio:.3g} times real time)"
