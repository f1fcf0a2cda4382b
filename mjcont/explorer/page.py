"""A document as one file of HTML that opens anywhere, offline: data, style, script, and a policy that allows no more.

The browser refuses any script but the one whose hash the page states, and every request; `<` is written out in the
data, so that no text of a model ends it.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from mjcont.errors import MjcontError
from mjcont.explorer.document import document_of
from mjcont.explorer.naming import named
from mjcont.outside.escapes import for_page
from mjcont.outside.saving import checked_path, write_file

_FOLDER = resources.files("mjcont.explorer") / "web" / "dist"
_ICON = "data:,"
_HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="mjcont">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="{icon}">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<div id="explorer"><noscript>A script draws this page, and scripts are switched off.</noscript></div>
<script type="application/json" id="document">{document}</script>
<script type="module">{script}</script>
<script type="text/plain" id="licences">{licences}</script>
</body>
</html>
"""


@cache
def bundle() -> tuple[str, str]:
    """Return the script and the style sheet of the page, as they were built."""
    script, style = ((_FOLDER / name).read_text(encoding="utf-8") for name in ("explorer.js", "explorer.css"))
    return script, style


def policy(connect: Sequence[str] = ()) -> str:
    """Return the content security policy: nothing but the page's own script and style, and sockets to `connect`."""
    script, style = (_hash(text) for text in bundle())
    parts = ["default-src 'none'", f"script-src {script}", f"style-src {style}", "img-src data: blob:"]
    return "; ".join([*parts, *([f"connect-src {' '.join(connect)}"] if connect else []), "base-uri 'none'",
                      "form-action 'none'"])


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def page(document: Mapping[str, Any] | None, connect: Sequence[str] = ()) -> str:
    """Return a document as a page; without one, a page that asks its server for it, at one of `connect`."""
    script, style = bundle()
    licences = (_FOLDER / "THIRD_PARTY_LICENSES.txt").read_text(encoding="utf-8").replace("<", "&lt;")
    data = json.dumps(document, allow_nan=False, separators=(",", ":"), ensure_ascii=False)
    title = f"{document['title']} - mjcont" if document else "mjcont"
    return _HEAD.format(
        policy=for_page(policy(connect)), icon=_ICON, title=for_page(title), style=style, script=script,
        licences=licences,
        document=data.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"),
    )


def to_html(path: str | Path, *results: Any, title: str = "", study: str = "") -> Path:
    """Write results as one page that opens in a browser without a server, and return its path.

    The page shows the mechanism beside its diagram: dragging along a branch moves it.

    Parameters
    ----------
    path : str or Path
        Ends with ".html".
    *results : Branch, CycleBranch, LoadPath, History, Sensitivities, SpecialMap, BarrierCurve, or a Diagram
        All of one model, which is shown.
    title : str
        Default the model's name.
    study : str
        The text of a study that makes them, for the page to hand out.

    Raises
    ------
    MjcontError
        If there is no result, one of another kind, or the file cannot be written.
    """
    return write_page(path, named(results), title=title, study=study)


def write_page(
    path: str | Path, results: Mapping[str, Any], *, title: str = "", study: str = "",
    files: Mapping[str, str] | None = None,
) -> Path:
    """Write results by name as one page, and return its path; `files` are those that the study names, their texts.

    The rest is as for `to_html`.
    """
    place = checked_path(path)
    if place.suffix.lower() not in (".html", ".htm"):
        raise MjcontError(f"a page is written as .html, got '{place.name}'")
    return write_file(place, page(document_of(results, title=title, study=study, files=files)))
