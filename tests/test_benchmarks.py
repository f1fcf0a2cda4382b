"""The benchmarks' book: rows as they come, failures as rows, nothing lost."""

from __future__ import annotations

import json
import os
import re
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mjcont as mc

sys.path.insert(0, str(Path(__file__).parent.parent))
from benchmarks import auto_peer, cases, compiled, run  # noqa: E402
from benchmarks.book import Book, Job, Missing  # noqa: E402
from benchmarks.layout import DIAGRAM, ORBITS, POINTS, Table  # noqa: E402
from benchmarks.measure import medians  # noqa: E402


class Plain:
    """A layout of names and values."""

    def head(self, section: str) -> Sequence[str]:
        return [section]

    def row(self, section: str, name: str, row: Any) -> Sequence[str]:
        return [f"{name} {row}"]


@pytest.fixture
def book(tmp_path: Path) -> Book:
    return Book(tmp_path / "out" / "bench.json", {}, Plain())


def fails(tell: object) -> float:
    raise ValueError("no such\nfigure")


def interrupted(tell: object) -> float:
    os.kill(os.getpid(), signal.SIGINT)
    raise AssertionError


def written(book: Book) -> dict[str, Any]:
    return dict(json.loads(book.path.read_text()))


def test_a_job_that_fails_is_a_row_and_the_rest_goes_on(book: Book, capsys: pytest.CaptureFixture[str]) -> None:
    book.run([Job("s", "a", lambda tell: 1.0), Job("s", "b", fails), Job("t", "c", lambda tell: 2.0)])
    assert written(book) == {"s": {"a": 1.0, "b": {"failed": "ValueError: no such figure"}}, "t": {"c": 2.0}}
    assert book.broken == ["s: b"]
    lines = [line for line in capsys.readouterr().out.split("\n") if line]
    assert lines == ["s", "a 1.0", "b: not measured: ValueError: no such figure", "t", "c 2.0"]


def test_each_row_is_written_before_the_next_is_measured(book: Book) -> None:
    seen: list[Any] = []
    book.run([Job("s", "a", lambda tell: 1.0), Job("s", "b", lambda tell: seen.append(written(book)) or 2.0)])
    assert seen == [{"s": {"a": 1.0}}]


def test_it_says_what_is_measured_and_how_far_it_is(book: Book, capsys: pytest.CaptureFixture[str]) -> None:
    book.run([Job("s", "a", lambda tell: 1.0), Job("s", "b", lambda tell: 2.0)])
    first, second = capsys.readouterr().err.splitlines()
    assert re.fullmatch(r"\[1/2, \d+ s\] s: a", first)
    assert re.fullmatch(r"\[2/2, \d+ s\] s: b", second)


def test_an_interrupt_keeps_the_rows_before_it(book: Book) -> None:
    with pytest.raises(KeyboardInterrupt):
        book.run([Job("s", "a", lambda tell: 1.0), Job("s", "b", interrupted), Job("s", "c", lambda tell: 3.0)])
    assert written(book) == {"s": {"a": 1.0}}


def test_an_interrupt_that_a_continuation_takes_for_itself_ends_the_benchmarks_all_the_same(book: Book) -> None:
    calls: list[int] = []

    def field(u: Any, p: Any) -> Any:
        calls.append(0)
        if len(calls) == 100:
            os.kill(os.getpid(), signal.SIGINT)
        return p["a"] - u

    def branch(tell: object) -> int:
        found = mc.continue_equilibria(mc.VectorField(field, [0.0], {"a": 0.0}), "a", bounds=(-1, 1))
        assert found.status == "interrupted"
        return len(found)

    with pytest.raises(KeyboardInterrupt):
        book.run([Job("s", "a", lambda tell: 1.0), Job("s", "part", branch)])
    assert written(book) == {"s": {"a": 1.0}}


def test_a_peer_that_is_not_there_is_a_row_but_no_failure(monkeypatch, tmp_path: Path, capsys) -> None:
    monkeypatch.setattr(auto_peer, "missing", lambda: "AUTO-07p is not installed")
    book = Book(tmp_path / "bench.json", {}, Table())
    diagrams = [job for job in run.plan(True, 1) if job.section == DIAGRAM]
    book.run(diagrams)
    assert len(diagrams) == 6
    assert all(row == {"missing": "AUTO-07p is not installed"} for row in written(book)[DIAGRAM].values())
    assert not book.broken
    assert "overcentre, 3e-06: not measured: AUTO-07p is not installed" in capsys.readouterr().out


@pytest.mark.skipif(compiled.missing() is not None, reason="no compiler")
def test_the_compiled_reaction_is_the_one_in_python() -> None:
    alone, together = (cases.reaction(kind).problem for kind in ("", "compiled"))
    states, heats = np.array([[0.1, 0.2], [0.4, 1.4], [0.9, 3.0]]), np.array([0.0, 0.2, 0.4])
    for problem in (alone, together):
        found = problem.residuals_along(states, problem.values(), {"D": heats})
        assert found == pytest.approx(np.array([[-0.1, -0.8], *rates(states[1:], heats[1:])]), rel=1e-14)


def rates(states: Any, heats: Any) -> Any:
    """Return f of `ab` as it is written in the books, with B = 14 and a cooling of 3."""
    u, v = states.T
    return np.array([-u + heats * (1.0 - u) * np.exp(v), -v + 14.0 * heats * (1.0 - u) * np.exp(v) - 3.0 * v]).T


def test_the_fields_of_the_benchmarks_have_one_curve() -> None:
    kinds = ["", "vectorized", *([] if compiled.missing() else ["compiled"])]
    branches = [cases.reaction(kind).run(chord=1e-4) for kind in kinds]
    hopf = [[p["D"] for p in b.special_points] for b in branches]
    assert all(points == pytest.approx(hopf[0], abs=1e-9) and len(points) == 2 for points in hopf)


def test_a_run_that_fails_leaves_the_figures_of_the_others():
    def broken() -> float:
        raise RuntimeError("it stopped")

    times, failed = medians({"ours": lambda: 2.0, "theirs": broken}, 3)
    assert times == {"ours": 2.0}
    assert failed == {"theirs": "RuntimeError: it stopped"}
    row = {"ours": 2.0, "mjcont": 2.0, "floor": 4.0, "failed": failed}
    first, second = Table().row(POINTS, "case", row)
    assert first.split()[:4] == ["case", "2.0", "4.0", "0.50"]
    assert second.strip() == "theirs not measured: RuntimeError: it stopped"


def test_an_orbits_row_states_times_ratio_and_evaluations():
    row = {"mjcont": 6.0, "AUTO": 12.0, "evaluations": {"mjcont": 2160, "AUTO": 5100.0}}
    (line,) = Table().row(ORBITS, "case", row)
    assert line.split() == ["case", "6.00", "12.00", "0.50", "2160/5100"]


def test_the_quick_plan_is_part_of_the_whole_one():
    quick, whole = ({(j.section, j.name) for j in run.plan(q, 1)} for q in (True, False))
    assert quick < whole


def test_missing_is_told_with_its_reason(book: Book) -> None:
    def absent(tell: object) -> float:
        raise Missing("not here")

    book.run([Job("s", "a", absent)])
    assert written(book) == {"s": {"a": {"missing": "not here"}}}
