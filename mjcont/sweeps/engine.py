"""Computing the cases of a sweep on any `concurrent.futures.Executor`, with what to do when workers die.

Cases form a tree: one is computed when its parent has been. Tasks of several cases go to whoever is free; what a case
gives does not depend on the task it is in, so neither on the order in which workers finish.
"""

from __future__ import annotations

import heapq
import math
import multiprocessing
import signal
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from typing import Any

from mjcont.errors import MjcontError
from mjcont.outside.processes import end_with_parent, starting
from mjcont.sweeps.jobs import NOMINAL, Item, run_items

# cases in a task, at most: more than a few where they are quick, as many as take so many seconds
_TASK, _QUICK, _LONG = 16, 64, 2.0
_DEATHS = 2
# seconds that the thread of a pool has to see its processes end
_PATIENCE = 5.0


class Inline(Executor):
    """Runs in this process, at once."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Run and return what is done."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Crew:
    """Who computes: an executor, how many tasks it can run at a time, and whether it can be made anew."""

    renewable = False

    def __init__(self, executor: Executor, slots: Callable[[], int]) -> None:
        self.executor, self.slots = executor, slots

    def renew(self) -> None:
        """Replace an executor that is broken."""

    def close(self) -> None:
        """Leave an executor that was given as it is."""


class _Pool(ProcessPoolExecutor):
    """A pool whose processes, which it starts when there are tasks, start as `processes` has it."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Take a task."""
        with starting():
            return super().submit(fn, *args, **kwargs)


class LocalCrew(Crew):
    """Processes on this machine, one thread each, that end when this one does."""

    renewable = True

    def __init__(self, workers: int) -> None:
        self._workers = workers
        super().__init__(self._pool(), lambda: workers)

    def _pool(self) -> Executor:
        context = multiprocessing.get_context("spawn")
        # an interrupt is for the one that hands out the tasks
        return _Pool(self._workers, context, initializer=end_with_parent, initargs=(signal.SIG_IGN,))

    def renew(self) -> None:
        """Start new processes."""
        self.close()
        self.executor = self._pool()

    def close(self) -> None:
        """Stop the processes without waiting for what they compute."""
        running = list((getattr(self.executor, "_processes", None) or {}).values())
        manager = getattr(self.executor, "_executor_manager_thread", None)
        self.executor.shutdown(wait=False, cancel_futures=True)
        for process in running:  # Python itself would wait for them at its end
            process.terminate()
        if manager is not None:  # it must not close what Python's end still writes to
            manager.join(_PATIENCE)


class Tree:
    """Which cases may be computed now: those whose parents are done, the one with the longest chain behind it first."""

    def __init__(self, parents: Sequence[int], heights: Sequence[int], done: Mapping[int, Any]) -> None:
        self.parents, self.heights = parents, heights
        self.children: dict[int, list[int]] = {}
        for i, parent in enumerate(parents):
            self.children.setdefault(parent, []).append(i)
        self._ready: list[tuple[int, int]] = []
        self.left = len(parents) - len(done)
        for i, parent in enumerate(parents):
            if i not in done and (parent == NOMINAL or parent in done):
                self.offer(i)

    def offer(self, case: int) -> None:
        """Take a case as ready."""
        heapq.heappush(self._ready, (-self.heights[case], case))

    def completed(self, case: int, known: Callable[[int], bool]) -> None:
        """Offer the children of a case that is done, but for those known: done, or on their way."""
        for child in self.children.get(case, ()):
            if not known(child):
                self.offer(child)

    def take(self, slots: int, most: int) -> list[int]:
        """Return the cases of a task, each after its parent: a share of those ready, then what hangs on them."""
        size = max(1, min(most, math.ceil(self.left / (4 * slots))))
        share = min(size, math.ceil(len(self._ready) / (2 * slots)))
        task = [heapq.heappop(self._ready)[1] for _ in range(share)]
        front = deque(task)
        while front and len(task) < size:
            for child in self.children.get(front.popleft(), ())[: size - len(task)]:
                task.append(child)
                front.append(child)
        self.left -= len(task)
        return task

    def __bool__(self) -> bool:
        """Whether a case is ready."""
        return bool(self._ready)


class Run:
    """A sweep on its way: what is ready, in flight, lost with its worker, and done."""

    def __init__(
        self, job: str, values: Sequence[Sequence[float]], tree: Tree, done: Mapping[int, Mapping[str, Any]],
        crew: Crew, store: Callable[[Sequence[Mapping[str, Any]]], None],
    ) -> None:
        self.job, self.values, self.tree, self.done, self.crew, self.store = job, values, tree, done, crew, store
        self.flying: dict[Future[Any], list[int]] = {}
        self.suspects: deque[int] = deque()
        self.deaths: dict[int, int] = {}
        self._seconds = 0.0
        self._timed = 0

    def go(self) -> None:
        """Compute every case that is not done."""
        while self.tree or self.flying or self.suspects:
            if self.suspects:
                self._alone()
            else:
                slots = max(1, self.crew.slots())
                while self.tree and len(self.flying) < 2 * slots:
                    self._submit(self.tree.take(slots, self._most()))
            finished, _ = wait(self.flying, return_when=FIRST_COMPLETED)
            self._collect(finished)

    def _most(self) -> int:
        """Return how many cases a task may have, by what those that are done took."""
        quick = int(min(_LONG * self._timed / self._seconds, _QUICK)) if self._seconds else 0
        return max(_TASK, quick)

    def _alone(self) -> None:
        """Let nothing but the next suspect be in flight, so that a death is its own."""
        if not self.flying:
            self._submit([self.suspects[0]])

    def _submit(self, cases: Sequence[int]) -> None:
        inside = set(cases)
        items = []
        for case in cases:
            parent = int(self.tree.parents[case])
            known = None if parent == NOMINAL or parent in inside else self.done[parent]["points"]
            items.append(Item(case, tuple(map(float, self.values[case])), parent, known))
        try:
            future = self.crew.executor.submit(run_items, self.job, items)
        except (BrokenExecutor, RuntimeError) as error:
            future = Future()
            future.set_exception(error if isinstance(error, BrokenExecutor) else BrokenExecutor(str(error)))
        self.flying[future] = list(cases)

    def _collect(self, finished: set[Future[Any]]) -> None:
        broken = False
        while finished:
            for future in finished:
                broken = self._result(future) or broken
            # a pool's other tasks fail with it, but for those that are done
            finished = wait(self.flying).done if broken else set()
        if broken:
            self.crew.renew()

    def _result(self, future: Future[Any]) -> bool:
        """Keep what a task gave, or mark its cases as lost; whether the executor is broken."""
        cases = self.flying.pop(future)
        try:
            records = future.result()
        except (BrokenExecutor, CancelledError) as error:
            self._lost(cases, error)
            return True
        except Exception as error:
            if type(error).__name__ != "KilledWorker":  # what Dask says when several workers died of a task
                raise self._cannot(error) from error
            self._lost(cases, error)
        else:
            self._keep(records, set(cases))
        return False

    def _keep(self, records: Sequence[Mapping[str, Any]], cases: set[int]) -> None:
        self.store(records)
        self._seconds += sum(r.get("seconds", 0.0) for r in records)
        self._timed += len(records)
        if self.suspects and cases == {self.suspects[0]}:
            self.suspects.popleft()
        suspects = set(self.suspects)
        for case in cases:
            self.tree.completed(case, lambda child: child in self.done or child in suspects)

    def _lost(self, cases: Sequence[int], error: BaseException) -> None:
        if not self.crew.renewable and isinstance(error, BrokenExecutor | CancelledError):
            raise self._cannot(error) from error
        if list(cases) != list(self.suspects)[:1]:
            self.suspects.extend(cases)
            return
        (case,) = cases
        self.deaths[case] = self.deaths.get(case, 0) + 1
        if self.deaths[case] >= _DEATHS:
            sentence = f"its worker died {_DEATHS} times while it was computed alone"
            empty = {"from": NOMINAL, "status": "failed", "message": sentence, "values": {}, "points": {}}
            self._keep([{"case": case, **empty, "evaluations": 0, "seconds": 0.0}], {case})

    def _cannot(self, error: BaseException) -> MjcontError:
        what = " ".join(f"{type(error).__name__}: {error}".split())
        return MjcontError(
            f"the workers are lost ({what}); {len(self.done)} cases are stored: run the same sweep again"
        )
