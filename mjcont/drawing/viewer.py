"""MuJoCo's own viewer, opened at a pose; refuses in a sentence where there is no display."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import mujoco

from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.quiet import quiet
from mjcont.numerics.equations.problem import Array


def view(mechanism: Mechanism, state: Array, values: Mapping[str, float]) -> None:
    """Open the viewer with the mechanism at a state and parameter values; returns when its window is closed.

    Raises
    ------
    MjcontError
        If no window with OpenGL can be opened on this machine.
    """
    model, data = posed(mechanism, state, values)
    require_display()
    import mujoco.viewer

    mujoco.viewer.launch(model, data)


class Stand:
    """A copy of a model that takes one pose after another; `model` and `data` stay the same objects."""

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism = mechanism
        self.model = mechanism.simulation_model()
        self._writer = mechanism.writer(self.model)
        self.data = mujoco.MjData(self.model)

    def pose(self, state: Array, values: Mapping[str, float]) -> None:
        """Put it at rest in a state, with parameter values."""
        self._writer.write(self._mechanism.parameters, self._mechanism.values(values))
        self.data.qpos[:] = state
        self._writer.inputs.begin(self.data)
        with quiet:
            mujoco.mj_forward(self.model, self.data)


def posed(mechanism: Mechanism, state: Array, values: Mapping[str, float]) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a copy of the model that has the parameter values, and its data at rest in the state."""
    stand = Stand(mechanism)
    stand.pose(state, values)
    return stand.model, stand.data


def require_display() -> None:
    """Raise unless a window with OpenGL can be opened: the viewer itself would end the process."""
    try:
        import glfw
    except ImportError as error:
        raise MjcontError("the viewer needs glfw: pip install glfw") from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        window = None
        try:
            if glfw.init():
                glfw.window_hint(glfw.VISIBLE, glfw.FALSE)
                window = glfw.create_window(64, 64, "mjcont", None, None)
            reason: Any = glfw.get_error()[1]
        finally:
            if window:
                glfw.destroy_window(window)
            glfw.terminate()
    if not window:
        why = reason.decode() if isinstance(reason, bytes) else reason
        raise MjcontError(f"no display to open the viewer on{f' ({why})' if why else ''}")
