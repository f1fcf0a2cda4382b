"""Pictures of mechanisms: what is drawn equals the kinematics written out here, and stands where it can be read."""

from itertools import product

import numpy as np
import pytest
from problems.marks import long

import mjcont as mc
from mjcont.drawing.picture import picture
from mjcont.drawing.plotting import plot
from mjcont.drawing.poses import add_poses, draw, draw_poses

GEARS = ("nose_gear", "nose_gear_full")
KEYFRAMES = ("downlock_above", "downlock_below", "uplock_above", "uplock_below")

HEAD = '<mujoco model="{name}"><option gravity="0 0 -9.81"><flag contact="disable"/></option><worldbody>'
SLIDER = (
    HEAD.format(name="slider")
    + """
      <geom type="plane" size="2 1 1" pos="0 -0.3 0" zaxis="0 1 0"/>
      <body name="crank"><joint name="turn" axis="0 0 1"/>
        <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" rgba="1 0 0 1"/>
        <site name="end" pos="0.5 0 0"/></body>
      <body name="block" pos="1 0 0"><joint name="slide" type="slide" axis="1 0 0"/>
        <geom type="ellipsoid" size="0.1 0.05 0.05"/></body>
    </worldbody>
    <tendon><spatial name="line" stiffness="{stiffness}"><site site="end"/><site site="far"/></spatial></tendon>
    <actuator><motor name="pull" tendon="line"/><motor name="push" joint="slide"/>
      <motor name="torque" joint="turn" gear="-2"/>
      <general name="follower" site="end" gear="0 1 0 0 0 0"/></actuator></mujoco>"""
).replace("<body name=\"block\"", '<site name="far" pos="2 0.5 0"/><body name="block"')


def slider(stiffness=0.0):
    return mc.Mechanism.from_xml(SLIDER.replace("{stiffness}", str(stiffness)))


def unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def link(shown, body):
    """The longest segment that is drawn for a body, (2, 2)."""
    segments = [s.points for s in shown.shapes if s.body == body and len(s.points) == 2]
    return max(segments, key=lambda p: np.linalg.norm(p[1] - p[0]))


def pins(shown):
    return {p.name: p for p in shown.pins}


def forces(shown):
    return {f.name: f for f in shown.forces}


def random_states(mechanism, count=10):
    rng = np.random.default_rng(7)
    return mechanism.qpos0 + rng.uniform(-1.0, 1.0, (count, mechanism.nq))


@pytest.fixture(scope="module")
def fold(overcentre_branch):
    return overcentre_branch().point("LP2")


# -- what is drawn -------------------------------------------------------------------------------------------


def test_links_of_the_overcentre_end_where_the_kinematics_say(overcentre):
    for state in random_states(overcentre):
        shown = picture(overcentre, state)
        for body, (x, z, angle) in zip(("link_1", "link_2"), state.reshape(2, 3), strict=True):
            ends = np.array([x, z]) + np.outer([-0.5, 0.5], unit(angle))
            assert link(shown, body) == pytest.approx(ends, abs=1e-12)


def test_links_and_pins_of_the_nose_gear_end_where_the_kinematics_say():
    gear = mc.Mechanism.from_xml("nose_gear")
    for state in random_states(gear):
        theta_1, theta_2, *turns = state
        angles = theta_2 + np.cumsum([0.0, *turns])
        a = np.array([-1.540, 0.007])
        b = a + 0.843 * unit(angles[0])
        e = b + 0.439 * unit(angles[2])
        c, h = b + 1.114 * unit(angles[1]), e + 0.439 * unit(angles[3])
        shown = picture(gear, state)
        for body, ends in (
            ("upper_sidestay", (a, b)),
            ("lower_sidestay", (b, c)),
            ("locklink_B", (b, e)),
            ("locklink_H", (e, h)),
        ):
            assert link(shown, body) == pytest.approx(np.array(ends), abs=1e-9)
        found = pins(shown)
        for name, place in (("A", a), ("B", b), ("C", c), ("E", e), ("H", h)):
            assert found[name].at == pytest.approx(place, abs=1e-9)
        wheel = next(s for s in shown.shapes if s.body == "wheels" and s.radius == 0.33)
        assert wheel.points == pytest.approx(2.5 * unit(theta_1 - np.pi / 2)[None], abs=1e-12)


def test_the_outline_of_a_link_lies_a_radius_from_its_axis(overcentre):
    shown = picture(overcentre)
    shape = next(s for s in shown.shapes if s.body == "link_1" and len(s.points) == 2)
    start, end = shape.points
    along = np.clip((shape.outline - start) @ (end - start) / np.sum((end - start) ** 2), 0.0, 1.0)
    away = np.linalg.norm(shape.outline - start - along[:, None] * (end - start), axis=1)
    assert away == pytest.approx(np.full(len(away), 0.025), abs=1e-12)


def test_pins_have_letters_and_tell_bushes_from_rigid_pins(overcentre):
    kinds = {p.name: p.elastic for p in picture(overcentre).pins}
    assert kinds == {"A": True, "B": True, "C": True}
    tree = picture(mc.Mechanism.from_xml("overcentre_tree"))
    assert {p.name: p.elastic for p in tree.pins} == kinds
    gear = {p.name: p.elastic for p in picture(mc.Mechanism.from_xml("nose_gear")).pins}
    assert {n: e for n, e in gear.items() if n in "ABCEH"} == {"A": False, "B": False, "E": False, "C": True, "H": True}
    full = {p.name: p.elastic for p in picture(mc.Mechanism.from_xml("nose_gear_full")).pins}
    assert full == dict.fromkeys("DABECH", True)


@pytest.mark.slow
def test_the_gap_of_a_bush_is_drawn_to_both_its_sides(overcentre_branch):
    point = overcentre_branch(k_j=20.0).point("LP2")
    found = pins(picture(point.problem, point))
    x, z, angle = point.state[:3]
    assert found["B"].other == pytest.approx([x, z] + 0.5 * unit(angle), abs=1e-12)
    assert found["A"].other == pytest.approx([0.0, 0.0], abs=1e-12)
    assert np.linalg.norm(found["A"].at) > 0.05
    assert found["C"].other == pytest.approx([found["C"].at[0], 0.0], abs=1e-12)


def test_a_stiff_tendon_is_a_spring_and_one_that_only_shows_it_is_not(overcentre):
    (spring,) = picture(overcentre).springs
    assert (spring.name, spring.coil) == ("spring", 1)
    assert spring.path[1:3] == pytest.approx(np.array([[0.75, 1.0], [0.25, 1.0]]) * [1.0, np.sqrt(3.0) / 4.0])
    assert picture(overcentre, inputs={"k_sp": 0.0}).springs == []


def test_a_spatial_tendon_is_a_spring_or_without_stiffness_a_cable():
    (cable,) = picture(slider()).springs
    (spring,) = picture(slider(stiffness=100.0)).springs
    assert (cable.coil, spring.coil) == (None, 0)
    assert spring.path == pytest.approx(np.array([[0.5, 0.0], [2.0, 0.5]]))


def test_forces_point_as_their_values_say(overcentre, overcentre_branch, fold):
    assert forces(picture(overcentre))["F"].direction == pytest.approx([0.0, 1.0])
    assert forces(picture(overcentre, fold))["F"].at == pytest.approx(fold.state[:2])
    pushed_down = overcentre_branch().at(F=-20.0)[0]
    assert forces(picture(overcentre, pushed_down))["F"].direction == pytest.approx([0.0, -1.0])
    assert picture(overcentre, inputs={"F": 0.0}).forces == []
    assert picture(overcentre, overcentre_branch().at(F=0.0)[0], inputs={"F": 0.0}).forces == []


def test_a_force_on_a_tendon_is_a_pair_that_pulls_where_negative():
    gear = mc.Mechanism.from_xml("nose_gear")
    for value in (300.0, -300.0):
        pair = [f for f in picture(gear, "uplock_above", inputs={"F_ul": value}).forces if f.name == "F_ul"]
        first, second = pair
        outward = (first.at - second.at) / np.linalg.norm(first.at - second.at)
        assert np.sign(value) * outward == pytest.approx(first.direction)
        assert first.direction == pytest.approx(-second.direction)
        assert first.into == second.into == (value < 0)


def test_forces_on_hinges_are_moments_and_follow_sites():
    found = forces(picture(slider(), np.array([np.pi / 2, 0.3])))
    assert found["torque"].turn == -1
    assert found["push"].direction == pytest.approx([1.0, 0.0])
    assert found["push"].at == pytest.approx([1.3, 0.0])
    assert found["follower"].direction == pytest.approx([-1.0, 0.0])
    assert found["follower"].at == pytest.approx([0.0, 0.5])


def test_gravity_is_shown_where_it_is_tilted():
    gear = mc.Mechanism.from_xml("nose_gear")
    assert "g" not in forces(picture(gear))
    tilted = forces(picture(gear, inputs={"gravity_angle": np.deg2rad(-20.0)}))["g"]
    assert tilted.direction == pytest.approx([np.sin(np.deg2rad(20.0)), -np.cos(np.deg2rad(20.0))])


def test_a_body_without_geoms_is_drawn_from_its_hinge_to_its_sites(pendulum_xml):
    shown = picture(mc.Mechanism.from_xml(pendulum_xml()), np.array([0.3]))
    assert link(shown, "rod") == pytest.approx(np.array([[0.0, 0.0], unit(0.3 + np.pi / 2)]))
    assert shown.pins[0].fixed


def test_geoms_of_hidden_groups_and_transparent_ones_are_left_out(pendulum_xml):
    body = '<geom type="sphere" size="0.1" group="{}" rgba="1 0 0 {}" contype="0" conaffinity="0"/>'
    for group, alpha, count in ((0, 1, 1), (3, 1, 0), (0, 0, 0)):
        shown = picture(mc.Mechanism.from_xml(pendulum_xml(body=body.format(group, alpha))))
        assert sum(len(s.points) == 1 for s in shown.shapes) == count


def test_an_ellipsoid_and_a_mesh_are_drawn_by_their_outline(pendulum_xml):
    block = next(s for s in picture(slider()).shapes if s.body == "block")
    assert np.ptp(block.outline, axis=0) == pytest.approx([0.2, 0.1])
    mesh = '<asset><mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/></asset>'
    body = '<geom type="mesh" mesh="wedge" contype="0" conaffinity="0"/>'
    shown = picture(mc.Mechanism.from_xml(pendulum_xml(body=body, rest=mesh)))
    assert np.ptp(shown.shapes[0].outline, axis=0) == pytest.approx([1.0, 1.0], abs=1e-7)


# -- the plane -----------------------------------------------------------------------------------------------


def test_the_plane_follows_from_the_hinges(overcentre):
    assert link(picture(slider(), np.array([np.pi / 6, 0.0])), "crank")[1] == pytest.approx(0.5 * unit(np.pi / 6))
    assert link(picture(overcentre), "link_1")[1] == pytest.approx(unit(np.pi / 3))
    mirrored = link(picture(overcentre, plane="-xz"), "link_1")[1]
    assert mirrored == pytest.approx(unit(np.pi / 3) * [-1.0, 1.0])


@pytest.mark.parametrize(
    ("joints", "named"),
    [
        ('<joint name="yaw" axis="0 0 1"/><joint name="hip" axis="0 1 0"/>', "hip"),
        ('<joint name="hip" axis="0 1 0"/><joint name="side" type="slide" axis="0 1 0"/>', "side"),
        ('<joint name="float" type="free"/>', "float"),
        ('<joint name="socket" type="ball"/>', "socket"),
    ],
)
def test_a_model_that_does_not_move_in_a_plane_is_refused(joints, named):
    body = f'<body>{joints}<geom size="0.1" mass="1"/></body></worldbody></mujoco>'
    model = mc.Mechanism.from_xml(HEAD.format(name="robot") + body)
    message = f"draw shows planar models, and 'robot' does not move in one plane: see joint '{named}'"
    with pytest.raises(mc.MjcontError, match=message):
        draw(model)


def test_a_plane_that_does_not_fit_is_refused(overcentre):
    with pytest.raises(mc.MjcontError, match="'overcentre' does not move in the plane 'xy': see joint"):
        draw(overcentre, plane="xy")
    with pytest.raises(mc.MjcontError, match="such as 'xz' or '-xz', got 'side'"):
        draw(overcentre, plane="side")


# -- drawing -------------------------------------------------------------------------------------------------


def names(ax, kind=""):
    return [t.get_text() for t in ax.texts if t.get_text() and (not kind or t.get_label() == f"_{kind}")]


def rectangles(ax):
    boxes = [t.get_window_extent() for t in ax.texts if t.get_text()]
    return [(b.min, b.max) for b in boxes]


@pytest.mark.slow
@pytest.mark.parametrize(("model", "keyframe"), [
    *zip(GEARS, KEYFRAMES[::3], strict=True), *(long(g, k) for g, k in product(GEARS, KEYFRAMES[1:3]))
])
def test_labels_do_not_overlap_and_stay_inside(model, keyframe):
    ax = draw(mc.Mechanism.from_xml(model), keyframe)
    boxes = rectangles(ax)
    for i, (low, high) in enumerate(boxes):
        assert np.all(low >= ax.bbox.min) and np.all(high <= ax.bbox.max)
        assert not any(np.all(low < other[1]) and np.all(other[0] < high) for other in boxes[:i])


@pytest.mark.slow
def test_everything_is_named_unless_told_otherwise(overcentre):
    assert sorted(names(draw(overcentre))) == ["A", "B", "C", "F", "link 1", "link 2", "spring"]
    assert names(draw(overcentre, labels=False)) == []
    assert sorted(names(draw(overcentre, labels=("pins", "forces")))) == ["A", "B", "C", "F"]
    renamed = names(draw(overcentre, labels={"link_1": "crank", "spring": ""}))
    assert "crank" in renamed and "spring" not in renamed and "A" in renamed


def test_an_unknown_kind_of_label_says_which_there_are(overcentre):
    with pytest.raises(mc.NameLookupError, match="unknown kind of label 'pin'. Did you mean pins"):
        draw(overcentre, labels=("pin",))


@pytest.mark.slow
def test_a_pose_that_is_none_is_refused(overcentre, overcentre_branch):
    with pytest.raises(mc.NameLookupError, match="unknown keyframe 'up'"):
        draw(overcentre, "up")
    with pytest.raises(mc.ParameterError, match=r"state must have shape \(6,\)"):
        draw(overcentre, np.zeros(5))
    with pytest.raises(mc.MjcontError, match="pose must be a Point, an array of numbers or a string, got the Branch"):
        draw(overcentre, overcentre_branch())
    with pytest.raises(mc.MjcontError, match="draw: mechanism must be a Mechanism, got the VectorField"):
        draw(mc.VectorField(lambda u, p: u, [0.0], {"a": 1.0}))


def test_lengths_are_true_and_axes_are_hidden(overcentre):
    ax = draw(overcentre)
    assert ax.get_aspect() == 1.0
    assert not ax.axison


@pytest.mark.slow
def test_a_second_pose_in_one_colour_joins_the_first(overcentre, fold):
    ax = draw(overcentre, color="0.8", labels=False)
    assert not any(line.get_label() == "_force" for line in ax.lines)
    draw(overcentre, fold, ax)
    assert ax.get_xlim()[0] < -0.1 and ax.get_ylim()[1] > 0.87
    assert sum(line.get_label() == "_spring" for line in ax.lines) == 2


def test_poses_in_a_row_have_one_scale_and_their_titles(overcentre, overcentre_branch):
    points = {p.label: p for p in overcentre_branch().special_points}
    figure = draw_poses(overcentre, points, cols=3)
    first, second = figure.axes
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["LP1", "LP2"]
    assert first.get_xlim() == second.get_xlim() and first.get_ylim() == second.get_ylim()
    assert sorted(names(first)) == ["A", "B", "C", "F"]
    with pytest.raises(mc.MjcontError, match="draw_poses needs at least one pose"):
        draw_poses(overcentre, {})


# -- poses in a diagram --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_poses_stand_where_the_diagram_is_empty(overcentre_branch):
    branch = overcentre_branch()
    ax = plot(branch, x="F", y="theta_1")
    limits = ax.get_xlim(), ax.get_ylim()
    insets = add_poses(ax, branch, ("LP1", "LP2"), x="F", y="theta_1")
    ax.figure.draw_without_rendering()
    assert (ax.get_xlim(), ax.get_ylim()) == limits
    curve = ax.transData.transform(np.column_stack([branch["F"], np.degrees(branch["theta_1"])]))
    boxes = [inset.get_window_extent() for inset in insets]
    for box in boxes:
        assert ax.bbox.x0 <= box.x0 and box.x1 <= ax.bbox.x1 and ax.bbox.y0 <= box.y0 and box.y1 <= ax.bbox.y1
        assert not np.any(np.all((curve > box.min) & (curve < box.max), axis=1))
    assert not boxes[0].overlaps(boxes[1])
    assert [names(inset) for inset in insets] == [["LP1"], ["LP2"]]
    assert max(box.width for box in boxes) == pytest.approx(0.2 * ax.bbox.width, rel=1e-6)


@pytest.mark.slow
def test_each_pose_has_a_line_to_its_point(overcentre_branch):
    branch = overcentre_branch()
    ax = plot(branch, x="F", y="theta_1")
    point = branch.at(theta_1=0.0)[0]
    add_poses(ax, {"overcentre": point}, x="F", y="theta_1")
    (leader,) = [t for t in ax.texts if not t.get_text()]
    assert leader.xy == pytest.approx((point["F"], 0.0))


def test_points_outside_the_limits_have_no_pose(overcentre_branch):
    ax = plot(overcentre_branch(), x="F", y="theta_1")
    ax.set_ylim(0, 90)
    assert [names(inset) for inset in add_poses(ax, overcentre_branch(), x="F", y="theta_1")] == [["LP2"]]


def test_poses_can_be_renamed_and_unknown_ones_say_which_there_are(overcentre_branch):
    branch = overcentre_branch()
    ax = plot(branch, x="F", y="theta_1")
    (inset,) = add_poses(ax, branch, {"LP1": "FP2"}, x="F", y="theta_1")
    assert names(inset) == ["FP2"]
    with pytest.raises(mc.NameLookupError, match="unknown special point 'LP9'. Did you mean LP"):
        add_poses(ax, branch, ("LP9",), x="F", y="theta_1")
    with pytest.raises(mc.NameLookupError, match="unknown parameter or observable 'G'"):
        add_poses(ax, branch, x="G", y="theta_1")


def test_a_point_without_a_mechanism_has_no_pose():
    field = mc.VectorField(lambda u, p: p["mu"] + u - u**3, [-1.5], {"mu": -1.0}, names=["x"])
    branch = mc.continue_equilibria(field, "mu", bounds=(-1, 1))
    with pytest.raises(mc.MjcontError, match="a point without a Mechanism has no pose to draw"):
        add_poses(plot(branch, x="mu", y="x"), branch, x="mu", y="x")
