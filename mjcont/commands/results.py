"""Commands on stored results: `plot`, `animate`, `sensitivities`, `export`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mjcont.commands import animate
from mjcont.commands.common import OK, Command, load, load_branch, load_curve, naming, output
from mjcont.commands.readers import place
from mjcont.errors import MjcontError
from mjcont.outside.terminal import say

_EXPORTS = (".csv", ".html")


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("plot", "draw a diagram of stored branches", plot)
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

    animate.add_arguments(command("animate", "write a moving picture of a stored result", animate.run))

    p = command("sensitivities", "tell how a stored special point moves with the model's parameters", influence)
    p.add_argument("file", metavar="FILE.h5")
    p.add_argument("label", metavar="LABEL", help="a special point of it, such as LP1")
    p.add_argument("-p", "--parameter", metavar="NAME", action="append",
                   help="a parameter, or a path such as body:strut.mass (repeat it; default: all the model declares)")
    p.add_argument("-q", "--quantity", metavar="COL", action="append",
                   help="what moves (repeat it; default: the point's own parameters)")
    p.add_argument("-o", "--out", type=place, metavar="FILE", help="draw a tornado chart of the first: png, pdf or svg")
    p.add_argument("--csv", type=place, metavar="FILE.csv", help="write the table, angles in degrees")

    p = command("export", "write a stored result as CSV, or results as a page that opens in a browser", export)
    p.add_argument("files", metavar="FILE.h5", nargs="+", help="one for a table; several make one page")
    p.add_argument("-o", "--out", type=place, metavar="FILE",
                   help="its ending decides: .csv, or .html for the mechanism beside its diagram (default: FILE.csv)")
    p.add_argument("--title", metavar="TEXT", default="", help="of a page (default: the model's name)")
    p.add_argument("--radians", dest="degrees", action="store_false", help="of a table: angles in radians")


def plot(args: argparse.Namespace) -> int:
    """Draw curves of result files."""
    from mjcont.drawing.plotting import plot as drawn
    from mjcont.drawing.plotting import save_figure
    from mjcont.results.branch import Branch

    out = output(args.out, ".png", args.files)
    branches = [load_curve(file) for file in args.files]
    for file, branch in zip(args.files, branches, strict=True):
        for column in (args.x, args.y):
            with naming(file):
                _ = [branch[name] for name in (branch.drawn(column) if isinstance(branch, Branch) else [column])]
    axes: Any = drawn(*branches, x=args.x, y=args.y, labels=args.labels, degrees=args.degrees, title=args.title,
                     units=[u for u in args.units.split(",") if u], key=args.legend, legend=args.legend and None)
    save_figure(axes.figure, out)
    say(f"plot: {out}")
    return OK


def influence(args: argparse.Namespace) -> int:
    """Print how a special point moves."""
    from mjcont.influence.sensitivities import sensitivities

    for out in filter(None, (args.out, args.csv)):
        output(out, "", [args.file])
    branch = load_branch(args.file)
    with naming(args.file):
        found = sensitivities(branch.point(args.label), args.parameter, quantities=args.quantity)
    say(str(found))
    if args.csv:
        say(f"written: {found.to_csv(args.csv)}")
    if args.out:
        from mjcont.drawing.plotting import save_figure

        say(f"plot: {save_figure(found.plot().figure, args.out)}")
    return OK


def export(args: argparse.Namespace) -> int:
    """Write a result as CSV, or results as a page: the ending of the file decides."""
    out = output(args.out, _EXPORTS[0], args.files)
    if out.suffix.lower() not in _EXPORTS:
        raise MjcontError(f"cannot export to '{out.name}': the ending must be one of {', '.join(_EXPORTS)}")
    if out.suffix.lower() == ".csv":
        if len(args.files) > 1:
            raise MjcontError(f"a table is of one result, got {len(args.files)}; a page (-o page.html) takes several")
        written = load(args.files[0]).to_csv(out, degrees=args.degrees)
    else:
        from mjcont.explorer.opening import study_of
        from mjcont.explorer.page import write_page

        found = {Path(f): load(f) for f in args.files}
        study, files = study_of(*next(iter(found.items())))
        written = write_page(out, {p.stem: r for p, r in found.items()}, title=args.title, study=study, files=files)
    say(f"written: {written}")
    return OK
