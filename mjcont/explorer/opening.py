"""What a session begins with: a model, a study or a result becomes tables of a study, and results that are there."""

from __future__ import annotations

import tomllib
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from mjcont.errors import MjcontError, ResultFileError, StudyError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.loading import needs_files, read_source, shipped_models
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.settings import Settings
from mjcont.results.branch import Branch
from mjcont.results.files import RESULT_SUFFIXES
from mjcont.results.formats import load
from mjcont.studies.first import first_look
from mjcont.studies.forms import FILE_STEM
from mjcont.studies.plans import check_study, located, parse
from mjcont.studies.schema import toml_text

# s after which whoever opened a model would rather choose what to vary
_SOON = 15.0
_SETTINGS = frozenset(s.name for s in fields(Settings))


@dataclass(frozen=True, slots=True)
class Opened:
    """The tables of a study, and what is there besides.

    Attributes
    ----------
    tables : as TOML has them; none of a result in a bare model's, and of a result that no table computes again.
    results : by name, those that need not be computed any more.
    mechanism : the model, None where the tables are to be read for it.
    computes : whether there is something to compute before the first click.
    notes : sentences, on files of the model that are not there, say.
    """

    tables: Mapping[str, Any]
    results: Mapping[str, Any] = field(default_factory=dict)
    mechanism: Mechanism | None = None
    computes: bool = True
    notes: tuple[str, ...] = ()


def opened(source: str) -> Opened:
    """Return what a session begins with: of a model, of a study (`.toml`), or of a result file (`.h5`).

    Raises
    ------
    MjcontError
        If it cannot be read, or has no model.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        found = _opened(Path(source), source)
    return replace(found, notes=tuple(dict.fromkeys(str(w.message) for w in caught)))


def _opened(path: Path, source: str) -> Opened:
    if path.suffix.lower() == ".toml":
        return _of_study(path)
    if path.suffix.lower() in RESULT_SUFFIXES:
        return _of_result(path)
    if not path.is_file() and source in shipped_models():
        return Opened({"model": source}, mechanism=Mechanism.from_xml(source))
    return Opened({"model": str(path.resolve())}, mechanism=Mechanism.from_xml(path))


def reopened(study: str) -> Opened:
    """Return what goes on with the text of a session's study."""
    return Opened(tomllib.loads(study))


def _of_study(given: Path) -> Opened:
    path = located(given)
    study, problems = check_study(path)
    if study is None:
        more = f" ({len(problems) - 1} more: see `mjcont check`)" if len(problems) > 1 else ""
        raise StudyError(problems[0] + more)
    tables = parse(path)
    beside = path.parent / tables["model"]
    return Opened({**tables, **({"model": str(beside.resolve())} if beside.is_file() else {})})


def _of_result(path: Path) -> Opened:
    """Return a result, with the table that computes it again where it is a branch of equilibria."""
    result = load(path)
    mechanism = getattr(result, "problem", None)
    if not isinstance(mechanism, Mechanism):
        raise ResultFileError(f"'{path}' carries no model of a mechanism: the explorer needs one")
    tables: dict[str, Any] = {"model": str(path.resolve())}
    if isinstance(result, Branch) and result.kind == "equilibria":
        tables |= _again(path, result, mechanism)
    return Opened(tables, {_called(path): result}, mechanism, computes=False)


def study_of(path: Path, result: Any) -> tuple[str, dict[str, str]]:
    """Return the text of a study that computes a stored branch of equilibria again, and the files that it names.

    Both are empty for other results, and for models that cannot be told in one text.
    """
    mechanism = getattr(result, "problem", None)
    if not isinstance(mechanism, Mechanism) or not isinstance(result, Branch) or result.kind != "equilibria":
        return "", {}
    told = told_model(mechanism)
    if told is None:
        return "", {}
    model, files = told
    return toml_text({"model": model, **_again(path, result, mechanism)}), files


def told_model(mechanism: Mechanism) -> tuple[str, dict[str, str]] | None:
    """Return what a study calls a model wherever it lies, and the texts of the files that go with it, by name.

    A shipped model has its name; another is a file. None of a model that needs more files, or has parameters that were
    declared in Python.
    """
    text, name = mechanism.mjcf, mechanism.name
    if text is None or mechanism.declared:
        return None
    if name in shipped_models() and read_source(name)[0] == text:
        return name, {}
    if needs_files(text):
        return None
    file = f"{name if FILE_STEM.fullmatch(name) else 'model'}.xml"
    return file, {file: text}


def _called(path: Path) -> str:
    """Return what the result in a file is called: as the file, unless a study's may not be called so."""
    return path.stem if FILE_STEM.fullmatch(path.stem) else "result"


def _again(path: Path, branch: Branch, mechanism: Mechanism) -> dict[str, Any]:
    """Return the tables that compute a branch again, from its own start."""
    usual = mechanism.values()
    fixed = {n: float(v) for n, v in branch.fixed.items() if n not in usual or usual[n] != v}
    ((name, bounds),) = branch.free.items()
    start = branch.start_index
    ways = {0: 1, len(branch) - 1: -1}
    one_way = {"direction": ways[start]} if len(branch.ends) == 1 and start in ways else {}
    table = {
        "name": _called(path), "parameter": name, "bounds": [float(b) for b in bounds],
        "start": {name: float(branch[name][start])}, "state": [float(x) for x in branch.states[start]], **one_way,
    }
    settings = {n: v for n, v in branch.settings.items() if n in _SETTINGS}
    zeros = {n: list(v) if isinstance(v, list | tuple) else v for n, v in branch.settings.get("zeros", {}).items()}
    table |= {key: value for key, value in (("settings", settings), ("zeros", zeros)) if value}
    return {"parameters": fixed, "branch": [table]} if fixed else {"branch": [table]}


def first_table(mechanism: Mechanism) -> dict[str, Any] | None:
    """Return the table of a first branch of a model, None if nothing that moves it is found soon."""
    try:
        with clock.limited(_SOON):
            look = first_look(mechanism)
    except (MjcontError, clock.TimeUp):
        return None
    low, high = look.bounds
    value = look.parameter.value
    inside = {} if low <= value <= high else {"start": {look.parameter.name: 0.5 * (low + high)}}
    key = {"keyframe": look.keyframe} if look.keyframe is not None else {}
    return {"parameter": look.parameter.name, "bounds": [low, high], **inside, **key}
