"""Random fields of 1 to 30 unknowns whose special points and stability are known in closed form.

    x' = sigma (p - P(x)),   z_j' = g_j(x) z_j - z_j^3,   |w_k|' = g_k(x) |w_k| - |w_k|^3,   angle' = omega_k

seen through a random linear map. On the curve z = w = 0, p = P(x) there is a fold where P' = 0, a branch point where a
g_j and a Hopf point where a g_k changes its sign, and as many unstable eigenvalues as the signs of these tell.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

import mjcont as mc

Function = Callable[[float], float]
REACH = 0.93


@dataclass
class Growth:
    """A growth rate as a function of x, its zeros, and whether it is that of an oscillation."""

    rate: Function
    zeros: list[float]
    oscillates: bool


@dataclass
class Known:
    """A field and what is known of it."""

    seed: int
    problem: mc.VectorField
    bounds: tuple[float, float]
    state: np.ndarray
    back: np.ndarray
    size: float
    growths: list[Growth]
    slope: Function
    folds: list[float] = field(default_factory=list)

    def truth(self):
        """Return (kind, x) of the special points."""
        found = [("LP", x) for x in self.folds]
        for g in self.growths:
            found += [("HB" if g.oscillates else "BP", x) for x in g.zeros]
        return sorted(found, key=lambda e: e[1])

    def unstable(self, x):
        """Return the number of unstable eigenvalues at x, None within 1e-6 of a change."""
        rates = [(g.rate(x), 2 if g.oscillates else 1) for g in self.growths] + [(-self.slope(x), 1)]
        return None if min(abs(r) for r, _ in rates) < 1e-6 else sum(n for r, n in rates if r > 0.0)


def simple(zeros, sign=1.0, steep=1.0):
    """Return sign * steep * product of (x - zero), bounded below by its zeros alone."""
    return lambda x: sign * steep * math.prod(x - z for z in zeros)


def bump(centre, width, height, depth, sign):
    """Return a rate -depth + height exp(-((x - centre) / width)^2) times a sign, and its zeros."""
    half = width * math.sqrt(math.log(height / depth))
    return lambda x: sign * (height * math.exp(-(((x - centre) / width) ** 2)) - depth), [centre - half, centre + half]


def place(rng):
    """Return where a point may lie: irrational in every step."""
    return float(rng.uniform(-0.8, 0.8))


def growths(rng, room):
    """Return rates that fit in `room` unknowns, at least half of them with a pattern that is easily missed."""
    found = list[Growth]()

    def add(rate, zeros, oscillates):
        found.append(Growth(rate, zeros, oscillates))

    pattern = rng.choice(["none", "pair", "opposite", "dip", "bump", "steep", "single"])
    first, second = bool(rng.random() < 0.5), bool(rng.random() < 0.5)
    needs = {"none": 0, "pair": 2 + first + second, "opposite": 2 + first + second}.get(str(pattern), 1 + first)
    if needs > room:
        return found
    at, gap = place(rng), 10.0 ** rng.uniform(-6.0, -1.0)
    sign = float(rng.choice([-1.0, 1.0]))
    steep = 10.0 ** rng.uniform(-0.5, 0.5)
    if pattern in ("pair", "opposite"):
        other = -sign if pattern == "opposite" else sign
        add(simple([at], sign, steep), [at], first)
        add(simple([at + gap], other), [at + gap], second)
    elif pattern == "dip":
        gap = 10.0 ** rng.uniform(-4.0, -1.0)
        add(simple([at, at + gap], sign, steep), [at, at + gap], first)
    elif pattern == "bump":
        width, depth = 10.0 ** rng.uniform(math.log10(0.02), -0.7), 10.0 ** rng.uniform(-1.0, 0.5)
        rate, zeros = bump(at, width, depth * rng.uniform(1.5, 4.0), depth, sign)
        add(rate, zeros, first)
    elif pattern == "steep":
        width = 10.0 ** rng.uniform(-2.0, -0.5)
        add(lambda x: sign * math.tanh((x - at) / width), [at], first)
    elif pattern == "single":
        add(simple([at], sign, steep), [at], first)
    room -= needs
    while room > 0 and rng.random() < 0.8:
        oscillates = bool(room > 1 and rng.random() < 0.3)
        decay = -(10.0 ** rng.uniform(-1.0, 1.0))
        add(lambda x, decay=decay: decay, [], oscillates)
        room -= 1 + oscillates
    return found


def known(seed, sizes=(1.0,)):
    """Return the field of a seed, its state multiplied by one of `sizes`."""
    rng = np.random.default_rng(seed)
    n = int(rng.choice([1, 2, 3, 4, 6, 10, 20, 30], p=[0.1, 0.2, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05]))
    every = growths(rng, n - 1)
    n = 1 + sum(1 + g.oscillates for g in every)
    bend = rng.choice(["straight", "folds", "steep"], p=[0.5, 0.3, 0.2])
    folds = list[float]()
    if bend == "folds":
        a, gap = place(rng), 10.0 ** rng.uniform(-2.0, -0.3)
        b = a + gap
        folds = [a, b]

        def curve(x):
            return x**3 / 3.0 - 0.5 * (a + b) * x * x + a * b * x

        def slope(x):
            return (x - a) * (x - b)
    else:
        width = 10.0 ** rng.uniform(-1.5, -0.5) if bend == "steep" else 1.0

        def curve(x):
            return 0.3 * x + (0.5 * math.tanh(x / width) if bend == "steep" else 0.1 * x**3)

        def slope(x):
            return 0.3 + (0.5 / width / math.cosh(x / width) ** 2 if bend == "steep" else 0.3 * x**2)

    size, speed = float(rng.choice(sizes)), 10.0 ** rng.uniform(-0.5, 0.5)
    omegas = 10.0 ** rng.uniform(-0.3, 1.0, len(every))
    matrix = np.eye(n) if rng.random() < 0.3 else np.linalg.qr(rng.normal(size=(n, n)))[0]
    matrix = matrix @ (np.eye(n) + 0.3 * rng.normal(size=(n, n)) / math.sqrt(n))
    back = np.linalg.inv(matrix)

    def f(u, p):
        z = back @ (np.asarray(u) / size)
        x = z[0]
        out, i = [speed * (p["p"] - curve(x))], 1
        for g, omega in zip(every, omegas, strict=True):
            rate = g.rate(x)
            if g.oscillates:
                rate -= z[i] ** 2 + z[i + 1] ** 2
                out += [rate * z[i] - omega * z[i + 1], omega * z[i] + rate * z[i + 1]]
            else:
                out.append(rate * z[i] - z[i] ** 3)
            i += 1 + g.oscillates
        return size * (matrix @ np.array(out))

    start = -REACH
    ends = [curve(x) for x in np.linspace(-REACH, REACH, 2001)]
    low, high = min(ends), max(ends)
    margin = 0.02 * (high - low)
    state = size * matrix @ np.concatenate([[start], np.zeros(n - 1)])
    problem = mc.VectorField(f, state, {"p": curve(start)})
    return Known(seed, problem, (low - margin, high + margin), state, back, size, every, slope, folds)


def judge(case, branch):
    """Return what is wrong with a branch of a known field, sentences."""
    wrong = list[str]()
    xs = [float((case.back @ s)[0] / case.size) for s in branch.states]
    reached = max(xs)
    if reached < REACH:
        wrong.append(f"ends at x = {reached}: {branch.ends}")
    left = [(k, x) for k, x in case.truth() if min(xs) < x < reached]
    for point in branch.special_points:
        x = float((case.back @ point.state)[0] / case.size)
        own = [e for e in left if e[0] == point.kind]
        nearest = min(own, key=lambda e: abs(e[1] - x), default=None)
        if nearest is None or abs(nearest[1] - x) > 1e-6 or not point.converged:
            near = [e for e in case.truth() if e[0] == point.kind and abs(e[1] - x) < 1e-4]
            doubled = "double" if any(abs(e[1] - x) < 1e-7 for e in near) else "misplaced" if near else "false"
            if abs(x) < reached - 1e-3:
                wrong.append(f"{doubled} {point.label} at x = {x!r}, {point.note}")
            continue
        left.remove(nearest)
    wrong += [f"missed {kind} at x = {x!r}" for kind, x in left]
    for x, count in zip(xs, branch.n_unstable, strict=True):
        expected = case.unstable(x)
        special = any(abs(x - t) < 1e-5 for _, t in case.truth())
        if expected is not None and not special and expected != count:
            wrong.append(f"{count} unstable at x = {x!r}, not {expected}")
            break
    return wrong


def run(seed, sizes=(1.0,)):
    """Follow the field of a seed; return what is wrong."""
    case = known(seed, sizes)
    branch = mc.continue_equilibria(case.problem, "p", case.bounds)
    return judge(case, branch)
