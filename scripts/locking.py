"""Locking and unlocking the gear that locks: load paths, and a lock with a stop.

(a) Without unlock force: as F_ret grows the gear retracts, passes FP1 and locks; F_ret falls to FP2 and it stays; below
that it lets go. (b) Under an unlock force of 500 N: F_ret rises to the new FP1 and the gear is unlocked. (c) Both
forces: the locus of FP1 and FP2, the two paths, and, with the stop, where the locklinks leave it. (d-f) The same gear
with a stop for its locklinks 5 deg below overcentre (nose_gear_stop). (d) Equilibria without unlock force and with 500
N; CO: the locklinks meet the stop. (e) What they press against it with. (f) The same without retraction force, against
the spring's free length. Light grey, dark grey, solid and dashed as in the paper's figures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from _gear import LOAD_FACTORS, LOCKING, UNLOCK, Slice, add_legend, angle_of, draw_sides, load_case, wrapped
from _loci import Case

import mjcont as mc
from mjcont.drawing.axes import axis_label
from mjcont.drawing.plotting import COLORS, draw_curve, mark, new_figure, pieces, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script, whole
from mjcont.paper.twins import write_twins

STOPPED = "nose_gear_stop"
HIGH = 8e5  # N
# F_ret and F_ul in N. Retracting from above overcentre past FP1, then less force, down to below FP2.
LOCK = ({"F_ret": 2.5e5, "F_ul": 0.0}, {"F_ret": 5.5e5}, {"F_ret": 4.6e5}, {"F_ret": 3.0e5})
# Locked between FP2 and FP1, which both come down under the unlock force; past FP1; no unlock force; let down.
BETWEEN = 4.142e5
FREE = ({"F_ret": 5.5e5, "F_ul": 0.0}, {"F_ret": 4.6e5}, {"F_ret": BETWEEN, "F_ul": UNLOCK}, {"F_ret": 4.3e5},
        {"F_ul": 0.0}, {"F_ret": 1e5})
UNLOCKS = (-50.0, -100.0, -200.0, -300.0, -400.0, -500.0, -750.0, -1000.0)  # N
STRONG = -6000.0  # N, beyond what an actuator of this gear gives: what opens the stopped lock without F_ret
FREE_LENGTHS = (0.75, 1.25)  # m


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed.

    Attributes
    ----------
    slices : the free gear without unlock force and with 500 N.
    case : FP1 and its locus.
    locks, frees : load paths of the free gear; holds : the stopped gear's from uplock to no F_ret.
    stopped : the stopped gear's locked curve in F_ret, by F_ul.
    strong : the same without F_ret, in F_ul; lengths : in the spring's free length, by load factor; spring, load : in
    its stiffness, and in the load factor.
    """

    slices: Sequence[Slice]
    case: Case
    locks: mc.LoadPath
    frees: mc.LoadPath
    holds: mc.LoadPath
    stopped: Mapping[float, mc.Branch]
    strong: mc.Branch
    lengths: Mapping[float, mc.Branch]
    spring: mc.Branch
    load: mc.Branch


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "locking.png")
    write_twins(out, "locking", *study.slices[0].branches, study.locks, study.frees, study.holds)
    return findings(study)


def compute() -> Study:
    """Compute everything."""
    gear, stop = mc.Mechanism.from_xml(LOCKING), mc.Mechanism.from_xml(STOPPED)
    curve = whole(mc.continue_equilibria(stop, "F_ret", (0.0, HIGH), {"F_ret": 6e5}, keyframe="uplock_below"))
    rest = _at(curve, "F_ret", 0.0)

    def along(name: str, bounds: tuple[float, float], **values: float) -> mc.Branch:
        start = mc.find_equilibrium(stop, {**rest.parameters, **values}, state=rest.state)
        return whole(mc.continue_equilibria(stop, name, bounds, start))

    return Study(
        slices=[Slice.of(gear, load_case(f_ul=f)) for f in (0.0, UNLOCK)],
        case=Case.of(gear, 1.0, 0.0),
        locks=mc.load_path(gear, LOCK, keyframe="uplock_above"),
        frees=mc.load_path(gear, FREE, keyframe="uplock_below"),
        holds=mc.load_path(stop, "F_ret", [2.5e5, 5.5e5, 0.0], keyframe="uplock_above"),
        stopped={0.0: curve, **{f: along("F_ret", (0.0, HIGH), F_ul=f) for f in UNLOCKS}},
        strong=along("F_ul", (STRONG, 0.0)),
        lengths={n: along("l_us", FREE_LENGTHS, load_factor=n) for n in LOAD_FACTORS},
        spring=along("k_sp", (0.0, 1e5)),
        load=along("load_factor", (-1.0, 2.5)),
    )


def _at(branch: mc.Branch, name: str, value: float) -> mc.Point:
    """Return the stable point of a branch at a value."""
    (point,) = (p for p in branch.at(**{name: value}) if p.n_unstable == 0)
    return point


def corner(branch: mc.Branch) -> mc.SpecialPoint:
    """Return the only corner, where the locklinks meet the stop or leave it."""
    (point,) = branch.of_kind("CO")
    return point


def opening(branch: mc.Branch) -> mc.SpecialPoint:
    """Return where the stopped lock opens: the fold beyond the corner, or the corner where it turns back itself."""
    folds = [p for p in branch.of_kind("LP") if 0.0 > p["theta_ov"] > corner(branch)["theta_ov"]]
    return folds[0] if folds else corner(branch)


# --- drawing


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(3, 2, (9.6, 11.0))
    for ax, near, load, panel in zip(axes[0], study.slices, (study.locks, study.frees), "ab", strict=True):
        near.draw(ax)
        _draw_path(ax, load)
        ax.set(xlim=(230, 600), ylim=(-70, 70))
        set_panel_title(ax, f"({panel})  {'with 500 N' if near.load['F_ul'] else 'no unlock force'}")
    _draw_forces(axes[1, 0], study)
    _draw_stopped(axes[1, 1], axes[2, 0], study)
    for (n, b), color in zip(study.lengths.items(), COLORS, strict=False):
        draw_curve(axes[2, 1], b["l_us"], b["stop_load"], pieces(b), color=color)
        mark(axes[2, 1], corner(b)["l_us"], 0.0, "CO", f"{n:g}", color=color)
    axes[2, 1].set(xlabel=axis_label("l_us", "m"), ylabel=axis_label("stop_load", "N m"), ylim=(-50, None))
    set_panel_title(axes[2, 1], "(f)  no retraction force; load factors")
    add_legend(axes[0, 0], loc="lower right")
    save_figure(figure, path)


def _draw_path(ax: Any, load: mc.LoadPath) -> None:
    """Draw a load path, broad, with dotted arrows for its jumps."""
    force, angle = load["F_ret"] / 1e3, wrapped(load["theta_ov"])
    cuts = [0, *(j.index + 1 for j in load.jumps), len(force)]
    for first, last in pairwise(cuts):
        ax.plot(force[first:last], angle[first:last], color=COLORS[1], linewidth=4.0, alpha=0.45, zorder=1)
    for k in cuts[1:-1]:
        ax.annotate("", (force[k], angle[k]), (force[k - 1], angle[k - 1]),
                    arrowprops={"arrowstyle": "-|>", "color": COLORS[1], "linestyle": ":", "linewidth": 1.4})


def _draw_forces(ax: Any, study: Study) -> None:
    locus = study.case.locus
    draw_curve(ax, locus["F_ul"], locus["F_ret"] / 1e3, [("stable", 0, len(locus) - 1)], color=COLORS[0])
    for p in (study.case.cusp, study.case.second_cusp):
        mark(ax, p["F_ul"], p["F_ret"] / 1e3, "CP")
    for load, color in ((study.locks, COLORS[1]), (study.frees, COLORS[2])):
        ax.plot(load["F_ul"], load["F_ret"] / 1e3, color=color, linewidth=1.2, linestyle="-.")
        for jump in load.jumps:
            mark(ax, jump.before["F_ul"], jump.before["F_ret"] / 1e3, "LP")
    opens = [opening(b) for b in study.stopped.values()][1:]
    corners = [corner(b) for b in study.stopped.values()]
    ax.plot([p["F_ul"] for p in corners], [p["F_ret"] / 1e3 for p in corners], color=COLORS[3], linewidth=1.6)
    for p in opens:
        mark(ax, p["F_ul"], p["F_ret"] / 1e3, p.kind)
    ax.set(xlabel=axis_label("F_ul", "N"), ylabel=axis_label("F_ret", "kN"), xlim=(-620, 40), ylim=(290, 570))
    set_panel_title(ax, "(c)  folds, paths (dash-dotted), stop (purple)")


def _draw_stopped(left: Any, right: Any, study: Study) -> None:
    for f_ul, color in ((0.0, COLORS[0]), (UNLOCK, COLORS[1])):
        b = study.stopped[f_ul]
        draw_sides(left, b, b["F_ret"] / 1e3, wrapped(b["theta_ov"]))
        draw_curve(right, b["F_ret"] / 1e3, b["stop_load"], pieces(b), color=color)
        right.plot([], [], color=color, label=f"{abs(f_ul):g} N")
        for p in b.special_points:
            mark(left, p["F_ret"] / 1e3, angle_of(p), p.kind, p.label[:2] if p.kind == "CO" else "")
            mark(right, p["F_ret"] / 1e3, float(p["stop_load"]), p.kind, "CO" if p.kind == "CO" else "")
    left.set(xlabel=axis_label("F_ret", "kN"), ylabel=axis_label("theta_ov", "deg"), xlim=(0, 600), ylim=(-7, 1))
    right.set(xlabel=axis_label("F_ret", "kN"), ylabel=axis_label("stop_load", "N m"), xlim=(0, 600))
    right.legend(title="unlock force", frameon=False, fontsize=8.0, title_fontsize=8.0)
    set_panel_title(left, "(d)  with a stop: no unlock force, and 500 N")
    set_panel_title(right, "(e)  with a stop: the load on it")


# --- findings


def findings(study: Study) -> list[Finding]:
    """Return what the study shows."""
    return [_locks(study), _lets_go(study), _unlocks(study), _less(study), _stop_holds(study), _weight(study),
            _opens(study)]


def _jumps(path: mc.LoadPath) -> str:
    return "; ".join(
        f"{j.label} at F_ret = {j.before['F_ret']:.1f} N from theta_ov = {angle_of(j.before):+.2f} to "
        f"{angle_of(j.after):+.2f} deg" for j in path.jumps if j.after is not None
    )


def _locks(study: Study) -> Finding:
    fp1, first = study.slices[0].fold, study.locks.jumps[0]
    after = first.after
    locked = [p for p in study.slices[0].at(fp1["F_ret"]) if p["theta_ov"] < 0 and p.n_unstable == 0]
    near = min(abs(angle_of(p) - angle_of(after)) for p in locked) if after is not None else np.inf
    return Finding(
        "The gear locks itself: as F_ret passes FP1 it jumps onto the locked curve.",
        f"load path, {_jumps(study.locks)}; the first one takes {first.time:.1f} s. The locked curve passes within "
        f"{near:.0e} deg of where it lands",
        abs(first.before["F_ret"] / fp1["F_ret"] - 1.0) < 1e-9 and near < 1e-3,
        LOCKING,
    )


def _lets_go(study: Study) -> Finding:
    fp1, fp2 = study.slices[0].folds[:2]
    second, count = study.locks.jumps[1], len(study.locks.jumps)
    return Finding(
        "Locked, it stays while the retraction force falls, down to FP2; below that it lets go.",
        f"locked from FP1 at {fp1['F_ret']:.0f} N up and back to {second.before['F_ret']:.1f} N, "
        f"{100 * (1 - second.before['F_ret'] / fp1['F_ret']):.1f} % below FP1; then it extends below overcentre, to "
        f"theta_1 = {angle_of(second.after, 'theta_1'):.1f} deg. The first gear has no such fold",
        count == 2 and abs(second.before["F_ret"] / fp2["F_ret"] - 1.0) < 1e-9
        and second.after is not None and second.after["theta_1"] > np.radians(-55.0),
        LOCKING,
    )


def _unlocks(study: Study) -> Finding:
    fp1, path = study.slices[1].fold, study.frees
    (jump,) = path.jumps
    end = path.final
    return Finding(
        "With 500 N the gear is unlocked by raising F_ret to the new FP1; it then stays unlocked without unlock force "
        "and is let down above overcentre.",
        f"{_jumps(path)}, FP1 at {fp1['F_ret']:.1f} N; at the end F_ul = {end['F_ul']:g} N, F_ret = "
        f"{end['F_ret'] / 1e3:.0f} kN, theta_ov = {angle_of(end):+.1f} deg, theta_1 = {angle_of(end, 'theta_1'):.1f} "
        f"deg. Before that both forces must move together: under 500 N the gear is locked between "
        f"{study.slices[1].folds[1]['F_ret']:.0f} and {fp1['F_ret']:.0f} N only",
        abs(jump.before["F_ret"] / fp1["F_ret"] - 1.0) < 1e-9 and jump.after is not None
        and jump.after["theta_ov"] > 0 and end["theta_ov"] > 0,
        LOCKING,
    )


def _less(study: Study) -> Finding:
    """Find from which unlock force on the gear can be unlocked at all."""
    turn, cusp = study.case.exchange, study.case.cusp
    free = [(f, opening(b)["F_ret"]) for f, b in study.stopped.items() if turn["F_ul"] > f > -210.0]
    return Finding(
        "A weaker unlock force does as well, with more retraction force: the locked curve has a fold from the turn of "
        "the locus on, w . f_F_ret = 0, long before the cusp.",
        f"turn at F_ul = {turn['F_ul']:.2f} N, F_ret = {turn['F_ret']:.0f} N; cusp at {cusp['F_ul']:.1f} N. FP1 of the "
        "locked gear: " + ", ".join(f"{r / 1e3:.1f} kN at {-f:.0f} N" for f, r in free)
        + f". All less than the {study.case.fold['F_ret'] / 1e3:.1f} kN at which the gear locks without unlock force, "
        "so that above overcentre it finds a rest and does not lock again",
        len(free) == 3 and all(r < study.case.fold["F_ret"] for _, r in free),
        LOCKING,
    )


def _stop_holds(study: Study) -> Finding:
    curve = study.stopped[0.0]
    engages, rest, (jump,) = corner(curve), _at(curve, "F_ret", 0.0), study.holds.jumps
    stable = curve.stability == "stable"
    return Finding(
        "With a stop 5 deg below overcentre the gear stays locked without any retraction force.",
        f"it locks at FP1 as before ({jump.before['F_ret']:.1f} N, landing at {angle_of(jump.after):+.2f} deg); as "
        f"F_ret falls the locklinks meet the stop at {engages['F_ret']:.2f} N (corner, theta_ov = "
        f"{angle_of(engages):.4f} deg, located to {engages.tolerance:.0e}). From there on the load on the stop grows, "
        f"to {rest['stop_load']:.1f} N m at F_ret = 0, theta_ov = {angle_of(rest):+.3f} deg. All {int(stable.sum())} "
        f"points are stable",
        bool(np.all(stable)) and study.holds.final["theta_ov"] < corner(curve)["theta_ov"]
        and abs(study.holds.final["F_ret"]) < 1e-9 and len(study.holds.jumps) == 1
        and bool(np.all(np.diff(_loads(curve)) < 1e-9)),
        STOPPED,
    )


def _loads(curve: mc.Branch) -> Array:
    """Return the loads on the stop by rising F_ret."""
    return np.asarray(curve["stop_load"][np.argsort(curve["F_ret"])])


def _weight(study: Study) -> Finding:
    shown = [f"{corner(b)['l_us']:.4f} m at load factor {n:g}" for n, b in study.lengths.items()]
    lengths = [corner(b)["l_us"] for b in study.lengths.values()]
    leaves = corner(study.load)
    nominal = study.spring.problem.parameters["l_us"].value
    return Finding(
        "Without retraction force it is the weight that holds the locklinks against the stop; the spring must only not "
        "pull them off.",
        f"at F_ret = 0 the gear stays locked for every free length from {', '.join(shown)} on (it is {nominal} m); "
        f"there the stop's load vanishes and the lock opens. With {nominal} m any spring will do, even none: stable "
        f"for every k_sp from 0 to 1e5 N/m. When the load factor falls below {leaves['load_factor']:.4f} the locklinks "
        f"leave the stop, and rest between it and overcentre down to -1",
        bool(np.all(np.diff(lengths) < 0)) and max(lengths) < nominal
        and bool(np.all(study.spring.n_unstable == 0)) and bool(np.all(study.load.n_unstable == 0))
        and bool(np.all(study.load["theta_ov"] < 0)),
        STOPPED,
    )


def _opens(study: Study) -> Finding:
    alone = corner(study.strong)
    points = {f: opening(b) for f, b in study.stopped.items() if f}
    shown = [f"{p['F_ret'] / 1e3:.1f} kN at {-f:.0f} N ({'fold' if p.kind == 'LP' else 'corner'})"
             for f, p in points.items()]
    kinds = [p.kind for p in points.values()]
    forces = [p["F_ret"] for p in points.values()]
    return Finding(
        "The force that unlocks the stopped lock: the more the retraction force relieves it, the less. Weak unlock "
        "forces open it at the fold FP1 off the stop, strong ones the moment the locklinks leave the stop, a "
        "non-smooth fold.",
        f"without retraction force {-alone['F_ul']:.1f} N; with it, {', '.join(shown)}",
        kinds == sorted(kinds, key="LP CO".index) and {"LP", "CO"} == set(kinds) and bool(np.all(np.diff(forces) < 0))
        and "turns back" in alone.note,
        STOPPED,
    )


if __name__ == "__main__":
    run_script(main)
