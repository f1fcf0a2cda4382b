"""The wheel: unpacked where nothing of the checkout is, it finds its models, studies, pages and scripts."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.long
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the package as pip unpacks it."""
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([sys.executable, "-m", "build", "--wheel", "-o", folder, ROOT], check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "site")
    return folder / "site"


def run(installed: Path, here: Path, *argv: str) -> str:
    """Run a command of the installed package in a folder and return what it prints."""
    env = {**os.environ, "PYTHONPATH": str(installed)}
    command = [sys.executable, "-m", "mjcont", *argv]
    done = subprocess.run(command, cwd=here, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_it_is_the_installed_package_that_runs(installed: Path, tmp_path: Path) -> None:
    assert run(installed, tmp_path, "schema", "--path").startswith(str(installed))


def test_a_study_runs_by_its_name(installed: Path, tmp_path: Path) -> None:
    run(installed, tmp_path, "run", "overcentre", "-q")
    assert {p.name for p in (tmp_path / "out").iterdir()} >= {"equilibria.h5", "overcentre.png"}


def test_first_steps_go_from_a_model_to_an_answer(installed: Path, tmp_path: Path) -> None:
    assert "next: mjcont run overcentre.toml" in run(installed, tmp_path, "init", "overcentre")
    assert "LP1 (fold)" in run(installed, tmp_path, "run", "overcentre.toml")
    assert "locks at F = 15.1" in run(installed, tmp_path, "answer", "overcentre_lock")
    assert "nothing changed" in run(installed, tmp_path, "compare", "overcentre", "overcentre")


def test_its_pages_are_there_and_lead_nowhere_outside(installed: Path, tmp_path: Path) -> None:
    assert run(installed, tmp_path, "docs", "studies").startswith("# Study files")
    assert not (installed / "mjcont" / "docs" / "images").exists()


def test_its_figures_are_known(installed: Path, tmp_path: Path) -> None:
    said = subprocess.run(
        [sys.executable, "-m", "mjcont", "reproduce", "999"], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(installed)}, check=False,
    )
    assert "unknown figure 999. Valid: 1, 2" in said.stderr
