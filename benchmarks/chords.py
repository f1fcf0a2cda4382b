"""Accuracy of a diagram: how far its chords lie from the curve."""

from __future__ import annotations

import numpy as np


def chord_error(curve: np.ndarray, reference: np.ndarray, spans: np.ndarray) -> float:
    """Return the largest distance of a fine reference curve from a polyline.

    Parameters
    ----------
    curve : (N, 2) points of the diagram.
    reference : (M, 2) many points of the same curve.
    spans : (2,) widths by which both axes are scaled.
    """
    c, r = curve / spans, reference / spans
    start, chord = c[:-1], np.diff(c, axis=0)
    lengths = np.maximum(np.sum(chord**2, axis=1), 1e-300)
    worst = 0.0
    for point in r:
        along = np.clip(np.sum((point - start) * chord, axis=1) / lengths, 0.0, 1.0)
        nearest = start + along[:, None] * chord
        worst = max(worst, float(np.min(np.hypot(*(point - nearest).T))))
    return worst
