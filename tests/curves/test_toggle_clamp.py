"""A toggle clamp that rests on a stop beyond dead centre, against its closed form."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import mjcont as mc

A_B, A_C, K, L_0, STOP = 0.1, 0.3, 2e5, 0.202, math.radians(3.0)


def length(theta: float) -> float:
    """Length of the strut B-C by the law of cosines."""
    return math.sqrt(A_B**2 + A_C**2 - 2.0 * A_B * A_C * math.cos(theta))


def moment(theta: float) -> float:
    """Moment that holds the handle at theta off the stop: dU/dtheta of U = k (l - l_0)^2 / 2."""
    return K * (length(theta) - L_0) * A_B * A_C * math.sin(theta) / length(theta)


def slope(theta: float) -> float:
    """Derivative of the moment, by a centred difference in closed form."""
    return (moment(theta + 1e-6) - moment(theta - 1e-6)) / 2e-6


@pytest.fixture(scope="module")
def clamp():
    return mc.continue_equilibria(
        mc.Mechanism.from_xml("toggle_clamp"), "M", bounds=(-30.0, 30.0), start={"M": 20.0}, keyframe="closed"
    )


def test_the_clamp_leaves_its_stop_at_the_moment_of_the_closed_form(clamp):
    (corner,) = clamp.of_kind("CO")
    assert corner.note.startswith("upper limit of theta")
    assert corner["M"] == pytest.approx(moment(STOP), rel=1e-6)
    assert corner["theta"] == pytest.approx(STOP, abs=1e-7)


def test_leaving_the_stop_is_a_non_smooth_fold_where_the_clamp_is_beyond_the_dip_of_its_moment(clamp):
    (corner,) = clamp.of_kind("CO")
    assert slope(STOP) < 0.0  # beyond dead centre the strut drives the handle on
    assert corner.note.endswith("M turns back: a non-smooth fold")


def test_the_clamp_holds_by_itself_on_its_stop_and_not_at_dead_centre(clamp):
    stability = {round(math.degrees(p["theta"])): p.stability for p in clamp.at(M=0.0)}
    assert stability[3] == "stable"
    assert stability[0] == "unstable"


def test_folds_lie_where_the_closed_form_has_its_extremes(clamp):
    inside = brentq(slope, math.radians(-20.0), math.radians(-2.0), xtol=1e-12)
    found = min(clamp.of_kind("LP"), key=lambda p: abs(p["theta"] - inside))
    assert found["theta"] == pytest.approx(inside, abs=1e-6)
    assert found["M"] == pytest.approx(moment(inside), rel=1e-9)


def test_every_row_off_the_stop_obeys_the_closed_form(clamp):
    free = clamp["theta"] < STOP - 1e-9
    assert np.count_nonzero(free) > 20
    expected = [moment(t) for t in clamp["theta"][free]]
    assert clamp["M"][free] == pytest.approx(expected, abs=1e-6)
