"""The explorer as a process of its own, and a page's side of its socket without a browser."""

import json
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from websockets.sync.client import ClientConnection, connect

from problems.commands import child


def until(true: Callable[[], Any], seconds: float = 60.0) -> Any:
    """Wait until something is so, and return it."""
    end = time.monotonic() + seconds
    while not (found := true()):
        assert time.monotonic() < end, "it did not come to be so"
        time.sleep(0.05)
    return found


@contextmanager
def exploring(*argv: object) -> Iterator[tuple[Any, str]]:
    """The command `explore` as a process, and the address that it prints."""
    run = child("explore", *argv, "--no-browser")
    try:
        assert run.stdout is not None and run.stderr is not None
        address = run.stdout.readline().strip()
        assert address.startswith("http://127.0.0.1:"), run.stderr.read()
        yield run, address
    finally:
        run.kill()
        run.wait()
        for stream in (run.stdout, run.stderr):
            stream.close()


def children(pid: int) -> list[int]:
    """The processes that a process has started and that live."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, parent = stat.read_text().rpartition(")")[2].split()[:2]
        except OSError:
            continue
        if int(parent) == pid and state != "Z":
            found.append(int(stat.parent.name))
    return found


def workers(pid: int) -> list[int]:
    """Those among them that hold a session."""
    return [p for p in children(pid) if "spawn_main" in Path(f"/proc/{p}/cmdline").read_text()]


def lives(pid: int) -> bool:
    """Whether a process lives."""
    try:
        os.kill(pid, 0)
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Page:
    """A page's side of the socket."""

    def __init__(self, talk: ClientConnection) -> None:
        self._talk, self._count = talk, 0
        self.events: list[dict[str, Any]] = []

    def ask(self, op: str, **args: Any) -> Any:
        """The answer to a request, what was told meanwhile in `events`."""
        self.send(op, **args)
        while (message := self.hear()).get("id") != self._count:
            pass
        return message.get("result", message.get("error"))

    def send(self, op: str, **args: Any) -> None:
        """Ask, and do not wait."""
        self._count += 1
        self._talk.send(json.dumps({"id": self._count, "op": op, "args": args}))

    def hear(self) -> dict[str, Any]:
        """The next message."""
        message: dict[str, Any] = json.loads(self._talk.recv(timeout=120))
        if "event" in message:
            self.events.append(message)
        return message

    def idle(self) -> None:
        """Wait until a first branch is there."""
        until(lambda: self.hear().get("tables") and not self.events[-1]["running"])


@contextmanager
def page(address: str) -> Iterator[Page]:
    """A page that opens an address."""
    host, _, token = address.partition("/#")
    url = host.replace("http:", "ws:") + "/socket"
    protocols: Any = ["mjcont", f"token.{token}"]
    origin: Any = host
    with connect(url, subprotocols=protocols, origin=origin, max_size=None, max_queue=None, proxy=None) as talk:
        yield Page(talk)
