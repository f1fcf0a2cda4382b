"""What the dynamic check of a branch found: a verdict for each of some points."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mjcont.results.points import show
from mjcont.results.text import Cells, Shown, Tabular

CONFIRMED, CONTRADICTED, UNRESOLVED = "confirmed", "contradicted", "unresolved"


@dataclass(frozen=True, slots=True)
class Check:
    """One point of a branch and what its motions say.

    Attributes
    ----------
    index, label : row of the branch, and its label if it is a special point.
    parameters : values of the free parameters.
    stability : what the branch says.
    eigenvalue : the critical one of the branch, in 1/s.
    rate : measured growth rate in 1/s, NaN if none was measured.
    time : for how long the motions were followed, in s.
    verdict : "confirmed", "contradicted" or "unresolved".
    sentence : why.
    """

    index: int
    label: str
    parameters: Mapping[str, float]
    stability: str
    eigenvalue: complex
    rate: float
    time: float
    verdict: str
    sentence: str


@dataclass(frozen=True, slots=True, repr=False)
class Certificate(Tabular, Shown):
    """What the dynamic check of a branch found.

    Attributes
    ----------
    checks : tuple of Check, along the branch.
    tolerance : largest relative difference between measured and predicted rate that confirms.
    resolution : least |Re s| x time at which a rate counts as resolved.
    units : of the free parameters.
    """

    checks: tuple[Check, ...]
    tolerance: float
    resolution: float
    units: Mapping[str, str]

    def __len__(self) -> int:
        """Return the number of points checked."""
        return len(self.checks)

    def __iter__(self) -> Iterator[Check]:
        """Iterate over the checks."""
        return iter(self.checks)

    def of(self, verdict: str) -> list[Check]:
        """Return the checks with a verdict."""
        return [c for c in self.checks if c.verdict == verdict]

    @property
    def holds(self) -> bool:
        """Whether at least one point is confirmed and none contradicted."""
        return bool(self.of(CONFIRMED)) and not self.of(CONTRADICTED)

    @property
    def headline(self) -> str:
        """The counts as one line."""
        counts = Counter(c.verdict for c in self.checks)
        deviations = [abs(c.rate / c.eigenvalue.real - 1.0) for c in self.of(CONFIRMED)]
        worst = f", rates within {max(deviations):.1e} of the eigenvalues" if deviations else ""
        return (
            f"stability by simulation: {len(self)} points, {counts[CONFIRMED]} confirmed{worst}, "
            f"{counts[CONTRADICTED]} contradicted, {counts[UNRESOLVED]} unresolved"
        )

    def __str__(self) -> str:
        """Return the counts and a line for every point."""
        lines = [self.headline]
        for c in self.checks:
            place = ", ".join(f"{n} = {show(v, self.units.get(n, ''))}" for n, v in c.parameters.items())
            name = f"row {c.index}" + (f" ({c.label})" if c.label else "")
            lines.append(f"  {name}, {place}: {c.stability}, {c.verdict}: {c.sentence}")
        return "\n".join(lines)

    def plot(self, ax: Any = None) -> Any:
        """Draw rates of simulated motions beside those of the eigenvalues and return the axes."""
        from mjcont.drawing.charts import draw_certificate

        return draw_certificate(self, ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield "row", "", [c.index for c in self]
        yield "label", "", [c.label for c in self]
        yield from ((n, unit, np.array([c.parameters[n] for c in self])) for n, unit in self.units.items())
        yield "stability", "", [c.stability for c in self]
        yield "Re s", "1/s", [c.eigenvalue.real for c in self]
        yield "Im s", "1/s", [c.eigenvalue.imag for c in self]
        yield "rate", "1/s", [float(c.rate) for c in self]
        yield "time", "s", [float(c.time) for c in self]
        yield "verdict", "", [c.verdict for c in self]
        yield "sentence", "", [c.sentence for c in self]

    def to_json(self) -> str:
        """Return the certificate as JSON."""
        rows = [{**asdict(c), "eigenvalue": [c.eigenvalue.real, c.eigenvalue.imag]} for c in self.checks]
        head = {"tolerance": self.tolerance, "resolution": self.resolution, "units": dict(self.units)}
        return json.dumps({**head, "checks": rows})

    @classmethod
    def from_json(cls, text: str) -> Certificate:
        """Read what `to_json` wrote."""
        given = json.loads(text)
        checks = tuple(Check(**{**row, "eigenvalue": complex(*row["eigenvalue"])}) for row in given["checks"])
        return cls(checks, given["tolerance"], given["resolution"], given["units"])
