"""The README as a package index shows it.

An index shows pictures and follows links by whole addresses only. pyproject.toml states where the repository's files
can be fetched (`files`); as long as that is nowhere, pictures are left out, and links are their words.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

try:
    from hatchling.metadata.plugin.interface import MetadataHookInterface
except ImportError:  # outside a build
    MetadataHookInterface = object

_PICTURE = re.compile(r"^!\[[^\]]*\]\([^)]*\)\n\n?", re.MULTILINE)
_CAPTIONED = re.compile(r"<!-- picture -->.*?<!-- end of picture -->\n\n?", re.DOTALL)
_PAGE = re.compile(r"\[([^\]]+)\]\(docs/(\w+)\.md\)")
_LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]*\)")
_TARGET = re.compile(r"\]\((?!https?:)([^)]*)\)")


def page(readme: str, files: str = "") -> str:
    """Return the text with whole addresses, or without pictures and links where there are no `files`."""
    if files:
        return _TARGET.sub(rf"]({files.rstrip('/')}/\1)", readme)
    words = _PAGE.sub(r"\1 (`mjcont docs \2`)", _PICTURE.sub("", _CAPTIONED.sub("", readme)))
    return _LINK.sub(r"\1", words)


class IndexPage(MetadataHookInterface):
    """Give the built package its page."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the package's readme."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": page(text, self.config.get("files", ""))}
