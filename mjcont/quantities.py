"""What parameters and observables are, apart from any model: names, units, values, and what they act on."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mjcont.numerics.differences import CENTRED, PARAMETER, Stencil

# fields in which the forces are affine, so that two points give an exact derivative
_AFFINE = frozenset(
    {
        "ctrl",
        "jnt_stiffness",
        "dof_damping",
        "qpos_spring",
        "tendon_stiffness",
        "tendon_damping",
        "actuator_biasprm",
        "actuator_gainprm",
    }
)
_PRODUCTS = ({"jnt_stiffness", "qpos_spring"}, {"ctrl", "actuator_gainprm"})


@dataclass(frozen=True, slots=True)
class Target:
    """Entries `index` of the flattened model field `field`, set to offset + factor * value.

    `derives` says whether MuJoCo must recompute derived constants when they change.
    """

    field: str
    index: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0
    path: str = ""
    derives: bool = False


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named scalar that acts on the model.

    Attributes
    ----------
    name, unit : str
    value : float
        Its value in the loaded model (SI, radians).
    bounds : tuple of float
        Where the parameter makes sense; the default range of a continuation.
    kind : {"control", "gravity", "field", "spec"}
    targets : tuple of Target
        Empty for gravity_angle and load_factor, which act together on the gravity vector, and for "spec".
    hard_bounds : tuple of float
        A control's range in MuJoCo, outside which it would be clamped.
    edit : callable, optional
        Of kind "spec": writes a value into a copy of the model's spec, which is then compiled.
    source : str
        Of kind "spec": its paths, or its function's name.
    is_function : bool
        Whether `edit` is a user's function, not made from paths.
    touched : frozenset
        Of kind "spec": the entries of the compiled model that change with it.
    """

    name: str
    unit: str
    value: float
    bounds: tuple[float, float]
    kind: str
    targets: tuple[Target, ...] = ()
    hard_bounds: tuple[float, float] = (-math.inf, math.inf)
    edit: Callable[[Any, float], None] | None = None
    source: str = ""
    is_function: bool = False
    touched: frozenset[tuple[str, int]] = frozenset()

    @property
    def cost(self) -> str:
        """What a change of value costs: "nothing", "field", "field + constants" or "recompile"."""
        if self.kind == "spec":
            return "recompile"
        if self.kind == "control":
            return "nothing"
        return "field + constants" if self.needs_constants else "field"

    @property
    def acts_on(self) -> str:
        """What it acts on, in words or as paths."""
        if self.kind == "field":
            return " ".join(t.path for t in self.targets)
        return self.source or self.kind

    @property
    def affine(self) -> bool:
        """Whether the generalised forces are affine in the parameter."""
        fields = {t.field for t in self.targets}
        return bool(fields) and fields <= _AFFINE and not any(pair <= fields for pair in _PRODUCTS)

    @property
    def entries(self) -> frozenset[tuple[str, int]]:
        """The entries of model fields on which it acts."""
        if self.kind == "gravity":
            return frozenset({("opt.gravity", i) for i in range(3)})
        if self.kind == "spec":
            return self.touched
        found = {(t.field, i) for t in self.targets for i in t.index}
        scaled = {("body_inertia", 3 * i + k) for field, i in found if field == "body_mass" for k in range(3)}
        return frozenset(found | scaled)

    @property
    def needs_constants(self) -> bool:
        """Whether MuJoCo must recompute derived constants when the parameter changes."""
        return any(t.derives for t in self.targets)


def difference_rule(parameter: Parameter, value: float, span: float | None = None) -> tuple[Stencil, float]:
    """Return the difference rule and step for derivatives in a parameter of a model.

    Forces are affine in controls, stiffnesses and the like, where two points are exact for any step. Elsewhere there
    are four: a parameter of the spec costs as many compilations.
    """
    size = max(abs(value), 1e-2 * (span or parameter.bounds[1] - parameter.bounds[0]))
    if parameter.affine:
        return CENTRED, max(1.0, abs(value)) if parameter.kind == "control" else 0.1 * size
    if parameter.unit == "rad":
        return PARAMETER, min(PARAMETER.step, PARAMETER.step * size * 100.0)
    return PARAMETER, PARAMETER.step * size


@dataclass(frozen=True, slots=True)
class Observable:
    """A named scalar read from a state: `function(model, data)` for a Mechanism, in `unit`."""

    name: str
    unit: str
    function: Callable[[Any, Any], float]


def default_bounds(value: float, unit: str = "") -> tuple[float, float]:
    """Return a range for a parameter that states none: a decade around a positive value."""
    if unit == "rad":
        return (-math.pi, math.pi)
    if value > 0:
        return (0.1 * value, 10.0 * value)
    return (-1.0, 1.0) if value == 0 else (10.0 * value, 0.1 * value)
