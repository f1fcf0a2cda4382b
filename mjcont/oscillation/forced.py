"""Forcing: parameters of a model that are periodic in time.

    p(t) = p + sum of amplitude cos(2 pi harmonic t / T + phase),   T = 1 / frequency

A driven parameter's own value is the mean. Beside it stand the parameters `frequency` (Hz), `NAME.amplitude` and
`NAME.phase`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.numerics.equations.problem import Array, Values
from mjcont.results.model import Model
from mjcont.results.quantities import Parameter, default_bounds, finite

FREQUENCY = "frequency"


@dataclass(frozen=True, slots=True)
class Harmonic:
    """A harmonic input, amplitude cos(2 pi harmonic t / T + phase), added to the parameter's own value.

    Attributes
    ----------
    amplitude : in the parameter's unit.
    phase : rad.
    harmonic : how many of its periods make one of the forcing.
    """

    amplitude: float
    phase: float = 0.0
    harmonic: int = 1

    def __post_init__(self) -> None:
        finite("a harmonic's amplitude", self.amplitude)
        finite("a harmonic's phase", self.phase)
        if isinstance(self.harmonic, bool) or not isinstance(self.harmonic, int) or self.harmonic < 1:
            raise ParameterError(f"harmonic must be a whole number, 1 or more, got {self.harmonic!r}")


@dataclass(frozen=True, slots=True)
class Forcing:
    """What drives a model: harmonics by parameter, and the parameters that they bring.

    Attributes
    ----------
    inputs : by the name of the driven parameter.
    periods : periods of the forcing in one of the motion: 2 after a period doubling.
    """

    inputs: Mapping[str, Harmonic]
    parameters: Mapping[str, Parameter]
    periods: int = 1

    def period(self, values: Values) -> float:
        """Return the period of the motion, s."""
        return self.periods / values[FREQUENCY]

    def period_rate(self, values: Values, name: str) -> float:
        """Return the derivative of the period in a parameter."""
        return -self.periods / values[FREQUENCY] ** 2 if name == FREQUENCY else 0.0

    def driven(self, phases: Array, values: Values) -> dict[str, Array]:
        """Return the values of the driven parameters at phases (m,), (m,) each."""
        angle = 2.0 * math.pi * self.periods * phases
        return {
            name: values[name] + values[f"{name}.amplitude"] * np.cos(h.harmonic * angle + values[f"{name}.phase"])
            for name, h in self.inputs.items()
        }

    def record(self) -> dict[str, Any]:
        """Return what files keep of it."""
        inputs = {n: [h.amplitude, h.phase, h.harmonic] for n, h in self.inputs.items()}
        return {"inputs": inputs, "periods": self.periods}


def check_forcing(model: Model, given: Any) -> dict[str, Harmonic]:
    """Return the harmonics by parameter.

    Raises
    ------
    ParameterError, NameLookupError
        If there are none, one is no `Harmonic`, its parameter unknown or one that cannot move in time.
    """
    if not isinstance(given, Mapping) or not given:
        raise ParameterError('forcing must name at least one input, such as {"F": mc.Harmonic(5.0)}')
    for name, h in given.items():
        parameter = model.parameter(name)
        if not isinstance(h, Harmonic):
            raise ParameterError(f"forcing of '{name}' must be a Harmonic, got {type(h).__name__}")
        if parameter.kind in ("spec", "switch"):
            what = "geometry, with which the model is compiled" if parameter.kind == "spec" else "a switch"
            raise ParameterError(f"'{name}' is {what}: it cannot move in time")
    return dict(given)


def make_forcing(model: Model, inputs: Mapping[str, Harmonic], frequency: float | None, periods: int = 1) -> Forcing:
    """Return the forcing of a model at a frequency, in Hz.

    Raises
    ------
    ParameterError
        If a parameter of the model has the name of one that the forcing brings.
    """
    own = {FREQUENCY: Parameter(FREQUENCY, "Hz", frequency or 1.0, default_bounds(frequency or 1.0), "forcing",
                                hard_bounds=(1e-12, math.inf), limit="the positive numbers {range}")}
    for name, h in inputs.items():
        unit = model.parameter(name).unit
        own[f"{name}.amplitude"] = Parameter(f"{name}.amplitude", unit, h.amplitude, default_bounds(h.amplitude),
                                             "forcing")
        own[f"{name}.phase"] = Parameter(f"{name}.phase", "rad", h.phase, default_bounds(h.phase, "rad"), "forcing")
    for name in own:
        if name in model.parameters:
            raise ParameterError(
                f"the model has a parameter '{name}', which the forcing needs for itself: rename it where it is "
                f"declared, such as to '{name}_0'"
            )
    return Forcing(dict(inputs), own, periods)


def check_inputs(model: Model, forcing: Forcing, values: Values) -> None:
    """Raise a BoundsError where a driven parameter leaves its range within a period."""
    for name in forcing.inputs:
        low, high = model.parameter(name).hard_bounds
        swing = abs(values[f"{name}.amplitude"])
        mean = values[name]
        if mean - swing < low or mean + swing > high:
            raise BoundsError(
                f"input '{name}' moves between {mean - swing:g} and {mean + swing:g}, outside "
                f"{model.parameter(name).limits}"
            )


def split(given: Values, forcing: Forcing | None) -> tuple[dict[str, float], dict[str, float]]:
    """Return the values of the model's parameters, and those of the forcing's."""
    own = {} if forcing is None else {n: float(v) for n, v in given.items() if n in forcing.parameters}
    return {n: float(v) for n, v in given.items() if n not in own}, own


def forcing_parameter(model: Model, forcing: Forcing | None, name: str) -> Parameter:
    """Return a parameter of the forcing, or of the model."""
    if forcing is not None and name in forcing.parameters:
        return forcing.parameters[name]
    if forcing is not None and ":" not in name and name not in model.parameters:
        raise unknown_name("parameter", name, [*model.parameters, *forcing.parameters])
    return model.parameter(name)
