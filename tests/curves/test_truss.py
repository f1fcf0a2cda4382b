"""A classic of elastic stability with closed forms: the truss of von Mises.

The truss (half span a, bars of stiffness k and rest length L0, dead load P downwards; L1, L2 the lengths of the bars):

    symmetric path    L = sqrt(a^2 + z^2),  P = 2 k z (L0 / L - 1)
    snap-through      dP/dz = 0:     L^3 = a^2 L0,  P_max = 2 k L0 (1 - (a / L0)^(2/3))^(3/2)
    sideways          d2V/dx2 = 0:   L^3 - L0 L^2 + a^2 L0 = 0
    sideways path     with s = (L1 + L2) / 2, d = (L1 - L2) / 2:  x = s d / a,  d^2 = s^2 - L0 (s^2 - a^2) / s,
                      P = 2 k a sqrt((a^2 - d^2) / (s^2 - a^2))

R. von Mises, "Ueber die Stabilitaetsprobleme der Elastizitaetstheorie", ZAMM 3 (1923) 406-422.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.classics import regular

import mjcont as mc

K, L0 = 1000.0, 1.25
SHALLOW, STEEP = 1.0, 0.35  # half spans, m: the bars rise 0.75 m (3-4-5) and 1.2 m (7-24-25)


# -- the truss: closed forms -----------------------------------------------------------------------------------


def symmetric_load(z, a):
    return 2.0 * K * z * (L0 / np.hypot(a, z) - 1.0)


def snap_load(a):
    return 2.0 * K * L0 * (1.0 - (a / L0) ** (2.0 / 3.0)) ** 1.5


def sideways_lengths(a):
    """Bar lengths at which the symmetric path meets the sideways path, the longer first."""
    roots = np.roots([1.0, -L0, 0.0, a**2 * L0])
    return sorted((r.real for r in roots if abs(r.imag) < 1e-12 and r.real > a), reverse=True)


def sideways_coefficient(a):
    """Cubic coefficient c of x' = b (P - P_b) x + c x^3, from the slopes of both paths at the longer length.

    On the sideways path P - P_b = -(c / b) x^2, and b = -d(d2V/dx2)/dP on the symmetric one.
    """
    s = sideways_lengths(a)[0]
    z = math.sqrt(s**2 - a**2)
    load = symmetric_load(z, a)
    # symmetric path, by L: V_xx = 2 k (1 - L0 / L + L0 a^2 / L^3), P = 2 k z (L0 / L - 1)
    v_slope = 2.0 * K * (L0 / s**2 - 3.0 * L0 * a**2 / s**4)
    p_slope = 2.0 * K * (s / z * (L0 / s - 1.0) - z * L0 / s**2)
    # sideways path, by s, where d = 0
    d_slope = 2.0 * s - L0 - L0 * a**2 / s**2
    x_slope = s**2 * d_slope / a**2
    side_slope = 2.0 * K**2 * a**2 / load * (-d_slope / (s**2 - a**2) - 2.0 * s * a**2 / (s**2 - a**2) ** 2)
    return (v_slope / p_slope) * (side_slope / x_slope)


# -- the truss: snap-through -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def truss():
    return mc.Mechanism.from_xml("von_mises_truss")


@pytest.fixture(scope="module")
def shallow(truss):
    return mc.continue_equilibria(truss, "P", bounds=(-300.0, 300.0))


@pytest.fixture(scope="module")
def steep(truss):
    return mc.continue_equilibria(truss, "P", bounds=(-2000.0, 2000.0), start={"a": STEEP}, keyframe="steep")


@pytest.mark.parametrize(("keyframe", "a"), [("unloaded", SHALLOW), ("inverted", SHALLOW), ("steep", STEEP)])
def test_the_unloaded_truss_rests_at_its_keyframes(truss, keyframe, a):
    x = truss.start_state(keyframe)
    assert np.abs(truss.residual(x, truss.values({"a": a}))).max() < 1e-12


def test_every_point_of_the_symmetric_path_lies_on_its_closed_form(shallow):
    assert np.abs(shallow["x"]).max() < 1e-12
    assert shallow["P"] == pytest.approx(symmetric_load(shallow["z"], SHALLOW), abs=1e-9)


@pytest.mark.parametrize(("a", "keyframe"), [(SHALLOW, "unloaded"), (STEEP, "steep"), (0.7, "unloaded")])
def test_the_truss_snaps_at_the_load_of_the_closed_form(truss, a, keyframe):
    branch = mc.continue_equilibria(truss, "P", bounds=(-2000.0, 2000.0), start={"a": a}, keyframe=keyframe)
    down, up = branch.of_kind("LP")
    assert [down["P"], up["P"]] == pytest.approx([snap_load(a), -snap_load(a)], rel=1e-11)


def test_at_the_snap_a_bar_has_the_length_of_the_closed_form(shallow):
    for fold in shallow.of_kind("LP"):
        assert fold["length_left"] ** 3 == pytest.approx(SHALLOW**2 * L0, rel=1e-8)
        assert fold["length_right"] == pytest.approx(fold["length_left"], rel=1e-12)


def test_the_fold_coefficient_is_half_the_curvature_of_the_load(shallow):
    # f = P(z) - P on the symmetric path, d2P/dz2 = -6 k L0 a^2 z / L^5
    first = shallow.point("LP1")
    z = math.sqrt((SHALLOW**2 * L0) ** (2.0 / 3.0) - SHALLOW**2)
    curvature = -6.0 * K * L0 * SHALLOW**2 * z / math.hypot(SHALLOW, z) ** 5
    assert first.coefficients["a"] == pytest.approx(0.5 * curvature, rel=1e-7)


def test_the_shallow_truss_is_stable_but_between_its_snaps(shallow):
    assert [p.label for p in shallow.special_points] == ["LP1", "LP2"]
    assert regular(shallow) == ["stable", "unstable", "stable"]


def test_the_snap_load_follows_the_closed_form_as_the_supports_move_apart(shallow):
    locus = mc.continue_special(shallow.point("LP1"), "a", bounds={"P": (-2000.0, 2000.0), "a": (0.5, 1.24)})
    assert locus["P"] == pytest.approx(snap_load(locus["a"]), rel=1e-9, abs=1e-9)
    assert locus["a"][[0, -1]] == pytest.approx([0.5, 1.24])


# -- the truss: sideways ---------------------------------------------------------------------------------------


def test_the_steep_truss_goes_sideways_at_both_lengths_of_the_closed_form(steep):
    longer, shorter = sideways_lengths(STEEP)
    lengths = [longer, shorter, shorter, longer]
    signs = [1.0, 1.0, -1.0, -1.0]
    points = steep.of_kind("BP")
    assert [p["length_left"] for p in points] == pytest.approx(lengths, rel=1e-10)
    loads = [s * symmetric_load(math.sqrt(n**2 - STEEP**2), STEEP) for s, n in zip(signs, lengths, strict=True)]
    assert [p["P"] for p in points] == pytest.approx(loads, rel=1e-10)


def test_the_steep_truss_goes_sideways_before_it_snaps(steep):
    kinds = [p.kind for p in steep.special_points]
    assert kinds == ["BP", "LP", "BP", "BP", "LP", "BP"]
    assert steep.point("BP1")["P"] < steep.point("LP1")["P"]


@pytest.mark.parametrize(
    ("ratio", "kinds"),
    [
        (0.99 / math.sqrt(8.0), ["BP", "LP", "BP"]),
        (1.01 / math.sqrt(8.0), ["BP", "BP", "LP"]),
        (0.99 * 2.0 / math.sqrt(27.0), ["BP", "BP", "LP"]),
        (1.01 * 2.0 / math.sqrt(27.0), ["LP"]),
    ],
)
def test_the_order_of_special_points_depends_on_the_slope_as_in_the_closed_form(truss, ratio, kinds):
    a = ratio * L0
    start = [0.0, math.sqrt(L0**2 - a**2)]
    branch = mc.continue_equilibria(truss, "P", bounds=(0.0, 2000.0), start={"a": a}, state=start, direction=1)
    assert [p.kind for p in branch.special_points] == kinds


def test_between_the_two_slopes_the_truss_is_stable_again_before_it_snaps(truss):
    a = 0.37 * L0
    start = [0.0, math.sqrt(L0**2 - a**2)]
    branch = mc.continue_equilibria(truss, "P", bounds=(0.0, 2000.0), start={"a": a}, state=start, direction=1)
    assert regular(branch)[:4] == ["stable", "unstable", "stable", "unstable"]


def test_the_steep_truss_loses_its_stability_where_it_goes_sideways(steep):
    first, last = steep.point("BP1").index, steep.point("BP4").index
    assert set(steep.stability[:first]) == {"stable"}
    assert set(steep.stability[last + 1 :]) == {"stable"}
    assert "stable" not in steep.stability[first : last + 1]


def test_unstable_directions_are_counted_as_in_the_closed_form(steep):
    longer, shorter = sideways_lengths(STEEP)
    lengths = np.hypot(STEEP, steep["z"])
    sideways = (lengths < longer) & (lengths > shorter)
    downwards = lengths**3 < STEEP**2 * L0
    rows = np.array([not label for label in steep.labels])
    assert np.array_equal(steep.n_unstable[rows], (sideways.astype(int) + downwards)[rows])


def test_going_sideways_is_a_subcritical_pitchfork_with_the_coefficient_of_the_closed_form(steep):
    point = steep.point("BP1")
    assert point.coefficients["type"] == "subcritical pitchfork"
    assert point.coefficients["c"] == pytest.approx(sideways_coefficient(STEEP), rel=1e-6)


@pytest.fixture(scope="module")
def sideways(steep):
    """The path on which the apex is off the middle; it closes on itself through the inverted truss."""
    (loop,) = [b for b in mc.switch_branches(steep.point("BP1")) if np.abs(b["x"]).max() > 0.1]
    return loop


def test_every_point_of_the_sideways_path_lies_on_its_closed_form(sideways):
    one, two = sideways["length_left"], sideways["length_right"]
    s, d = 0.5 * (one + two), 0.5 * (one - two)
    assert d**2 == pytest.approx(s**2 - L0 * (s**2 - STEEP**2) / s, abs=1e-9)
    squared = (2.0 * K * STEEP) ** 2 * (STEEP**2 - d**2) / (s**2 - STEEP**2)
    assert sideways["P"] ** 2 == pytest.approx(squared, rel=1e-8, abs=1e-5)


def test_the_sideways_path_is_a_loop_over_both_sides(sideways):
    assert sideways.status == "closed"
    assert [sideways["x"].min(), sideways["x"].max()] == pytest.approx([-L0, L0], rel=1e-2)
    assert sideways["P"].max() == pytest.approx(-sideways["P"].min(), rel=1e-9)


def test_the_sideways_path_meets_the_symmetric_one_twice(sideways, steep):
    loads = sorted(p["P"] for p in sideways.of_kind("BP"))
    assert loads == pytest.approx([steep.point("BP4")["P"], steep.point("BP1")["P"]], rel=1e-9)


def test_unloaded_the_sideways_path_has_both_bars_in_one_line(sideways):
    found = sideways.at(P=0.0)
    assert sorted(p["x"] for p in found) == pytest.approx([-L0, L0], rel=1e-10)
    assert [p["z"] for p in found] == pytest.approx([0.0, 0.0], abs=1e-10)


def test_the_sideways_path_is_nowhere_stable(sideways):
    assert "stable" not in sideways.stability


def test_a_sideways_load_turns_the_branch_point_into_a_fold_at_a_smaller_load(truss, steep):
    branch = mc.continue_equilibria(
        truss, "P", bounds=(0.0, 2000.0), start={"a": STEEP, "H": 1.0}, keyframe="steep", direction=1
    )
    fold = branch.of_kind("LP")[0]
    assert 0.0 < fold["P"] < steep.point("BP1")["P"]


@pytest.mark.slow
def test_the_load_lost_to_a_small_imperfection_follows_koiters_two_thirds_power(truss, steep):
    # near the point 0 = b p x + c x^3 + H: folds where p^3 = -(27/4) (c / b^3) H^2 (Koiter 1945)
    bifurcation = steep.point("BP1")["P"]
    s = sideways_lengths(STEEP)[0]
    z = math.sqrt(s**2 - STEEP**2)
    v_slope = 2.0 * K * (L0 / s**2 - 3.0 * L0 * STEEP**2 / s**4)
    b = -v_slope / (2.0 * K * (s / z * (L0 / s - 1.0) - z * L0 / s**2))
    c = sideways_coefficient(STEEP)
    for load in (1e-3, 1e-4):
        start = {"a": STEEP, "H": load}
        branch = mc.continue_equilibria(truss, "P", bounds=(0.0, 300.0), start=start, keyframe="steep", direction=1)
        lost = bifurcation - branch.of_kind("LP")[0]["P"]
        assert lost == pytest.approx((27.0 * c * load**2 / (4.0 * b**3)) ** (1.0 / 3.0), rel=1e-2)


@pytest.mark.slow
def test_the_inner_path_ends_with_a_sentence_where_the_apex_meets_a_support(steep):
    # there s = a and P = 2 k a sqrt((L0 - a) / a): a bar has no length, and its force no direction
    (path,) = [b for b in mc.switch_branches(steep.point("BP2")) if np.abs(b["x"]).max() > 0.1]
    limit = 2.0 * K * STEEP * math.sqrt((L0 - STEEP) / STEEP)
    assert path["P"].max() == pytest.approx(limit, rel=1e-3)
    assert path.status == "step too small"
    assert "step below ds_min at P = 1122" in path.message
