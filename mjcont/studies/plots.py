"""The table [[plot]] of a study: a diagram of the study's curves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mjcont.results.units import check_wished
from mjcont.studies import forms as f
from mjcont.studies import keys as k
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.forms import FILE_STEM, PLOT_SUFFIXES
from mjcont.studies.keys import Context, Key, Kind, takes
from mjcont.studies.orbits import ORBITS, check_plotted, default_curves, plotted
from mjcont.studies.schema import Table

CURVES = ("branch", "locus", "diagram", "path", *ORBITS)


def _wrong(file: str) -> str:
    """Return what is wrong with the name of a plot's file."""
    if "/" in file or "\\" in file:
        return "names a folder, which `mjcont run -o` says"
    strange = dict.fromkeys(c for c in file if not FILE_STEM.fullmatch(f"a{c}"))
    if strange:
        return "has " + ", ".join("a space" if c == " " else f"'{c}'" for c in strange)
    return "begins with no letter or digit" if file.endswith(PLOT_SUFFIXES) else "has another ending"


@takes(f.PLOT_FILE)
def _plot_file(table: Table, key: str, context: Context) -> str:
    file = table.text(key)
    if not FILE_STEM.fullmatch(file) or Path(file).suffix not in PLOT_SUFFIXES:
        raise table.error(key, f"'{file}' {_wrong(file)}: expected a file name of letters, digits, '-', '_' and '.' "
                               f"that ends in one of {', '.join(PLOT_SUFFIXES)}")
    return file


@takes(f.TEXTS)
def _wished_units(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read units in which numbers are to be shown."""
    found = table.texts(key)
    with k.about(table, key):
        check_wished(found)
    return found


def _check_plot(found: dict[str, Any], table: Table, context: Context) -> None:
    if not found["branches"]:
        plain = tuple(n for n, known in context.known.items() if known.kind in ("branch", "diagram"))
        plain = default_curves(found, context, plain)
        found["branches"] = plain or tuple(n for n, known in context.known.items() if known.kind in CURVES)
    if not found["branches"]:
        raise table.error("branches", "the study computes no branch, locus, diagram or path to draw")
    check_plotted(found, table, context)


PLOT = Kind("plot", "A diagram, drawn as soon as its curves are done.", {
    "file": Key(_plot_file, "File name ending in `.png`, `.pdf` or `.svg`, without a folder.", needed=True),
    "x": Key(plotted, "Column: a parameter or an observable; of orbits also `period`, `frequency`, `energy`, "
                      "`NAME.max`, `.min`, `.amplitude`, `.mean`, `.rms`, of responses `.h1`, `.phase`.", needed=True),
    "y": Key(plotted, "The same. An observable of orbits is drawn by its largest and smallest value.", needed=True),
    "branches": Key(r.curves(*CURVES), "Names of branches, diagrams, cycles, responses, loci and paths.",
                    otherwise="all but loci and paths; if there are none, these"),
    "title": Key(v.text, "A string.", ""),
    "labels": Key(v.flag, "`false` leaves out the labels of special points.", True),
    "degrees": Key(v.flag, "`false` draws angles in radians.", True),
    "units": Key(_wished_units, 'Units of the axes that they fit, such as `["kN", "mm"]`.', ()),
    "legend": Key(v.flag, "`false` leaves out the key to line styles and markers.", True),
}, _check_plot)
