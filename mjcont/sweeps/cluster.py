"""Crews of a sweep: processes here, an executor that is given, or a Dask cluster."""

from __future__ import annotations

import os
from concurrent.futures import Executor
from typing import Any

from mjcont.errors import MjcontError
from mjcont.sweeps.engine import Crew, Inline, LocalCrew

_PATIENCE = 30  # seconds for a cluster to answer


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def make_crew(executor: Executor | None, scheduler: str | None, workers: int | None) -> Crew:
    """Return who computes: an executor, the workers of a Dask scheduler, or processes on this machine.

    Raises
    ------
    MjcontError
        If more than one is named, the number is not positive, or the cluster does not answer.
    """
    if workers is not None and workers < 1:
        raise MjcontError(f"workers must be a whole number from 1 on, got {workers}")
    if executor is not None and scheduler is not None:
        raise MjcontError("give an executor or the address of a scheduler, not both")
    if scheduler is not None:
        return DaskCrew(scheduler)
    if executor is None:
        count = workers or processors()
        return Crew(Inline(), lambda: 1) if count == 1 else LocalCrew(count)
    client = getattr(executor, "_client", None)
    if client is not None and hasattr(client, "nthreads"):  # Dask's: follow its number of workers
        return Crew(executor, lambda: sum(client.nthreads().values()))
    slots = workers or int(getattr(executor, "_max_workers", processors()))
    return Crew(executor, lambda: slots)


class DaskCrew(Crew):
    """The workers of a Dask scheduler, as many as there are at the time: with none, tasks wait for the first."""

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError as error:
            raise MjcontError("a sweep on a cluster needs distributed: pip install 'mjcont[cluster]'") from error
        try:
            self._client: Any = Client(address, timeout=_PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise MjcontError(f"no Dask scheduler answers at '{address}': {error}") from error
        super().__init__(self._client.get_executor(pure=False), lambda: sum(self._client.nthreads().values()))

    def close(self) -> None:
        """Take back what is not done, and leave the cluster."""
        self.executor.shutdown(wait=False)
        self._client.close()
