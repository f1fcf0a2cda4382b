"""Frames rendered by MuJoCo off-screen; refuses in a sentence where there is no OpenGL."""

from __future__ import annotations

import warnings
from typing import Any

import mujoco

from mjcont.errors import MjcontError, unknown_name
from mjcont.numerics.equations.problem import Array


class Offscreen:
    """A renderer of one model; `image` may be called at any pose of it, `close` frees it.

    Raises
    ------
    MjcontError
        If OpenGL cannot draw off-screen on this machine.
    NameLookupError
        If the model has no such camera.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int, camera: str | None = None) -> None:
        self._view = _camera(model, camera)
        buffer = model.vis.global_
        buffer.offwidth, buffer.offheight = max(buffer.offwidth, width), max(buffer.offheight, height)
        self._renderer = _renderer(model, width, height)

    def image(self, data: mujoco.MjData) -> Array:
        """Return what the camera sees, (height, width, 3) bytes."""
        self._renderer.update_scene(data, self._view)
        return self._renderer.render()

    def close(self) -> None:
        """Free what OpenGL holds."""
        self._renderer.close()


def _camera(model: mujoco.MjModel, name: str | None) -> Any:
    if name is not None:
        names = [n for n in (str(model.camera(i).name) for i in range(model.ncam)) if n]
        if name not in names:
            raise unknown_name("camera", name, names)
        return name
    free = mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, free)
    return free


def _renderer(model: mujoco.MjModel, width: int, height: int) -> Any:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # glfw warns, then fails
            return mujoco.Renderer(model, height, width)
    except Exception as error:  # each backend fails with errors of its own
        raise MjcontError(
            f"MuJoCo cannot render off-screen here ({' '.join(str(error).split()) or type(error).__name__}): set "
            "MUJOCO_GL=egl or MUJOCO_GL=osmesa before Python starts (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri, or "
            "libosmesa6), or leave rendering='drawing'"
        ) from error
