"""The report of the paper's figures together with studies that go beyond the paper.

A study is a script beside those of the figures: a docstring (title, caption) and `main(out)`, which draws
`out/NAME.png` and returns its findings. A line in `STUDIES` makes it part of `mjcont report --extended`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from mjcont.errors import unknown_name
from mjcont.paper.findings import stem
from mjcont.paper.reproduce import Progress, ReproduceResult, available, draw

# Name of the script and what it does, in the order of the report.
STUDIES: Mapping[str, str] = {
    "unlocking": "unlocking the nose gear in gusts, by position and by force",
    "locking": "locking and unlocking the gear that locks along load paths, and a lock with a stop",
    "locking_gusts": "unlocking the gear that locks in gusts, and what a stop is good for",
    "load_map": "the gear's retraction and unlock force over gravity angle and load factor, and their worst cases",
    "shimmy": "a nose wheel that shimmies: where it begins, its cycles and their folds over speed and load",
    "shaken_pins": "elastic joints that oscillate, against rigid ones, and amplitudes that unlock the gear that locks",
    "tolerances": "how the gear's forces scatter within tolerances, against the linear estimate",
}


def report(
    out: str | Path,
    *,
    extended: bool = False,
    only: str | None = None,
    jobs: int | None = None,
    force: bool = False,
    say: Callable[[str], None] = print,
    progress: Progress | None = None,
) -> ReproduceResult:
    """Write `report.html` and `report.md` on the paper's figures and, if `extended`, on the studies beyond it.

    Parameters
    ----------
    out : path
        Folder, made if need be. What is up to date in it is not computed again.
    extended : bool
        Run the studies of `STUDIES` too.
    only : str, optional
        Run this figure or study alone, such as "fig03" or "unlocking"; the report covers what else is up to date.
    jobs, force, say, progress : see `reproduce`

    Raises
    ------
    NameLookupError
        If there is no such figure or study; the message lists those there are.
    MjcontError
        See `reproduce`.
    """
    everything: list[int | str] = [*available(), *STUDIES]
    names = {stem(n): n for n in everything}
    if only is not None and only not in names:
        raise unknown_name("figure or study", only, names)
    chosen = [names[only]] if only is not None else everything if extended else list(available())
    covered = everything if extended or only in STUDIES else list(available())
    return draw(chosen, covered, out, jobs=jobs, force=force, say=say, progress=progress)
