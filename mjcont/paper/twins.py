"""The interactive twin of a figure: its curves in a page of the explorer, one page a model."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from mjcont.explorer.document import problem_of
from mjcont.explorer.page import to_html

_UNSAFE = re.compile(r"[^\w-]")


def write_twins(out: Path, stem: str, *results: Any) -> list[Path]:
    """Write a figure's results beside its picture: STEM.html, of further models STEM.MODEL.html; return the files.

    Parameters
    ----------
    out : folder.
    stem : the figure's name, such as "fig03".
    *results : as `mjcont.to_html` takes them.
    """
    models: dict[str, list[Any]] = {}
    for result in results:
        problem = problem_of(result)
        models.setdefault(problem.name if problem is not None else "", []).append(result)
    written = []
    for k, (name, each) in enumerate(models.items()):
        file = f"{stem}.{_UNSAFE.sub('_', name)}.html" if k else f"{stem}.html"
        written.append(to_html(out / file, *each, title=f"{_label(stem)}: {name}"))
    return written


def _label(stem: str) -> str:
    """Return a figure's name to be read."""
    return f"Figure {int(stem[3:])}" if stem[3:].isdecimal() else stem.replace("_", " ").capitalize()


def twins(out: Path, stem: str) -> tuple[str, ...]:
    """Return the names of a figure's pages in a folder, the first model's first."""
    return tuple(p.name for p in [*out.glob(f"{stem}.html"), *sorted(out.glob(f"{stem}.*.html"))])
