"""Bifurcation diagrams: what is drawn, from branches of systems whose equilibria are known in closed form."""

import subprocess
import sys

import numpy as np
import pytest

import mjcont as mc
from mjcont.drawing import notes, plotting
from mjcont.drawing.notes import place_labels
from mjcont.drawing.plotting import LINE_STYLES, new_figure, plot, save_figure, split_by_stability


@pytest.fixture(scope="module")
def cusp():
    """x' = mu + x - x^3: folds at x = -1/sqrt(3) and 1/sqrt(3), unstable between them."""
    field = mc.VectorField(
        lambda u, p: p["mu"] + p["lam"] * u - u**3, [-1.5], {"mu": -1.0, "lam": 1.0}, names=["x"], units={"mu": "rad"}
    )
    return mc.continue_equilibria(field, "mu", bounds=(-1, 1))


def curves(ax):
    return [line for line in ax.lines if line.get_label() == "_curve"]


def test_stable_pieces_are_solid_and_unstable_ones_dashed(cusp):
    ax = plot(cusp, x="mu", y="x")
    styles = ["solid" if line.get_linestyle() == "-" else "dashed" for line in curves(ax)]
    assert styles == ["solid", "dashed", "solid"]
    assert len({line.get_color() for line in curves(ax)}) == 1


def test_pieces_meet_at_the_folds_without_a_gap(cusp):
    first, second, third = (line.get_xydata() for line in curves(plot(cusp, x="mu", y="x")))
    assert np.array_equal(first[-1], second[0])
    assert np.array_equal(second[-1], third[0])
    assert abs(second[0, 1]) == pytest.approx(1 / np.sqrt(3), abs=1e-9)
    assert len(first) + len(second) + len(third) - 2 == len(cusp)


@pytest.mark.parametrize(
    ("words", "special", "expected"),
    [
        ("ss*uu", {2}, [("stable", 0, 2), ("unstable", 2, 4)]),
        ("ss*ss", {2}, [("stable", 0, 4)]),
        ("ssmss", set(), [("stable", 0, 4)]),
        ("smmmu", set(), [("stable", 0, 1), ("marginal", 1, 3), ("unstable", 3, 4)]),
        ("ssuu", set(), [("stable", 0, 1), ("unstable", 1, 3)]),
        ("s**s", {1, 2}, [("stable", 0, 1), ("unstable", 1, 2), ("stable", 2, 3)]),
        ("*uu", {0}, [("unstable", 0, 2)]),
        ("s*mmm", {1}, [("stable", 0, 1), ("marginal", 1, 4)]),
        ("s", set(), []),
    ],
)
def test_pieces_of_a_curve(words, special, expected):
    names = {"s": "stable", "u": "unstable", "m": "marginal", "*": "marginal"}
    assert split_by_stability([names[w] for w in words], special) == expected


def test_angles_are_drawn_in_degrees_unless_told_otherwise(cusp):
    turned, plain = plot(cusp, x="mu", y="x"), plot(cusp, x="mu", y="x", degrees=False)
    assert turned.get_xlabel() == "μ [deg]"
    assert plain.get_xlabel() == "μ [rad]"
    assert turned.get_ylabel() == "x"
    assert np.allclose(curves(turned)[0].get_xdata(), np.degrees(curves(plain)[0].get_xdata()))


def test_a_line_is_cut_where_an_angle_jumps_by_a_turn(cusp):
    ax = new_figure()[1]
    ys = np.array([3.0, 3.1, -3.1, -3.0])
    plotting.draw_curve(ax, np.arange(4.0), ys, [("stable", 0, 3)], color="black", breaks=[1])
    assert [list(line.get_ydata()) for line in curves(ax)] == [[3.0, 3.1], [-3.1, -3.0]]


def test_special_points_are_labelled_and_can_be_renamed_or_left_bare(cusp):
    def texts(**options):
        return [t.get_text() for t in plot(cusp, x="mu", y="x", **options).texts]

    assert texts() == ["LP1", "LP2"]
    assert texts(labels={"LP1": "FP2"}) == ["FP2", "LP2"]
    assert texts(labels=False) == []


def test_labels_sit_off_the_curve_and_off_each_other(cusp):
    ax = plot(cusp, cusp, x="mu", y="x")
    ax.figure.draw_without_rendering()
    place_labels(ax)
    boxes = [t.get_window_extent() for t in ax.texts]
    ink = notes.drawn_points(ax)
    for i, box in enumerate(boxes):
        assert not any(box.contains(*p) for p in ink)
        assert not any(box.overlaps(other) for other in boxes[i + 1 :])


def test_markers_of_all_kinds_differ_in_shape():
    shapes = [shape for shape, _ in plotting.MARKERS.values()]
    assert len(set(shapes)) == len(shapes)


@pytest.mark.parametrize("kind", sorted(plotting.MARKERS))
def test_the_marker_of_every_kind_is_seen(kind):
    ax = new_figure(size=(1.0, 1.0))[1]
    ax.axis("off")
    plotting.mark(ax, 0.5, 0.5, kind)
    ax.figure.canvas.draw()
    image = np.asarray(ax.figure.canvas.buffer_rgba())[..., :3]
    assert np.count_nonzero(image.max(axis=-1) < 140) >= 5


@pytest.mark.slow
def test_several_branches_are_told_apart_by_colour_and_by_the_parameter_that_differs(cusp):
    other = mc.continue_equilibria(cusp.problem, "mu", bounds=(-1, 1), start={"lam": 0.5}, state=[-1.2])
    ax = plot(cusp, other, x="mu", y="x")
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["lam = 1", "lam = 0.5"]
    assert len({line.get_color() for line in curves(ax)}) == 2


def test_the_legend_explains_the_line_styles_on_request(cusp):
    ax = plot(cusp, x="mu", y="x", legend=True)
    assert [t.get_text() for t in ax.get_legend().get_texts()][-2:] == ["stable", "unstable"]
    assert plot(cusp, x="mu", y="x").get_legend() is None


def test_a_second_call_on_the_same_axes_takes_the_next_colour(cusp):
    ax = plot(cusp, x="mu", y="x")
    plot(cusp, x="mu", y="x", ax=ax)
    assert list(dict.fromkeys(line.get_color() for line in curves(ax))) == list(plotting.COLORS[:2])


def test_a_parameter_held_fixed_can_be_an_axis(cusp):
    ax = plot(cusp, x="lam", y="x")
    assert set(curves(ax)[0].get_xdata()) == {1.0}


def test_an_unknown_column_is_an_error_that_lists_the_columns_and_draws_nothing(cusp):
    ax = new_figure()[1]
    with pytest.raises(mc.NameLookupError, match=r"unknown column 'y'.*lam, mu, x"):
        plot(cusp, x="mu", y="y", ax=ax)
    assert len(ax.lines) == 0


@pytest.mark.parametrize(
    ("branches", "options", "message"),
    [
        (0, {}, "at least one branch"),
        (1, {"legend": ["a", "b"]}, r"a name for each branch \(1 in all\)"),
        (1, {"legend": "a"}, "must be a list"),
    ],
)
def test_wrong_arguments_are_explained(cusp, branches, options, message):
    with pytest.raises(mc.MjcontError, match=message):
        plot(*[cusp] * branches, x="mu", y="x", **options)


def test_lists_and_diagrams_are_drawn_like_their_curves(cusp):
    alone = plot(cusp, x="mu", y="x")
    for given in ([cusp], mc.Diagram([cusp])):
        assert len(plot(given, x="mu", y="x").lines) == len(alone.lines)


def test_what_is_no_curve_is_refused_with_the_way_to_write_it(cusp):
    with pytest.raises(mc.MjcontError, match="one by one.*got a Point"):
        plot(cusp[0], x="mu", y="x")


def test_a_key_explains_line_styles_and_markers(cusp):
    words = [t.get_text() for t in plot(cusp, x="mu", y="x", key=True).get_legend().get_texts()]
    assert {"stable", "unstable", "LP: fold"} <= set(words)


def test_a_branch_is_short_in_a_console_and_its_rows_are_points(cusp):
    assert len(repr(cusp)) < 300
    assert "<pre>" in cusp._repr_html_()
    assert {"mu", "x"} <= set(cusp._ipython_key_completions_())
    assert (cusp[0]["mu"], cusp[-1]["mu"]) == (cusp["mu"][0], cusp["mu"][-1])
    assert sum(1 for _ in cusp) == len(cusp)
    for wrong in (len(cusp), 1.5, ["mu"]):
        with pytest.raises(mc.NameLookupError, match="rows"):
            cusp[wrong]


def test_a_branch_draws_itself_with_a_title_and_wrong_units_are_refused(cusp):
    assert cusp.plot(title="cusp").get_title(loc="left") == "cusp"
    with pytest.raises(mc.ParameterError, match="unknown unit 'kn_'"):
        cusp.plot(units="kn_")


def test_an_axis_in_another_unit_has_round_numbers_and_says_so():
    branch = mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F", (-50, 50), start={"F": 50.0})
    ax = branch.plot(y="height", units=("kN", "in"))
    ax.figure.canvas.draw()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("F [kN]", "height [in]")
    assert {t.get_text() for t in ax.get_yticklabels()} >= {"0", "20", "40"}


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_a_figure_is_written_with_the_same_bytes_every_time(cusp, tmp_path, suffix):
    files = [save_figure(plot(cusp, x="mu", y="x").figure, tmp_path / f"{i}.{suffix}") for i in range(2)]
    assert files[0].read_bytes() == files[1].read_bytes()
    assert len(list(tmp_path.iterdir())) == 2


def test_an_unknown_suffix_is_an_error_that_lists_the_formats(cusp, tmp_path):
    with pytest.raises(mc.MjcontError, match=r"\.png, \.svg, \.pdf"):
        save_figure(new_figure()[0], tmp_path / "a.bmp")


@pytest.mark.slow
def test_plotting_needs_neither_pyplot_nor_matplotlib_until_it_draws():
    code = (
        "import sys, mjcont, mjcont.drawing.plotting as p; assert 'matplotlib' not in sys.modules\n"
        "p.new_figure(); assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_line_styles_differ():
    assert len({str(style) for style in LINE_STYLES.values()}) == 3


@pytest.mark.slow
def test_poses_of_several_mechanisms_share_a_figure_and_may_show_a_part_of_the_plane(overcentre):
    figure, axes = new_figure(1, 2)
    gear = mc.Mechanism.from_xml("nose_gear_locking")
    mc.draw_poses(overcentre, {"above": overcentre.qpos0}, axes=axes[:1])
    mc.draw_poses(gear, {"links": "uplock_above"}, axes=axes[1:], window=((-1.75, -0.75), (0.25, 0.85)))
    assert [ax.get_title(loc="left") for ax in axes] == ["above", "links"]
    assert axes[1].get_xlim() == pytest.approx((-1.75, 0.25))
    assert axes[1].get_ylim() == pytest.approx((-0.75, 0.85))
    with pytest.raises(mc.MjcontError, match="draw_poses needs an axes for each of 2 poses, got 1"):
        mc.draw_poses(gear, {"a": "uplock_above", "b": "uplock_below"}, axes=axes[:1])
