"""Where the elements of an MJCF stand in its text: start tags with their attributes, by what an element is called.

The text is looked at tag by tag, not parsed and written again: all but the numbers asked for stays to the letter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_PIECE = re.compile(
    r"""<!--.*?-->|<\?.*?\?>|<!\[CDATA\[.*?\]\]>|<(?P<close>/?)(?P<name>[A-Za-z_][\w.-]*)"""
    r"""(?P<inside>(?:[^<>"']|"[^"]*"|'[^']*')*?)(?P<empty>/?)>""",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"""([\w:-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
# the section in which elements of a kind stand, and their tags where these are not the kind's own name
_SECTIONS = {
    "body": "worldbody", "joint": "worldbody", "geom": "worldbody", "site": "worldbody", "inertial": "worldbody",
    "tendon": "tendon", "actuator": "actuator", "equality": "equality",
}
_ANY_TAG = frozenset({"tendon", "actuator", "equality"})


@dataclass(slots=True)
class Element:
    """An element in the text.

    Attributes
    ----------
    tag, chain : its tag, and the tags around it, the outermost first.
    values : attribute to its text.
    spans : attribute to where its text stands.
    end : where another attribute may be put.
    parent : the element around it.
    """

    tag: str
    chain: tuple[str, ...]
    values: dict[str, str]
    spans: dict[str, tuple[int, int]]
    end: int
    parent: Element | None = field(repr=False, default=None)


def elements(text: str) -> Iterator[Element]:
    """Yield the elements of an XML text in their order."""
    around: list[Element] = []
    for piece in _PIECE.finditer(text):
        if piece["name"] is None:
            continue
        if piece["close"]:
            if around:
                around.pop()
            continue
        values, spans, start = {}, {}, piece.start("inside")
        for a in _ATTRIBUTE.finditer(piece["inside"]):
            group = 2 if a[2] is not None else 3
            values[a[1]] = a[group]
            spans[a[1]] = start + a.start(group), start + a.end(group)
        end = start + len(piece["inside"].rstrip())
        found = Element(piece["name"], tuple(e.tag for e in around), values, spans, end, around[-1] if around else None)
        yield found
        if not piece["empty"]:
            around.append(found)


def find(text: str, kind: str, name: str) -> list[Element]:
    """Return the elements of a kind called `name`: of "inertial" that of the body so called, of "option" every one."""
    found = []
    for e in elements(text):
        if kind == "option":
            if e.tag == "option" and len(e.chain) == 1:
                found.append(e)
            continue
        if _SECTIONS[kind] not in e.chain[1:2]:
            continue
        if kind == "inertial":
            own = e.tag == "inertial" and e.parent is not None and e.parent.values.get("name") == name
        else:
            fits = len(e.chain) == 2 if kind in _ANY_TAG else e.tag == kind
            own = fits and e.values.get("name") == name
        found += [e] if own else []
    return found


class Edits:
    """Changes of attributes in a text, made together.

    Parameters
    ----------
    text : the MJCF.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self._made: dict[tuple[int, int], str] = {}
        self._added: dict[int, dict[str, str]] = {}

    def words(self, element: Element, attribute: str) -> list[str] | None:
        """Return an attribute's words with the changes so far, None if the element has none."""
        if attribute in element.spans:
            return self._made.get(element.spans[attribute], element.values[attribute]).split()
        added = self._added.get(element.end, {}).get(attribute)
        return None if added is None else added.split()

    def put(self, element: Element, attribute: str, words: list[str]) -> None:
        """Give an attribute other words; one that the element does not have is put at the end of its tag."""
        if attribute in element.spans:
            self._made[element.spans[attribute]] = " ".join(words)
        else:
            self._added.setdefault(element.end, {})[attribute] = " ".join(words)

    def __str__(self) -> str:
        """Return the text with all changes."""
        pieces = [(start, end, words) for (start, end), words in self._made.items()]
        pieces += [(at, at, "".join(f' {n}="{w}"' for n, w in added.items())) for at, added in self._added.items()]
        text = self.text
        for start, end, words in sorted(pieces, reverse=True):
            text = text[:start] + words + text[end:]
        return text
