"""Text from models and files where it would be more than text: on a terminal, in a picture, in a report's tables."""

from __future__ import annotations

import html
import re

_LONGEST = 60
_MARKUP = re.compile(r"\||<(?=[A-Za-z/!?])|(?<=\])\(")  # ends of cells, tags, links


def for_terminal(text: str) -> str:
    """Return text whose characters that would command a terminal are written out; line ends and tabs stay."""
    return "".join(c if c.isprintable() or c in "\n\t" else _written_out(c) for c in text)


def for_picture(name: str) -> str:
    """Return a name as matplotlib draws it, character by character on one line; a long one without its middle."""
    shown = "".join(c if c.isprintable() else _written_out(c) for c in name)
    if len(shown) > _LONGEST:
        half = (_LONGEST - 1) // 2
        shown = f"{shown[:half]}…{shown[-half:]}"
    return shown.replace("$", r"\$")


def for_page(text: str) -> str:
    """Return text for HTML, also inside quotes."""
    return html.escape(for_terminal(text))


def for_cell(text: str) -> str:
    """Return text for a cell of a table in Markdown."""
    return " ".join(_MARKUP.sub(r"\\\g<0>", for_terminal(text)).split())


def _written_out(character: str) -> str:
    return character.encode("unicode_escape", "backslashreplace").decode("ascii")
