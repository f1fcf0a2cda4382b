"""The files that an MJCF reads, known before MuJoCo reads them: what it would not survive is refused.

MuJoCo follows models that attach each other until its stack is full, and expands whatever count a file states. The
text is looked at tag by tag, not parsed: MuJoCo takes a little more than XML.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import prod
from pathlib import Path

import numpy as np

from mjcont.errors import ModelError
from mjcont.numerics.equations.problem import Array

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_TAG = re.compile(r"""<(/?)([A-Za-z_][\w.-]*)((?:[^<>"']|"[^"]*"|'[^']*')*?)(/?)>""")
_ATTRIBUTE = re.compile(r"""([\w:-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_WORDS = {"include": "includes", "model": "attaches"}
# beyond these a model takes minutes or all memory; no mechanism comes near
MOST_ELEMENTS, MOST_ENTRIES, MOST_PIXELS, MOST_DEEP = 200_000, 10_000_000, 50_000_000, 50
MOST_FREEDOMS = 5000
_SIZES: Mapping[str, tuple[str, ...]] = {
    "size": ("nkey", "nuserdata", "nconmax", "njmax", "nuser_body", "nuser_jnt", "nuser_geom", "nuser_site",
             "nuser_cam", "nuser_tendon", "nuser_actuator", "nuser_sensor"),
    "numeric": ("size",), "user": ("dim",), "plugin": ("dim",), "general": ("actdim",),
}
_AREAS = {"hfield": ("nrow", "ncol"), "texture": ("width", "height")}


@dataclass(frozen=True, slots=True)
class Tag:
    """A tag of a text: whether it closes, its name and attributes, whether it is empty."""

    closes: bool
    name: str
    attributes: Mapping[str, str]
    empty: bool


def tags(text: str) -> Iterator[Tag]:
    """Yield the tags of an XML text."""
    for found in _TAG.finditer(_COMMENT.sub("", text)):
        attributes = {name: a or b for name, a, b in _ATTRIBUTE.findall(found[3])}
        yield Tag(bool(found[1]), found[2], attributes, bool(found[4]))


def look_at(text: str, folder: Path | None, label: str) -> tuple[Path, ...]:
    """Return the files of MJCF that a text includes or attaches, in the order in which they are met.

    Raises
    ------
    ModelError
        If files contain each other in a circle, or the text states sizes that no memory has room for.
    """
    scan = _Scan((folder or Path()).resolve(), label)
    own = Path(label).resolve() if folder is not None else None
    counts = scan.count(text, (own,) if own is not None else (), ("",) if own is not None else ())
    for count, most, what in zip(counts, (MOST_ELEMENTS, MOST_FREEDOMS), ("elements", "joints"), strict=True):
        if count > most:
            raise ModelError(
                f"model {label}: it has {count:.0f} {what}, replicates, grids and attached models counted in; at most "
                f"{most} are taken (matrices of all degrees of freedom are kept in full)"
            )
    return tuple(scan.files)


class _Scan:
    """A walk through a text and the files that it reads."""

    def __init__(self, folder: Path, label: str) -> None:
        self.folder, self.label = folder, label
        self.files: dict[Path, Array] = {}

    def count(self, text: str, chain: tuple[Path, ...], links: tuple[str, ...]) -> Array:
        """Return the numbers of elements and joints of a text; `chain` are the files that lead to it, `links` how."""
        total, factors, models = np.zeros(2), [1.0], {}
        for tag in tags(text):
            if tag.closes:
                if len(factors) > 1:
                    factors.pop()
                continue
            self._refuse_sizes(tag)
            a, here = tag.attributes, factors[-1]
            own = prod(_numbers(a.get("count", "1"))) if tag.name in ("composite", "flexcomp") else 1.0
            total += here * own * np.array([1.0, tag.name in ("joint", "freejoint")])
            if tag.name in _WORDS and a.get("file"):
                inside = self._file(a["file"], chain, (*links, _WORDS[tag.name]))
                total += here * inside * (tag.name == "include")
                models[a.get("name", Path(a["file"]).stem)] = inside
            if tag.name == "attach":
                total += here * models.get(a.get("model", ""), np.zeros(2))
            if not tag.empty:
                factors.append(here * (prod(_numbers(a.get("count", "1"))) if tag.name == "replicate" else 1.0))
        return total

    def _file(self, name: str, chain: tuple[Path, ...], links: tuple[str, ...]) -> Array:
        beside = chain[-1].parent if chain else self.folder
        places = [p.resolve() for p in (beside / name, self.folder / name) if p.is_file()]
        if not places:
            return np.zeros(2)  # MuJoCo says what is missing
        place = places[0]
        if place in chain:
            first = chain.index(place)
            circle = [place.name]
            for file, link in zip((*chain[first + 1 :], place), links[first + 1 :], strict=True):
                circle.append(f"{link} {file.name}")
            raise ModelError(f"model {self.label}: {', which '.join([' '.join(circle[:2]), *circle[2:]])}: without end")
        if place not in self.files:
            if len(chain) > MOST_DEEP:
                raise ModelError(f"model {self.label}: {place.name} is the {len(chain)}th file in a chain of files")
            self.files[place] = np.zeros(2)
            try:
                text = place.read_text(encoding="utf-8", errors="replace")
            except OSError:
                return self.files[place]
            self.files[place] = self.count(text, (*chain, place), links)
        return self.files[place]

    def _refuse_sizes(self, tag: Tag) -> None:
        for name in _SIZES.get(tag.name, ()):
            if prod(_numbers(tag.attributes.get(name, "0"))) > MOST_ENTRIES:
                raise ModelError(
                    f"model {self.label}: <{tag.name} {name}=\"{tag.attributes[name]}\"> asks for more than "
                    f"{MOST_ENTRIES:,} entries"
                )
        sides = _AREAS.get(tag.name, ())
        if sides and prod(prod(_numbers(tag.attributes.get(s, "0"))) for s in sides) > MOST_PIXELS:
            given = " ".join(f'{s}="{tag.attributes[s]}"' for s in sides)
            raise ModelError(f"model {self.label}: <{tag.name} {given}> has more than {MOST_PIXELS:,} points")


def _numbers(text: str) -> list[float]:
    """Return the whole numbers of an attribute, none below 1; MuJoCo says what is no number."""
    return [max(float(word), 1.0) for word in text.split() if word.lstrip("+").isdecimal()]
