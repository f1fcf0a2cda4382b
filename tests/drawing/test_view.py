"""`mjcont view`: the pose it opens, what it says where there is none, and machines without a display."""

import os
import subprocess
import sys
from pathlib import Path

import mujoco.viewer
import pytest
from problems.commands import STUDY

import mjcont as mc
from mjcont.commands.cli import main


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A stored branch with two folds."""
    model = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(model, "F", bounds=(-50, 50), start={"F": 50.0})
    return branch.save(tmp_path_factory.mktemp("stored") / "equilibria.h5")


def without_display(*argv: object) -> subprocess.CompletedProcess[str]:
    """Run the command line as on a machine without display or OpenGL."""
    missing = ("DISPLAY", "WAYLAND_DISPLAY", "MUJOCO_GL", "MPLBACKEND")
    environment = {k: v for k, v in os.environ.items() if k not in missing}
    command = [sys.executable, "-m", "mjcont", *(str(a) for a in argv)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment, check=False)


@pytest.mark.slow
def test_view_opens_the_pose_that_is_asked_for(stored: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = []
    monkeypatch.setattr("mjcont.drawing.viewer.require_display", lambda: None)
    monkeypatch.setattr(mujoco.viewer, "launch", lambda model, data: seen.append((model, data)))
    fold = mc.load(stored).point("LP1")
    for argv in (["--label", "LP1"], ["--at", "F=20"], []):
        assert main(["view", str(stored), *argv]) == 0
    assert seen[0][1].qpos == pytest.approx(fold.state)
    assert seen[0][1].ctrl[0] == fold["F"]
    assert max(abs(a) for a in seen[0][1].qacc) < 1e-8
    assert seen[1][1].ctrl[0] == 20.0
    assert main(["view", "overcentre"]) == 0
    assert main(["view", "overcentre", "--at", "F=0.02kN", "--at", "k_j=2e5"]) == 0
    assert seen[-1][1].ctrl[0] == 20.0
    assert seen[-1][0].actuator("bush_A_x").biasprm[1] == -2e5


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems have a display without any variable set")
def test_without_a_display_view_says_so_in_one_line() -> None:
    view = without_display("view", "overcentre")
    assert view.returncode == 2
    assert view.stderr.startswith("mjcont: error: no display to open the viewer on")
    assert view.stderr.count("\n") == 1


@pytest.mark.slow
def test_a_study_needs_no_display(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(STUDY)
    run = without_display("run", tmp_path / "study.toml", "-o", tmp_path, "-q")
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert (tmp_path / "fig.png").stat().st_size > 1000


@pytest.mark.parametrize(
    ("argv", "message"),
    [
        (["RESULT", "--label", "LP9"], "equilibria.h5': unknown special point 'LP9'. Did you mean LP"),
        (["RESULT", "--at", "F=90"], "no point with F = 90: F goes from -50 N to 50 N"),
        (["RESULT", "--at", "F=2kg"], "does not fit a quantity in N. Valid units: N, kN, MN, lbf."),
        (["RESULT", "--at", "G=2"], "unknown column 'G'"),
        (["RESULT", "--keyframe", "up"], "--keyframe goes with a model; for a result file use --label or --at"),
        (["overcentre", "--at", "G=2"], "unknown parameter 'G'. Valid: F"),
        (["overcentre", "--keyframe", "up"], "unknown keyframe 'up'"),
        (["overcentre", "--label", "LP1"], "--label goes with a result file; for a model use --keyframe or --at"),
    ],
)
def test_a_pose_that_is_not_there_says_what_is(
    argv: list[str], message: str, stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["view", *(str(stored) if a == "RESULT" else a for a in argv)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.startswith("mjcont: error: ")
    assert error.count("\n") == 1
