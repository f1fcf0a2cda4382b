"""Reading MJCF into models that a Mechanism can own: sources, refusals, private copies, and a readable summary."""

from __future__ import annotations

import copy
import math
import re
import warnings
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

from mjcont import assets, modelfiles
from mjcont.equalities import describe_equalities
from mjcont.errors import ModelError, ParameterError, unknown_name
from mjcont.features import touching
from mjcont.geometry import Geometry
from mjcont.mjcf import exact_text
from mjcont.observables import without_sensor_filters
from mjcont.tables import number, table, unit_shown
from mjcont.topology import describe_topology

if TYPE_CHECKING:
    from mjcont.mechanism import Mechanism

_OTHER_FILES = re.compile(r"<(include|model)\b")
_NEEDS_FILES = re.compile(r"\bfile\w*\s*=")
_REFUSED = (ValueError, RuntimeError, MemoryError, mujoco.FatalError)  # what MuJoCo raises on models
_JOINT = mujoco.mjtJoint
_DISABLE = mujoco.mjtDisableBit


def models_folder() -> Path:
    """Return the folder of the models that ship with mjcont: in the wheel, or beside the package in a checkout."""
    package = Path(str(resources.files("mjcont")))
    installed = package / "models_xml"
    return installed if installed.is_dir() else package.parent / "models_xml"


def shipped_models() -> list[str]:
    """Return the names of the models that ship with mjcont."""
    return sorted(p.stem for p in models_folder().glob("*.xml"))


def read_source(source: str | Path) -> tuple[str, Path | None]:
    """Return the XML text of a path, of a shipped model's name, or of text itself, and its folder."""
    if isinstance(source, str) and source.lstrip().startswith("<"):
        modelfiles.look_at(source, None, "XML text")
        return source, None
    path = Path(source)
    if not path.is_file() and path.parent == Path() and not path.suffix:
        path = models_folder() / f"{path.name}.xml"
    if not path.is_file():
        shipped = ", ".join(shipped_models()) or "none"
        what = "is a folder, not a file" if Path(source).is_dir() else "no such file"
        raise ModelError(f"model '{source}': {what}. Models that ship with mjcont: {shipped}.")
    try:
        text, folder = path.read_text(encoding="utf-8"), path.resolve().parent
    except (UnicodeDecodeError, OSError) as error:
        raise ModelError(f"model '{source}' cannot be read as text: {error}") from error
    modelfiles.look_at(text, folder, str(path))
    try:
        str(folder).encode()
    except UnicodeEncodeError as error:
        if _NEEDS_FILES.search(text):
            raise ModelError(f"model '{source}': MuJoCo reads further files in folders whose names are UTF-8 only: "
                             "move the model") from error
        return text, None
    return text, folder


def parse(text: str, folder: Path | None, label: str) -> mujoco.MjSpec:
    """Return the spec of an XML text; relative files are looked up in `folder`."""
    try:
        if folder is not None and _OTHER_FILES.search(text):
            return mujoco.MjSpec.from_file(label)
        spec = mujoco.MjSpec.from_string(text)
    except _REFUSED as error:
        raise ModelError(f"model {label}: MuJoCo rejects it: {_one_line(error)}") from error
    if folder is not None:
        spec.modelfiledir = str(folder)
    return spec


def compile_spec(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """Compile a spec, turning MuJoCo's error into ours."""
    try:
        return spec.compile()
    except _REFUSED as error:
        raise ModelError(f"model '{spec.modelname}': MuJoCo cannot compile it: {_one_line(error)}") from error


def files_read(source: str | Path) -> list[str]:
    """Return the files that a source reads, itself first, each with what is wrong with it, if anything."""
    text, folder = read_source(source)
    if folder is None:
        return []
    path = Path(source) if Path(source).is_file() else models_folder() / f"{source}.xml"
    spec = parse(text, folder, str(path))
    included = modelfiles.look_at(text, folder, str(path)) if _OTHER_FILES.search(text) else ()
    files = dict.fromkeys([path.resolve(), *included, *assets.files(spec, folder)])
    shown = [f.relative_to(folder) if f.is_relative_to(folder) else f for f in files]
    return [str(name) + ("" if file.is_file() else ": not there") for name, file in zip(shown, files, strict=True)]


def load(source: str | Path) -> tuple[mujoco.MjModel, str, tuple[str, ...], Geometry]:
    """Return the compiled model of a source, XML that stands alone, notes for the user, and the spec behind it.

    The XML is the text as written, or flattened where it needs other files; what needs a missing file is left out.
    """
    text, folder = read_source(source)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        spec = parse(text, folder, "XML text" if folder is None else str(source))
        place = (folder or Path()).resolve()
        notes, dropped = assets.read_notes(spec), assets.drop_missing(spec, place)
        rewritten = assets.anchor_files(spec, place) or bool(dropped) or bool(_OTHER_FILES.search(text))
        model = compile_spec(spec)
        notes = tuple(dict.fromkeys((*notes, *dropped, *(f"MuJoCo: {_one_line(w.message)}" for w in caught))))
        if rewritten:
            assets.write_notes(spec, notes)
            text = exact_text(spec)
            spec, place = parse(text, None, "with everything it includes"), Path()
            model = compile_spec(spec)
    return model, text, notes, Geometry(spec, place if folder is not None and not rewritten else None)


def _one_line(error: Warning | Exception | str) -> str:
    return " ".join(str(error).split())


def copy_model(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy that can be edited freely."""
    return copy.copy(model)


def owned_copy(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy without the control ranges that the model itself does not clamp: they are no limits."""
    own = copy_model(model)
    if model.opt.disableflags & _DISABLE.mjDSBL_CLAMPCTRL:
        own.actuator_ctrllimited[:] = 0
    return own


def start_state(
    mechanism: Mechanism, keyframe: str | None = None, state: np.ndarray | None = None
) -> np.ndarray:
    """Return a start: the state given, or a keyframe's, or qpos0."""
    m: Any = mechanism
    if state is not None:
        x = np.array(state, dtype=float)
        if x.shape != (m.nq,):
            raise ParameterError(f"state must have shape ({m.nq},) for model '{m.name}', got {x.shape}")
        return x
    if keyframe is None:
        return np.array(m.qpos0)
    if keyframe not in m.keyframes:
        raise unknown_name("keyframe", keyframe, m.keyframes)
    return np.array(m.keyframes[keyframe])


def evaluation_copy(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return the private copy on which residuals are evaluated.

    Its integrator is one for which qacc is the forward-dynamics acceleration, its solver is not cut short for speed,
    sensors are off, and controls are never clamped (bounds outside a ctrlrange are refused before). Controls have
    reached their actuators, and dry friction is off. `model` itself, which observables are read from, loses what delays
    controls and filters sensors.
    """
    model.actuator_delay[:] = 0.0
    private = copy_model(model)
    # time histories with "discrete" clamp no equality's time constant, those with other integrators do
    if np.any((model.eq_solref[:, 0] > 0) & (model.eq_solref[:, 0] < 2.0 * model.opt.timestep)):
        if model.opt.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE:
            private.opt.disableflags |= int(_DISABLE.mjDSBL_REFSAFE)
    private.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
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


def model_name(model: mujoco.MjModel) -> str:
    """Return the name in the MJCF's root element."""
    return bytes(model.names[: model.names.index(b"\0")]).decode() or "model"


def coordinates_are_flat(model: mujoco.MjModel) -> bool:
    """Whether qpos is a vector space: slides and hinges only."""
    return bool(np.all(np.isin(model.jnt_type, [_JOINT.mjJNT_SLIDE, _JOINT.mjJNT_HINGE])))


def state_scale(model: mujoco.MjModel) -> np.ndarray:
    """Return the typical size of each tangent coordinate: 1 rad, or the model's size in metres, (nv,)."""
    size = float(model.stat.extent)
    if not math.isfinite(size) or size <= 0:
        size = 1.0
    scale = np.ones(model.nv)
    for j in range(model.njnt):
        start = model.jnt_dofadr[j]
        if model.jnt_type[j] == _JOINT.mjJNT_SLIDE:
            scale[start] = size
        elif model.jnt_type[j] == _JOINT.mjJNT_FREE:
            scale[start : start + 3] = size
    return scale


def keyframes(model: mujoco.MjModel) -> dict[str, np.ndarray]:
    """Return the positions of the model's keyframes by name."""
    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_KEY, k) or f"key{k}" for k in range(model.nkey)]
    return {name: model.key_qpos[k].copy() for k, name in enumerate(names)}


def checked_state(model: mujoco.MjModel, state: Any) -> np.ndarray:
    """Return a state that a user gives as an array, (nq,)."""
    x = np.array(state, dtype=float)
    if x.shape != (model.nq,):
        raise ParameterError(f"state must have shape ({model.nq},) for model '{model_name(model)}', got {x.shape}")
    return x


def state_labels(model: mujoco.MjModel) -> list[tuple[str, str]]:
    """Return name and unit of each entry of qpos."""
    parts = {
        _JOINT.mjJNT_SLIDE: [("", "m")],
        _JOINT.mjJNT_HINGE: [("", "rad")],
        _JOINT.mjJNT_BALL: [(f".q{i}", "") for i in range(4)],
        _JOINT.mjJNT_FREE: [(f".{c}", "m") for c in "xyz"] + [(f".q{i}", "") for i in range(4)],
    }
    labels = []
    for j in range(model.njnt):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, j) or f"joint{j}"
        labels += [(name + suffix, unit) for suffix, unit in parts[_JOINT(model.jnt_type[j])]]
    return labels


def describe(mechanism: Mechanism) -> str:
    """Return what `mjcont inspect` prints."""
    m: Any = mechanism
    lines = [f"{m.name}: {m.n} degrees of freedom, {len(m.bushes)} bush elements"]
    if m.constrained:
        lines[0] += ", with constraints (equalities, limits or contacts)"
    lines += ["", "parameters", str(m.parameters)]
    values = m.measure(m.qpos0[None], m.values())[0]
    rows = [["name", "at qpos0", "unit"]]
    for o, v in zip(m.observables.values(), values, strict=True):
        rows.append([o.name, number(v, o.unit), unit_shown(o.unit)])
    lines += ["", "observables", *table(rows)]
    lines += ["", "structure", *describe_topology(m.simulation_model())]
    if springs := describe_equalities(m.simulation_model()):
        lines += ["", "constraints as springs", *springs]
    lines += ["", "starts", "  qpos0", *(f"  keyframe {k}" for k in m.keyframes)]
    if m.notes:
        lines += ["", "notes", *(f"  {note}" for note in m.notes)]
    return "\n".join(lines)
