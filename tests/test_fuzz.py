"""Random short runs of random problems raise nothing but an `MjcontError`: 3,000 in all, a tenth of them by default."""

from __future__ import annotations

import warnings

import pytest
from fuzzing import run

TENTH, ALL, BLOCK = 300, 3000, 30


def go(seeds):
    for seed in seeds:
        print(f"seed {seed}")  # shown where it fails: `run(seed)` of fuzzing.py is the same run anywhere
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # features of random models that are left out
            run(seed)


@pytest.mark.parametrize("first", range(0, TENTH, BLOCK))
def test_random_runs_raise_nothing_but_errors_of_ours(first):
    go(range(first, first + BLOCK))


@pytest.mark.long
@pytest.mark.parametrize("first", range(TENTH, ALL, BLOCK))
def test_many_random_runs_raise_nothing_but_errors_of_ours(first):
    go(range(first, first + BLOCK))
