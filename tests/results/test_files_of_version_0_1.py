"""Result files written by version 0.1.0 load, whatever becomes of the code: one small file of each format."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from problems.reference import ELASTIC_FOLDS

import mjcont as mc

WRITTEN = Path(__file__).parent / "written"
FIRST_FOLD, SECOND_FOLD = (force for force, _ in ELASTIC_FOLDS[1000.0])


def old(name: str) -> Any:
    """Return the result in a file, of which a note says that it has no checksums."""
    with pytest.warns(mc.ResultWarning, match="no checksums"):
        return mc.load(WRITTEN / name)


@pytest.mark.slow
def test_a_branch_of_a_vector_field_holds_points_that_satisfy_its_equations():
    branch = old("vector_field_branch.h5")
    u, v = branch.states.T
    assert branch.problem is None
    assert branch["D"] * (1.0 - u) * np.exp(v) == pytest.approx(u, rel=1e-9, abs=1e-12)
    assert v == pytest.approx(branch.fixed["B"] * u / 4.0, rel=1e-9, abs=1e-12)
    assert [p.label for p in branch.special_points] == ["HB1", "LP1", "LP2", "HB2"]


@pytest.mark.slow
def test_a_hopf_locus_of_a_vector_field_holds_points_of_trace_zero():
    locus = old("vector_field_hopf_locus.h5")
    u, v = locus.states.T
    assert locus.kind == "HB locus"
    assert locus["B"] * u == pytest.approx(5.0 + locus["D"] * np.exp(v), rel=1e-8)


@pytest.mark.slow
def test_a_branch_of_a_mechanism_comes_with_its_model_its_declared_parameter_and_its_certificate():
    branch = old("mechanism_branch.h5")
    turn = branch["hip"]
    moments = 0.5 * 9.81 * np.sin(turn + 0.01) + branch["P"] * np.sin(turn)
    assert branch.problem.parameters["k"].value * turn == pytest.approx(moments, abs=1e-9)
    assert tuple(branch.problem.parameters["k"].bounds) == (1.0, 100.0)
    assert branch.certificate.holds
    assert branch.at(P=5.0)[0].stability == "stable"


@pytest.mark.slow
def test_a_fold_locus_of_a_mechanism_passes_the_fold_known_beforehand():
    locus = old("mechanism_fold_locus.h5")
    assert locus.kind == "LP locus"
    assert locus["F"][locus.start_index] == pytest.approx(SECOND_FOLD, abs=1e-8)


@pytest.mark.slow
def test_a_load_path_keeps_its_jump_at_the_fold():
    path = old("load_path.h5")
    (jump,) = path.jumps
    assert jump.before["F"] == pytest.approx(FIRST_FOLD, abs=1e-8)
    assert [s.branch.kind for s in path.segments] == ["equilibria", "equilibria"]
    assert path["F"][[0, -1]] == pytest.approx([17.0, 15.0])


@pytest.mark.slow
def test_a_history_keeps_its_inputs():
    history = old("history.h5")
    assert history["P"] == pytest.approx(2.0 * history["time"])
    assert history.problem.parameters["k"].value == 10.0


@pytest.mark.slow
def test_a_sweep_keeps_its_cases():
    table = old("sweep.h5")
    order = np.argsort(table["k_sp"])
    assert len(table) == 3
    assert not table.failed
    assert np.all(np.diff(table["fold.F"][order]) > 0)


@pytest.mark.slow
@pytest.mark.parametrize("file", sorted(WRITTEN.glob("*.h5")), ids=lambda p: p.stem)
def test_what_is_loaded_is_saved_and_loaded_again(file, tmp_path):
    result = old(file.name)
    assert str(mc.load(result.save(tmp_path / file.name))) == str(result)
