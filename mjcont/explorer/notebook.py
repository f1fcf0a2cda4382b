"""The verb that shows the explorer in a notebook; what that needs is imported when it is called."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from mjcont.arguments import checked
from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.outside.saving import checked_path, write_file
from mjcont.results.formats import Result
from mjcont.results.sweeps import SweepTable

if TYPE_CHECKING:
    from mjcont.explorer.widget import Explorer


@checked
def explore(source: Mechanism | Result | str | Path, file: str | Path | None = None) -> Explorer:
    """Return the explorer of a result, a model or a study, for a notebook to show.

    Parameters
    ----------
    source : Branch, another result that can be saved, Mechanism, or the path of a model, a study or a result
        From a branch of equilibria the session goes on: its folds can be followed, and so on.
    file : path, optional
        Where a result (`.h5`) or a model (`.xml`) is stored, for the session's study to name; default a file that goes
        with the widget, and that the study cannot name for longer.

    Raises
    ------
    MjcontError
        If anywidget is not installed, or the source has no MJCF text, from which the session's process works.
    """
    from mjcont.explorer.widget import Explorer

    if isinstance(source, str | Path):
        return Explorer(str(source))
    problem = source if isinstance(source, Mechanism) else getattr(source, "problem", None)
    if not isinstance(problem, Mechanism) or problem.mjcf is None or isinstance(source, SweepTable):
        raise MjcontError("the explorer takes a Mechanism that was read from MJCF, or a result of one; mc.to_html "
                          "writes a page of others")
    if isinstance(source, Mechanism) and source.declared:
        raise MjcontError(f"{source.name} has parameters of this program's own, {', '.join(source.declared)}: give a "
                          "result, whose file carries them")
    folder = tempfile.TemporaryDirectory(prefix="mjcont-") if file is None else None
    if folder is not None:
        stem = "equilibria" if getattr(source, "kind", "") == "equilibria" else "result"
        file = Path(folder.name) / ("model.xml" if isinstance(source, Mechanism) else f"{stem}.h5")
    path = checked_path(file or "")
    if isinstance(source, Mechanism):
        write_file(path, problem.mjcf)
    else:
        source.save(path)
    return Explorer(str(path), None if folder is None else folder.cleanup)
