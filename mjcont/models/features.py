"""What a model has that cannot be treated, and is refused, or that is treated in a way its user should know of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice

import mujoco
import numpy as np

from mjcont.errors import ModelError, ModelWarning, ParameterError, warn
from mjcont.models.actuators import actuator_name, follower, integrator
from mjcont.models.numbers import refuse_invalid
from mjcont.models.sources import MOST_FREEDOMS
from mjcont.models.states import element_name
from mjcont.results.quantities import FRICTION

_DISABLE = mujoco.mjtDisableBit
_OBJ = mujoco.mjtObj
_SHOWN = 6


def refuse_unsupported(model: mujoco.MjModel) -> None:
    """Raise a ModelError for features whose equilibria this version cannot compute, saying what to do instead."""
    if model.nv == 0:
        raise ModelError("the model has no degree of freedom, so nothing in it can find a place to rest: add a joint")
    refuse_invalid(model)
    if model.nv > MOST_FREEDOMS:
        raise ModelError(
            f"the model has {model.nv} degrees of freedom: mjcont keeps matrices of that size in full, "
            f"{8e-9 * model.nv**2:.1f} GB each, and takes at most {MOST_FREEDOMS}"
        )
    if model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP:
        raise ModelError('sleeping bodies make equilibria path dependent: remove <flag sleep="enable"/>')
    if np.any(model.jnt_springyield > 0) or np.any(model.tendon_springyield > 0):
        raise ModelError("plastic springs (springyield) make equilibria path dependent: set springyield to 0")
    for actuator in range(model.nactuator):
        _refuse_actuator(model, actuator)
    for plugin in np.flatnonzero(model.plugin_statenum > 0):
        name = mujoco.mj_id2name(model, _OBJ.mjOBJ_PLUGIN, int(plugin)) or f"plugin{plugin}"
        raise ModelError(f"plugin '{name}' has states of its own, whose rest is unknown: remove it from the model")


def _refuse_actuator(model: mujoco.MjModel, actuator: int) -> None:
    dyn, name = mujoco.mjtDyn, actuator_name(model, actuator)
    kind = dyn(model.actuator_dyntype[actuator])
    gain = mujoco.mjtGain(model.actuator_gaintype[actuator])
    bias = mujoco.mjtBias(model.actuator_biastype[actuator])
    if kind == dyn.mjDYN_USER or gain == mujoco.mjtGain.mjGAIN_USER or bias == mujoco.mjtBias.mjBIAS_USER:
        raise ModelError(
            f"actuator '{name}' is of type user: its law is in a callback that the model does not carry. "
            "Use one of MuJoCo's own types, or continue its force as a parameter: make it a motor"
        )
    if model.actuator_actnum[actuator] == 0 or follower(model, actuator) or integrator(model, actuator):
        return
    if kind == dyn.mjDYN_PID:
        raise ModelError(
            f"actuator '{name}' (pid) has a state: an integral, which at rest is whatever holds the setpoint, or a "
            "limited setpoint. Set ki and slewmax to 0, which leaves a position servo, or fix the joint by an equality"
        )
    if kind == dyn.mjDYN_DCMOTOR:
        raise ModelError(
            f"actuator '{name}' (dcmotor) has electrical, thermal, friction or controller states, whose rest depends "
            "on the motion. Leave out what makes them (inductance, thermal, lugre, integral gain): it is then static"
        )
    raise ModelError(
        f"actuator '{name}' has activation states of its own (a plugin's, or more than one), whose rest is unknown: "
        "leave out what makes them, or make it a motor or a position servo"
    )


def passive(model: mujoco.MjModel) -> bool:
    """Whether velocities at rest meet dampers only: on joints, on tendons, along actuators.

    The damping matrix is then a sum of c J'J with c >= 0, symmetric and positive semidefinite in every state.
    """
    dampers = (model.dof_damping, model.tendon_damping, model.actuator_damping)
    plain = np.all(model.actuator_gaintype == int(mujoco.mjtGain.mjGAIN_FIXED)) and not model.na
    none = model.actuator_biastype == int(mujoco.mjtBias.mjBIAS_NONE)
    resisting = np.all(none | (_affine_bias(model) & (model.actuator_biasprm[:, 2] <= 0)))
    return bool(plain and resisting and explicit_damping(model) and all(np.all(d >= 0) for d in dampers))


def _affine_bias(model: mujoco.MjModel) -> np.ndarray:
    return model.actuator_biastype == int(mujoco.mjtBias.mjBIAS_AFFINE)


def explicit_damping(model: mujoco.MjModel) -> bool:
    """Whether the resistance to velocities at rest is known in closed form (see `dampers`)."""
    gains = [int(g) for g in (mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtGain.mjGAIN_AFFINE, mujoco.mjtGain.mjGAIN_MUSCLE)]
    laws = [int(b) for b in (mujoco.mjtBias.mjBIAS_NONE, mujoco.mjtBias.mjBIAS_AFFINE, mujoco.mjtBias.mjBIAS_MUSCLE)]
    known = np.all(np.isin(model.actuator_gaintype, gains)) and np.all(np.isin(model.actuator_biastype, laws))
    elsewhere = model.opt.density or model.opt.viscosity or model.nplugin or model.nflex
    return bool(known and not elsewhere and np.all(model.actuator_outnum == 1) and not _polynomials(model))


def linear_in_velocity(model: mujoco.MjModel) -> bool:
    """Whether forces are linear in velocity on each smooth piece, so that steps of unit speed are exact."""
    linear = [int(g) for g in (mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtGain.mjGAIN_AFFINE)]
    laws = _affine_bias(model) | (model.actuator_biastype == int(mujoco.mjtBias.mjBIAS_NONE))
    straight = np.all(np.isin(model.actuator_gaintype, linear)) and np.all(laws)
    return bool(straight and not (model.opt.density or model.nplugin or _polynomials(model)))


def _polynomials(model: mujoco.MjModel) -> bool:
    """Whether a damper has higher powers of the velocity."""
    return any(p.any() for p in (model.dof_dampingpoly, model.tendon_dampingpoly, model.actuator_dampingpoly))


def friction_notes(model: mujoco.MjModel, friction: str) -> list[str]:
    """Return what is to be said about friction, warning of friction that is left out.

    Raises
    ------
    ModelError
        If `friction` is "refuse" and there is any.
    ParameterError
        If `friction` is no valid choice.
    """
    if not isinstance(friction, str) or friction not in FRICTION:
        raise ParameterError(f"unknown friction '{friction}'. Valid: {', '.join(FRICTION)}.")
    notes = []
    dry, contacts = list(_with_dry_friction(model)), list(islice(_with_contact_friction(model), _SHOWN + 1))
    if dry:
        what = f"dry friction (frictionloss of {_listing(dry)}) carries no load at rest in MuJoCo, where it creeps"
        if friction == "refuse":
            raise ModelError(
                f"{what}: rest under friction is no equilibrium. Remove it, or take the model without it "
                '(friction="frictionless")'
            )
        notes.append(f"{what}: equilibria and their stability are those without it; time histories keep it")
        warn(notes[-1], ModelWarning)
    if contacts:
        what = f"friction of contacts ({_listing(contacts)}) carries no load at rest in MuJoCo, where it creeps"
        if friction == "refuse":
            raise ModelError(
                f"{what}: rest under friction is no equilibrium. Give these geoms condim 1, or take the model without "
                'contact friction (friction="frictionless")'
            )
        notes.append(f"{what}: equilibria and their stability are those without it; time histories keep it")
    return notes


def activation_notes(model: mujoco.MjModel) -> list[str]:
    """Return what is to be said about actuators that have a state."""
    actuators = range(model.nactuator)
    following = [actuator_name(model, a) for a in actuators if follower(model, a)]
    integrated = [actuator_name(model, a) for a in actuators if integrator(model, a)]
    notes = []
    if following:
        notes.append(f"at rest the activation of {_listing(following)} equals the control; its own decay is stable")
    if integrated:
        notes.append(
            f"at rest the control of {_listing(integrated)} is zero and its integral stays as it is: the parameter of "
            "that name is the integral (the setpoint)"
        )
    return notes


def _listing(names: list[str]) -> str:
    more = " and others" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


def _with_dry_friction(model: mujoco.MjModel) -> Iterator[str]:
    """Return the joints and tendons with friction loss that acts."""
    if model.opt.disableflags & (_DISABLE.mjDSBL_CONSTRAINT | _DISABLE.mjDSBL_FRICTIONLOSS):
        return
    for j in dict.fromkeys(int(j) for j in model.dof_jntid[model.dof_frictionloss > 0]):
        yield f"joint {element_name(model, _OBJ.mjOBJ_JOINT, j)}"
    for t in np.flatnonzero(model.tendon_frictionloss > 0):
        yield f"tendon {element_name(model, _OBJ.mjOBJ_TENDON, int(t))}"


def _with_contact_friction(model: mujoco.MjModel) -> Iterator[str]:
    """Return the pairs of geoms that could touch with friction."""
    if model.opt.disableflags & (_DISABLE.mjDSBL_CONSTRAINT | _DISABLE.mjDSBL_CONTACT):
        return
    for p in range(model.npair):
        if model.pair_dim[p] > 1 and model.pair_friction[p].any():
            yield _pair(model, int(model.pair_geom1[p]), int(model.pair_geom2[p]))
    for i, j in touching(model):
        first, second = int(model.geom_priority[i]), int(model.geom_priority[j])
        deciding = [i, j] if first == second else [i if first > second else j]
        if model.geom_condim[deciding].max() > 1 and model.geom_friction[deciding].any():
            yield _pair(model, i, j)


def touching(model: mujoco.MjModel) -> Iterable[tuple[int, int]]:
    """Return the pairs of geoms of different bodies that could collide, parent and child apart."""
    kind, affinity, body = model.geom_contype, model.geom_conaffinity, model.geom_bodyid
    parent = model.body_parentid
    for i in range(model.ngeom):
        for j in range(i):
            a, b = model.body_weldid[body[i]], model.body_weldid[body[j]]
            related = a == b or (a and b and (parent[a] == b or parent[b] == a))
            if not related and (kind[i] & affinity[j] or kind[j] & affinity[i]):
                yield i, j


def _pair(model: mujoco.MjModel, i: int, j: int) -> str:
    return f"{element_name(model, _OBJ.mjOBJ_GEOM, j)} on {element_name(model, _OBJ.mjOBJ_GEOM, i)}"
