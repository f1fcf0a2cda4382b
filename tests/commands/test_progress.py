"""Long work on a terminal: what it does, how far, how long still; in one line that is wiped, and in a pipe nothing."""

import io
import math
import time
from collections.abc import Callable

import pytest

from mjcont.commands.progress import Gauge, spoken, time_left
from mjcont.commands.told import Told
from mjcont.curves.collect import Found
from mjcont.outside.terminal import Live
from mjcont.studies.reporter import Range


class Clock:
    """A time that passes when it is told to."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def until(done: Callable[[], bool]) -> None:
    """Wait for what a thread does."""
    deadline = time.monotonic() + 60.0
    while not done():
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.2, "0 s"), (99.4, "99 s"), (100.0, "2 min"), (3600.0, "60 min"), (9000.0, "2 h 30 min")]
)
def test_times_are_said_as_people_say_them(seconds: float, words: str) -> None:
    assert spoken(seconds) == words


def test_what_is_left_is_as_long_as_what_was_done() -> None:
    assert time_left(0.25, 10.0) == ", about 30 s left"


def test_what_was_there_before_took_no_time() -> None:
    assert time_left(0.75, 10.0, before=0.5) == ", about 10 s left"


@pytest.mark.parametrize("share", [math.nan, 0.0, 1.0])
def test_nobody_guesses_from_nothing(share: float) -> None:
    assert time_left(share, 60.0) == ""


def test_nobody_guesses_at_once() -> None:
    assert time_left(0.5, 1.0) == ""


def test_the_line_says_what_how_far_and_how_long_still() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    gauge.begin("sweep")
    gauge.count(10, 40, " cases")
    clock.now = 30.0
    gauge.count(20, 40, " cases", ", 1 failed")
    assert gauge.line() == "sweep: 20 of 40 cases, 1 failed, 30 s, about 60 s left"


def test_what_is_first_told_late_was_done_since_the_beginning() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    gauge.begin("map")
    clock.now = 10.0
    gauge.count(1, 4)
    assert gauge.line() == "map: 1 of 4, 10 s, about 30 s left"


def test_a_share_that_falls_is_one_of_other_work() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    gauge.begin("motion")
    gauge.tell("", 0.0)
    clock.now = 10.0
    gauge.tell("", 1.0)
    gauge.tell("", 0.0)
    clock.now = 15.0
    gauge.tell("", 0.25)
    assert gauge.line() == "motion: 15 s, about 15 s left"


def test_what_is_over_at_once_says_nothing() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    gauge.begin("sweep")
    clock.now = 0.5
    assert gauge.line() == ""


def test_a_curve_says_where_it_is_what_it_found_and_how_long_it_may_take() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    told = Told(gauge)
    told.started("equilibria", "a task", (2, 3), {"F": Range(-50.0, 50.0, "N")})
    told.point(1, Found("", {"F": 50.0}, {}))
    clock.now = 10.0
    told.point(7, Found("LP", {"F": 30.0}, {}))
    told.point(8, Found("", {"F": 30.0}, {}))
    assert gauge.line() == "equilibria (result 2 of 3): 8 points, F = 30 N, 1 LP, 10 s, about 40 s left"


def test_angles_are_told_in_degrees() -> None:
    clock = Clock()
    gauge = Gauge(clock=clock)
    told = Told(gauge)
    told.started("turn", "a task", (1, 1), {"a": Range(0.0, math.pi, "rad")})
    clock.now = 1.0
    told.point(3, Found("", {"a": math.pi / 2}, {}))
    assert gauge.line() == "turn: 3 points, a = 90 deg, 1 s"


def test_a_terminal_has_one_line_that_is_wiped_at_the_end() -> None:
    stream, clock = io.StringIO(), Clock()
    with Gauge(stream, clock) as gauge:
        gauge.begin("work")
        clock.now = 5.0
        until(lambda: "work: 5 s" in stream.getvalue())
    assert stream.getvalue().endswith("\r\x1b[K")
    assert "\n" not in stream.getvalue()


def test_others_write_where_the_line_was_wiped() -> None:
    stream, clock = io.StringIO(), Clock()
    with Gauge(stream, clock) as gauge:
        gauge.begin("work")
        clock.now = 5.0
        with gauge.aside():
            stream.write("figure 3\n")
        written = stream.getvalue()
        assert written.endswith("\r\x1b[Kfigure 3\n")
        until(lambda: stream.getvalue() != written)  # the line comes back


def test_a_line_is_no_longer_than_the_terminal_is_wide(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "20")
    stream = io.StringIO()
    Live(stream).show("x" * 100)
    assert stream.getvalue() == "\r\x1b[K" + "x" * 19
