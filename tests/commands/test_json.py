"""What `--json` prints: valid JSON, numbers in SI units and radians, with their units."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from problems.commands import FALLING, STUDY

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.commands.facts import as_json

ANSWER = STUDY + '[answer]\nlocks = "equilibria:LP1"\nsimulations = 0\n'


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Any:
    """What runs a command and returns the JSON that it prints."""

    def run(*argv: object) -> Any:
        capsys.readouterr()
        assert main([*map(str, argv), "--json"]) == 0
        return json.loads(capsys.readouterr().out, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))

    return run


def test_a_model_tells_parameters_observables_and_modes(printed: Any) -> None:
    facts, mechanism = printed("inspect", "overcentre"), mc.Mechanism.from_xml("overcentre")
    assert list(facts["parameters"]) == list(mechanism.parameters)
    assert facts["parameters"]["gravity_angle"]["bounds"] == list(mechanism.parameter("gravity_angle").bounds)
    assert facts["observables"]["theta_1"] == {"unit": "rad"}
    frequencies = mc.modes(mc.find_equilibrium(mechanism)).frequencies
    assert [m["frequency"] for m in facts["modes"]] == pytest.approx(list(frequencies), rel=1e-9)


def test_a_model_that_rests_nowhere_has_no_modes(printed: Any, here: Path) -> None:
    (here / "falling.xml").write_text(FALLING)
    assert printed("inspect", "falling.xml")["modes"] == []


def test_a_result_tells_its_points_in_radians(printed: Any, stored: Path) -> None:
    facts, branch = printed("inspect", stored), mc.load(stored)
    assert [p["label"] for p in facts["points"]] == ["LP1", "LP2"]
    assert facts["points"][0]["values"]["theta_1"] == {"value": branch.point("LP1")["theta_1"], "unit": "rad"}
    assert sum(facts["stability"].values()) == facts["rows"] == len(branch)


@pytest.mark.slow
def test_a_run_tells_results_with_their_files_and_nothing_else(printed: Any, here: Path) -> None:
    (here / "study.toml").write_text(STUDY + '[[searches]]\nname = "found"\nstarts = 20\n')
    facts = printed("run", "study.toml", "-o", "out")
    assert [(r["name"], r["files"]) for r in facts["results"]] == [
        ("found", ["out/found.csv"]), ("equilibria", ["out/equilibria.h5"])]
    assert facts["plots"] == ["out/fig.png"]
    assert facts["results"][0]["points"]


@pytest.mark.slow
def test_an_answer_tells_value_margin_and_influence(printed: Any, here: Path) -> None:
    (here / "study.toml").write_text(ANSWER)
    locks = printed("answer", "study.toml")["answers"]["locks"]
    assert locks["value"] == pytest.approx(24.07741, abs=1e-4)
    assert locks["margin"] == pytest.approx(50.0 - locks["value"])
    assert set(locks["most sensitive to"]) == {"parameter", "tolerance", "change"}
    assert "simulation" not in locks


def test_what_is_no_number_is_null() -> None:
    told = json.loads(as_json({"a": np.nan, "b": np.inf, "c": np.array([1.5, np.nan]), "d": 1j, "e": Path("x")}))
    assert told == {"a": None, "b": None, "c": [1.5, None], "d": {"re": 0.0, "im": 1.0}, "e": "x"}


def test_quiet_and_json_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["run", "overcentre", "-q", "--json"])
    assert "not allowed with" in capsys.readouterr().err
