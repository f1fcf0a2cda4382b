"""Tables as CSV, for spreadsheets: quoted as RFC 4180 has it, and no cell is a formula."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from mjcont.outside.saving import write_file

# What makes a spreadsheet compute a cell, also in its wide forms; it then starts with ', which makes it text.
_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")


def write_table(path: str | Path, head: Sequence[str], rows: Iterable[Sequence[Any]]) -> Path:
    """Write a table; floats with all their digits, a text that a spreadsheet would run behind a '."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\r\n")
    out.writerow(map(cell, head))
    out.writerows(map(cell, row) for row in rows)
    return write_file(path, text.getvalue())


def cell(value: Any) -> Any:
    """Return a value as its cell has it."""
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, str) and value.lstrip(" ").startswith(_FORMULA):
        return f"'{value}"
    return value
