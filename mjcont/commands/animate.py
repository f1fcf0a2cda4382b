"""The command `mjcont animate`: a stored history, branch or load path as a moving picture."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from mjcont.commands.common import OK, load, naming
from mjcont.commands.progress import gauge
from mjcont.commands.readers import place
from mjcont.outside.terminal import say


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    p.add_argument("file", metavar="FILE.h5", help="a history, a branch or a load path")
    p.add_argument("-o", "--out", type=place, metavar="FILE",
                   help="gif, or mp4 with ffmpeg (default: FILE.gif beside the input)")
    p.add_argument("-x", metavar="COL", help="column along the horizontal axis (default: time, or the parameter)")
    p.add_argument("-y", metavar="COL", help="column along the vertical axis (default: the first observable)")
    p.add_argument("--on", metavar="BRANCH.h5", action="append", help="a branch to draw the diagram of (repeat it)")
    p.add_argument("--fps", type=float, default=25.0, help="frames a second (default: 25)")
    p.add_argument("--seconds", type=float, help="length (default: real time of 2 to 20 s, or 8 s)")
    p.add_argument("--size", metavar="WxH", type=_size, default=(800, 360), help="in pixels (default: 800x360)")
    p.add_argument("--radians", dest="degrees", action="store_false", help="angles in radians, not degrees")
    p.add_argument("--plane", help="the drawing's horizontal and vertical axis, such as xz or -xz")
    p.add_argument("--rendering", default="drawing", help="drawing (default), or mujoco, which needs OpenGL")
    p.add_argument("--camera", metavar="NAME", help="one of the model's cameras, with --rendering mujoco")


def run(args: argparse.Namespace) -> int:
    """Write the animation and say where it is."""
    from mjcont.drawing.animation import animate

    out = Path(args.out) if args.out else Path(args.file).with_suffix(".gif")
    result: Any = load(args.file)  # `animate` says what it takes
    on: list[Any] = [load(b) for b in args.on or []]
    with naming(args.file), gauge(str(out)) as shown:
        animate(
            result, out, args.x, args.y, on=on, fps=args.fps, seconds=args.seconds, size=args.size,
            degrees=args.degrees, plane=args.plane, rendering=args.rendering, camera=args.camera,
            progress=lambda done, count: shown.count(done, count, " frames"),
        )
    say(f"animation: {out}")
    return OK


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal()):
        raise argparse.ArgumentTypeError(f"expected WIDTHxHEIGHT in pixels such as 800x360, got '{text}'")
    return int(width), int(height)
