"""Draw the pictures of the README and the documentation: python docs/make_images.py."""

from pathlib import Path

import numpy as np

import mjcont as mc
from mjcont.drawing.notes import place_labels
from mjcont.drawing.plotting import mark, new_figure, save_figure, set_panel_title

OUT = Path(__file__).parent / "images"


def overcentre() -> None:
    """Draw the overcentre mechanism, and a landing gear that locks with its three folds and their locus."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0}, ds_max=0.02)
    gear = mc.Mechanism.from_xml("nose_gear_locking")
    bounds = (3e5, 6e5)
    above = mc.continue_equilibria(gear, "F_ret", bounds, {"F_ret": 4e5}, keyframe="uplock_above", ds_max=0.02)
    below = mc.continue_equilibria(gear, "F_ret", bounds, {"F_ret": 5.5e5}, keyframe="uplock_below", ds_max=0.02)
    locus = mc.continue_special(above.point("LP1"), "F_ul", bounds=(-1000, 0), ds_max=0.02)
    figure, axes = new_figure(1, 3, (11.0, 3.6))
    mc.plot(branch, x="F", y="theta_1", ax=axes[0])
    mc.plot(above, below, x="F_ret", y="theta_ov", ax=axes[1], labels=False, legend=False)
    axes[1].set_xticks(np.linspace(*bounds, 4))
    names = zip([above.point("LP1"), *reversed(below.of_kind("LP"))], ("FP1", "FP2", "FP3"), strict=True)
    for fold, name in names:
        mark(axes[1], fold["F_ret"], np.degrees(fold["theta_ov"]), "LP", name)
    mc.plot(locus, x="F_ul", y="F_ret", ax=axes[2])
    titles = ("overcentre mechanism", "nose landing gear that locks", "locus of its folds FP1 and FP2")
    for ax, title in zip(axes, titles, strict=True):
        set_panel_title(ax, title)
        place_labels(ax)
    save_figure(figure, OUT / "overview.png", dpi=110)


def poses() -> None:
    """Draw both mechanisms at their special points."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0})
    above, below = branch.point("LP2"), branch.point("LP1")
    shown = {"fold LP2": above, "overcentre": branch.at(theta_1=0.0)[0], "fold LP1": below}
    save_figure(mc.draw_poses(mechanism, shown, cols=3), OUT / "overcentre_poses.png", dpi=110)
    gear = mc.Mechanism.from_xml("nose_gear")
    slices = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")
    locus = mc.continue_special(slices.point("LP1"), "F_ul", bounds=(-1000, 0))
    shown = {
        "downlock": "downlock_below",
        "retracted, fold LP1": slices.point("LP1"),
        "cusp CP1": locus.point("CP1"),
        "uplock": "uplock_below",
    }
    save_figure(mc.draw_poses(gear, shown, cols=4), OUT / "nose_gear_poses.png", dpi=110)


def hysteresis() -> None:
    """Draw the overcentre mechanism's hysteresis loop with its jumps, and the energy barriers of its rests."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(0, 40), start={"F": 40.0}, ds_max=0.02)
    figure, (left, right) = new_figure(1, 2, (8.4, 3.6))
    mc.plot(branch, mc.load_path(branch, "F", [40, 0, 40]), x="F", y="theta_1", ax=left)
    mc.barrier_along(branch, search=False).plot(right)
    set_panel_title(left, "hysteresis loop")
    set_panel_title(right, "energy barrier between the folds")
    place_labels(left)
    save_figure(figure, OUT / "hysteresis.png", dpi=110)


def unlocking() -> None:
    """Animate the nose landing gear as retraction locks it and the unlock actuator opens it again."""
    gear = mc.Mechanism.from_xml("nose_gear")
    legs = [{"F_ret": 4e5, "F_ul": 0.0}, {"F_ret": 5.5e5}, {"F_ul": -600.0}, {"F_ret": 4e5}]
    path = mc.load_path(gear, legs, keyframe="uplock_above")
    mc.animate(path, OUT / "unlocking.gif", "F_ret", "theta_ov", fps=20, size=(720, 340))


def flutter() -> None:
    """Draw the rods' flutter over their rest, its cycles, and the resonance of a shaken truss."""
    rods = mc.Mechanism.from_xml("ziegler_rods")
    rest = mc.continue_equilibria(rods, "P", bounds=(1.4, 2.2), start={"P": 1.4})
    cycles = mc.continue_cycles(rest.point("HB1"))
    truss = mc.Mechanism.from_xml("von_mises_truss")
    response = mc.continue_response(
        truss, "frequency", (2.5, 5.5), {"P": mc.Harmonic(15.0)}, {"joint:z.damping": 2.0}, ds_max=0.05
    )
    figure, axes = new_figure(1, 3, (11.0, 3.4))
    mc.plot(rest, cycles, x="P", y="q1", ax=axes[0])
    mc.plot_orbits(cycles, x="q1", y="q2", n=6, ax=axes[1])
    mc.plot(response, x="frequency", y="z.amplitude", ax=axes[2])
    titles = ("rods under a follower load flutter", "their cycles", "a truss that is shaken")
    for ax, title in zip(axes, titles, strict=True):
        set_panel_title(ax, title)
        place_labels(ax)
    save_figure(figure, OUT / "flutter.png", dpi=110)


if __name__ == "__main__":
    OUT.mkdir(exist_ok=True)
    flutter()
    hysteresis()
    overcentre()
    poses()
    unlocking()
