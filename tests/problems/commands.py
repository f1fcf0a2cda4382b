"""Studies and models that the command line is tried on, and the command line as a process of its own."""

import os
import select
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

STUDY = """
model = "overcentre"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
[[plot]]
file = "fig.png"
x = "F"
y = "theta_1"
"""
SLOW = """
model = "overcentre"
[[branch]]
name = "slow"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
zeros = { F = 49.99 }
[branch.settings]
ds = 1e-4
ds_max = 1e-4
max_points = 1000000
[[branch]]
name = "next"
parameter = "F"
"""
FALLING = """<mujoco model="falling">
<worldbody><body><joint name="z" type="slide" axis="0 0 1"/><geom size="0.1"/></body></worldbody>
<actuator><general name="lift" joint="z" ctrllimited="true" ctrlrange="-1 2"/></actuator></mujoco>"""
# An interrupt reaches the child also where its parent ignores interrupts.
CHILD = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from mjcont.commands.cli import main; "
    + ("sys.exit(main())")
)

Fails = Callable[..., str]


@contextmanager
def terminal() -> Iterator[tuple[Callable[[], str], int]]:
    """A terminal: what reads all that it has shown so far, and the file to write to."""
    import pty

    master, slave = pty.openpty()
    shown = bytearray()

    def read() -> str:
        while select.select([master], [], [], 0.1)[0]:
            shown.extend(os.read(master, 65536))
        return shown.decode(errors="replace")

    try:
        yield read, slave
    finally:
        os.close(slave)
        os.close(master)


def child(*argv: object, stderr: int = subprocess.PIPE) -> subprocess.Popen[str]:
    """Start the command line as a process."""
    return subprocess.Popen(
        [sys.executable, "-c", CHILD, *(str(a) for a in argv)],
        stdout=subprocess.PIPE,
        stderr=stderr,
        text=True,
    )
