"""What `mjcont docs` finds in this installation: pages, words of the glossary, names of the Python interface."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

from mjcont.errors import unknown_name
from mjcont.models.loading import shipped_folder

_GLOSSARY = "glossary"
_ENTRY = re.compile(r"^### (.+)\n+((?:(?!^##).*\n?)*)", re.MULTILINE)
_LISTED = 80  # characters of a line that lists a method


def folder() -> Path:
    """Return where the pages are."""
    return shipped_folder("docs")


def pages() -> dict[str, Path]:
    """Return the pages' files by their names."""
    return {path.stem: path for path in sorted(folder().glob("*.md"))}


def words() -> dict[str, str]:
    """Return the entries of the glossary by their words, in small letters."""
    text = (folder() / f"{_GLOSSARY}.md").read_text(encoding="utf-8")
    return {word.lower(): f"{word}\n\n{entry.strip()}" for word, entry in _ENTRY.findall(text)}


def place(topic: str) -> Path:
    """Return the file of a page, or the one with a word of the glossary.

    Raises
    ------
    NameLookupError
        If there is neither.
    """
    known = pages()
    name = topic.removesuffix(".md").removeprefix("docs/")
    if name in known:
        return known[name]
    if topic.lower() in words():
        return known[_GLOSSARY]
    raise unknown_name("page", topic, known)


def text_of(topic: str) -> str:
    """Return a page, or the entry of the glossary and what a name of the Python interface is for.

    Raises
    ------
    NameLookupError
        If there is none of these.
    """
    found = [words().get(topic.lower(), ""), _described(topic)]
    if topic not in pages() and any(found):
        return "\n\n".join(text for text in found if text)
    return place(topic).read_text(encoding="utf-8").rstrip()


def _described(topic: str) -> str:
    """Return the signature and the docstring of a public name such as `plot` or `Branch.at`, or nothing."""
    import mjcont

    name, _, member = topic.removeprefix("mjcont.").removeprefix("mc.").partition(".")
    if name not in mjcont.__all__ or member.startswith("_"):
        return ""
    owner = getattr(mjcont, name)
    value = getattr(owner, member, None) if member else owner
    if value is None:
        return ""
    shown = f"mjcont.{name}.{member}" if member else f"mjcont.{name}"
    lines = [f"{shown}{_signature(value)}", "", inspect.getdoc(value) or ""]
    if inspect.isclass(value):
        methods = {n: getattr(value, n) for n in dir(value) if not n.startswith("_")}
        lines += ["", *(f"  .{n:<16} {_first_line(m)}"[:_LISTED] for n, m in methods.items() if _first_line(m))]
    return "\n".join(lines).rstrip()


def _signature(value: object) -> str:
    return str(inspect.signature(value)) if callable(value) else ""


def _first_line(value: object) -> str:
    return (inspect.getdoc(value) or "").partition("\n")[0] if callable(value) or isinstance(value, property) else ""
