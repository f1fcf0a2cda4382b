"""The command line, `mjcont`. Every error that a user can cause is one line on stderr and exit status 2.

Each file beside this one has the commands on one subject: their arguments and what they do. What a command needs is
imported when it runs, so that `mjcont --help` is quick.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mjcont.commands import explore, first, help, models, reports, results, studies
from mjcont.commands.common import INTERRUPTED, USER_ERROR
from mjcont.errors import MjcontError, unknown_name
from mjcont.outside.interrupts import ended_by, termination_unwinds
from mjcont.outside.terminal import complain

_EXAMPLES = """examples:
  mjcont inspect overcentre                     what can be continued, what can be read, where to start
  mjcont init my_model.xml                      write a first study of a model
  mjcont run overcentre -o out                  compute a study's branches, store them, draw its plots
  mjcont check my_study.toml                    everything that is wrong with a study, before it runs
  mjcont plot out/equilibria.h5 -x F -y theta_1
  mjcont sensitivities out/equilibria.h5 LP1    how that fold moves with masses, lengths, stiffnesses
  mjcont explore out/equilibria.h5              the mechanism beside its diagram, in the browser
  mjcont view out/equilibria.h5 --label LP1     that pose in MuJoCo's viewer
  mjcont docs                                   what to read, in this installation
"""


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *rest: Any) -> None:
        from mjcont import __version__

        print(f"mjcont {__version__}", flush=True)
        parser.exit()


class _Parser(argparse.ArgumentParser):
    """A parser that asks which command was meant: `known` are those that there are, by name."""

    known: Mapping[str, Any] = {}

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; a first word that is no command is a NameLookupError."""
        first = next(iter(sys.argv[1:] if args is None else args), "-")
        if not first.startswith("-") and first not in self.known:
            raise unknown_name("command", first, self.known)
        return super().parse_known_args(args, namespace)


def parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    top = _Parser(
        prog="mjcont",
        description="Where can a MuJoCo mechanism rest, is it stable there, and how does that change with a parameter?",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = top.add_subparsers(
        title="commands", metavar="COMMAND", required=True, parser_class=argparse.ArgumentParser
    )
    top.known = commands.choices

    def command(name: str, text: str, function: Callable[[argparse.Namespace], int]) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        added.set_defaults(command=function)
        return added

    for room in (models, first, studies, explore, results, reports, help):
        room.register(command)
    return top


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
    top = parser()
    try:
        args = top.parse_args(argv)
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
