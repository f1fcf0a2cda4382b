"""Branches of mechanisms, and a column of hinged links."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

import mjcont as mc
from problems.reference import BOUNDS, START


@cache
def branch_of(model, chord=3e-6, k_j=1e3):
    """Return a branch in the load."""
    if model == "overcentre":
        values = {"F": START, "k_j": k_j}
        return mc.continue_equilibria(mc.Mechanism.from_xml(model), "F", BOUNDS, values, chord=chord)
    mechanism, values, key = mc.Mechanism.from_xml(model), {"F_ret": 20.0}, "uplock_above"
    if model == "nose_gear":
        values = {"F_ret": 4e5, "gravity_angle": math.radians(-20.0)}
    bounds = (0.0, 60.0) if model == "nose_gear_full" else (0.0, 8e5)
    return mc.continue_equilibria(mechanism, "F_ret", bounds, values, keyframe=key, chord=chord)


def scaled(branch):
    """Return the points in the unknowns in which distance is measured, (N, n + 1)."""
    ((name, (low, high)),) = branch.free.items()
    return np.column_stack([branch.states / branch.problem.state_scale, branch[name] / (high - low)])


def column(links):
    """Return an elastic column of hinged links under a dead load P along its axis, of length 1 m."""
    length, stiffness = 1.0 / links, float(links)
    opening = "".join(
        f'<body pos="{length if i else 0} 0 0"><joint axis="0 1 0" stiffness="{stiffness}" damping="0.1"/>'
        f'<geom type="capsule" fromto="0 0 0 {length} 0 0" size="0.01" density="1000"/>'
        for i in range(links)
    )
    return mc.Mechanism.from_xml(
        '<mujoco><option gravity="0 0 0"><flag contact="disable"/></option><worldbody><site name="ground"/>'
        f'{opening}<site name="tip" pos="{length} 0 0"/>{"</body>" * links}</worldbody>'
        '<actuator><general name="P" site="tip" refsite="ground" gear="-1 0 0 0 0 0"/></actuator></mujoco>'
    )
