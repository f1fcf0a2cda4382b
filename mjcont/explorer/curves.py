"""Results as curves of a document: columns, stability, special points, and the pose of every row.

A curve is plain data (`arrays.plain`), SI and radians; the browser shows degrees and kN. Every kind of result has a
function below that fills what it has; the rest of the fields is empty.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.errors import MjcontError
from mjcont.explorer.arrays import packed, plain
from mjcont.explorer.scene import Scene
from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import KINDS
from mjcont.results.barriers import BarrierCurve
from mjcont.results.branch import Branch
from mjcont.results.histories import History
from mjcont.results.loadpaths import Jump, LoadPath
from mjcont.results.maps import SpecialMap
from mjcont.results.model import Model
from mjcont.results.model import units as units_of
from mjcont.results.orbits import CycleBranch
from mjcont.results.points import SpecialPoint
from mjcont.results.sensitivities import Sensitivities, headline

STABLE, MARGINAL, UNSTABLE, JUMPING = 1, 0, -1, 2
_CODES = {"stable": STABLE, "marginal": MARGINAL, "unstable": UNSTABLE}
# orbits of a curve that carry their motion, and samples of each: what a loop in the browser needs to look smooth
_ORBITS, _SAMPLES = 40, 61
# samples of a history that travel: more than a screen is wide
_MOST_SAMPLES = 4000
Curve = dict[str, Any]


class Stage:
    """The scene of a document's model; results of another model have no poses."""

    def __init__(self, problem: Model | None) -> None:
        self.problem = problem
        self.scene = Scene(problem) if isinstance(problem, Mechanism) else None

    def fits(self, problem: Model | None) -> bool:
        """Whether results of a problem can be shown here."""
        same = problem is self.problem or getattr(problem, "mjcf", None) == getattr(self.problem, "mjcf", "")
        return self.scene is not None and isinstance(problem, Mechanism) and same

    def poses(
        self, problem: Model | None, states: Array, values: Sequence[Mapping[str, float]], varying: Sequence[str]
    ) -> Curve:
        """Return the poses of rows as fields of a curve; none for a plain vector field."""
        if not self.fits(problem) or not len(states):
            return {}
        assert self.scene is not None and isinstance(problem, Mechanism)
        scene = self.scene if problem is self.problem else Scene(problem)
        found = scene.poses(states, values, varying)
        every: Curve = {"poses": packed(found.bodies, "f4")}
        if found.shapes is not None:
            every["shapes"] = packed(found.shapes, "f4")
        if found.tendons.shape[1]:
            every["tendons"] = packed(found.tendons, "f4")
        return every


def drawable(result: Any) -> bool:
    """Whether the explorer shows results of its kind."""
    return isinstance(result, tuple(_KINDS))


def curve_of(
    result: Any, name: str, stage: Stage, parent: str | None = None, *, spectra: bool = True
) -> Curve:
    """Return a result as a curve called `name`.

    Parameters
    ----------
    result : Branch, CycleBranch, LoadPath, History, Sensitivities, SpecialMap or BarrierCurve
    stage : what its rows are posed on.
    parent : the name of the curve that it began on.
    spectra : whether eigenvalues that are not known are computed; else those rows show none.

    Raises
    ------
    MjcontError
        If the explorer shows no results of its kind.
    """
    kind = next((k for k in _KINDS if isinstance(result, k)), None)
    if kind is None:
        names = ", ".join(k.__name__ for k in _KINDS)
        raise MjcontError(f"the explorer shows no {type(result).__name__}: it takes {names}, Diagram")
    own: Curve = {
        "id": name, "name": name, "parent": parent, "model": getattr(result, "name", ""), "columns": {}, "units": {},
        "roles": {}, "axes": ["", ""], "free": {}, "fixed": {}, "fixed_units": {}, "stability": None, "specials": [],
        "ends": [], "notes": [], "text": str(result), "poses": None, "eigenvalues": None, "orbit": None,
    }
    found = _KINDS[kind](result, stage, spectra)
    if stage.scene is not None and len(found.get("columns", {})) and not found.get("poses"):
        found["notes"] = [*found.get("notes", []), "of another model than the one that is shown: it has no poses here"]
    return {**own, **found}


# -- curves of equilibria, of special points, of orbits --------------------------------------------------------


def _of_branch(branch: Branch, stage: Stage, spectra: bool) -> Curve:
    values = [branch.parameters_at(i) for i in range(len(branch))]
    x, y = ([*branch.free] if len(branch.free) > 1 and not branch.rated else branch.axes)[:2]
    return {
        "kind": "branch" if branch.rated else "locus",
        "of": branch.kind,
        **_columns({n: (c.unit, c.role, c.values) for n, c in branch.columns.items()}),
        "axes": [x, y],
        "free": plain(branch.free),
        "fixed": plain(branch.fixed),
        "fixed_units": dict(branch.fixed_units),
        "stability": packed([_CODES[s] for s in branch.stability], "i1") if branch.rated else None,
        "unstable": packed(branch.n_unstable, "i4"),
        "start": branch.start_index,
        "specials": [_special(p) for p in branch.special_points],
        "ends": [{"status": word, "text": sentence} for word, sentence in branch.ends],
        "notes": [*branch.notes, *([branch.certificate.headline] if branch.certificate is not None else [])],
        **stage.poses(branch.problem, branch.states, values, list(branch.free)),
        "eigenvalues": spectra_of(branch, spectra and branch.rated),
    }


def _of_orbits(branch: CycleBranch, stage: Stage, spectra: bool) -> Curve:
    rows = _spread(len(branch), [m.index for m in branch.marks], _ORBITS) if len(branch.orbits) else []
    found = _of_branch(branch, stage, spectra)
    drawn = next((n for n in branch.columns if branch.envelope(n.removesuffix(".max"))), branch.axes[1])
    return {
        **found, "kind": "orbits" if branch.rated else "locus",
        "axes": [found["axes"][0], drawn.removesuffix(".max")] if branch.rated else found["axes"],
        "multipliers": True, "orbit": _motions(branch, rows, stage) if rows else None,
    }


def _motions(branch: CycleBranch, rows: Sequence[int], stage: Stage) -> Curve:
    """Return one period of some of a curve's orbits, (orbits, samples), at even times."""
    histories = [branch.orbits[i].history(_SAMPLES) for i in rows]
    names = [n for n in histories[0].columns if n != "time"]
    posed = [stage.poses(h.problem, h.states, _values(h, range(len(h))), _driven(h)) for h in histories]
    joined: Curve = {}
    if all("poses" in p for p in posed):
        from mjcont.explorer.arrays import unpacked

        keys = [k for k in ("poses", "tendons", "shapes") if all(k in p for p in posed)]
        joined = {k: packed(np.array([unpacked(p[k]) for p in posed]), "f4") for k in keys}
    return {
        "rows": packed(rows, "i4"),
        "period": packed([h["time"][-1] for h in histories]),
        "columns": {n: packed([h[n] for h in histories], "f4") for n in names},
        "units": {n: histories[0].unit(n) for n in names},
        **joined,
    }


def _spread(count: int, needed: Sequence[int], most: int) -> list[int]:
    """Return some of `count` rows, evenly, with those needed among them."""
    even = np.linspace(0, count - 1, min(count, most)).round().astype(int).tolist()
    return sorted({*even, *needed})


def spectra_of(branch: Branch, complete: bool) -> Any:
    """Return the eigenvalues of a branch's rows, (N, m, 2), real and imaginary parts; unknown ones computed or NaN."""
    return _packed_spectra(_spectra(branch, complete))


def _spectra(branch: Branch, complete: bool) -> Array:
    """Return the eigenvalues of rows, (N, m), NaN where there are fewer or they are not known."""
    return branch.eigenvalues if complete and branch.problem is not None else branch.spectra.table()


def _packed_spectra(table: Array) -> Any:
    return packed(np.stack([table.real, table.imag], axis=-1), "f4") if table.size else None


def _special(p: SpecialPoint) -> Curve:
    values = {**p.parameters, **p.observables}
    return {
        "label": p.label, "kind": p.kind, "name": KINDS[p.kind].name if p.kind in KINDS else "",
        "row": p.index, "values": plain(values), "text": str(p), "facts": _facts(p),
    }


def _facts(p: SpecialPoint) -> str:
    """Return what a table of values does not say: coefficients, how well it is known, a note."""
    told = [f"{k} = {v:.6g}" if isinstance(v, float) else f"{k} = {v}" for k, v in p.coefficients.items()]
    told.append(f"located to {p.tolerance:.1e}" if p.converged else "not converged: a guess")
    return ", ".join(told) + (f". {p.note}" if p.note else "")


# -- motion ----------------------------------------------------------------------------------------------------


def _of_path(path: LoadPath, stage: Stage, spectra: bool) -> Curve:
    """Return a load path with the motions of its jumps between its rows."""
    names = list(dict.fromkeys([*path.names, *path.segments[0].branch.columns]))
    roles = {c.name: c.role for s in path.segments[:1] for c in s.branch.columns.values()}
    columns = {n: [path[n]] for n in names}
    codes = np.concatenate([[_CODES[w] for w in s.branch.stability[:: s.direction]] for s in path.segments])
    values = [s.branch.parameters_at(int(i)) for s in path.segments for i in s.rows()]
    states, at, specials = path.states, np.arange(len(path)), []
    for jump in sorted(path.jumps, key=lambda j: -j.index):
        motion = np.reshape(jump.states, (-1, states.shape[1]))
        motion = motion[np.isfinite(motion).all(axis=1)]
        i, here = jump.index, {n: float(jump.before[n]) for n in values[jump.index]}
        seen = _seen(path, motion, here, names)
        columns = {n: [np.concatenate([c[0][: i + 1], seen[n], c[0][i + 1 :]])] for n, c in columns.items()}
        codes = np.insert(codes, i + 1, [JUMPING] * len(motion))
        at = np.insert(at, i + 1, [-1] * len(motion))
        states = np.concatenate([states[: i + 1], motion, states[i + 1 :]])
        values[i + 1 : i + 1] = [here] * len(motion)
        specials.append(jump)
    return {
        "kind": "loadpath",
        **_columns({n: (path.unit(n), roles.get(n, "parameter"), c[0]) for n, c in columns.items()}),
        "axes": list(path.axes), "fixed": plain(path.segments[0].branch.fixed),
        "fixed_units": dict(path.segments[0].branch.fixed_units),
        "free": {n: [min(v[n] for v in path.vertices), max(v[n] for v in path.vertices)] for n in path.names},
        "stability": packed(codes, "i1"),
        "own": packed(at, "i4"),
        "eigenvalues": _packed_spectra(_along(path, spectra)[at]),
        "specials": [_jumped(j, int(np.flatnonzero(at == j.index)[0])) for j in reversed(specials)],
        "ends": [{"status": path.status, "text": path.message}],
        **stage.poses(path.problem, states, values, list(path.names)),
    }


def _along(path: LoadPath, complete: bool) -> Array:
    """Return the eigenvalues of a path's rows, and behind them a row of NaN for all that move."""
    tables = [_spectra(s.branch, complete)[:: s.direction] for s in path.segments]
    found = np.full((len(path) + 1, max(t.shape[1] for t in tables)), complex(np.nan, np.nan))
    first = 0
    for table in tables:
        found[first : first + len(table), : table.shape[1]] = table
        first += len(table)
    return found


def _seen(path: LoadPath, states: Array, values: Mapping[str, float], names: Sequence[str]) -> dict[str, Array]:
    """Return columns along a motion at fixed parameter values."""
    problem, read = path.problem, [n for n in names if n not in values]
    measured = np.full((len(states), len(read)), np.nan)
    if problem is not None and len(states):
        measured = problem.measure(states, problem.values(values), read)
    return {n: np.full(len(states), values[n]) if n in values else measured[:, read.index(n)] for n in names}


def _jumped(jump: Jump, row: int) -> Curve:
    values = {**jump.before.parameters, **jump.before.observables}
    name = KINDS[jump.kind].name if jump.kind in KINDS else "jump"
    return {"label": jump.label, "kind": jump.kind, "name": f"jump at {name}", "row": row, "values": plain(values),
            "text": str(jump), "facts": str(jump).partition(": ")[2]}


def _of_history(history: History, stage: Stage, spectra: bool) -> Curve:
    del spectra
    shown = next((c.name for c in history.columns.values() if c.role == "observable"), "time")
    rows = _spread(len(history), [], _MOST_SAMPLES)
    thinned = [f"{len(rows)} of its {len(history)} samples are shown"] if len(rows) < len(history) else []
    return {
        "kind": "history",
        **_columns({n: (c.unit, c.role, c.values[rows]) for n, c in history.columns.items()}),
        "axes": ["time", shown], "fixed": plain(history.fixed), "notes": thinned,
        "ends": [{"status": history.status, "text": history.message}],
        **stage.poses(history.problem, history.states[rows], _values(history, rows), _driven(history)),
    }


def _driven(history: History) -> list[str]:
    return [c.name for c in history.columns.values() if c.role == "parameter"]


def _values(history: History, rows: Sequence[int]) -> list[dict[str, float]]:
    known: Any = history.problem.parameters if history.problem is not None else ()
    driven = {n: history[n] for n in _driven(history) if n in known}
    fixed = {n: v for n, v in history.fixed.items() if n in known}
    return [{**fixed, **{n: float(c[i]) for n, c in driven.items()}} for i in rows]


# -- what is no curve of states ----------------------------------------------------------------------------------


def _of_sensitivities(s: Sensitivities, stage: Stage, spectra: bool) -> Curve:
    del stage, spectra
    point = s.point
    return {
        "kind": "sensitivities", "model": point.model.name, "title": headline(s),
        "point": getattr(point, "label", ""), "parameters": list(s.parameters), "quantities": list(s.quantities),
        "derivatives": packed(s.derivatives), "changes": packed(s.changes), "values": plain(s.values),
        "tolerances": plain(s.tolerances), "units": dict(s.units), "notes": list(s.notes),
        "fixed": plain(point.parameters),
    }


def _of_map(found: SpecialMap, stage: Stage, spectra: bool) -> Curve:
    """Return the rows of a grid where the point exists, in the grid's order."""
    del spectra
    units, own = units_of(found.point.model), [n for n in found.point.free if n not in found.axes]
    points = [p for p in found.points.ravel() if p is not None]
    names = [*found.axes, *own, *found.point.observables]
    values = [dict(p.parameters) for p in points]
    return {
        "kind": "map", "model": found.point.model.name, "point": found.point.label,
        **_columns({n: (units[n], "parameter" if n in found.point.parameters else "observable",
                        np.array([p[n] for p in points])) for n in names}),
        "axes": [*found.axes, *own][:2], "shown": own[0] if own else names[-1],
        "grid": {n: packed(a) for n, a in found.axes.items()},
        "notes": list(dict.fromkeys(m for m in found.messages.ravel() if m)), "fixed": plain(found.point.parameters),
        **stage.poses(found.point.problem, np.array([p.state for p in points]), values, names),
    }


def _of_barriers(found: BarrierCurve, stage: Stage, spectra: bool) -> Curve:
    del spectra
    rests = [b.rest for b in found.barriers]
    return {
        "kind": "barriers", "model": rests[0].model.name if rests else "",
        **_columns({found.name: (found.unit, "parameter", found.values), "energy": ("J", "observable", found.energy)}),
        "axes": [found.name, "energy"], "pieces": packed(found.pieces, "i4"), "rows": packed(found.rows, "i4"),
        "fixed": plain(rests[0].parameters) if rests else {},
        **(stage.poses(rests[0].problem, np.array([r.state for r in rests]), [r.parameters for r in rests],
                       [found.name]) if rests else {}),
    }


def _columns(columns: Mapping[str, tuple[str, str, Array]]) -> Curve:
    return {
        "columns": {n: packed(values) for n, (_, _, values) in columns.items()},
        "units": {n: unit for n, (unit, _, _) in columns.items()},
        "roles": {n: role for n, (_, role, _) in columns.items()},
    }


_KINDS: Mapping[type, Callable[[Any, Stage, bool], Curve]] = {
    CycleBranch: _of_orbits,
    Branch: _of_branch,
    LoadPath: _of_path,
    History: _of_history,
    Sensitivities: _of_sensitivities,
    SpecialMap: _of_map,
    BarrierCurve: _of_barriers,
}
