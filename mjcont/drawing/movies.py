"""Pictures in a row as a file: GIF by Pillow, MP4 by ffmpeg; whole or not at all."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path

import numpy as np

from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.outside.saving import check_writable, write_file

SUFFIXES = (".gif", ".mp4")
# a GIF counts hundredths of a second, and viewers slow down below two of them
_GIF_FPS = 50.0
_FOR_PALETTE = 6

Draw = Callable[[int], Array]
Progress = Callable[[int, int], None]


def check_movie(path: Path, fps: float) -> None:
    """Raise unless a movie can be written there at that rate, before any work is done."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        valid = ", ".join(SUFFIXES)
        raise MjcontError(f"cannot write an animation as '{path.name}': the suffix must be one of {valid}")
    check_writable(path)
    if suffix == ".gif" and fps > _GIF_FPS:
        raise MjcontError(f"a GIF shows at most {_GIF_FPS:g} frames a second, got fps = {fps:g}; an MP4 shows more")
    if suffix == ".mp4":
        _ffmpeg()


def write_movie(path: Path, draw: Draw, count: int, fps: float, progress: Progress | None = None) -> Path:
    """Write `count` frames; `draw(k)` returns frame k, (height, width, 3) bytes, and may be called again."""

    def frames() -> Iterator[Array]:
        for k in range(count):
            yield draw(k)
            if progress is not None:
                progress(k + 1, count)

    if path.suffix.lower() == ".mp4":
        return write_file(path, _mp4(path, frames(), fps))
    some = np.unique(np.linspace(0, count - 1, _FOR_PALETTE).round().astype(int))
    samples = np.concatenate([draw(int(k)) for k in some])
    ticks = np.diff((100.0 * np.arange(count + 1) / fps).round()).astype(int)
    return write_file(path, _gif(frames(), samples, 10 * ticks))


def _gif(frames: Iterator[Array], samples: Array, durations: Array) -> bytes:
    """Return frames, each for so many milliseconds, in the colours of some of them."""
    from PIL import Image

    # one palette for all frames: colours do not flicker, and only what moves is stored
    palette = Image.fromarray(samples).quantize(255)
    colors = np.array(palette.getpalette()).reshape(-1, 3)
    colors[colors.sum(axis=1).argmax()] = 255  # averages leave the paper grey
    palette.putpalette(colors.ravel().tolist())
    images = (Image.fromarray(f).quantize(palette=palette, dither=Image.Dither.NONE) for f in frames)
    first = next(images)
    made = io.BytesIO()
    first.save(made, format="GIF", save_all=True, append_images=images, loop=0, duration=durations.tolist())
    return made.getvalue()


def _ffmpeg() -> str:
    """Return the path of ffmpeg, where matplotlib looks for it."""
    from matplotlib import rcParams

    found = shutil.which(str(rcParams["animation.ffmpeg_path"]))
    if found is None:
        raise MjcontError(
            "an MP4 needs ffmpeg, which is not found: install it (Debian: ffmpeg), set matplotlib's "
            "rcParams['animation.ffmpeg_path'], or write a .gif"
        )
    return found


def _mp4(path: Path, frames: Iterator[Array], fps: float) -> bytes:
    """Return frames as ffmpeg makes them into a movie; it writes into memory where the system can, else a folder."""
    if hasattr(os, "memfd_create"):
        memory = os.memfd_create("mjcont")
        with os.fdopen(memory, "rb") as made:
            _run_ffmpeg(path, f"/dev/fd/{memory}", frames, fps, (memory,))
            return made.read()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "movie.mp4"
        _run_ffmpeg(path, str(place), frames, fps)
        return place.read_bytes()


def _run_ffmpeg(path: Path, out: str, frames: Iterator[Array], fps: float, kept: tuple[int, ...] = ()) -> None:
    first = next(frames)
    # what every player shows needs an even number of pixels each way
    height, width = (2 * (n // 2) for n in first.shape[:2])
    given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{fps:.6g}", "-i", "-"]
    wanted = ["-an", "-vcodec", "libx264", "-pix_fmt", "yuv420p", "-f", "mp4", out]
    command = [_ffmpeg(), "-y", "-loglevel", "error", *given, *wanted]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, pass_fds=kept) as process:
        assert process.stdin is not None and process.stderr is not None
        try:
            for frame in chain([first], frames):
                process.stdin.write(np.ascontiguousarray(frame[:height, :width]).tobytes())
        except BrokenPipeError:
            pass  # its own words, read below, say why
        except BaseException:
            process.kill()
            raise
        _, said = process.communicate()
    if process.returncode != 0:
        lines = said.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise MjcontError(f"cannot write {path}: ffmpeg could not make the animation: {lines[-1]}")
