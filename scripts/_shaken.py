"""Shaken mechanisms, with elastic and with rigid pins: their rests, responses over k_j and small swings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from _rigid_linkage import RigidLinkage

import mjcont as mc
from mjcont.numerics.equations.problem import Array

# model: loads that move, with amplitude; frequency in Hz; range of k_j in N/m; k_j enough for exact equilibria
CASES: Mapping[str, tuple[Mapping[str, float], float, tuple[float, float], float]] = {
    "overcentre": ({"F": 5.0, "load_factor": 0.2}, 0.5, (1e3, 1e8), 1e6),
    "nose_gear": ({"F_ret": 2e3, "load_factor": 4e-3}, 0.5, (1e6, 1e9), 1e6),
    "nose_gear_locking": ({"F_ret": 2e3, "load_factor": 4e-3}, 0.25, (1e7, 1e9), 1e8),
}
NAMES = {"overcentre": "overcentre", "nose_gear": "first gear", "nose_gear_locking": "gear that locks"}


@dataclass(frozen=True, slots=True)
class Shaken:
    """A mechanism that is shaken at a rest.

    Attributes
    ----------
    rest : its rest at the stiffness of `OWN`; linkage, y : the same with rigid pins, and its rest's place.
    name : the coordinate that is told.
    """

    rest: mc.Point
    linkage: RigidLinkage
    y: float
    name: str

    @classmethod
    def of(cls, model: str, rest: mc.Point, name: str, span: tuple[float, float]) -> Shaken:
        """Return it for the rest of a shipped model, and a range in deg of the coordinate around it."""
        mechanism: Any = rest.problem
        about = (rest[name] - 0.05, rest[name] + 0.05)
        low, high = np.radians(span)
        loads = tuple(CASES[model][0])
        linkage = RigidLinkage.of(mechanism, name, rest.state, (low, high), loads, rest.parameters)
        return cls(rest, linkage, linkage.rest(*about), name)


@dataclass(frozen=True, slots=True)
class Compared:
    """Responses of elastic pins over k_j against that of rigid ones; differences relative to the rigid amplitude.

    Attributes
    ----------
    stiffness, apart : k_j, and the largest difference of the swings about their means.
    told : twice what doubling k_j changes in the transfer function, relative: what an engineer can know without the
        rigid linkage.
    """

    model: str
    load: str
    stiffness: Array
    apart: Array
    told: Array

    def needed(self, part: float = 0.01) -> float:
        """Return the stiffness from which they differ by less, NaN if they do everywhere."""
        above = np.flatnonzero(self.apart > part)
        if not len(above) or above[-1] + 1 == len(self.apart):
            return float("nan")
        rows = slice(above[-1], above[-1] + 2)
        return float(np.exp(np.interp(-np.log(part), -np.log(self.apart[rows]), np.log(self.stiffness[rows]))))

    @property
    def slope(self) -> float:
        """The power of k_j with which the difference falls where it is below a tenth."""
        small = self.apart < 0.1
        return float(np.polyfit(np.log(self.stiffness[small]), np.log(self.apart[small]), 1)[0])

    @property
    def factor(self) -> tuple[float, float]:
        """Smallest and largest ratio of the difference to what is told of it, where it is below a tenth."""
        found = (self.apart / self.told)[self.apart < 0.1]
        return float(found.min()), float(found.max())


def rests() -> dict[str, Shaken]:
    """Return the three mechanisms: overcentre at 30 N, the first gear locked at 500 kN, the second at 470 kN."""
    overcentre, gear = (mc.Mechanism.from_xml(name) for name in ("overcentre", "nose_gear"))
    above = mc.find_equilibrium(overcentre, {"F": 30.0, "k_j": 1e6})
    below = mc.find_equilibrium(gear, {"F_ret": 5.3e5}, keyframe="uplock_below")
    return {
        "overcentre": Shaken.of("overcentre", above, "theta_1", (-80.0, 80.0)),
        "nose_gear": Shaken.of("nose_gear", below, "theta_ov", (-30.0, 20.0)),
        "nose_gear_locking": Shaken.of("nose_gear_locking", held(4.7e5), "theta_ov", (-50.0, 40.0)),
    }


def around(point: mc.Point, degrees: float) -> tuple[float, float]:
    """Return a range in deg around a point's theta_ov."""
    middle = float(np.degrees(point["theta_ov"]))
    return middle - degrees, middle + degrees


def held(force: float, **values: float) -> mc.Point:
    """Return the rest of the locking gear, locked under a retraction force."""
    gear = mc.Mechanism.from_xml("nose_gear_locking")
    branch = mc.continue_equilibria(gear, "F_ret", (4e5, 8e5), {"F_ret": 6e5, **values}, keyframe="uplock_below")
    return max((p for p in branch.at(F_ret=force) if p.n_unstable == 0), key=lambda p: p["theta_ov"])


def bush_mode(point: mc.Point) -> tuple[float, float]:
    """Return frequency (Hz) and damping ratio of the lowest bush mode, the second slowest that swings."""
    mode = [m for m in mc.modes(point) if m.omega > 0.0][1]
    return mode.natural_omega / (2.0 * np.pi), mode.damping_ratio


def stiffened(shaken: Shaken, **values: float) -> mc.Point:
    """Return the rest at other stiffness or damping of the pins."""
    return mc.find_equilibrium(shaken.rest.problem, {**shaken.rest.parameters, **values}, state=shaken.rest.state)


def compare(model: str, shaken: Shaken, load: str) -> Compared:
    """Return the responses over k_j."""
    loads, frequency, bounds, _ = CASES[model]
    rigid, times = rigid_orbit(shaken, load, loads[load], frequency), np.linspace(0.0, 1.0 / frequency, 65)[:-1]
    swing = shaken.linkage.angle([rigid.at(t)[0] for t in times])
    curve = mc.continue_response(
        shaken.rest.problem, "k_j", bounds, {load: mc.Harmonic(loads[load])},
        {**shaken.rest.parameters, "k_j": bounds[1]}, frequency=frequency, state=shaken.rest.state, ds_max=0.5,
        direction=-1)
    apart, told = [], []
    for point in curve:
        other = point.orbit.read(shaken.name, times)
        apart.append(np.abs((other - other.mean()) - (swing - swing.mean())).max() / (0.5 * np.ptp(swing)))
        one, two = (mc.transfer(stiffened(shaken, k_j=f * point["k_j"]), load, [shaken.name], [frequency])[shaken.name]
                    for f in (1.0, 2.0))
        told.append(2.0 * np.abs(one / two - 1.0)[0])
    return Compared(model, load, np.array(curve["k_j"]), np.array(apart), np.array(told))


def rigid_orbit(shaken: Shaken, load: str, amplitude: float, frequency: float) -> Any:
    """Return the response of the linkage with rigid pins."""
    start = {"f": frequency, "amplitude": 0.5 * amplitude}
    curve = mc.continue_response(shaken.linkage.field(load), "amplitude", (0.25 * amplitude, amplitude), start=start,
                                 state=[shaken.y, 0.0], direction=1)
    return curve.orbits[-1]


def by_frequency(shaken: Shaken, stiffness: float, over: Array, ratios: Sequence[float]) -> dict[float, Array]:
    """Return |H / H_rigid - 1| of F to theta_1 over frequencies relative to the lowest bush mode's, by its damping."""
    first, _ = bush_mode(stiffened(shaken, k_j=stiffness, c_j=0.0))
    rigid = shaken.linkage.response(shaken.y, "F", first * over)
    found = {}
    for ratio in ratios:
        rest = stiffened(shaken, k_j=stiffness, c_j=2.0 * ratio * stiffness / (2.0 * np.pi * first))
        found[ratio] = np.abs(mc.transfer(rest, "F", ["theta_1"], first * over)["theta_1"] / rigid - 1.0)
    return found
