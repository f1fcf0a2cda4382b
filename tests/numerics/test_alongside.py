"""Folds and cusps of variants moved side by side, to where closed forms have them; what cannot be is said to be so."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

import mjcont as mc
from mjcont.numerics.equations.free import Free
from mjcont.numerics.points.alongside import Moved, move


def bent(u, p):
    """Equilibria y = x and la + mu z + p z^2 - r z^3 = 0, z = x - s: a fold where mu + 2 p z = 3 r z^2."""
    x, y = u
    z = x - p["s"]
    return [p["la"] + p["mu"] * z + p["p"] * z**2 - p["r"] * z**3 + 5.0 * (y - x), x - y]


FIELD = mc.VectorField(bent, [1.0, 1.0], {"la": 0.0, "mu": 3.0, "p": 0.0, "r": 1.0, "s": 0.0}, names=["x", "y"])
OWN = {1: ("la",), 2: ("la", "mu")}


def fold(p: float = 0.0, r: float = 1.0, s: float = 0.0, mu: float = 3.0) -> tuple[float, float]:
    """Return x and la of the upper fold."""
    z = (p + math.sqrt(p * p + 3.0 * r * mu)) / (3.0 * r)
    return s + z, -(mu * z + p * z**2 - r * z**3)


def cusp(p: float = 0.0, r: float = 1.0, s: float = 0.0) -> tuple[float, float, float]:
    """Return x, la and mu of the cusp, where all derivatives but the third vanish."""
    z = p / (3.0 * r)
    mu = 3.0 * r * z**2 - 2.0 * p * z
    return s + z, -(mu * z + p * z**2 - r * z**3), mu


def moved(
    start: Sequence[float], targets: Sequence[dict[str, float]], like: Sequence[int] | None = None
) -> Moved:
    """Move a point (x, la, ...) of the field as it is to variants."""
    names, count = OWN[len(start) - 1], len(targets)
    own = dict(zip(names, start[1:], strict=True))
    values = [FIELD.values(own)] * count + [{**FIELD.values(own), **t} for t in targets]
    free = [[Free(n, -3.0, 3.0, bounded=False) for n in names]] * count
    x = np.full((count, 2), start[0])
    columns = np.tile(start[1:], (count, 1))
    return move(FIELD, FIELD.variants(values, names), x, free, columns, np.array(like or [0] * count))


def spread(count: int) -> list[dict[str, float]]:
    random = np.random.default_rng(2)
    return [{"p": p, "r": 1.0 + r, "s": s} for p, r, s in 0.1 * random.uniform(-1.0, 1.0, (count, 3))]


def test_folds_come_to_where_their_closed_form_has_them() -> None:
    found = moved(fold(), spread(8))
    assert found.reached.all()
    for i, target in enumerate(spread(8)):
        x, la = fold(**target)
        np.testing.assert_allclose(found.x[i], x, rtol=1e-9)
        assert found.values[i, 0] == pytest.approx(la, rel=1e-12)


def test_cusps_come_to_where_their_closed_form_has_them_with_their_coefficient() -> None:
    found = moved(cusp(), spread(8))
    assert found.reached.all()
    for i, target in enumerate(spread(8)):
        x, la, mu = cusp(**target)
        np.testing.assert_allclose(found.x[i], x, atol=1e-9)
        np.testing.assert_allclose(found.values[i], [la, mu], atol=1e-12)
        # v = (1, 1) / sqrt(2), w = (1, 5) sqrt(2) / 6 and f_xxx(v, v, v) = -6 r (1, 0) / sqrt(8)
        assert found.coefficient[i] == pytest.approx(-target["r"] / 12.0, rel=1e-6)


def test_a_parameter_may_move_on_a_logarithmic_scale() -> None:
    own = {"la": 2.0, "p": 0.0}  # the lower fold, z = -1
    variants = FIELD.variants([FIELD.values(own), FIELD.values({**own, "s": 0.2, "mu": 3.1})], ("la",))
    free = [[Free("la", 1e-2, 20.0, bounded=False)]]
    found = move(FIELD, variants, np.full((1, 2), -1.0), free, np.array([[2.0]]), np.zeros(1, dtype=int))
    assert found.reached[0]
    z = math.sqrt(3.1 / 3.0)
    assert found.values[0, 0] == pytest.approx(3.1 * z - z**3, rel=1e-12)


def test_the_coefficient_of_a_fold_is_that_of_its_normal_form() -> None:
    found = moved(fold(), [{"p": 0.05, "r": 1.1}])
    z = fold(0.05, 1.1)[0]
    assert found.coefficient[0] == pytest.approx((2.0 * 0.05 - 6.0 * 1.1 * z) / (12.0 * math.sqrt(2.0)), rel=1e-8)


@pytest.mark.parametrize("start", [fold(), cusp()], ids=["fold", "cusp"])
def test_what_becomes_of_a_point_does_not_depend_on_its_fellows_to_the_bit(start: tuple[float, ...]) -> None:
    targets = [*spread(5), {"p": math.nan}, {"s": 50.0}]
    together, apart = moved(start, targets), moved(start, targets, list(range(len(targets))))
    for i, target in enumerate(targets):
        alone = moved(start, [target])
        for one in (together, apart):
            assert one.reached[i] == alone.reached[0] == (i < 5)
            for name in ("x", "values", "tolerance", "coefficient", "evaluations") if i < 5 else ():
                np.testing.assert_array_equal(getattr(one, name)[i], getattr(alone, name)[0])


def test_a_fold_that_has_ceased_to_exist_is_not_reached_and_its_fellows_are() -> None:
    # mu + 2 p z - 3 r z^2 has no zero where p^2 + 3 r mu < 0
    found = moved((*fold(mu=0.5),), [{"p": 0.01, "mu": 0.5}, {"mu": -0.1}, {"p": -0.01, "mu": 0.5}])
    assert found.reached.tolist() == [False, False, False]  # from where mu is 3 no fold of mu = 0.5 is there
    start = FIELD.values({"mu": 0.5, "la": fold(mu=0.5)[1]})
    targets = [{"p": 0.01}, {"mu": -0.1}, {"p": -0.01}]
    variants = FIELD.variants([start] * 3 + [{**start, **t} for t in targets], ("la",))
    free = [[Free("la", -3.0, 3.0, bounded=False)]] * 3
    x, la = fold(mu=0.5)
    found = move(FIELD, variants, np.full((3, 2), x), free, np.full((3, 1), la), np.zeros(3, dtype=int))
    assert found.reached.tolist() == [True, False, True]


def test_a_fold_never_comes_to_the_other_one() -> None:
    # folds at z = +-sqrt(mu / (3 r)) are 2 / sqrt(3) apart; s takes the lower one to where the upper one was
    x, la = fold(mu=1.0)
    start, gap = FIELD.values({"mu": 1.0, "la": la}), 2.0 / math.sqrt(3.0)
    variants = FIELD.variants([start, {**start, "s": gap}], ("la",))
    free = [[Free("la", -3.0, 3.0, bounded=False)]]
    found = move(FIELD, variants, np.full((1, 2), x), free, np.array([[la]]), np.zeros(1, dtype=int))
    assert not found.reached[0]
