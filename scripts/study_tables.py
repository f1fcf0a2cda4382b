"""Write what follows from the tables of a study, docs/studies.md and the JSON Schema: `scripts/study_tables.py`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mjcont.commands.jsonschema import SCHEMA
from mjcont.commands.jsonschema import text as schema_text
from mjcont.outside.saving import write_file
from mjcont.studies.keys import Key, Kind
from mjcont.studies.plots import PLOT
from mjcont.studies.tables import KINDS
from mjcont.studies.waveforms import SHAPES

DOCS = Path(__file__).resolve().parent.parent / "docs" / "studies.md"
FIRST, LAST = "<!-- keys: written by scripts/study_tables.py -->", "<!-- end of keys -->"


def shown(value: Any) -> str:
    """Return a default as TOML has it."""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return f'`"{value}"`' if isinstance(value, str) else f"`{value:g}`" if isinstance(value, float) else f"`{value}`"


def default(key: Key) -> str:
    """Return what the column on defaults says."""
    return "needed" if key.needed else key.otherwise or shown(key.default)


def section(kind: Kind) -> str:
    """Return the section on a table."""
    rows = [f"| `{name}` | {key.text} | {default(key)} |" for name, key in kind.keys.items()]
    return "\n".join([f"## `[[{kind.table}]]`", "", kind.title, "", "| key | | default |", "|---|---|---|", *rows])


def shapes() -> str:
    """Return the section on inputs."""
    rows = []
    for name, form in SHAPES.items():
        keys = ", ".join(f"`{k}`" if d is None else f"`{k} = {d:g}`" for k, d in form.keys.items())
        rows.append(f"| `{name}` | {form.text} | {keys} |")
    return "\n".join([
        "## Inputs", "",
        'An input of a history is a number, a table `{ times = [0, 1], values = [0, "5 N"] }` (linear between, held',
        'before and after), or a shape `{ shape = "ramp", from = 0, to = "5 N", duration = 2 }`. Times are in s.', "",
        "| shape | | keys |", "|---|---|---|", *rows,
    ])


def text() -> str:
    """Return all sections."""
    return "\n\n".join([*(section(kind) for kind in KINDS.values()), section(PLOT), shapes()])


def rewritten(page: str) -> str:
    """Return the page with its sections on keys as they should be."""
    before, _, rest = page.partition(FIRST)
    return f"{before}{FIRST}\n\n{text()}\n\n{LAST}{rest.partition(LAST)[2]}"


if __name__ == "__main__":
    write_file(DOCS, rewritten(DOCS.read_text(encoding="utf-8")))
    write_file(SCHEMA, schema_text())
