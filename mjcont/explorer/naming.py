"""What results are called on a page: their kind, and what differs between those of one kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from mjcont.results.branch import Branch
from mjcont.results.points import show

_WORDS = {
    "CycleBranch": "orbits", "LoadPath": "load path", "History": "history", "SpecialMap": "map",
    "Sensitivities": "sensitivities", "BarrierCurve": "barriers", "Diagram": "diagram",
}


def named(results: Sequence[Any]) -> dict[str, Any]:
    """Return results by names that tell them apart: "equilibria", "LP locus", "equilibria, k_j = 100 N/m"."""
    words = [_word(r) for r in results]
    alike = [[r for r, w in zip(results, words, strict=True) if w == word] for word in words]
    full = [", ".join([w, *_differences(r, same)]) for r, w, same in zip(results, words, alike, strict=True)]
    seen: Counter[str] = Counter()
    found = {}
    for name, result in zip(full, results, strict=True):
        seen[name] += 1
        found[name if seen[name] == 1 else f"{name} ({seen[name]})"] = result
    return found


def _word(result: Any) -> str:
    return _WORDS.get(type(result).__name__, "") or str(getattr(result, "kind", "result"))


def _differences(result: Any, same: Sequence[Any]) -> list[str]:
    """Return the values of the parameters along a branch that are not those of all others."""
    if not all(isinstance(r, Branch) for r in same):
        return []
    common = set.intersection(*(set(r.fixed) for r in same))
    names = [n for n in result.fixed if n in common and len({r.fixed[n] for r in same}) > 1]
    return [f"{n} = {show(result.fixed[n], result.unit(n), 4).replace('*', ' ')}" for n in names]
