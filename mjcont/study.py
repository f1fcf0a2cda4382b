"""Studies: files that name a model, parameter values, branches and plots, and what runs them.

docs/studies.md describes the files, `plans` reads and checks them.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mjcont.branch import Branch, show
from mjcont.collect import units
from mjcont.continuation import continue_equilibria
from mjcont.errors import MjcontError
from mjcont.plans import BranchPlan, PlotPlan, Study, load_study
from mjcont.progress import Reporter

__all__ = ["BranchPlan", "PlotPlan", "Study", "load_study", "output_folder", "run_study"]

_SHOWN = 4


def run_study(study: Study, out: str | Path, reporter: Reporter | None = None) -> list[Branch]:
    """Compute the branches of a study, storing each in the folder `out` as soon as it is done, and draw its plots.

    An interrupted branch is stored with the points it has, and is the last.

    Parameters
    ----------
    study : Study
    out : path
        A folder, made if it is missing. Files in it of the same names are replaced.
    reporter : Reporter, optional
        Hears how the run goes; default nobody.

    Returns
    -------
    list of Branch

    Raises
    ------
    MjcontError
        If the folder cannot be written to, or a branch has no start; the branches before it are kept.
    """
    reporter = reporter or Reporter()
    folder = output_folder(out)
    done: dict[str, Branch] = {}
    for plan in study.branches:
        branch = _compute(study, plan, reporter)
        done[plan.name] = branch
        reporter.finished(branch, _store(branch, plan, folder))
        if branch.interrupted:
            break
        for plot in study.plots:
            if plan.name in plot.branches and done.keys() >= set(plot.branches):
                reporter.plotted(draw(plot, done, folder))
    return list(done.values())


def output_folder(path: str | Path) -> Path:
    """Return a folder, made if it is missing, after trying to write to it."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = "it is a file" if folder.is_file() else error.strerror
        raise MjcontError(f"cannot write to the output folder '{path}': {reason}") from error
    return folder


def _compute(study: Study, plan: BranchPlan, reporter: Reporter) -> Branch:
    reporter.started(plan.name, _task(study, plan), _shown_columns(study, plan))
    try:
        return continue_equilibria(
            study.mechanism,
            plan.parameter,
            plan.bounds,
            plan.start,
            keyframe=plan.keyframe,
            state=plan.state,
            direction=plan.direction,
            zeros=plan.zeros,
            progress=reporter.point,
            **plan.settings,
        )
    except MjcontError as error:
        raise type(error)(f"study '{study.file}': branch '{plan.name}': {error}") from error
    finally:
        reporter.stopped()


def _task(study: Study, plan: BranchPlan) -> str:
    unit_of = units(study.mechanism)
    low, high = (show(b, unit_of[plan.parameter]) for b in plan.bounds)
    fixed = [f"{n} = {show(v, unit_of[n])}" for n, v in plan.start.items() if n != plan.parameter]
    return ", ".join([f"{study.mechanism.name}, {plan.parameter} from {low} to {high}", *fixed])


def _shown_columns(study: Study, plan: BranchPlan) -> list[tuple[str, str]]:
    """Return the columns worth watching, with units: the parameter, what the study asks about, other observables."""
    unit_of = units(study.mechanism)
    plotted = [c for p in study.plots if plan.name in p.branches for c in (p.x, p.y)]
    wanted = dict.fromkeys([plan.parameter, *plan.zeros, *plotted, *study.mechanism.observables])
    varying = [n for n in wanted if n == plan.parameter or n in study.mechanism.observables]
    return [(n, unit_of[n]) for n in varying[:_SHOWN]]


def _store(branch: Branch, plan: BranchPlan, folder: Path) -> list[Path]:
    files = [branch.save(folder / f"{plan.name}.h5")]
    if plan.csv:
        files.append(branch.to_csv(folder / f"{plan.name}.csv"))
    return files


def draw(plan: PlotPlan, branches: Mapping[str, Branch], folder: Path) -> Path:
    """Draw one plot of a study into a folder and return its file."""
    from mjcont.plotting import plot, save_figure, set_panel_title

    chosen = [branches[name] for name in plan.branches]
    axes: Any = plot(*chosen, x=plan.x, y=plan.y, labels=plan.labels, degrees=plan.degrees)
    if plan.title:
        set_panel_title(axes, plan.title)
    return Path(save_figure(axes.figure, folder / plan.file))
