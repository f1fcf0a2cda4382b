"""What results say on the equality constraints of a mechanism: the springs that they are, over a curve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mjcont.models.equalities import ConstraintStiffness, constraint_stiffness


def notes_on(mechanism: Any, values: Sequence[Mapping[str, float]]) -> list[str]:
    """Return a line for each equality constraint of a mechanism: which spring it is, at the parameters' values.

    Parameters
    ----------
    mechanism : Mechanism
    values : sequence of mappings
        Parameters' values; where the stiffness differs between them, its range is stated.
    """
    model = mechanism.simulation_model()
    writer = mechanism.writer(model)
    found: dict[tuple[str, str], list[ConstraintStiffness]] = {}
    for given in values:
        writer.write(mechanism.parameters, given)
        for spring in constraint_stiffness(model):
            found.setdefault((spring.kind, spring.name), []).append(spring)
    return [_note(springs) for springs in found.values()]


def _note(springs: Sequence[ConstraintStiffness]) -> str:
    low, high = min(s.stiffness for s in springs), max(s.stiffness for s in springs)
    span = f"{low:.4g}" if high - low <= 1e-9 * high else f"{low:.4g} to {high:.4g}"
    first = springs[0]
    text = f"{first.kind} {first.name} is a spring of {span} {first.unit} at rest"
    return "; ".join([text, *first.warnings])
