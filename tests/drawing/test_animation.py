"""Animations: how many frames, for how long, what they show, and what is refused."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.drawing.frames import frames_of, track_of

SMALL = {"fps": 10.0, "size": (240, 120)}
RED = (209, 40, 31)


@pytest.fixture(scope="module")
def history():
    mechanism = mc.Mechanism.from_xml("overcentre")
    push = {"F": ([0.0, 3.0], [40.0, 0.0])}
    return mc.simulate(mechanism, push, duration=3.0, start={"F": 40.0, "m_1": 2.0}, samples=100)


@pytest.fixture(scope="module")
def loop():
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(0, 40), start={"F": 40.0})
    return mc.load_path(branch, "F", [40, 0])


def _read(path):
    """Return frames and their durations in ms."""
    frames, durations = [], []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            frames.append(np.asarray(image.convert("RGB")).astype(int))
            durations.append(image.info["duration"])
    return frames, durations


def _red(frame):
    """Return column and row of the middle of what is drawn in the moving point's colour, right of the mechanism."""
    rows, cols = np.nonzero(np.abs(frame - RED).sum(axis=2) < 60)
    return cols.mean(), rows.mean()


@pytest.mark.slow
def test_a_history_of_three_seconds_has_thirty_frames_in_real_time(history, tmp_path):
    frames, durations = _read(mc.animate(history, tmp_path / "a.gif", **SMALL))
    assert len(frames) == 30 and frames[0].shape == (120, 240, 3)
    assert sum(durations) == 3000


@pytest.mark.slow
def test_durations_that_are_no_hundredths_of_a_second_add_up(history, tmp_path):
    _, durations = _read(mc.animate(history, tmp_path / "a.gif", seconds=1.0, fps=30.0, size=(240, 120)))
    assert set(durations) == {30, 40} and sum(durations) == 1000


@pytest.mark.slow
def test_the_mechanism_moves_and_the_point_goes_to_the_right(history, tmp_path):
    frames, _ = _read(mc.animate(history, tmp_path / "a.gif", seconds=0.5, **SMALL))
    assert np.abs(frames[0][:, :80] - frames[-1][:, :80]).max() > 100
    assert _red(frames[-1])[0] > _red(frames[0])[0] + 30


def test_frames_of_a_history_are_even_in_time_and_interpolate_its_rows(history):
    frames = frames_of(track_of(history, "time", "theta_1"), 8)
    times = np.linspace(0.0, 3.0, 8)
    assert [f.x for f in frames] == pytest.approx(times)
    assert [f.y for f in frames] == pytest.approx(np.interp(times, history["time"], history["theta_1"]))
    assert np.array_equal(frames[0].state, history.states[0]) and np.allclose(frames[-1].state, history.states[-1])
    assert frames[3].values["F"] == pytest.approx(40.0 - 40.0 * times[3] / 3.0)


def test_frames_of_a_branch_are_even_in_the_scaled_diagram(overcentre_branch):
    branch = overcentre_branch()
    frames = frames_of(track_of(branch, "F", "theta_1"), 60)
    assert (frames[0].x, frames[0].y) == (branch["F"][0], branch["theta_1"][0])
    assert (frames[-1].x, frames[-1].y) == pytest.approx((branch["F"][-1], branch["theta_1"][-1]))
    steps = np.hypot(*(np.diff([getattr(f, n) for f in frames]) / np.ptp(branch[c]) for n, c in
                       (("x", "F"), ("y", "theta_1"))))
    assert steps.max() / steps.min() < 1.05


def test_poses_between_rows_are_the_branchs_own(overcentre_branch):
    branch = overcentre_branch()
    frame = frames_of(track_of(branch, "F", "theta_1"), 60)[37]
    seen = branch.problem.measure(frame.state[None], frame.values, ["theta_1"])
    assert seen[0, 0] == pytest.approx(frame.y, abs=1e-9)


def test_a_jump_moves_at_the_load_of_its_fold_from_one_rest_to_the_next(loop):
    jump = loop.jumps[0]
    moving = [f for f in frames_of(track_of(loop, "F", "theta_1"), 200) if f.caption.endswith("jump at a fold")]
    assert len(moving) > 20
    assert np.array([f.x for f in moving]) == pytest.approx(jump.before["F"], rel=1e-3)
    assert moving[0].y == pytest.approx(jump.before["theta_1"], abs=0.1)
    assert moving[-1].y == pytest.approx(jump.after["theta_1"], abs=0.1)


@pytest.mark.slow
def test_a_load_path_begins_and_ends_at_its_ends(loop, tmp_path):
    frames = frames_of(track_of(loop, "F", "theta_1"), 20)
    assert np.array_equal(frames[0].state, loop.states[0]) and np.allclose(frames[-1].state, loop.states[-1])
    pictures, _ = _read(mc.animate(loop, tmp_path / "a.gif", seconds=1.0, **SMALL))
    assert _red(pictures[-1])[1] > _red(pictures[0])[1]


@pytest.mark.slow
def test_a_history_goes_over_a_branch_with_a_parameter_that_it_holds(overcentre_branch, tmp_path):
    held = mc.simulate(mc.Mechanism.from_xml("overcentre"), duration=0.5, start={"F": 20.0})
    assert frames_of(track_of(held, "F", "theta_1"), 5)[3].x == 20.0
    frames, _ = _read(mc.animate(held, tmp_path / "a.gif", on=overcentre_branch(), seconds=0.3, **SMALL))
    assert len(frames) == 3


def test_a_stored_history_knows_the_parameters_that_it_held(history, tmp_path):
    again = mc.load(history.save(tmp_path / "h.h5"))
    assert again["m_1"][0] == 2.0 and again.unit("m_1") == "kg"
    assert frames_of(track_of(again, "time", "theta_1"), 3)[1].values["m_1"] == 2.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"path": "a.avi"}, "must be one of .gif, .mp4"),
        ({"path": "nowhere/a.gif"}, "does not exist"),
        ({"y": "theta_9"}, "unknown column 'theta_9'.*theta_1"),
        ({"fps": 80.0}, "at most 50 frames"),
        ({"fps": -1.0}, "fps must be a positive number"),
        ({"seconds": 1e6}, "more than 5000"),
        ({"size": (8, 8)}, "whole number from 64"),
        ({"on": "b.h5"}, "on must be a Branch or a list of Branches"),
        ({"rendering": "photo"}, "unknown rendering 'photo'.*drawing, mujoco"),
        ({"camera": "side"}, "goes with rendering='mujoco'"),
        ({"rendering": "mujoco", "camera": "front"}, "unknown camera 'front'. Valid: side"),
    ],
)
def test_wrong_input_is_refused_and_leaves_no_file(history, tmp_path, options, message):
    options = {**SMALL, **options}
    with pytest.raises(mc.MjcontError, match=message):
        mc.animate(history, tmp_path / options.pop("path", "a.gif"), **options)
    assert list(tmp_path.iterdir()) == []


def test_results_without_poses_are_refused(history, tmp_path):
    with pytest.raises(mc.MjcontError, match="without a Mechanism"):
        mc.animate(replace(history, problem=None), tmp_path / "a.gif")
    with pytest.raises(mc.MjcontError, match="got the int 3"):
        mc.animate(3, tmp_path / "a.gif")
    first = {n: replace(c, values=c.values[:1]) for n, c in history.columns.items()}
    with pytest.raises(mc.MjcontError, match="at least two rows"):
        mc.animate(replace(history, columns=first, states=history.states[:1]), tmp_path / "a.gif")


@pytest.mark.slow
def test_an_interrupt_leaves_the_old_file_and_no_other(history, tmp_path):
    out = tmp_path / "a.gif"
    out.write_bytes(b"old")

    def stop(done, count):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        mc.animate(history, out, progress=stop, **SMALL)
    assert [p.name for p in tmp_path.iterdir()] == ["a.gif"] and out.read_bytes() == b"old"


def test_an_mp4_without_ffmpeg_says_what_to_install(history, tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(mc.MjcontError, match="Debian: ffmpeg"):
        mc.animate(history, tmp_path / "a.mp4")


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="needs ffmpeg")
def test_an_mp4_is_written_by_ffmpeg(history, tmp_path):
    out = mc.animate(history, tmp_path / "a.mp4", seconds=0.5, **SMALL)
    assert out.read_bytes()[4:8] == b"ftyp"


@pytest.mark.slow
@pytest.mark.parametrize(("backend", "expected"), [("disable", "set MUJOCO_GL=egl"), ("egl", "a.gif")])
def test_mujoco_renders_where_there_is_opengl_and_says_so_where_not(history, tmp_path, backend, expected):
    file = history.save(tmp_path / "h.h5")
    command = [sys.executable, "-m", "mjcont", "animate", str(file), "-o", str(tmp_path / "a.gif"), "--seconds", "0.3",
               "--fps", "10", "--size", "240x120", "--rendering", "mujoco", "--camera", "side"]
    environment = {**os.environ, "MUJOCO_GL": backend}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if backend == "egl" and done.returncode != 0:
        pytest.skip("no EGL here")
    assert expected in done.stdout + done.stderr and "Traceback" not in done.stderr
    if backend == "egl":
        frames, _ = _read(tmp_path / "a.gif")
        assert np.abs(frames[0][:, :80] - frames[-1][:, :80]).max() > 50


@pytest.mark.slow
def test_the_command_writes_a_gif_beside_the_result(history, tmp_path, capsys):
    file = history.save(tmp_path / "h.h5")
    assert main(["animate", str(file), "-y", "theta_1", "--seconds", "0.3", "--size", "240x120"]) == 0
    assert capsys.readouterr().out == f"animation: {tmp_path / 'h.gif'}\n"
    assert len(_read(tmp_path / "h.gif")[0]) == 8
    assert main(["animate", str(file), "-y", "nothing"]) == 2
    assert "unknown column 'nothing'" in capsys.readouterr().err
