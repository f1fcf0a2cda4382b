"""What a Mechanism computes with: models that are written to, and so belong to one thread each."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import Any, Self

import mujoco

from mjcont import loading, travel
from mjcont.derivatives import Derivatives
from mjcont.evaluation import Evaluator
from mjcont.readings import Readings
from mjcont.writer import FieldWriter


class Machinery:
    """The models of one thread: one copy for residuals, one for observables, with what evaluates them.

    Parameters
    ----------
    mechanism : Mechanism
        Whose parameters are written; its copies with held modes share them.
    loaded : mujoco.MjModel
        The model as loaded, never changed.
    evaluations : int
        Where to begin to count.
    """

    __slots__ = ("derivatives", "evaluator", "loaded", "model", "readings", "writer")

    def __init__(self, mechanism: Any, loaded: mujoco.MjModel, evaluations: int) -> None:
        m, shown = mechanism, loading.copy_model(loaded)
        self.loaded = loaded
        self.model = loading.evaluation_copy(shown)
        self.writer = m.writer(self.model)
        self.readings = Readings(shown, m.parameters, m.writer(shown), m.constrained)
        self.evaluator = Evaluator(self.model, self.writer, m.constrained, evaluations)
        self.derivatives = Derivatives(self.evaluator, self.writer, m.parameters, m.state_scale, m.retract_each)


class _OfThread(threading.local):
    """A place that each thread finds filled with a machinery of its own."""

    def __init__(self, make: Callable[[], Machinery]) -> None:
        self.machinery = make()


class Shared:
    """What a Mechanism and its copies with held modes have in common.

    Attributes
    ----------
    here : holds the machinery of the thread that asks.
    lock : held while a parameter is declared.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.here: Any = None

    def own(self, mechanism: Any, model: mujoco.MjModel, evaluations: int = 0) -> None:
        """Take a model: every thread makes its machinery from a copy, the calling one at once."""
        loaded, caller = loading.copy_model(model), threading.get_ident()

        def make() -> Machinery:
            return Machinery(mechanism, loaded, evaluations if threading.get_ident() == caller else 0)

        self.here = _OfThread(make)


class Machined:
    """A Mechanism as the owner of its machinery: any thread may use it, and finds models of its own."""

    parameters: Any
    observables: Any
    declared: Any
    _shared: Shared

    @property
    def _loaded(self) -> mujoco.MjModel:
        return self._shared.here.machinery.loaded

    @property
    def _model(self) -> mujoco.MjModel:
        return self._shared.here.machinery.model

    @property
    def _writer(self) -> FieldWriter:
        return self._shared.here.machinery.writer

    @property
    def _readings(self) -> Readings:
        return self._shared.here.machinery.readings

    @property
    def _evaluator(self) -> Evaluator:
        return self._shared.here.machinery.evaluator

    @property
    def _derivatives(self) -> Derivatives:
        return self._shared.here.machinery.derivatives

    @property
    def nonsmooth(self) -> bool:
        """Whether the forces are smooth in pieces only."""
        return self._evaluator.nonsmooth

    def copy(self) -> Self:
        """Return a mechanism of its own: what is declared or observed on one is not on the other."""
        other = copy.copy(self)
        other.parameters, other.observables = copy.copy(self.parameters), dict(self.observables)
        other.declared, other._shared = dict(self.declared), Shared()
        other._shared.own(other, self._loaded)
        return other

    def __copy__(self) -> Self:
        """Return what shares everything with this one but attributes set from now on."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to other processes as MJCF (or a compiled model), with what was declared beside it."""
        return travel.packed(self)
