"""Evaluations of many states of one model or of its variants: batched where nothing constrains it, else one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.errors import MjcontError
from mjcont.mechanism.kinks import Kinks, codes_at, element_name
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.quiet import Warned, quiet
from mjcont.numerics.equations.clock import check
from mjcont.numerics.equations.problem import Array, Values, Variants
from mjcont.results.quantities import Parameter

# more variants share calls that take little any more; meshes are in every model
_MOST_VARIANTS, _MODELS_BYTES = 32, 2e8
_CONTACT = int(mujoco.mjtConstraint.mjCNSTR_CONTACT_FRICTIONLESS)
_EQUALITY = int(mujoco.mjtConstraint.mjCNSTR_EQUALITY)
_LIMITS = (int(mujoco.mjtConstraint.mjCNSTR_LIMIT_JOINT), int(mujoco.mjtConstraint.mjCNSTR_LIMIT_TENDON))


class Rows:
    """A batch of a fixed number of rows, evaluated on one thread (waking a second costs more than it gives)."""

    def __init__(self, model: mujoco.MjModel, count: int, kinks: Kinks | None) -> None:
        self._model, self._kinks = model, kinks
        self._batch = Batch(model, count, nthread=1)
        self._warned = Warned(self._batch)
        self._spoilt: Array | None = None
        self._version = -1
        self._qpos = self._batch.bind("qpos")
        self._qvel = self._batch.bind("qvel")
        self._ctrl = self._batch.bind("ctrl")
        self._act = self._batch.bind("act") if model.na else None
        self._inputs: list[tuple[Array, Array]] | None = None
        self._forces = self._batch.bind("qfrc_smooth")
        self._acceleration = self._batch.bind("qacc")
        self._fields: dict[str, Array] = {}
        self._told_apart = {f: self._batch.bind(f) for f in kinks.fields} if kinks is not None else {}

    def forward(
        self,
        qpos: Array,
        qvel: Array | None,
        writer: FieldWriter,
        ctrl: Array | None = None,
        act: Array | None = None,
    ) -> Array:
        """Evaluate the rows' states with the writer's inputs and return qfrc_smooth, a live view (m, nv).

        `ctrl` (m, nu) takes the place of the writer's controls, `act` (m, followers) that of activations at rest. Rows
        that MuJoCo cannot evaluate so are NaN.
        """
        if self._version != writer.version:
            self._batch.set_models(self._model)
            self._version = writer.version
        self._qpos[:] = qpos
        self._qvel[:] = 0.0 if qvel is None else qvel
        if self._inputs is None:
            self._inputs = writer.inputs.bound(self._batch)
        writer.inputs.put_rows(self._inputs)
        if ctrl is not None:
            self._ctrl[:] = ctrl
        if act is not None and self._act is not None:
            self._act[:, writer.inputs.following] = act
        self._batch.forward()
        self._spoilt = self._warned.spoilt()
        return self._of_sound_rows(self._forces)

    def acceleration(self) -> Array:
        """Return qacc of the last evaluation, a live view (m, nv)."""
        return self._of_sound_rows(self._acceleration)

    def _of_sound_rows(self, field: Array) -> Array:
        return field if self._spoilt is None else np.where(self._spoilt[:, None], np.nan, field)

    def field(self, name: str) -> Array:
        """Return a field of the data, a live view (m, ...): filled by evaluations after it was first asked for."""
        if name not in self._fields:
            self._fields[name] = self._batch.bind(name)
        return self._fields[name]

    @property
    def codes(self) -> Array:
        """The smooth piece of the forces that each row of the last evaluation lies on, (m, elements)."""
        assert self._kinks is not None
        return self._kinks.codes(self._model, self._told_apart)

    @property
    def sides(self) -> list[bytes]:
        """What tells apart the smooth pieces of the forces in the last evaluation, by rows."""
        return [row.tobytes() for row in self.codes]


class ModelVariants(Variants):
    """Forces at rest of variants of a smooth model; some controls have values of their own in every state.

    Row r of variant s is simulation r S + s of a batch for S variants: each keeps its model, whatever is asked for.

    Parameters
    ----------
    fresh : makes a model as loaded, to be written to, with its writer.
    size : what a model takes, in bytes.
    parameters : by name.
    counted : called with the number of evaluations made.

    Attributes
    ----------
    most : how many variants are worth their memory, if each has a model before it is moved and one after.
    """

    def __init__(
        self, fresh: Callable[[], tuple[mujoco.MjModel, FieldWriter]], size: int, parameters: Mapping[str, Parameter],
        counted: Callable[[int], None],
    ) -> None:
        self._fresh, self._parameters, self._counted = fresh, parameters, counted
        self.most = max(1, min(_MOST_VARIANTS, int(_MODELS_BYTES / (2 * size))))
        self._models: list[mujoco.MjModel] = []
        self._writers: list[FieldWriter] = []
        self._values: list[Values] = []
        self._names: tuple[str, ...] = ()
        self._sound = np.zeros(0, dtype=bool)
        self._batch: Batch | None = None
        self._qpos = self._ctrl = self._forces = np.zeros((0, 0, 0))
        self._current = False  # whether the batch has the models as they are

    def take(self, values: Sequence[Values], names: Sequence[str]) -> None:
        """Write the values of variants, each into a model; `names` are controls that nothing else depends on."""
        while len(self._models) < len(values):
            model, writer = self._fresh()
            self._models.append(model)
            self._writers.append(writer)
            self._batch = None
        self._values, self._names = list(values), tuple(names)
        self._sound = np.array([self._written(w, v) for w, v in zip(self._writers, values, strict=False)])
        self._current = False

    def _written(self, writer: FieldWriter, values: Values) -> bool:
        """Write values; return whether there is such a model."""
        try:
            writer.write(self._parameters, values)
        except MjcontError:
            return False
        return not writer.failure

    def residuals(self, chosen: Array, states: Array, columns: Array) -> Array:
        """Return forces at rest of the variants chosen, (K, m, nv)."""
        check()
        count, slots = states.shape[1], len(self._models)
        self._counted(len(chosen) * count)
        self._prepare(count)
        self._qpos[:count, chosen] = states.transpose(1, 0, 2)
        if self._names:
            self._ctrl[:count, chosen] = self._controls(chosen, columns).transpose(1, 0, 2)
        rows = (np.arange(count)[:, None] * slots + chosen).ravel().astype(np.int32)
        assert self._batch is not None
        self._batch.forward(rows)
        found: Array = np.ascontiguousarray(self._forces[:count, chosen].transpose(1, 0, 2))
        spoilt = self._warned.spoilt()
        if spoilt is not None:
            found[spoilt.reshape(-1, slots)[:count, chosen].T] = np.nan
        found[~self._sound[chosen]] = np.nan
        return found

    def _prepare(self, count: int) -> None:
        """Have a batch with so many rows for each variant, on the models as they are, with their inputs."""
        slots = len(self._models)
        if self._batch is None or len(self._qpos) < count:
            self._batch = Batch(self._models[0], count * slots, nthread=1)
            self._warned = Warned(self._batch)
            self._qpos, self._ctrl, self._forces = (
                view.reshape(count, slots, -1) for view in map(self._batch.bind, ("qpos", "ctrl", "qfrc_smooth"))
            )
            self._current = False
        if not self._current:
            self._batch.set_models(self._models * len(self._qpos))
            for s, writer in enumerate(self._writers):
                for view, array in writer.inputs.bound(self._batch):
                    view[s::slots] = array
            self._current = True

    def _controls(self, chosen: Array, columns: Array) -> Array:
        """Return the controls in every state, (K, m, nu)."""
        ctrl = np.stack([self._writers[s].inputs.ctrl for s in chosen.tolist()])
        out = np.repeat(ctrl[:, None], columns.shape[1], axis=1)
        for i, name in enumerate(self._names):
            own = np.array([self._values[s][name] for s in chosen.tolist()])
            for target in self._parameters[name].targets:
                out[:, :, list(target.index)] += (target.factor * (columns[:, :, i] - own[:, None]))[..., None]
        return out


class ConstrainedRows:
    """Evaluations of a model with constraints: the forces at zero acceleration, constraint forces among them.

    MuJoCo's constraint forces depend on the acceleration; at rest and in equilibrium it is zero, so equilibria are
    where the inverse dynamics at zero acceleration ask for no force. One row after the other: the batch has no
    inverse dynamics. Friction of contacts is left out: at rest MuJoCo's has no force, but it would add to mass and
    damping, and call stable what only creeps.
    """

    def __init__(self, model: mujoco.MjModel, kinks: Kinks | None) -> None:
        self._model, self._kinks = model, kinks
        self._data = mujoco.MjData(model)
        self._warned = Warned(self._data)
        self.sides: list[bytes] = []
        self.idle = True  # whether no constraint was near in any row of the last evaluation

    def forward(self, qpos: Array, qvel: Array | None, writer: FieldWriter, qacc: Array | None = None) -> Array:
        """Return the forces for every row, (m, nv); `qacc` (m, nv) is zero unless given."""
        m, d = self._model, self._data
        out = np.empty((len(qpos), m.nv))
        self.sides, self.idle = [], True
        writer.inputs.put(d)
        with quiet:  # of constraints MuJoCo also warns without counting
            for i, x in enumerate(qpos):
                d.qpos[:] = x
                d.qvel[:] = 0.0 if qvel is None else qvel[i]
                d.qacc[:] = 0.0 if qacc is None else qacc[i]
                mujoco.mj_inverse(m, d)
                mujoco.mj_fwdActuation(m, d)
                side = load_side(m, d)
                self.idle &= d.nefc == 0
                self.sides.append(side if self._kinks is None else side + codes_at(self._kinks, m, d).tobytes())
                out[i] = d.qfrc_actuator - d.qfrc_inverse
                if d.ncon and (qvel is not None or qacc is not None):
                    out[i] -= _contact_friction(m, d)
                if self._warned.spoilt() is not None:
                    out[i] = np.nan
        return out

    def accelerations(
        self, qpos: Array, qvel: Array, writer: FieldWriter, act: Array | None = None
    ) -> Array:
        """Return qacc for every row, (m, nv); `touched` then has the names of what carried load in any.

        With `act` (m, followers) the rates of these activations stand beside it, (m, nv + followers).
        """
        m, d, following = self._model, self._data, writer.inputs.following
        out = np.empty((len(qpos), m.nv + (0 if act is None else len(following))))
        self.touched: list[frozenset[str]] = []
        writer.inputs.put(d)
        with quiet:
            for i, x in enumerate(qpos):
                d.qpos[:], d.qvel[:], d.qacc_warmstart[:] = x, qvel[i], 0.0
                if act is not None:
                    d.act[following] = act[i]
                mujoco.mj_forward(m, d)
                out[i, : m.nv], out[i, m.nv :] = d.qacc, d.act_dot[following] if act is not None else ()
                if self._warned.spoilt() is not None:
                    out[i] = np.nan
                names = frozenset(_loaded(m, d)) if d.nefc else frozenset()
                if self._kinks is not None:
                    names |= self._kinks.names(m, codes_at(self._kinks, m, d))
                self.touched.append(names)
        return out

    def active(self, x: Array, writer: FieldWriter) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest, and of what `kinks` finds busy."""
        m, d = self._model, self._data
        writer.inputs.put(d)
        d.qpos[:], d.qvel[:], d.qacc[:] = x, 0.0, 0.0
        with quiet:
            mujoco.mj_inverse(m, d)
        found = frozenset(_loaded(m, d))
        if self._kinks is None:
            return found
        mujoco.mj_fwdActuation(m, d)
        return found | self._kinks.names(m, codes_at(self._kinks, m, d))

    def connections(self, x: Array, writer: FieldWriter) -> list[Array]:
        """Return the gradients (nv,) of equalities, and of limits and contacts' distances that carry load at rest."""
        self.active(x, writer)
        m, d = self._model, self._data
        rows = [[r] for r in range(d.nefc) if d.efc_type[r] == _EQUALITY or _stops(d, r)]
        for first, dim in zip(d.contact.efc_address, d.contact.dim, strict=True):
            elliptic = m.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC or dim == 1
            own = [first] if elliptic else list(range(first, first + 2 * (dim - 1)))  # a pyramid's edges have its sum
            rows += [own] if first >= 0 and np.any(d.efc_force[own] > 0.0) else []
        found = []
        for own in rows:
            weights, gradient = np.zeros(d.nefc), np.zeros(m.nv)
            weights[own] = 1.0 / len(own)
            mujoco.mj_mulJacTVec(m, d, gradient, weights)
            found.append(gradient)
        return found


def _stops(d: mujoco.MjData, r: int) -> bool:
    """Whether a constraint's row is a limit that carries load."""
    return bool(d.efc_type[r] in _LIMITS and d.efc_force[r] > 0.0)


def _contact_friction(m: mujoco.MjModel, d: mujoco.MjData) -> Array:
    """Return the part of the contact forces that does not act along the normals, as generalised forces (nv,)."""
    along = np.zeros(d.nefc)
    elliptic = m.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    for first, dim in zip(d.contact.efc_address, d.contact.dim, strict=True):
        if first < 0 or dim == 1:
            continue
        if elliptic:
            along[first + 1 : first + dim] = d.efc_force[first + 1 : first + dim]
        else:  # a pyramid's edges come in pairs that share the normal force
            pairs = d.efc_force[first : first + 2 * (dim - 1)].reshape(-1, 2)
            along[first : first + 2 * (dim - 1)] = (pairs - pairs.mean(axis=1, keepdims=True)).ravel()
    out = np.zeros(m.nv)
    mujoco.mj_mulJacTVec(m, d, out, along)
    return out


def load_side(m: mujoco.MjModel, d: mujoco.MjData) -> bytes:
    """Return what tells apart the smooth pieces of the forces: the constraints that carry load."""
    loaded = d.efc_force != 0.0
    kind, index = d.efc_type[loaded], d.efc_id[loaded]
    if d.ncon:  # a contact's number depends on the others: its geoms do not
        touching = kind >= _CONTACT
        pair = d.contact.geom[index[touching]]
        index[touching] = pair[:, 0] * m.ngeom + pair[:, 1]
    held = d.contact.geom.tobytes() if d.ncon and _adhesion(m) else b""  # it acts on contacts that bear nothing, too
    return kind.tobytes() + index.tobytes() + held


def _adhesion(m: mujoco.MjModel) -> bool:
    """Whether an actuator pulls at the contacts of a body."""
    return bool(np.any(m.actuator_trntype == int(mujoco.mjtTrn.mjTRN_BODY)))


def _loaded(m: mujoco.MjModel, d: mujoco.MjData) -> Iterator[str]:
    """Yield the names of the limits and contacts that carry load; two geoms may touch at several points."""
    kinds = mujoco.mjtConstraint
    points: dict[tuple[int, ...], set[int]] = {}
    for r in range(d.nefc):
        kind, index = kinds(d.efc_type[r]), int(d.efc_id[r])
        if d.efc_force[r] <= 0.0:
            continue
        if kind == kinds.mjCNSTR_LIMIT_JOINT:
            ball = m.jnt_type[index] == int(mujoco.mjtJoint.mjJNT_BALL)  # it has one, of its angle
            low = not ball and d.qpos[m.jnt_qposadr[index]] < np.mean(m.jnt_range[index])
            yield f"{'lower' if low else 'upper'} limit of {element_name(m, mujoco.mjtObj.mjOBJ_JOINT, index)}"
        elif kind == kinds.mjCNSTR_LIMIT_TENDON:
            side = "lower" if d.ten_length[index] < np.mean(m.tendon_range[index]) else "upper"
            yield f"{side} limit of {element_name(m, mujoco.mjtObj.mjOBJ_TENDON, index)}"
        elif kind.name.startswith("mjCNSTR_CONTACT"):
            points.setdefault(tuple(int(g) for g in d.contact[index].geom), set()).add(index)
    for geoms, found in points.items():
        first, second = (element_name(m, mujoco.mjtObj.mjOBJ_GEOM, g) for g in geoms)
        for k in range(len(found)):
            yield f"contact{f' {k + 1}' if k else ''} of {first} and {second}"
