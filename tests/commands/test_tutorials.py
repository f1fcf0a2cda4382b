"""The tutorials do what they say when they are followed word for word."""

from __future__ import annotations

from pathlib import Path

import pytest
from problems.pages import blocks, follow

import mjcont as mc

pytestmark = [pytest.mark.long, pytest.mark.filterwarnings("ignore::mjcont.errors.ModelWarning")]
DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_an_engineer_gets_from_a_model_to_the_load_at_which_it_opens(here: Path) -> None:
    follow(DOCS / "engineer.md", here)
    assert {"rests.png", "opening.png", "influence.png"} <= {p.name for p in (here / "out").iterdir()}
    assert {"lock.html", "lock.gif", "change.png"} <= {p.name for p in here.iterdir()}


def test_a_user_of_mujoco_gets_from_a_model_to_its_switching_force(here: Path) -> None:
    names = follow(DOCS / "mujoco.md", here)
    assert names["locus"].of_kind("CP")
    assert "10 confirmed" in str(names["checked"].certificate)
    assert names["shaken"].of_kind("LPC")
    assert (here / "gripper.html").stat().st_size > 100_000


def test_a_dynamicist_gets_from_a_field_to_points_of_codimension_two(here: Path) -> None:
    names = follow(DOCS / "dynamicist.md", here)
    assert {"CP", "BT"} <= {p.kind for p in names["folds"].special_points}


@pytest.mark.parametrize("page", ["auto", "matcont", "bifurcationkit", "bringing"])
def test_what_other_pages_show_runs(page: str, here: Path) -> None:
    assert any(isinstance(value, mc.Branch) for value in follow(DOCS / f"{page}.md", here).values())


@pytest.mark.parametrize("page", ["engineer", "mujoco", "dynamicist", "bringing"])
def test_a_tutorial_has_something_to_follow(page: str) -> None:
    assert sum(b.language in ("python", "console") for b in blocks(DOCS / f"{page}.md")) >= 2
