"""What a study file asks for: its schema, checked whole before anything is computed.

docs/studies.md describes every key. Numbers are SI and radians; a string such as "20 deg" says its unit.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from mjcont.branch import show
from mjcont.collect import units
from mjcont.continuation import check_bounds, make_settings
from mjcont.errors import MjcontError, StudyError, unknown_name
from mjcont.loading import shipped_models
from mjcont.mechanism import Mechanism
from mjcont.numerics.settings import Settings
from mjcont.quantities import FRICTION
from mjcont.schema import Table
from mjcont.sweepplans import SweepPlan, read_sweep

STUDY_VERSION = 1
PLOT_SUFFIXES = (".png", ".pdf", ".svg")
_FILE_STEM = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")
_NAME = re.compile(r"[A-Za-z_]\w*")
_SETTING_UNITS = {"angle": "rad", "angle_max": "rad", "max_seconds": "s"}


@dataclass(frozen=True, slots=True)
class BranchPlan:
    """One curve of equilibria to be computed; `start` holds every parameter value that the study gives."""

    name: str
    parameter: str
    bounds: tuple[float, float]
    start: Mapping[str, float]
    keyframe: str | None = None
    state: tuple[float, ...] | None = None
    direction: int | None = None
    zeros: Mapping[str, float] = field(default_factory=dict)
    csv: bool = False
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class PlotPlan:
    """One diagram to be drawn from branches of the study."""

    file: str
    branches: tuple[str, ...]
    x: str
    y: str
    title: str = ""
    labels: bool = True
    degrees: bool = True


@dataclass(frozen=True, slots=True)
class Study:
    """A checked study file with its model."""

    file: str
    mechanism: Mechanism = field(repr=False)
    branches: tuple[BranchPlan, ...]
    plots: tuple[PlotPlan, ...] = ()
    sweep: SweepPlan | None = None
    friction: str = FRICTION[0]


def load_study(path: str | Path, *, friction: str | None = None) -> Study:
    """Read a study file and check all of it, also against its model; `friction` comes before the file's own.

    Raises
    ------
    StudyError
        If anything is wrong: one line that names the file and the key, with the valid choices.
    """
    root = Table(str(path), _parse(Path(path)))
    root.only("version", "model", "friction", "parameters", "declare", "branch", "plot", "sweep")
    version = root.integer("version", STUDY_VERSION)
    if version != STUDY_VERSION:
        raise root.error("version", f"this mjcont reads version {STUDY_VERSION}, the file has {version}")
    root.require("model", "branch")
    mechanism = _load_model(root, Path(path).parent, friction)
    declare = root.table("declare")
    for name in declare.data:
        _declare(declare, name, mechanism)
    common = _values(root.table("parameters"), mechanism)
    curves, diagrams = root.tables("branch"), root.tables("plot")
    if not curves:
        raise root.error("branch", "a study needs at least one [[branch]]")
    branches = tuple(_branch(table, mechanism, common) for table in curves)
    _refuse_repeats(curves, "name")
    plots = tuple(_plot(table, mechanism, branches) for table in diagrams)
    _refuse_repeats(diagrams, "file")
    asked = friction or root.text("friction", FRICTION[0])
    return Study(str(path), mechanism, branches, plots, read_sweep(root, mechanism, branches), asked)


def _parse(path: Path) -> dict[str, Any]:
    if not path.is_file():
        what = "is a folder, not a file" if path.is_dir() else "no such file"
        raise StudyError(f"study '{path}': {what}")
    try:
        text = path.read_text(encoding="utf-8")
    except (UnicodeDecodeError, OSError) as error:
        raise StudyError(f"study '{path}' cannot be read as text: {error}") from error
    try:
        return tomllib.loads(text)
    except ValueError as error:
        raise StudyError(f"study '{path}': not valid TOML: {error}") from error


@contextmanager
def _named(table: Table, key: str) -> Iterator[None]:
    """Let an error about the model name the file and the key."""
    try:
        yield
    except StudyError:
        raise
    except MjcontError as error:
        raise table.error(key, error) from error


def _load_model(root: Table, folder: Path, friction: str | None) -> Mechanism:
    name, asked = root.text("model"), root.text("friction", FRICTION[0])
    if asked not in FRICTION:
        raise root.error("friction", unknown_name("choice", asked, FRICTION))
    friction = friction or asked
    beside = folder / name
    with _named(root, "model"):
        if not beside.is_file() and name in shipped_models():
            return Mechanism.from_xml(name, friction=friction)
        return Mechanism.from_xml(beside, friction=friction)


def _declare(declare: Table, name: str, mechanism: Mechanism) -> None:
    table = declare.table(name)
    table.only("targets", "unit", "bounds")
    table.require("targets")
    known = mechanism.parameters.get(name)
    if not _NAME.fullmatch(name):
        raise declare.error(name, "a parameter's name consists of letters, digits and '_'")
    if (known is not None and known.kind != "control") or name in mechanism.observables:
        raise declare.error(name, "the model has a parameter or an observable of this name: choose another")
    unit = table.text("unit")
    bounds = _pair(table, unit)
    if bounds is not None and not bounds[0] < bounds[1]:
        raise table.error("bounds", f"expected low < high, got [{bounds[0]:g}, {bounds[1]:g}]")
    targets = table.texts("targets")
    if not targets:
        raise table.error("targets", "expected at least one target, such as ['joint:hip.stiffness']")
    with _named(table, "targets"):
        mechanism.declare(name, *targets, unit=unit, bounds=bounds)


def _pair(table: Table, unit: str) -> tuple[float, float] | None:
    pair = table.quantities("bounds", (unit, unit), "two numbers such as [-50, 50]")
    return None if pair is None else (pair[0], pair[1])


def _values(table: Table, mechanism: Mechanism) -> dict[str, float]:
    """Return the parameter values in a table, each known to the model and inside its control's range."""
    found: dict[str, float] = {}
    for name in table.data:
        with _named(table, name):
            found[name] = table.quantity(name, mechanism.parameter(name).unit)
            mechanism.values({name: found[name]})
    return found


def _branch(table: Table, mechanism: Mechanism, common: Mapping[str, float]) -> BranchPlan:
    table.only("name", "parameter", "bounds", "start", "keyframe", "state", "direction", "zeros", "csv", "settings")
    table.require("name", "parameter")
    name, parameter = table.text("name"), table.text("parameter")
    if not _FILE_STEM.fullmatch(name):
        raise table.error("name", f"'{name}' names a file: use letters, digits, '-', '_' and '.' only")
    with _named(table, "parameter"):
        unit = mechanism.parameter(parameter).unit
        check_bounds(mechanism, parameter, None)
    bounds = _pair(table, unit)
    with _named(table, "bounds"):
        low, high = check_bounds(mechanism, parameter, bounds)
    start = {**common, **_values(table.table("start"), mechanism)}
    value = start.get(parameter, mechanism.parameter(parameter).value)
    if not low <= value <= high:
        raise table.error(
            "start",
            f"{parameter} = {show(value, unit)} lies outside the bounds {show(low, unit)} .. {show(high, unit)}: "
            f"give start = {{ {parameter} = ... }} inside them",
        )
    keyframe, state = _pose(table, mechanism)
    return BranchPlan(
        name,
        parameter,
        (low, high),
        start,
        keyframe,
        state,
        _direction(table),
        _zeros(table.table("zeros"), mechanism, parameter),
        table.flag("csv"),
        _settings(table.table("settings")),
    )


def _pose(table: Table, mechanism: Mechanism) -> tuple[str | None, tuple[float, ...] | None]:
    units = [unit for _, unit in mechanism.state_labels]
    names = ", ".join(name for name, _ in mechanism.state_labels)
    state = table.quantities("state", units, f"{len(units)} numbers ({names})")
    keyframe = table.text("keyframe") if "keyframe" in table.data else None
    if keyframe is not None and state is not None:
        raise table.error("state", "give a keyframe or a state, not both")
    if keyframe is not None:
        with _named(table, "keyframe"):
            mechanism.start_state(keyframe)
    return keyframe, state


def _direction(table: Table) -> int | None:
    if "direction" not in table.data:
        return None
    direction = table.integer("direction", 1)
    if direction not in (1, -1):
        raise table.error("direction", f"expected 1 or -1 (leave it out for both directions), got {direction}")
    return direction


def _zeros(table: Table, mechanism: Mechanism, parameter: str) -> dict[str, float]:
    unit_of = units(mechanism)
    valid = [*mechanism.observables, parameter]
    for name in table.data:
        if name not in valid:
            raise table.error(name, unknown_name("column", name, valid))
    return {name: table.quantity(name, unit_of[name]) for name in table.data}


def _settings(table: Table) -> dict[str, Any]:
    found: dict[str, Any] = {}
    defaults = {f.name: f.default for f in fields(Settings)}
    table.only(*defaults)
    for name in table.data:
        whole = isinstance(defaults[name], int)
        found[name] = table.integer(name, 0) if whole else table.quantity(name, _SETTING_UNITS.get(name, "1"))
    with _named(table, ""):
        make_settings(found)
    return found


def _plot(table: Table, mechanism: Mechanism, branches: Sequence[BranchPlan]) -> PlotPlan:
    table.only("file", "branches", "x", "y", "title", "labels", "degrees")
    table.require("file", "x", "y")
    file = table.text("file")
    suffixes = ", ".join(PLOT_SUFFIXES)
    if not _FILE_STEM.fullmatch(file) or Path(file).suffix not in PLOT_SUFFIXES:
        raise table.error("file", f"'{file}' must be a file name without a folder, ending in one of {suffixes}")
    plans = {b.name: b for b in branches}
    chosen = table.texts("branches") if "branches" in table.data else tuple(plans)
    if not chosen:
        raise table.error("branches", "expected at least one branch; leave the key out for all of them")
    for i, name in enumerate(chosen):
        if name not in plans:
            raise table.error(f"branches[{i}]", unknown_name("branch", name, plans))
    for axis in ("x", "y"):
        column, valid = table.text(axis), units(mechanism)
        if column not in valid:
            raise table.error(axis, unknown_name("column", column, valid))
    return PlotPlan(
        file,
        chosen,
        table.text("x"),
        table.text("y"),
        table.text("title"),
        table.flag("labels", True),
        table.flag("degrees", True),
    )


def _refuse_repeats(tables: Sequence[Table], key: str) -> None:
    """Refuse names that would share a file, also where case makes no difference."""
    first: dict[str, Table] = {}
    for table in tables:
        name = table.text(key)
        earlier = first.setdefault(name.casefold(), table)
        if earlier is not table:
            raise table.error(key, f"'{name}' is the {key} of {earlier.where} already")
