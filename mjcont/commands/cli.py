"""The command line, `mjcont`. Every error that a user can cause is one line on stderr and exit status 2.

What a command needs is imported when it runs, so `mjcont --help` is quick.
"""

from __future__ import annotations

import argparse
import shlex
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mjcont.commands import animate, first
from mjcont.commands.arguments import parser
from mjcont.errors import MjcontError, ModelError, ResultFileError
from mjcont.outside.interrupts import ended_by, termination_unwinds
from mjcont.outside.saving import check_writable
from mjcont.outside.terminal import complain, live_stream, say
from mjcont.results.quantities import FRICTION

if TYPE_CHECKING:
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.results.branch import Branch
    from mjcont.results.points import Point

OK, FAILED, USER_ERROR, INTERRUPTED = 0, 1, 2, 130
# modes that `inspect` shows
_MODES = 6
_RESULT_SUFFIXES = (".h5", ".hdf5")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments; default those of the process.

    Returns
    -------
    int
        0; 1 if a figure could not be reproduced; 2 after a user's error; 130 if interrupted (143 by SIGTERM).
    """
    args = parser(_COMMANDS).parse_args(argv)
    try:
        with termination_unwinds():
            return int(args.command(args))
    except KeyboardInterrupt:
        return _complain("interrupted", INTERRUPTED)
    except ImportError as error:
        ending = ended_by(error)
        if ending is None:
            raise
        return ending if ending != INTERRUPTED else _complain("interrupted", INTERRUPTED)
    except MjcontError as error:
        return _complain(f"error: {error}", USER_ERROR)
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return _complain(f"error: {place}{error.strerror or error}", USER_ERROR)


def _complain(message: str, status: int) -> int:
    complain(f"mjcont: {message}")
    return status


# -- commands ----------------------------------------------------------------------------------------------


def _inspect(args: argparse.Namespace) -> int:
    if _is_result(args.model):
        say(str(_load(args.model)))
    else:
        from mjcont.mechanism.mechanism import Mechanism
        from mjcont.models.loading import files_read

        with _warnings_as_lines():
            mechanism = Mechanism.from_xml(args.model, friction=args.friction or FRICTION[0])
        say(str(mechanism))
        say("\n".join(["", "modes", *_mode_lines(mechanism)]))
        say("\n".join(["", "files that this model reads", *(f"  {name}" for name in files_read(args.model))]))
        say(f"\nnext: mjcont init {shlex.quote(args.model)}")
    return OK


def _mode_lines(mechanism: Mechanism) -> list[str]:
    """Return the slowest modes at the rest to which the model as loaded belongs, or why there are none."""
    from mjcont.curves.continuation import find_equilibrium
    from mjcont.oscillation.modes import modes

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            rest = find_equilibrium(mechanism)
            found = modes(rest)
    except MjcontError as error:
        return [f"  {error}"]
    return [f"  of the {rest.stability} rest that qpos0 belongs to", *found.table(_MODES), *found.notes]


def _run(args: argparse.Namespace) -> int:
    from mjcont.commands.progress import Table
    from mjcont.studies.reporter import Reporter
    from mjcont.studies.study import interruption, load_study, run_study

    with _warnings_as_lines():
        study = load_study(args.study, friction=args.friction)
    if args.quiet:
        reporter = Reporter()
    else:
        reporter = Table(say, live_stream())
    results = run_study(study, args.out, reporter)
    ended = interruption(study, results, args.out)
    return _complain(ended, INTERRUPTED) if ended else OK


def _check(args: argparse.Namespace) -> int:
    from mjcont.studies.study import check_study, summary

    with _warnings_as_lines():
        study, problems = check_study(args.study, friction=args.friction)
    for line in problems:
        complain(line)
    if study is not None:
        say(summary(study))
    return USER_ERROR if problems else OK


def _sweep(args: argparse.Namespace) -> int:
    from mjcont.commands.sweep import run

    with _warnings_as_lines():
        run(args, say)
    return OK


def _plot(args: argparse.Namespace) -> int:
    from mjcont.drawing.plotting import plot, save_figure
    from mjcont.results.branch import Branch

    out = _output(args.out, ".png", args.files)
    branches = [_load_curve(file) for file in args.files]
    for file, branch in zip(args.files, branches, strict=True):
        for column in (args.x, args.y):
            with _naming(file):
                _ = [branch[name] for name in (branch.drawn(column) if isinstance(branch, Branch) else [column])]
    axes: Any = plot(*branches, x=args.x, y=args.y, labels=args.labels, degrees=args.degrees, title=args.title,
                     units=[u for u in args.units.split(",") if u], key=args.legend, legend=args.legend and None)
    save_figure(axes.figure, out)
    say(f"plot: {out}")
    return OK


def _sensitivities(args: argparse.Namespace) -> int:
    from mjcont.influence.sensitivities import sensitivities

    for out in filter(None, (args.out, args.csv)):
        _output(out, "", [args.file])
    branch = _load_branch(args.file)
    with _naming(args.file):
        found = sensitivities(branch.point(args.label), args.parameter, quantities=args.quantity)
    say(str(found))
    if args.csv:
        say(f"written: {found.to_csv(args.csv)}")
    if args.out:
        from mjcont.drawing.plotting import save_figure

        say(f"plot: {save_figure(found.plot().figure, args.out)}")
    return OK


def _view(args: argparse.Namespace) -> int:
    from mjcont.drawing.poses import mechanism_of
    from mjcont.drawing.viewer import view

    point = _point_of_result(args) if _is_result(args.model) else _point_of_model(args)
    if point is not None:
        say(str(point))
        view(mechanism_of(point), point.state, point.parameters)
        return OK
    from mjcont.mechanism.mechanism import Mechanism

    with _warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model)
    view(mechanism, mechanism.start_state(args.keyframe), mechanism.values())
    return OK


def _reproduce(args: argparse.Namespace) -> int:
    from mjcont.paper.reproduce import reproduce

    result = reproduce(args.figures or None, args.out, jobs=args.jobs, force=args.force, say=say)
    return FAILED if result.failed else OK


def _report(args: argparse.Namespace) -> int:
    from mjcont.paper.extended import report

    options = {"extended": args.extended, "only": args.only, "jobs": args.jobs, "force": args.force}
    return FAILED if report(args.out, **options, say=say).failed else OK


def _bush(args: argparse.Namespace) -> int:
    from mjcont.models.bushes import bushed_xml
    from mjcont.outside.saving import write_file

    out = Path(args.out)
    _refuse_input(out, [args.model], "model")
    with _warnings_as_lines():
        text = bushed_xml(
            args.model, args.joint, args.connect, stiffness=args.stiffness, damping=args.damping, frame=args.frame
        )
    _check_written(Path(args.model), text, out)
    out.parent.mkdir(parents=True, exist_ok=True)
    write_file(out, text)
    say(f"written: {out}")
    return OK


def _check_written(model: Path, text: str, out: Path) -> None:
    """Raise a ModelError unless a text compiles where it is to be written, with all the files that its model has."""
    from mjcont.models.loading import compile_spec, parse_present

    spec, missing = parse_present(text, out.resolve().parent, f"'{out}'")
    compile_spec(spec)
    if model.is_file() and missing != parse_present(text, model.resolve().parent, f"'{model}'")[1]:
        raise ModelError(f"'{out}': {missing[0]}: files beside the model must be beside it, too")


def _export(args: argparse.Namespace) -> int:
    out = _output(args.out, ".csv", [args.file])
    result = _load(args.file)
    say(f"written: {result.to_csv(out, degrees=args.degrees)}")
    return OK


# -- points and files --------------------------------------------------------------------------------------


def _is_result(name: str) -> bool:
    return Path(name).suffix.lower() in _RESULT_SUFFIXES


@contextmanager
def _warnings_as_lines() -> Iterator[None]:
    """Print each warning for the user as one line, once the work that gives it is done."""
    import warnings

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        yield
    for warning in caught:
        complain(f"mjcont: warning: {warning.message}")


@contextmanager
def _naming(file: str) -> Iterator[None]:
    """Let an error name the file that it is about."""
    try:
        yield
    except MjcontError as error:
        raise type(error)(f"'{file}': {error}") from error


def _load(path: str) -> Any:
    from mjcont.results.formats import load

    with _warnings_as_lines():
        return load(path)


def _refuse_input(out: Path, inputs: Sequence[str], what: str) -> None:
    """Refuse to write over what is read."""
    for file in inputs:
        if out.exists() and Path(file).exists() and out.samefile(file):
            raise MjcontError(f"'{out}' is the {what} itself: give the new one a name of its own")


def _output(given: str | None, suffix: str, inputs: Sequence[str]) -> Path:
    """Return the file to be written, by default beside the first input, known to be writable and not read."""
    out = Path(given) if given else Path(inputs[0]).with_suffix(suffix)
    _refuse_input(out, inputs, "input")
    check_writable(out)
    return out


def _load_curve(path: str) -> Any:
    """Read a branch, a locus or a load path."""
    result = _load(path)
    for mark, words in (("velocities", "time history"), ("cases", "sweep")):
        if hasattr(result, mark):
            raise ResultFileError(f"'{path}' holds a {words}: inspect and export take it, this command takes curves")
    return result


def _load_branch(path: str) -> Branch:
    """Read a result that has points of its own to be named."""
    from mjcont.results.branch import Branch

    result = _load_curve(path)
    if not isinstance(result, Branch):
        raise ResultFileError(f"'{path}' holds a load path: this command takes a branch or a locus")
    return result


def _point_of_model(args: argparse.Namespace) -> Point | None:
    """Return the equilibrium that --at asks for, or None for a pose as it stands in the model."""
    from mjcont.curves.continuation import find_equilibrium
    from mjcont.mechanism.mechanism import Mechanism

    if args.label:
        raise MjcontError("--label goes with a result file; for a model use --keyframe or --at")
    if not args.at:
        return None
    with _warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model)
    return find_equilibrium(
        mechanism, {name: _value(name, text, mechanism.parameter(name).unit) for name, text in args.at}
    )


def _point_of_result(args: argparse.Namespace) -> Point:
    """Return the point of a stored branch that --label or --at asks for, or its start."""
    from mjcont.results.points import show

    if args.keyframe:
        raise MjcontError("--keyframe goes with a model; for a result file use --label or --at")
    branch = _load_branch(args.model)
    if branch.problem is None:
        raise ResultFileError(f"result file '{args.model}' holds no model to view")
    if args.label:
        with _naming(args.model):
            return branch.point(args.label)
    if not args.at:
        return branch.row(branch.start_index)
    if len(args.at) > 1:
        raise MjcontError("a point of a result file has one --at, such as --at F=20")
    ((name, text),) = args.at
    with _naming(args.model):
        points = branch.at(**{name: _value(name, text, branch.unit(name))})
    if not points:
        low, high = (show(end, branch.unit(name)) for end in (branch[name].min(), branch[name].max()))
        raise MjcontError(f"'{args.model}' has no point with {name} = {text}: {name} goes from {low} to {high}")
    if len(points) > 1:
        say(f"{len(points)} points have {name} = {text}; this is the first stable one, or the first of all:")
    return next((p for p in points if p.stability == "stable"), points[0])


def _value(name: str, text: str, unit: str) -> float:
    from mjcont.studies.schema import quantity

    try:
        return quantity(text, unit)
    except ValueError as error:
        raise MjcontError(f"--at {name}: {error}") from error


def _animate(args: argparse.Namespace) -> int:
    return animate.run(args, say)


def _init(args: argparse.Namespace) -> int:
    with _warnings_as_lines():
        first.init(args, say)
    return OK


def _compare(args: argparse.Namespace) -> int:
    with _warnings_as_lines():
        first.compare(args, say)
    return OK


def _answer(args: argparse.Namespace) -> int:
    with _warnings_as_lines():
        first.answer(args, say)
    return OK


_COMMANDS = {
    "answer": _answer,
    "compare": _compare,
    "init": _init,
    "inspect": _inspect,
    "run": _run,
    "check": _check,
    "sweep": _sweep,
    "plot": _plot,
    "animate": _animate,
    "sensitivities": _sensitivities,
    "view": _view,
    "reproduce": _reproduce,
    "report": _report,
    "bush": _bush,
    "export": _export,
}
