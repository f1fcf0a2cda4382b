"""The README as a package index shows it: without the pictures and links that lead into the repository."""

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
_LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]*\)")


def page(readme: str) -> str:
    """Return the text without pictures, and with the words of links that are no web addresses."""
    return _LINK.sub(r"\1", _PICTURE.sub("", _CAPTIONED.sub("", readme)))


class IndexPage(MetadataHookInterface):
    """Give the built package its page."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the package's readme."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": page(text)}
