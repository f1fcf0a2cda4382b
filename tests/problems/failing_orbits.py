"""Motions of which nothing can be computed, and a call of every routine for orbits with one of them (`CASES`)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mjcont as mc
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import Corrected
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.orbits import (
    conserved,
    defining,
    detectors,
    fast,
    floquet,
    follow,
    forms,
    linger,
    loci,
    mesh,
    passing,
    points,
    quadrature,
    resonances,
    switch,
)
from mjcont.numerics.orbits.flow import Flow, Rates
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.scheme import scheme
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.steps import End
from problems.failing import FIELDS

ENTRIES = {"nan": math.nan, "infinite": math.inf, "singular": 1.0, "huge": 1e300}


class BadFlow(Flow):
    """A motion whose rates are those of a bad field, and their derivatives bad in the same way."""

    c, evaluations = 2, 0

    def __init__(self, kind, order, forced):
        self.kind, self.order, self.forced = kind, order, forced
        self.scale = np.ones(self.d)
        self.field = mc.VectorField(FIELDS[kind], np.zeros(2), {"p": 0.0, "q": 1.0})
        self.parameter, self.values = self.field.parameter, self.field.values
        self.parameter_stencil = self.field.parameter_stencil

    parameter = values = parameter_stencil = None  # those of the field

    def rates(self, states, phases, values):
        return np.array([FIELDS[self.kind](u[:2], values) for u in states]).reshape(len(states), 2)

    def derivatives(self, states, phases, values, wrt, accurate, ranges=()):
        entry, m = ENTRIES.get(self.kind, 0.0), len(states)
        return Rates(self.rates(states, phases, values), np.full((m, 2, self.d), entry),
                     np.full((m, 2, len(wrt)), entry))

    def period(self, values):
        return 2.0 * math.pi


class BadConservingFlow(BadFlow, conserved.ConservativeFlow):
    """The same, of which an energy is said to be kept."""

    chosen_by = conserved.ENERGY

    def values(self, given=None):
        return {**self.field.values({k: v for k, v in (given or {}).items() if k != "energy"}), "energy": 1.0}

    def energies(self, states, values):
        return self.rates(states, None, values)[:, 0]

    def energy_slopes(self, states, values):
        return np.full(states.shape, ENTRIES.get(self.kind, 0.0))

    def energy_rate(self, state, values, name):
        return ENTRIES.get(self.kind, 0.0)

    def unfolding(self, states, values):
        return self.rates(states, None, values)


@dataclass(frozen=True)
class BadMotion:
    """A motion at which every routine fails, and what the routines ask for besides."""

    kind: str
    order: int
    forced: bool

    @cached_property
    def flow(self):
        return BadFlow(self.kind, self.order, self.forced)

    @property
    def shift(self):
        return np.zeros(self.flow.d)

    @cached_property
    def path(self):
        """A circle, or nothing at all where the field is zero."""
        places, rule = np.linspace(0.0, 1.0, 4), scheme("radau", 2)
        size, d = (0.0 if self.kind == "zero" else 1.0), self.flow.d
        s = size * np.cos(2.0 * np.pi * places[:, None] + np.arange(d))
        return Path(rule, self.order, places, s, np.zeros((3, 2, 2)), 2.0 * math.pi)

    @cached_property
    def orbits(self):
        return follow.laid(self.flow, self.path, self.shift)

    settings = property(lambda self: Settings(max_points=4))
    meshes = property(lambda self: follow.MeshSettings(scheme("radau", 2), 3, 12))
    values = property(lambda self: self.flow.values())

    @cached_property
    def system(self):
        return System(self.orbits, self.values, [Free("p", -1.0, 1.0)])

    @property
    def two(self):
        return System(self.orbits, self.values, [Free("p", -1.0, 1.0), Free("q", 0.0, 2.0)])

    x = property(lambda self: self.orbits.joined(self.path))
    y = property(lambda self: self.system.start_y())

    @cached_property
    def local(self):
        return Local(self.orbits, self.x, self.values, ("p",), True, self.system.ranges)

    @cached_property
    def matrix(self):
        return self.system.jacobian(self.local, self.y)

    @cached_property
    def keeping(self):
        """The equations of its orbits, as if an energy were kept."""
        flow = BadConservingFlow(self.kind, self.order, False)
        del flow.values  # those of the class, with the energy
        return conserved.orbits_on(
            flow, self.path.scheme, self.path.mesh, self.path.s, self.shift, np.ones(flow.d), self.path.period
        )

    def kept_multipliers(self):
        orbits, s = self.keeping, self.path.s[0]
        linear = orbits.linearize(orbits.joined(self.path), orbits.flow.values(), ("p", "energy"))
        assert linear.jac.shape == (orbits.n, orbits.n)
        m = conserved.own_multipliers(orbits, linear.blocks, self.path.period, s, s)
        assert len(m.values) == len(m.own) + 2 == orbits.flow.d

    @property
    def kept_system(self):
        return System(self.keeping, self.keeping.flow.values(), [Free("p", -1.0, 1.0)])

    @property
    def kept(self):
        system, x = self.kept_system, self.keeping.joined(self.path)
        local = system.local(x, system.start_y())
        tangent = np.append(np.zeros(self.keeping.n), 1.0)
        return CurvePoint(x, system.start_y(), tangent, 0.0, local, system.jacobian(local, system.start_y()))

    def look_at_kept(self, detector):
        made, old, new = detector(self.kept_system, self.settings), self.kept, self.kept
        new.s = 1e-6
        made.crossed(old, new)
        made.locate(old, new, [])

    def in_quadrature(self):
        made = quadrature.InQuadrature(
            lambda u, tau, p: self.flow.rates(u, tau, p)[:, 0], lambda tau, p: 2.0 * np.pi * tau, 1.0
        )
        self.condition(made)
        assert made.gradient(self.local, self.system, self.y).shape == (1, self.orbits.n + 1)

    @property
    def blocks(self):
        return self.local.linearization.blocks

    @property
    def corrected(self):
        return Corrected(self.x, self.y, self.local, None, 0, 0.0, 0.0, 0.0)

    def point(self, s=0.0, tail=()):
        tangent = np.append(np.zeros(self.orbits.n), 1.0)
        return CurvePoint(self.x, np.append(self.y, tail), tangent, 0.0, self.local, self.matrix, s)

    def look(self, found):
        """Look for special points between two points that lie in one place."""
        ends = self.point(), self.point(1e-6)
        for d in found:
            d.crossed(*ends)
            d.locate(*ends, [])

    def condition(self, made, aux=0):
        """Return a condition's values, its borders renewed in between."""
        given = np.full(aux, 1.0)
        made.value(self.local, given)
        made.update(self.local, given)
        assert np.shape(made.value(self.local, given)) == (made.count,)

    def torus(self):
        held = loci.held_system("NS", self.two, self.x, np.append(self.two.start_y(), 1.0))
        assert held.conditions[0].count == 2


def walk(bad):
    """Follow a curve of orbits, which ends at once, with a status and a sentence."""
    trace = follow.trace_orbits(follow.Follower(bad.settings, bad.meshes), bad.system, bad.point())
    assert isinstance(trace.end, End) and len(trace.end.message.split()) >= 3
    return trace.end.status


BARE = np.full((3, 2, 2), math.nan)
CASES = {
    "conserved.orbits_on": lambda b: b.keeping,
    "conserved.ConservedOrbits": lambda b: b.keeping.residual(b.keeping.joined(b.path), b.keeping.flow.values()),
    "conserved.blur": lambda b: conserved.blur(np.full(4, ENTRIES.get(b.kind, 0.0))),
    "conserved.own_multipliers": BadMotion.kept_multipliers,
    "collocation.Orbits": lambda b: b.orbits.residual(b.x, b.values),
    "collocation.OrbitLinearization": lambda b: b.local.jac,
    "defining.orbits_of": lambda b: defining.orbits_of(b.local),
    "defining.bend": lambda b: defining.bend(b.local, b.system, b.y, np.ones(b.orbits.n), np.ones(b.orbits.n + 1)),
    "defining.turned": lambda b: defining.turned(b.local, -1.0, True),
    "defining.CycleFold": lambda b: b.condition(defining.CycleFold(b.local)),
    "defining.PeriodDoubling": lambda b: b.condition(defining.PeriodDoubling(b.local)),
    "defining.Torus": lambda b: b.condition(defining.Torus(b.local, 1.0), 1),
    "defining.CycleBranch": lambda b: b.condition(defining.CycleBranch(b.local, b.system.free[0]), 1),
    "detectors.FoldOfCycles": lambda b: b.look([detectors.FoldOfCycles(b.system, b.settings)]),
    "detectors.BranchOfCycles": lambda b: b.look([detectors.BranchOfCycles(b.system, b.settings)]),
    "detectors.located": lambda b: detectors.located(
        b.system, b.point(), b.point(1e-6), b.corrected, "LPC", defining.CycleFold(b.local)
    ),
    "fast.fast_modes": lambda b: fast.fast_modes(b.orbits, b.blocks, b.path.period),
    "fast.first_order_each": lambda b: fast.first_order_each(b.blocks.jac),
    "fast.exponentials": lambda b: fast.exponentials(BARE),
    "floquet.transfers": lambda b: floquet.transfers(b.blocks),
    "floquet.condensed": lambda b: floquet.condensed(np.zeros((3, 2, 2))),
    "floquet.multipliers": lambda b: floquet.multipliers(b.orbits, b.blocks, b.path.period, b.path.s[0]),
    "follow.laid": lambda b: b.orbits,
    "follow.carried_tangent": lambda b: follow.carried_tangent(b.system, b.point(), b.orbits),
    "follow.orbit_near": lambda b: follow.orbit_near(b.flow, b.path, b.values, b.shift, b.meshes),
    "follow.entered": lambda b: follow.entered(b.system, b.x, b.y, b.point().tangent, b.settings),
    "follow.OrbitByOrbit": lambda b: follow.OrbitByOrbit(b.system, b.settings).begin(b.point()),
    "follow.Follower": walk,
    "follow.trace_orbits": walk,
    "forms.square_of_fold": lambda b: forms.square_of_fold(b.point(), defining.CycleFold(b.local)),
    "forms.cubic_of_doubling": lambda b: forms.cubic_of_doubling(b.point()),
    "forms.cubic_of_torus": lambda b: forms.cubic_of_torus(b.point(), 1.0),
    "forms.side_of": lambda b: forms.side_of(math.nan),
    "linger.may_linger": lambda b: linger.may_linger(b.flow, b.path, b.values, b.orbits.sizes),
    "linger.lingering": lambda b: linger.lingering(b.flow, b.path, b.values, b.orbits.sizes),
    "linger.deviation": lambda b: linger.deviation(b.orbits, b.path),
    "linger.is_rest": lambda b: linger.is_rest(b.orbits, b.path),
    "linger.shrinks_slowly": lambda b: linger.shrinks_slowly(b.orbits, b.path, b.values, 1e-3 * b.path.period),
    "linger.shrunk_to": lambda b: linger.shrunk_to(b.orbits, b.path, b.values, True),
    "linger.first_order": lambda b: linger.first_order(b.flow, b.path.s[0], b.values),
    "loci.Meeting": lambda b: b.look([loci.Meeting("R1", b.system, b.settings, lambda point: math.nan)]),
    "loci.held": lambda b: [loci.held(k, b.point(tail=[1.0])) for k in ("LPC", "PD", "NS")],
    "loci.locus_detectors": lambda b: b.look(loci.locus_detectors("PD")(b.system, b.settings)),
    "loci.conditions_for": lambda b: loci.conditions_for("PD", b.local, np.zeros(0)),
    "loci.held_system": BadMotion.torus,
    "mesh.error_of": lambda b: mesh.error_of(b.path, np.zeros(b.flow.d)),
    "mesh.equidistributed": lambda b: mesh.equidistributed(b.path, b.orbits.sizes, 5),
    "mesh.first_mesh": lambda b: mesh.first_mesh(np.zeros((4, 2)), np.linspace(0.0, 1.0, 4), 5),
    "mesh.count_for": lambda b: mesh.count_for(b.path, 0.0, 1e-9),
    "passing.Crossing": lambda b: b.look([passing.Crossing(b.system, b.settings)]),
    "passing.cycle_detectors": lambda b: b.look(passing.cycle_detectors(b.system, b.settings)),
    "path.Path": lambda b: b.path.carried(np.array([0.0, 1.0])),
    "points.orbits_at": lambda b: points.orbits_at(b.point()),
    "points.path_at": lambda b: points.path_at(b.point()),
    "points.multipliers_at": lambda b: points.multipliers_at(b.point()),
    "points.error_at": lambda b: points.error_at(b.point()),
    "points.unstable": lambda b: points.unstable(points.multipliers_at(b.point())),
    "quadrature.InQuadrature": BadMotion.in_quadrature,
    "resonances.angles": lambda b: resonances.angles(b.kept),
    "resonances.energy_slope": lambda b: resonances.energy_slope(b.kept),
    "resonances.EnergyTurns": lambda b: b.look_at_kept(resonances.EnergyTurns),
    "resonances.InternalResonance": lambda b: b.look_at_kept(resonances.InternalResonance),
    "resonances.family_detectors": lambda b: [
        d.value(b.kept) for d in resonances.family_detectors(b.kept_system, b.settings)
    ],
    "resonances.Leaving": lambda b: b.look_at_kept(resonances.Leaving),
    "switch.departures": lambda b: switch.departures(
        b.flow, b.path, b.shift, b.system, b.x, b.y, (3, 1), b.settings
    ),
    "switch.doubled": lambda b: switch.doubled(b.flow, b.path, b.shift, b.system, b.x, b.y),
    "switch.crossing": lambda b: switch.crossing(b.system, b.x, b.y, b.point().tangent),
    "switch.system_at": lambda b: switch.system_at(b.flow, b.path, b.shift, b.values, tuple(b.system.free)),
}
# records, and bases of what stands above
PLAIN = {
    "collocation.Blocks", "conserved.ConservativeFlow", "defining.Multiplier", "fast.FastModes", "floquet.Multipliers",
    "flow.Rates", "flow.Flow",
    "follow.MeshSettings", "scheme.Scheme", "switch.Departure",
}  # fmt: skip
BAD = [BadMotion(kind, order, forced) for kind in FIELDS for order in (1, 2) for forced in (False, True)]
