"""Pictures of orbits: envelopes over equilibria, frequency responses, phase portraits, and movies that loop."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PIL import Image
from problems.oscillators import circles, flutter, resonance

import mjcont as mc


def lines(ax, label="_curve"):
    return [line for line in ax.lines if line.get_label() == label]


def texts(ax):
    return sorted(t.get_text() for t in ax.texts)


@pytest.mark.slow
def test_cycles_are_drawn_as_envelopes_over_their_equilibria():
    equilibria, cycles = circles()
    ax = mc.plot(equilibria, cycles, x="b1", y="u[0]")
    flat, curved = [], []
    for line in lines(ax):
        (flat if np.ptp(line.get_ydata()) < 1e-9 else curved).append(line)
    assert len(flat) == 2  # stable and unstable rest
    assert sorted(line.get_linestyle() for line in curved) == ["-", "-", "--", "--"]
    high = max(line.get_ydata().max() for line in curved)
    assert high == pytest.approx(math.sqrt(0.5 + 0.5 * math.sqrt(1.8)), abs=1e-6)
    assert min(line.get_ydata().min() for line in curved) == pytest.approx(-high)


@pytest.mark.slow
def test_a_fold_is_marked_on_both_envelopes_and_named_once():
    ax = mc.plot(circles()[1], x="b1", y="u[0]")
    marks = np.array([line.get_xydata()[0] for line in lines(ax, "_point")])
    assert marks == pytest.approx(np.array([[-0.25, math.sqrt(0.5)], [-0.25, -math.sqrt(0.5)]]), abs=1e-6)
    assert texts(ax) == ["LPC1"]


@pytest.mark.slow
def test_curves_of_different_kinds_are_named_by_them():
    ax = mc.plot(*circles(), x="b1", y="u[0]")
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["equilibria", "cycles"]


def test_an_orbit_draws_itself_whatever_it_is_called_through():
    ax = mc.plot(flutter()[-1].orbit)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("q1 [deg]", "rate of q1 [deg/s]")
    assert mc.plot(flutter()[-1].orbit, x="q2").get_xlabel() == "q2 [deg]"


@pytest.mark.slow
def test_a_frequency_response_is_one_line_with_units():
    ax = mc.plot(resonance(), x="w", y="x.amplitude")
    (line,) = lines(ax)
    assert line.get_ydata() == pytest.approx(np.degrees(resonance()["x.amplitude"]))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("w [rad/s]", "x amplitude [deg]")


def test_an_unknown_observable_is_an_error_that_lists_columns():
    with pytest.raises(mc.NameLookupError, match="u\\[0\\].max"):
        mc.plot(circles()[1], x="b1", y="hip")


def test_an_orbit_is_a_closed_line():
    orbit = flutter()[-1].orbit
    ax = orbit.plot("q1", "q2")
    (line,) = lines(ax, "_orbit")
    xy = line.get_xydata()
    assert xy[0] == pytest.approx(xy[-1], abs=1e-6)
    assert np.ptp(xy[:, 0]) == pytest.approx(np.degrees(np.ptp(orbit["q1"])), rel=1e-3)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("q1 [deg]", "q2 [deg]")


@pytest.mark.slow
def test_an_orbit_is_drawn_against_its_own_rate():
    ax = resonance()[0].orbit.plot("x", degrees=False)
    x, rate = lines(ax, "_orbit")[0].get_data()
    size = np.abs(1.0 / (0.75 + 0.1j))
    assert np.hypot(x, rate / 0.5) == pytest.approx(np.full(len(x), size), rel=1e-5)
    assert ax.get_ylabel() == "rate of x [rad/s]"


def test_a_portrait_shows_orbits_of_a_curve_dashed_where_unstable():
    cycles = circles()[1]
    ax = mc.plot_orbits(cycles, x="u[0]", y="u[1]", n=6)
    rows = sorted({round(i) for i in np.linspace(0, len(cycles) - 1, 6)})
    drawn = lines(ax, "_orbit")
    assert [line.get_linestyle() == "--" for line in drawn] == [cycles.stability[i] == "unstable" for i in rows]
    assert ax.figure.axes[1].get_ylabel() == "b1"


def test_an_orbit_against_time_needs_an_observable():
    with pytest.raises(mc.MjcontError, match="name an observable to draw against time"):
        flutter()[0].orbit.plot("time")
    (line,) = lines(flutter()[0].orbit.plot("time", "q1"), "_orbit")
    assert line.get_xdata()[-1] == pytest.approx(flutter()[0].orbit.period)


@pytest.mark.slow
def test_a_movie_of_an_orbit_is_a_period_without_its_end(tmp_path):
    path = mc.animate(flutter()[-1], tmp_path / "orbit.gif", "q1", "q2", seconds=1.0, fps=8, size=(320, 160))
    with Image.open(path) as movie:
        assert movie.n_frames == 8
        assert movie.info["loop"] == 0


def test_a_curve_of_orbits_is_animated_by_one_of_them(tmp_path):
    with pytest.raises(mc.MjcontError, match=r"one orbit of a curve"):
        mc.animate(flutter(), tmp_path / "orbits.gif")
