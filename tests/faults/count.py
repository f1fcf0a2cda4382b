"""What a campaign counts: how each trial ended, and what must never be."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

FAULTS = ("traceback", "crash", "hang", "wrong", "lost", "litter", "unclear")


@dataclass
class Count:
    """How the trials of a campaign ended; `faults` tells how to repeat those that must not be."""

    name: str
    seed: int
    ends: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def add(self, trial: int, end: str, detail: str = "") -> None:
        """Note the end of a trial."""
        self.ends[end] += 1
        if end in FAULTS:
            self.faults.append(f"{self.name}, seed {self.seed}, trial {trial}: {end}: {detail[-600:]}")

    def __str__(self) -> str:
        """Return the counts in a line, then the faults."""
        ends = ", ".join(f"{n} {end}" for end, n in sorted(self.ends.items()))
        none = ", ".join(f"0 {fault}" for fault in FAULTS if not self.ends[fault])
        return "\n".join([f"{self.name}: {sum(self.ends.values())} trials: {ends}; {none}", *self.faults])
