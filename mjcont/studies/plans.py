"""What a study file asks for: its schema, checked whole before anything is computed.

docs/studies.md describes every key. Numbers are SI and radians; a string such as "20 deg" says its unit.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mjcont.arguments import checked
from mjcont.errors import ResultFileError, StudyError, did_you_mean, unknown_name
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.loading import shipped_folder, shipped_models
from mjcont.results.files import RESULT_SUFFIXES
from mjcont.results.formats import load
from mjcont.results.quantities import FRICTION
from mjcont.studies import forms as f
from mjcont.studies.answers import ANSWER, AnswerPlan, read_answer
from mjcont.studies.forms import PLOT_SUFFIXES
from mjcont.studies.keys import Context, Reference, about, check_keys, read
from mjcont.studies.plots import PLOT
from mjcont.studies.schema import Table
from mjcont.studies.sweeps import SWEEP, read_sweep
from mjcont.studies.tables import KINDS, known
from mjcont.studies.values import pair, value_table
from mjcont.sweeps.plan import Setup, SweepPlan

__all__ = ["PLOT_SUFFIXES", "BranchPlan", "PlotPlan", "Study", "Task", "check_study", "load_study"]

STUDY_VERSION = 1
DECLARE = f.table({"targets": {**f.TEXTS, "minItems": 1}, "unit": f.TEXT, "bounds": f.PAIR}, "targets",
                  text="A parameter that the model does not declare itself.")
TOP: Mapping[str, f.Form] = {
    "version": {"const": STUDY_VERSION, "description": "Version of this schema."},
    "model": {**f.TEXT, "description": "An MJCF file or a result file, relative to the study, or a model that ships."},
    "friction": {**f.choice(*FRICTION), "description": "Leave friction out of equilibria, or refuse models with it."},
    "parameters": {**f.VALUES, "description": "Values for every result, by the parameters' names."},
    "declare": {"type": "object", "additionalProperties": DECLARE},
    **{kind.table: f.tables(kind.form()) for kind in (*KINDS.values(), PLOT)},
    "sweep": SWEEP,
    "answer": ANSWER,
}
_NAME = re.compile(r"[A-Za-z_]\w*")


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
    origin: Reference | None = None


@dataclass(frozen=True, slots=True)
class Task:
    """Any other result to be computed: its kind, and the values of its keys."""

    kind: str
    name: str
    given: Mapping[str, Any]


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
    units: tuple[str, ...] = ()
    legend: bool = True


@dataclass(frozen=True, slots=True)
class Study:
    """A checked study file with its model; `common` are the values for all results."""

    file: str
    mechanism: Mechanism = field(repr=False)
    branches: tuple[BranchPlan, ...]
    plots: tuple[PlotPlan, ...] = ()
    tasks: tuple[Task, ...] = ()
    sweep: SweepPlan | None = None
    friction: str = FRICTION[0]
    answer: AnswerPlan | None = None
    common: Mapping[str, float] = field(default_factory=dict)

    @property
    def plans(self) -> tuple[BranchPlan | Task, ...]:
        """Everything to be computed, in that order: searches, branches, the other tables as `KINDS` has them."""
        first = tuple(t for t in self.tasks if t.kind == "search")
        return (*first, *self.branches, *(t for t in self.tasks if t.kind != "search"))

    def sweep_setup(self) -> Setup:
        """Return the sweep that the study's table [sweep] asks for.

        Raises
        ------
        StudyError
            If there is none, or the nominal values of what varies differ between its branches.
        """
        plan = self.sweep
        if plan is None:
            raise StudyError(f"study '{self.file}': it has no table [sweep]: see `mjcont docs sweeps`")
        needed = {p.branch for p in plan.points if p.branch}
        branches = tuple(b for b in self.branches if b.name in needed)
        starts = [self.mechanism.values(b.start) for b in branches]
        for name in plan.vary:
            if len({s[name] for s in starts}) > 1:
                raise StudyError(
                    f"study '{self.file}': sweep.vary.{name}: its nominal value differs between the branches "
                    f"{', '.join(sorted(needed))}"
                )
        own: dict[str, tuple[str, ...]] = {}
        for p in plan.points:
            first = next((b.parameter for b in branches if b.name == p.branch), "")
            own[p.name] = (*own[p.of], p.parameter) if p.of else (first,)
        record = plan.record or tuple(f"{n}.{q}" for n, qs in own.items() for q in qs)
        friction = self.friction
        text = Path(self.file).read_text(encoding="utf-8")
        nominal = {n: starts[0][n] for n in plan.vary}
        solved = frozenset(q for qs in own.values() for q in qs)
        return Setup(self.mechanism, plan, friction, {**starts[0], **nominal}, solved, record, branches, None, text)


@checked
def load_study(path: str | Path, *, friction: str | None = None) -> Study:
    """Read a study file and check all of it, also against its model; `friction` comes before the file's own.

    Raises
    ------
    StudyError
        If anything is wrong: the first problem, one line that names the file and the key, with the valid choices.
    """
    study, problems = _read(path, friction)
    if study is None:
        raise problems[0]
    return study


def check_study(path: str | Path, *, friction: str | None = None) -> tuple[Study | None, list[str]]:
    """Return the study, or None, and every problem that can be found without computing: a line each.

    A line reads `FILE: table[i].key: what is wrong, with the valid choices`.
    """
    path = located(path)
    return _told(path, *_read(path, friction))


def check_data(data: Mapping[str, Any], file: str | Path) -> tuple[Study | None, list[str]]:
    """Return what `check_study` does for the tables of a study; `file` is what messages call it, and where it lies."""
    return _told(file, *_checked(data, Path(file), None, Context(None)))


def _told(file: str | Path, study: Study | None, problems: Sequence[StudyError]) -> tuple[Study | None, list[str]]:
    lines = (str(p).replace(f"study '{file}': ", f"{file}: ", 1) for p in problems)
    return study, list(dict.fromkeys(" ".join(line.split()) for line in lines))


def shipped_studies() -> list[str]:
    """Return the names of the studies that ship with mjcont."""
    return sorted(p.stem for p in shipped_folder("studies").glob("*.toml"))


def located(path: str | Path) -> Path:
    """Return the file of a path, or of a shipped study's name, such as "overcentre" or "studies/overcentre.toml"."""
    given = Path(path)
    inside = shipped_folder("studies") / f"{given.stem}.toml"
    named = given.parent == Path() and given.suffix in ("", ".toml")
    within = given.parent == Path("studies") and given.suffix == ".toml"
    return inside if not given.exists() and (named or within) and inside.is_file() else given


def _read(path: str | Path, friction: str | None) -> tuple[Study | None, list[StudyError]]:
    path = located(path)
    context = Context(None)
    data: dict[str, Any] = {}
    with context.noting():
        data = parse(Path(path))
    if context.problems:
        return None, context.problems
    return _checked(data, path, friction, context)


def _checked(
    data: Mapping[str, Any], path: Path, friction: str | None, context: Context
) -> tuple[Study | None, list[StudyError]]:
    root = Table(str(path), data)
    check_keys(root, TOP, ("model",), context)
    with context.noting():
        version = root.integer("version", STUDY_VERSION)
        if version != STUDY_VERSION:
            raise root.error("version", f"this mjcont reads version {STUDY_VERSION}, the file has {version}")
    with context.noting():
        context.mechanism = _load_model(root, path.parent, friction) if "model" in data else None
    if context.mechanism is not None:
        _prepare(root, context)
    study = _assemble(root, context, friction)
    return (None if context.problems else study), context.problems


def _prepare(root: Table, context: Context) -> None:
    """Declare the study's parameters and read the values for all results."""
    with context.noting():
        declare = root.table("declare")
        for name in declare.data:
            with context.noting():
                _declare(declare, name, context.mechanism)
    with context.noting():
        context.common = value_table(root.table("parameters"), context)


def _assemble(root: Table, context: Context, friction: str | None) -> Study:
    branches: list[BranchPlan] = []
    tasks: list[Task] = []
    places: dict[str, str] = {}
    named: list[Table] = []
    count = 0
    for kind, spec in KINDS.items():
        for table in _tables(root, spec.table, context):
            count += 1
            given = read(table, spec, context)
            name = table.data.get("name")
            if isinstance(name, str):
                named.append(table)
                draws = table.data.get("columns") or ("png" in spec.keys and table.data.get("png", True))
                _claim(places, "name", [name, *([f"{name}.png"] if draws else [])], table, context)
                if name not in context.known:
                    context.known[name] = known(kind, given or {}, table.data, context)
            if given is not None:
                tasks += [] if kind == "branch" else [Task(kind, given.pop("name"), given)]
                branches += [BranchPlan(origin=given.pop("from"), **given)] if kind == "branch" else []
    _claim_branches(named, root, context)
    if not count and not context.problems:
        wanted = ", ".join(f"[[{spec.table}]]" for kind, spec in KINDS.items() if kind != "branch")
        missing = "" if "branch" in root.data else "this key is missing: "
        context.problems.append(
            root.error("branch", f"{missing}a study needs at least one [[branch]], or another result: {wanted}")
        )
    plots = []
    for table in _tables(root, "plot", context):
        given = read(table, PLOT, context)
        if isinstance(table.data.get("file"), str):
            _claim(places, "file", [table.data["file"]], table, context)
        plots += [PlotPlan(**given)] if given is not None else []
    sweep, asked = None, friction or FRICTION[0]
    with context.noting():
        asked = friction or root.text("friction", FRICTION[0])
        if context.mechanism is not None:
            sweep = read_sweep(root, context.mechanism, tuple(branches))
    answer = read_answer(root, context)
    made = tuple(branches), tuple(plots), tuple(tasks)
    return Study(root.file, context.mechanism, *made, sweep, asked, answer, dict(context.common))


def _tables(root: Table, key: str, context: Context) -> Sequence[Table]:
    found: Sequence[Table] = ()
    with context.noting():
        found = root.tables(key)
    return found


def _claim(places: dict[str, str], key: str, files: Sequence[str], table: Table, context: Context) -> None:
    """Note names that would share a file, also where case makes no difference."""
    name = table.data[key]
    with context.noting():
        for file in files:
            earlier = places.setdefault(file.casefold(), table.where)
            if earlier != table.where:
                raise table.error(key, f"'{name}' is the {key} of {earlier} already")


def _claim_branches(named: Sequence[Table], root: Table, context: Context) -> None:
    """Refuse names of what is written besides: the branches of a diagram, and a sweep's tables."""
    diagrams = {name.casefold(): name for name, known in context.known.items() if known.kind == "diagram"}
    for table in named:
        name = table.data["name"]
        stem, _, number = name.casefold().rpartition("_")
        with context.noting():
            if number.isdecimal() and stem in diagrams:
                raise table.error("name", f"'{name}' is what a branch of the diagram '{diagrams[stem]}' is called")
            if "sweep" in root.data and name.casefold() == "sweep":
                raise table.error("name", f"'{name}' is what the table of the study's sweep is called")


def parse(path: Path) -> dict[str, Any]:
    """Return the tables of a study file.

    Raises
    ------
    StudyError
        If there is no such file, or it is no TOML.
    """
    if not path.is_file():
        what = "is a folder, not a file" if path.is_dir() else "no such file"
        names = shipped_studies()
        raise StudyError(f"study '{path}': {what}.{did_you_mean(path.stem, names)} Studies that ship with mjcont: "
                         f"{', '.join(names)}.")
    try:
        text = path.read_text(encoding="utf-8-sig")  # editors on Windows begin files with a mark
    except (UnicodeDecodeError, OSError) as error:
        raise StudyError(f"study '{path}' cannot be read as text: {error}") from error
    try:
        return tomllib.loads(text)
    except ValueError as error:
        if text.lstrip().startswith("<"):
            first = f"`mjcont init {path}` writes a first study of it"
            raise StudyError(f"study '{path}': this is a model; {first}") from error
        raise StudyError(f"study '{path}': not valid TOML: {error}") from error


def _load_model(root: Table, folder: Path, friction: str | None) -> Mechanism:
    name, asked = root.text("model"), root.text("friction", FRICTION[0])
    if asked not in FRICTION:
        raise root.error("friction", unknown_name("choice", asked, FRICTION))
    friction = friction or asked
    beside = folder / name
    with about(root, "model"):
        if beside.suffix.lower() in RESULT_SUFFIXES:
            return model_in(beside)
        if not beside.is_file() and name in shipped_models():
            return Mechanism.from_xml(name, friction=friction)
        return Mechanism.from_xml(beside, friction=friction)


def model_in(path: Path) -> Mechanism:
    """Return the mechanism that a result file carries.

    Raises
    ------
    ResultFileError
        If the file cannot be read, or carries none.
    """
    problem = getattr(load(path), "problem", None)
    if not isinstance(problem, Mechanism):
        raise ResultFileError(f"result file '{path}' carries no model: name the MJCF file itself")
    return problem


def _declare(declare: Table, name: str, mechanism: Mechanism) -> None:
    table = declare.table(name)
    table.only(*DECLARE["properties"])
    table.require(*DECLARE["required"])
    known = mechanism.parameters.get(name)
    if not _NAME.fullmatch(name):
        raise declare.error(name, "a parameter's name consists of letters, digits and '_'")
    if (known is not None and known.kind != "control") or name in mechanism.observables:
        raise declare.error(name, "the model has a parameter or an observable of this name: choose another")
    unit = table.text("unit")
    bounds = pair(table, "bounds", unit) if "bounds" in table.data else None
    targets = table.texts("targets")
    if not targets:
        raise table.error("targets", "expected at least one target, such as ['joint:hip.stiffness']")
    with about(table, "targets"):
        mechanism.declare(name, *targets, unit=unit, bounds=bounds)
