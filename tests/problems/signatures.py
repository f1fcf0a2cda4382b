"""What of a result must not turn on rounding: special points, statuses, stability, ends; and how two results differ.

A signature maps names to words, which must be equal, and to numbers with what they may be off by: for a special point
its stated tolerance, the last Newton step on its defining system.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

import mjcont as mc
from mjcont.curves.diagram import Diagram
from mjcont.numerics.equations.free import Free
from mjcont.results.loadpaths import LoadPath
from mjcont.results.search import Equilibria

# a last Newton step at the noise floor is drawn by chance: the error after it may be some times as large
STATED = 10.0
# what a tolerance cannot fall below: some units in the last place of a parameter's coordinate
FLOOR = 1e-12
# special points that differ by less, in states and in parts of parameters' ranges, are at one place
SAME_PLACE = 1e-6
# curves that end where their steps happened to take them
WANDERING = ("max points", "max arclength", "max time", "runs off", "interrupted", "stopped")


@dataclasses.dataclass(frozen=True)
class Number:
    """A value and what it may be off by."""

    value: float
    tolerance: float


Signature = dict[str, str | Number]


def signature(result: Any, name: str = "") -> Signature:
    """Return the signature of a result, or of several in a list or a dictionary."""
    return dict(_marks(result, name))


def differences(one: Signature, other: Signature) -> list[str]:
    """Return a sentence for each name in which two signatures differ."""
    found = [f"{name}: in one only ({(one.get(name) or other.get(name))})" for name in one.keys() ^ other.keys()]
    for name in one.keys() & other.keys():
        a, b = one[name], other[name]
        if isinstance(a, Number) and isinstance(b, Number):
            allowed = STATED * max(a.tolerance, b.tolerance)
            if not abs(a.value - b.value) <= allowed and not a.value == b.value:
                apart = abs(a.value - b.value)
                found.append(f"{name}: {a.value!r} and {b.value!r}, {apart:.1e} apart for {allowed:.1e}")
        elif a != b:
            found.append(f"{name}: {a} and {b}")
    return sorted(found)


def _marks(result: Any, name: str) -> Iterator[tuple[str, str | Number]]:
    if isinstance(result, mc.Branch):
        yield from _branch(result, name)
    elif isinstance(result, mc.SpecialPoint):
        yield from _special(result, name)
    elif isinstance(result, mc.Point):
        yield f"{name} rest", f"{result.stability}, {result.n_unstable}"
    elif isinstance(result, Diagram):
        yield from _marks(list(result), name)
    elif isinstance(result, Equilibria):
        words = [f"{p.stability} {p.n_unstable} {p.mirror_of}".strip() for p in result]
        yield f"{name} equilibria", "; ".join(words)
    elif isinstance(result, LoadPath):
        yield from _load_path(result, name)
    elif isinstance(result, Mapping):
        for key, value in result.items():
            yield from _marks(value, f"{name} {key}".strip())
    elif isinstance(result, list | tuple):
        yield f"{name} count", str(len(result))
        for i, value in enumerate(result, 1):
            yield from _marks(value, f"{name} {i}".strip())
    else:
        yield from _other(result, name)


def _branch(branch: mc.Branch, name: str) -> Iterator[tuple[str, str | Number]]:
    yield f"{name} points", _in_order(branch.special_points)
    yield f"{name} stability", _stretches(branch)
    yield f"{name} neutral saddles", str(len(branch.neutral_saddles))
    yield f"{name} notes", "; ".join(n for n in branch.notes if "rows between points" not in n)  # whose number is free
    for p in branch.special_points:
        yield from _special(p, f"{name} {p.label}")
    for which, row, (word, _) in zip(("first", "last"), (0, -1), branch.ends, strict=False):
        yield f"{name} {which} end", word
        if word in WANDERING or word == "closed":
            continue
        for n, (low, high) in branch.free.items():
            yield f"{name} {which} end at {n}", Number(float(branch[n][row]), 1e-7 * (high - low))


def _in_order(points: Sequence[mc.SpecialPoint]) -> str:
    """Return the labels in order along the branch; of points at one place neither comes first."""
    places: list[list[mc.SpecialPoint]] = []
    for p in points:
        if places and _apart(places[-1][-1], p) < SAME_PLACE:
            places[-1].append(p)
        else:
            places.append([p])
    return " ".join("+".join(sorted(p.label for p in place)) for place in places)


def _apart(p: mc.SpecialPoint, q: mc.SpecialPoint) -> float:
    moved = [abs(p[n] - q[n]) / (high - low) for n, (low, high) in p.free.items()]
    return float(max(*moved, np.abs(p.state - q.state).max()))


def _stretches(branch: mc.Branch) -> str:
    """Return stability and number of unstable eigenvalues along a branch; where it is marginal its sides count."""
    aside = np.ones(len(branch), dtype=bool)
    for p in branch.special_points:
        aside &= np.abs(branch.states - p.state).max(axis=1) > SAME_PLACE
    rows = zip(branch.stability.tolist(), branch.n_unstable.tolist(), aside.tolist(), strict=True)
    told = [f"{word} {count}" for word, count, counts in rows if counts and word != "marginal"]
    return ", ".join(key for key, _ in itertools.groupby(told)) or "marginal"


def _special(p: mc.SpecialPoint, name: str) -> Iterator[tuple[str, str | Number]]:
    yield f"{name} is", f"{p.kind}, {p.coefficients.get('type', '')}, {'located' if p.converged else 'a guess'}"
    yield f"{name} stability", f"{p.stability} {p.n_unstable}"
    for n, (low, high) in p.free.items():
        free = Free(n, low, high)
        slope = abs(free.slope(free.coordinate(p[n])))
        yield f"{name} {n}", Number(p[n], slope * max(p.tolerance, FLOOR))


def _load_path(path: LoadPath, name: str) -> Iterator[tuple[str, str | Number]]:
    yield f"{name} path", path.status
    yield f"{name} jumps", "; ".join(f"{j.label} {j.kind} {j.status}" for j in path.jumps)
    for i, s in enumerate(path.segments, 1):
        yield f"{name} segment {i}", f"leg {s.leg}, {s.direction}"
        yield f"{name} segment {i} points", " ".join(p.label for p in s.branch.special_points)


def _other(result: Any, name: str) -> Iterator[tuple[str, str | Number]]:
    """Yield statuses and points of any other result, and whether its numbers are finite."""
    if isinstance(result, np.ndarray) and result.dtype.kind in "fc":
        yield f"{name} finite", "".join("-+"[int(v)] for v in np.isfinite(result).ravel())
    elif isinstance(result, np.ndarray):
        yield from _marks(list(result.ravel()), name)
    elif result is None or isinstance(result, str):
        yield name, str(result)
    elif isinstance(result, float | int):
        yield f"{name} finite", str(math.isfinite(result))
    else:
        fields = {n: getattr(result, n) for n in ("status", "verdict", "active", "limit", "derivatives", "points",
                                                  "locus", "checks", "saddle") if hasattr(result, n)}
        yield name, type(result).__name__
        for n, value in fields.items():
            yield from _marks(dict(value) if isinstance(value, Mapping) else value, f"{name} {n}")
