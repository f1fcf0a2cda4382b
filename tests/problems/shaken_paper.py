"""The shipped studies and the curves of the paper's figures, as they are followed under noise.

The figures' own functions compute the curves; drawing and motions in time, which take most of a figure's time, are
left out. Of figure 8 the curves of FP1 and FP3 are computed (that of FP2 is FP1's), and of its branches one at the
small stiffness, and at the larger ones those through the poses; of figures 14 and 15 the magnified cusp is left out.
"""

from __future__ import annotations

import importlib
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import mjcont as mc
from mjcont.paper.reproduce import scripts_folder
from problems.shaken_problems import Job

sys.path.insert(0, str(scripts_folder()))
_overcentre, _gear, _loci, *_figures = (
    importlib.import_module(name)
    for name in ("_overcentre", "_gear", "_loci", "fig03", "fig04", "fig07", "fig08", "fig10", "fig15")
)
fig03, fig04, fig07, fig08, fig10, fig15 = _figures
STUDIES = Path(__file__).parent.parent.parent / "studies"
SWEPT = 3


def _study(path: Path) -> list[Any]:
    """Return a study's results, energy barriers left out: they are a number at each of many rows that steps choose."""
    study = mc.load_study(path)
    tasks = tuple(t for t in study.tasks if t.kind != "barrier")
    with tempfile.TemporaryDirectory() as folder:
        results = mc.run_study(replace(study, plots=(), tasks=tasks), folder)
        swept = [mc.sweep(study, out=folder, limit=SWEPT, workers=1)] if study.sweep is not None else []
    return [*results, *swept]


def _gear_model(name: str = _gear.FIRST) -> mc.Mechanism:
    return mc.Mechanism.from_xml(name)


def _full_gear() -> mc.Mechanism:
    return mc.Mechanism.from_xml("nose_gear_full")


def _at_stiffness(k_j: float) -> mc.Branch:
    return _overcentre.equilibria(_overcentre.overcentre(), k_j=k_j)


def _fig03() -> list[mc.Branch]:
    return [_overcentre.equilibria(_overcentre.overcentre(), ds_max=0.03, c_sp=c) for c in fig03.DAMPING]


def _fig04() -> list[Any]:
    branches = [_at_stiffness(k) for k in fig04.STIFFNESS]
    stiff = branches[-1]
    study = partial(mc.stiffness_study, stiff.problem, parameter="k_j", tol=0.01, bounds=fig04.SPAN, ds_max=0.02)
    return [branches, [study(stiff.point(label), quantity="F") for label in _overcentre.FOLDS]]


def _fig06() -> Any:
    return mc.bifurcation_diagram(
        _full_gear(), "F_ret", (0, 60), {"F_ret": 20.0}, keyframes=["uplock_above", "uplock_below"]
    )


def _fig08() -> list[Any]:
    """Return the folds with stiff joints, two of their curves in stiffness, and a branch that meets one at 1e4 N/m."""
    gear, soft = _full_gear(), fig08.STIFFNESS[0]
    folds = fig08.stiff_folds(gear)
    loci = [mc.continue_special(p, "k_j", fig08.SPAN, zeros={"k_j": soft}) for p in (folds[0], folds[-1])]
    start = loci[0].point("UZ1")
    return [folds, loci, mc.bifurcation_diagram(gear, "F_ret", fig08.BOUNDS, start, zeros={"theta_ov": 0.0})]


def _fig08_stiff(k_j: float) -> Any:
    start = {"F_ret": 20.0, "k_j": k_j}
    return mc.bifurcation_diagram(_full_gear(), "F_ret", fig08.BOUNDS, start, keyframes=fig08.KEYFRAMES)


def _fig09() -> list[Any]:
    gear = _gear_model()
    branch = mc.continue_equilibria(gear, "F_ret", (3e5, 8e5), {"F_ret": 4e5}, keyframe="uplock_above")
    return [branch, mc.stiffness_study(gear, branch.point("LP1"), "k_j", 1e-3)]


def _fig10() -> Any:
    gear = _gear_model()
    return mc.bifurcation_diagram(gear, "F_ret", fig10.BOUNDS, fig10._starts(gear), ds_max=fig10.DS_MAX)


def _load_slice(name: str, load_factor: float, degrees: float, f_ul: float) -> list[mc.Branch]:
    found = _gear.Slice.of(_gear_model(name), _gear.load_case(load_factor, degrees, f_ul))
    return list(found.branches)


def _load_case(name: str, load_factor: float, degrees: float) -> list[Any]:
    case = _loci.Case.of(_gear_model(name), load_factor, degrees)
    return [case.fold, case.locus]


def _near_cusp() -> mc.Branch:
    gear = _gear_model()
    return _loci.near_cusp(gear, _loci.Case.of(gear, 1.0, 0.0))


def _cusps(load_factor: float) -> mc.Branch:
    return fig15._cusps(_loci.Case.of(_gear_model(), load_factor, 0.0))


def _papers() -> Iterator[tuple[str, Job]]:
    yield "figures 2 and 3", _fig03
    yield "figure 4", _fig04
    yield "figure 5", lambda: [_at_stiffness(k) for k in (1e2, 1e6)]
    yield "figure 6", _fig06
    for c_j in fig07.DAMPING:
        yield f"figure 7, c_j = {c_j:g}", lambda c=c_j: fig07._branches(_full_gear(), c)
    yield "figure 8", _fig08
    for k_j in fig08.STIFFNESS[1:]:
        yield f"figure 8, k_j = {k_j:g}", partial(_fig08_stiff, k_j)
    yield "figure 9", _fig09
    yield "figure 10", _fig10
    for gear in (_gear.FIRST, _gear.LOCKING):
        yield from _loaded(gear, "" if gear == _gear.FIRST else ", the gear that locks")
    yield "figure 12, magnified", _near_cusp


def _loaded(gear: str, of: str) -> Iterator[tuple[str, Job]]:
    """Yield the curves of a gear under its load cases."""
    for f_ul in (0.0, _gear.UNLOCK):
        for degrees in _gear.ANGLES:
            yield f"figure 11, {degrees:g} deg, {f_ul:g} N{of}", partial(_load_slice, gear, 1.0, degrees, f_ul)
    for n in (0.5, 2.5):
        yield f"figure 13, {n:g} g{of}", partial(_load_slice, gear, n, 0.0, 0.0)
    for n in _gear.LOAD_FACTORS:
        for degrees in _gear.ANGLES:
            yield f"figures 12, 14, 15: {n:g} g, {degrees:g} deg{of}", partial(_load_case, gear, n, degrees)
        if not of:
            yield f"figure 15, cusps at {n:g} g", partial(_cusps, n)


PAPER: dict[str, Job] = dict(_papers())
SHIPPED: dict[str, Job] = {path.stem: partial(_study, path) for path in sorted(STUDIES.glob("*.toml"))}
