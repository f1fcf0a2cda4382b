"""The command `mjcont sweep`: its arguments, its summary."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from mjcont.commands.common import OK, warnings_as_lines
from mjcont.commands.progress import gauge
from mjcont.commands.readers import place, positive
from mjcont.errors import MjcontError
from mjcont.outside.saving import check_writable
from mjcont.outside.terminal import say


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Add the command's arguments to its parser."""
    p.add_argument("study", metavar="STUDY.toml", help="a study file with a table [sweep] (mjcont docs sweeps)")
    p.add_argument("-o", "--out", type=place, metavar="DIR", default="sweep",
                   help="folder for the journal and the tables; a sweep that stopped goes on there (default: sweep)")
    p.add_argument("--limit", metavar="N", type=positive, help="the first N cases only")
    where = p.add_mutually_exclusive_group()
    where.add_argument("--workers", metavar="N", type=positive, help="processes (default: one a processor)")
    where.add_argument("--scheduler", metavar="ADDRESS", help="a Dask scheduler, such as tcp://host:8786")
    p.add_argument("--plot", type=place, metavar="FILE", action="append", default=[],
                   help="draw a quantity's distribution (with -y; default the first): png, pdf or svg")
    p.add_argument("-x", metavar="COL", help="of the plot: scatter against this column instead")
    p.add_argument("-y", metavar="COL", help="of the plot: the quantity")
    p.add_argument("-q", "--quiet", action="store_true", help="print errors only")


def run(args: argparse.Namespace) -> int:
    """Run the sweep, print what it found, and draw it if asked."""
    with warnings_as_lines():
        _run(args)
    return OK


def _run(args: argparse.Namespace) -> None:
    from mjcont.studies.study import load_study
    from mjcont.sweeps.sweeps import sweep

    study = load_study(args.study)
    drawn = study.sweep is not None and [*study.sweep.vary, *study.sweep.record]
    for column in (args.x, args.y):
        if column and not args.plot:
            raise MjcontError("-x and -y go with --plot FILE")
        if column and drawn and study.sweep is not None and study.sweep.record and column not in drawn:
            raise MjcontError(f"the plot's column '{column}' is not in this sweep. Valid: {', '.join(drawn)}.")
    for file in args.plot:
        check_writable(file)
    began = time.monotonic()
    with gauge("sweep", quiet=args.quiet) as shown:

        def progress(done: int, total: int, failed: int) -> None:
            shown.count(done, total, " cases", f", {failed} failed" if failed else "")

        table = sweep(study, out=args.out, limit=args.limit, workers=args.workers, scheduler=args.scheduler,
                      progress=progress)
    if not args.quiet:
        say(str(table))
        say(f"  written: {Path(args.out) / 'sweep.csv'}, {Path(args.out) / 'sweep.h5'} "
            f"({time.monotonic() - began:.1f} s)")
    for file in args.plot:
        from mjcont.drawing.plotting import save_figure

        path = save_figure(table.plot(args.y, args.x).figure, file)
        if not args.quiet:
            say(f"plot: {path}")

