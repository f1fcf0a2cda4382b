"""Two versions of a model and what they answer: what changed in the text, and how far special points moved.

Points of one kind on curves of one name are matched so that they move least in all; the others vanished or
appeared.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from scipy.optimize import linear_sum_assignment

from mjcont.curves.collect import Progress
from mjcont.curves.continuation import continue_equilibria
from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.results.branch import Branch
from mjcont.results.formats import load
from mjcont.results.points import SpecialPoint, show
from mjcont.studies.first import First, first_look
from mjcont.studies.plans import load_study
from mjcont.studies.reporter import Range, Reporter
from mjcont.studies.study import run_study

_SAME = 1e-9
_MOST = 40


@dataclass(frozen=True, slots=True)
class Moved:
    """A special point in both answers, or in one of them: the other is None."""

    old: SpecialPoint | None
    new: SpecialPoint | None


@dataclass(frozen=True, slots=True)
class Compared:
    """A curve in both answers, and its special points."""

    name: str
    old: Branch
    new: Branch
    points: tuple[Moved, ...]


@dataclass(frozen=True, slots=True)
class Comparison:
    """What changed between two models and what they answer.

    Attributes
    ----------
    names : what the old and the new are called.
    model : sentences on what changed in the model.
    curves : the curves that both have, with their special points matched.
    missing : sentences on curves that only one of them has.
    """

    names: tuple[str, str]
    model: tuple[str, ...]
    curves: tuple[Compared, ...]
    missing: tuple[str, ...] = ()

    def plot(self, x: str = "", y: str = "", *, name: str = "", ax: Any = None) -> Any:
        """Draw a curve (default the first) of both and return the axes; `y` is by default the first observable."""
        from mjcont.drawing.plotting import plot

        if not self.curves:
            raise MjcontError(f"nothing to draw: '{self.names[0]}' and '{self.names[1]}' have no curve in common")
        both = next((c for c in self.curves if c.name == name), self.curves[0])
        x = x or next(iter(both.old.free))
        y = y or next((n for n, c in both.old.columns.items() if c.role == "observable"), x)
        return plot(both.old, both.new, x=x, y=y, ax=ax, legend=list(self.names), key=True)

    def __str__(self) -> str:
        """Return what changed, a line each."""
        lines = [f"{self.names[0]} -> {self.names[1]}", "model: " + ("" if self.model else "nothing changed")]
        lines += [f"  {m}" for m in self.model[:_MOST]]
        lines += [f"  and {len(self.model) - _MOST} more"] if len(self.model) > _MOST else []
        for c in self.curves:
            lines.append(f"{c.name}, {c.old.kind} in {', '.join(c.old.free)}:")
            lines += [f"  {line}" for line in _told(c)]
        return "\n".join(line.rstrip() for line in [*lines, *self.missing])


def compare(old: str | Path, new: str | Path, folder: Path, reporter: Reporter | None = None) -> Comparison:
    """Return what changed between two models, studies or results; studies write their files into `folder`.

    Two models are given the same question, that of the old one's first study. `reporter` hears how it goes.

    Raises
    ------
    MjcontError
        If either cannot be read or computed.
    """
    sides = [_answers(source, folder / word, reporter) for source, word in ((old, "old"), (new, "new"))]
    looks = [s for s in sides if isinstance(s, First)]
    if len(looks) == 1:
        raise MjcontError(f"compare takes two models, or two of studies and results: got '{old}' and '{new}'")
    if looks:
        reporter = reporter or Reporter()
        sides = []
        for number, look in enumerate(looks, 1):
            span = Range(*looks[0].bounds, looks[0].parameter.unit)
            reporter.started("equilibria", look.mechanism.name, (number, 2), {looks[0].parameter.name: span})
            sides.append({"equilibria": _asked(looks[0], look.mechanism, reporter.point)})
            reporter.stopped()
    before, after = (s for s in sides if isinstance(s, Mapping))
    if len(before) == len(after) == 1:  # what a file is called makes no difference
        after = dict(zip(before, after.values(), strict=True))
    shared = [n for n in before if n in after and _alike(before[n], after[n])]
    curves = tuple(Compared(n, before[n], after[n], matched(before[n], after[n])) for n in shared)
    missing = [f"{n}, {own[n].kind} in {', '.join(own[n].free)}: only in {word}"
               for own, word in ((before, old), (after, new)) for n in own if n not in shared]
    models = [next((b.problem for b in s.values() if b.problem is not None), None) for s in (before, after)]
    texts = [str(m.mjcf or "") if m is not None else "" for m in models]
    changes = (*model_changes(*texts), *_held_changes(curves))
    return Comparison(_called(old, new), changes, curves, tuple(missing))


def _alike(old: Branch, new: Branch) -> bool:
    """Whether two curves answer one question: of one kind, in the same parameters."""
    return old.kind == new.kind and set(old.free) == set(new.free)


def _called(old: str | Path, new: str | Path) -> tuple[str, str]:
    """Return names short enough for a legend that differ."""
    names = Path(old).name, Path(new).name
    return (names[0], names[1]) if names[0] != names[1] else (str(old), str(new))


def _answers(source: str | Path, folder: Path, reporter: Reporter | None) -> dict[str, Branch] | First:
    """Return the curves of a result or a study, by name; of a model what its first study would ask."""
    suffix = Path(source).suffix.lower()
    if suffix in (".h5", ".hdf5"):
        result = load(source)
        if not isinstance(result, Branch):
            raise MjcontError(f"'{source}' holds no branch or locus: compare takes results with special points")
        return {Path(source).stem: result}
    if suffix != ".toml":
        return first_look(Mechanism.from_xml(source))
    study = load_study(source)
    found: dict[str, Branch] = {}
    for plan, result in zip(study.plans, run_study(study, folder, reporter), strict=False):
        several = list(result) if hasattr(result, "branches") else [result]
        numbered = len(several) > 1 or hasattr(result, "branches")
        found |= {f"{plan.name}_{i}" if numbered else plan.name: b for i, b in enumerate(several, 1)
                  if isinstance(b, Branch)}
    return found


def _asked(question: First, mechanism: Mechanism, progress: Progress) -> Branch:
    """Return the curve that answers a question about one model, of another."""
    keyframe = question.keyframe if question.keyframe in (None, *mechanism.keyframes) else None
    low, high = question.bounds
    value = question.parameter.value
    start = {} if low <= value <= high else {question.parameter.name: 0.5 * (low + high)}
    return continue_equilibria(
        mechanism, question.parameter.name, (low, high), start, keyframe=keyframe, progress=progress
    )


# -- models ------------------------------------------------------------------------------------------------


def model_changes(old: str, new: str) -> list[str]:
    """Return what changed between two MJCF texts, a sentence an element: attributes, elements gone and new."""
    try:
        before, after = (dict(_elements(ElementTree.fromstring(text), "")) if text else {} for text in (old, new))
    except ElementTree.ParseError:  # MuJoCo takes a little more than XML
        return [] if old == new else ["the text of the model changed"]
    gone, added = before.keys() - after.keys(), after.keys() - before.keys()
    found = [f"{place} is {word}" for places, lost, word in ((before, gone, "gone"), (after, added, "new"))
             for place in places if place in lost and _above(place) not in lost]
    for place, own in before.items():
        other = after.get(place, own)
        found += [f"{place}: {name} {own.get(name, '(default)')} -> {other.get(name, '(default)')}"
                  for name in dict.fromkeys((*own, *other))
                  if (own.get(name) or "").split() != (other.get(name) or "").split()]
    return found


def _elements(element: ElementTree.Element, above: str) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield each element's place, by names where it has one, with its attributes."""
    counts: dict[str, int] = {}
    for child in element:
        counts[child.tag] = counts.get(child.tag, 0) + 1
        called = child.get("name") or (child.get("class") if child.tag == "default" else None) or str(counts[child.tag])
        place = f"{above}{child.tag} {called}"
        yield place, dict(child.attrib)
        yield from _elements(child, f"{place} / ")


def _above(place: str) -> str:
    return place.rpartition(" / ")[0]


def _held_changes(curves: Sequence[Compared]) -> list[str]:
    """Return what changed in the values that the curves hold fixed."""
    found = []
    for c in curves:
        for name in dict.fromkeys((*c.old.fixed, *c.new.fixed)):
            a, b = c.old.fixed.get(name), c.new.fixed.get(name)
            if a is not None and b is not None and abs(a - b) > _SAME * max(abs(a), abs(b)):
                unit = c.old.fixed_units.get(name, "")
                found.append(f"{c.name}: {name} = {show(a, unit)} -> {show(b, unit)}")
    return found


# -- answers -----------------------------------------------------------------------------------------------


def matched(old: Branch, new: Branch) -> tuple[Moved, ...]:
    """Return the special points of two curves side by side, those that are in one of them alone at the end."""
    names = [n for n, c in old.columns.items() if n in new.columns and c.unit == new.columns[n].unit]
    spans = {n: float(np.ptp(old[n])) or 1.0 for n in names}
    pairs: list[Moved] = []
    for kind in dict.fromkeys(p.kind for p in (*old.special_points, *new.special_points)):
        before, after = old.of_kind(kind), new.of_kind(kind)
        apart = np.array([[sum(((a[n] - b[n]) / spans[n]) ** 2 for n in names) for b in after] for a in before])
        rows, columns = linear_sum_assignment(np.sqrt(apart)) if apart.size else ((), ())
        pairs += [Moved(before[i], after[j]) for i, j in zip(rows, columns, strict=True)]
        pairs += [Moved(p, None) for i, p in enumerate(before) if i not in set(rows)]
        pairs += [Moved(None, p) for j, p in enumerate(after) if j not in set(columns)]
    return tuple(pairs)


def _told(c: Compared) -> list[str]:
    """Return what changed along a curve: its points, margins, stability, ends."""
    lines = [_move(m, c) for m in c.points] or ["no special points in either"]
    if c.old.rated:
        lines += _differs("margin", c, _margin) + _differs("stability", c, _stability)
    return lines + _differs("end", c, lambda b: b.message)


def _move(moved: Moved, c: Compared) -> str:
    old, new = moved.old, moved.new
    if old is None or new is None:
        there = new if old is None else old
        assert there is not None
        where = ", ".join(f"{n} = {show(there[n], c.old.unit(n))}" for n in c.old.free)
        return f"{there.label} {'appeared' if old is None else 'vanished'}: {where}"
    name = old.label if old.label == new.label else f"{old.label} (now {new.label})"
    parts = []
    for n in c.old.free:
        unit, change = c.old.unit(n), new[n] - old[n]
        size = max(abs(old[n]), abs(new[n]))
        if abs(change) <= _SAME * size:
            parts.append(f"{n} = {show(old[n], unit)} as before")
            continue
        share = f" ({100.0 * change / abs(old[n]):+.3g} %)" if old[n] else ""
        by = show(abs(change), unit, 4)
        parts.append(f"{n} {show(old[n], unit)} -> {show(new[n], unit)}, {'+' if change > 0 else '-'}{by}{share}")
    return f"{name}: {'; '.join(parts)}"


def _margin(branch: Branch) -> str:
    """Return how far the parameter may change from the start to the nearest fold, either way."""
    name = next(iter(branch.free))
    here, unit = float(branch[name][branch.start_index]), branch.unit(name)
    folds = sorted((p[name] - here for p in branch.of_kind("LP")), key=abs)
    if not folds:
        return "no fold"
    return f"{show(abs(folds[0]), unit, 5)} from {name} = {show(here, unit, 5)} to the nearest fold"


def _stability(branch: Branch) -> str:
    words = [str(w) for i, w in enumerate(branch.stability) if branch.labels[i] == "" and w != "marginal"]
    return ", ".join(w for i, w in enumerate(words) if i == 0 or words[i - 1] != w) or "marginal"


def _differs(what: str, c: Compared, of: Callable[[Branch], str]) -> list[str]:
    old, new = of(c.old), of(c.new)
    return [f"{what}: {old}" + ("" if old == new else f" -> {new}")]
