"""What the tests of the command line need: a stored branch, an empty folder, commands that must fail."""

from pathlib import Path

import pytest
from problems.commands import STUDY, Fails

from mjcont.commands.cli import main


@pytest.fixture(scope="session")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A stored branch with two folds."""
    folder = tmp_path_factory.mktemp("stored")
    (folder / "study.toml").write_text(STUDY)
    assert main(["run", str(folder / "study.toml"), "-o", str(folder), "--quiet"]) == 0
    return folder / "equilibria.h5"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder: an empty one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def fails(here: Path, capsys: pytest.CaptureFixture[str]) -> Fails:
    """Run a command that must fail with one line on stderr, and return that line."""

    def run(*argv: object) -> str:
        capsys.readouterr()
        assert main([str(a) for a in argv]) == 2
        error = capsys.readouterr().err
        assert error.startswith("mjcont: error: ")
        assert error.endswith("\n")
        assert error.count("\n") == 1
        return error

    return run
