"""What the gallery shows of a script: the figures among its variables, after each of its blocks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

_SHOWN = "_mjcont_gallery"


def scrape(block: Any, block_vars: Mapping[str, Any], gallery_conf: Mapping[str, Any]) -> str:
    """Save the figures that no block before has shown, and return the text that shows them."""
    paths = []
    for figure in figures(block_vars["example_globals"].values()):
        paths.append(next(block_vars["image_path_iterator"]))
        figure.savefig(paths[-1], dpi=110)
        setattr(figure, _SHOWN, True)
    return figure_rst(paths, gallery_conf["src_dir"])


def figures(values: Iterable[Any]) -> list[Figure]:
    """Return the figures among values, and those of axes, each once and none that was shown."""
    every = [f for v in values if isinstance(v, Artist) and isinstance(f := v.get_figure(root=True), Figure)]
    return [f for f in dict.fromkeys(every) if not hasattr(f, _SHOWN)]
