"""The test problems that are followed under noise: classic fields, random ones, mechanisms. A name, what to compute.

Each is made anew whenever it is called: nothing that rounding could have touched is kept from another call.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

import mjcont as mc
from problems import crossings, fields, folding, forms, locusfields, locusforms, motions
from problems.curves import scalar
from problems.kinked import cable, slider
from problems.mechanisms import column
from problems.random_linkage import linkage
from problems.rowmodels import BALL, CROSSED
from problems.stops import pendulum_with_stops
from problems.ziegler import ziegler

Job = Callable[[], Any]
LOADED = {"four_bar": (-3.0, 3.0), "slider_crank": (-3.0, 3.0), "watt_six_bar": (-3.0, 3.0), "rssr": (-1.2, 1.6)}


# -- fields in closed form ------------------------------------------------------------------------------------


def _curve(field: Callable[[], mc.VectorField], name: str, low: float, high: float, **options: Any) -> mc.Branch:
    return mc.continue_equilibria(field(), name, bounds=(low, high), **options)


def _diagram(field: Callable[[], mc.VectorField], low: float, high: float) -> Any:
    return mc.bifurcation_diagram(field(), "mu", bounds=(low, high))


def _locus(curve: Callable[[], mc.Branch], label: str, name: str, low: float, high: float, **options: Any) -> Any:
    return mc.continue_special(curve().point(label), name, bounds=(low, high), **options)


def _ab(B: float = 18.0) -> mc.Branch:
    return _curve(lambda: fields.ab(B), "D", 0.0, 0.6)


def _cusps() -> mc.Branch:
    folds = _locus(lambda: _curve(locusfields.tilted_cusp, "mu", -2.0, 2.0), "LP1", "la", -2.0, 2.0)
    return mc.continue_special(folds.point("CP1"), "e", bounds=(-2.0, 2.0))


def _isola_entered_at_its_folds(radius: float) -> list[mc.Branch]:
    isola = folding.circle_branch(radius)
    return [isola, *(folding.circle_branch(radius, start=p) for p in isola.special_points)]


def _two_folds(la: float) -> mc.Branch:
    field = scalar(lambda x, p: p["mu"] + la * x - x**3, -1.0, mu=-1.0)
    return mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))


def _oscillator(cubic: float, omega: float) -> mc.Branch:
    made = partial(forms.seen_through, forms.SPACE)
    return _curve(lambda: made(forms.oscillator(cubic, omega), {"mu": -0.5}, [0.0] * 3), "mu", -0.5, 0.6)


def _fields() -> Iterator[tuple[str, Job]]:
    for B in (14.0, 18.0):
        yield f"ab at B = {B:g}", partial(_ab, B)
    yield "pp2", lambda: mc.bifurcation_diagram(fields.pp2(), "p", bounds=(0.0, 1.2), max_size=3.0)
    yield "cusp", partial(_curve, fields.cusp, "mu", -1.0, 1.0)
    yield "adaptx", partial(_curve, fields.adaptx, "alpha", 0.1, 2.0)
    yield "brusselator", partial(_curve, fields.brusselator, "B", 0.5, 8.0)
    yield "bratu", partial(fields.branch_of_bratu.__wrapped__, 100)
    yield "brusselator in a tube", partial(_curve, lambda: fields.tube(10), "B", 1.0, 6.2)
    yield "brusselator on many cells", partial(_curve, lambda: fields.tube(80), "B", 1.0, 5.3)
    for radius in (1.0, 1e-3):
        yield f"isola of radius {radius:g}", partial(_isola_entered_at_its_folds, radius)
    for gap, sign in ((0.1, 1.0), (1e-3, 1.0), (0.1, -1.0), (1e-3, -1.0)):
        field = partial(folding.hyperbolas, gap, sign)
        yield f"hyperbolas {sign * gap:+g}", partial(_curve, field, "la", -1.0, 1.0)
    for eps in (0.1, -1e-3):
        yield f"imperfect pitchfork {eps:+g}", partial(_curve, partial(folding.imperfect, eps), "mu", -1.0, 1.0)
    yield "twin waves", partial(_curve, partial(folding.twin_waves, 1e-3), "t", -1.0, 1.0, state=[0.0])
    for la in (0.1, 10**-3.25, 1e-5):
        yield f"two folds, {la:.0e}", partial(_two_folds, la)
    for apart in (1e-2, 1e-4):
        yield f"two oscillations {apart:g} apart", partial(
            _curve, partial(folding.two_oscillations, apart, 0.111), "mu", -1.0, 1.0
        )
    yield "neutral saddle", partial(_curve, folding.neutral_saddle, "mu", 0.2, 3.0)
    yield "oscillator", partial(_oscillator, -1.0, 1.0)
    for name, field, low, high in (
        ("pitchfork", crossings.pitchfork, -1.0, 1.0),
        ("transcritical", crossings.transcritical, -1.0, 1.0),
        ("circle and line", crossings.circle_and_line, -1.5, 1.5),
        ("circle and two lines", crossings.circle_and_two_lines, -1.5, 1.5),
        ("two modes", crossings.two_modes, 0.0, 4.0),
    ):
        yield name, partial(_diagram, field, low, high)


def _together() -> Iterator[tuple[str, Job]]:
    """Vectorized fields; what each evaluates is shaken inside."""
    for name, field, *how in (
        ("ab", partial(fields.ab, 18.0), "D", 0.0, 0.6),
        ("adaptx", fields.adaptx, "alpha", 0.1, 2.0),
        ("brusselator", fields.brusselator, "B", 0.5, 8.0),
        ("two oscillations", partial(folding.two_oscillations, 1e-2, 0.111), "mu", -1.0, 1.0),
        ("hyperbolas", partial(folding.hyperbolas, 1e-3, 1.0), "la", -1.0, 1.0),
        ("neutral saddle", folding.neutral_saddle, "mu", 0.2, 3.0),
    ):
        yield f"{name}, side by side", partial(_curve, lambda f=field: fields.vectorized(f()), *how)
    for name, field in (("pitchfork", crossings.pitchfork), ("circle and two lines", crossings.circle_and_two_lines)):
        yield f"{name}, side by side", partial(_diagram, lambda f=field: fields.vectorized(f()), -1.5, 1.5)
    yield "folds of ab, side by side", partial(
        _locus, lambda: _curve(lambda: fields.vectorized(fields.ab(18.0)), "D", 0.0, 0.6), "LP1", "B", 8.0, 40.0
    )


def _loci() -> Iterator[tuple[str, Job]]:
    yield "folds of ab", partial(_locus, _ab, "LP1", "B", 8.0, 40.0)
    yield "Hopf points of ab", partial(_locus, _ab, "HB2", "B", 8.0, 24.0, end_at=())
    yield "folds of the cusp", partial(_locus, lambda: _curve(fields.cusp, "mu", -1.0, 1.0), "LP1", "la", -1.0, 2.0)
    yield "cusps", _cusps
    for sign in (1.0, -1.0):
        curve = partial(_curve, partial(locusfields.conic, sign), "la", -2.0, 2.0)
        yield f"conic {sign:+g}", partial(_locus, curve, "LP1", "mu", -1.5, 1.5)
    for name in ("k", "e"):
        curve = partial(_curve, locusfields.pitchfork, "mu", -1.0, 1.0)
        yield f"branch points in {name}", partial(_locus, curve, "BP1", name, -0.5, 0.5)
    for form, label in zip(locusforms.FORMS, ("HB1", "LP1"), strict=True):
        curve = partial(_curve, partial(locusforms.zero_hopf, *form), "b1", -1.5, 1.0)
        yield f"{label} beside a zero-Hopf point", partial(_locus, curve, label, "b2", -0.2, 0.4)
    yield "double Hopf", partial(
        _locus, lambda: _curve(locusforms.double_hopf, "mu", -1.0, 1.5), "HB1", "nu", 0.0, 1.0
    )


# -- random fields and linkages -------------------------------------------------------------------------------


def network(seed: int) -> mc.VectorField:
    """Return u' = -u + W tanh(u) + b p of two to five cells, W and b drawn at random: folds and Hopf points come."""
    random = np.random.default_rng(seed)
    n = int(random.integers(2, 6))
    weights, push = random.normal(0.0, 3.0 / math.sqrt(n), (n, n)), random.normal(0.0, 1.0, n)
    return mc.VectorField(lambda u, p: -u + weights @ np.tanh(u) + push * p["p"], np.zeros(n), {"p": 4.0})


def polynomial(seed: int) -> mc.VectorField:
    """Return a field of one to four components with random coefficients up to the third power, dissipative."""
    random = np.random.default_rng(1000 + seed)
    n = int(random.integers(1, 5))
    linear, push = random.normal(0.0, 1.0, (n, n)), random.normal(0.0, 1.0, n)
    square = random.normal(0.0, 0.5, (n, n, n))

    def f(u: np.ndarray, p: Any) -> np.ndarray:
        return linear @ u + np.einsum("ijk,j,k->i", square, u, u) - u**3 + push * p["p"]

    return mc.VectorField(f, np.zeros(n), {"p": 0.0})


def _random() -> Iterator[tuple[str, Job]]:
    for seed in range(8):
        yield f"network {seed}", partial(_curve, partial(network, seed), "p", -4.0, 4.0, max_points=400)
        yield f"polynomial {seed}", partial(_curve, partial(polynomial, seed), "p", -3.0, 3.0, max_points=400)
    for seed in range(20):
        yield f"linkage {seed}", partial(_linkage, seed)


def _linkage(seed: int) -> mc.Branch:
    mechanism = mc.Mechanism.from_xml(linkage(seed))
    return mc.continue_equilibria(mechanism, "M", bounds=(-30.0, 30.0), max_points=400)


# -- mechanisms -----------------------------------------------------------------------------------------------


def _mechanism(source: str, name: str, low: float, high: float, start: Any = None, **options: Any) -> mc.Branch:
    return mc.continue_equilibria(mc.Mechanism.from_xml(source), name, (low, high), start, **options)


def _shipped(model: str, closure: str) -> mc.Branch:
    """Return the branch of a linkage that loops close, by MuJoCo's constraints or by bushes."""
    close = mc.set_constraint_stiffness if closure == "native" else mc.add_bushes
    mechanism = mc.Mechanism.from_spec(close(model, stiffness=1e5))
    start = mechanism.qpos0[mechanism.state_labels.index(("crank", "rad"))]
    window = tuple(start + turn for turn in LOADED[model])
    return mc.continue_equilibria(mechanism, "M", (-20.0, 20.0), {"M": 0.0}, limits={"crank": window})


def _truss() -> list[Any]:
    steep = _mechanism("von_mises_truss", "P", -2000.0, 2000.0, {"a": 0.35}, keyframe="steep")
    return [steep, mc.switch_branches(steep.point("BP1")), _mechanism("von_mises_truss", "P", -300.0, 300.0)]


def _column_pushed_aside() -> list[mc.Branch]:
    links, start = mc.Mechanism.from_xml("buckling_column"), {"H": 0.01, "P": 10.0}
    branch = mc.continue_equilibria(links, "P", (0.0, 12.0), start, keyframe="leaning_left")
    return [branch, mc.continue_special(branch.point("LP1"), "H", bounds=(-0.5, 0.5))]


def _overcentre_folds(k_j: float = 1e6) -> list[mc.Branch]:
    branch = _mechanism("overcentre", "F", -50.0, 60.0, {"F": 50.0, "k_j": k_j})
    loci = [mc.continue_special(p, "k_j", (8.0, 1e8), zeros={"k_j": 100.0}) for p in branch.of_kind("LP")]
    return [branch, *loci]


def _ziegler(b: float) -> mc.Branch:
    return mc.continue_equilibria(ziegler(b), "P", (0.0, 3.0), {"P": 0.0})


def _column_straight() -> mc.Branch:
    return mc.continue_equilibria(column(7), "P", (0.0, 200.0), direction=1)


def _mechanisms() -> Iterator[tuple[str, Job]]:
    for k_j in (8.0, 1e3):
        yield f"overcentre, k_j = {k_j:g}", partial(
            _mechanism, "overcentre", "F", -50.0, 60.0, {"F": 50.0, "k_j": k_j}
        )
    yield "overcentre, folds in stiffness", _overcentre_folds
    yield "overcentre, energy barrier", lambda: mc.energy_barrier(
        mc.find_equilibrium(mc.Mechanism.from_xml("overcentre"), {"F": 20.0})
    )
    yield "overcentre tree", partial(_mechanism, "overcentre_tree", "F", -50.0, 60.0, {"F": 50.0})
    yield "truss", _truss
    yield "column, whole diagram", lambda: mc.bifurcation_diagram(
        mc.Mechanism.from_xml("buckling_column"), "P", (0.0, 40.0)
    )
    yield "column, pushed aside", _column_pushed_aside
    yield "column of seven links", _column_straight
    for b in (0.1, 1.0):
        yield f"Ziegler's column, b = {b:g}", partial(_ziegler, b)
    for model in LOADED:
        for closure in ("native", "bush"):
            yield f"{model}, {closure}", partial(_shipped, model, closure)
    yield "tethered body", partial(_mechanism, "tethered_body", "F_x", -3.0, 3.0)
    yield "ball joint", partial(_mechanism, BALL, "P", -3.0, 3.0)
    yield "double crossing", partial(_mechanism, CROSSED, "P", 0.0, 3.0)
    for gravity in (0.5, 2.0):
        yield f"pendulum between stops, g = {gravity:g}", lambda g=gravity: mc.continue_equilibria(
            pendulum_with_stops(g), "M", bounds=(-5.0, 5.0)
        )
    yield "cable", lambda: mc.continue_equilibria(
        slider(cable()), "F", bounds=(-4.0, 10.0)
    )
    yield "toggle clamp", partial(_mechanism, "toggle_clamp", "M", -30.0, 30.0, {"M": 20.0}, keyframe="closed")


def _overcentre_shaken_by_its_force() -> mc.Branch:
    overcentre = mc.Mechanism.from_xml("overcentre")
    start, forcing = {"F": 30.0, "k_j": 1e3}, {"F": mc.Harmonic(5.0)}
    return mc.continue_response(overcentre, "frequency", (0.3, 0.35), forcing, start, direction=1)


def _motions() -> Iterator[tuple[str, Job]]:
    yield "relaxation oscillation", lambda: mc.continue_cycles(motions.van_der_pol(), "mu", (1.0, 3.0))
    yield "forced Duffing", lambda: mc.continue_response(motions.duffing(), "w", (0.8, 2.6))
    yield "overcentre, shaken by its force", _overcentre_shaken_by_its_force


PROBLEMS: dict[str, Job] = dict([*_fields(), *_together(), *_loci(), *_random(), *_mechanisms(), *_motions()])
