"""Processes that work for another: they end with it, write nothing afterwards, and an interrupt is no traceback."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

# A script whose figures take a while, then write; `reproduce` in a process of its own.
SLOW = '''"""Figure {n}: slow."""
import time
from mjcont.drawing.plotting import new_figure, save_figure

def main(out):
    (out / "started{n}").touch()
    for i in range(400):
        time.sleep(0.01)
        (out / "last{n}").write_text(str(time.time()))
    figure, ax = new_figure()
    save_figure(figure, out / "fig0{n}.png")
    return []
'''
REPRODUCE = """
import sys
from pathlib import Path
from mjcont.paper import reproduce
from mjcont.commands.cli import main
if __name__ == "__main__":
    reproduce.scripts_folder = lambda: Path(sys.argv[1])
    sys.exit(main(["reproduce", "-o", sys.argv[2], "--jobs", "2"]))
"""


@pytest.fixture
def begin(tmp_path: Path):
    """Return a function that starts two slow figures in a process group of their own; nothing is left of it."""
    started = []

    def run() -> subprocess.Popen:
        (tmp_path / "scripts").mkdir()
        for n in (1, 2):
            (tmp_path / "scripts" / f"fig0{n}.py").write_text(SLOW.replace("{n}", str(n)))
        (tmp_path / "run.py").write_text(REPRODUCE)
        command = [sys.executable, str(tmp_path / "run.py"), str(tmp_path / "scripts"), str(tmp_path / "out")]
        started.append(subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True))
        return started[-1]

    yield run
    for process in started:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.communicate()


def wait_for(file: Path) -> None:
    deadline = time.monotonic() + 60
    while not file.exists():
        assert time.monotonic() < deadline, f"{file} is not there"
        time.sleep(0.01)


def alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SIGTERM", pytest.param("SIGKILL", marks=pytest.mark.long)])
def test_figures_end_with_the_process_that_asked_for_them_and_write_nothing_afterwards(
    begin, tmp_path: Path, name: str
) -> None:
    process = begin()
    wait_for(tmp_path / "out" / "last1")
    process.send_signal(getattr(signal, name))
    process.wait(timeout=30)
    ended = time.time()
    deadline = time.monotonic() + 10
    while alive(process.pid) and time.monotonic() < deadline:  # the resource tracker sees its pipe close
        time.sleep(0.02)
    assert not alive(process.pid)
    assert all(float(f.read_text() or 0) < ended + 0.2 for f in (tmp_path / "out").glob("last*"))
    assert not list((tmp_path / "out").glob("*.png"))
    assert process.returncode == {"SIGTERM": 143, "SIGKILL": -9}[name]


@pytest.mark.slow
@pytest.mark.parametrize("delay", [0.0, 0.25])
def test_an_interrupt_while_processes_start_gives_one_line(begin, tmp_path: Path, delay: float) -> None:
    process = begin()
    wait_for(tmp_path / "out")
    time.sleep(delay)
    os.killpg(process.pid, signal.SIGINT)  # what a terminal sends
    said = process.communicate(timeout=30)[1]
    assert process.returncode == 130
    assert said == "mjcont: interrupted\n"
