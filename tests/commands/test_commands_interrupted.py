"""The command line interrupted, and with nobody who reads."""

import os
import signal
from pathlib import Path

import pytest
from problems.commands import SLOW, STUDY, child, terminal

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.commands.told import Told


def test_an_interrupt_while_a_branch_runs_stores_its_points(
    here: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def impatient(self: Told, count: int, special: object) -> None:
        if count == 5:
            raise KeyboardInterrupt

    monkeypatch.setattr(Told, "point", impatient)
    (here / "study.toml").write_text(STUDY + SLOW[SLOW.index("[[") :])
    assert main(["run", "study.toml"]) == 130
    err = capsys.readouterr().err
    assert err == "mjcont: interrupted: out/equilibria.h5 holds the 6 points so far; 2 more not computed\n"
    assert [p.name for p in (here / "out").iterdir()] == ["equilibria.h5"]
    assert mc.load("out/equilibria.h5").interrupted


def test_an_interrupt_elsewhere_is_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mjcont.studies.study.load_study", interrupted)
    assert main(["run", "study.toml"]) == 130
    assert capsys.readouterr().err == "mjcont: interrupted\n"


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
def test_ctrl_c_stores_the_points_so_far(tmp_path: Path) -> None:
    (tmp_path / "slow.toml").write_text(SLOW)
    with terminal() as (shown, stderr):
        run = child("run", tmp_path / "slow.toml", "-o", tmp_path / "out", stderr=stderr)
        while "points, F = " not in shown():
            assert run.poll() is None
        run.send_signal(signal.SIGINT)
        assert run.wait(timeout=120) == 130
        last = shown().replace("\r\n", "\n").rpartition("\x1b[K")[2]
    assert run.stdout is not None
    run.stdout.close()
    assert last.startswith("mjcont: interrupted: ")
    assert last.count("\n") == 1
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["slow.h5"]
    branch = mc.load(tmp_path / "out" / "slow.h5")
    assert branch.interrupted
    assert len(branch) > 1


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows reports a closed pipe in other ways")
def test_a_closed_pipe_ends_the_output_and_not_the_run(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(STUDY)
    run = child("run", tmp_path / "study.toml", "-o", tmp_path)
    assert run.stdout is not None
    assert run.stderr is not None
    run.stdout.close()
    assert run.stderr.read() == ""
    run.stderr.close()
    assert run.wait(timeout=60) == 0
    assert (tmp_path / "equilibria.h5").is_file()
