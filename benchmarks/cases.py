"""What is measured: problems with a parameter, bounds and a start."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

import mjcont as mc
from benchmarks import compiled

LINKS = (5, 10, 20, 40, 80, 160)


@dataclass(frozen=True, slots=True)
class Case:
    """A branch that is computed over and over.

    Attributes
    ----------
    name : str
    problem : Mechanism or VectorField
    parameter : str
    bounds : tuple of float
    start : equilibrium from which it is followed, found beforehand for mjcont and its peers alike
    watched : str
        The column whose chord error counts as the diagram's accuracy.
    direction : int or None
    """

    name: str
    problem: Any
    parameter: str
    bounds: tuple[float, float]
    start: mc.Point
    watched: str = ""
    direction: int | None = None

    def run(self, **options: Any) -> mc.Branch:
        """Compute the branch."""
        return mc.continue_equilibria(
            self.problem, self.parameter, self.bounds, self.start, direction=self.direction, **options
        )


def overcentre(stiffness: float = 1e3) -> Case:
    """Return the overcentre mechanism, six degrees of freedom, with bushes of the model's stiffness or another."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    start = mc.find_equilibrium(mechanism, {"k_j": stiffness, "F": 0.0})
    name = "overcentre" if stiffness == 1e3 else f"overcentre {stiffness:.0e}"
    return Case(name, mechanism, "F", (-30.0, 30.0), start, "theta_1")


def gear() -> Case:
    """Return the nose gear of five degrees of freedom at a gravity angle of -20 degrees."""
    mechanism = mc.Mechanism.from_xml("nose_gear")
    values = {"F_ret": 4e5, "gravity_angle": math.radians(-20.0)}
    start = mc.find_equilibrium(mechanism, values, keyframe="uplock_above")
    return Case("nose gear", mechanism, "F_ret", (0.0, 8e5), start, "theta_ov")


def full_gear() -> Case:
    """Return the nose gear of fifteen degrees of freedom."""
    mechanism = mc.Mechanism.from_xml("nose_gear_full")
    start = mc.find_equilibrium(mechanism, {"F_ret": 20.0}, keyframe="uplock_above")
    return Case("nose gear full", mechanism, "F_ret", (0.0, 60.0), start, "theta_ov")


def chain(links: int) -> Case:
    """Return an elastic cantilever of equal links, bent by a force at its tip across its axis."""
    mechanism = mc.Mechanism.from_xml(chain_xml(links))
    return Case(f"chain {links}", mechanism, "P", (0.0, 6.0), mc.find_equilibrium(mechanism), "turn0", direction=1)


def chain_xml(links: int) -> str:
    """Return MJCF of a horizontal cantilever of length 1 m with bending stiffness 1 N m^2, in `links` hinged links.

    The last link carries a force P along -z of the ground, by an actuator between two sites.
    """
    length, stiffness = 1.0 / links, float(links)
    opening = "".join(
        f'<body name="link{i}" pos="{length if i else 0} 0 0">'
        f'<joint name="turn{i}" axis="0 1 0" stiffness="{stiffness}" damping="{0.01 * stiffness}"/>'
        f'<geom type="capsule" fromto="0 0 0 {length} 0 0" size="{0.1 * length}" density="1"/>'
        for i in range(links)
    )
    return (
        '<mujoco model="chain"><option gravity="0 0 -9.81"><flag contact="disable"/></option>'
        '<custom><text name="mjcont/P" data="unit=N bounds=0,10 : control:P"/></custom>'
        f'<worldbody><site name="ground"/>{opening}<site name="tip" pos="{length} 0 0"/>{"</body>" * links}</worldbody>'
        '<actuator><general name="P" site="tip" refsite="ground" gear="0 0 -1 0 0 0"/></actuator>'
        "</mujoco>"
    )


def reaction(kind: str = "") -> Case:
    """Return the plain problem `ab`: two chemical reactions (demo of AUTO-07p), B = 14, sigma = 3.

    Its function takes one state at a time, or is "vectorized", or "compiled" and takes many at once.
    """

    def alone(u: Any, p: Mapping[str, float]) -> list[float]:
        conversion = p["D"] * (1.0 - u[0]) * math.exp(u[1])
        return [conversion - u[0], p["B"] * conversion - (1.0 + 3.0) * u[1]]

    def together(u: Any, p: Mapping[str, Any]) -> list[Any]:
        conversion = p["D"] * (1.0 - u[0]) * np.exp(u[1])
        return [conversion - u[0], p["B"] * conversion - (1.0 + 3.0) * u[1]]

    rhs = {"": lambda: alone, "vectorized": lambda: together, "compiled": compiled.compiled}[kind]()
    problem = mc.VectorField(rhs, [0.0, 0.0], {"D": 0.0, "B": 14.0}, name="ab", vectorized=bool(kind))
    return Case(f"ab {kind}".strip(), problem, "D", (0.0, 0.4), mc.find_equilibrium(problem), "u[0]", direction=1)
