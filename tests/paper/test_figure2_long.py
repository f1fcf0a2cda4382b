"""Figure 2 at slower loads: how far a load gets ahead of the mechanism as it sweeps past a fold.

Theory: near a fold the heavily damped mechanism obeys x' = a x^2 + b r t, whose solution leaves at a delay
proportional to r^(2/3) (a Riccati equation; the constant is the first zero of the Airy function).
"""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

fig02 = load_script(scripts_folder() / "fig02.py")

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def heavy():
    """The equilibria of the heavily damped mechanism."""
    return fig02.equilibria(fig02.overcentre(), c_sp=10.0)


def rate_of_figure_2(fold):
    """The rate, in N/s, at which the load of figure 2 passes a fold."""
    return np.radians(360.0 / fig02.CYCLE) * np.sqrt(fig02.BOUNDS[1] ** 2 - fold["F"] ** 2)


@pytest.mark.parametrize("label", ["LP1", "LP2"])
def test_the_load_gets_ahead_with_the_power_two_thirds_of_its_rate(heavy, label):
    rate = rate_of_figure_2(heavy.point(label))
    ahead = [fig02.overshoot(heavy, label, rate / slower) for slower in (1.0, 10.0, 100.0, 1000.0)]
    powers = np.log10(np.divide(ahead[:-1], ahead[1:]))
    assert np.all((powers > 0.62) & (powers < 0.70))


def test_a_ramp_past_the_fold_stands_for_the_whole_cycle(heavy):
    slower = 10.0
    motion = mc.simulate(
        heavy.problem,
        {"F": lambda t: fig02.load(t / slower)},
        slower * fig02.CYCLE,
        heavy.row(len(heavy) - 1),
        samples=36_000,
    )
    passed = fig02.passages(motion)
    assert len(passed) == 2
    for (_, force), label in zip(passed, ("LP2", "LP1"), strict=True):
        fold = heavy.point(label)
        ahead = fig02.overshoot(heavy, label, rate_of_figure_2(fold) / slower)
        assert abs(force - fold["F"]) == pytest.approx(ahead, rel=0.02)
