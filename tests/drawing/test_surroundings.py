"""What pictures of mechanisms need around them, and that they are the same every time."""

import os
import subprocess
import sys

import pytest

import mjcont as mc
from mjcont.drawing.plotting import plot, save_figure
from mjcont.drawing.poses import add_poses, draw


@pytest.mark.slow
def test_a_picture_is_the_same_every_time(tmp_path, overcentre_branch):
    branch = overcentre_branch()
    written = []
    for k in range(2):
        ax = plot(branch, x="F", y="theta_1")
        add_poses(ax, branch, x="F", y="theta_1")
        written.append(save_figure(ax.figure, tmp_path / f"diagram{k}.png").read_bytes())
        gear = mc.Mechanism.from_xml("nose_gear")
        written.append(save_figure(draw(gear).figure, tmp_path / f"gear{k}.svg").read_bytes())
    assert written[:2] == written[2:]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems have a display without any variable set")
def test_neither_opengl_nor_a_display_nor_pyplot_is_needed(tmp_path):
    missing = ("DISPLAY", "WAYLAND_DISPLAY", "MUJOCO_GL", "MPLBACKEND")
    environment = {k: v for k, v in os.environ.items() if k not in missing}
    code = (
        "import sys; import mjcont as mc; from mjcont.drawing.poses import draw; "
        "from mjcont.drawing.plotting import save_figure; "
        "assert 'matplotlib' not in sys.modules; "
        f"save_figure(draw(mc.Mechanism.from_xml('overcentre')).figure, {str(tmp_path / 'pose.png')!r}); "
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert (tmp_path / "pose.png").stat().st_size > 5000
