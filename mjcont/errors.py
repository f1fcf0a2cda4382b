"""Every error that a user of mjcont can cause, and how their messages list the valid choices.

Failure of the numerics is not here: a branch that cannot go on says so in its status.
"""

from __future__ import annotations

import difflib
import os
import sys
import warnings
from collections.abc import Iterable
from types import FrameType

_PACKAGE = os.path.dirname(__file__) + os.sep


class MjcontError(Exception):
    """Base of all errors that mjcont raises on purpose."""


class ModelError(MjcontError):
    """A model file that cannot be read, compiled, or treated as an equilibrium problem."""


class NameLookupError(MjcontError):
    """A name that the model does not have; the message lists those it has."""


class ParameterError(MjcontError):
    """A parameter declaration or value that does not fit the model."""


class BoundsError(MjcontError):
    """Bounds that are empty, exclude the start, or leave the range of a control."""


class FunctionError(MjcontError):
    """A function of the user's own, such as a vector field's, that raised an error or returned no numbers."""


class StartError(MjcontError):
    """No equilibrium was found from the given start."""


class StudyError(MjcontError):
    """A study file with a wrong key, type or value."""


class ResultFileError(MjcontError):
    """A result file that cannot be read or does not fit the given problem."""


class ModelWarning(UserWarning):
    """A feature of a model that is left out, with the reason."""


class BranchWarning(UserWarning):
    """A start at which several branches meet, one of which is followed."""


class RangeWarning(UserWarning):
    """A value outside the range that its parameter declares, often one in another unit."""


class ResultWarning(UserWarning):
    """A stored result whose damage would not be seen: it was written without checksums."""


def warn(message: str, category: type[Warning]) -> None:
    """Give a warning that names the line of the user's own that led to it: the one that called into this package."""
    frame: FrameType | None = sys._getframe(1)
    level, outermost = 2, 1
    while frame is not None:  # other packages may lie between ours
        if frame.f_code.co_filename.startswith(_PACKAGE):
            outermost = level
        frame, level = frame.f_back, level + 1
    warnings.warn(message, category, stacklevel=outermost + 1)


def leaves_domain(error: Exception) -> bool:
    """Whether a user's function has no value there, by overflow, division by zero or a root of a negative number."""
    words = ("math domain", "nonnegative", "positive input")
    return isinstance(error, ArithmeticError) or (
        isinstance(error, ValueError) and any(word in str(error) for word in words)
    )


def did_you_mean(name: str, valid: Iterable[str]) -> str:
    """Return the question which of `valid` was meant, with a space before it; empty where none is close.

    Case makes no difference, nor do a few letters, nor whether dashes, dots, blanks or underscores join words.
    """
    plain: dict[str, list[str]] = {}
    for choice in valid:
        plain.setdefault(_plain(choice), []).append(choice)
    close = difflib.get_close_matches(_plain(str(name)), sorted(plain), n=3, cutoff=0.6)
    found = [choice for word in close for choice in sorted(plain[word])][:3]
    return f" Did you mean {' or '.join(found)}?" if found else ""


def _plain(name: str) -> str:
    return "".join(" " if c in "-_. " else c for c in name.casefold()).strip()


def unknown_name(kind: str, name: str, valid: Iterable[str]) -> NameLookupError:
    """Return the error for `name`, which is not among `valid`: close matches first, then the whole list."""
    choices = sorted(valid)
    listing = ", ".join(choices) if choices else "none"
    return NameLookupError(f"unknown {kind} '{name}'.{did_you_mean(name, choices)} Valid: {listing}.")
