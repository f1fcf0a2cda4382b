"""The command line, `mjcont`. Every error that a user can cause is one line on stderr and exit status 2.

What a command needs is imported when it runs, so `mjcont --help` is quick.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mjcont.errors import MjcontError, ResultFileError
from mjcont.quantities import FRICTION

if TYPE_CHECKING:
    from mjcont.branch import Branch, Point

OK, FAILED, USER_ERROR, INTERRUPTED = 0, 1, 2, 130
_RESULT_SUFFIXES = (".h5", ".hdf5")
_EXAMPLES = """examples:
  mjcont inspect overcentre                     what can be continued, what can be read, where to start
  mjcont run studies/overcentre.toml -o out     compute a study's branches, store them, draw its plots
  mjcont plot out/equilibria.h5 -x F -y theta_1
  mjcont sensitivities out/equilibria.h5 LP1    how that fold moves with masses, lengths, stiffnesses
  mjcont view out/equilibria.h5 --label LP1     that pose in MuJoCo's viewer
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments; default those of the process.

    Returns
    -------
    int
        0; 1 if a figure could not be reproduced; 2 after a user's error; 130 if interrupted.
    """
    args = _parser().parse_args(argv)
    try:
        return int(args.command(args))
    except KeyboardInterrupt:
        return _complain("interrupted", INTERRUPTED)
    except MjcontError as error:
        return _complain(f"error: {error}", USER_ERROR)
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return _complain(f"error: {place}{error.strerror or error}", USER_ERROR)


def say(text: str = "") -> None:
    """Print a line at once; when nobody reads any more, go on in silence, so that results are still stored."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _complain(message: str, status: int) -> int:
    print(f"mjcont: {' '.join(message.split())}", file=sys.stderr)
    return status


# -- commands ----------------------------------------------------------------------------------------------


def _inspect(args: argparse.Namespace) -> int:
    if _is_result(args.model):
        say(str(_load(args.model)))
    else:
        from mjcont.mechanism import Mechanism

        with _warnings_as_lines():
            mechanism = Mechanism.from_xml(args.model, friction=args.friction or FRICTION[0])
        say(str(mechanism))
    return OK


def _run(args: argparse.Namespace) -> int:
    from mjcont.progress import Reporter, Table
    from mjcont.study import load_study, run_study

    with _warnings_as_lines():
        study = load_study(args.study, friction=args.friction)
    if args.quiet:
        reporter = Reporter()
    else:
        terminal = sys.stderr is not None and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        reporter = Table(say, sys.stderr if terminal else None)
    branches = run_study(study, args.out, reporter)
    if branches[-1].interrupted:
        last = study.branches[len(branches) - 1].name
        skipped = len(study.branches) - len(branches)
        rest = f"; {skipped} more not computed" if skipped else ""
        stored = Path(args.out) / f"{last}.h5"
        return _complain(f"interrupted: {stored} holds the {len(branches[-1])} points so far{rest}", INTERRUPTED)
    return OK


def _plot(args: argparse.Namespace) -> int:
    from mjcont.plotting import plot, save_figure

    branches = [_load_curve(file) for file in args.files]
    for file, branch in zip(args.files, branches, strict=True):
        for column in (args.x, args.y):
            with _naming(file):
                _ = branch[column]
    out = Path(args.out) if args.out else Path(args.files[0]).with_suffix(".png")
    axes: Any = plot(*branches, x=args.x, y=args.y, labels=args.labels, degrees=args.degrees)
    save_figure(axes.figure, out)
    say(f"plot: {out}")
    return OK


def _sensitivities(args: argparse.Namespace) -> int:
    from mjcont.adjoint import sensitivities

    branch = _load_branch(args.file)
    with _naming(args.file):
        found = sensitivities(branch.point(args.label), args.parameter, quantities=args.quantity)
    say(str(found))
    if args.csv:
        say(f"written: {found.to_csv(args.csv)}")
    if args.out:
        from mjcont.plotting import save_figure

        say(f"plot: {save_figure(found.plot().figure, args.out)}")
    return OK


def _view(args: argparse.Namespace) -> int:
    from mjcont.viewer import view

    point = _point_of_result(args) if _is_result(args.model) else _point_of_model(args)
    if point is not None:
        say(str(point))
        view(point.problem, point.state, point.parameters)
        return OK
    from mjcont.mechanism import Mechanism

    with _warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model)
    view(mechanism, mechanism.start_state(args.keyframe), mechanism.values())
    return OK


def _reproduce(args: argparse.Namespace) -> int:
    from mjcont.reproduce import reproduce

    result = reproduce(args.figures or None, args.out, jobs=args.jobs, force=args.force, say=say)
    return FAILED if result.failed else OK


def _report(args: argparse.Namespace) -> int:
    from mjcont.extended import report

    options = {"extended": args.extended, "only": args.only, "jobs": args.jobs, "force": args.force}
    return FAILED if report(args.out, **options, say=say).failed else OK


def _bush(args: argparse.Namespace) -> int:
    from mjcont.bushes import bushed_xml
    from mjcont.loading import compile_spec, parse

    out = Path(args.out)
    if out.exists() and Path(args.model).exists() and out.samefile(args.model):
        raise MjcontError(f"'{out}' is the model itself: give the new one a name of its own")
    with _warnings_as_lines():
        text = bushed_xml(
            args.model, args.joint, args.connect, stiffness=args.stiffness, damping=args.damping, frame=args.frame
        )
    compile_spec(parse(text, out.resolve().parent, f"'{out}' (files beside the model must be beside it, too)"))
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(text, encoding="utf-8")
    say(f"written: {out}")
    return OK


def _export(args: argparse.Namespace) -> int:
    result = _load(args.file)
    out = Path(args.out) if args.out else Path(args.file).with_suffix(".csv")
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
        print(f"mjcont: warning: {' '.join(str(warning.message).split())}", file=sys.stderr)


@contextmanager
def _naming(file: str) -> Iterator[None]:
    """Let an error name the file that it is about."""
    try:
        yield
    except MjcontError as error:
        raise type(error)(f"'{file}': {error}") from error


def _load(path: str) -> Any:
    from mjcont.storage import load

    return load(path)


def _load_curve(path: str) -> Any:
    """Read a branch, a locus or a load path."""
    result = _load(path)
    if hasattr(result, "velocities"):
        raise ResultFileError(f"'{path}' holds a time history: inspect and export take it, this command takes curves")
    return result


def _load_branch(path: str) -> Branch:
    """Read a result that has points of its own to be named."""
    from mjcont.branch import Branch

    result = _load_curve(path)
    if not isinstance(result, Branch):
        raise ResultFileError(f"'{path}' holds a load path: this command takes a branch or a locus")
    return result


def _point_of_model(args: argparse.Namespace) -> Point | None:
    """Return the equilibrium that --at asks for, or None for a pose as it stands in the model."""
    from mjcont.continuation import find_equilibrium
    from mjcont.mechanism import Mechanism

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
    from mjcont.branch import show

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
    from mjcont.schema import quantity

    try:
        return quantity(text, unit)
    except ValueError as error:
        raise MjcontError(f"--at {name}: {error}") from error


# -- arguments ---------------------------------------------------------------------------------------------


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *rest: Any) -> None:
        from mjcont import __version__

        say(f"mjcont {__version__}")
        parser.exit()


def _assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.rpartition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"expected NAME=VALUE such as F=20 or gravity_angle=20deg, got '{text}'")
    return name, value


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number from 1 on, got '{text}'")
    return int(text)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="mjcont",
        description="Where can a MuJoCo mechanism rest, is it stable there, and how does that change with a parameter?",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def command(name: str, function: Any, text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        added.set_defaults(command=function)
        return added

    friction_help = "leave friction out of equilibria, or refuse models that have it (default: frictionless)"
    model_help = "an MJCF file, or the name of a model that ships with mjcont, such as overcentre"
    p = command("inspect", _inspect, "show a model's parameters, observables and starts, or a result's summary")
    p.add_argument("model", metavar="MODEL|FILE.h5", help=model_help + "; or a result file")
    p.add_argument("--friction", choices=FRICTION, help=friction_help)

    p = command("run", _run, "run a study: compute its branches, store them, draw its plots")
    p.add_argument("study", metavar="STUDY.toml", help="the study file (docs/studies.md)")
    p.add_argument("-o", "--out", metavar="DIR", default="out", help="folder for results (default: out)")
    p.add_argument("--friction", choices=FRICTION, help=friction_help + " or the study's own")
    p.add_argument("-q", "--quiet", action="store_true", help="print errors only")

    p = command("plot", _plot, "draw a diagram of stored branches")
    p.add_argument("files", metavar="FILE.h5", nargs="+")
    p.add_argument("-x", metavar="COL", required=True, help="column along the horizontal axis")
    p.add_argument("-y", metavar="COL", required=True, help="column along the vertical axis")
    p.add_argument("-o", "--out", metavar="FILE", help="png, pdf or svg (default: FILE.png beside the first input)")
    p.add_argument("--no-labels", dest="labels", action="store_false", help="leave out LP1, HB1, ...")
    p.add_argument("--radians", dest="degrees", action="store_false", help="angles in radians, not degrees")

    p = command("sensitivities", _sensitivities, "tell how a stored special point moves with the model's parameters")
    p.add_argument("file", metavar="FILE.h5")
    p.add_argument("label", metavar="LABEL", help="a special point of it, such as LP1")
    p.add_argument("-p", "--parameter", metavar="NAME", action="append",
                   help="a parameter, or a path such as body:strut.mass (repeat it; default: all the model declares)")
    p.add_argument("-q", "--quantity", metavar="COL", action="append",
                   help="what moves (repeat it; default: the point's own parameters)")
    p.add_argument("-o", "--out", metavar="FILE", help="draw a tornado chart of the first: png, pdf or svg")
    p.add_argument("--csv", metavar="FILE.csv", help="write the table, SI and radians")

    p = command("view", _view, "open MuJoCo's viewer at a pose")
    p.add_argument("model", metavar="MODEL|FILE.h5", help=model_help + "; or a result file")
    pose = p.add_mutually_exclusive_group()
    pose.add_argument("--keyframe", metavar="K", help="a keyframe of the model")
    pose.add_argument("--label", metavar="LP1", help="a special point of a result")
    pose.add_argument(
        "--at",
        metavar="NAME=VALUE",
        type=_assignment,
        action="append",
        help="the model's equilibrium with these parameter values (repeat it for several), or a result's point there",
    )

    p = command("reproduce", _reproduce, "draw the paper's figures and check its findings")
    p.add_argument("figures", metavar="FIGURE", type=_positive, nargs="*", help="such as 3 or 5 (default: all)")

    q = command("report", _report, "write the report on the paper's figures, and on studies beyond the paper")
    q.add_argument("--extended", action="store_true", help="the extended studies as well")
    q.add_argument("--only", metavar="NAME", help="one figure or study, such as fig03 or unlocking")
    for each in (p, q):
        each.add_argument("-o", "--out", metavar="DIR", default="out/reproduce", help="default: out/reproduce")
        each.add_argument("--force", action="store_true", help="compute again what is stored already")
        each.add_argument("--jobs", metavar="N", type=_positive, help="figures at a time (default: one a processor)")

    p = command("bush", _bush, "replace rigid pins by elastic ones, so that a mechanism becomes an ODE")
    p.add_argument("model", metavar="MODEL", help=model_help)
    p.add_argument("-o", "--out", metavar="OUT.xml", required=True, help="the new model")
    p.add_argument("--joint", metavar="NAME", action="append", help="a hinge or ball joint of the tree (repeat it)")
    p.add_argument("--connect", metavar="NAME", action="append", help="a connect or weld (default: all active ones)")
    p.add_argument("--stiffness", metavar="K", type=float, default=1e6, help="N/m (default: 1e6)")
    p.add_argument("--damping", metavar="C", type=float, help="N s/m (default: about critical)")
    p.add_argument("--frame", choices=("world", "parent"), default="world", help="to which the axes are parallel")

    p = command("export", _export, "write a stored branch as CSV")
    p.add_argument("file", metavar="FILE.h5")
    p.add_argument("-o", "--out", metavar="FILE.csv", help="default: FILE.csv beside the input")
    p.add_argument("--radians", dest="degrees", action="store_false", help="angles in radians, not degrees")
    return parser
