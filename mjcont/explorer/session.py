"""A session at the explorer: its state is a study, whose text reproduces what was clicked.

Every click appends a table, which the study's own checks and runner take; undo drops the last. What is shown and
selected is the browser's alone.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any

from mjcont.errors import BoundsError, MjcontError, ParameterError, StudyError
from mjcont.explorer.clicks import TABLES, table_of
from mjcont.explorer.hearing import Hearing, Tell
from mjcont.explorer.opening import Opened, first_table, told_model
from mjcont.mechanism.mechanism import Mechanism
from mjcont.results.branch import Diagram
from mjcont.results.model import check_bounds
from mjcont.studies.plans import Study, check_data
from mjcont.studies.runs import interrupted
from mjcont.studies.schema import toml_text
from mjcont.studies.study import named, run_plan
from mjcont.studies.tables import KINDS

FILE = "study.toml"
_ORDER = tuple(kind.table for kind in KINDS.values())
_HEADER = "# What was looked at in mjcont's explorer: `mjcont run study.toml` computes it again.\n"
Results = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Moment:
    """What a session holds between two clicks.

    Attributes
    ----------
    tables : the study's, as TOML has them.
    common : the values for all results in them.
    results : by name; branches of a diagram D are D_1, D_2, ...
    parents : on which curve each result began, by name.
    click : what the last click did, in words; empty at the beginning.
    notes : sentences on what the last click left out.
    """

    tables: Mapping[str, Any]
    common: Mapping[str, float] = field(default_factory=dict)
    results: Mapping[str, Any] = field(default_factory=dict)
    parents: Mapping[str, str] = field(default_factory=dict)
    click: str = ""
    notes: tuple[str, ...] = ()


class Session:
    """A study that grows by clicks.

    Parameters
    ----------
    opened : what it begins with.
    tell : hears events: those of `Hearing`, and `state`.
    stop : set to stop what is computed; points so far are kept.
    between : called now and then while something is computed.

    Raises
    ------
    StudyError
        If what it begins with is no study; the message is its first problem.
    """

    def __init__(
        self, opened: Opened, tell: Tell, stop: threading.Event | None = None,
        between: Callable[[], None] = lambda: None,
    ) -> None:
        self._tell, self._between, self.stop = tell, between, stop or threading.Event()
        self._past: list[Moment] = []
        self._warned: set[str] = set()
        self._opened: Opened | None = opened
        self.running = ""
        with self._heeding() as notes:
            self.mechanism, common = self._begun_with(opened)
        results = dict(opened.results)
        said = dict.fromkeys((*self.mechanism.notes, *opened.notes, *notes))
        self.now = Moment(dict(opened.tables), common, results, notes=tuple(said))
        self._given = {n: r for n, r in results.items() if n not in self.names()}

    def _begun_with(self, opened: Opened) -> tuple[Mechanism, dict[str, float]]:
        """Return the model, and the values for all results."""
        if opened.mechanism is not None:
            return opened.mechanism, dict(opened.tables.get("parameters", {}))
        study = self._checked(opened.tables)
        return study.mechanism, dict(study.common)

    # -- clicks ------------------------------------------------------------------------------------------------

    def begin(self, computed: Callable[[Results], None] = lambda results: None) -> None:
        """Compute what the study asks for already, or find a first branch of a model; once.

        Parameters
        ----------
        computed : called with results by name, as soon as they are there.
        """
        opened, self._opened = self._opened, None
        if opened is None:
            return
        self.stop.clear()
        said = self.now.notes
        if not opened.computes:
            pass
        elif opened.mechanism is None:
            with self._busy("the study"):
                self.now = self._recomputed(self.now, computed)
        else:
            with self._busy("looking for a parameter that moves it"):
                table = first_table(opened.mechanism)
            if table is None:
                self.now = replace(self.now, notes=("nothing was found that moves it: choose a parameter and a start",))
            else:
                computed(self.add("branch", table))
                self._past.clear()
        self.now = replace(self.now, notes=tuple(dict.fromkeys((*said, *self.now.notes))))
        self.tell_state()

    def add(self, table: str, args: Mapping[str, Any]) -> Results:
        """Append a table to the study, compute it, and return its results by name.

        Parameters
        ----------
        table, args : as `table_of` takes them.

        Raises
        ------
        MjcontError
            If the study's checks refuse the table, or its result cannot be computed; the study is what it was.
        """
        now = self.now
        self.stop.clear()
        keys = table_of(table, args, now.results, self.mechanism, now.common, self._given)
        made = {"name": self._free_name(table), **keys}
        tables = {**now.tables, table: [*now.tables.get(table, []), made]}
        with self._heeding() as notes, self._busy(made["name"]):
            study = self._checked(tables)
            plan = next(p for p in study.plans if p.name == made["name"])
            result = run_plan(study, plan, now.results, self._hearing())
        found = named(plan, result)
        if interrupted(result):
            notes.append(f"{plan.name} was stopped: its points so far are kept, and the study computes it whole")
        parent = _parent(made, args)
        parents = {**now.parents, **({n: parent for n in found} if parent else {})}
        self._past.append(now)
        self.now = Moment(tables, now.common, {**now.results, **found}, parents, plan.name, tuple(notes))
        self.tell_state()
        return curves(found)

    def set(self, name: str, value: float) -> None:
        """Give a parameter another value for all results, and compute them anew; what is lost by that is left out.

        Raises
        ------
        MjcontError
            If there is no such parameter, it cannot have that value, or the user stopped; all is what it was.
        """
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ParameterError(f"the value of {name} must be a number, got {value!r}")
        low, high = check_bounds(self.mechanism, name, None)
        if not low <= value <= high:
            raise BoundsError(f"{name} = {value} lies outside its range {low:g} .. {high:g}")
        if not self.names():
            raise MjcontError("there is nothing to compute anew: follow a branch first")
        self.stop.clear()
        before, click = self.now, f"{name} = {value:g}"
        tables = {**before.tables, "parameters": {**before.tables.get("parameters", {}), name: float(value)}}
        common = {**before.common, name: float(value)}
        with self._busy(click):
            after = self._recomputed(replace(before, tables=tables, common=common, click=click))
        if not (self._past and before.click.startswith(f"{name} = ")):  # a slider that goes on is one click
            self._past.append(before)
        self.now = after
        self.tell_state()

    def undo(self) -> None:
        """Drop the last click.

        Raises
        ------
        MjcontError
            If there is none.
        """
        if not self._past:
            raise MjcontError("there is nothing to undo")
        self.now = self._past.pop()
        self.tell_state()

    def portable(self) -> tuple[str, dict[str, str]]:
        """Return the study as a text for another machine, and the files that it names; empty where that cannot be."""
        told = told_model(self.mechanism)
        return ("", {}) if told is None else (self.toml(told[0]), told[1])

    def toml(self, model: str = "") -> str:
        """Return the study as the text of its file; `model` is what it calls its model, default as it began."""
        tables = {**self.now.tables, **({"model": model} if model else {})}
        stopped = (n for n, result in self.now.results.items() if interrupted(result))
        return _HEADER + "".join(f"# {n} was stopped; here it is computed whole.\n" for n in stopped) + "\n" + (
            toml_text(tables))

    def tell_state(self) -> None:
        """Tell what there is to click: whether something runs, what undo would drop, the study's tables."""
        self._tell({
            "event": "state", "running": self.running, "can_undo": bool(self._past),
            "undo": self.now.click if self._past else "", "tables": self.names(), "notes": list(self.now.notes),
        })

    # -- the study ---------------------------------------------------------------------------------------------

    def names(self) -> list[str]:
        """Return the names of the study's tables: what a further one can refer to."""
        return [t["name"] for key in _ORDER for t in self.now.tables.get(key, [])]

    def _free_name(self, table: str) -> str:
        """Return a name that the study has not yet: equilibria, equilibria_2, ...; locus_1, locus_2, ..."""
        stem, taken = TABLES.get(table, table), {n.casefold() for n in [*self.names(), *self.now.results]}
        numbers = (f"{stem}_{i}" for i in range(2 if table == "branch" else 1, len(taken) + 3))
        return next(n for n in ([stem] if table == "branch" else []) + [*numbers] if n not in taken)

    def _checked(self, tables: Mapping[str, Any]) -> Study:
        """Return tables as a checked study."""
        study, problems = check_data(tables, FILE)
        if study is None:
            raise StudyError(_plain(problems[0]))
        return study

    @contextmanager
    def _heeding(self) -> Iterator[list[str]]:
        """Collect what is warned of inside, but what was said before."""
        notes: list[str] = []
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            yield notes
        notes += [w for w in dict.fromkeys(str(w.message) for w in caught) if w not in self._warned]
        self._warned.update(notes)

    def _recomputed(self, moment: Moment, computed: Callable[[Results], None] | None = None) -> Moment:
        """Return a moment with its tables' results computed; what cannot be computed is left out, with a note.

        Without `computed` a stop is an error; with it, it keeps what there is.
        """
        with self._heeding() as notes:
            study = self._checked(moment.tables)
        done: Results = dict(self._given)
        lost: dict[str, str] = {}
        for plan in study.plans:
            try:
                with self._heeding() as more, self._busy(plan.name):
                    result = run_plan(study, plan, done, self._hearing())
            except MjcontError as error:
                if self.stop.is_set():
                    raise
                lost[plan.name] = str(error)
                continue
            notes += more
            found = named(plan, result)
            done |= found
            if computed is not None:
                computed(curves(found))
            if interrupted(result) or self.stop.is_set():
                if computed is None:
                    raise MjcontError("stopped")
                break
        tables = {key: [t for t in value if t["name"] not in lost] if key in _ORDER else value
                  for key, value in moment.tables.items()}
        return replace(moment, tables={k: v for k, v in tables.items() if v != []}, results=done,
                       notes=(*notes, *(f"left out: {why}" for why in lost.values())))

    def _hearing(self) -> Hearing:
        return Hearing(self.mechanism, self._tell, self.stop, self._between)

    @contextmanager
    def _busy(self, what: str) -> Iterator[None]:
        """Tell that something runs, and let errors speak of the table instead of a file that is none."""
        before, self.running = self.running, what
        self.tell_state()
        try:
            yield
        except KeyboardInterrupt as error:
            raise MjcontError("stopped") from error
        except MjcontError as error:
            raise type(error)(_plain(str(error))) from error
        finally:
            self.running = before
            self.tell_state()


def curves(results: Mapping[str, Any]) -> Results:
    """Return results but diagrams, which are their branches."""
    return {n: r for n, r in results.items() if not isinstance(r, Diagram)}


def _plain(message: str) -> str:
    """Return a study's message without its file."""
    return message.replace(f"study '{FILE}': ", "", 1).replace(f"{FILE}: ", "", 1)


def _parent(made: Mapping[str, Any], args: Mapping[str, Any]) -> str:
    """Return the curve on which a table's result begins."""
    row = args.get("row")
    if isinstance(row, Mapping):
        return str(row["curve"])
    given = next((made[key] for key in ("point", "from", "branch") if key in made), "")
    first = given[0] if isinstance(given, list) and given else given
    return str(first).partition(":")[0]
