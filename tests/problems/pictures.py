"""What a picture shows: how far its lines go, in pixels, and how much colour it holds."""

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
