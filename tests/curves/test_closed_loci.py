"""Hopf curves round a circle in two parameters: the same special points, each once, from every start."""

import numpy as np
import pytest
from problems.marks import long

import mjcont as mc

BOUNDS = (-1.6, 1.6)


def spiral(u, p):
    """Hopf on p^2 + q^2 = 1, where the cubic coefficient is Im (p + iq)^3: six Bautin points, 60 degrees apart."""
    square, rate = u[0] ** 2 + u[1] ** 2, p["p"] ** 2 + p["q"] ** 2 - 1.0
    radial = rate + (3.0 * p["p"] ** 2 * p["q"] - p["q"] ** 3) * square - square**2
    return [radial * u[0] - 2.0 * u[1], 2.0 * u[0] + radial * u[1]]


def double_zero(u, p):
    """Hopf on p^2 + q^2 = 1, double zeros where Im (p + iq)^4 vanishes: at every 45 degrees."""
    s = 4.0 * p["p"] ** 3 * p["q"] - 4.0 * p["p"] * p["q"] ** 3
    return [u[1], p["p"] ** 2 + p["q"] ** 2 - 1.0 - s * s + s * u[1] + u[0] ** 2 + u[0] * u[1]]


def angles(locus, kind):
    """Return where points lie on the circle, in degrees from -1 on."""
    return sorted((float(np.degrees(np.arctan2(x["q"], x["p"]))) + 1.0) % 360.0 - 1.0 for x in locus.of_kind(kind))


def hopf_points(form, q, state, start):
    field = mc.VectorField(form, [0.0, 0.0], {"p": start, "q": q})
    point = mc.find_equilibrium(field, {"p": start, "q": q}, state=state)
    return mc.continue_equilibria(field, "p", BOUNDS, point).of_kind("HB")


@pytest.mark.slow
@pytest.mark.parametrize("q", [long(0.05), long(-0.7), 0.93])
def test_a_closed_hopf_curve_has_its_six_bautin_points_from_every_start(q):
    for point in hopf_points(spiral, q, [0.0, 0.0], 0.1):
        locus = mc.continue_special(point, "q", bounds=BOUNDS)
        assert {end[0] for end in locus.ends} == {"closed"}
        assert [x.kind for x in locus.special_points] == 6 * ["GH"]
        assert angles(locus, "GH") == pytest.approx([0.0, 60.0, 120.0, 180.0, 240.0, 300.0], abs=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize(("q", "first"), [long(0.05, 0.0), (0.62, 0.0), long(-0.8, 270.0)])
def test_a_hopf_curve_ends_at_the_double_zeros_on_both_sides_of_every_start(q, first):
    s = 4.0 * 0.4**3 * q - 1.6 * q**3
    points = hopf_points(double_zero, q, [-np.sqrt(1.0 - 0.16 - q * q + s * s), 0.0], 0.4)
    assert points
    for point in points:
        locus = mc.continue_special(point, "q", bounds=BOUNDS)
        assert [x.kind for x in locus.special_points] == ["BT", "BT"]
        assert angles(locus, "BT") == pytest.approx([first, first + 45.0], abs=1e-5)
