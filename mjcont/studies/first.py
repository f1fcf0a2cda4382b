"""A first study of a model: which parameter is worth varying, between which bounds, from where, and what to draw.

Parameters are tried, controls first, until a short curve of equilibria moves; what is written has been followed.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.curves.continuation import continue_equilibria, find_equilibrium
from mjcont.errors import MjcontError, ModelError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.loading import shipped_models
from mjcont.results.branch import Branch
from mjcont.results.model import check_bounds
from mjcont.results.quantities import Parameter
from mjcont.studies.schema import key_text, quoted

_ORDER = ("control", "input", "field", "spec", "gravity")
# of a trial: enough to see whether anything moves
_POINTS, _SECONDS, _MOVES = 400, 5.0, 0.01
_LISTED = 8


@dataclass(frozen=True, slots=True)
class First:
    """What a first study varies and draws: `trial` is a short curve from there, `starts` are places of rest."""

    mechanism: Mechanism
    parameter: Parameter
    bounds: tuple[float, float]
    keyframe: str | None
    shown: str
    starts: tuple[str | None, ...]
    trial: Branch


def first_look(mechanism: Mechanism) -> First:
    """Return what to vary first in a model.

    Raises
    ------
    ModelError
        If it rests nowhere that it starts, or no parameter moves it.
    """
    starts = tuple(_resting(mechanism))
    if not starts:
        raise ModelError(
            f"{mechanism.name}: no equilibrium found from its initial pose or a keyframe: add a keyframe near one, or "
            "search with mc.find_equilibria(mechanism)"
        )
    still: First | None = None
    for parameter in candidates(mechanism):
        for keyframe in starts:
            trial = _trial(mechanism, parameter, keyframe)
            if trial is None:
                continue
            shown = _most_moved(trial)
            bounds = check_bounds(mechanism, parameter.name, None)
            look = First(mechanism, parameter, bounds, keyframe, shown or _any_shown(trial), starts, trial)
            if shown:
                return look
            if still is None and trial.special_points:  # a rest that stays where it is, and loses its stability
                still = look
    if still is not None:
        return still
    raise ModelError(f"{mechanism.name}: none of its parameters moves it: {', '.join(mechanism.parameters)}")


def candidates(mechanism: Mechanism) -> list[Parameter]:
    """Return the parameters that can vary, the most promising first: controls, what the model declares, gravity."""
    found = [p for p in mechanism.parameters.values() if p.kind in _ORDER and p.bounds[0] < p.bounds[1]]
    return sorted(found, key=lambda p: _ORDER.index(p.kind))


def _resting(mechanism: Mechanism) -> Iterable[str | None]:
    for keyframe in (None, *mechanism.keyframes):
        try:
            find_equilibrium(mechanism, keyframe=keyframe)
        except MjcontError:
            continue
        yield keyframe


def _trial(mechanism: Mechanism, parameter: Parameter, keyframe: str | None) -> Branch | None:
    """Return a short curve, None where there is none."""
    limits: dict[str, Any] = {"max_points": _POINTS, "max_seconds": _SECONDS}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            return continue_equilibria(mechanism, parameter.name, None, _inside(parameter), keyframe=keyframe, **limits)
    except MjcontError:
        return None


def _inside(parameter: Parameter) -> dict[str, float]:
    """Return a start value where the parameter's own lies outside its bounds."""
    low, high = parameter.bounds
    return {} if low <= parameter.value <= high else {parameter.name: 0.5 * (low + high)}


def _most_moved(trial: Branch) -> str:
    """Return the observable that moves most, angles in radians beside lengths in metres; empty if none moves."""
    spans = {n: float(np.ptp(c.values)) for n, c in trial.columns.items()
             if c.role == "observable" and c.unit in ("rad", "m") and np.isfinite(c.values).all()}
    name = max(spans, key=lambda n: spans[n] * (1.0 if trial.unit(n) == "rad" else 0.5), default="")
    return name if name and spans[name] > _MOVES else ""


def _any_shown(trial: Branch) -> str:
    return next((n for n, c in trial.columns.items() if c.role == "observable"), next(iter(trial.free)))


def first_study(source: str | Path, out: Path, mechanism: Mechanism) -> str:
    """Return the text of a first study of a model, to be written to `out`."""
    look = first_look(mechanism)
    name, p = look.parameter.name, look.parameter
    low, high = (_value(b, p.unit) for b in look.bounds)
    start = {**_inside(p)}
    lines = [
        f"# A first study of {mechanism.name}: where it rests as {name} varies. Run it with",
        "#", f"#     mjcont run {out.name} -o out", "#",
        "# Lines that begin with # are suggestions: take the # away. `mjcont check` tells what is wrong, `mjcont docs",
        "# studies` what else there is, and with `mjcont schema` an editor completes this file.",
        "", f"model = {quoted(_model(source, out))}", "", "[parameters]            # values for all results",
        *_others(look), "", "[[branch]]", 'name = "equilibria"',
        f"parameter = {quoted(name)}    # {_why(p)}",
        f"bounds = [{low}, {high}]    # {'' if p.unit == 'rad' else (p.unit or 'no unit') + ', '}its own range",
    ]
    lines += [f"start = {{ {key_text(n)} = {_value(v, p.unit)} }}" for n, v in start.items()]
    lines += [f"keyframe = {quoted(k)}    # a place of rest" if k == look.keyframe else f"# keyframe = {quoted(k)}"
              for k in look.starts if k is not None]
    lines += ["csv = true", "", "[[plot]]", 'file = "equilibria.png"', f"x = {quoted(name)}",
              f"y = {quoted(look.shown)}    # what moves most; others: {_listed(look)}", ""]
    lines += _onward(look)
    return "\n".join(lines) + "\n"


def _others(look: First) -> list[str]:
    """Return the other parameters at the model's values, as suggestions."""
    others = [p for p in candidates(look.mechanism) if p is not look.parameter][:_LISTED]
    return [f"# {key_text(p.name)} = {_value(p.value, p.unit)}    # {p.unit or '1'}; {_why(p)}" for p in others]


def _onward(look: First) -> list[str]:
    """Return what to ask next: the first fold in a second parameter, and what it depends on."""
    fold = next((p.label for p in look.trial.special_points if p.kind == "LP"), "")
    others = [p for p in candidates(look.mechanism) if p is not look.parameter]
    if not fold or not others:
        return ["# [[searches]]          # every equilibrium, wherever it is", '# name = "found"']
    second = others[0]
    low, high = (_value(b, second.unit) for b in second.bounds)
    return [
        f"# [[loci]]              # how {fold} moves with a second parameter", '# name = "locus"',
        f'# point = "equilibria:{fold}"', f"# parameter = {quoted(second.name)}", f"# bounds = [{low}, {high}]", "",
        f"# [[sensitivities]]     # what {fold} depends on most",
        '# name = "influence"', f'# point = "equilibria:{fold}"',
    ]


def _listed(look: First) -> str:
    names = [n for n in look.mechanism.observables if n != look.shown]
    return ", ".join(" ".join(n.split()) for n in names[:_LISTED]) + (", ..." if len(names) > _LISTED else "")


def _why(parameter: Parameter) -> str:
    words = {"control": "an actuator's control", "gravity": "gravity", "input": "an input"}
    return words.get(parameter.kind) or " ".join(f"acts on {parameter.acts_on}".split())


def _model(source: str | Path, out: Path) -> str:
    """Return what the study calls its model: a shipped model's name, or the way there from the study's folder."""
    if str(source) in shipped_models() and not Path(source).is_file():
        return str(source)
    path, folder = Path(source).resolve(), out.resolve().parent
    return Path(os.path.relpath(path, folder)).as_posix()


def _value(value: float, unit: str) -> str:
    return f'"{np.degrees(value):.10g} deg"' if unit == "rad" else f"{value:.10g}"
