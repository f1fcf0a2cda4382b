"""First steps: the commands `mjcont init`, `mjcont compare` and `mjcont answer`."""

from __future__ import annotations

import argparse
import shlex
import tempfile
from collections.abc import Callable
from pathlib import Path

from mjcont.errors import MjcontError
from mjcont.outside.saving import check_writable, write_file


def init(args: argparse.Namespace, say: Callable[[str], None]) -> None:
    """Write a first study of a model and say how to run it."""
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.studies.first import first_study

    out = Path(args.out) if args.out else Path(f"{Path(args.model).stem}.toml")
    if out.exists() and not args.force:
        raise MjcontError(f"'{out}' is there already: choose another with -o, or --force replaces it")
    check_writable(out)
    write_file(out, first_study(args.model, out, Mechanism.from_xml(args.model)))
    say(f"written: {out}")
    say(f"next: mjcont run {shlex.quote(str(out))} -o out")


def compare(args: argparse.Namespace, say: Callable[[str], None]) -> None:
    """Tell what changed between two models and in their answers, and draw both."""
    from mjcont.drawing.plotting import save_figure
    from mjcont.studies.compare import compare as compared

    out = Path(args.out)
    for given in (args.old, args.new):
        if out.exists() and Path(given).exists() and out.samefile(given):
            raise MjcontError(f"'{out}' is the input itself: give the picture a name of its own")
    check_writable(out)
    with tempfile.TemporaryDirectory() as folder:
        found = compared(args.old, args.new, Path(folder))
    say(str(found))
    if found.curves:
        say(f"plot: {save_figure(found.plot(args.x, args.y).figure, out)}")


def answer(args: argparse.Namespace, say: Callable[[str], None]) -> None:
    """Run a study and tell what its table [answer] asks."""
    from mjcont.outside.terminal import live_stream
    from mjcont.studies.answers import answers
    from mjcont.studies.study import load_study, run_study

    study = load_study(args.study, friction=args.friction)
    if study.answer is None:
        raise MjcontError(f"study '{args.study}': it has no table [answer]: docs/studies.md tells what goes in there")
    from mjcont.commands.progress import Table

    live = live_stream()
    results = run_study(study, args.out, Table(lambda line: None, live) if live is not None else None)
    say("\n".join(answers(study, results)))
