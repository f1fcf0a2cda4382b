"""Studies: files that name a model, parameter values, what to compute and what to draw, and what runs them.

docs/studies.md describes the files, `plans` reads and checks them, `runs` computes their tables.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mjcont.arguments import checked
from mjcont.curves.continuation import continue_equilibria
from mjcont.errors import MjcontError
from mjcont.outside.saving import output_folder
from mjcont.results.model import units
from mjcont.results.points import show
from mjcont.studies.plans import BranchPlan, PlotPlan, Study, Task, check_data, check_study, load_study
from mjcont.studies.reporter import Range, Reporter
from mjcont.studies.runs import Running, compute, curves_of, interrupted, start_of, store_curve, task_line

__all__ = [
    "BranchPlan", "PlotPlan", "Study", "Task", "check_data", "check_study", "interruption", "load_study", "named",
    "output_folder", "run_plan", "run_study", "summary",
]


@checked
def run_study(study: Study, out: str | Path, reporter: Reporter | None = None) -> list[Any]:
    """Compute what a study asks for, storing each result in the folder `out` as soon as it is done; draw its plots.

    An interrupted curve, search or motion is stored with what it has, and is the last.

    Parameters
    ----------
    study : Study
    out : path
        A folder, made if it is missing. Files in it of the same names are replaced.
    reporter : Reporter, optional
        Hears how the run goes; default nobody.

    Returns
    -------
    list
        The results in the order of `study.plans`: Branch, Equilibria, Diagram, LoadPath, History, ...

    Raises
    ------
    MjcontError
        If the folder cannot be written to, or something cannot be computed; the results before it are kept.
    """
    reporter = reporter or Reporter()
    folder = output_folder(out)
    done: dict[str, Any] = {}
    results: list[Any] = []
    open_plots = list(study.plots)
    for number, plan in enumerate(study.plans, 1):
        place = number, len(study.plans)
        result, files = _compute(study, plan, place, Running(study.mechanism, folder, done, reporter))
        results.append(result)
        done |= named(plan, result)
        reporter.finished(result, files)
        if interrupted(result):
            break
        for plot in [p for p in open_plots if done.keys() >= set(p.branches)]:
            open_plots.remove(plot)
            reporter.plotted(draw(plot, done, folder))
    return results


def named(plan: BranchPlan | Task, result: Any) -> dict[str, Any]:
    """Return a result under its name, and the branches of a diagram D under D_1, D_2, ..."""
    parts = result if isinstance(plan, Task) and plan.kind == "diagram" else ()
    return {plan.name: result, **{f"{plan.name}_{i}": branch for i, branch in enumerate(parts, 1)}}


def run_plan(study: Study, plan: BranchPlan | Task, done: Mapping[str, Any], reporter: Reporter) -> Any:
    """Compute one table of a study from the results that it names, by name; nothing is stored or drawn."""
    return _compute(study, plan, (1, 1), Running(study.mechanism, None, done, reporter))[0]


def interruption(study: Study, results: Sequence[Any], out: str | Path) -> str:
    """Return what there is of a study that the user stopped, a sentence; empty if it went through."""
    if not results or not interrupted(results[-1]):
        return ""
    plan, skipped = study.plans[len(results) - 1], len(study.plans) - len(results)
    points = f"the {len(results[-1])} points so far" if hasattr(results[-1], "__len__") else "what there is so far"
    stored = Path(out) / f"{plan.name}.h5"
    held = f"{stored} holds {points}" if stored.is_file() else f"'{plan.name}' has {points}"
    return f"interrupted: {held}" + (f"; {skipped} more not computed" if skipped else "")


def _compute(
    study: Study, plan: BranchPlan | Task, place: tuple[int, int], at: Running
) -> tuple[Any, list[Path]]:
    """Compute one table of a study and store it; errors name the study and the table."""
    try:
        if isinstance(plan, Task):
            what = f"{study.mechanism.name}, {task_line(study.mechanism, plan)}"
            at.reporter.started(plan.name, what, place, _ranges(study, plan))
            return compute(plan, at)
        at.reporter.started(plan.name, _task(study, plan), place, _ranges(study, plan))
        pose = {"from": plan.origin, "start": plan.start, "keyframe": plan.keyframe, "state": plan.state}
        branch = continue_equilibria(
            study.mechanism,
            plan.parameter,
            plan.bounds,
            **start_of(pose, at.done),
            direction=plan.direction,
            zeros=plan.zeros,
            progress=at.reporter.point,
            **plan.settings,
        )
        return branch, store_curve(branch, plan.name, plan.csv, at.folder)
    except MjcontError as error:
        kind = plan.kind if isinstance(plan, Task) else "branch"
        raise type(error)(f"study '{study.file}': {kind} '{plan.name}': {error}") from error
    finally:
        at.reporter.stopped()


def _ranges(study: Study, plan: BranchPlan | Task) -> dict[str, Range]:
    """Return between which bounds the parameter of a curve is followed."""
    name: str | None
    bounds: tuple[float, float] | None
    if isinstance(plan, BranchPlan):
        name, bounds = plan.parameter, plan.bounds
    else:
        name, bounds = plan.given.get("parameter"), plan.given.get("bounds")
    if not name or not bounds or (isinstance(plan, Task) and plan.kind == "diagram"):  # of how many branches?
        return {}
    own = {"frequency": "Hz", "energy": "J"}
    return {name: Range(*bounds, units(study.mechanism).get(name, own.get(name, "")))}


def _task(study: Study, plan: BranchPlan) -> str:
    unit_of = units(study.mechanism)
    low, high = (show(b, unit_of[plan.parameter]) for b in plan.bounds)
    fixed = [f"{n} = {show(v, unit_of[n])}" for n, v in plan.start.items() if n != plan.parameter]
    return ", ".join([f"{study.mechanism.name}, {plan.parameter} from {low} to {high}", *fixed])


def draw(plan: PlotPlan, results: Mapping[str, Any], folder: Path) -> Path:
    """Draw one plot of a study into a folder and return its file."""
    from mjcont.drawing.plotting import plot, save_figure

    chosen = [curve for name in plan.branches for curve in curves_of(results, name)]
    axes: Any = plot(*chosen, x=plan.x, y=plan.y, labels=plan.labels, degrees=plan.degrees, title=plan.title,
                     units=plan.units, key=plan.legend, legend=None if plan.legend else False)
    return Path(save_figure(axes.figure, folder / plan.file))


def summary(study: Study) -> str:
    """Return what a study would compute and draw, a line each."""
    m, count = study.mechanism, len(study.plans)
    lines = [f"{study.file}: nothing wrong; {m.name}, {m.n} degrees of freedom, {count} result{'s' * (count != 1)}"]
    for plan in study.plans:
        what = task_line(m, plan) if isinstance(plan, Task) else f"branch: {_task(study, plan).partition(', ')[2]}"
        lines.append(f"  {plan.name}: {what}")
    if study.sweep is not None:
        lines += [f"  {p.name}: {p.label}, followed in a sweep by `mjcont sweep`" for p in study.sweep.points]
    lines += [f"  {p.file}: plot of {p.y} against {p.x}, {', '.join(p.branches)}" for p in study.plots]
    return "\n".join(lines)
