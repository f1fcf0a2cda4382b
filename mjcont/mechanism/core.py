"""The models that a Mechanism works on, and what evaluates them: one core in each thread, for it and its copies."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import partial

import mujoco
import numpy as np

from mjcont.mechanism.batches import ModelVariants
from mjcont.mechanism.derivatives import Derivatives
from mjcont.mechanism.evaluation import Evaluator
from mjcont.mechanism.geometry import Geometry
from mjcont.mechanism.large.couplings import couplings
from mjcont.mechanism.observables import Readings
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.features import touching
from mjcont.numerics.equations.problem import Array
from mjcont.outside.memory import give_back
from mjcont.results.text import ParameterTable

_DISABLE = mujoco.mjtDisableBit


class Core:
    """One model in three copies: as loaded, for residuals, for observables.

    Parameters
    ----------
    model : MjModel
        With the layout that the parameters need; taken over.
    moved : moves states (m, nq) by tangent steps (m, nv).
    evaluations : where to begin to count.

    Attributes
    ----------
    loaded, model : MjModel
        As loaded, and the private copy on which residuals are evaluated.
    writer, evaluator, derivatives : of that copy.
    variants : evaluates many variants on copies of its own.
    readings : reads observables from a third copy.
    nonsmooth : whether the forces are smooth in pieces only.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        parameters: ParameterTable,
        geometry: Geometry,
        constrained: bool,
        scale: Array,
        moved: Callable[[Array, Array], Array],
        evaluations: int = 0,
    ) -> None:
        give_back()  # what earlier ones held
        self.parameters, self.geometry = parameters, geometry
        self.loaded, self.model = copy_model(model), evaluation_copy(model)
        self.writer = self.writer_of(self.model)
        self.readings = Readings(model, self.parameters, self.writer_of(model), constrained)
        self.evaluator = Evaluator(self.model, self.writer, constrained, evaluations)
        self.nonsmooth = self.evaluator.nonsmooth
        sparse = couplings(self.model) if self.evaluator.structured else None
        self.derivatives = Derivatives(self.evaluator, self.writer, parameters, scale, moved, sparse)
        fresh = partial(_fresh, self.loaded, parameters, geometry)
        self.variants = ModelVariants(fresh, self.loaded.nbuffer, parameters, self.evaluator.counted)

    def writer_of(self, model: mujoco.MjModel) -> FieldWriter:
        """Return what writes parameter values into a copy of the model."""
        return FieldWriter(model, self.parameters, self.geometry)

    def as_loaded(self) -> mujoco.MjModel:
        """Return the model on which residuals are evaluated, every parameter at the model's own value."""
        self.writer.write(self.parameters, {name: p.value for name, p in self.parameters.items()})
        return self.model


def _fresh(
    loaded: mujoco.MjModel, parameters: ParameterTable, geometry: Geometry
) -> tuple[mujoco.MjModel, FieldWriter]:
    """Return another copy on which residuals are evaluated, and its writer."""
    model = evaluation_copy(copy_model(loaded))
    return model, FieldWriter(model, parameters, geometry)


def copy_model(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy that can be edited freely."""
    return copy.copy(model)


def owned_copy(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy without the control ranges that the model itself does not clamp: they are no limits."""
    own = copy_model(model)
    if model.opt.disableflags & _DISABLE.mjDSBL_CLAMPCTRL:
        own.actuator_ctrllimited[:] = 0
    return own


def evaluation_copy(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return the private copy on which residuals are evaluated.

    Its integrator is one for which qacc is the forward-dynamics acceleration, its solver is not cut short for speed,
    sensors are off, and controls are never clamped (bounds outside a ctrlrange are refused before). Controls have
    reached their actuators, and dry friction is off. `model` itself, which observables are read from, loses what delays
    controls and filters sensors; forces are read with such an integrator, too.
    """
    model.actuator_delay[:] = 0.0
    discrete = model.opt.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    private = copy_model(model)
    # time histories with "discrete" clamp no equality's time constant, those with other integrators do
    if np.any((model.eq_solref[:, 0] > 0) & (model.eq_solref[:, 0] < 2.0 * model.opt.timestep)):
        if discrete:
            private.opt.disableflags |= int(_DISABLE.mjDSBL_REFSAFE)
    private.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_INVDISCRETE)
    private.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE  # sparse constraint Jacobians are wrong in MuJoCo 4.0.0
    private.opt.disableflags |= int(_DISABLE.mjDSBL_SENSOR) | int(_DISABLE.mjDSBL_CLAMPCTRL)
    private.opt.disableflags |= int(_DISABLE.mjDSBL_FRICTIONLOSS)
    private.opt.iterations = max(private.opt.iterations, 100)
    private.opt.ls_iterations = max(private.opt.ls_iterations, 50)
    without_sensor_filters(model)
    return private


def simulation_copy(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a private copy for time histories; diverging motion is not reset silently."""
    private = copy_model(model)
    private.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE  # as in `evaluation_copy`
    private.opt.disableflags |= int(_DISABLE.mjDSBL_AUTORESET) | int(_DISABLE.mjDSBL_SENSOR)
    return private


def is_constrained(model: mujoco.MjModel) -> bool:
    """Return whether equality constraints, limits or contacts can act in the model."""
    off = int(model.opt.disableflags)
    if off & _DISABLE.mjDSBL_CONSTRAINT:
        return False
    equality = bool(model.neq) and not off & _DISABLE.mjDSBL_EQUALITY
    limits = bool(model.jnt_limited.any() or model.tendon_limited.any()) and not off & _DISABLE.mjDSBL_LIMIT
    contact = not off & _DISABLE.mjDSBL_CONTACT and (model.npair > 0 or any(True for _ in touching(model)))
    return equality or limits or contact


def without_sensor_filters(model: mujoco.MjModel) -> None:
    """Remove cut-off, noise and delay from a model of our own."""
    for field in ("sensor_cutoff", "sensor_noise", "sensor_delay"):
        if hasattr(model, field):
            np.asarray(getattr(model, field))[...] = 0.0
