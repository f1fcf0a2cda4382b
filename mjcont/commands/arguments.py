"""The arguments of the command line: what each command takes. What they do is in `cli`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from typing import Any

from mjcont.commands.animate import add_arguments as animate_arguments
from mjcont.commands.readers import assignment, place, positive
from mjcont.commands.sweep import add_arguments as sweep_arguments
from mjcont.results.quantities import FRICTION

Command = Callable[[str, str], argparse.ArgumentParser]

_EXAMPLES = """examples:
  mjcont inspect overcentre                     what can be continued, what can be read, where to start
  mjcont init my_model.xml                      write a first study of a model
  mjcont run studies/overcentre.toml -o out     compute a study's branches, store them, draw its plots
  mjcont check studies/overcentre.toml          everything that is wrong with a study, before it runs
  mjcont plot out/equilibria.h5 -x F -y theta_1
  mjcont sensitivities out/equilibria.h5 LP1    how that fold moves with masses, lengths, stiffnesses
  mjcont view out/equilibria.h5 --label LP1     that pose in MuJoCo's viewer
"""
_FRICTION_HELP = "leave friction out of equilibria, or refuse models that have it (default: frictionless)"
_MODEL_HELP = "an MJCF file, or the name of a model that ships with mjcont, such as overcentre"


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *rest: Any) -> None:
        from mjcont import __version__

        print(f"mjcont {__version__}", flush=True)
        parser.exit()


def parser(functions: Mapping[str, Callable[[argparse.Namespace], int]]) -> argparse.ArgumentParser:
    """Return the parser; `functions` are what the commands do, by name."""
    top = argparse.ArgumentParser(
        prog="mjcont",
        description="Where can a MuJoCo mechanism rest, is it stable there, and how does that change with a parameter?",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = top.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def command(name: str, text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        added.set_defaults(command=functions[name])
        return added

    for add in (_models, _studies, _results, _reports):
        add(command)
    return top


def _models(command: Command) -> None:
    """Add what works on models."""
    p = command("inspect", "show a model's parameters, observables and starts, or a result's summary")
    p.add_argument("model", metavar="MODEL|FILE.h5", help=_MODEL_HELP + "; or a result file")
    p.add_argument("--friction", choices=FRICTION, help=_FRICTION_HELP)

    p = command("init", "write a first study of a model, with comments, that runs")
    p.add_argument("model", metavar="MODEL", help=_MODEL_HELP)
    p.add_argument("-o", "--out", type=place, metavar="STUDY.toml", help="default: MODEL.toml in this folder")
    p.add_argument("--force", action="store_true", help="replace a file that is there")

    p = command("view", "open MuJoCo's viewer at a pose")
    p.add_argument("model", metavar="MODEL|FILE.h5", help=_MODEL_HELP + "; or a result file")
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

    p = command("bush", "replace rigid pins by elastic ones, so that a mechanism becomes an ODE")
    p.add_argument("model", metavar="MODEL", help=_MODEL_HELP)
    p.add_argument("-o", "--out", type=place, metavar="OUT.xml", required=True, help="the new model")
    p.add_argument("--joint", metavar="NAME", action="append", help="a hinge or ball joint of the tree (repeat it)")
    p.add_argument("--connect", metavar="NAME", action="append", help="a connect or weld (default: all active ones)")
    p.add_argument("--stiffness", metavar="K", type=float, default=1e6, help="N/m (default: 1e6)")
    p.add_argument("--damping", metavar="C", type=float, help="N s/m (default: about critical)")
    p.add_argument("--frame", choices=("world", "parent"), default="world", help="to which the axes are parallel")


def _studies(command: Command) -> None:
    """Add what works on studies."""
    p = command("run", "run a study: compute its branches, store them, draw its plots")
    p.add_argument("study", metavar="STUDY.toml", help="a study file, or one that ships with mjcont")
    p.add_argument("-o", "--out", type=place, metavar="DIR", default="out", help="folder for results (default: out)")
    p.add_argument("--friction", choices=FRICTION, help=_FRICTION_HELP + " or the study's own")
    p.add_argument("-q", "--quiet", action="store_true", help="print errors only")

    p = command("check", "tell everything that is wrong with a study, and what it would compute")
    p.add_argument("study", metavar="STUDY.toml")
    p.add_argument("--friction", choices=FRICTION, help=_FRICTION_HELP + " or the study's own")

    p = command("compare", "tell what changed between two models, studies or results, and in their answers")
    p.add_argument("old", metavar="OLD", help="an MJCF file, a study or a result file")
    p.add_argument("new", metavar="NEW", help="another of the same kind")
    p.add_argument("-o", "--out", type=place, metavar="FILE", default="compare.png",
                   help="the picture of both: png, pdf or svg (default: compare.png)")
    p.add_argument("-x", metavar="COL", default="", help="column along the horizontal axis (default: the parameter)")
    p.add_argument("-y", metavar="COL", default="", help="column along the vertical axis (default: an observable)")

    p = command("answer", "run a study and tell what its table [answer] asks: where it locks, unlocks, margins")
    p.add_argument("study", metavar="STUDY.toml")
    p.add_argument("-o", "--out", type=place, metavar="DIR", default="out", help="folder for results (default: out)")
    p.add_argument("--friction", choices=FRICTION, help=_FRICTION_HELP + " or the study's own")

    p = command("sweep", "compute a study's special points for many variants of its model; resumable")
    sweep_arguments(p)


def _results(command: Command) -> None:
    """Add what works on stored results."""
    p = command("plot", "draw a diagram of stored branches")
    p.add_argument("files", metavar="FILE.h5", nargs="+")
    p.add_argument("-x", metavar="COL", required=True, help="column along the horizontal axis")
    p.add_argument("-y", metavar="COL", required=True, help="column along the vertical axis")
    p.add_argument("-o", "--out", type=place, metavar="FILE",
                   help="png, pdf or svg (default: FILE.png beside the first input)")
    p.add_argument("--units", metavar="UNITS", default="", help="units of the axes that they fit, such as kN,mm")
    p.add_argument("--title", metavar="TEXT", default="")
    p.add_argument("--no-legend", dest="legend", action="store_false", help="no key to line styles and markers")
    p.add_argument("--no-labels", dest="labels", action="store_false", help="leave out LP1, HB1, ...")
    p.add_argument("--radians", dest="degrees", action="store_false", help="angles in radians, not degrees")

    animate_arguments(command("animate", "write a moving picture of a stored result"))

    p = command("sensitivities", "tell how a stored special point moves with the model's parameters")
    p.add_argument("file", metavar="FILE.h5")
    p.add_argument("label", metavar="LABEL", help="a special point of it, such as LP1")
    p.add_argument("-p", "--parameter", metavar="NAME", action="append",
                   help="a parameter, or a path such as body:strut.mass (repeat it; default: all the model declares)")
    p.add_argument("-q", "--quantity", metavar="COL", action="append",
                   help="what moves (repeat it; default: the point's own parameters)")
    p.add_argument("-o", "--out", type=place, metavar="FILE", help="draw a tornado chart of the first: png, pdf or svg")
    p.add_argument("--csv", type=place, metavar="FILE.csv", help="write the table, angles in degrees")

    p = command("export", "write a stored branch as CSV")
    p.add_argument("file", metavar="FILE.h5")
    p.add_argument("-o", "--out", type=place, metavar="FILE.csv", help="default: FILE.csv beside the input")
    p.add_argument("--radians", dest="degrees", action="store_false", help="angles in radians, not degrees")


def _reports(command: Command) -> None:
    """Add the paper's figures and reports."""
    p = command("reproduce", "draw the paper's figures and check its findings")
    p.add_argument("figures", metavar="FIGURE", type=positive, nargs="*", help="such as 3 or 5 (default: all)")

    q = command("report", "write the report on the paper's figures, and on studies beyond the paper")
    q.add_argument("--extended", action="store_true", help="the extended studies as well")
    q.add_argument("--only", metavar="NAME", help="one figure or study, such as fig03 or unlocking")
    for each in (p, q):
        each.add_argument("-o", "--out", type=place, metavar="DIR", default="out/reproduce",
                          help="default: out/reproduce")
        each.add_argument("--force", action="store_true", help="compute again what is stored already")
        each.add_argument("--jobs", metavar="N", type=positive, help="figures at a time (default: one a processor)")
