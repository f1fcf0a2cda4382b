"""Curves of scalar equations."""

from __future__ import annotations

import mjcont as mc


def scalar(function, x0, **parameters):
    return mc.VectorField(lambda u, p: [function(u[0], p)], [x0], parameters, names=["x"])


def labels(branch):
    return [p.label for p in branch.special_points]
