"""Fields of a thousand and of ten thousand unknowns: what is found, and what it costs in processor time and memory."""

from __future__ import annotations

import json
import math
import subprocess
import sys

import numpy as np
import pytest
from scipy import sparse
from scipy.optimize import brentq
from scipy.sparse.linalg import splu

import mjcont as mc

# a child, since the largest memory of a process never falls again
BRATU = """
import json, resource, time
import numpy as np
from scipy import sparse
import mjcont as mc

m = {m}
line = sparse.diags([np.ones(m - 1), np.full(m, -2.0), np.ones(m - 1)], [1, 0, -1]) * (m + 1.0) ** 2
square = sparse.csc_matrix(sparse.kron(line, sparse.identity(m)) + sparse.kron(sparse.identity(m), line))
field = mc.VectorField(
    lambda u, p: square @ u + p["la"] * np.exp(u), np.zeros(m * m), {{"la": 0.0}},
    jacobian=lambda u, p: square + sparse.diags(p["la"] * np.exp(u)),
)
field.observe("largest", lambda u, p: u.max())
branch = mc.continue_equilibria(field, "la", bounds=(0.0, 8.0), limits={{"largest": (0.0, 2.0)}})
used = resource.getrusage(resource.RUSAGE_SELF)
print(json.dumps({{
    "found": [[p.kind, p["la"]] for p in branch.special_points], "notes": list(branch.notes),
    "seconds": used.ru_utime + used.ru_stime, "megabytes": used.ru_maxrss / 1024.0,
    "counts": sorted(set(branch.n_unstable.tolist())),
}}))
"""


def bratu_fold(m):
    """Return the fold of the 2-D Bratu problem on m x m cells by Newton's method on the branch over the middle value.

    la is solved for with u; d la / d u(middle) = 0 is found by Brent's method: none of the package's own code.
    """
    line = sparse.diags([np.ones(m - 1), np.full(m, -2.0), np.ones(m - 1)], [1, 0, -1]) * (m + 1.0) ** 2
    square = sparse.csc_matrix(sparse.kron(line, sparse.identity(m)) + sparse.kron(sparse.identity(m), line))
    n, middle = m * m, (m // 2) * (m + 1)
    row = sparse.csc_matrix(([1.0], ([0], [middle])), shape=(1, n + 1))
    wave = np.sin(np.arange(1, m + 1) * math.pi / (m + 1))
    state = {"u": 1.39 * np.outer(wave, wave).ravel(), "la": 6.8}

    def slope(value):
        u, la = state["u"], state["la"]
        for _ in range(30):
            e = np.exp(u)
            wide = sparse.hstack([square + sparse.diags(la * e), sparse.csc_matrix(e[:, None])])
            lu = splu(sparse.csc_matrix(sparse.vstack([wide, row])))
            step = lu.solve(-np.append(square @ u + la * e, u[middle] - value))
            u, la = u + step[:n], la + step[n]
            if np.abs(step).max() < 1e-11:
                break
        state["u"], state["la"] = u, la
        return lu.solve(np.append(np.zeros(n), 1.0))[n]

    brentq(slope, 1.3, 1.5, xtol=1e-8)
    return state["la"]


@pytest.mark.long
def test_the_square_bratu_problem_of_10000_unknowns_has_its_fold_in_a_minute_and_600_megabytes():
    told = json.loads(subprocess.run(
        [sys.executable, "-c", BRATU.format(m=100)], capture_output=True, text=True, check=True
    ).stdout)
    ((kind, la),) = told["found"]
    assert kind == "LP"
    assert la == pytest.approx(bratu_fold(100), rel=1e-10)
    assert la == pytest.approx(6.808124423, rel=3e-5)  # the continuous problem's, h^2 away
    assert told["counts"] == [0, 1] and told["notes"] == []
    assert told["seconds"] < 60.0
    assert told["megabytes"] < 600.0


def brusselator_line(n, A=2.0, B=5.45, d_x=0.008, d_y=0.004):
    """The Brusselator with diffusion along a line of length L, held at its uniform state at both ends."""
    line = sparse.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [1, 0, -1], format="csc") * (n + 1.0) ** 2
    ends = np.zeros(n)
    ends[[0, -1]] = (n + 1.0) ** 2

    def f(u, p):
        x, y, part = u[:n], u[n:], p["L"] ** -2
        first = part * d_x * (line @ x + A * ends) + A - (B + 1.0) * x + x**2 * y
        return np.concatenate([first, part * d_y * (line @ y + B / A * ends) + B * x - x**2 * y])

    def jacobian(u, p):
        x, y, part = u[:n], u[n:], p["L"] ** -2
        return sparse.bmat([
            [part * d_x * line + sparse.diags(2.0 * x * y - B - 1.0), sparse.diags(x**2)],
            [sparse.diags(B - 2.0 * x * y), part * d_y * line - sparse.diags(x**2)],
        ], format="csc")

    start = np.concatenate([np.full(n, A), np.full(n, B / A)])
    return mc.VectorField(f, start, {"L": 0.2}, jacobian=jacobian)


@pytest.mark.long
def test_the_brusselator_on_500_cells_oscillates_where_and_as_fast_as_its_waves_do():
    """Wave k has the matrix [[B - 1 - d_x m, A^2], [-B, -A^2 - d_y m]], m = mu_k / L^2: its trace is zero."""
    n, A, B, d_x, d_y = 500, 2.0, 5.45, 0.008, 0.004
    branch = mc.continue_equilibria(brusselator_line(n), "L", bounds=(0.2, 1.2))
    mu = 4.0 * (n + 1) ** 2 * np.sin(np.array([1, 2]) * math.pi / (2 * (n + 1))) ** 2
    lengths = np.sqrt((d_x + d_y) * mu / (B - 1.0 - A**2))
    g = A**2 + d_y * mu / lengths**2
    assert [p.kind for p in branch.special_points] == ["HB", "HB"]
    assert [p["L"] for p in branch.special_points] == pytest.approx(lengths, rel=1e-9)
    omega = np.sqrt(A**2 * B - g**2)
    assert [p.coefficients["omega"] for p in branch.special_points] == pytest.approx(omega, rel=1e-9)
    assert lengths[0] == pytest.approx(0.51302, rel=2e-5)  # Saad, Numerical Methods for Large Eigenvalue Problems, 2.1
    assert branch.notes == () and set(branch.n_unstable) == {0, 2, 4}
