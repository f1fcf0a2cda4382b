"""Random mechanisms, 300 in all: what is said of their rests is what MuJoCo's own accelerations say."""

from __future__ import annotations

import itertools
import warnings

import numpy as np
import pytest
from problems.random_mechanism import KINDS, Judge, bounds_of, kind_of, mechanism

import mjcont as mc

ALL, BLOCK, ROWS = 300, 5, 4
# differences split a double zero into a pair of this size at most, 1/s
ZERO = 1e-2
STATUSES = {"at bound", "closed", "step too small", "breaks off", "max points", "runs off"}
# special points at which the number of unstable eigenvalues may change
CHANGING = ("LP", "HB", "BP", "CO", "ZH", "BT")


def followed(seed):
    """Return the branch of a random mechanism, None where no rest is found from its first pose."""
    print(f"seed {seed}: {kind_of(seed)}")  # shown where it fails
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # what is left out of a model
        problem = mc.Mechanism.from_xml(mechanism(seed))
    try:
        return mc.continue_equilibria(problem, "load", bounds=bounds_of(seed), max_points=80)
    except mc.StartError:
        return None


def zeros(branch, values):
    """Return how many eigenvalues are those of held motions: one or two zeros for each, less where they coincide.

    At a special point its own may be among them.
    """
    notes = [n for n in branch.notes if n.startswith("rigid-body zero modes held")]
    held = len(notes) and notes[0].count("rotation") + notes[0].count("translation")
    return int(np.count_nonzero(np.sort(np.abs(values))[: 2 * held] < ZERO))


def without_held(values, held):
    """Return eigenvalues without the smallest."""
    return values[np.argsort(np.abs(values))[held:]]


def judged(branch, every):
    """Return for rows of a branch how many eigenvalues are unstable by MuJoCo, where its differences can tell."""
    found = {}
    for i, (all_values, apart) in every.items():
        values = without_held(all_values, zeros(branch, all_values))
        noise = 10.0 * apart + 1e-9 * np.abs(values).max()
        if np.all(np.abs(values.real) > noise):
            found[i] = int(np.count_nonzero(values.real > 0))
    return found


def check(seed):
    """Return rows that MuJoCo can judge, all of them; assert that none is wrong, and no special point either."""
    branch = followed(seed)
    if branch is None:
        return 0, 0
    judge, special = Judge(seed), {p.index: p for p in branch.special_points}
    assert {word for word, _ in branch.ends} <= STATUSES, branch.ends
    beside = sorted({j for i in special for j in (i - 1, i + 1) if 0 <= j < len(branch) and j not in special})
    plain = [i for i in range(0, len(branch), max(len(branch) // ROWS, 1)) if i not in special]
    rows = sorted({*plain, *beside[: 2 * ROWS]})
    every = {i: judge.eigenvalues(branch.states[i], float(branch["load"][i])) for i in rows}
    truth, held = judged(branch, every), min((zeros(branch, values) for values, _ in every.values()), default=0)
    wrong = {i: (int(branch.n_unstable[i]), n) for i, n in truth.items() if branch.n_unstable[i] != n}
    assert not wrong, f"rows with (said, true) numbers of unstable eigenvalues: {wrong}"
    missed = [
        (a, b) for a, b in itertools.pairwise(sorted(truth))
        if truth[a] != truth[b] and not any(a < i < b and p.kind in CHANGING for i, p in special.items())
    ]
    assert not missed, f"between rows {missed} the number of unstable eigenvalues changes, and nothing is found"
    for p in branch.special_points:
        if p.kind in ("LP", "BP", "HB"):
            values, apart = judge.eigenvalues(p.state, p["load"])
            values = without_held(values, held)
            near = np.abs(values.real if p.kind == "HB" else values).min()
            assert near <= 100.0 * apart + 1e-4 * np.abs(values).max(), f"{p}: no eigenvalue of MuJoCo's is critical"
    for p, q in itertools.pairwise(branch.special_points):
        twice = p.kind == q.kind != "CO" and np.abs(p.state - q.state).max() < 1e-7
        assert not twice or abs(p["load"] - q["load"]) > 1e-7, f"{p.label} and {q.label} are one point"
    return len(truth), len(rows)


def go(seeds):
    known, asked = np.sum([check(seed) for seed in seeds], axis=0)
    assert known >= 0.5 * asked


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_random_mechanism_is_told_as_mujoco_moves_it(kind):
    go([KINDS.index(kind), len(KINDS) + KINDS.index(kind)])


@pytest.mark.fuzz
@pytest.mark.parametrize("first", range(0, ALL, BLOCK))
def test_300_random_mechanisms_are_told_as_mujoco_moves_them(first):
    go(range(first, first + BLOCK))
