"""Notes: facts about a point of a curve that are found out once and kept with it, each with a type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Protocol, TypeVar

T = TypeVar("T")


class Noted(Protocol):
    """What notes are kept with: a point of a curve."""

    @property
    def notes(self) -> dict[Any, Any]:
        """Its notes by their kind."""
        ...


class Note(Generic[T]):
    """A kind of note: declared once, where it is found out."""

    def known(self, point: Noted) -> bool:
        """Whether a point has it."""
        return self in point.notes

    def get(self, point: Noted) -> T | None:
        """Return a point's, None where it has none."""
        found: T | None = point.notes.get(self)
        return found

    def put(self, point: Noted, value: T) -> None:
        """Keep it with a point."""
        point.notes[self] = value

    def drop(self, point: Noted) -> None:
        """Forget a point's, if it has one."""
        point.notes.pop(self, None)

    def of(self, point: Noted, find: Callable[[], T]) -> T:
        """Return a point's, found out where it has none."""
        if self not in point.notes:
            point.notes[self] = find()
        found: T = point.notes[self]
        return found
