"""Hold the built site against what it promises: `python docs/check_site.py out/site`. Needs no network.

Every public name has a page and is found by the search; every link inside the site leads somewhere, to the anchor;
links that leave it are well-formed addresses. One line a finding, and exit status 1 if there is any.
"""

from __future__ import annotations

import inspect
import json
import re
import sys
import zlib
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import mjcont as mc
from mjcont.results.model import NOT_FOR_USERS


class _Page(HTMLParser):
    """The anchors and the links of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take down what a tag names and where it leads."""
        for name, value in attrs:
            if name == "id" and value:
                self.anchors.add(value)
            elif value and ((tag, name) == ("a", "href") or (tag in ("img", "script", "source") and name == "src")):
                self.links.append(value)


def public_names() -> list[str]:
    """Return all that a user may write after `mc.`: functions, classes, and the classes' own methods and properties."""
    names = []
    for name in mc.__all__:
        names.append(f"mjcont.{name}")
        value = getattr(mc, name)
        if inspect.isclass(value):
            own = [n for n in vars(value) if not n.startswith("_") and n not in NOT_FOR_USERS]
            names += [f"mjcont.{name}.{n}" for n in own if _documented(value, n)]
    return names


def _documented(owner: type, name: str) -> bool:
    value = inspect.getattr_static(owner, name)
    kinds = (classmethod, staticmethod, property)
    return inspect.isfunction(value) or isinstance(value, kinds) or type(value).__name__ == "cached_property"


def names_without_page(site: Path, names: list[str]) -> Iterator[str]:
    """Yield the names that the inventory or the search does not know."""
    there, found = inventory(site), searched(site)
    for name in names:
        if name not in there:
            yield f"{name}: no page"
        elif name not in found:
            yield f"{name}: the search does not find it"


def inventory(site: Path) -> set[str]:
    """Return the names of Python objects in objects.inv: four lines, then compressed ones, "name py:role ..."."""
    packed = (site / "objects.inv").read_bytes().split(b"\n", 4)[4]
    lines = zlib.decompress(packed).decode("utf-8").splitlines()
    return {line.split(" ")[0] for line in lines if line.split(" ")[1].startswith("py:")}


def searched(site: Path) -> set[str]:
    """Return the full names of the objects in the search index."""
    text = (site / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text.removeprefix("Search.setIndex(").rstrip().rstrip(";").removesuffix(")"))
    return {
        ".".join(part for part in (prefix, entry[4]) if part) for prefix, entries in index["objects"].items()
        for entry in entries
    }


def broken_links(site: Path) -> Iterator[str]:
    """Yield the links that lead nowhere in the site, and those out of it that are no addresses."""
    pages = {p: _Page(p.read_text(encoding="utf-8")) for p in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme in ("http", "https", "mailto"):
                if parts.scheme != "mailto" and not re.fullmatch(r"[a-z0-9-]+(\.[a-z0-9-]+)+(:\d+)?", parts.netloc):
                    yield f"{path.relative_to(site)}: no address: {link}"
            elif parts.scheme != "data":
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                if not target.exists():
                    yield f"{path.relative_to(site)}: leads nowhere: {link}"
                elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                    yield f"{path.relative_to(site)}: no such place on the page: {link}"


def main(site: Path) -> int:
    """Print what is wrong and return the exit status."""
    names = public_names()
    findings = [*names_without_page(site, names), *broken_links(site)]
    for finding in findings:
        print(finding, file=sys.stderr)
    print(f"site: {len(names)} public names have a page that a search finds; {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
