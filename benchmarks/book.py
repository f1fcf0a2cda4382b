"""What was measured so far: every row is printed and written as it comes, and one that fails says so."""

from __future__ import annotations

import json
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from mjcont.commands.progress import spoken, time_left
from mjcont.outside.saving import write_file

FAILED, MISSING = "failed", "missing"


class Missing(Exception):
    """A peer that cannot be had here; the argument says why."""


@dataclass(frozen=True, slots=True)
class Job:
    """One row of the table: its section and name, and what measures it, given what takes a word on the progress."""

    section: str
    name: str
    measure: Callable[[Callable[[str], None]], Any]


class Layout(Protocol):
    """How rows are shown."""

    def head(self, section: str) -> Sequence[str]:
        """Return the lines above a section."""
        ...

    def row(self, section: str, name: str, row: Any) -> Sequence[str]:
        """Return the lines of a row."""
        ...


@dataclass(slots=True)
class Book:
    """The results by section and name, in memory and in a JSON file.

    Attributes
    ----------
    broken : the rows that failed.
    """

    path: Path
    result: dict[str, Any]
    layout: Layout
    broken: list[str] = field(default_factory=list)

    def run(self, plan: Sequence[Job]) -> None:
        """Measure everything; an interrupt leaves the rows before it.

        Raises
        ------
        KeyboardInterrupt
            After an interrupt, also one that a continuation took for a wish for part of a branch.
        """
        began = time.monotonic()
        with _interrupts() as stopped:
            for number, job in enumerate(plan, 1):
                seconds = time.monotonic() - began
                far = f"{number}/{len(plan)}, {spoken(seconds)}{time_left((number - 1) / len(plan), seconds)}"
                where = f"[{far}] {job.section}: {job.name}"
                row = self._measured(job, where, stopped)
                stopped()
                self.add(job.section, job.name, row)
        _say("")

    def _measured(self, job: Job, where: str, stopped: Callable[[], None]) -> Any:
        def tell(word: str) -> None:
            stopped()
            _say(f"{where}, {word}")

        _say(where, keep=True)
        try:
            return job.measure(tell)
        except Missing as missing:
            return {MISSING: str(missing)}
        except Exception as error:  # whatever it is, the other rows are measured
            return {FAILED: f"{type(error).__name__}: {' '.join(str(error).split())}"}

    def add(self, section: str, name: str, row: Any) -> None:
        """Take a row, print it and write the file."""
        if section not in self.result:
            self.result[section] = {}
            self._print(["", *self.layout.head(section)])
        self.result[section][name] = row
        unmeasured = [v for k, v in row.items() if k in (FAILED, MISSING)] if isinstance(row, dict) else []
        if isinstance(row, dict) and FAILED in row:
            self.broken.append(f"{section}: {name}")
        whole = any(isinstance(text, str) for text in unmeasured)
        self._print([f"{name}: not measured: {unmeasured[0]}"] if whole else self.layout.row(section, name, row))
        self.write()

    def write(self) -> None:
        """Write the file anew, whole or not at all."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        text = json.dumps(self.result, indent=1) + "\n"
        write_file(self.path, text)

    @staticmethod
    def _print(lines: Sequence[str]) -> None:
        _say("")
        print("\n".join(lines), flush=True)


@contextmanager
def _interrupts() -> Iterator[Callable[[], None]]:
    """Remember interrupts; what is yielded raises KeyboardInterrupt after one."""
    seen: list[int] = []

    def note(signum: int, frame: object) -> None:
        seen.append(signum)
        raise KeyboardInterrupt

    def stopped() -> None:
        if seen:
            raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, note)
    try:
        yield stopped
    finally:
        signal.signal(signal.SIGINT, before)


def _say(text: str, *, keep: bool = False) -> None:
    """Show what is being done on the terminal, in one line; elsewhere only what is to be kept, as lines."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)
    elif keep:
        print(text, file=sys.stderr, flush=True)
