"""What a picture shows: how far its lines go, in pixels, how much colour it holds, and texts that meet."""

from pathlib import Path
from typing import Any

import numpy as np


def lengths(ax: Any, label: str) -> list[float]:
    """Drawn length in pixels of each line with a label; 0 for one whose points are all apart or not finite."""
    found = []
    for line in ax.lines:
        if line.get_label() == label:
            steps = np.hypot(*np.diff(ax.transData.transform(line.get_xydata()), axis=0).T)
            found.append(float(steps[np.isfinite(steps)].sum()))
    return found


def colored(path: Path) -> int:
    """Number of pixels of a PNG that are no grey: curves, bars, contours, but no frame, grid or text."""
    from matplotlib.image import imread

    pixels = imread(path)[..., :3]
    return int(np.count_nonzero(np.ptp(pixels, axis=-1) > 0.2))


def meeting(figure: Any, gap: float = 0.0) -> list[tuple[str, str]]:
    """Texts of a figure, as it is saved, whose boxes meet: numbers, labels, titles, legends, names of points."""
    from matplotlib.text import Text

    figure.draw_without_rendering()
    boxes = []
    for ax in figure.axes:
        boxes += [(t.get_text(), t.get_window_extent()) for t in _ticks(ax)]
    ticks = {t for ax in figure.axes for t in (*ax.get_xticklabels(which="both"), *ax.get_yticklabels(which="both"))}
    others = [t for t in figure.findobj(Text) if t not in ticks and t.get_text().strip() and _shown(t)]
    boxes += [(t.get_text(), t.get_window_extent()) for t in others]
    boxes = [(text, box) for text, box in boxes if box.width > 0.0]
    found = []
    for i, (text, box) in enumerate(boxes):
        found += [(text, other) for other, b in boxes[i + 1 :] if box.padded(gap).overlaps(b)]
    return found


def _ticks(ax: Any) -> list[Any]:
    """The numbers beside axes that are in view."""
    found: list[Any] = []
    if not ax.axison:
        return found
    for axis, view in ((ax.xaxis, ax.get_xlim()), (ax.yaxis, ax.get_ylim())):
        low, high = sorted(view)
        edge = 1e-9 * (high - low)
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            inside = low - edge <= tick.get_loc() <= high + edge
            found += [t for t in (tick.label1, tick.label2) if inside and t.get_text().strip() and _shown(t)]
    return found


def _shown(artist: Any) -> bool:
    """Whether an artist and what it belongs to are visible."""
    return bool(artist.get_visible() and (artist.axes is None or artist.axes.get_visible()))


def watched(monkeypatch: Any, *modules: Any) -> list[Any]:
    """Return a list that every figure saved from now on is added to, also by modules that are given."""
    import sys

    from mjcont.drawing import plotting

    save, figures = plotting.save_figure, []

    def saved(figure: Any, *rest: Any, **options: Any) -> Any:
        figures.append(figure)
        return save(figure, *rest, **options)

    for module in {*sys.modules.values(), *modules}:
        if getattr(module, "save_figure", None) is save:
            monkeypatch.setattr(module, "save_figure", saved)
    return figures
