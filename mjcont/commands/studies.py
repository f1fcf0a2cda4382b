"""Commands on studies: `run`, `check`, `sweep`."""

from __future__ import annotations

import argparse

from mjcont.commands import sweep
from mjcont.commands.common import (
    FRICTION_HELP,
    INTERRUPTED,
    JSON_HELP,
    OK,
    STUDY_HELP,
    USER_ERROR,
    Command,
    warnings_as_lines,
)
from mjcont.commands.readers import place
from mjcont.outside.terminal import complain, say
from mjcont.results.quantities import FRICTION


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("run", "run a study: compute its branches, store them, draw its plots", run)
    p.add_argument("study", metavar="STUDY.toml", help=STUDY_HELP)
    p.add_argument("-o", "--out", type=place, metavar="DIR", default="out", help="folder for results (default: out)")
    p.add_argument("--friction", choices=FRICTION, help=FRICTION_HELP + " or the study's own")
    how = p.add_mutually_exclusive_group()
    how.add_argument("-q", "--quiet", action="store_true", help="print errors only")
    how.add_argument("--json", action="store_true", help=JSON_HELP)

    p = command("check", "tell everything that is wrong with a study, and what it would compute", check)
    p.add_argument("study", metavar="STUDY.toml", help=STUDY_HELP)
    p.add_argument("--friction", choices=FRICTION, help=FRICTION_HELP + " or the study's own")

    sweep.add_arguments(command("sweep", "compute a study's special points for many variants of its model; resumable",
                                sweep.run))


def run(args: argparse.Namespace) -> int:
    """Run a study."""
    from mjcont.commands.facts import as_json, of_study
    from mjcont.commands.progress import gauge
    from mjcont.commands.told import Told
    from mjcont.studies.study import interruption, load_study, run_study

    with warnings_as_lines():
        study = load_study(args.study, friction=args.friction)
    with gauge(quiet=args.quiet) as shown:
        told = Told(shown, None if args.quiet or args.json else say)
        results = run_study(study, args.out, told)
    if args.json:
        say(as_json(of_study(study, told.results, told.plots)))
    ended = interruption(study, results, args.out)
    if ended:
        complain(f"mjcont: {ended}")
    return INTERRUPTED if ended else OK


def check(args: argparse.Namespace) -> int:
    """Say what is wrong with a study."""
    from mjcont.studies.study import check_study, summary

    with warnings_as_lines():
        study, problems = check_study(args.study, friction=args.friction)
    for line in problems:
        complain(line)
    if study is not None:
        say(summary(study))
    return USER_ERROR if problems else OK
