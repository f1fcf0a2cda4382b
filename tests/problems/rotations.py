"""Rotations, written out by hand."""

from __future__ import annotations

import math

import numpy as np


def cross(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def right_jacobian(v):
    """J with exp(v + dv) = exp(v) exp(J dv) to first order."""
    angle, x = np.linalg.norm(v), cross(v)
    if angle < 1e-8:
        return np.eye(3) - 0.5 * x
    return np.eye(3) - (1 - math.cos(angle)) / angle**2 * x + (angle - math.sin(angle)) / angle**3 * x @ x
