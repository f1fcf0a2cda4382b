"""The cusp of the nose gear in closed form, for rigid pins: what the load maps are compared with.

At the cusp the locklinks are in line: to first order only E moves, square to the line B-H, and the locklinks with
it. The balance there has the unlock force, the spring and the locklinks' weight, but neither the strut's weight nor
F_ret. Along that motion u is the line of the spring (link 5 to the strut), p the unit normal of B-H, g = n g (-sin
gamma, -cos gamma):

    F_ul = k_sp (l - l_us) + (m_4 + m_5) (g . p) / (u . p).

To second order theta_1 follows E, and with it all weights: F_ret r_ret balances their moment about D, with the drag
stays as a four-bar. The locklinks' own stiffness in that balance is left out, the bushes' give too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from mjcont.numerics.equations.problem import Array

GRAVITY = 9.81
A = np.array([-1.540, 0.007])  # from D; lengths in m, docs/paper.md
STRUT, UPPER, LOWER, LINK = 2.5, 0.843, 1.114, 0.439
D_C, D_H = 1.200, 0.645
UPLOCK = np.radians(-60.0)  # theta_1 nearby
_STEP = 1e-5


@dataclass(frozen=True, slots=True)
class RigidGear:
    """The gear with rigid pins and its locklinks in line: pose, and the loads that balance it.

    Attributes
    ----------
    theta_1 : float
    line : angle in rad from the x axis of the line from B to H.
    spring : force of the spring there in N, F_ul without weight.
    weight : (2,) array: F_ul = spring + load_factor * weight @ (sin gamma, cos gamma).
    moment : (2,) array: F_ret = load_factor * moment @ (sin gamma, cos gamma).
    """

    theta_1: float
    line: float
    spring: float
    weight: Array
    moment: Array

    @classmethod
    def of(cls, values: Mapping[str, float]) -> RigidGear:
        """Return it for masses, spring and lever of a gear's parameter values."""
        theta = float(brentq(lambda t: float(np.linalg.norm(_stays(t)["H"] - _stays(t)["B"])) - 2.0 * LINK,
                             UPLOCK - 0.05, UPLOCK + 0.05))
        at = _stays(theta)
        along = (at["H"] - at["B"]) / np.linalg.norm(at["H"] - at["B"])
        square = np.array([-along[1], along[0]])
        away = at["strut"] - (at["H"] - 0.5 * LINK * along)
        length = float(np.linalg.norm(away))
        lever = float(away @ square) / length
        weight = -(values["m_4"] + values["m_5"]) * GRAVITY * square / lever
        before, after = (_weights(t, values) for t in (theta - _STEP, theta + _STEP))
        moment = GRAVITY * (after - before) / (2.0 * _STEP) / values["r_ret"]
        return cls(theta, float(np.arctan2(along[1], along[0])), values["k_sp"] * (length - values["l_us"]), weight,
                   -moment)

    def unlock(self, angle: Array, load: Array | float) -> Array:
        """Return F_ul at the cusp for gravity angles in rad and load factors."""
        return np.asarray(self.spring + load * (self.weight[0] * np.sin(angle) + self.weight[1] * np.cos(angle)))

    def retraction(self, angle: Array, load: Array | float) -> Array:
        """Return F_ret at the cusp for gravity angles in rad and load factors."""
        return np.asarray(load * (self.moment[0] * np.sin(angle) + self.moment[1] * np.cos(angle)))

    @property
    def neutral(self) -> float:
        """The gravity angle in rad at which gravity acts along the locklinks: no load factor moves F_ul."""
        return -(0.5 * np.pi + self.line)

    @property
    def steepest(self) -> float:
        """The gravity angle in rad at which F_ret is largest: gravity square to the strut, but for the stays."""
        return float(np.arctan2(self.moment[0], self.moment[1]))


def _stays(theta: float) -> dict[str, Array]:
    """Return B, H and the centres of gravity and wheel of strut and stays at a strut angle, (2,) each."""
    down = np.array([np.sin(theta), -np.cos(theta)])
    c = D_C * down
    apart = c - A
    size = float(np.linalg.norm(apart))
    foot = (size**2 + UPPER**2 - LOWER**2) / (2.0 * size)
    unit = apart / size
    b = A + foot * unit + np.sqrt(max(UPPER**2 - foot**2, 0.0)) * np.array([-unit[1], unit[0]])
    return {"B": b, "H": D_H * down, "strut": 0.5 * STRUT * down, "upper": 0.5 * (A + b), "lower": 0.5 * (b + c),
            "wheel": STRUT * down}


def _weights(theta: float, values: Mapping[str, float]) -> Array:
    """Return the sum of masses times positions, (2,): its derivative by theta_1 is the lever of gravity."""
    at = _stays(theta)
    parts = {"strut": "m_1", "upper": "m_2", "lower": "m_3", "wheel": "m_6"}
    links = (values["m_4"] + values["m_5"]) * 0.5 * (at["B"] + at["H"])
    return np.asarray(sum(values[m] * at[name] for name, m in parts.items()) + links)
