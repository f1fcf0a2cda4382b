"""Modes drawn: the mechanism at both ends of a mode's swing, over its rest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.picture import picture
from mjcont.drawing.plotting import new_figure, set_panel_title
from mjcont.drawing.poses import mechanism_of
from mjcont.drawing.sketch import padded, render

if TYPE_CHECKING:
    from mjcont.results.modes import Mode, Modes

_TIGHT, _WIDE, _FIRST = 0.05, 2.6, 6
_BACK, _FRONT = "#b9c6d6", "#b8b8b8"


def draw_modes(modes: Modes, numbers: Sequence[int] | None, cols: int, plane: str | None) -> Any:
    """Draw a panel a mode: rest in grey, the other end of its swing in blue behind it, the mode on top."""
    chosen = [modes.mode(n) for n in numbers] if numbers is not None else list(modes)[:_FIRST]
    mechanism, values = mechanism_of(modes.point), modes.point.parameters
    shown = [
        [picture(mechanism, state, plane=plane, inputs=values)
         for state in (m.displaced(math.pi), modes.point.state, m.displaced())]
        for m in chosen
    ]
    boxes = np.array([padded(p, _TIGHT) for panel in shown for p in panel])
    box = np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
    width, height = _WIDE * (box[1] - box[0]) / (box[1] - box[0]).max()
    cols = max(1, min(cols, len(chosen)))
    rows, width = -(-len(chosen) // cols), max(float(width), 1.9)
    figure, grid = new_figure(rows, cols, (cols * width, rows * (float(height) + 0.45)), squeeze=False)
    for ax in grid.flat:
        ax.axis("off")
    unit = float((box[1] - box[0]).max())
    for ax, mode, panel in zip(grid.flat, chosen, shown, strict=False):
        set_panel_title(ax, title(mode))
        for pose, color in zip(panel, (_BACK, _FRONT, None), strict=True):
            render(ax, pose, box, unit, color=color, scale=0.8)
    return figure


def title(mode: Mode) -> str:
    """Return a mode's number, frequency and damping in two lines."""
    said = f"{mode.frequency:.4g} Hz" if mode.omega else f"{mode.kind}, {mode.growth:+.3g} 1/s"
    damped = f"damping ratio {mode.damping_ratio:.3g}" if mode.omega and math.isfinite(mode.damping_ratio) else ""
    return f"mode {mode.number}: {said}\n{damped}"
