"""Figure 10: all equilibria of the nose gear in straight and level flight.

Retraction force, overcentre angle theta_ov and strut angle theta_1 without unlock force: (a) theta_ov against F_ret,
(b) theta_1 against theta_ov; (1) the first gear, nose_gear, (2) the gear that locks, nose_gear_locking. Light grey:
above overcentre; dark grey: below. Solid: stable; dashed: unstable; circles: folds. Found from the four assembled poses
at several retraction forces, and from the deployed gear with its locklinks held near in line while the retraction force
grows.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from _gear import (
    DS_MAX,
    FIRST,
    LOCKING,
    NAMES,
    STARTS,
    Slice,
    add_legend,
    angle_of,
    draw_sides,
    load_case,
    wrapped,
)

import mjcont as mc
from mjcont.drawing.axes import axis_label
from mjcont.drawing.plotting import mark, new_figure, save_figure, set_panel_title
from mjcont.motion.histories import simulate
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins

BOUNDS = (0.0, 1e6)
KEYFRAMES = ("uplock_above", "uplock_below", "downlock_above", "downlock_below")
DEPLOYED = np.radians(-10.0)


def main(out: Path) -> list[Finding]:
    """Draw the figure into a folder and return its findings."""
    found = [_equilibria(mc.Mechanism.from_xml(name)) for name in (FIRST, LOCKING)]
    (first, _), (locking, _) = found
    _draw([near for near, _ in found], out)
    write_twins(out, "fig10", *(b for near, _ in found for b in near.branches))
    return [
        *(_curves(near, count) for near, count in found),
        *(_stability(near) for near, _ in found),
        *(_uppermost(near) for near, _ in found),
        *(_beyond(near) for near, _ in found),
        _lower_fold(first, locking),
        _stretched(_curve_of(first.branches, first.fold)),
    ]


def _equilibria(gear: mc.Mechanism) -> tuple[Slice, int]:
    starts = _starts(gear)
    diagram = mc.bifurcation_diagram(gear, "F_ret", BOUNDS, starts, ds_max=DS_MAX)
    return Slice(gear, load_case(), [whole(b) for b in diagram]), len(starts)


def _starts(gear: mc.Mechanism) -> list[mc.Point]:
    forces = (BOUNDS[0], STARTS[0], STARTS[-1], BOUNDS[1])
    found = [mc.find_equilibrium(gear, {**load_case(), "F_ret": f}, keyframe=k) for f in forces for k in KEYFRAMES]
    # An unlock actuator that pulls holds the locklinks near in line: the deployed gear then bears any F_ret.
    held = mc.continue_equilibria(gear, "F_ret", BOUNDS, load_case(f_ul=-200.0), keyframe="downlock_below")
    force = whole(held)["F_ret"][-1]
    found.append(mc.find_equilibrium(gear, {**load_case(), "F_ret": force}, state=held.states[-1]))
    return found


def _curve_of(branches: Sequence[mc.Branch], point: mc.SpecialPoint) -> mc.Branch:
    return next(b for b in branches if any(p is point for p in b.special_points))


def _draw(found: Sequence[Slice], out: Path) -> None:
    figure, axes = new_figure(2, 2, (9.6, 8.2))
    for number, (left, right), near in zip("12", axes, found, strict=True):
        names = {p["F_ret"]: f"FP$_{k}$" for k, p in enumerate(near.folds, 1)}
        for b in near.branches:
            force, overcentre, strut = b["F_ret"] / 1e3, wrapped(b["theta_ov"]), wrapped(b["theta_1"])
            draw_sides(left, b, force, overcentre)
            draw_sides(right, b, overcentre, strut)
            for p in b.of_kind("LP"):
                text = names.get(p["F_ret"], "")
                mark(left, force[p.index], overcentre[p.index], "LP", text)
                mark(right, overcentre[p.index], strut[p.index], "LP", text)
        left.set(xlabel=axis_label("F_ret", "kN"), ylabel=axis_label("theta_ov", "deg"), xlim=np.array(BOUNDS) / 1e3)
        right.set(xlabel=axis_label("theta_ov", "deg"), ylabel=axis_label("theta_1", "deg"), ylim=(-75, 5))
        set_panel_title(left, f"(a{number})  {NAMES[near.gear.name]}")
        set_panel_title(right, f"(b{number})  {NAMES[near.gear.name]}")
    add_legend(axes[0, 1], loc="center", bbox_to_anchor=(0.72, 0.5))
    save_figure(figure, out / "fig10.png")


def _curves(near: Slice, starts: int) -> Finding:
    branches, shown = near.branches, []
    for b in branches:
        folds = [f"{p['F_ret'] / 1e3:.3f} kN ({angle_of(p):+.2f}, {angle_of(p, 'theta_1'):.2f} deg)"
                 for p in b.of_kind("LP")]
        stable = np.degrees(b["theta_1"][b.stability == "stable"])
        shown.append(f"folds at {', '.join(folds)}, stable for theta_1 {stable.min():.1f} to {stable.max():.1f} deg")
    kinds = {p.kind for b in branches for p in b.special_points}
    return Finding(
        "The equilibria form separate curves above and below overcentre, with folds as their only bifurcations.",
        f"{len(branches)} curves from {starts} starts, duplicates recognised. {'; '.join(shown)} (theta_ov, theta_1 "
        f"in brackets)",
        len(branches) == 3 and kinds == {"LP"},
        near.gear.name,
    )


def _stability(near: Slice) -> Finding:
    fold = near.fold
    above = _curve_of(near.branches, fold)
    uplock = near.inside(above) & (np.arange(len(above)) != fold.index)
    beyond = above["theta_ov"] > fold["theta_ov"]
    others = [b for b in near.branches if b is not above]
    held = [b.stability[near.inside(b) & (b["theta_ov"] > _end_of_lock(near))] for b in others]
    locked = [words for words in held if len(words)]
    end = " down to FP2" if len(near.folds) > 1 else ""
    return Finding(
        "Near uplock the curve above overcentre is stable up to FP1; between it and the stable curve below overcentre "
        "lie saddles.",
        f"FP1 at F_ret = {fold['F_ret']:.3f} N, theta_ov = {angle_of(fold):+.6f} deg, theta_1 = "
        f"{angle_of(fold, 'theta_1'):.6f} deg. Around uplock all {int((uplock & beyond).sum())} points at larger "
        f"theta_ov are stable, all {int((uplock & ~beyond).sum())} at smaller theta_ov have one unstable eigenvalue; "
        f"all {sum(map(len, locked))} points below overcentre{end} are stable",
        np.all(above.n_unstable[uplock & beyond] == 0) and np.all(above.stability[uplock & beyond] == "stable")
        and np.all(above.n_unstable[uplock & ~beyond] == 1) and len(locked) == 1 and np.all(locked[0] == "stable"),
        near.gear.name,
    )


def _end_of_lock(near: Slice) -> float:
    """Return theta_ov of FP2, or far below where there is none."""
    return float(near.folds[1]["theta_ov"]) + np.radians(0.01) if len(near.folds) > 1 else -np.inf


def _uppermost(near: Slice) -> Finding:
    branches, fold = near.branches, near.fold
    above = _curve_of(branches, fold)
    low = above.of_kind("LP")[0]
    highest = []
    for force in np.linspace(low["F_ret"], fold["F_ret"], 12)[1:-1]:
        stable = [(p["theta_ov"], b is above) for b in branches for p in b.at(F_ret=force) if p.stability == "stable"]
        highest.append(max(stable)[1])
    return Finding(
        "A gear that retracts as F_ret rises follows the uppermost stable curve up to FP1.",
        f"from the fold near downlock ({low['F_ret']:.1f} N, theta_1 = {angle_of(low, 'theta_1'):.2f} deg) to FP1 the "
        f"stable equilibrium with the largest theta_ov is on the curve of FP1 at {sum(highest)} of {len(highest)} "
        f"forces",
        all(highest),
        near.gear.name,
    )


def _beyond(near: Slice) -> Finding:
    gear, branches, fold = near.gear, near.branches, near.fold
    force = 1.01 * fold["F_ret"]
    stable = [p for b in branches for p in b.at(F_ret=force) if p.stability == "stable"]
    uplocked = [p for p in stable if p["theta_1"] < np.radians(-45.0)]
    motion = simulate(gear, {"F_ret": force}, duration=60.0, start=fold)
    end = np.degrees(motion["theta_ov"][-1])
    others = [f"theta_ov = {angle_of(p):+.2f}, theta_1 = {angle_of(p, 'theta_1'):.2f} deg" for p in stable
              if p not in uplocked]
    return Finding(
        "Beyond FP1 the gear must go over to the stable curve below overcentre: it locks. The other stable equilibria "
        "at large F_ret are those of the deployed gear.",
        f"at 1.01 times the force of FP1, {force:.0f} N, one stable equilibrium near uplock, theta_ov = "
        f"{angle_of(uplocked[0]):+.3f} deg, and deployed {'; '.join(others)}. Simulated for 60 s from FP1 under this "
        f"force the gear comes to rest at {end:+.3f} deg",
        len(uplocked) == 1 and uplocked[0]["theta_ov"] < 0 and abs(end - angle_of(uplocked[0])) < 0.01
        and len(stable) > 1 and all(p["theta_1"] > DEPLOYED for p in stable if p not in uplocked),
        gear.name,
    )


def _lower_fold(first: Slice, locking: Slice) -> Finding:
    _, fp2, fp3 = locking.folds
    below = _curve_of(locking.branches, fp2)
    theta = below["theta_ov"]
    off = np.min(np.abs(theta[:, None] - [fp2["theta_ov"], fp3["theta_ov"]]), axis=1) > np.radians(0.01)
    near = locking.inside(below) & off
    locked, saddle = near & (theta > fp2["theta_ov"]), near & (theta < fp2["theta_ov"]) & (theta > fp3["theta_ov"])
    other = next(b for b in first.branches if any(p["theta_ov"] < 0 for p in b.at(F_ret=6e5) if p["theta_1"] < -0.8))
    upper = max(other.of_kind("LP"), key=lambda p: -p["theta_1"])
    return Finding(
        "The stable curve below overcentre ends in a fold near uplock as F_ret falls (one of the paper's three folds "
        "there).",
        f"at FP2, {fp2['F_ret']:.3f} N, theta_ov = {angle_of(fp2):+.5f} deg: all {int(locked.sum())} points between it "
        f"and overcentre are stable, all {int(saddle.sum())} from there to FP3, {fp3['F_ret']:.3f} N, "
        f"{angle_of(fp3):+.5f} deg, have one unstable eigenvalue; beyond FP3 the gear rests extended. The first gear "
        f"has no such fold: below overcentre nothing but the spring and F_ret holds it, and it extends as F_ret falls, "
        f"to theta_1 = {angle_of(upper, 'theta_1'):.2f} deg at a fold at {upper['F_ret']:.1f} N",
        np.all(below.n_unstable[locked] == 0) and np.all(below.n_unstable[saddle] == 1)
        and below["F_ret"][locked].min() >= fp2["F_ret"] * (1.0 - 1e-9) and upper["theta_1"] > np.radians(-45.0),
        LOCKING,
    )


def _stretched(above: mc.Branch) -> Finding:
    gaps = 1e3 * np.maximum(np.hypot(above["R_C_x"], above["R_C_z"]), np.hypot(above["R_H_x"], above["R_H_z"]))
    gaps /= above["k_j"]
    halfway = (np.abs(above["theta_1"] + np.radians(30.0)) < np.radians(20.0)) & (above.n_unstable > 0)
    stable = above.stability == "stable"
    return Finding(
        "The unstable equilibria halfway between uplock and downlock, locklinks in line, exist only because the pins "
        "are elastic.",
        f"on the curve of FP1 for theta_1 from -50 to -10 deg, theta_ov up to "
        f"{np.degrees(np.abs(above['theta_ov'][halfway]).max()):.2f} deg, a pin is apart by {gaps[halfway].min():.0f} "
        f"to {gaps[halfway].max():.0f} mm; where that curve is stable by at most {gaps[stable].max():.1f} mm",
        gaps[halfway].min() > 10.0 * gaps[stable].max(),
        FIRST,
    )


if __name__ == "__main__":
    run_script(main)
