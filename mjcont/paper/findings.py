"""Findings: what a figure or a study of the report shows, and whether the claim holds."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that a figure shows: the claim, what was computed, whether the claim holds, and on which model."""

    claim: str
    computed: str
    holds: bool
    model: str = ""

    def __post_init__(self) -> None:
        """Make `holds` a plain bool, whatever NumPy gave."""
        object.__setattr__(self, "holds", bool(self.holds))


@dataclass(frozen=True, slots=True)
class FigureResult:
    """A figure or a study that was drawn, or failed for a reason; `stamp` identifies all that it was made from.

    `pages` are the names of its interactive twins.
    """

    figure: int | str
    title: str
    caption: str
    findings: tuple[Finding, ...]
    reason: str
    stamp: str
    pages: tuple[str, ...] = ()

    @property
    def image(self) -> str:
        """Name of the picture's file."""
        return f"{stem(self.figure)}.png"

    def __str__(self) -> str:
        """Return the outcome in one line."""
        if self.reason:
            return f"{self.label}: failed: {self.reason}"
        return f"{self.label}: {sum(f.holds for f in self.findings)} of {len(self.findings)} findings hold"

    @property
    def label(self) -> str:
        """A figure's number or a study's name, to be read."""
        return label_of(self.figure)


def stem(figure: int | str) -> str:
    """Return the name, without ending, of a figure's or a study's script and files."""
    return f"fig{figure:02d}" if isinstance(figure, int) else figure


def label_of(figure: int | str) -> str:
    """Return a figure's number or a study's name, to be read."""
    return f"figure {figure}" if isinstance(figure, int) else figure
