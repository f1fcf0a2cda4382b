"""What is written in pictures: names, units, numbers and legends, none of them over another or over a curve."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.ticker import MaxNLocator
from problems.pictures import meeting

import mjcont as mc
from mjcont.drawing import notes
from mjcont.drawing.axes import label_axes, readable, show_axis, spread_ticks
from mjcont.drawing.plotting import MARKERS, draw_curve, mark, new_figure, plot, save_figure
from mjcont.results.points import show


@pytest.fixture(scope="module")
def cubic():
    """x' = mu + x - x^3, stable but between the folds at x = -1/sqrt(3) and 1/sqrt(3)."""
    field = mc.VectorField(lambda u, p: p["mu"] + u - u**3, [-1.5], {"mu": -1.0}, names=["x"])
    return mc.continue_equilibria(field, "mu", bounds=(-1, 1))


# -- names --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("F", "F"),
        ("F_ret", r"F$_{\mathrm{ret}}$"),
        ("theta_1", r"θ$_{\mathrm{1}}$"),
        ("R_A_x", r"R$_{\mathrm{A\,x}}$"),
        ("B_1[2]", r"B$_{\mathrm{1}}$[2]"),
        ("gravity_angle", "gravity angle"),
        ("joint_B[0]", "joint B[0]"),
        ("omega", "ω"),
        ("theta_1.max", r"θ$_{\mathrm{1}}$ max"),
        ("q1", "q1"),
        ("body:strut.mass", "body:strut.mass"),
        ("a//b", "a//b"),
        ("$b_$", r"\$b_\$"),
        ("_x", "_x"),
        ("x__y", "x__y"),
        ("", ""),
    ],
)
def test_names_are_written_as_people_do(name, shown):
    assert readable(name) == shown


def test_every_name_can_be_drawn(tmp_path):
    ax = new_figure()[1]
    for k, name in enumerate(["theta_ov", "F_ret_x", "a_1_2_3", "x_frac", "k_sp.h1", "gravity_angle"]):
        ax.text(0.1, 0.1 * k, readable(name))
    assert save_figure(ax.figure, tmp_path / "names.png").stat().st_size > 1000


# -- units --------------------------------------------------------------------------------------------------


def drawn(xs, ys, x, y):
    ax = new_figure()[1]
    ax.plot(xs, ys)
    label_axes(ax, x, y)
    ax.figure.draw_without_rendering()
    return ax


def numbers(labels):
    return [float(t.get_text().replace("\N{MINUS SIGN}", "-")) for t in labels if t.get_text()]


def test_large_forces_are_in_kilonewtons_and_short_lengths_in_millimetres():
    ax = drawn([3e5, 8e5], [0.0, 0.012], ("F_ret", "N"), ("gap", "m"))
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"F$_{\mathrm{ret}}$ [kN]", "gap [mm]")
    assert {400.0, 600.0} <= set(numbers(ax.get_xticklabels()))
    assert numbers(ax.get_yticklabels()) == pytest.approx([1e3 * t for t in ax.get_yticks()])


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [("N", 9e3, "N"), ("N", 2e4, "kN"), ("N*m", 5e6, "MN m"), ("N/m", 1e6, "MN/m"), ("m", 0.2, "m"),
     ("m/s", 0.01, "m/s"), ("kg", 1e6, "kg"), ("Pa", 1e5, "kPa"), ("kN", 1e6, "kN"), ("", 1e6, "")],
)
def test_a_unit_is_enlarged_only_where_numbers_ask_for_it(unit, largest, shown):
    ax = drawn([0.0, largest], [0.0, 1.0], ("F", unit), ("y", ""))
    assert ax.get_xlabel() == (f"F [{shown}]" if shown else "F")


def test_a_label_of_ones_own_has_the_numbers_that_were_drawn():
    ax = drawn([3e5, 8e5], [0.0, 1.0], ("F", "N"), ("y", ""))
    ax.set_xlabel("force [N]")
    ax.figure.draw_without_rendering()
    assert 4e5 in numbers(ax.get_xticklabels())


@pytest.mark.slow
def test_a_label_goes_with_its_numbers_when_the_scale_is_changed_afterwards():
    ax = drawn([1e2, 1e8], [0.0, 1.0], ("k_j", "N/m"), ("y", ""))
    assert ax.get_xlabel().endswith("[MN/m]")
    ax.set_xscale("log")
    ax.figure.draw_without_rendering()
    assert ax.get_xlabel().endswith("[N/m]")
    label_axes(ax, ("k_j", "N/m"), ("y", ""))
    ax.set_xscale("linear")
    label_axes(ax, ("k_j", "N/m"), ("y", ""))
    ax.figure.draw_without_rendering()
    assert ax.get_xlabel().endswith("[MN/m]")


def test_panels_that_share_an_axis_agree_on_its_unit():
    figure, (top, bottom) = new_figure(2, 1, sharex=True)
    top.plot([0.0, 5e4], [0.0, 1.0])
    show_axis(top.xaxis, "F", "N")
    show_axis(bottom.xaxis, "F", "N")
    top.set_xlabel("")
    figure.draw_without_rendering()
    assert bottom.get_xlabel() == "F [kN]"
    assert 20.0 in numbers(bottom.get_xticklabels())


def test_a_logarithmic_axis_keeps_its_unit():
    ax = new_figure()[1]
    ax.loglog([1e2, 1e8], [1.0, 2.0])
    show_axis(ax.xaxis, "k_j", "N/m")
    assert ax.get_xlabel() == r"k$_{\mathrm{j}}$ [N/m]"


@pytest.mark.parametrize(
    ("value", "unit", "digits", "text"),
    [(1e6, "N/m", 4, "1 MN/m"), (1e5, "N", 3, "100 kN"), (484766.7, "N", 7, "484766.7 N"), (1e-5, "m", 7, "0.01 mm"),
     (-6.6e-47, "rad", 7, "0 deg"), (-6.6e-47, "N", 7, "0 N"), (1e-9, "kg", 7, "1e-09 kg"), (0.5, "1", 7, "0.5")],
)
def test_values_are_shown_without_exponents_where_a_unit_does_it(value, unit, digits, text):
    assert show(value, unit, digits) == text


# -- nothing over anything ----------------------------------------------------------------------------------


def test_texts_that_meet_are_noticed():
    ax = new_figure()[1]
    ax.text(0.5, 0.5, "one")
    ax.text(0.52, 0.5, "other")
    assert ("one", "other") in meeting(ax.figure)


def test_numbers_that_would_touch_are_fewer():
    ax = new_figure(size=(2.4, 1.8))[1]
    ax.plot([4.0, 4.5], [0.0, 1.0])
    ax.xaxis.set_major_locator(MaxNLocator(6))
    ax.xaxis.set_major_formatter("{x:.7f}")
    ax.figure.draw_without_rendering()
    assert meeting(ax.figure, 2.0)
    spread_ticks(ax)
    assert not meeting(ax.figure, 2.0)
    assert len(numbers(ax.get_xticklabels())) >= 2


def test_a_legend_lies_where_nothing_is_drawn(cubic):
    ax = plot(cubic, x="mu", y="x", key=True)
    ax.figure.draw_without_rendering()
    box, ink = ax.get_legend().get_window_extent(), notes.drawn_points(ax)
    assert not np.any(np.all((ink > box.min) & (ink < box.max), axis=1))


def test_a_legend_without_room_stands_beside_the_axes(cubic):
    wave = np.linspace(0.0, 60.0, 4000)
    ax = new_figure()[1]
    ax.plot(wave, np.sin(wave))
    ax.legend([ax.lines[0]], ["wave"], loc="upper right").set_label(notes.LEGEND)
    width = ax.figure.get_size_inches()[0]
    notes.place_legend(ax, widen=True)
    ax.figure.draw_without_rendering()
    assert ax.get_legend().get_window_extent().x0 > ax.bbox.x1
    assert ax.get_legend().get_window_extent().x1 <= ax.figure.bbox.x1
    assert ax.figure.get_size_inches()[0] > width


def test_names_of_points_stay_off_the_legend(cubic):
    ax = plot(cubic, x="mu", y="x", key=True)
    assert not meeting(ax.figure)


def test_marks_of_two_kinds_at_one_place_are_both_seen():
    ax = new_figure()[1]
    ax.plot([0.0, 2.0], [0.0, 2.0])
    for kind in ("BP", "CP"):
        mark(ax, 1.0, 1.0, kind, f"{kind}1")
    mark(ax, 1.7, 1.7, "CP", "CP2")
    for _ in range(2):  # again after limits have changed
        notes.place_labels(ax)
    first, ring, alone = (line for line in ax.lines if line.get_label() == notes.POINT)
    assert first.get_markersize() == MARKERS["BP"][1]
    assert ring.get_markersize() == MARKERS["CP"][1] + 5.0
    assert ring.get_markerfacecolor() == "none"
    assert alone.get_markersize() == MARKERS["CP"][1]
    assert not meeting(ax.figure)


def test_dashes_of_curves_that_coincide_stay_dashes():
    """Of the pixels along the line, those in between the upper curve's dashes are white, not the lower one's colour."""
    ax = new_figure()[1]
    ax.axis("off")
    xs = np.linspace(0.0, 1.0, 50)
    for color, shift in (("#ff0000", 0.031), ("#0000ff", 0.0)):  # dashes begin at different places
        draw_curve(ax, xs + shift, np.zeros(50), [("unstable", 0, 49)], color=color, width=3.0)
    ax.set(xlim=(0.2, 0.8), ylim=(-1, 1))
    ax.figure.canvas.draw()
    image = np.asarray(ax.figure.canvas.buffer_rgba())
    row = image[image.shape[0] - round(ax.transData.transform((0.5, 0.0))[1]), :, :3].astype(int)
    assert (row.sum(axis=1) > 750).sum() > 0.2 * ax.bbox.width
    assert (row[:, 0] - row[:, 2] > 100).sum() < 0.05 * ax.bbox.width


@pytest.mark.long
def test_the_curve_of_the_four_bar_linkage_looks_smooth():
    (branch,) = [p for p in mc.load_study("four_bar").plans if p.name == "equilibria"]
    curve = mc.continue_equilibria(mc.Mechanism.from_xml("four_bar"), "M", branch.bounds, **branch.settings)
    ax = curve.plot(y="crank")
    ax.figure.draw_without_rendering()
    for line in (line for line in ax.lines if line.get_label() == "_curve"):
        steps = np.diff(ax.transData.transform(line.get_xydata()), axis=0)
        turns = np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))
        assert np.degrees(np.abs(turns).max()) < 12.0
        assert np.hypot(*steps.T).max() < 0.02 * ax.bbox.width
