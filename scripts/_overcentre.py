"""The overcentre mechanism of figures 2 to 5: its model and equilibria, its closed form, and what the eye tells apart.

The paper prints no parameters. Figures 2 to 5 take the set with which its sentences on them hold, a model of its own
with longer links and a longer spring than `overcentre` (docs/paper.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import mjcont as mc
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import distances, whole

MODEL = "overcentre_paper"
BOUNDS = (-50.0, 50.0)  # F in N, in all figures
FOLDS = {"LP2": "FP1", "LP1": "FP2"}  # labels in a branch, and the paper's names in its order
LABELS = {"LP2": "FP$_1$", "LP1": "FP$_2$"}  # the same, as they are drawn
LINE_WIDTH = 0.01  # of what the axes span: 1.6 points, the width of a curve, in a panel of 160
_SPANS = (100.0, np.pi)  # of the axes: -50 N to 50 N, -90 deg to 90 deg
_GRAVITY = 9.81  # m/s^2, of the model at load_factor 1


def overcentre() -> mc.Mechanism:
    """Return the mechanism of figures 2 to 5."""
    return mc.Mechanism.from_xml(MODEL)


def equilibria(mechanism: mc.Mechanism, *, ds_max: float = 0.02, **values: float) -> mc.Branch:
    """Return the equilibria over the range of F, at values of other parameters."""
    return whole(mc.continue_equilibria(mechanism, "F", BOUNDS, {"F": BOUNDS[1], **values}, ds_max=ds_max))


def curve(branch: mc.Branch) -> Array:
    """Return F and theta_1 along a branch, (N, 2)."""
    return np.column_stack([branch["F"], branch["theta_1"]])


def to_axes(points: Array) -> Array:
    """Return points (F, theta_1), (..., 2), in units of what the axes span."""
    return np.asarray(points / _SPANS)


def farthest(one: Array, other: Array) -> tuple[float, float, float]:
    """Return the largest distance of two curves (N, 2), in units of the axes' spans, and F and theta_1 of that point.

    It is the farthest that a point of either lies from the other. Points beyond the range of F are not looked at.
    """
    found = []
    for points, line in ((one, other), (other, one)):
        seen = points[np.abs(points[:, 0]) <= BOUNDS[1]]
        away = distances(to_axes(seen), to_axes(line))
        worst = int(away.argmax())
        found.append((float(away[worst]), float(seen[worst, 0]), float(seen[worst, 1])))
    return max(found)


@dataclass(frozen=True)
class Rigid:
    """The mechanism with rigid joints: lengths in m, weight in N, spring stiffness in N/m."""

    L1: float
    L2: float
    l_us: float
    k_sp: float
    weight: float

    @classmethod
    def of(cls, mechanism: mc.Mechanism) -> Rigid:
        """Read the mechanism; its initial pose has the joints closed."""
        p = mechanism.values()
        names = ("joint_B[0]", "joint_B[2]", "theta_1", "theta_2", "spring_length")
        x, z, theta_1, theta_2, length = mechanism.measure(mechanism.qpos0[None], p, names)[0]
        L1 = np.hypot(x, z)
        L2 = (2 * length - L1 * np.cos(theta_1)) / np.cos(theta_2)
        return cls(L1, L2, p["l_us"], p["k_sp"], (p["m_1"] + p["m_2"]) * _GRAVITY * p["load_factor"])

    def force(self, theta_1: Array, sign: float = -1.0) -> Array:
        """Return F at equilibrium, equation (5), where the paper prints sign = +1."""
        theta_2 = -np.arcsin(self.L1 * np.sin(theta_1) / self.L2)
        stretch = self.L1 / 2 * np.cos(theta_1) + self.L2 / 2 * np.cos(theta_2) - self.l_us
        return self.weight + sign * self.k_sp * stretch * (np.tan(theta_1) - np.tan(theta_2))

    def fold(self, label: str) -> dict[str, float]:
        """Return F and theta_1 of a fold by its label in a branch, for links of equal length."""
        theta_1 = float(np.arccos(np.cbrt(self.l_us / self.L1))) * (1.0 if label == "LP2" else -1.0)
        return {"F": float(self.force(np.array(theta_1))), "theta_1": theta_1}

    def curve(self, count: int = 4001) -> Array:
        """Return F and theta_1 along the curve from a little beyond one bound of F to the other, (N, 2)."""
        theta = np.sort([*np.linspace(-1.5, 1.5, count), *(self.fold(label)["theta_1"] for label in FOLDS)])
        force = self.force(theta)
        inside = (force >= 1.2 * BOUNDS[0]) & (force <= 1.2 * BOUNDS[1])
        return np.column_stack([force, theta])[inside]
