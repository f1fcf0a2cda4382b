"""What commands share: reading results, naming files in errors, printing warnings as lines."""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from mjcont.errors import MjcontError, ResultFileError
from mjcont.outside.saving import check_writable
from mjcont.outside.terminal import complain

if TYPE_CHECKING:
    from mjcont.results.branch import Branch

OK, FAILED, USER_ERROR, INTERRUPTED = 0, 1, 2, 130
MODEL_HELP = "an MJCF file, or the name of a model that ships with mjcont, such as overcentre"
FRICTION_HELP = "leave friction out of equilibria, or refuse models that have it (default: frictionless)"
STUDY_HELP = "a study file, or the name of one that ships with mjcont, such as overcentre"
JSON_HELP = "print JSON instead of words: SI units and radians"


class Command(Protocol):
    """Adds a command to the parser: its name, what it does, and the function that does it."""

    def __call__(
        self, name: str, text: str, function: Callable[[argparse.Namespace], int]
    ) -> argparse.ArgumentParser:
        """Return the command's own parser, to which its arguments are added."""


def is_result(name: str) -> bool:
    """Whether a name is that of a result file."""
    from mjcont.results.files import RESULT_SUFFIXES

    return Path(name).suffix.lower() in RESULT_SUFFIXES


@contextmanager
def warnings_as_lines() -> Iterator[None]:
    """Print each warning for the user as one line, once the work that gives it is done."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        yield
    for warning in caught:
        complain(f"mjcont: warning: {warning.message}")


@contextmanager
def naming(file: str) -> Iterator[None]:
    """Let an error name the file that it is about."""
    try:
        yield
    except MjcontError as error:
        raise type(error)(f"'{file}': {error}") from error


def load(path: str) -> Any:
    """Read a result file."""
    from mjcont.results.formats import load

    with warnings_as_lines():
        return load(path)


def refuse_input(out: Path, inputs: Sequence[str], what: str) -> None:
    """Refuse to write over what is read."""
    for file in inputs:
        if out.exists() and Path(file).exists() and out.samefile(file):
            raise MjcontError(f"'{out}' is the {what} itself: give the new one a name of its own")


def output(given: str | None, suffix: str, inputs: Sequence[str]) -> Path:
    """Return the file to be written, by default beside the first input, known to be writable and not read."""
    out = Path(given) if given else Path(inputs[0]).with_suffix(suffix)
    refuse_input(out, inputs, "input")
    check_writable(out)
    return out


def load_curve(path: str) -> Any:
    """Read a branch, a locus or a load path."""
    result = load(path)
    for mark, words in (("velocities", "time history"), ("cases", "sweep")):
        if hasattr(result, mark):
            raise ResultFileError(f"'{path}' holds a {words}: inspect and export take it, this command takes curves")
    return result


def load_branch(path: str) -> Branch:
    """Read a result that has points of its own to be named."""
    from mjcont.results.branch import Branch

    result = load_curve(path)
    if not isinstance(result, Branch):
        raise ResultFileError(f"'{path}' holds a load path: this command takes a branch or a locus")
    return result
