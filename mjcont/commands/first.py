"""First steps: the commands `mjcont init`, `mjcont compare` and `mjcont answer`."""

from __future__ import annotations

import argparse
import shlex
import tempfile
from pathlib import Path

from mjcont.commands.common import (
    FRICTION_HELP,
    JSON_HELP,
    MODEL_HELP,
    OK,
    STUDY_HELP,
    Command,
    refuse_input,
    warnings_as_lines,
)
from mjcont.commands.readers import place
from mjcont.errors import MjcontError
from mjcont.outside.saving import check_writable, write_file
from mjcont.outside.terminal import say
from mjcont.results.quantities import FRICTION


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("init", "write a first study of a model, with comments, that runs", init)
    p.add_argument("model", metavar="MODEL", help=MODEL_HELP)
    p.add_argument("-o", "--out", type=place, metavar="STUDY.toml", help="default: MODEL.toml in this folder")
    p.add_argument("--force", action="store_true", help="replace a file that is there")

    p = command("compare", "tell what changed between two models, studies or results, and in their answers", compare)
    p.add_argument("old", metavar="OLD", help="an MJCF file, a study or a result file")
    p.add_argument("new", metavar="NEW", help="another of the same kind")
    p.add_argument("-o", "--out", type=place, metavar="FILE", default="compare.png",
                   help="the picture of both: png, pdf or svg (default: compare.png)")
    p.add_argument("-x", metavar="COL", default="", help="column along the horizontal axis (default: the parameter)")
    p.add_argument("-y", metavar="COL", default="", help="column along the vertical axis (default: an observable)")
    p.add_argument("--json", action="store_true", help=JSON_HELP)

    p = command("answer", "run a study and tell what its table [answer] asks: where it locks, unlocks, margins", answer)
    p.add_argument("study", metavar="STUDY.toml", help=STUDY_HELP)
    p.add_argument("-o", "--out", type=place, metavar="DIR", default="out", help="folder for results (default: out)")
    p.add_argument("--friction", choices=FRICTION, help=FRICTION_HELP + " or the study's own")
    p.add_argument("--json", action="store_true", help=JSON_HELP)


def init(args: argparse.Namespace) -> int:
    """Write a first study of a model and say how to run it."""
    from mjcont.commands.progress import gauge
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.studies.first import first_study

    out = Path(args.out) if args.out else Path(f"{Path(args.model).stem}.toml")
    if out.exists() and not args.force:
        raise MjcontError(f"'{out}' is there already: choose another with -o, or --force replaces it")
    check_writable(out)
    with warnings_as_lines(), gauge("trying parameters"):
        write_file(out, first_study(args.model, out, Mechanism.from_xml(args.model)))
    say(f"written: {out}")
    say(f"next: mjcont run {shlex.quote(str(out))} -o out")
    return OK


def compare(args: argparse.Namespace) -> int:
    """Tell what changed between two models and in their answers, and draw both."""
    from mjcont.commands.facts import as_json, of_comparison
    from mjcont.commands.progress import gauge
    from mjcont.commands.told import Told
    from mjcont.drawing.plotting import save_figure
    from mjcont.studies.compare import compare as compared

    out = Path(args.out)
    refuse_input(out, [args.old, args.new], "input")
    check_writable(out)
    with warnings_as_lines(), tempfile.TemporaryDirectory() as folder, gauge() as shown:
        found = compared(args.old, args.new, Path(folder), Told(shown))
    plot = save_figure(found.plot(args.x, args.y).figure, out) if found.curves else None
    if args.json:
        say(as_json({**of_comparison(found), "plot": plot}))
        return OK
    say(str(found))
    if plot is not None:
        say(f"plot: {plot}")
    return OK


def answer(args: argparse.Namespace) -> int:
    """Run a study and tell what its table [answer] asks."""
    from mjcont.commands.facts import as_json, of_answers
    from mjcont.commands.progress import gauge
    from mjcont.commands.told import Told
    from mjcont.studies.answers import answers
    from mjcont.studies.study import load_study, run_study

    with warnings_as_lines(), gauge() as shown:
        study = load_study(args.study, friction=args.friction)
        if study.answer is None:
            raise MjcontError(f"study '{args.study}': it has no table [answer]: see `mjcont docs studies`")
        found = answers(study, run_study(study, args.out, Told(shown)), shown.begin)
    if args.json:
        say(as_json(of_answers(study, found)))
    else:
        say("\n".join([f"{study.mechanism.name}, {study.file}", *map(str, found)]))
    return OK
