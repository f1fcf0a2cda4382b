"""An interrupt may come at any line while parameters are written: what is asked afterwards is right nevertheless."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.models.quiet import quiet

LENGTH = "spec:geom:rod.size[1]"
ROD = """<mujoco><worldbody><body><joint name="hip" type="hinge" axis="0 1 0" stiffness="3" damping="1"/>
<geom name="rod" type="cylinder" size="0.02 0.5" pos="0 0 0.5" density="1000"/></body></worldbody>
<actuator><motor name="torque" joint="hip"/></actuator></mujoco>"""


@pytest.fixture(autouse=True)
def heard_again() -> Iterator[None]:
    """Let MuJoCo be heard again: an interrupt on the way out of `with quiet` leaves it quiet."""
    yield
    quiet._depth = 0
    mujoco.set_mju_user_warning(None)


def interrupted(work: Callable[[], Any], line: int) -> bool:
    """Do work that an interrupt ends at a line, counted from its first, of what writes; whether it came."""
    left = line

    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        nonlocal left
        if Path(frame.f_code.co_filename).name not in ("writer.py", "inputs.py", "geometry.py"):
            return None
        left -= event == "line"
        if left == 0:
            left = -1
            raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


def lines(work: Callable[[], Any], step: int) -> Iterator[int]:
    """Yield the lines at which work was interrupted, some steps apart, until it ends first."""
    line = 1
    while interrupted(work, line):
        yield line
        line += step


@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "asked", "step"),
    [
        ("overcentre", {"F": 30.0}, 1),
        ("overcentre", {"F": 30.0, "k_j": 700.0, "gravity_angle": 0.2, "m_1": 2.0}, 1),
        (ROD, {LENGTH: 0.7, "gravity_angle": 0.1}, 11),
    ],
    ids=["a control", "fields and gravity", "geometry"],
)
def test_forces_are_right_after_an_interrupt_at_any_line(source: str, asked: dict[str, float], step: int) -> None:
    mechanism = mc.Mechanism.from_xml(source)
    x = mechanism.start_state() + 0.1
    own, there = mechanism.values(), mechanism.values(asked)
    expected = {id(v): mechanism.residual(x, v) for v in (own, there, own)}
    count = 0
    for _line in lines(lambda: mechanism.residual(x, there), step):
        for values in (own, there, own) if count % 2 else (there, own):
            np.testing.assert_array_equal(mechanism.residual(x, values), expected[id(values)])
        count += 1
    assert count > 5
