"""Commands on the paper: `reproduce` and `report`."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from mjcont.commands.common import FAILED, OK, Command
from mjcont.commands.progress import gauge
from mjcont.commands.readers import place, positive
from mjcont.outside.terminal import say


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("reproduce", "draw the paper's figures and check its findings", reproduce)
    p.add_argument("figures", metavar="FIGURE", type=positive, nargs="*", help="such as 3 or 5 (default: all)")

    q = command("report", "write the report on the paper's figures, and on studies beyond the paper", report)
    q.add_argument("--extended", action="store_true", help="the extended studies as well")
    q.add_argument("--only", metavar="NAME", help="one figure or study, such as fig03 or unlocking")
    for each in (p, q):
        each.add_argument("-o", "--out", type=place, metavar="DIR", default="out/reproduce",
                          help="default: out/reproduce")
        each.add_argument("--force", action="store_true", help="compute again what is stored already")
        each.add_argument("--jobs", metavar="N", type=positive, help="figures at a time (default: one a processor)")


def reproduce(args: argparse.Namespace) -> int:
    """Draw figures and say which findings hold."""
    from mjcont.paper import reproduce as paper

    with _drawing() as options:
        result = paper.reproduce(args.figures or None, args.out, jobs=args.jobs, force=args.force, **options)
    return FAILED if result.failed else OK


def report(args: argparse.Namespace) -> int:
    """Write the report."""
    from mjcont.paper import extended

    given = {"extended": args.extended, "only": args.only, "jobs": args.jobs, "force": args.force}
    with _drawing() as options:
        result = extended.report(args.out, **given, **options)
    return FAILED if result.failed else OK


@contextmanager
def _drawing() -> Iterator[dict[str, Any]]:
    """Yield what shows how the drawing of figures goes."""
    with gauge("drawing") as shown:

        def told(line: str) -> None:
            with shown.aside():
                say(line)

        def progress(running: Sequence[str], done: int, total: int) -> None:
            shown.count(done, total, " done", f": {', '.join(running)}")

        yield {"say": told, "progress": progress}
