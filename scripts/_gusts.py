"""Gusts and turbulence as a gear feels them: histories of load factor and gravity angle.

The aircraft plunges only: a vertical gust of velocity u (m/s, up) lifts it with the force rho V a S (u - w) / 2, w its
own vertical velocity, so that

    w' = (u - w) / tau,   n - 1 = w' / g,   gravity angle = w / V (the flight path's),   tau = 2 (W/S) / (rho V a g).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array

G = 9.81


@dataclass(frozen=True, slots=True)
class Aircraft:
    """What turns a gust into a load factor; the default is a narrow-body airliner on approach.

    Attributes
    ----------
    speed : m/s, equivalent air speed; loading : W/S in N/m^2; slope : lift curve slope in 1/rad; density : kg/m^3.
    """

    speed: float = 90.0
    loading: float = 5000.0
    slope: float = 5.5
    density: float = 1.225

    @property
    def tau(self) -> float:
        """Time in s in which the aircraft gives way to a gust."""
        return 2.0 * self.loading / (self.density * self.speed * self.slope * G)


@dataclass(frozen=True, slots=True)
class Gust:
    """A history of vertical air velocity and what it does to the aircraft: times (m,), each (m,)."""

    times: Array
    velocity: Array
    load_factor: Array
    gravity_angle: Array

    @property
    def inputs(self) -> dict[str, tuple[Array, Array]]:
        """The inputs of a simulation."""
        return {"load_factor": (self.times, self.load_factor), "gravity_angle": (self.times, self.gravity_angle)}


def felt(times: Array, velocity: Array, aircraft: Aircraft) -> Gust:
    """Return what an aircraft feels of vertical air velocity (m,), which is linear between evenly spaced times."""
    dt, tau = float(times[1] - times[0]), aircraft.tau
    w = np.zeros(len(times))
    decay = np.exp(-dt / tau)
    rates = np.diff(velocity) / dt
    for k, rate in enumerate(rates.tolist()):
        # w = u - tau u' + (w_k - u_k + tau u') e^(-t / tau) while u' is constant
        w[k + 1] = velocity[k + 1] - tau * rate + (w[k] - velocity[k] + tau * rate) * decay
    return Gust(times, velocity, 1.0 + (velocity - w) / (tau * G), w / aircraft.speed)


def design_velocity(gradient: float, reference: float) -> float:
    """Return the design gust velocity in m/s at a gradient distance in m: reference (H / 107 m)^(1/6)."""
    return float(reference * (gradient / 107.0) ** (1.0 / 6.0))


def one_minus_cos(times: Array, peak: float, gradient: float, begin: float, aircraft: Aircraft) -> Gust:
    """Return the discrete gust of CS-25.341: u = peak / 2 (1 - cos(pi s / H)) over 0 <= s <= 2 H, s = V (t - begin)."""
    s = aircraft.speed * (times - begin)
    inside = (s >= 0.0) & (s <= 2.0 * gradient)
    velocity = np.where(inside, 0.5 * peak * (1.0 - np.cos(np.pi * s / gradient)), 0.0)
    return felt(times, velocity, aircraft)


def dryden(times: Array, sigma: float, scale: float, seed: int, aircraft: Aircraft) -> Gust:
    """Return random turbulence with the first-order Dryden spectrum, in still air before times[0].

    Its one-sided spectrum in angular frequency is 2 sigma^2 (L/V) / (pi (1 + (omega L/V)^2)); samples are those of the
    exact first-order process, blended in over one scale length so that it starts from rest.
    """
    rng = np.random.default_rng(seed)
    dt, rate = float(times[1] - times[0]), aircraft.speed / scale
    keep = np.exp(-rate * dt)
    noise = rng.standard_normal(len(times))
    u = np.empty(len(times))
    u[0] = sigma * noise[0]
    for k in range(1, len(times)):
        u[k] = keep * u[k - 1] + sigma * np.sqrt(1.0 - keep**2) * noise[k]
    ramp = np.clip((times - times[0]) * rate, 0.0, 1.0)
    return felt(times, u * ramp, aircraft)
