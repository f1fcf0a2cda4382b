"""Commands as processes of their own: fresh ones, and forked ones, which need not pay for their imports.

A forked one comes from a process that has everything loaded; it runs `python -m mjcont` from its first line on, and
ends as an interpreter does.
"""

from __future__ import annotations

import atexit
import json
import os
import resource
import runpy
import signal
import subprocess
import sys
import time
import warnings
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

LOADED = (
    "faults.reader", "mjcont.commands.cli", "mjcont.commands.sweep", "mjcont.drawing.plotting", "mjcont.studies.runs",
    "mjcont.sweeps.plan", "matplotlib.backends.backend_agg",
)


class Fresh:
    """A process that runs; what it says on stderr goes into a file."""

    def __init__(self, command: Sequence[str], said: Path) -> None:
        with open(said, "wb") as stream:
            self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stream, start_new_session=True)
        self._said, self.pid = said, self._process.pid

    @property
    def returncode(self) -> int:
        """How it ended."""
        return self._process.returncode

    def send_signal(self, number: int) -> None:
        """Send a signal, unless it has ended."""
        self._process.send_signal(number)

    def wait(self, timeout: float) -> str:
        """Wait for its end, and return what it said on stderr."""
        self._process.wait(timeout)
        return self._said.read_text(errors="replace")


class Forked:
    """The same for mjcont with these arguments, forked; no file that it writes may be larger than `limit`."""

    def __init__(self, arguments: Sequence[str], said: Path, limit: int | None = None) -> None:
        self._server, self._said = server(), said
        self.pid: int = self._server.ask({"arguments": list(arguments), "said": str(said), "limit": limit})
        self.returncode: int | None = None

    def send_signal(self, number: int) -> None:
        """Send a signal, unless its end is known already."""
        if self.returncode is None:
            os.kill(self.pid, number)  # it is nobody else's number before it is collected

    def wait(self, timeout: float) -> str:
        """Wait for its end, and return what it said on stderr."""
        until = time.monotonic() + timeout
        while self.returncode is None:
            self.returncode = self._server.ask({"collect": self.pid})
            if self.returncode is None:
                if time.monotonic() > until:
                    raise subprocess.TimeoutExpired("mjcont", timeout)
                time.sleep(0.03)
        return self._said.read_text(errors="replace")


class Server:
    """The process that has everything loaded, seen from here."""

    def __init__(self) -> None:
        here = str(Path(__file__).parent.parent)
        paths = os.pathsep.join([here, os.environ.get("PYTHONPATH", "")])
        self._process = subprocess.Popen(
            [sys.executable, "-m", "faults.warm"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            env={**os.environ, "PYTHONPATH": paths},
        )
        atexit.register(self._close)

    def ask(self, request: dict[str, Any]) -> Any:
        """Return the answer to a request."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def _close(self) -> None:
        self._process.communicate()


@cache
def server() -> Server:
    """Return the one server of this process."""
    return Server()


# -- the server ------------------------------------------------------------------------------------------------


def _serve() -> dict[str, Any] | None:
    """Answer requests; return None at their end, and in each forked process what it shall do."""
    while line := sys.stdin.readline():
        asked = json.loads(line)
        if "collect" in asked:
            found, status = os.waitpid(asked["collect"], os.WNOHANG)
            answer = os.waitstatus_to_exitcode(status) if found else None
            print(json.dumps(answer), flush=True)
        elif os.fork() == 0:
            return asked
    return None


def _become(asked: dict[str, Any]) -> None:
    """Be a command: a group of its own, files for streams, the signals as a shell leaves them."""
    os.setsid()
    answer = os.dup(sys.stdout.fileno())
    nothing, said = os.open(os.devnull, os.O_RDWR), os.open(asked["said"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream, file in enumerate((nothing, nothing, said)):
        os.dup2(file, stream)
    if asked["limit"] is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (asked["limit"], asked["limit"]))
    sys.argv = ["mjcont", *asked["arguments"]]
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    os.write(answer, b"%d\n" % os.getpid())  # it can be killed from now on
    os.close(answer)
    runpy.run_module("mjcont", run_name="__main__", alter_sys=True)


def _main() -> None:
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # until the command is there to hear it
    for module in LOADED:
        __import__(module)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of forks beside BLAS' threads, which are asleep
        asked = _serve()
    if asked is not None:
        _become(asked)


if __name__ == "__main__":
    _main()
