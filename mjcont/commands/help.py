"""Commands that help with mjcont itself: `docs`, `schema` and `completion`."""

from __future__ import annotations

import argparse
from pathlib import Path

from mjcont.commands.common import OK, Command
from mjcont.commands.completion import SHELLS, script
from mjcont.commands.readers import place
from mjcont.outside.terminal import say


def register(command: Command) -> None:
    """Add the commands to the parser."""
    p = command("docs", "list what there is to read in this installation, or print a page, a word or a name", docs)
    p.add_argument("topic", metavar="TOPIC", nargs="*",
                   help="a page such as studies, a word such as fold, or a name such as load_path")
    p.add_argument("--path", action="store_true", help="print where the pages are, or the page is")

    p = command("schema", "print the JSON Schema of study files, with which editors complete and check them", schema)
    p.add_argument("-o", "--out", type=place, metavar="FILE.json", help="write it there instead")
    p.add_argument("--path", action="store_true", help="print where it is in this installation")

    p = command("completion", "print what lets a shell complete mjcont's commands", completion)
    p.add_argument("shell", metavar="SHELL", choices=SHELLS, help=", ".join(SHELLS))


def docs(args: argparse.Namespace) -> int:
    """List the pages of the documentation, or print one, a word of the glossary or what a name is for."""
    from mjcont.commands import pages

    topic = " ".join(args.topic)
    if topic:
        say(str(pages.place(topic)) if args.path else pages.text_of(topic))
        return OK
    if args.path:
        say(str(pages.folder()))
        return OK
    lines = [f"{name:<16} {_title(path.read_text(encoding='utf-8'))}" for name, path in pages.pages().items()]
    say("\n".join([*lines, "", f"They are in {pages.folder()}; mjcont docs PAGE prints one. It explains words (fold) "
                   "and names (load_path), too."]))
    return OK


def _title(text: str) -> str:
    return text.partition("\n")[0].lstrip("# ")


def schema(args: argparse.Namespace) -> int:
    """Print the JSON Schema of study files."""
    from mjcont.commands.jsonschema import SCHEMA, text
    from mjcont.outside.saving import write_file

    if args.out:
        say(f"written: {write_file(args.out, text())}")
        say(f"begin a study with the line: #:schema ./{Path(args.out).name}")
    else:
        say(str(SCHEMA) if args.path else text().rstrip())
    return OK


def completion(args: argparse.Namespace) -> int:
    """Print the script that a shell reads."""
    from mjcont.commands.cli import parser
    from mjcont.models.loading import shipped_models
    from mjcont.studies.plans import shipped_studies

    say(script(args.shell, parser(), {"model": shipped_models(), "study": shipped_studies()}))
    return OK
