"""Equality constraints as the springs that they are at rest: stiffness, damping, and what these depend on.

With the impedance d(r), the reference constants k, b and A the sum of the inverse weights of what the constraint joins,
MuJoCo's force on the residual r of a constraint at acceleration zero is

    -K r - C r',   K = k d^2 / ((1 - d) A),   C = b d / ((1 - d) A),

and its dependence on the acceleration adds the mass d / ((1 - d) A). A weld's rotation by the angle t has the residual
s sin(t / 2), s its torquescale, so that its torque is K s^2 sin(t) / 4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import ParameterError
from mjcont.models.impedance import impedance, is_constant, least_time_constant, reference_constants, standard_form
from mjcont.models.quiet import quiet, quiet_data
from mjcont.results.quantities import Target

_EQ, _OBJ = mujoco.mjtEq, mujoco.mjtObj
KINDS = {_EQ.mjEQ_CONNECT: "connect", _EQ.mjEQ_WELD: "weld", _EQ.mjEQ_JOINT: "joint", _EQ.mjEQ_TENDON: "tendon"}
ROTATION = "weld rotation"
_UNITS = {"N/m": ("m", "N*s/m", "kg"), "N*m/rad": ("rad", "N*m*s/rad", "kg*m^2")}


@dataclass(frozen=True, slots=True)
class ConstraintStiffness:
    """An equality constraint as a spring and damper at rest.

    Attributes
    ----------
    name : str
    kind : {"connect", "weld", "weld rotation", "joint", "tendon"}
        A weld is two springs, one for the translation and one for the rotation.
    unit : {"N/m", "N*m/rad"}
        Of the stiffness. A joint equality acts on its first joint with it, a tendon equality on its first tendon.
    reference : (k, b)
        Of the reference acceleration, in 1/s^2 and 1/s.
    solimp : five numbers
    weight : float
        A, in 1/kg or 1/(kg m^2).
    torquescale : float
        Of a weld's rotation; 0 for everything else.
    given_time_constant, least_time_constant : float
        solref's time constant (0 where solref states a stiffness), and the one below which MuJoCo clamps it.
    depends_on_pose : bool
        Whether the weight is computed anew at every pose (`diagexact`); else it is that of the pose qpos0.
    """

    name: str
    kind: str
    unit: str
    reference: tuple[float, float]
    solimp: tuple[float, ...]
    weight: float
    torquescale: float = 0.0
    given_time_constant: float = 0.0
    least_time_constant: float = 0.0
    depends_on_pose: bool = False

    @property
    def stiffness(self) -> float:
        """Stiffness of the closed constraint."""
        return self.at(0.0)

    @property
    def damping(self) -> float:
        """Damping of the closed constraint, in N*s/m or N*m*s/rad."""
        return self.reference[1] * self.added_mass

    @property
    def added_mass(self) -> float:
        """What the constraint adds to the mass, in kg or kg*m^2, in the direction in which it opens."""
        d = impedance(self.solimp, 0.0)
        return d / ((1.0 - d) * self.weight) * self._lever

    @property
    def depends_on_gap(self) -> bool:
        """Whether the stiffness changes as the constraint opens."""
        return not is_constant(self.solimp)

    @property
    def depends_on_timestep(self) -> bool:
        """Whether MuJoCo clamps solref's time constant at two timesteps."""
        return 0.0 < self.given_time_constant < self.least_time_constant

    @property
    def _lever(self) -> float:
        return 0.25 * self.torquescale**2 if self.kind == ROTATION else 1.0

    def at(self, gap: float) -> float:
        """Return force over gap (torque over angle) where the constraint is open by `gap`, in m or rad."""
        error, shape = gap, 1.0
        if self.kind == ROTATION:
            error, shape = self.torquescale * math.sin(0.5 * gap), float(np.sinc(gap / np.pi))
        d = impedance(self.solimp, error)
        return self.reference[0] * d * d / ((1.0 - d) * self.weight) * self._lever * shape

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to know before the stiffness is relied on, in words."""
        found = []
        if self.depends_on_gap:
            first, least = self.solimp[0], self.solimp[2]
            final = self.stiffness / _softness(self.solimp, 0.0) * _softness(self.solimp, np.inf)
            found.append(
                f"stiffness depends on the gap: {self.stiffness:.3g} to {final:.3g} {self.unit} over solimp's width "
                f"{least:g}; solimp=\"{first:g} {first:g} {least:g}\" makes it constant"
            )
        if self.depends_on_timestep:
            found.append(
                f"solref is clamped by the timestep: its time constant {self.given_time_constant:g} s acts as "
                f"{self.least_time_constant:g} s"
            )
        if self.depends_on_pose:
            found.append("stiffness depends on the pose (diagexact); this is that of the softest direction at qpos0")
        return tuple(found)

    def __str__(self) -> str:
        """Return name, stiffness, damping and added mass."""
        _, damping, mass = _UNITS[self.unit]
        return (
            f"{self.kind} {self.name}: {self.stiffness:.4g} {self.unit} at rest, damping {self.damping:.3g} {damping}, "
            f"adds {self.added_mass:.3g} {mass}"
        )


def _softness(solimp: Sequence[float], opening: float) -> float:
    d = impedance(solimp, opening)
    return d * d / (1.0 - d)


def equality_name(model: mujoco.MjModel, equality: int) -> str:
    """Return an equality's name, or equality0, equality1, ... where it has none."""
    return mujoco.mj_id2name(model, _OBJ.mjOBJ_EQUALITY, equality) or f"equality{equality}"


def constraint_stiffness(mechanism: Any) -> list[ConstraintStiffness]:
    """Return every active connect, weld, joint and tendon equality as the spring that it is at rest.

    Parameters
    ----------
    mechanism : Mechanism or mujoco.MjModel
        With its values as loaded.

    Returns
    -------
    list of ConstraintStiffness
        In the model's order; a weld gives two, for translation and rotation.
    """
    if not (isinstance(mechanism, mujoco.MjModel) or hasattr(mechanism, "simulation_model")):
        raise ParameterError(f"constraint_stiffness takes a Mechanism or an MjModel, got a {type(mechanism).__name__}")
    model = mechanism if isinstance(mechanism, mujoco.MjModel) else mechanism.simulation_model()
    off = mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_EQUALITY
    if model.opt.disableflags & int(off):
        return []
    active = [e for e in range(model.neq) if model.eq_active0[e]]
    return [spring for e in active for spring in springs_of(model, e)]


def springs_of(model: mujoco.MjModel, equality: int) -> list[ConstraintStiffness]:
    """Return the springs that one equality is."""
    kind = KINDS.get(_EQ(model.eq_type[equality]))
    if kind is None:
        return []
    solref, solimp = model.eq_solref[equality], tuple(float(v) for v in model.eq_solimp[equality])
    first, _, standard = standard_form(solref)
    exact = bool(model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_DIAGEXACT)
    weights = _exact_weights(model, equality) if exact else _weights(model, equality)
    scale = float(model.eq_data[equality, 10]) if kind == "weld" else 0.0
    return [
        ConstraintStiffness(
            name=equality_name(model, equality),
            kind=kind if which == 0 else ROTATION,
            unit="N*m/rad" if which else _unit(model, equality),
            reference=reference_constants(model, solref, solimp),
            solimp=solimp,
            weight=weight,
            torquescale=scale if which else 0.0,
            given_time_constant=first if standard else 0.0,
            least_time_constant=least_time_constant(model),
            depends_on_pose=exact,
        )
        for which, weight in enumerate(weights)
    ]


def _weights(model: mujoco.MjModel, equality: int) -> list[float]:
    """Return A, the sum of the inverse weights at qpos0 of what an equality joins: for a weld's rotation, too."""
    kind, ids = KINDS[_EQ(model.eq_type[equality])], [int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality])]
    if kind == "joint":
        return [sum(float(model.dof_invweight0[model.jnt_dofadr[j]]) for j in ids if j >= 0)]
    if kind == "tendon":
        return [sum(float(model.tendon_invweight0[t]) for t in ids if t >= 0)]
    if model.eq_objtype[equality] == _OBJ.mjOBJ_SITE:
        ids = [int(model.site_bodyid[s]) for s in ids]
    return [float(model.body_invweight0[ids, k].sum()) for k in range(2 if kind == "weld" else 1)]


def _exact_weights(model: mujoco.MjModel, equality: int) -> list[float]:
    """Return the largest A that MuJoCo computes at qpos0 for the directions of an equality."""
    data = quiet_data(model)
    with quiet:
        mujoco.mj_forward(model, data)
    rows = (data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY) & (data.efc_id == equality)
    weights = data.efc_diagA[rows]
    return [float(block.max()) for block in np.split(weights, max(1, len(weights) // 3))]


def _unit(model: mujoco.MjModel, equality: int) -> str:
    """Return N/m, or N*m/rad where the constraint's residual is an angle."""
    first = int(model.eq_obj1id[equality])
    joints = [first]
    if model.eq_type[equality] == _EQ.mjEQ_TENDON:
        wraps = range(model.tendon_adr[first], model.tendon_adr[first] + model.tendon_num[first])
        if any(model.wrap_type[w] != mujoco.mjtWrap.mjWRAP_JOINT for w in wraps):
            return "N/m"
        joints = [int(model.wrap_objid[w]) for w in wraps]
    elif model.eq_type[equality] != _EQ.mjEQ_JOINT:
        return "N/m"
    turning = all(model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE for j in joints)
    return "N*m/rad" if turning else "N/m"


# -- as a parameter ---------------------------------------------------------------------------------------------


def direct_solref(spring: ConstraintStiffness) -> float:
    """Return the number g for which solref = (-g K, ...) makes a closed constraint's stiffness K."""
    d, d_w = impedance(spring.solimp, 0.0), float(np.clip(spring.solimp[1], mujoco.mjMINIMP, mujoco.mjMAXIMP))
    return (1.0 - d) * spring.weight * (d_w / d) ** 2


def stiffness_targets(
    model: mujoco.MjModel, equalities: Sequence[int], factor: float, offset: float, path: str
) -> list[Target]:
    """Return the targets that set constraints' effective stiffness (a weld's: of its translation) through solref.

    A damping that solref states stays; where it states a damping ratio, that stays.

    Raises
    ------
    ParameterError
        If a constraint is not active, or its stiffness depends on the gap or on the pose.
    """
    found = []
    for e in equalities:
        name = equality_name(model, e)
        springs = springs_of(model, e)
        if not springs or not model.eq_active0[e]:
            raise ParameterError(
                f"target '{path}': equality '{name}' is not an active connect, weld, joint or tendon equality"
            )
        spring = springs[0]
        if spring.depends_on_gap:
            d, width = spring.solimp[0], spring.solimp[2]
            raise ParameterError(
                f"target '{path}': the stiffness of {spring.kind} '{name}' depends on its gap; make it constant in the "
                f"model with solimp=\"{d:g} {d:g} {width:g}\", or with mjcont.set_constraint_stiffness"
            )
        if spring.depends_on_pose:
            raise ParameterError(
                f"target '{path}': with <flag diagexact=\"enable\"/> the stiffness of {spring.kind} '{name}' depends "
                "on the pose: remove the flag"
            )
        gain, (_, ratio, standard) = direct_solref(spring), standard_form(model.eq_solref[e])
        target = Target(
            "eq_solref", (2 * e,), factor, offset, path, scale=-gain, loaded=spring.stiffness, unit=spring.unit
        )
        found.append(target)
        if standard:
            found.append(replace(target, index=(2 * e + 1,), scale=-2.0 * ratio * math.sqrt(gain), power=0.5))
    return found


# -- in words ---------------------------------------------------------------------------------------------------


def describe_equalities(model: mujoco.MjModel) -> list[str]:
    """Return the lines on the stiffness of equalities that `mjcont inspect` prints."""
    lines = []
    for spring in constraint_stiffness(model):
        lines.append(f"  {spring}")
        if spring.kind != ROTATION:
            lines += [f"    {warning}" for warning in spring.warnings]
    if lines and model.opt.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE and _has_passive_forces(model):
        lines.append('  stiffer in time histories: integrator="discrete" weighs them with M + hD + h^2 K, not with M')
    return lines


def _has_passive_forces(model: mujoco.MjModel) -> bool:
    fields = (model.dof_damping, model.jnt_stiffness, model.tendon_damping, model.tendon_stiffness)
    return any(field.any() for field in fields) or bool(model.actuator_biasprm[:, 1:3].any())
