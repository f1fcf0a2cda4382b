"""Editing MJCF as text: comments, blank lines and the user's own numbers stay; what is added keeps the indentation."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np

from mjcont.models.quiet import heard

_DIGITS = 17
_PRECISION = threading.Lock()  # the number of digits is one for all threads

Element = ElementTree.Element  # a comment is one whose tag is a function


def exact_text(spec: mujoco.MjSpec) -> str:
    """Return a spec as XML with all digits; MuJoCo's own setting is six."""
    library = ctypes.CDLL(str(next(Path(mujoco.__file__).parent.glob("libmujoco*"), "")) or None)
    setter = getattr(library, "_mjPRIVATE__set_xml_precision", None)
    getter = getattr(library, "_mjPRIVATE__get_xml_precision", None)
    with heard(), _PRECISION:
        spec.compile()
        if setter is None or getter is None:
            return str(spec.to_xml())
        before = getter()
        setter(ctypes.c_int(_DIGITS))
        try:
            return str(spec.to_xml())
        finally:
            setter(ctypes.c_int(before))


class Document:
    """An MJCF text being edited.

    Raises
    ------
    ElementTree.ParseError
        If the text is not well-formed XML (MuJoCo itself takes a little more, such as `--` in comments).
    """

    def __init__(self, text: str) -> None:
        start = max(text.find("<mujoco"), 0)
        self.head = "" if text[:start].lstrip().startswith("<?xml") else text[:start]
        builder = ElementTree.TreeBuilder(insert_comments=True)
        parser = ElementTree.XMLParser(target=builder)
        self.root: Element = ElementTree.fromstring(text[start:].encode(), parser)

    def __str__(self) -> str:
        """Return the text."""
        return self.head + ElementTree.tostring(self.root, encoding="unicode").rstrip().replace(" />", "/>") + "\n"

    def sections(self, tag: str) -> list[Element]:
        """Return the sections of that name, such as worldbody."""
        return self.root.findall(tag)

    def section(self, tag: str, before: str | None = None) -> Element:
        """Return the last section of that name, made if there is none: before another section, or at the end."""
        found = self.sections(tag)
        if found:
            return found[-1]
        made = ElementTree.Element(tag)
        others = self.sections(before) if before else []
        index = list(self.root).index(others[0]) if others else len(self.root)
        while others and index and not is_element(self.root[index - 1]):
            index -= 1  # a comment belongs to the section below it
        self.insert(self.root, made, index)
        if others:
            made.tail = "\n" + (made.tail or "")
        elif index:
            self.root[index - 1].tail = "\n" + (self.root[index - 1].tail or "")
        return made

    def named(self, section: str, name: str, *tags: str) -> Element | None:
        """Return the element called `name` with one of the tags in a section, at any depth."""
        for top in self.sections(section):
            for element in top.iter():
                if element.tag in tags and element.get("name") == name:
                    return element
        return None

    def parents(self) -> dict[Element, Element]:
        """Return every element's parent."""
        return {child: parent for parent in self.root.iter() for child in parent}

    def depth(self, element: Element) -> int:
        """Return how deep an element lies; the root at 0."""
        parents, depth = self.parents(), 0
        while element in parents:
            element, depth = parents[element], depth + 1
        return depth

    def insert(self, parent: Element, child: Element, index: int | None = None) -> None:
        """Put a child before the one at `index` (default at the end), on a line of its own."""
        index = len(parent) if index is None else index
        inner, outer = ("\n" + "  " * (self.depth(parent) + k) for k in (1, 0))
        if not len(parent):
            parent.text, child.tail = inner, outer
        elif index == len(parent):
            child.tail = outer
            parent[-1].tail = inner
        else:
            child.tail = inner
        parent.insert(index, child)

    def add(self, parent: Element, tag: str, attributes: dict[str, str], index: int | None = None) -> Element:
        """Make an element and insert it."""
        made = ElementTree.Element(tag, attributes)
        self.insert(parent, made, index)
        return made

    def comment(self, parent: Element, text: str, index: int | None = None) -> None:
        """Insert a comment."""
        made: Any = ElementTree.Comment(f" {text.replace('--', '- -')} ")
        self.insert(parent, made, index)

    def remove(self, child: Element) -> None:
        """Take an element out, and its parent with it if that has nothing left but comments."""
        parent = self.parents()[child]
        index = list(parent).index(child)
        if index == len(parent) - 1 and index:
            parent[index - 1].tail = child.tail
        parent.remove(child)
        if parent is not self.root and not elements(parent):
            self.remove(parent)


def included(text: str, folder: Path) -> str:
    """Return a text with those that it includes in their places; what cannot be read is left to MuJoCo to say."""
    if "<include" not in text:
        return text
    try:
        document = Document(text)
        while (change := _insert_included(document, folder)) is not None:
            document = change
    except (ElementTree.ParseError, OSError, UnicodeDecodeError):
        return text
    return str(document)


def _insert_included(document: Document, folder: Path) -> Document | None:
    """Put the children of one included text in the place of its <include>; None if there is none left."""
    parents = document.parents()
    found = next((e for e in document.root.iter("include") if e.get("file")), None)
    if found is None:
        return None
    parent, children = parents[found], list(Document((folder / str(found.get("file"))).read_text("utf-8")).root)
    index = list(parent).index(found)
    parent.remove(found)
    for k, child in enumerate(children):
        document.insert(parent, child, index + k)
    return document


def is_element(item: Any) -> bool:
    """Whether it is an element, not a comment."""
    return isinstance(item.tag, str)


def elements(parent: Element) -> list[Element]:
    """Return an element's children, comments apart."""
    return [c for c in parent if is_element(c)]


def number(value: float) -> str:
    """Return a number that reads back to the same; rounding errors of zeros and simple numbers are left out."""
    value = float(value)
    simple = round(value, 12)
    value = simple if abs(value - simple) < 4e-16 * max(1.0, abs(value)) else value
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def numbers(values: Iterable[float] | np.ndarray) -> str:
    """Return a vector as an attribute's text."""
    return " ".join(number(v) for v in values)
