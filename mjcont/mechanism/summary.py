"""What `mjcont inspect` prints of a mechanism: what can be continued, what can be read, where to start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import mujoco

from mjcont.models.actuators import bush_names
from mjcont.models.equalities import describe_equalities
from mjcont.models.states import keyframes, model_name
from mjcont.models.topology import describe_topology
from mjcont.results.quantities import Observable
from mjcont.results.text import ParameterTable, number, table, unit_shown


def describe(
    model: mujoco.MjModel,
    constrained: bool,
    parameters: ParameterTable,
    readings: Iterable[tuple[Observable, float]],
    notes: Sequence[str],
) -> str:
    """Return the summary of a model as loaded; `readings` are its observables with their values at qpos0."""
    lines = [f"{model_name(model)}: {model.nv} degrees of freedom, {len(bush_names(model))} bush elements"]
    if constrained:
        lines[0] += ", with constraints (equalities, limits or contacts)"
    lines += ["", "parameters", str(parameters)]
    rows = [["name", "at qpos0", "unit"], *([o.name, number(v, o.unit), unit_shown(o.unit)] for o, v in readings)]
    lines += ["", "observables", *table(rows)]
    lines += ["", "structure", *describe_topology(model)]
    if springs := describe_equalities(model):
        lines += ["", "constraints as springs", *springs]
    lines += ["", "starts", "  qpos0", *(f"  keyframe {k}" for k in keyframes(model))]
    if notes:
        lines += ["", "notes", *(f"  {note}" for note in notes)]
    return "\n".join(lines)
