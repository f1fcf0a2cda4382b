"""The paper's figures: finding their scripts, drawing them in parallel processes, and reporting their findings.

A script `figNN.py` has a docstring (first line the title, the rest the caption) and `main(out)`, which draws
`out/figNN.png` and returns its findings. A figure whose script, models and mjcont are what they were is not
drawn again. Scripts stand beside the package in a checkout and inside it in the wheel.
"""

from __future__ import annotations

import argparse
import ast
import hashlib
import importlib.util
import json
import multiprocessing
import os
import platform
import re
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from importlib import metadata, resources
from multiprocessing import connection
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, NameLookupError
from mjcont.models.loading import models_folder
from mjcont.numerics.equations.problem import Array
from mjcont.outside.interrupts import held
from mjcont.outside.processes import end_with_parent, starting
from mjcont.outside.saving import output_folder, write_file
from mjcont.outside.sealing import digest
from mjcont.paper.findings import FigureResult, Finding, label_of, stem
from mjcont.paper.report import as_html, headline, markdown, verdict
from mjcont.paper.twins import twins
from mjcont.results.branch import Branch

Progress = Callable[[Sequence[str], int, int], None]
_SCRIPT = re.compile(r"fig(\d\d)\.py")
# figures that take longest are started first, so that no processor waits for one of them at the end
_LONGEST = (15, 11, 8, 9, 2, 12, 14)


@dataclass(frozen=True, slots=True)
class ReproduceResult:
    """The results of the figures and studies asked for, and the HTML report; `report.md` lies beside it."""

    figures: dict[int | str, FigureResult]
    report: Path

    @property
    def failed(self) -> list[int | str]:
        """Figures and studies that could not be drawn."""
        return [n for n, r in self.figures.items() if r.reason]

    @property
    def findings(self) -> dict[int | str, tuple[Finding, ...]]:
        """The findings of each figure asked for."""
        return {n: r.findings for n, r in self.figures.items()}


def whole(branch: Branch) -> Branch:
    """Return the branch if both its ends are regular: a figure must not show part of a curve as if it were all.

    Raises
    ------
    MjcontError
        With the branch's own sentence, if it ended elsewhere.
    """
    if branch.status not in ("at bound", "closed"):
        raise MjcontError(f"{branch.name}, {branch.kind} in {', '.join(branch.free)}: {branch.message}")
    return branch


def distances(points: Array, curve: Array) -> Array:
    """Return the distance of each point (N, 2) from a polyline (M, 2), (N,)."""
    start, along = curve[:-1], np.diff(curve, axis=0)
    length = np.maximum(np.sum(along**2, axis=1), np.finfo(float).tiny)
    away = points[:, None] - start
    foot = np.clip(np.sum(away * along, axis=2) / length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(away - foot[:, :, None] * along, axis=2).min(axis=1))


def run_script(main: Callable[[Path], Sequence[Finding]]) -> None:
    """Run a figure's `main` from the command line, `-o DIR`, and print its findings."""
    parser = argparse.ArgumentParser(description=(sys.modules[main.__module__].__doc__ or "").partition("\n")[0])
    parser.add_argument("-o", "--out", type=Path, default=Path("out"), help="folder for the picture (default: out)")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    findings = main(out)
    print("\n".join(f"[{verdict(f)}] {f.model and f.model + ': '}{f.claim}\n    {f.computed}" for f in findings))


def scripts_folder() -> Path:
    """Return the folder of the figure scripts: in the wheel, or beside the package in a checkout."""
    package = Path(str(resources.files("mjcont")))
    installed = package / "scripts"
    return installed if installed.is_dir() else package.parent / "scripts"


def available() -> list[int]:
    """Return the numbers of the figures that can be drawn."""
    return sorted(int(m[1]) for p in scripts_folder().glob("fig*.py") if (m := _SCRIPT.fullmatch(p.name)))


def reproduce(
    figures: Sequence[int] | None,
    out: str | Path,
    *,
    jobs: int | None = None,
    force: bool = False,
    say: Callable[[str], None] = print,
    progress: Progress | None = None,
) -> ReproduceResult:
    """Draw figures of the paper and write `report.html` and `report.md` on their findings into a folder.

    Parameters
    ----------
    figures : sequence of int, optional
        Their numbers; None or none for all there are.
    out : path
        Folder, made if need be. It gets figNN.png, figNN.json, and figNN.html, the figure's curves beside the
        mechanism (of a second model figNN.MODEL.html); the report covers every figure in it that is up
        to date, those of earlier runs as well.
    jobs : int, optional
        Processes at a time; default one a processor.
    force : bool
        Draw figures again that are up to date.
    say : callable
        Takes a line on each figure.
    progress : callable, optional
        `progress(running, done, all)` whenever a figure begins or ends; `running` are those being drawn.

    Raises
    ------
    MjcontError
        If a number is unknown (the message lists those there are) or the folder cannot be made. A figure that
        fails is no exception: see `ReproduceResult.failed`.
    """
    return draw(_chosen(figures), available(), out, jobs=jobs, force=force, say=say, progress=progress)


def draw(
    chosen: Sequence[int | str],
    covered: Sequence[int | str],
    out: str | Path,
    *,
    jobs: int | None = None,
    force: bool = False,
    say: Callable[[str], None] = print,
    progress: Progress | None = None,
) -> ReproduceResult:
    """Draw figures and studies, and write the report on those `covered` that are up to date; see `reproduce`."""
    out = Path(out)
    if jobs is not None and jobs < 1:
        raise MjcontError(f"jobs must be at least 1, got {jobs}")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise MjcontError(f"cannot make the folder {out}: {error.strerror or error}") from error
    output_folder(out)
    stamps = {n: _stamp(n) for n in dict.fromkeys([*covered, *chosen])}
    results = {n: r for n in stamps if (r := _up_to_date(out, n, stamps[n])) is not None}
    todo = [n for n in chosen if force or n not in results or results[n].reason]
    for n in [n for n in chosen if n not in todo]:
        say(f"{results[n]} (up to date)")
    try:
        for result in _draw_all(todo, out, stamps, jobs or os.cpu_count() or 1, progress):
            results[result.figure] = result
            say(str(result))
    finally:
        done = [results[n] for n in stamps if n in results]
        write_file(out / "report.md", markdown(done, versions()))
        report = write_file(out / "report.html", as_html(done, versions()))
    say(headline(done))
    say(f"report: {report}")
    return ReproduceResult({n: results[n] for n in chosen}, report)


def _chosen(figures: Sequence[int] | None) -> list[int]:
    there = available()
    if not there:
        raise MjcontError(f"there are no figure scripts in {scripts_folder()}: mjcont is not installed completely")
    chosen = sorted(set(figures or there))
    for n in chosen:
        if n not in there:
            raise NameLookupError(f"unknown figure {n}. Valid: {', '.join(map(str, there))}.")
    return chosen


def _draw_all(
    todo: Sequence[int | str], out: Path, stamps: dict[int | str, str], jobs: int, progress: Progress | None
) -> Iterator[FigureResult]:
    """Draw figures in processes of their own, so that one that crashes harms no other; yield each as it ends."""
    context = multiprocessing.get_context("spawn")
    waiting = sorted(todo, key=lambda n: _LONGEST.index(n) if n in _LONGEST else len(_LONGEST))
    running: dict[Any, tuple[int | str, Any]] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                n = waiting.pop(0)
                process = context.Process(target=_draw, args=(n, _script(n), out, stamps[n]), name=label_of(n))
                with held(), starting():
                    process.start()
                    running[process.sentinel] = (n, process)
            if progress is not None:
                progress([label_of(n) for n, _ in running.values()], len(todo) - len(waiting) - len(running), len(todo))
            for sentinel in connection.wait(list(running)):
                n, process = running.pop(sentinel)
                process.join()
                result = _read(out, n)
                if result is None:
                    result = _result(n, _script(n), (), f"its process ended with code {process.exitcode}", stamps[n])
                    write_record(_record(out, n), result, out / result.image)
                yield result
    finally:
        for _, process in running.values():
            process.kill()
        for _, process in running.values():
            process.join()


def _draw(figure: int | str, script: Path, out: Path, stamp: str) -> None:
    """Draw one figure in this process, made for it, and write its json."""
    import matplotlib

    # An interrupt ends this process: continuation would take it as a wish for a partial branch.
    end_with_parent(signal.SIG_DFL)
    matplotlib.rcdefaults()
    png, record = out / f"{stem(figure)}.png", _record(out, figure)
    for old in (record, png, *(out / p for p in twins(out, stem(figure)))):
        old.unlink(missing_ok=True)
    findings: tuple[Finding, ...] = ()
    reason = ""
    try:
        findings = tuple(load_script(script).main(out))
        if not png.is_file():
            raise MjcontError(f"{script.name} drew no {png.name}")
    except Exception as error:
        findings, reason = (), _one_line(error)
    write_record(record, _result(figure, script, findings, reason, stamp, twins(out, stem(figure))), png)


def load_script(script: Path) -> ModuleType:
    """Return the module of a figure's script, which may import its neighbours."""
    if str(script.parent) not in sys.path:
        sys.path.insert(0, str(script.parent))
    spec = importlib.util.spec_from_file_location(script.stem, script)
    if spec is None or spec.loader is None:
        raise MjcontError(f"cannot load {script}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up there
    spec.loader.exec_module(module)
    return module


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text if isinstance(error, MjcontError) else f"{type(error).__name__}: {text}"


def _result(
    figure: int | str, script: Path, findings: Sequence[Finding], reason: str, stamp: str, pages: tuple[str, ...] = ()
) -> FigureResult:
    try:
        doc = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or ""
    except SyntaxError:
        doc = ""
    first, _, caption = doc.partition("\n")
    title = first.rstrip(".") or label_of(figure).capitalize()
    return FigureResult(figure, title, caption.strip(), tuple(findings), reason, stamp, pages)


def _script(figure: int | str) -> Path:
    return scripts_folder() / f"{stem(figure)}.py"


def _record(out: Path, figure: int | str) -> Path:
    return out / f"{stem(figure)}.json"


def write_record(record: Path, result: FigureResult, png: Path) -> None:
    """Store what a figure gave, with the digests of that and of its picture."""
    data: dict[str, Any] = asdict(result)
    data["picture"] = hashlib.sha256(png.read_bytes()).hexdigest() if png.is_file() else ""
    write_file(record, json.dumps({**data, "sha256": digest(data)}, indent=2) + "\n")


def _read(out: Path, figure: int | str) -> FigureResult | None:
    """Return what is stored of a figure, None unless it and the picture are as they were written."""
    try:
        data: dict[str, Any] = json.loads(_record(out, figure).read_text(encoding="utf-8"))
        if data.pop("sha256") != digest(data):
            return None
        picture = data.pop("picture")
        own = {"findings": tuple(Finding(**f) for f in data["findings"]), "pages": tuple(data["pages"])}
        result = FigureResult(**{**data, **own})
        if picture and hashlib.sha256((out / result.image).read_bytes()).hexdigest() != picture:
            return None
        return result
    except (OSError, ValueError, TypeError, LookupError, AttributeError, RecursionError):
        return None


def _up_to_date(out: Path, figure: int | str, stamp: str) -> FigureResult | None:
    """Return the result of an earlier run with the same script, models and sources, a failure among them."""
    result = _read(out, figure)
    fresh = result is not None and result.stamp == stamp and (
        bool(result.reason) or all((out / file).is_file() for file in (result.image, *result.pages)))
    return result if fresh else None


def versions() -> dict[str, str]:
    """Return the versions that decide what a figure looks like."""
    import mjcont

    names = ("mujoco", "numpy", "scipy", "matplotlib")
    found = {"mjcont": mjcont.__version__, "python": platform.python_version()}
    return found | {name: metadata.version(name) for name in names}


def _stamp(figure: int | str) -> str:
    """Return a hash of all that a figure is made from: its script, helpers, models, mjcont's sources, versions."""
    package, scripts = Path(str(resources.files("mjcont"))), scripts_folder()
    helpers = scripts.glob("_*.py")
    sources = [p for p in package.rglob("*.py") if scripts not in p.parents]
    sources += (package / "explorer" / "web" / "dist").glob("explorer.*")
    files = [_script(figure), *sorted(helpers), *sorted(models_folder().glob("*.xml")), *sorted(sources)]
    digest = hashlib.sha256(json.dumps(versions(), sort_keys=True).encode())
    for path in files:
        digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()
