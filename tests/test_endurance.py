"""Much of it: thousands of continuations in one process, branches of a hundred thousand rows."""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import mjcont as mc
from benchmarks.rows import long_branch
from mjcont.drawing.plotting import save_figure

MANY = """
import gc
import mjcont as mc

def resident():
    gc.collect()
    return next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmRSS"))

text = mc.Mechanism.from_xml("von_mises_truss").mjcf
mechanism = mc.Mechanism.from_xml(text)
for i in range(1, 5001):
    if i % 10 == 0:
        mechanism = mc.Mechanism.from_xml(text)
    start = {"k": 900.0 + i % 7}
    branch = mc.continue_equilibria(mechanism, "P", bounds=(-200.0, 200.0), keyframe="unloaded", start=start)
    assert len(branch.special_points) > 0 and len(branch.eigenvalues)
    if i == 500:
        before = resident()
print(resident() / before)
"""


@pytest.mark.long
def test_five_thousand_continuations_need_no_more_memory_than_five_hundred() -> None:
    if not Path("/proc/self/status").exists():
        pytest.skip("this system does not tell a process's memory there")
    done = subprocess.run([sys.executable, "-c", MANY], capture_output=True, text=True, check=True)
    assert float(done.stdout) <= 1.05


def processor_seconds(function: Callable[[], object]) -> float:
    """Return the least that this process computes for a call, of three."""

    def once() -> float:
        began = time.process_time()
        function()
        return time.process_time() - began

    return min(once() for _ in range(3))


@pytest.mark.long
def test_a_hundred_thousand_rows_are_saved_and_loaded_in_a_second_and_drawn_in_three() -> None:
    branch = long_branch()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "long.h5"
        assert processor_seconds(lambda: branch.save(file)) < 1.0
        assert processor_seconds(lambda: mc.load(file)) < 1.0
        picture = Path(folder) / "long.png"
        assert processor_seconds(lambda: save_figure(mc.plot(branch, x="F", y="theta_1").figure, picture)) < 3.0
