"""Commands on models: `inspect`, `view`, `bush`."""

from __future__ import annotations

import argparse
import shlex
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from mjcont.commands.common import (
    FRICTION_HELP,
    JSON_HELP,
    MODEL_HELP,
    OK,
    Command,
    is_result,
    load,
    load_branch,
    naming,
    refuse_input,
    warnings_as_lines,
)
from mjcont.commands.readers import assignment, place
from mjcont.errors import MjcontError, ModelError, ResultFileError
from mjcont.outside.terminal import say
from mjcont.results.quantities import FRICTION

if TYPE_CHECKING:
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.results.linear.modes import Modes
    from mjcont.results.points import Point

# modes that `inspect` shows
_MODES = 6


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("inspect", "show a model's parameters, observables and starts, or a result's summary", inspect)
    p.add_argument("model", metavar="MODEL|FILE.h5", help=MODEL_HELP + "; or a result file")
    p.add_argument("--friction", choices=FRICTION, help=FRICTION_HELP)
    p.add_argument("--json", action="store_true", help=JSON_HELP)

    p = command("view", "open MuJoCo's viewer at a pose", view)
    p.add_argument("model", metavar="MODEL|FILE.h5", help=MODEL_HELP + "; or a result file")
    pose = p.add_mutually_exclusive_group()
    pose.add_argument("--keyframe", metavar="K", help="a keyframe of the model")
    pose.add_argument("--label", metavar="LP1", help="a special point of a result")
    pose.add_argument(
        "--at",
        metavar="NAME=VALUE",
        type=assignment,
        action="append",
        help="the model's equilibrium with these parameter values (repeat it for several), or a result's point there",
    )

    p = command("bush", "replace rigid pins by elastic ones, so that a mechanism becomes an ODE", bush)
    p.add_argument("model", metavar="MODEL", help=MODEL_HELP)
    p.add_argument("-o", "--out", type=place, metavar="OUT.xml", required=True, help="the new model")
    p.add_argument("--joint", metavar="NAME", action="append", help="a hinge or ball joint of the tree (repeat it)")
    p.add_argument("--connect", metavar="NAME", action="append", help="a connect or weld (default: all active ones)")
    p.add_argument("--stiffness", metavar="K", type=float, default=1e6, help="N/m (default: 1e6)")
    p.add_argument("--damping", metavar="C", type=float, help="N s/m (default: about critical)")
    p.add_argument("--frame", choices=("world", "parent"), default="world", help="to which the axes are parallel")


def inspect(args: argparse.Namespace) -> int:
    """Print what a model or a result is."""
    if is_result(args.model):
        from mjcont.commands.facts import as_json, of_result

        result = load(args.model)
        say(as_json(of_result(result)) if args.json else str(result))
        return OK
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.models.loading import files_read

    with warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model, friction=args.friction or FRICTION[0])
    files, found = list(files_read(args.model)), _modes(mechanism)
    if args.json:
        from mjcont.commands.facts import as_json, of_mechanism

        say(as_json(of_mechanism(mechanism, None if isinstance(found, str) else found, files)))
        return OK
    say(str(mechanism))
    lines = [f"  {found}"] if isinstance(found, str) else [
        f"  of the {found.point.stability} rest that qpos0 belongs to", *found.table(_MODES), *found.notes]
    say("\n".join(["", "modes", *lines]))
    say("\n".join(["", "files that this model reads", *(f"  {name}" for name in files)]))
    say(f"\nnext: mjcont init {shlex.quote(args.model)}")
    return OK


def _modes(mechanism: Mechanism) -> Modes | str:
    """Return the modes at the rest to which the model as loaded belongs, or why there are none."""
    from mjcont.curves.continuation import find_equilibrium
    from mjcont.oscillation.modes import modes

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return modes(find_equilibrium(mechanism))
    except MjcontError as error:
        return str(error)


def view(args: argparse.Namespace) -> int:
    """Open the viewer at the pose asked for."""
    from mjcont.drawing import viewer
    from mjcont.drawing.poses import mechanism_of

    point = _point_of_result(args) if is_result(args.model) else _point_of_model(args)
    if point is not None:
        say(str(point))
        viewer.view(mechanism_of(point), point.state, point.parameters)
        return OK
    from mjcont.mechanism.mechanism import Mechanism

    with warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model)
    viewer.view(mechanism, mechanism.start_state(args.keyframe), mechanism.values())
    return OK


def _point_of_model(args: argparse.Namespace) -> Point | None:
    """Return the equilibrium that --at asks for, or None for a pose as it stands in the model."""
    from mjcont.curves.continuation import find_equilibrium
    from mjcont.mechanism.mechanism import Mechanism

    if args.label:
        raise MjcontError("--label goes with a result file; for a model use --keyframe or --at")
    if not args.at:
        return None
    with warnings_as_lines():
        mechanism = Mechanism.from_xml(args.model)
    return find_equilibrium(
        mechanism, {name: _value(name, text, mechanism.parameter(name).unit) for name, text in args.at}
    )


def _point_of_result(args: argparse.Namespace) -> Point:
    """Return the point of a stored branch that --label or --at asks for, or its start."""
    from mjcont.results.points import show

    if args.keyframe:
        raise MjcontError("--keyframe goes with a model; for a result file use --label or --at")
    branch = load_branch(args.model)
    if branch.problem is None:
        raise ResultFileError(f"result file '{args.model}' holds no model to view")
    if args.label:
        with naming(args.model):
            return branch.point(args.label)
    if not args.at:
        return branch.row(branch.start_index)
    if len(args.at) > 1:
        raise MjcontError("a point of a result file has one --at, such as --at F=20")
    ((name, text),) = args.at
    with naming(args.model):
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


def bush(args: argparse.Namespace) -> int:
    """Write a model with bushes for pins."""
    from mjcont.models.bushes import bushed_xml
    from mjcont.outside.saving import write_file

    out = Path(args.out)
    refuse_input(out, [args.model], "model")
    with warnings_as_lines():
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
