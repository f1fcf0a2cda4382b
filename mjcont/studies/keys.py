"""Tables of a study file as data: which keys each has, how they are read, what they default to.

A key's reader checks its value against the model and what the study names before; every problem is noted, not only the
first. `values` and `references` have the readers, `tables` the tables themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from mjcont.errors import MjcontError, StudyError, unknown_name
from mjcont.studies.forms import Form, table
from mjcont.studies.schema import Table


@dataclass(frozen=True, slots=True)
class Known:
    """A result that the study will have: its kind, and what of it is known before it is computed."""

    kind: str
    free: tuple[str, ...] = ()
    zeros: bool = False


@dataclass(frozen=True, slots=True)
class Reference:
    """A point of another result: "equilibria:LP1"; without a label all of them."""

    result: str
    label: str = ""

    def __str__(self) -> str:
        """Return it as a study writes it."""
        return f"{self.result}:{self.label}" if self.label else self.result


@dataclass(slots=True)
class Context:
    """What keys are read against, and the problems met so far; without a mechanism only keys themselves are checked."""

    mechanism: Any
    common: Mapping[str, float] = field(default_factory=dict)
    known: dict[str, Known] = field(default_factory=dict)
    problems: list[StudyError] = field(default_factory=list)

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Note a problem and go on."""
        try:
            yield
        except StudyError as error:
            self.problems.append(error)

    def unit(self, name: Any) -> str:
        """Return the unit of a parameter; empty, which any unit fits, if there is none of this name."""
        try:
            return str(self.mechanism.parameter(name).unit) if isinstance(name, str) else ""
        except MjcontError:
            return ""


@contextmanager
def about(table: Table, key: str) -> Iterator[None]:
    """Let an error about the model name the file and the key."""
    try:
        yield
    except StudyError:
        raise
    except MjcontError as error:
        raise table.error(key, error) from error


@dataclass(frozen=True, slots=True)
class Reader:
    """What reads a key; `takes` says in the words of JSON Schema what it takes, for editors."""

    function: Callable[[Table, str, Context], Any]
    takes: Form

    def __call__(self, table: Table, key: str, context: Context) -> Any:
        """Return the value of a key, checked."""
        return self.function(table, key, context)


def takes(form: Form) -> Callable[[Callable[[Table, str, Context], Any]], Reader]:
    """Make a reader of a function, with what it takes."""
    return lambda function: Reader(function, form)


@dataclass(frozen=True, slots=True)
class Key:
    """A key: its reader, what docs/studies.md says of it, its value when left out, and how that is said."""

    read: Reader
    text: str
    default: Any = None
    needed: bool = False
    otherwise: str = ""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of table: its key at top level, what it is, its keys, and a check of them together."""

    table: str
    title: str
    keys: Mapping[str, Key]
    check: Callable[[dict[str, Any], Table, Context], None] | None = None

    def form(self) -> Form:
        """Return what the table takes, in the words of JSON Schema."""
        said = {name: {**key.read.takes, "description": key.text} for name, key in self.keys.items()}
        return table(said, *(name for name, key in self.keys.items() if key.needed), text=self.title)


def read(table: Table, kind: Kind, context: Context) -> dict[str, Any] | None:
    """Return the values of a table, or None if anything in it is wrong; problems are noted."""
    before = len(context.problems)
    check_keys(table, kind.keys, [k for k, v in kind.keys.items() if v.needed], context)
    if context.mechanism is None:
        return None
    found: dict[str, Any] = {}
    for key, spec in kind.keys.items():
        with context.noting():
            found[key] = spec.read(table, key, context) if key in table.data else spec.default
    if len(context.problems) > before:
        return None
    with context.noting():
        if kind.check is not None:
            kind.check(found, table, context)
    return found if len(context.problems) == before else None


def check_keys(table: Table, valid: Mapping[str, Any] | Sequence[str], needed: Sequence[str], context: Context) -> None:
    """Note every key that is not among the valid ones, and every one that is missing."""
    for key in table.data:
        with context.noting():
            if key not in valid:
                raise table.error(key, unknown_name("key", key, valid))
    for key in needed:
        with context.noting():
            if key not in table.data:
                raise table.error(key, f"this key is missing. Needed here: {', '.join(needed)}.")
