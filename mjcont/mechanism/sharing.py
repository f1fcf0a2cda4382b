"""A Mechanism in several threads and processes: a core for each thread, and what pickle makes one from again."""

from __future__ import annotations

import copy
import threading
import warnings
from collections.abc import Callable, Mapping
from typing import Any, Self

import mujoco

from mjcont.mechanism.core import Core, copy_model, simulation_copy
from mjcont.mechanism.geometry import Geometry
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.manifold import Manifold
from mjcont.numerics.equations.problem import Array
from mjcont.results.quantities import Observable, Parameter
from mjcont.results.text import ParameterTable


class Cores:
    """The cores of a Mechanism and of its copies with held modes: models that are written to belong to one thread.

    Attributes
    ----------
    lock : held while a parameter is declared.
    """

    def __init__(self, make: Callable[[mujoco.MjModel, int], Core], model: mujoco.MjModel) -> None:
        self.lock, self._make = threading.RLock(), make
        self._take(model, 0)

    def _take(self, model: mujoco.MjModel, evaluations: int) -> None:
        places = threading.local()
        places.core = self._make(copy_model(model), evaluations)
        self._model, self._places = model, places

    @property
    def here(self) -> Core:
        """The core of the thread that asks, made when it asks first."""
        places = self._places
        core: Core | None = getattr(places, "core", None)
        if core is None:
            core = places.core = self._make(copy_model(self._model), 0)
        return core

    def relayout(self) -> None:
        """Take models of the layout that compiled ones have: a parameter of the spec was declared."""
        core = self.here
        if core.loaded.body_simple.any():
            self._take(core.geometry.with_layout(core.loaded, core.parameters), core.evaluator.count)


class Shareable:
    """A Mechanism as the owner of cores: any thread may use it, and pickle takes it to other processes.

    It travels as MJCF, with what was declared beside it.
    """

    parameters: ParameterTable
    observables: dict[str, Observable]
    declared: dict[str, Any]
    mjcf: str | None
    constrained: bool
    state_scale: Array
    declare: Callable[..., Parameter]
    _manifold: Manifold
    _friction: str
    _held: tuple[str, ...]
    _cores: Cores

    def _own(self, model: mujoco.MjModel, geometry: Geometry) -> None:
        """Take a model: every thread makes a core from a copy, the calling one at once."""
        # none of these knows the mechanism: what it holds is free as soon as nothing refers to it
        parameters, constrained, scale = self.parameters, self.constrained, self.state_scale
        moved = self._manifold.retract_each

        def make(own: mujoco.MjModel, evaluations: int) -> Core:
            return Core(own, parameters, geometry, constrained, scale, moved, evaluations)

        self._cores = Cores(make, geometry.with_layout(copy_model(model), self.parameters))

    @property
    def _core(self) -> Core:
        return self._cores.here

    @property
    def nonsmooth(self) -> bool:
        """Whether the forces are smooth in pieces only."""
        return self._core.nonsmooth

    @property
    def failure(self) -> str:
        """Why the model does not compile at the values evaluated last; empty where it does."""
        core = self._core
        return core.writer.failure or core.derivatives.failure

    @property
    def evaluations(self) -> int:
        """Forward evaluations so far, by this thread; every row of a batch counts as one."""
        return self._core.evaluator.count

    def simulation_model(self) -> mujoco.MjModel:
        """Return a copy of the model as loaded, for time histories; diverging motion is not reset silently."""
        return simulation_copy(self._core.loaded)

    def writer(self, model: mujoco.MjModel) -> FieldWriter:
        """Return what writes parameter values into a copy of the model."""
        return self._core.writer_of(model)

    def copy(self) -> Self:
        """Return a mechanism of its own: what is declared or observed on one is not on the other."""
        other = copy.copy(self)
        other.parameters, other.observables = copy.copy(self.parameters), dict(self.observables)
        other.declared = dict(self.declared)
        other._own(self._core.loaded, self._core.geometry.anew())
        return other

    def __copy__(self) -> Self:
        """Return what shares everything with this one but attributes set from now on."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel as MJCF, or as a compiled model; Python functions travel as pickle takes them, by name."""
        functions = {n: self.parameters[n].edit for n, given in self.declared.items() if "function" in given}
        observed = {n: o for n, o in self.observables.items() if o.source is None}
        model = self._core.loaded if self.mjcf is None else self.mjcf
        return _again, (type(self), model, self._friction, dict(self.declared), functions, observed, self._held)

    def declare_again(
        self, declared: Mapping[str, Any], functions: Mapping[str, Callable[[Any, float], None]] | None = None
    ) -> None:
        """Declare what `declared` of another mechanism says, where it is not known yet; functions are given beside it.

        Raises
        ------
        ParameterError
            If a path matches nothing here.
        """
        for name, given in declared.items():
            if name in self.parameters:
                continue
            how = {"unit": given["unit"], "bounds": tuple(given["bounds"])}
            if "function" in given:
                self.declare(name, function=(functions or {})[name], value=given["value"], **how)
            else:
                self.declare(name, *given["paths"], **how)


def _again(
    kind: Any, model: Any, friction: str, declared: Mapping[str, Any],
    functions: Mapping[str, Callable[[Any, float], None]], observed: Mapping[str, Observable], held: tuple[str, ...],
) -> Any:
    """Return the mechanism that was pickled."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # said when it was made first
        make = kind.from_xml if isinstance(model, str) else kind.from_model
        mechanism = make(model, friction=friction)
    mechanism.declare_again(declared, functions)
    mechanism.observables.update(observed)
    return mechanism.holding(held) if held else mechanism
