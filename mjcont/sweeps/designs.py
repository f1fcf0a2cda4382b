"""Designs of a sweep: which parameter values its cases have.

A design is a function of what varies, the number of cases and the seed alone: case i has the same values everywhere.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import product
from typing import Any

import numpy as np

from mjcont.arguments import check_fields
from mjcont.errors import ParameterError, unknown_name
from mjcont.numerics.equations.problem import Array

DESIGNS = ("latin hypercube", "monte carlo", "quasi-random", "grid", "list")
EXTENDABLE = ("monte carlo", "quasi-random")  # the first cases of a larger one are those of a smaller one
DISTRIBUTIONS = ("normal", "truncated normal", "uniform", "triangular", "lognormal")
_MOST = 1_000_000
_QUANTILES = 64  # of a distribution, to measure its width


@dataclass(frozen=True, slots=True)
class Spread:
    """How a parameter scatters about its nominal value.

    Attributes
    ----------
    kind : {"normal", "truncated normal", "uniform", "triangular", "lognormal"}
    width : float
        Standard deviation of the normal ones (of the logarithm for the lognormal, then always relative); half the
        range of the others.
    relative : bool
        Whether `width` is a fraction of the nominal value, not in the parameter's own unit.
    centre : float, optional
        Instead of the nominal value: mean, median or mode.
    cut : float
        Standard deviations at which a truncated normal ends.
    """

    kind: str
    width: float
    relative: bool = False
    centre: float | None = None
    cut: float = 3.0

    def __post_init__(self) -> None:
        """Refuse what is no distribution."""
        check_fields(self)
        if self.kind not in DISTRIBUTIONS:
            raise unknown_name("distribution", self.kind, DISTRIBUTIONS)
        if not (math.isfinite(self.width) and self.width > 0):
            raise ParameterError(f"the width of a {self.kind} distribution must be a positive number, got {self.width}")
        if not (math.isfinite(self.cut) and self.cut > 0):
            raise ParameterError(f"cut must be a positive number of standard deviations, got {self.cut}")
        if self.centre is not None and not math.isfinite(self.centre):
            raise ParameterError(f"centre must be a finite number, got {self.centre}")

    def quantiles(self, probability: Array, nominal: float) -> Array:
        """Return the values that are not exceeded with the given probabilities."""
        from scipy import stats

        centre = nominal if self.centre is None else self.centre
        if self.kind == "lognormal":
            if centre == 0:
                raise ParameterError("a lognormal distribution needs a centre other than zero")
            return np.asarray(centre * np.exp(self.width * stats.norm.ppf(probability)))
        width = self.width * abs(centre) if self.relative else self.width
        if width == 0:
            raise ParameterError("a relative width needs a centre other than zero: give it absolutely")
        if self.kind == "normal":
            scaled = stats.norm.ppf(probability)
        elif self.kind == "truncated normal":
            scaled = stats.truncnorm.ppf(probability, -self.cut, self.cut)
        elif self.kind == "uniform":
            scaled = 2.0 * probability - 1.0
        else:
            scaled = stats.triang.ppf(probability, 0.5, loc=-1.0, scale=2.0)
        return np.asarray(centre + width * scaled)


Vary = Mapping[str, "Spread | Sequence[float]"]


def make_design(
    design: str, vary: Vary, nominal: Mapping[str, float], *, cases: int | None = None, seed: int = 0
) -> Array:
    """Return the parameter values of every case, (N, d), in the order of `vary`.

    Raises
    ------
    NameLookupError, ParameterError
        If the design is unknown, or does not go with what varies.
    """
    if design not in DESIGNS:
        raise unknown_name("design", design, DESIGNS)
    if not vary:
        raise ParameterError("name at least one parameter that varies")
    drawn = [n for n, v in vary.items() if isinstance(v, Spread)]
    if design in ("grid", "list"):
        if drawn:
            raise ParameterError(f"a {design} needs values, {drawn[0]} has a distribution: use 'latin hypercube'")
        if cases is not None:
            raise ParameterError(f"the values of a {design} say how many cases there are: leave the number out")
        return _enumerated(design, vary)
    for name in vary:
        if name not in drawn:
            raise ParameterError(f"a {design} needs distributions, {name} has values: use 'grid' or 'list'")
    if cases is None or not 1 <= cases <= _MOST:
        raise ParameterError(f"a {design} needs a number of cases from 1 to {_MOST}, got {cases}")
    probability = _probabilities(design, cases, len(vary), seed)
    columns = []
    for k, (name, spread) in enumerate(vary.items()):
        assert isinstance(spread, Spread)
        try:
            columns.append(spread.quantiles(probability[:, k], nominal[name]))
        except ParameterError as error:
            raise ParameterError(f"{name}: {error}") from error
    return np.column_stack(columns)


def _probabilities(design: str, cases: int, dimensions: int, seed: int) -> Array:
    if seed < 0:
        raise ParameterError(f"seed must be a whole number from 0 on, got {seed}")
    random = np.random.Generator(np.random.PCG64(seed))
    inside = random.random((cases, dimensions))
    if design == "monte carlo":
        return np.clip(inside, 2.0**-54, None)  # no quantile is infinite
    if design == "quasi-random":
        from scipy.stats import qmc

        sequence = qmc.Sobol(dimensions, scramble=True, seed=np.random.Generator(np.random.PCG64(seed)))
        return np.clip(sequence.random_base2(max(cases - 1, 0).bit_length())[:cases], 2.0**-54, None)
    strata = np.column_stack([random.permutation(cases) for _ in range(dimensions)])
    return np.clip((strata + inside) / cases, 2.0**-54, None)


def _enumerated(design: str, vary: Vary) -> Array:
    axes: dict[str, list[float]] = {}
    for name, given in vary.items():
        try:
            axes[name] = [float(v) for v in given]  # type: ignore[union-attr]
        except (TypeError, ValueError) as error:
            raise ParameterError(f"{name}: the values must be numbers, got {given!r}") from error
        if not axes[name] or not all(map(math.isfinite, axes[name])):
            raise ParameterError(f"{name}: give at least one value, all of them finite")
    if design == "grid":
        if math.prod(map(len, axes.values())) > _MOST:
            raise ParameterError(f"this grid has more than {_MOST} cases")
        return np.array(list(product(*axes.values())))
    lengths = {name: len(a) for name, a in axes.items()}
    if len(set(lengths.values())) > 1:
        shown = ", ".join(f"{n} {k}" for n, k in lengths.items())
        raise ParameterError(f"in a list every parameter has as many values as there are cases, here: {shown}")
    return np.column_stack([np.array(a) for a in axes.values()])


def scales(vary: Vary, nominal: Mapping[str, float]) -> Array:
    """Return the root mean square change of each parameter from its nominal value, 1 where there is none, (d,).

    It depends on what varies alone, not on how many cases there are.
    """
    middles = (np.arange(_QUANTILES) + 0.5) / _QUANTILES
    found = []
    for name, v in vary.items():
        values = v.quantiles(middles, nominal[name]) if isinstance(v, Spread) else np.array(v, dtype=float)
        found.append(math.sqrt(np.mean((values - nominal[name]) ** 2)) or 1.0)
    return np.array(found)


def describe_design(
    design: str, vary: Vary, nominal: Mapping[str, float], cases: int | None, seed: int
) -> dict[str, Any]:
    """Return what decides the values of each case, as plain data; the number of cases where they depend on it."""
    drawn = {n: asdict(v) if isinstance(v, Spread) else [float(x) for x in v] for n, v in vary.items()}
    how: dict[str, Any] = {"design": design, "vary": drawn, "nominal": dict(nominal)}
    if design not in ("grid", "list"):
        how["seed"] = seed
    return how if design in EXTENDABLE else {**how, "cases": cases}
