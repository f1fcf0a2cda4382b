"""Pages that are followed word for word: files saved, commands and Python run, and what is shown held against it.

A file is a block after the comment `<!-- file: NAME -->`. A block of text after commands or Python shows lines of what
these print; those with digits that another machine may round otherwise are not shown on a page. Needs no test tools:

    python pages.py PAGE.md ...      # follows pages, each in a new folder here
"""

from __future__ import annotations

import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NOT_FOLLOWED = ("pip", "make", "git", "cd", "eval")


@dataclass(frozen=True, slots=True)
class Block:
    """A block of a page: its language, its text, and the file that it is saved as."""

    language: str
    text: str
    file: str = ""


def blocks(page: Path) -> Iterator[Block]:
    """Yield the blocks of a page."""
    for file, language, text in _BLOCK.findall(page.read_text(encoding="utf-8")):
        yield Block(language, text, file)


def commands(block: Block) -> Iterator[str]:
    """Yield the commands of a console block, without comments; a line that ends with a backslash goes on."""
    for line in block.text.replace("\\\n", " ").splitlines():
        if line.startswith("$ "):
            words = shlex.split(line[2:], comments=True)
            if words and Path(words[0]).name not in _NOT_FOLLOWED:
                yield line[2:].partition("  #")[0].strip()


def run(command: str, folder: Path, python: str = sys.executable) -> str:
    """Run a command in a folder as a shell would, `mjcont` being this one; return what it printed."""
    command = re.sub(r"^(?:\.venv/bin/)?mjcont\b", f"{shlex.quote(python)} -m mjcont", command)
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "MPLBACKEND": "agg"})
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def follow(page: Path, folder: Path) -> dict[str, Any]:
    """Follow a page in a folder, which is where we are; return the names that its Python leaves."""
    names: dict[str, Any] = {"__name__": "__main__"}
    said = ""
    for block in blocks(page):
        if block.file:
            (folder / block.file).write_text(block.text, encoding="utf-8")
        elif block.language == "console":
            said = "".join(run(command, folder) for command in commands(block))
        elif block.language == "python":
            with redirect_stdout(io.StringIO()) as out:
                exec(compile(block.text, f"{page.name}", "exec"), names)  # noqa: S102
            said = out.getvalue()
        elif block.language == "text":
            missing = [line for line in block.text.splitlines() if line.strip() not in said]
            assert not missing, f"{page.name} shows {missing}, but it says\n{said}"
    return names


if __name__ == "__main__":
    for name in sys.argv[1:]:
        folder = Path.cwd() / Path(name).stem
        folder.mkdir()
        os.chdir(folder)
        follow(Path(name), folder)
        os.chdir(folder.parent)
