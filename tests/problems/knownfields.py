"""Random fields of 1 to 30 unknowns whose special points and stability are known in closed form.

    x' = sigma h(x, p),   z_j' = g_j(x) z_j - z_j^3,   |w_k|' = g_k(x) |w_k| - |w_k|^3,   angle' = omega_k

and terms of second order in z and w, seen through a random linear map and in random units. On the curve z = w = 0,
h(x, p) = 0, or p = P(x), there is a fold where P' = 0, a branch point where a g_j and a Hopf point where a g_k changes
its sign, and as many unstable eigenvalues as the signs of h_x and of these tell.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

import mjcont as mc
from problems.fields import vectorized

Function = Callable[[float], float]
REACH = 0.93
# noise of eigenvalues, in parts of the Jacobian, that differences of fourth order leave (`numerics/spectra/tracks.py`)
NOISE = 1e-11


@dataclass
class Curve:
    """The curve p = P(x) from `start` to `reach`: h(x, p), P, h_x on it, folds, and where points may lie."""

    flow: Callable[[float, float], float]
    value: Function
    rate: Function
    folds: list[float] = field(default_factory=list)
    start: float = -REACH
    reach: float = REACH
    room: tuple[float, float] = (-0.8, 0.8)

    def bounds(self):
        """Return the range of p, a little more than what P takes up to `reach`."""
        ends = [self.value(x) for x in np.linspace(self.start, self.reach, 2001)]
        margin = 0.02 * (max(ends) - min(ends))
        return min(ends) - margin, max(ends) + margin


@dataclass
class Growth:
    """A growth rate as a function of x, its zeros, and whether it is that of an oscillation.

    `lifts` is how far it is from zero between two zeros, and `together` how many rates share the zeros.
    """

    rate: Function
    zeros: list[float]
    oscillates: bool
    lifts: float = math.inf
    together: int = 1


@dataclass
class Known:
    """A field and what is known of it."""

    seed: int
    problem: mc.VectorField
    bounds: tuple[float, float]
    back: np.ndarray
    size: float
    growths: list[Growth]
    curve: Curve
    speed: float
    largest: float

    def truth(self):
        """Return (kind, x) of the special points that are to be found one by one."""
        found = [("LP", x) for x in self.curve.folds]
        for g in self.growths:
            if g.together == 1 and g.lifts > 100.0 * NOISE * self.largest:
                found += [("HB" if g.oscillates else "BP", x) for x in g.zeros]
        return sorted(found, key=lambda e: e[1])

    def doubtful(self):
        """Return (kind, x) of points nearer to each other than can be told: both, or one for both, or none."""
        dips = [g for g in self.growths if g.lifts <= 100.0 * NOISE * self.largest]
        return [("HB" if g.oscillates else "BP", x) for g in dips for x in g.zeros]

    def multiple(self):
        """Return (kind, x) of points at which several eigenvalues reach the axis together."""
        found = {("HB" if g.oscillates else "BP", x) for g in self.growths if g.together > 1 for x in g.zeros}
        return sorted(found, key=lambda e: e[1])

    def unstable(self, x):
        """Return the number of unstable eigenvalues at x, None within 1e-6 of a change."""
        rates = [(g.rate(x), 2 if g.oscillates else 1) for g in self.growths] + [(self.speed * self.curve.rate(x), 1)]
        least = min(abs(r) for r, _ in rates)
        return None if least < max(1e-6, 1e-9 * self.largest) else sum(n for r, n in rates if r > 0.0)


# -- curves -------------------------------------------------------------------------------------------------------


def along(value, slope, folds=()):
    """Return the curve of x' = p - P(x)."""
    return Curve(lambda x, p: p - value(x), value, lambda x: -slope(x), list(folds))


def straight(rng):
    """Return a curve without folds."""
    return along(lambda x: 0.3 * x + 0.1 * x**3, lambda x: 0.3 + 0.3 * x**2)


def steep(rng):
    """Return a curve that is steep at x = 0."""
    width = 10.0 ** rng.uniform(-2.0, -0.5)
    return along(
        lambda x: 0.3 * x + 0.5 * math.tanh(x / width), lambda x: 0.3 + 0.5 / width / math.cosh(x / width) ** 2
    )


def folded(rng):
    """Return a curve with two folds."""
    a = place(rng, (-0.8, 0.8))
    b = a + 10.0 ** rng.uniform(-2.0, -0.3)
    return along(
        lambda x: x**3 / 3.0 - 0.5 * (a + b) * x * x + a * b * x, lambda x: (x - a) * (x - b), [a, b]
    )


def imperfect(rng):
    """Return one half of a pitchfork, p x - x^3 + e, or of a crossing, p x - x^2 - e, that an imperfection opens."""
    e = 10.0 ** rng.uniform(-11.0, -1.5)
    if rng.random() < 0.5:
        made = Curve(lambda x, p: p * x - x**3 + e, lambda x: x * x - e / x, lambda x: -2.0 * x * x - e / x)
        made.folds = [-((e / 2.0) ** (1 / 3))]
    else:
        made = Curve(lambda x, p: p * x - x * x - e, lambda x: x + e / x, lambda x: e / x - x, [-math.sqrt(e)])
    made.reach, made.room = -e / 0.9, (-0.8, -0.4)
    return made


CURVES = {straight: 0.4, folded: 0.25, steep: 0.15, imperfect: 0.2}


# -- growth rates -------------------------------------------------------------------------------------------------


def simple(zeros, sign=1.0, steep=1.0):
    """Return sign * steep * product of (x - zero), bounded below by its zeros alone."""
    return lambda x: sign * steep * math.prod(x - z for z in zeros)


def bump(centre, half, ratio, depth, sign):
    """Return depth (ratio exp(-((x - centre) / width)^2) - 1) times a sign, and its zeros, `half` from the centre."""
    width, zeros = half / math.sqrt(math.log(ratio)), [centre - half, centre + half]
    return lambda x: sign * depth * (ratio * math.exp(-(((x - centre) / width) ** 2)) - 1.0), zeros


def place(rng, room):
    """Return where a point may lie: irrational in every step."""
    return float(rng.uniform(*room))


def growths(rng, count, curve):
    """Return rates that fit in `count` unknowns, at least half of them with a pattern that is easily missed."""
    found = list[Growth]()
    pattern = str(rng.choice(["none", "pair", "opposite", "dip", "bump", "steep", "single", "together"]))
    first, second = bool(rng.random() < 0.5), bool(rng.random() < 0.5)
    if pattern == "together":
        second = first
    needs = {"none": 0, **dict.fromkeys(("pair", "opposite", "together"), 2 + first + second)}.get(pattern, 1 + first)
    if needs > count:
        return found
    at, gap = place(rng, curve.room), 10.0 ** rng.uniform(-6.0, -1.0)
    sign, slope = float(rng.choice([-1.0, 1.0])), 10.0 ** rng.uniform(-0.5, 0.5)
    if pattern in ("pair", "opposite", "together"):
        other, gap = (-sign if pattern == "opposite" else sign), gap if pattern != "together" else 0.0
        together = 1 + (pattern == "together")
        found.append(Growth(simple([at], sign, slope), [at], first, together=together))
        found.append(Growth(simple([at + gap], other), [at + gap], second, together=together))
    elif pattern == "dip":
        rate = simple([at, at + gap], sign, slope)
        found.append(Growth(rate, [at, at + gap], first, abs(rate(at + 0.5 * gap))))
    elif pattern == "bump":
        low, high = curve.bounds()
        least = min(0.01 * (high - low) * 1e-3 / abs(curve.value(at + 1e-3) - curve.value(at)), 0.1)
        half, depth = 10.0 ** rng.uniform(math.log10(least), -0.9), 10.0 ** rng.uniform(-1.0, 0.5)
        rate, zeros = bump(at, half, rng.uniform(1.5, 4.0), depth, sign)
        found.append(Growth(rate, zeros, first, abs(rate(at))))
    elif pattern == "steep":
        width = 10.0 ** rng.uniform(-2.0, -0.5)
        found.append(Growth(lambda x: sign * math.tanh((x - at) / width), [at], first))
    elif pattern == "single":
        found.append(Growth(simple([at], sign, slope), [at], first))
    return [*found, *steady(rng, count - needs)]


def steady(rng, count):
    """Return decays that fill `count` unknowns, or some of them."""
    found = list[Growth]()
    while count > 0 and rng.random() < 0.97:
        oscillates = bool(count > 1 and rng.random() < 0.3)
        decay = -(10.0 ** rng.uniform(-1.0, 1.0))
        found.append(Growth(lambda x, decay=decay: decay, [], oscillates))
        count -= 1 + oscillates
    return found


# -- fields -------------------------------------------------------------------------------------------------------


def known(seed):
    """Return the field of a seed."""
    rng = np.random.default_rng(seed)
    n = int(rng.choice([1, 2, 3, 4, 6, 10, 20, 30], p=[0.1, 0.2, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05]))
    curve = list(CURVES)[rng.choice(len(CURVES), p=list(CURVES.values()))](rng)
    every = growths(rng, n - 1, curve)
    n = 1 + sum(1 + g.oscillates for g in every)
    size = float(10.0 ** rng.uniform(-3.0, 3.0)) if rng.random() < 0.6 else 1.0
    speed, omegas = 10.0 ** rng.uniform(-0.5, 0.5), 10.0 ** rng.uniform(-0.3, 1.0, len(every))
    matrix = np.eye(n) if rng.random() < 0.3 else np.linalg.qr(rng.normal(size=(n, n)))[0]
    matrix = matrix @ (np.eye(n) + 0.3 * rng.normal(size=(n, n)) / math.sqrt(n))
    back, mirrored = np.linalg.inv(matrix), bool(rng.random() < 0.5)
    couplings = rng.normal(size=(n, n - 1)) / n * (rng.random() < 0.5)
    if mirrored:  # under z -> -z
        couplings[1:] = 0.0

    def f(u, p):
        z = back @ (np.asarray(u) / size)
        x = z[0]
        out, i = [speed * curve.flow(x, p["p"])], 1
        for g, omega in zip(every, omegas, strict=True):
            rate = g.rate(x)
            if g.oscillates:
                rate -= z[i] ** 2 + z[i + 1] ** 2
                out += [rate * z[i] - omega * z[i + 1], omega * z[i] + rate * z[i + 1]]
            else:
                out.append(rate * z[i] - z[i] ** 3)
            i += 1 + g.oscillates
        return size * (matrix @ (np.array(out) + couplings @ z[1:] ** 2))

    state = size * matrix @ np.concatenate([[curve.start], np.zeros(n - 1)])
    problem = mc.VectorField(f, state, {"p": curve.value(curve.start)})
    rates = [abs(g.rate(x)) for g in every for x in (curve.start, 0.0)]
    steepest = max(abs(curve.rate(x)) for x in np.linspace(curve.start, curve.reach, 201))
    largest = max([speed * steepest, *rates, *(w for w, g in zip(omegas, every, strict=True) if g.oscillates)])
    return Known(seed, problem, curve.bounds(), back, size, every, curve, speed, largest)


# -- judgement ----------------------------------------------------------------------------------------------------


def judge(case, branch):
    """Return what is wrong with a branch of a known field, sentences."""
    wrong = list[str]()
    xs = [float((case.back @ s)[0] / case.size) for s in branch.states]
    if max(xs) < case.curve.reach:
        wrong.append(f"ends at x = {max(xs)}: {branch.ends}")
    left, several, doubtful = case.truth(), case.multiple(), case.doubtful()
    left = [e for e in left if e[1] < max(case.curve.reach, *xs)]  # a fold beyond is passed in some
    for point in branch.special_points:
        x = float((case.back @ point.state)[0] / case.size)
        found = _nearest(left if point.converged else several, point.kind, x)
        if found is not None:
            (left if point.converged else several).remove(found)
        elif _nearest(doubtful, point.kind, x, 1e-4) is None:
            wrong.append(f"{_word(case, point.kind, x)} {point.label} at x = {x!r}, {point.note}")
    wrong += [f"missed {kind} at x = {x!r}" for kind, x in left + several]
    special = [x for _, x in case.truth() + case.multiple() + case.doubtful()]
    for x, count in zip(xs, branch.n_unstable, strict=True):
        expected = case.unstable(x)
        if expected is not None and expected != count and not any(abs(x - t) < 1e-5 for t in special):
            wrong.append(f"{count} unstable at x = {x!r}, not {expected}")
            break
    return wrong


def _nearest(points, kind, x, off=1e-6):
    """Return the point of a kind that lies where it was found, None where there is none."""
    own = [e for e in points if e[0] == kind and abs(e[1] - x) < off]
    return min(own, key=lambda e: abs(e[1] - x), default=None)


def _word(case, kind, x):
    """Return what a point is that is none of those that are left to be found."""
    near = [e for e in case.truth() + case.multiple() if e[0] == kind and abs(e[1] - x) < 1e-4]
    return "double" if any(abs(e[1] - x) < 1e-7 for e in near) else "misplaced" if near else "false"


def run(seed, together=False):
    """Follow the field of a seed, by itself or with a function of many states `together`; return what is wrong."""
    case = known(seed)
    problem = vectorized(case.problem) if together else case.problem
    branch = mc.continue_equilibria(problem, "p", case.bounds)
    return judge(case, branch)
