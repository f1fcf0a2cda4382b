"""The process in which a session computes, and the way there: messages in, answers and events out, JSON texts both.

A request is `{id, op, args}`, an answer `{id, result}` or `{id, error: {message}}`, an event `{event, ...}`. A process
of its own keeps the server, or a notebook's kernel, free while it computes; it ends with whoever started it.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from mjcont.outside.processes import end_with_parent, starting

# to whom a message is: everybody's are events, the owner's is the study as it stands, for a worker that comes after
EVERYBODY, OWNER = -1, -2
Hear = Callable[[int, str], None]
LARGEST_MESSAGE = 2**20
_JOIN_SECONDS = 2.0


class Worker:
    """A process that holds a session.

    Parameters
    ----------
    source : what it opens (see `opening`).
    hear : called with each message and to whom it is, from a thread of its own.
    study : the text of a study to go on with.
    """

    def __init__(self, source: str, hear: Hear, study: str = "") -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_work, args=(theirs, source, study), daemon=True)
        with starting():
            self._process.start()
        theirs.close()
        self._hear = hear
        self._over, self._gone = threading.Event(), threading.Event()
        threading.Thread(target=self._listen, daemon=True).start()

    @property
    def pid(self) -> int:
        """The number of the process."""
        return int(self._process.pid or 0)

    @property
    def alive(self) -> bool:
        """Whether it can still answer."""
        return not self._gone.is_set()

    def send(self, client: int, text: str) -> None:
        """Hand a client's request over; its answer is heard."""
        with suppress(OSError):  # it ended: that was told
            self._pipe.send((client, text))

    def end(self) -> None:
        """End the process, whatever it is busy with."""
        self._over.set()
        self._process.kill()
        self._process.join(_JOIN_SECONDS)

    def _listen(self) -> None:
        while True:
            try:
                client, text = self._pipe.recv()
            except (EOFError, OSError):
                break
            if not self._over.is_set():
                self._hear(client, text)
        self._gone.set()
        if not self._over.is_set():
            self._hear(EVERYBODY, json.dumps({"event": "ended", "message": "the process that computes has ended"}))


def _work(pipe: Connection, source: str, study: str) -> None:
    """Serve one session until nobody asks any more."""
    end_with_parent(signal.SIG_IGN)  # an interrupt is for whoever started this, who ends it then
    waiting = Waiting()
    threading.Thread(target=_receive, args=(pipe, waiting), daemon=True).start()
    writing = threading.Lock()

    def send(client: int, message: dict[str, Any] | str) -> None:
        text = message if isinstance(message, str) else json.dumps(message, allow_nan=False, separators=(",", ":"))
        try:
            with writing:
                pipe.send((client, text))
        except OSError:
            os._exit(0)

    from mjcont.explorer.desk import Desk

    desk = Desk.opened(source, study, send, waiting)
    while desk is not None:
        desk.answer(*waiting.take())


class Waiting:
    """Requests that wait, in order; that to stop does not."""

    def __init__(self) -> None:
        self.stop = threading.Event()
        self.running = False
        self._there = threading.Condition()
        self._requests: deque[tuple[int, dict[str, Any]]] = deque()

    def put(self, client: int, request: dict[str, Any]) -> None:
        """Add a request; one to stop takes effect at once where something runs."""
        with self._there:
            if request.get("op") == "cancel" and self.running:
                self.stop.set()
            self._requests.append((client, request))
            self._there.notify()

    def take(self) -> tuple[int, dict[str, Any]]:
        """Return the next request, once there is one."""
        with self._there:
            self._there.wait_for(lambda: bool(self._requests))
            return self._requests.popleft()

    def take_one_of(self, ops: frozenset[str]) -> tuple[int, dict[str, Any]] | None:
        """Return the first request of those named, None where none waits."""
        with self._there:
            for i, (client, request) in enumerate(self._requests):
                if request.get("op") in ops:
                    del self._requests[i]
                    return client, request
        return None


def _receive(pipe: Connection, waiting: Waiting) -> None:
    while True:
        try:
            client, text = pipe.recv()
        except (EOFError, OSError):
            os._exit(0)
        waiting.put(client, read_request(text))


def read_request(text: str) -> dict[str, Any]:
    """Return a request as plain data: `id`, `op`, `args`; or why it is none, under `refused`.

    Numbers that JSON does not have are refused.
    """

    def never(name: str) -> float:
        raise ValueError(f"{name} is no number that JSON has")

    try:
        found = json.loads(text, parse_constant=never)
    except (ValueError, RecursionError) as error:
        return {"id": None, "refused": f"this is no JSON: {error}"}
    if not isinstance(found, dict) or not isinstance(found.get("id"), int | str):
        return {"id": None, "refused": "a request is an object with id, op and args"}
    if not isinstance(found.get("op"), str) or not isinstance(found.get("args", {}), dict):
        return {"id": found["id"], "refused": "a request has an op, a string, and args, an object"}
    return {"id": found["id"], "op": found["op"], "args": found.get("args", {})}
