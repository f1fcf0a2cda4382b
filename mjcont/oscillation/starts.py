"""Where curves of orbits begin: the small orbits at a Hopf point, and motions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from mjcont.errors import MjcontError, StartError
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.starts import find_start
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.conserved import orbits_on
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.follow import MeshSettings, orbit_near
from mjcont.numerics.orbits.mesh import first_mesh
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import path_at
from mjcont.numerics.orbits.scheme import Scheme
from mjcont.oscillation.flows import ModelFlow
from mjcont.results.points import SpecialPoint

_SAMPLES = 401
# a response is followed from rest in steps of its amplitude no smaller than this part
_SHORTEST = 1e-3
# periods for which a motion may take to settle, and their difference when it has, relative
_MOST_PERIODS, _SETTLED = 200, 1e-6


def harmonic_orbit(
    flow: Flow, scheme: Scheme, count: int, mean: Array, direction: Array, omega: float, size: float
) -> tuple[Orbits, Array, Array]:
    """Return equations around the orbits of a Hopf point, its orbit of a size, and how orbits change with the size.

    `direction` (d,) is the complex eigenvector of i omega: u = mean + size Re(direction exp(i omega t)).
    """
    mesh, period = np.linspace(0.0, 1.0, count + 1), 2.0 * np.pi / omega
    turned = np.exp(2j * np.pi * mesh)[:, None]
    wave, slopes = np.real(turned * direction), np.real(2j * np.pi * turned * direction)
    sizes = flow.scale.copy()
    if flow.order == 2:
        sizes[flow.c :] = np.maximum(sizes[flow.c :], sizes[: flow.c] * omega)
    orbits = orbits_on(flow, scheme, mesh, slopes, np.zeros(flow.d), sizes, period)
    inside = np.exp(2j * np.pi * orbits.phases)[:, None]
    h = (period * orbits.lengths)[:, None, None] ** flow.order
    highest = (1j * omega) ** flow.order * direction[: flow.c]
    w = h * np.real(inside * highest).reshape(orbits.w_shape)
    still = Path(scheme, flow.order, mesh, np.tile(mean, (count + 1, 1)), np.zeros(orbits.w_shape), period)
    along = orbits.joined(Path(scheme, flow.order, mesh, wave, w, 0.0))
    return orbits, orbits.joined(still) + size * along, along


def hopf_vector(flow: ModelFlow, point: SpecialPoint) -> tuple[Array, Array, float]:
    """Return the state (d,), the complex eigenvector (d,) of largest component one scale, and omega of a Hopf point.

    Raises
    ------
    MjcontError
        If no pair of eigenvalues oscillates there.
    """
    values = flow.values({k: v for k, v in point.parameters.items() if k in flow.values()})
    mean = flow.resting(point.state, values)
    rates = flow.derivatives(mean[None], np.zeros(1), values, (), True).jac[0]
    matrix = rates
    if flow.order == 2:
        matrix = np.zeros((flow.d, flow.d))
        matrix[: flow.c, flow.c :], matrix[flow.c :] = np.eye(flow.c), rates
    found, vectors = np.linalg.eig(matrix)
    omega = float(point.coefficients.get("omega", np.nan))
    oscillating = np.flatnonzero(found.imag > 0.0)
    if not len(oscillating):
        raise MjcontError(f"{point.label} has no pair of eigenvalues that oscillates: no limit cycles begin there")
    near = np.abs(found[oscillating] - 1j * omega) if np.isfinite(omega) else np.abs(found[oscillating].real)
    k = int(oscillating[np.argmin(near)])
    vector = oriented(vectors[:, k])
    size = float(np.abs(vector[: flow.c] / flow.scale[: flow.c]).max())
    return mean, vector / size, float(found[k].imag)


def sampled_path(
    flow: ModelFlow,
    scheme: Scheme,
    count: int,
    states: Callable[[Array], Array],
    period: float,
    values: Values,
    steps: Array | None = None,
) -> Path:
    """Return a motion as polynomials on a mesh on which it moves evenly; `states` takes tau (k,) to states (k, d).

    `steps` are places, from 0 to 1, between which the motion is smooth.
    """
    tau = np.linspace(0.0, 1.0, _SAMPLES)
    if steps is not None:
        tau = np.unique(np.clip(np.concatenate([tau[:: _SAMPLES // 20], steps]), 0.0, 1.0))
    mesh = first_mesh(states(tau), tau, count)
    lengths = np.diff(mesh)
    points = (mesh[:-1, None] + lengths[:, None] * scheme.c).ravel()
    h = (period * lengths)[:, None, None] ** flow.order
    w = h * flow.rates(states(points), points, values).reshape(count, scheme.degree, flow.c)
    return Path(scheme, flow.order, mesh, states(mesh), w, period)


def resting_path(flow: ModelFlow, scheme: Scheme, count: int, state: Array, period: float) -> Path:
    """Return rest in a state (d,) as a path."""
    mesh = np.linspace(0.0, 1.0, count + 1)
    still = np.zeros((count, scheme.degree, flow.c))
    return Path(scheme, flow.order, mesh, np.tile(state, (count + 1, 1)), still, period)


def response_path(flow: ModelFlow, x: Array, values: dict[str, float], meshes: MeshSettings) -> Path:
    """Return a motion near a periodic response: from rest at the mean, its inputs growing; or settled in time.

    Raises
    ------
    StartError
        If there is none.
    """
    if flow.forcing is None:
        return _settled_in_time(flow, x, values, meshes)
    found = find_start(flow.model, x, flow.theirs(values))
    if found.failure is not None:
        raise StartError(f"no equilibrium found under the mean inputs, from which to begin: {found.failure}")
    still = flow.resting(found.x, values)
    path: Path = resting_path(flow, meshes.scheme, meshes.first, still, flow.period(values))
    amplitudes = [f"{name}.amplitude" for name in flow.forcing.inputs]
    part, step = 0.0, 1.0
    while part < 1.0:
        ahead = min(part + step, 1.0)
        at = {**values, **{name: ahead * values[name] for name in amplitudes}}
        point = orbit_near(flow, path, at, np.zeros(flow.d), meshes)
        if point is None:
            step *= 0.5
            if step < _SHORTEST:
                break
            continue
        path, part = path_at(point), ahead
        step *= 1.5
    if part < 1.0:
        free = flow.model.rigid_modes(found.x, flow.theirs(values))
        loose = f"nothing opposes {' and '.join(free)}: let a spring do it" if free else ""
        why = loose or flow.touches or "it turns there or loses itself"
        raise StartError(f"the response from rest was lost at {part:.3g} of the inputs' amplitudes: {why}; give a "
                         "smaller amplitude, or state= near another response")
    return path


def _settled_in_time(flow: ModelFlow, x: Array, values: dict[str, float], meshes: MeshSettings) -> Path:
    """Return the last period of the motion from a state, once periods no longer differ, or after many."""
    period, state = flow.period(values), x.copy()

    def field(t: float, u: Array) -> Array:
        return flow.rates(u[None], np.array([t / period]), values)[0]

    for _ in range(_MOST_PERIODS):
        fine = {"rtol": 1e-7, "atol": 1e-9 * flow.scale}
        run = solve_ivp(field, (0.0, period), state, method="LSODA", dense_output=True, **fine)
        if not run.success or not np.isfinite(run.y[:, -1]).all():
            raise StartError("the motion from the start could not be followed: it diverges or has no value there")
        change = np.abs(run.y[:, -1] - state) / np.maximum(flow.scale, np.abs(run.y).max(axis=1))
        state = run.y[:, -1]
        if change.max() < _SETTLED:
            break
    dense = run.sol
    return sampled_path(flow, meshes.scheme, meshes.first, lambda tau: dense(tau * period).T, period, values)
