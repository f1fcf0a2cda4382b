"""Forces that are smooth in pieces only: springs with a dead band, saturating actuators, tendons that touch a geom.

Which piece a state lies on is a row of small integers, the *codes*: zero for an element that is idle. Limits and
contacts are constraints and have sides of their own (see `batches`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.numerics.equations.problem import Array

_DISABLE = mujoco.mjtDisableBit
_OBJECT = mujoco.mjtObj
_SUM = 1e-12


@dataclass(frozen=True, slots=True)
class Kinks:
    """The elements of a model whose force has a kink.

    Attributes
    ----------
    bands : tendons whose spring has a dead band: slack inside it.
    actuators, joints, tendons : those with a force range of their own, that of all actuators together for the latter.
    wraps : (tendon, geom) for every geom that a tendon may touch.
    driven : (ntendon, nu) whether an actuator pulls at a tendon.
    """

    bands: Array
    actuators: Array
    joints: Array
    tendons: Array
    wraps: tuple[tuple[int, int], ...]
    driven: Array

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Kinks | None:
        """Return the elements of a model, None where every force is smooth."""
        springs = not model.opt.disableflags & _DISABLE.mjDSBL_SPRING
        acts = not model.opt.disableflags & _DISABLE.mjDSBL_ACTUATION
        pull = (model.actuator_trntype == int(mujoco.mjtTrn.mjTRN_TENDON)) & (model.actuator_outnum == 1)
        driven = acts * pull * (model.actuator_trnid[:, 0] == np.arange(model.ntendon)[:, None])
        moved = np.isin(model.jnt_type, [int(mujoco.mjtJoint.mjJNT_SLIDE), int(mujoco.mjtJoint.mjJNT_HINGE)])
        limited = model.actuator_forcelimited.astype(bool) & (model.actuator_outnum > 0)
        band = springs * (model.tendon_lengthspring[:, 0] < model.tendon_lengthspring[:, 1])
        found = cls(
            np.flatnonzero(band),
            np.flatnonzero(acts * limited),
            np.flatnonzero(acts * model.jnt_actfrclimited.astype(bool) * moved),
            np.flatnonzero(model.tendon_actfrclimited.astype(bool) * driven.any(axis=1)),
            tuple(_wraps(model)),
            driven,
        )
        parts = (found.bands, found.actuators, found.joints, found.tendons, found.wraps)
        return found if any(len(p) for p in parts) else None

    @property
    def fields(self) -> tuple[str, ...]:
        """Names of the fields of MjData that tell the pieces apart."""
        spring = ("ten_length",) if len(self.bands) else ()
        force = ("actuator_force",) if len(self.actuators) or len(self.tendons) else ()
        joint = ("qfrc_actuator",) if len(self.joints) else ()
        return spring + force + joint + (("ten_wrapadr", "ten_wrapnum", "wrap_obj") if self.wraps else ())

    def codes(self, m: mujoco.MjModel, data: Mapping[str, Array]) -> Array:
        """Return the piece that every row of `data` lies on, (rows, elements), of small integers."""
        stiff = (m.tendon_stiffness != 0.0) | m.tendon_stiffnesspoly.any(axis=1)
        parts = []
        if len(self.bands):
            length, (low, high) = data["ten_length"][:, self.bands], m.tendon_lengthspring[self.bands].T
            parts.append(stiff[self.bands] * ((length > high).astype(np.int8) - (length < low)))
        if len(self.actuators):
            parts.append(self._saturation(m, data["actuator_force"]))
        if len(self.joints):
            force = data["qfrc_actuator"][:, m.jnt_dofadr[self.joints]]
            parts.append(_at_bounds(force, m.jnt_actfrcrange[self.joints]))
        if len(self.tendons):
            starts = np.where(m.actuator_outnum > 0, m.actuator_outadr, 0)
            total = data["actuator_force"][:, starts] @ self.driven[self.tendons].T
            parts.append(_at_bounds(total, m.tendon_actfrcrange[self.tendons], _SUM))
        if self.wraps:
            carries = np.tile(stiff, (len(data["wrap_obj"]), 1))
            if len(self.bands):
                carries[:, self.bands] &= parts[0] != 0
            carries |= self.driven.any(axis=1) | m.tendon_limited.astype(bool)
            parts.append(self._touching(data) * carries[:, [t for t, _ in self.wraps]])
        return np.concatenate(parts, axis=1).astype(np.int8)

    def _saturation(self, m: mujoco.MjModel, force: Array) -> Array:
        """Return which bound of its range each actuator's force lies on; torques in space have a bound on the norm."""
        found = _at_bounds(force[:, m.actuator_outadr[self.actuators]], m.actuator_forcerange[self.actuators])
        for k in np.flatnonzero(m.actuator_outnum[self.actuators] > 1):
            a = self.actuators[k]
            outputs = force[:, m.actuator_outadr[a] : m.actuator_outadr[a] + m.actuator_outnum[a]]
            bound = m.actuator_forcerange[a, 1]
            found[:, k] = np.linalg.norm(outputs, axis=1) >= bound * (1.0 - _SUM)
        return found

    def _touching(self, data: Mapping[str, Array]) -> Array:
        """Return how many points of each tendon's path lie on each geom, (rows, len(wraps))."""
        objects = data["wrap_obj"].reshape(len(data["wrap_obj"]), -1)
        place = np.arange(objects.shape[1])
        counts = []
        for tendon, geom in self.wraps:
            first = data["ten_wrapadr"][:, tendon, None]
            own = (place >= first) & (place < first + data["ten_wrapnum"][:, tendon, None])
            counts.append((own & (objects == geom)).sum(axis=1))
        return np.stack(counts, axis=1)

    def names(self, m: mujoco.MjModel, codes: Array) -> frozenset[str]:
        """Return the names of the elements that a row of codes (elements,) finds busy."""
        kinds = (
            *(("tendon {} taut", "tendon {} compressed", _OBJECT.mjOBJ_TENDON, i) for i in self.bands),
            *(("actuator {} saturated", "", _OBJECT.mjOBJ_ACTUATOR, i) for i in self.actuators),
            *(("actuation of joint {} saturated", "", _OBJECT.mjOBJ_JOINT, i) for i in self.joints),
            *(("actuation of tendon {} saturated", "", _OBJECT.mjOBJ_TENDON, i) for i in self.tendons),
        )
        found = {
            (below if code < 0 and below else above).format(element_name(m, kind, i))
            for (above, below, kind, i), code in zip(kinds, codes, strict=False)
            if code
        }
        for (tendon, geom), code in zip(self.wraps, codes[len(kinds) :], strict=True):
            if code:
                pair = element_name(m, _OBJECT.mjOBJ_TENDON, tendon), element_name(m, _OBJECT.mjOBJ_GEOM, geom)
                found.add("contact of tendon {} and {}".format(*pair))
        return frozenset(found)


def codes_at(kinks: Kinks, m: mujoco.MjModel, d: mujoco.MjData) -> Array:
    """Return the codes of one MjData, (elements,)."""
    return kinks.codes(m, {f: getattr(d, f)[None] for f in kinks.fields})[0]


def element_name(m: mujoco.MjModel, kind: mujoco.mjtObj, index: int) -> str:
    """Return an element's name, or its kind and number where it has none."""
    return mujoco.mj_id2name(m, kind, index) or f"{kind.name.removeprefix('mjOBJ_').lower()}{index}"


def _at_bounds(force: Array, ranges: Array, tolerance: float = 0.0) -> Array:
    """Return 1 where a force is clamped at the upper end of its range, -1 at the lower, 0 between, int8."""
    slack = tolerance * (ranges[:, 1] - ranges[:, 0])
    return (force >= ranges[:, 1] - slack).astype(np.int8) - (force <= ranges[:, 0] + slack)


def _wraps(model: mujoco.MjModel) -> list[tuple[int, int]]:
    """Return every (tendon, geom) of which the tendon's path may touch the geom."""
    round_ones = (int(mujoco.mjtWrap.mjWRAP_SPHERE), int(mujoco.mjtWrap.mjWRAP_CYLINDER))
    pairs = [
        (t, int(model.wrap_objid[w]))
        for t in range(model.ntendon)
        for w in range(model.tendon_adr[t], model.tendon_adr[t] + model.tendon_num[t])
        if model.wrap_type[w] in round_ones
    ]
    return list(dict.fromkeys(pairs))
