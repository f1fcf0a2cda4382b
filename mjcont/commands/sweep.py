"""The command `mjcont sweep`: its arguments, its live count, its summary."""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from mjcont.errors import MjcontError
from mjcont.outside.saving import check_writable
from mjcont.outside.terminal import Live, live_stream

if TYPE_CHECKING:
    from mjcont.sweeps.sweeps import Progress

_REDRAW_SECONDS = 0.2


def add_arguments(p: argparse.ArgumentParser, positive: Callable[[str], int]) -> None:
    """Add the command's arguments to its parser."""
    p.add_argument("study", metavar="STUDY.toml", help="a study file with a table [sweep] (docs/sweeps.md)")
    p.add_argument("-o", "--out", metavar="DIR", default="sweep",
                   help="folder for the journal and the tables; a sweep that stopped goes on there (default: sweep)")
    p.add_argument("--limit", metavar="N", type=positive, help="the first N cases only")
    where = p.add_mutually_exclusive_group()
    where.add_argument("--workers", metavar="N", type=positive, help="processes (default: one a processor)")
    where.add_argument("--scheduler", metavar="ADDRESS", help="a Dask scheduler, such as tcp://host:8786")
    p.add_argument("--plot", metavar="FILE", action="append", default=[],
                   help="draw a quantity's distribution (with -y; default the first): png, pdf or svg")
    p.add_argument("-x", metavar="COL", help="of the plot: scatter against this column instead")
    p.add_argument("-y", metavar="COL", help="of the plot: the quantity")
    p.add_argument("-q", "--quiet", action="store_true", help="print errors only")


def run(args: argparse.Namespace, say: Callable[[str], None]) -> None:
    """Run the sweep, print what it found, and draw it if asked."""
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
    stream = None if args.quiet else live_stream()
    live = Live(stream) if stream is not None else None
    began = time.monotonic()
    table = sweep(
        study, out=args.out, limit=args.limit, workers=args.workers, scheduler=args.scheduler,
        progress=_counted(live) if live is not None else None,
    )
    if live is not None:
        live.show()
    if not args.quiet:
        say(str(table))
        say(f"  written: {Path(args.out) / 'sweep.csv'}, {Path(args.out) / 'sweep.h5'} "
            f"({time.monotonic() - began:.1f} s)")
    for file in args.plot:
        from mjcont.drawing.plotting import save_figure

        path = save_figure(table.plot(args.y, args.x).figure, file)
        if not args.quiet:
            say(f"plot: {path}")


def _counted(live: Live) -> Progress:
    """Return what shows how many cases are done and how long the rest may take."""
    began, drawn, first = time.monotonic(), -math.inf, -1

    def show(done: int, total: int, failed: int) -> None:
        nonlocal drawn, first
        now = time.monotonic()
        first = done if first < 0 else first
        if now - drawn < _REDRAW_SECONDS:
            return
        drawn = now
        left = (total - done) * (now - began) / (done - first) if done > first else math.nan
        rest = f", about {left:.0f} s left" if math.isfinite(left) else ""
        lost = f", {failed} failed" if failed else ""
        live.show(f"{done} of {total} cases{lost}{rest}")

    return show
