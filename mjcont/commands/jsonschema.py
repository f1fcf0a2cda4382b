"""The JSON Schema of study files, made of the tables that read them: editors complete and check with it.

`studies/study.schema.json` is its text, written by scripts/study_tables.py.
"""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Any

from mjcont.studies.forms import DEFINITIONS
from mjcont.studies.plans import TOP
from mjcont.studies.tables import KINDS

SCHEMA = Path(str(resources.files("mjcont"))) / "studies" / "study.schema.json"


def schema() -> dict[str, Any]:
    """Return the schema, draft 7, which editors know."""
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A study of mjcont",
        "type": "object",
        "properties": dict(TOP),
        "required": ["model"],
        "anyOf": [{"required": [kind.table]} for kind in KINDS.values()],
        "additionalProperties": False,
        "definitions": dict(DEFINITIONS),
    }


def text() -> str:
    """Return the schema as a file has it."""
    return json.dumps(schema(), indent=1, ensure_ascii=False) + "\n"
