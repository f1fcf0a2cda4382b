"""Problems at which nothing can be computed, and a call of every numerical routine with one of them (`CASES`)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

import mjcont as mc
import mjcont.numerics.points.passage as passages
from mjcont.curves.walkers import equilibrium_detectors
from mjcont.numerics.equations import (
    adjoint,
    algebra,
    bordered,
    columns,
    defining,
    differences,
    newton,
    settings,
    starts,
    system,
)
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Pencil
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.points import balance, codim2, corner, events, kinds, looking, normalform, on_equilibria, on_loci
from mjcont.numerics.search import box, coordinates, creep, deflation, multistart, spanning, sphere
from mjcont.numerics.spectra import spectrum, stability, tracks, vibration
from mjcont.numerics.step import arclength, hermite, notes, turning
from mjcont.numerics.walk import between, filled, interior, kinks, longsteps, onebyone, trace
from mjcont.numerics.walk.steps import End

FIELDS = {
    "nan": lambda u, p: np.full(len(u), math.nan),
    "infinite": lambda u, p: np.full(len(u), math.inf),
    "zero": lambda u, p: np.zeros(len(u)),
    "constant": lambda u, p: np.ones(len(u)),
    "singular": lambda u, p: np.full(len(u), u.sum() - p["p"]),
    "huge": lambda u, p: 1e300 * (u - p["p"]),
}


@dataclass(frozen=True)
class Bad:
    """A problem at which every routine fails, and what the routines ask for besides."""

    kind: str
    n: int
    sparse: bool

    @cached_property
    def problem(self):
        f = FIELDS[self.kind]
        entries = {"nan": math.nan, "infinite": math.inf, "singular": 1.0}.get(self.kind, 0.0)
        matrix = 1e300 * np.eye(self.n) if self.kind == "huge" else np.full((self.n, self.n), entries)
        given = {"jacobian": lambda u, p: sparse.csc_matrix(matrix)} if self.sparse else {}
        return mc.VectorField(f, np.zeros(self.n), {"p": 0.0, "q": 1.0}, **given)

    x = property(lambda self: np.zeros(self.n))
    y = property(lambda self: np.zeros(1))
    v = property(lambda self: np.ones(self.n))
    values = property(lambda self: self.problem.values())
    sparse_jac = property(lambda self: sparse.csc_matrix(self.local.jac))
    settings = property(lambda self: settings.Settings())
    free = property(lambda self: Free("p", -1.0, 1.0))
    corrected = property(lambda self: newton.Corrected(self.x, self.y, self.local, None, 0, 0.0, 0.0, 0.0))

    @cached_property
    def system(self):
        return system.System(self.problem, self.values, [self.free])

    @property
    def local(self):
        return self.system.local(self.x, self.y)

    @property
    def matrix(self):
        return self.system.jacobian(self.local, self.y)

    def point(self, s=0.0):
        """Return a curve point; all lie in one place, whatever their arclength."""
        tangent = np.append(np.zeros(self.n), 1.0)
        return arclength.CurvePoint(self.x, self.y, tangent, 0.0, self.local, self.matrix, s)

    @property
    def pair(self):
        return self.point(), self.point(1e-6)

    def many(self):
        wide = np.full(self.n, math.inf)
        return multistart.Many(self.problem, self.values, True, False, np.zeros(self.n), wide)

    def slots(self):
        return coordinates.layout(self.problem.state_labels, self.problem.state_scale, self.x, {})

    def adjoint(self):
        square = system.System(self.problem, self.values, (), accurate=True)
        return adjoint.Adjoint(square, self.x, np.zeros(0))

    def located(self, detectors):
        """Look for special points with detectors between two points of the curve."""
        found = []
        for d in detectors:
            d.crossed(*self.pair)
            found.append(d.locate(*self.pair, []))
        return found

    def condition(self, build, aux=0):
        """Return a condition's values, its borders renewed in between."""
        made = build()
        made.value(self.local, np.zeros(aux))
        made.update(self.local, np.zeros(aux))
        found = made.value(self.local, np.zeros(aux))
        assert found.shape == (made.count,)
        return found

    def fold(self):
        return defining.Fold(self.local)

    def hopf_system(self):
        free = [self.free, Free("q", 0.0, 2.0)]
        full = system.System(self.problem, self.values, free, [defining.Hopf(self.local, 1.0)], True)
        return full, full.conditions[0]


def walk(bad):
    """Return how a walk from a point ends, with all detectors of a curve of equilibria."""
    stepper = onebyone.OneByOne(bad.system, bad.settings, equilibrium_detectors(bad.system, bad.settings, {}))
    ends = [item for item in trace.Walker(stepper).walk(bad.point()) if isinstance(item, End)]
    assert len(ends) == 1 and ends[0].message
    return ends[0].status


def pencil(bad):
    """Return a pencil with a singular mass and the field's stiffness."""
    stiffness = -bad.local.raw_jac
    stiffness = stiffness.toarray() if sparse.issparse(stiffness) else stiffness
    return Pencil(np.zeros((bad.n, bad.n)), np.eye(bad.n), stiffness)


def steps_without_points(bad):
    """Ask for what lies inside two steps: the first needs no point inside, and the second has no matrix."""
    ends = [bad.point(), bad.point(0.01), bad.point(0.4)]
    for before, after in zip(ends, ends[1:], strict=False):
        after.past = (arclength.Earlier(before.s, np.zeros(bad.n + 1), before.tangent, before.jac),)
    if sparse.issparse(ends[0].jac):
        return []
    long = longsteps.LongSteps(bad.system, bad.settings, lambda p: None)
    found = long.inside([(ends[0], ends[1]), (ends[1], ends[2])])
    assert found and (isinstance(found[-1], Refused) or bad.kind in ("zero", "singular", "huge", "constant"))
    return found


def filled_step(bad):
    """Take a long step from a point, as with matrices that are not sparse."""
    if bad.sparse:
        return None
    stepper = filled.Filled(bad.system, bad.settings)
    stepper.begin(bad.point())
    return stepper.attempt(bad.point(), 4.0 * bad.settings.ds_max)


CASES = {
    "adjoint.Adjoint": lambda b: b.adjoint().weights(b.v),
    "algebra.solve": lambda b: algebra.solve(np.zeros((b.n, b.n)), b.v),
    "algebra.inverses": lambda b: algebra.inverses(np.zeros((2, b.n, b.n))),
    "algebra.least_squares": lambda b: algebra.least_squares(np.full((b.n, b.n), math.nan), b.v),
    "algebra.singular": lambda b: algebra.singular(np.full((2, b.n, b.n), math.inf)),
    "algebra.eigenvalues": lambda b: algebra.eigenvalues(np.full((b.n, b.n), math.nan)),
    "algebra.symmetric_eigenvalues": lambda b: algebra.symmetric_eigenvalues(np.full((b.n, b.n), math.nan)),
    "algebra.eigenvectors": lambda b: algebra.eigenvectors(np.full((b.n, b.n), math.inf)),
    "algebra.root": lambda b: (algebra.root(lambda x: math.nan, 0.0, 1.0), algebra.root(lambda x: 1.0, 0.0, 1.0)),
    "algebra.cholesky": lambda b: algebra.cholesky(np.zeros((2, b.n, b.n))),
    "arclength.point_from": lambda b: arclength.first_point(b.system, b.x, b.y, 1.0, b.settings),
    "arclength.first_point": lambda b: arclength.first_point(b.system, b.x, b.y, 1.0, b.settings),
    "arclength.tangent_at": lambda b: arclength.tangent_at(b.system, b.local, b.y),
    "arclength.predict": lambda b: arclength.predict(b.point(), 0.1),
    "arclength.remembered": lambda b: arclength.remembered(b.point(), np.zeros(b.n + 1)),
    "arclength.advance": lambda b: arclength.advance(b.system, b.point(), 0.1, b.settings),
    "arclength.next_step": lambda b: arclength.next_step(0.1, b.point(), b.settings),
    "arclength.follows": lambda b: arclength.follows(*b.pair),
    "turning.may_turn_twice": lambda b: turning.may_turn_twice(b.system, *b.pair, 0),
    "turning.far_below": lambda b: turning.far_below(np.zeros(1)),
    "turning.pairs_may_turn_twice": lambda b: turning.pairs_may_turn_twice(np.zeros(2), np.zeros(2), np.zeros(2)),
    "turning.falls_between": lambda b: turning.falls_between(b.system, *b.pair),
    "turning.turning_fraction": lambda b: turning.turning_fraction(b.system, *b.pair, 0),
    "arclength.by_contraction": lambda b: arclength.by_contraction(b.point()),
    "arclength.turned_back": lambda b: arclength.turned_back(b.system, [b.point()]),
    "arclength.land": lambda b: arclength.land(b.system, b.point(), 0, 0.5, 0.1, b.settings),
    "arclength.land_beside": lambda b: arclength.land_beside(b.system, b.point(), 0, 0.5, b.settings),
    "arclength.aim": lambda b: arclength.aim(b.system, b.point(), 0.1, np.zeros(b.n + 1), steady=True),
    "turning.may_turn_beyond": lambda b: turning.may_turn_beyond(b.system, *b.pair),
    "between.rows_between": lambda b: None if b.sparse else between.rows_between(b.system, b.pair, 1e-6),
    "bordered.largest_in_rows": lambda b: bordered.largest_in_rows(b.matrix),
    "bordered.row_scale": lambda b: bordered.row_scale(b.matrix),
    "bordered.border": lambda b: bordered.border(b.local.jac, b.v[:, None], b.v[None]),
    "bordered.oriented": lambda b: [bordered.oriented(v) for v in (b.x, np.full(b.n, math.nan))],
    "bordered.null_vectors": lambda b: bordered.null_vectors(b.local.jac),
    "bordered.Factored": lambda b: (
        bordered.Factored(b.local.jac).solve(b.v), bordered.Factored(b.local.jac).solve_transposed(b.v),
        bordered.Factored(b.local.jac).last_column(), bordered.Factored(b.local.jac).sign,
    ),
    "box.projected": lambda b: box.projected(b.v, np.full(b.n, math.nan)),
    "box.minimise": lambda b: box.minimise(lambda u: (math.nan, np.full(b.n, math.nan)), b.v, tol=1e-6),
    "codim2.zero_hopf_coefficients": lambda b: codim2.zero_hopf_coefficients(b.problem, b.x, b.values, 1.0),
    "codim2.double_hopf_coefficients": lambda b: codim2.double_hopf_coefficients(b.problem, b.x, b.values, 1.0, 1.0),
    "columns.scaled": lambda b: columns.scaled(b.sparse_jac, b.v, math.nan * b.v),
    "columns.bordered": lambda b: columns.bordered(b.sparse_jac, math.nan * b.v[:, None], b.v[None], np.zeros((1, 1))),
    "columns.largest_entries": lambda b: columns.largest_entries(b.sparse_jac),
    "columns.weighted_sum": lambda b: columns.weighted_sum([math.nan, 1.0], [b.sparse_jac, b.sparse_jac]),
    "coordinates.layout": lambda b: coordinates.layout((), np.zeros(0), np.zeros(0), {}),
    "coordinates.with_turns": lambda b: coordinates.with_turns(
        b.slots(), [(name, "rad") for name, _ in b.problem.state_labels], b.x[None], b.many().residuals
    ),
    "coordinates.Coordinates": lambda b: coordinates.Coordinates(b.problem, b.slots()).steps(
        np.zeros((0, b.n)), np.zeros((0, b.n))
    ),
    "corner.loaded": lambda b: corner.loaded(b.system, b.x, b.y),
    "corner.loaded_at": lambda b: corner.loaded_at(b.system, b.point()),
    "corner.describe": lambda b: corner.describe(frozenset(), frozenset()),
    "corner.cross": lambda b: corner.cross(b.system, b.point(), b.settings),
    "corner.break_off": lambda b: corner.break_off(b.system, b.point()),
    "corner.CornerDetector": lambda b: b.located([corner.CornerDetector(b.system, b.settings)]),
    "creep.rates": lambda b: creep.rates(b.local),
    "creep.creep": lambda b: creep.creep(b.problem, b.x, b.values, most=20),
    "defining.parameter_slope": lambda b: defining.parameter_slope(lambda at: float(at.f[0]), b.local, "p"),
    "defining.dense_pencil": lambda b: defining.dense_pencil(b.local),
    "defining.Fold": lambda b: (b.condition(b.fold), b.fold().gradient(b.local, b.system, b.y)),
    "defining.BranchPoint": lambda b: b.condition(lambda: defining.BranchPoint(b.local, b.free), 1),
    "defining.Hopf": lambda b: b.condition(lambda: defining.Hopf(b.local, 0.0), 1),
    "defining.FoldCoefficient": lambda b: b.condition(lambda: defining.FoldCoefficient(b.fold(), b.local)),
    "defining.DoubleZero": lambda b: b.condition(lambda: defining.DoubleZero(b.fold(), b.local)),
    "defining.Transversality": lambda b: b.condition(lambda: defining.Transversality(b.fold(), b.local)),
    "deflation.newton": lambda b: deflation.newton(b.many(), np.zeros((3, b.n))),
    "deflation.Deflation": lambda b: deflation.newton(
        b.many(), np.zeros((3, b.n)), deflation.Deflation(lambda x: x[:, None] - b.x, np.full(b.n, math.inf))
    ),
    "differences.inward": lambda b: differences.inward(0.0, 1.0, (0.0, 0.0)),
    "differences.kept_within": lambda b: differences.kept_within(differences.PARAMETER, 1.0, 0.0, (0.0, 0.0)),
    "hermite.node_windows": lambda b: hermite.node_windows(np.zeros(2), np.zeros(1, dtype=int), 4, 0.2),
    "differences.stencil": lambda b: differences.stencil(True),
    "differences.jacobian_steps": lambda b: differences.jacobian_steps(np.zeros(b.n), differences.FOURTH_ORDER),
    "differences.jacobian_from_rows": lambda b: differences.jacobian_from_rows(
        np.zeros((2 * b.n, b.n)), np.zeros(b.n), differences.SECOND_ORDER
    ),
    "differences.length_of": lambda b: differences.length_of(b.x, b.v),
    "differences.directional": lambda b: differences.directional(b.problem, b.x, b.values, 0.0 * b.v, 3),
    "differences.by_orders": lambda b: differences.by_orders(np.full((7, b.n), np.nan), 2, 1e-2),
    "differences.combine": lambda b: differences.combine(lambda rows: rows, b.v, 2, 1e-2),
    "differences.settled_combine": lambda b: [
        differences.settled_combine(lambda rows, fill=fill: np.full((len(rows), b.n), fill), b.v[None], 2, 1e-2)
        for fill in (0.0, math.nan, math.inf)
    ],
    "differences.second_form": lambda b: differences.second_form(b.problem, b.x, b.values, b.v, 0.0 * b.v),
    "differences.product": lambda b: differences.product(b.problem, b.x, b.values, 0.0 * b.v),
    "differences.product_slopes": lambda b: differences.product_slopes(b.problem, b.x, b.values, 0.0 * b.v),
    "differences.bilinear_gradient": lambda b: differences.bilinear_gradient(b.problem, b.x, b.values, b.x, b.x),
    "on_equilibria.square_system": lambda b: on_equilibria.square_system(b.system, [b.fold()], b.corrected),
    "on_equilibria.fold_detector": lambda b: b.located([on_equilibria.fold_detector(b.system, b.settings)]),
    "on_equilibria.critical_pairs": lambda b: on_equilibria.critical_pairs(stability.local_spectrum(b.local)),
    "on_equilibria.critical_pair": lambda b: on_equilibria.critical_pair(stability.local_spectrum(b.local)),
    "on_equilibria.critical_square": lambda b: on_equilibria.critical_square(stability.local_spectrum(b.local)),
    "on_equilibria.critical_sum": lambda b: on_equilibria.critical_sum(stability.local_spectrum(b.local)),
    "on_equilibria.zero_detector": lambda b: b.located(
        [on_equilibria.zero_detector(b.system, lambda x, values: math.nan, "x", b.settings)]
    ),
    "on_equilibria.BranchPointDetector": lambda b: b.located([on_equilibria.BranchPointDetector(b.system, b.settings)]),
    "on_equilibria.HopfDetector": lambda b: b.located([on_equilibria.HopfDetector(b.system, b.settings)]),
    "events.bisect": lambda b: events.bisect(b.system, *b.pair, lambda p, q: True, lambda p, q: None, b.settings),
    "events.within": lambda b: events.within(b.system, *b.pair, b.corrected),
    "events.between": lambda b: events.between(b.system, b.point(), b.point(), 0.5),
    "events.approximate": lambda b: events.approximate(b.system, *b.pair, 0.5, b.settings),
    "events.guessed": lambda b: events.guessed(b.system, *b.pair, math.nan),
    "events.zero_fraction": lambda b: [events.zero_fraction(*v) for v in ((0.0, 0.0), (math.nan, 1.0))],
    "events.point_at": lambda b: events.point_at(b.system, b.point(), b.point(), b.corrected, 0.0),
    "events.ZeroDetector": lambda b: b.located([on_equilibria.fold_detector(b.system, b.settings)]),
    "looking.look": lambda b: looking.look(
        b.system, *b.pair, equilibrium_detectors(b.system, b.settings, {}), b.settings
    ),
    "events.ScalarZero": lambda b: b.condition(lambda: events.ScalarZero(lambda x, values: math.nan)),
    "filled.Filled": lambda b: filled_step(b),  # noqa: PLW0108
    "hermite.lagrange": lambda b: hermite.lagrange([], 0.0),
    "hermite.hermite": lambda b: hermite.hermite([0.0], 0.0),
    "hermite.lagrange_each": lambda b: hermite.lagrange_each(np.zeros((1, 3)), np.zeros(1)),
    "hermite.hermite_each": lambda b: hermite.hermite_each(np.zeros((1, 3)), np.zeros(1)),
    "hermite.mixed": lambda b: hermite.mixed(np.zeros((0, 2)), np.zeros((3, 1, 1)), np.zeros((0, 2), dtype=int)),
    "hermite.arc": lambda b: [hermite.arc(0.0, 1.0), hermite.arc(1.0, math.nan), hermite.arc(1.0, -1.0)],
    "hermite.combine": lambda b: hermite.combine([0.0], [b.v]),
    "interior.count_inside": lambda b: [interior.count_inside(v, v, b.settings) for v in (math.nan, math.inf)],
    "interior.fill": steps_without_points,
    "kinds.conditions_of": lambda b: [
        kinds.conditions_of(code, b.local, b.system, 0.0) for code in kinds.CONTINUABLE
    ],
    "kinds.found_on": lambda b: kinds.found_on(""),
    "kinds.holds_eigenvalues": lambda b: kinds.holds_eigenvalues(""),
    "kinds.name_of": lambda b: kinds.name_of(""),
    "kinks.across": lambda b: kinks.across(b.system, b.point(), 0.0, b.settings),
    "kinks.broken_off": lambda b: kinks.broken_off(b.system, b.point()),
    "kinks.at_bound": lambda b: kinks.at_bound(b.system, 0, math.nan).message,
    "longsteps.LongSteps": steps_without_points,
    "notes.Note": lambda b: notes.Note().get(b.point()),
    "onebyone.OneByOne": walk,
    "on_loci.lyapunov_at": lambda b: on_loci.lyapunov_at(b.local),
    "on_loci.fold_locus_detectors": lambda b: b.n > 1 or b.located(
        on_loci.fold_locus_detectors(b.system, b.fold(), b.settings)
    ),
    "on_loci.hopf_locus_detectors": lambda b: hopf_locus(b),  # noqa: PLW0108
    "on_loci.unfolding_stop": lambda b: on_loci.unfolding_stop(b.system),
    "on_loci.FirstLyapunov": lambda b: b.condition(lambda: on_loci.FirstLyapunov(1.0)),
    "multistart.shortened": lambda b: multistart.shortened(np.full((2, b.n), math.nan)),
    "multistart.spectral_step": lambda b: multistart.spectral_step(*b.many().linearize(np.zeros((2, b.n)))),
    "multistart.levenberg_marquardt": lambda b: multistart.levenberg_marquardt(b.many(), np.zeros((3, b.n))),
    "multistart.Many": lambda b: b.many().residuals(np.zeros((0, b.n))),
    "newton.with_row": lambda b: newton.with_row(b.matrix, None),
    "newton.length": lambda b: newton.length(np.zeros(0)),
    "newton.matrix_with_row": lambda b: newton.matrix_with_row(b.system, b.local, b.y, np.zeros(b.n + 1)),
    "newton.known_to": lambda b: newton.known_to(b.system, b.corrected),
    "newton.undefined": lambda b: newton.undefined(b.system),
    "newton.correct": lambda b: newton.correct(b.system, b.x, b.y, b.point().tangent, None, b.settings),
    "newton.solve": lambda b: newton.solve(system.System(b.problem, b.values, ()), b.x, np.zeros(0)),
    "newton.solve_linear": lambda b: newton.solve_linear(b.local.raw_jac, b.v),
    "starts.find_start": lambda b: starts.find_start(b.problem, b.x, b.values),
    "normalform.fold_coefficient": lambda b: normalform.fold_coefficient(b.local, b.x, b.x),
    "normalform.cusp_coefficient": lambda b: normalform.cusp_coefficient(b.local, b.x, b.x),
    "normalform.lyapunov": lambda b: normalform.lyapunov(b.problem, b.x, b.values, 0.0),
    "normalform.eigenvectors": lambda b: normalform.eigenvectors(np.zeros((b.n, b.n)), math.nan),
    "normalform.double_zero_coefficients": lambda b: normalform.double_zero_coefficients(b.problem, b.x, b.values),
    "normalform.pitchfork_coefficient": lambda b: normalform.pitchfork_coefficient(b.local, b.x),
    "normalform.crossing": lambda b: normalform.crossing(b.local, np.zeros((b.n + 1, 2)), b.x, 1.0),
    "normalform.FirstOrder": lambda b: normalform.FirstOrder(b.problem, b.x, b.values).second(b.v, 1j * b.v),
    "passage.passage": lambda b: passages.passage(b.local, b.v, b.v, b.v),
    "passage.runaway": lambda b: [passages.runaway(m) for m in (math.nan, math.inf, -1.0)],
    "passage.Passage": lambda b: passages.Passage(*4 * [{"constant": 1.0}.get(b.kind, math.nan)]).rate(math.nan),
    "spanning.spanning_tree": lambda b: spanning.spanning_tree(np.zeros((0, 2)), 3),
    "spanning.heights": lambda b: spanning.heights(np.zeros(0, dtype=int)),
    "sphere.ways_through": lambda b: sphere.ways_through(b.system, b.x, b.system.start_y(), 0, 1e-2),
    "balance.Balance": lambda b: balance.Balance(b.system, b.settings).pieces(*b.pair),
    "balance.multiple": lambda b: balance.multiple(balance.Piece(*b.pair, 2)),
    "tracks.motion_at": lambda b: tracks.motion_at(b.point()),
    "tracks.meetings": lambda b: [tracks.meetings(pair, 0, [], None) for pair in (b.pair, (b.point(), b.point()))],
    "tracks.interpolated": lambda b: [tracks.interpolated(pair, 0) for pair in (b.pair, (b.point(), b.point()))],
    "tracks.tracks": lambda b: [tracks.tracks(pair, 0) for pair in (b.pair, (b.point(), b.point()))],
    "vibration.vibration": lambda b: vibration.vibration(pencil(b)),
    "vibration.frequency_response": lambda b: vibration.frequency_response(pencil(b), np.array([0.0, math.nan]), b.v),
    "spectrum.companion": lambda b: spectrum.companion(*vars_of(pencil(b))),
    "spectrum.spectrum": lambda b: (spectrum.spectrum(b.local.pencil), spectrum.spectrum(pencil(b))),
    "spectrum.symmetric": lambda b: spectrum.symmetric(np.full((b.n, b.n), math.nan)),
    "spectrum.quadratic_eigenvalues": lambda b: spectrum.quadratic_eigenvalues(*vars_of(pencil(b))),
    "spectrum.conservative_spectra": lambda b: spectrum.conservative_spectra([pencil(b)]),
    "stability.spectrum_of": lambda b: stability.spectrum_of(b.point()),
    "stability.negative_stiffness": lambda b: stability.negative_stiffness(b.point()),
    "stability.spectra_of": lambda b: stability.spectra_of([]),
    "stability.spectra_at": lambda b: stability.spectra_at(b.problem, b.x[None], [b.values], {"p": (0.0, 1.0)}),
    "stability.verdicts": lambda b: stability.verdicts(b.pair, []),
    "stability.verdict_at": lambda b: [
        stability.verdict_at(k.holds, stability.local_spectrum(b.local)) for k in kinds.KINDS.values()
    ],
    "stability.tell": lambda b: stability.tell(b.point(), [], b.point()),
    "stability.local_spectrum": lambda b: stability.local_spectrum(b.local),
    "stability.rounding_samples": lambda b: stability.rounding_samples(b.local),
    "system.equation_scale": lambda b: system.equation_scale(b.local),
    "system.equation_sizes": lambda b: system.equation_sizes(np.zeros((0, b.n, b.n + 1))),
    "system.System": lambda b: b.system.error(b.local, b.x, b.y),
    "trace.Walker": walk,
    "trace.trace": lambda b: trace.trace(
        trace.Walker(onebyone.OneByOne(b.system, b.settings)), b.point(), None
    ).end.message,
}
# records without a computation of their own, and the guard, which has a test below
PLAIN = {
    "clock.TimeUp", "clock.allowance", "clock.check", "clock.expired", "clock.limited", "clock.unlimited",
    "trace.time_up",
    "arclength.Earlier", "arclength.CurvePoint", "between.Between", "box.Minimum", "coordinates.Slot", "creep.Crept",
    "events.Found", "events.Located", "events.Detector", "events.ByOrientation", "guard.raise_unexpected",
    "guard.guarded", "interior.Interior", "interior.Gap", "kinds.Kind", "multistart.Runs",
    "newton.Corrected", "starts.Start",
    "normalform.Crossing", "normalform.Lyapunov", "notes.Noted", "problem.Equations", "problem.Linearization",
    "problem.Pencil", "problem.Stencil", "problem.Varied", "refusals.Refused", "refusals.Why", "settings.Settings",
    "settings.check_numbers", "settings.make_settings",
    "spectrum.Spectrum", "steps.Status", "steps.End", "steps.Step", "steps.Neutral", "steps.Leap",
    "balance.Piece", "tracks.Modes", "tracks.Motion", "tracks.Meeting",
    "free.Free", "system.Local", "system.Condition", "trace.Trace",
}  # fmt: skip
BAD = [Bad(kind, n, s) for kind in FIELDS for n in (1, 2) for s in (False, True)]


def vars_of(p):
    return p.mass, p.damping, p.stiffness


def hopf_locus(bad):
    full, hopf = bad.hopf_system()
    y = full.start_y()
    point = arclength.CurvePoint(bad.x, y, np.zeros(bad.n + full.k), 0.0, full.local(bad.x, y), np.zeros((1, 1)))
    detectors = on_loci.hopf_locus_detectors(full, hopf, bad.settings, lyapunov=True)
    return [d.crossed(point, point) for d in detectors]
