"""Normal-form coefficients of zero-Hopf and double Hopf points.

    zero-Hopf    s = sign(G200 G011), theta = 2 Re G110 / G200
    double Hopf  p11, p22, theta = p12 / p22, delta = p21 / p11

with G200 = <p0, B(q0, q0)>, G011 = <p0, B(q1, q1*)>, G110 = <p1, B(q0, q1)>, and p_jk the real parts of the cubic
coefficients of the amplitude equations. Source: Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., sections
8.5 and 8.6. A second-order problem is taken in its first-order form.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mjcont.numerics.equations.bordered import null_vectors
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.numerics.points.normalform import FirstOrder, eigenvectors, shifted, solved

# a coefficient counts as zero below this part of the frequency, for amplitudes of the state's scale
_VANISHES = 1e-9


def zero_hopf_coefficients(problem: Equations, x: Array, values: Values, omega: float) -> tuple[dict[str, float], str]:
    """Return omega, s and theta of a zero-Hopf point of frequency omega, and a sentence where they are not defined.

    G200 vanishes under mirror symmetry (the zero eigenvalue is a pitchfork's), G011 where the oscillation does not
    shift the mean: the quadratic normal form says nothing then, and both coefficients are NaN.
    """
    form = FirstOrder(problem, x, values)
    jac = form.jacobian()
    q0, p0 = (v[:, 0] for v in null_vectors(jac))
    p0 = p0 / (p0 @ q0)
    q1, p1 = eigenvectors(jac, omega)
    g200 = float(p0 @ form.second(q0, q0))
    g011 = float(p0 @ form.second(q1, q1.conj()).real)
    g110 = complex(np.vdot(p1, form.second(q0, q1)))
    floor, along, across = _VANISHES * abs(omega), form.size(q0), form.size(q1)
    missing = [
        name
        for name, size in (("G200", abs(g200) / along), ("G011", abs(g011) * along / (across * across)))
        if not size > floor
    ]
    if missing:
        return {"omega": omega, "s": math.nan, "theta": math.nan}, f"{_degenerate(missing)}: no s, no theta"
    return {"omega": omega, "s": float(np.sign(g200 * g011)), "theta": 2.0 * g110.real / g200}, ""


def double_hopf_coefficients(
    problem: Equations, x: Array, values: Values, omega1: float, omega2: float
) -> tuple[dict[str, float], str]:
    """Return the frequencies and p11, p22, theta, delta of a double Hopf point, and a sentence where it is degenerate.

    theta and delta are NaN where the coefficient they are divided by vanishes.
    """
    form = FirstOrder(problem, x, values)
    jac = form.jacobian()
    q1, p1 = eigenvectors(jac, omega1)
    q2, p2 = eigenvectors(jac, omega2)
    b = form.second
    h1100, h0011, h2000, h0020, h1010, h1001 = (
        -solved(shifted(jac, 1j * rate), b(u, v))
        for rate, u, v in (
            (0.0, q1, q1.conj()), (0.0, q2, q2.conj()), (2.0 * omega1, q1, q1), (2.0 * omega2, q2, q2),
            (omega1 + omega2, q1, q2), (omega1 - omega2, q1, q2.conj()),
        )
    )
    own1 = form.trilinear(q1, q1, q1.conj()) + b(q1.conj(), h2000) + 2.0 * b(q1, h1100)
    own2 = form.trilinear(q2, q2, q2.conj()) + b(q2.conj(), h0020) + 2.0 * b(q2, h0011)
    cross1 = form.trilinear(q1, q2, q2.conj()) + b(q2.conj(), h1010) + b(q2, h1001) + b(q1, h0011)
    cross2 = form.trilinear(q2, q1, q1.conj()) + b(q1.conj(), h1010) + b(q1, h1001.conj()) + b(q2, h1100)
    p11, p22 = 0.5 * float(np.vdot(p1, own1).real), 0.5 * float(np.vdot(p2, own2).real)
    p12, p21 = float(np.vdot(p1, cross1).real), float(np.vdot(p2, cross2).real)
    floors = [_VANISHES * abs(w) * size * size for w, size in ((omega1, form.size(q1)), (omega2, form.size(q2)))]
    theta, delta = (
        cross / own if abs(own) > floor else math.nan
        for cross, own, floor in ((p12, p22, floors[1]), (p21, p11, floors[0]))
    )
    missing = [name for name, value in (("p11", delta), ("p22", theta)) if math.isnan(value)]
    coefficients = {"omega": omega1, "omega2": omega2, "p11": p11, "p22": p22, "theta": theta, "delta": delta}
    return coefficients, _degenerate(missing) if missing else ""


def _degenerate(missing: Sequence[str]) -> str:
    return f"degenerate, {' and '.join(missing)} {'vanishes' if len(missing) == 1 else 'vanish'}"
