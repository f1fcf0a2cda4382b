"""The JSON Schema of study files: it takes what the readers take, and refuses what no study may have."""

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from mjcont.commands import jsonschema as own
from mjcont.commands.cli import main
from mjcont.models.loading import shipped_folder
from mjcont.studies.first import first_study
from mjcont.studies.plans import check_study
from mjcont.studies.plots import PLOT
from mjcont.studies.tables import KINDS

STUDY = """
model = "overcentre"
[[branch]]
name = "a"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
zeros = { theta_1 = [0, "10 deg"] }
[branch.settings]
ds_max = 0.05
[[maps]]
name = "m"
point = "a:LP1"
grid = { k_sp = { from = 8, to = 12, count = 3 } }
[[histories]]
name = "h"
inputs = { F = { shape = "ramp", from = 0, to = "5 N", duration = 2 } }
[[plot]]
file = "fig.png"
x = "F"
y = "theta_1"
"""


@pytest.fixture(scope="module")
def validator() -> Any:
    jsonschema.Draft7Validator.check_schema(own.schema())
    return jsonschema.Draft7Validator(own.schema())


def test_the_file_that_ships_is_made_of_the_tables() -> None:
    assert own.SCHEMA.read_text(encoding="utf-8") == own.text()


@pytest.mark.parametrize("path", sorted(shipped_folder("studies").glob("*.toml")), ids=lambda p: p.stem)
def test_studies_that_ship_are_valid(path: Path, validator: Any) -> None:
    validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["overcentre", "von_mises_truss"])
def test_first_studies_are_valid(name: str, validator: Any, tmp_path: Path) -> None:
    from mjcont import Mechanism

    validator.validate(tomllib.loads(first_study(name, tmp_path / "s.toml", Mechanism.from_xml(name))))


def test_a_study_of_many_tables_is_valid(validator: Any, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(STUDY)
    assert check_study(tmp_path / "s.toml")[1] == []
    validator.validate(tomllib.loads(STUDY))


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ('model = "overcentre"', "", ()),
        ('model = "overcentre"', "model = 3", ("model",)),
        ("[[plot]]", "[[plots]]", ()),
        ("bounds = [-50, 50]", "bound = [-50, 50]", ("branch", 0)),
        ("bounds = [-50, 50]", "bounds = [-50]", ("branch", 0, "bounds")),
        ("bounds = [-50, 50]", 'bounds = [-50, "much"]', ("branch", 0, "bounds", 1)),
        ('parameter = "F"\n', "", ("branch", 0)),
        ("{ F = 50 }", "{ F = true }", ("branch", 0, "start", "F")),
        ("ds_max = 0.05", "ds_maxi = 0.05", ("branch", 0, "settings")),
        ('point = "a:LP1"', 'point = "a"', ("maps", 0, "point")),
        ("count = 3", "count = 1", ("maps", 0, "grid", "k_sp")),
        ('shape = "ramp"', 'shape = "rump"', ("histories", 0, "inputs", "F")),
        ('"fig.png"', '"fig 1.png"', ("plot", 0, "file")),
        ('"fig.png"', '"fig.doc"', ("plot", 0, "file")),
    ],
)
def test_a_mistake_is_found_where_it_is_and_by_the_readers_too(
    old: str, new: str, where: tuple[object, ...], validator: Any, tmp_path: Path
) -> None:
    wrong = STUDY.replace(old, new)
    assert wrong != STUDY
    (error,) = validator.iter_errors(tomllib.loads(wrong))
    assert tuple(error.absolute_path) == where
    (tmp_path / "s.toml").write_text(wrong)
    assert check_study(tmp_path / "s.toml")[1] != []


def test_every_key_is_explained_to_an_editor() -> None:
    found = own.schema()["properties"]
    for kind in (*KINDS.values(), PLOT):
        properties = found[kind.table]["items"]["properties"]
        assert list(properties) == list(kind.keys)
        assert all(p["description"] for p in properties.values())


def test_the_command_prints_the_schema_and_writes_it_beside_a_study(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out) == own.schema()
    assert main(["schema", "-o", "study.schema.json"]) == 0
    assert "#:schema ./study.schema.json" in capsys.readouterr().out
    assert json.loads((tmp_path / "study.schema.json").read_text(encoding="utf-8")) == own.schema()
    assert main(["schema", "--path"]) == 0
    assert Path(capsys.readouterr().out.strip()).is_file()
