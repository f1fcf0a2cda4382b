"""Normal forms of points of codimension two on curves of special orbits, for `exactorbits.around`.

Rates of the deviations y from an orbit of period 2 pi, in axes that turn with them by half a turn a period where
multipliers are to be negative: exponents l of rest are multipliers exp(2 pi l), or -exp(2 pi l). Free are p and q.
Source of the forms: Kuznetsov, Elements of Applied Bifurcation Theory, chapters 8 and 9.
"""

from __future__ import annotations


def double_one(y, p):
    """y1'' = p + q y1' - y1^2 + y1 y1' (Bogdanov and Takens): folds at p = 0, tori at p = q^2, q < 0; R1 at 0.

    Along the tori y1 = -q, and the exponents are +-i sqrt(-2 q).
    """
    return [y[1], p["p"] + p["q"] * y[1] - y[0] ** 2 + y[0] * y[1]]


def double_minus_one(y, p):
    """y1'' = p y1 + q y1' - y1^3 - y1^2 y1', odd: doublings of rest at p = 0, tori at q = 0, p < 0; R2 at 0.

    Along the tori the exponents are +-i sqrt(-p), and half a turn.
    """
    return [y[1], p["p"] * y[0] + p["q"] * y[1] - y[0] ** 3 - y[0] ** 2 * y[1]]


def third(y, p):
    """z' = (p + i q) z + z*^2 - |z|^2 z: tori of rest at p = 0, with a third of a turn 1:3 at q = 0."""
    a, b = y
    grows = p["p"] - a * a - b * b
    return [grows * a - p["q"] * b + a * a - b * b, p["q"] * a + grows * b - 2.0 * a * b]


def quarter(y, p):
    """z' = (p + i q) z + z*^3 / 2 - |z|^2 z: tori of rest at p = 0, with a quarter of a turn 1:4 at q = 0."""
    a, b = y
    grows = p["p"] - a * a - b * b
    cube = a**3 - 3.0 * a * b * b, b**3 - 3.0 * a * a * b
    return [grows * a - p["q"] * b + 0.5 * cube[0], p["q"] * a + grows * b + 0.5 * cube[1]]


def fold_and_flip(y, p):
    """A doubling of exponent q + y3 beside a fold y3' = p - y3^2: folds at p = 0, doublings at p = q^2, y3 = -q."""
    return [y[0] * (p["q"] + y[2] - y[0] ** 2), -y[1], p["p"] - y[2] ** 2]


def fold_and_torus(y, p):
    """A pair of exponents q + y3 +- 0.3 i beside a fold y3' = p - y3^2: folds at p = 0, tori at p = q^2, y3 = -q."""
    grows = p["q"] + y[2] - y[0] ** 2 - y[1] ** 2
    return [grows * y[0] - 0.3 * y[1], 0.3 * y[0] + grows * y[1], p["p"] - y[2] ** 2]


def flip_and_torus(y, p):
    """A doubling of exponent p beside a pair of exponents q + p +- 0.3 i: doublings at p = 0, tori at p = -q."""
    r2 = y[2] ** 2 + y[3] ** 2
    grows = p["q"] + p["p"] - r2 - y[0] ** 2
    return [y[0] * (p["p"] - y[0] ** 2 - 0.5 * r2), -y[1], grows * y[2] - 0.3 * y[3], 0.3 * y[2] + grows * y[3]]


def two_tori(y, p):
    """Pairs of exponents p +- 0.3 i and q + p +- 0.16 i: tori at p = 0 and at p = -q."""
    r1, r2 = y[0] ** 2 + y[1] ** 2, y[2] ** 2 + y[3] ** 2
    a, b = p["p"] - r1 - 0.5 * r2, p["q"] + p["p"] - 0.5 * r1 - r2
    return [a * y[0] - 0.3 * y[1], 0.3 * y[0] + a * y[1], b * y[2] - 0.16 * y[3], 0.16 * y[2] + b * y[3]]
