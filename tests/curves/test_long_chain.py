"""A cantilever of hundreds of links, bent by a load at its tip: what a row costs, and what it says.

With n links of length l = 1 / n and springs k = n it is a discrete elastica of bending stiffness 1 N m^2: a hinge turns
by the moment of the load about it, k phi_i = P l (cos theta_i + ... + cos theta_n), theta_i = phi_1 + ... + phi_i.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from problems.chains import bent

TESTS = Path(__file__).parents[1]


@pytest.mark.slow
def test_a_long_chain_bends_as_the_elastica_and_its_stability_is_that_of_its_eigenvalues():
    branch, _ = bent(140)
    p, angles = branch["P"], np.cumsum(branch.states, axis=1)
    arms = np.cumsum(np.cos(angles)[:, ::-1], axis=1)[:, ::-1] / 140
    assert np.abs(140 * branch.states - p[:, None] * arms).max() < 1e-8
    assert set(branch.stability) == {"stable"}
    assert all(branch.row(i).eigenvalues.real.max() < 0.0 for i in (0, len(branch) // 2, -1))


@pytest.mark.long
def test_a_row_of_400_links_costs_at_most_8_times_one_of_200():
    assert bent(400)[1] < 8.0 * bent(200)[1]


@pytest.mark.long
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="Linux tells the largest memory")
def test_400_links_take_at_most_400_megabytes():
    code = "from problems.chains import bent; bent(400); print(open('/proc/self/status').read())"
    done = subprocess.run([sys.executable, "-c", code], cwd=TESTS, capture_output=True, text=True, check=True)
    (peak,) = re.findall(r"VmHWM:\s*(\d+) kB", done.stdout)  # what getrusage tells of a child begins with its parent's
    assert float(peak) < 400e3
