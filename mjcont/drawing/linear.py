"""Small motions drawn: modes at both ends of their swing over rest, and Bode plots of transfer functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.axes import readable
from mjcont.drawing.picture import picture
from mjcont.drawing.plotting import COLORS, LINE_STYLES, new_figure, set_panel_title
from mjcont.drawing.poses import mechanism_of
from mjcont.drawing.sketch import padded, render
from mjcont.errors import MjcontError

if TYPE_CHECKING:
    from mjcont.results.linear import Mode, Transfer

_TIGHT, _WIDE = 0.05, 2.6
_BACK, _FRONT = "#b9c6d6", "#b8b8b8"


def draw_modes(chosen: Sequence[Mode], cols: int, plane: str | None) -> Any:
    """Draw a panel a mode: rest in grey, the other end of its swing in blue behind it, the mode on top."""
    if not chosen:
        raise MjcontError("there are no modes to draw")
    point = chosen[0].point
    mechanism, values = mechanism_of(point), point.parameters
    shown = [
        [picture(mechanism, state, plane=plane, inputs=values)
         for state in (m.displaced(math.pi), point.state, m.displaced())]
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


def draw_transfer(transfer: Transfer, decibels: bool, degrees: bool) -> Any:
    """Draw every output's gain above its phase; dashed where the equilibrium is not stable."""
    figure, (top, bottom) = new_figure(2, 1, (5.6, 4.6), sharex=True, height_ratios=[1.5, 1.0])
    style = LINE_STYLES["stable" if transfer.stable else "unstable"]
    turn = math.degrees(1.0) if degrees else 1.0
    for i, name in enumerate(transfer.outputs):
        factor = turn if transfer.units[name] == "rad" else 1.0
        gain, color = factor * transfer.gain(name), COLORS[i % len(COLORS)]
        gain = np.where(gain > 0.0, gain, np.nan)  # a logarithm shows no zero
        top.plot(transfer.frequencies, 20.0 * np.log10(gain) if decibels else gain, color=color, linestyle=style,
                 label=readable(name))
        bottom.plot(transfer.frequencies, turn * transfer.phase(name), color=color, linestyle=style)
    top.set_xscale("log")
    units = {transfer.units[n] for n in transfer.outputs}
    unit = units.pop() if len(units) == 1 else ""
    shown = ("deg" if degrees and unit == "rad" else unit) or "1"
    per = f"{shown} per {transfer.units[transfer.input] or '1'}"
    if decibels:
        top.set_ylabel(f"gain [dB of {per}]")
    else:
        if any(np.isfinite(line.get_ydata()).any() for line in top.lines):
            top.set_yscale("log")
        top.set_ylabel(f"gain [{per}]" if unit else "gain")
    bottom.set_ylabel(f"phase [{'deg' if degrees else 'rad'}]")
    bottom.set_xlabel("frequency [Hz]")
    top.legend(loc="best")
    title = f"{readable(transfer.input)} swings" + ("" if transfer.stable else ", about an unstable equilibrium")
    top.set_title(title, loc="left", fontsize=9.5)
    return figure
