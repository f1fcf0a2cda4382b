"""The verb `transfer`: what observables do when a parameter swings a little, from M, C, K at an equilibrium."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, ParameterError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.moving import has_activations
from mjcont.numerics.equations.differences import FOURTH_ORDER, PARAMETER, jacobian_from_rows, jacobian_steps
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.vibration import frequency_response, vibration
from mjcont.oscillation.forced import Harmonic, check_forcing
from mjcont.oscillation.modes import check_point, linearized, notes_of
from mjcont.results.linear import Transfer
from mjcont.results.model import Model
from mjcont.results.points import Point

# how many frequencies there are unless told, and how far beyond the slowest and the fastest swinging mode
_COUNT, _BEYOND = 400, 4.0


@checked
@np.errstate(all="ignore")
def transfer(
    point: Point,
    input: str,
    output: str | Sequence[str] | None = None,
    frequencies: Sequence[float] | Array | None = None,
) -> Transfer:
    """Return the linear transfer functions from a parameter to observables at an equilibrium, stable or not.

    H(w) = g . (K + i w C - w^2 M)^-1 df/dp + dy/dp, g = dy/dx + i w dy/dv.

    Parameters
    ----------
    point : Point or SpecialPoint
        An equilibrium, as for `modes`.
    input : the parameter that swings: a control, a load factor, a field of the model; not geometry.
    output : observables; default all of them.
    frequencies : in Hz
        Default 400 evenly spaced in their logarithm, from a quarter of the slowest to four times the fastest mode that
        swings, those of the modes among them.

    Returns
    -------
    Transfer
        NaN where a frequency is that of an undamped mode.

    Raises
    ------
    MjcontError, NameLookupError, ParameterError
        If the point is no equilibrium, a name is unknown, the input cannot move in time, an actuator has a state of
        its own, or a frequency is not positive.
    """
    check_point(point)
    model, values = point.model, dict(point.parameters)
    check_forcing(model, {input: Harmonic(1.0)})
    if isinstance(model, Mechanism) and has_activations(model):
        raise MjcontError(f"{model.name}: an actuator has a state of its own (a filter, muscle or integrator), which "
                          "M, C and K leave out: make it a motor")
    pencil, rates = linearized(point, (input,))
    names = tuple(dict.fromkeys([output] if isinstance(output, str) else output or model.observables))
    if not names:
        raise MjcontError("name at least one output")
    units = {n: model.observable(n).unit for n in names} | {input: model.parameter(input).unit}
    s, _ = vibration(pencil)
    hertz = _checked(frequencies) if frequencies is not None else _around(np.abs(s.imag[s.imag > 0]) / (2.0 * np.pi))
    omega = 2.0 * np.pi * hertz
    moved = frequency_response(pencil, omega, rates[:, 0])
    found = np.empty((len(hertz), len(names)), complex)
    in_state, in_speed, direct = _readings(model, point.state, values, names, input)
    for i in range(len(names)):
        found[:, i] = moved @ in_state[i] + 1j * omega * (moved @ in_speed[i]) + direct[i]
    return Transfer(point, input, names, hertz, found, point.stability == "stable", units, notes_of(point))


def _checked(frequencies: Sequence[float] | Array) -> Array:
    found = np.atleast_1d(np.asarray(frequencies, float))
    if found.ndim != 1 or not len(found) or not (np.isfinite(found).all() and (found > 0).all()):
        raise ParameterError("frequencies must be positive numbers, in Hz, at least one")
    return np.unique(found)


def _around(modes: Array) -> Array:
    """Return frequencies around those of the modes that swing, or around 1 Hz."""
    low, high = (modes.min(), modes.max()) if len(modes) else (1.0, 1.0)
    return np.unique(np.concatenate([np.geomspace(low / _BEYOND, high * _BEYOND, _COUNT), modes]))


def _readings(
    model: Model, x: Array, values: dict[str, float], names: Sequence[str], driver: str
) -> tuple[Array, Array, Array]:
    """Return derivatives of observables in the state (k, n), in velocities (k, n), and in the input (k,)."""
    scale, steps = model.state_scale, jacobian_steps(model.state_scale, FOURTH_ORDER)
    states = np.array([model.retract(x, s) for s in steps])
    in_state = jacobian_from_rows(model.measure(states, values, names), scale, FOURTH_ORDER)
    in_speed = np.zeros_like(in_state)
    if isinstance(model, Mechanism):
        measured = model.measure(np.broadcast_to(x, (len(steps), len(x))), values, names, steps)
        in_speed = jacobian_from_rows(measured, scale, FOURTH_ORDER)
    parameter = model.parameter(driver)
    h = PARAMETER.step * max(abs(values[driver]), 1e-2 * (parameter.bounds[1] - parameter.bounds[0]))
    swung = [{**values, driver: values[driver] + o * h} for o in PARAMETER.offsets]
    rows = model.measure(np.broadcast_to(x, (len(swung), len(x))), swung, names)
    return in_state, in_speed, np.asarray(PARAMETER.weights) @ rows / h
