"""Functions of CasADi and JAX, recognised by what they offer: neither is needed, nor loaded unless one is given.

A CasADi function has `name_in`, `factory` and `forward`; its first input is u, another one a parameter by its name,
`t`, or all parameters in their order. What `jax.jit` returns has `lower` and `eval_shape`; it is called like a plain
function. Both then have derivatives of first to third order, exact, and take many states at once.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.errors import ParameterError
from mjcont.fields.parameters import Arrays
from mjcont.numerics.equations.problem import Array

# unknowns from which on a CasADi Jacobian is sparse, if no more than this part of it may be other than zero
_LARGE, _SPARSE = 200, 0.1
# the fewest columns that JAX compiles a function for; there are twice as many each time
_FEWEST = 8


@dataclass(frozen=True, slots=True)
class Offered:
    """What a function of another package offers, as `VectorField` takes it."""

    function: Callable[..., Any]
    jacobian: Callable[..., Any]
    dfdp: Callable[..., Any]
    second: Callable[..., Any]
    third: Callable[..., Any]
    timed: bool


def offered(function: Any, owner: str, n: int, names: Sequence[str], arrays: Arrays, timed: bool) -> Offered | None:
    """Return what a function offers beside its value; None for one of Python's own.

    Raises
    ------
    ParameterError
        If its inputs do not fit the unknowns and parameters, or JAX computes with 32 bits.
    """
    own: _Casadi | _Jax
    if all(callable(getattr(function, name, None)) for name in ("name_in", "numel_in", "factory", "forward")):
        own = _Casadi(function, owner, n, names, arrays)
        timed = own.timed
    elif all(callable(getattr(function, name, None)) for name in ("lower", "eval_shape")):
        try:
            jax = importlib.import_module("jax")
        except ImportError:
            return None
        own = _Jax(jax, function, owner, timed)
    else:
        return None
    return Offered(own.f, own.jacobian, own.dfdp, own.second, own.third, timed)


class _Casadi:
    """A CasADi function, its inputs read from p by their names."""

    def __init__(self, function: Any, owner: str, n: int, names: Sequence[str], arrays: Arrays) -> None:
        self._function, (self._state, *others) = function, list(function.name_in())
        for what, size in (("takes", function.numel_in(0)), ("returns", function.numel_out(0))):
            if size != n:
                raise ParameterError(f"the CasADi function of {owner} {what} shape {(size, 1)}, u0 has {n} unknowns: "
                                     f"expected {(n, 1)}")
        self._readers = [self._reader(name, function.numel_in(1 + i), owner, names, arrays)
                         for i, name in enumerate(others)]
        self.timed = "t" in others and "t" not in names
        out, inputs = function.name_out()[0], list(function.name_in())
        self._jacobian = function.factory("jacobian", inputs, [f"jac:{out}:{self._state}"])
        self._sparse = n >= _LARGE and self._jacobian.nnz_out(0) <= _SPARSE * n * n
        self._acting = [name for name in others if not (name == "t" and self.timed)]
        self._slopes = function.factory("dfdp", inputs, [f"jac:{out}:{name}" for name in self._acting])
        self._all = next((i for i, name in enumerate(self._acting) if name not in (*names, *arrays.entries)), None)
        self._ways = [function]
        for _ in range(3):
            self._ways.append(self._ways[-1].forward(1))

    def _reader(
        self, name: str, size: int, owner: str, names: Sequence[str], arrays: Arrays
    ) -> Callable[[Mapping[str, Any], Any], Any]:
        """Return what reads an input from p and t."""
        fits = {**{n: 1 for n in names}, **{n: len(entries) for n, entries in arrays.entries.items()}}
        if fits.get(name) == size:
            return lambda p, t: p[name]
        if name == "t" and name not in fits and size == 1:
            return lambda p, t: t
        if name not in fits and size == len(names):
            return _every(names, arrays)
        wanted = f"expected {fits[name]}" if name in fits else (
            f"expected the name of a parameter ({', '.join(fits)}), t, or one input with all {len(names)} numbers")
        raise ParameterError(f"the CasADi function of {owner} has an input '{name}' of {size} numbers: {wanted}")

    def _inputs(self, u: Array, p: Mapping[str, Any], t: Any = 0.0) -> list[Any]:
        return [_column(u, u.ndim), *(_column(read(p, t), u.ndim) for read in self._readers)]

    def f(self, u: Array, p: Mapping[str, Any], t: Any = 0.0) -> Array:
        """Return f, (n,) or (n, m)."""
        found = self._function.call(self._inputs(u, p, t))[0].full()
        return found if u.ndim == 2 else found[:, 0]

    def jacobian(self, u: Array, p: Mapping[str, Any]) -> Any:
        """Return df/du."""
        found = self._jacobian.call(self._inputs(u, p))[0]
        return found.sparse() if self._sparse else found.full()

    def dfdp(self, u: Array, p: Mapping[str, Any]) -> Any:
        """Return df/dp by names, or of all parameters."""
        found = [each.full() for each in self._slopes.call(self._inputs(u, p))] if self._acting else []
        if self._all is not None:
            return found[self._all]
        return {name: each[:, 0] if np.ndim(p[name]) == 0 else each
                for name, each in zip(self._acting, found, strict=True)}

    def _along(self, u: Array, p: Mapping[str, Any], *along: Array) -> Array:
        """Return a directional derivative: seeds follow the inputs and outputs of the function of one order less."""
        inputs = self._inputs(u, p)
        for order, v in enumerate(along):
            own = self._ways[order]
            outputs = [np.zeros(own.size_out(i)) for i in range(own.n_out())]
            seeds = [_column(v, 1), *(np.zeros(own.size_in(i)) for i in range(1, own.n_in()))]
            inputs = [*inputs, *outputs, *seeds]
        found: Array = self._ways[len(along)].call(inputs)[0].full()[:, 0]
        return found

    second = third = _along


class _Jax:
    """A function that JAX has compiled, its derivatives compiled likewise."""

    def __init__(self, jax: Any, function: Any, owner: str, timed: bool) -> None:
        if not jax.config.jax_enable_x64:
            raise ParameterError(f"the function of {owner} is JAX's, which computes with 32 bits until it is told: "
                                 'jax.config.update("jax_enable_x64", True)')

        def whole(u: Any, p: Any, *t: Any) -> Any:
            return jax.numpy.asarray(function(u, p, *t))

        def still(u: Any, p: Any) -> Any:
            return whole(u, p, 0.0) if timed else whole(u, p)

        def along(u: Any, p: Any, *vectors: Any) -> Any:
            f: Callable[[Any], Any] = functools.partial(still, p=p)
            for v in vectors:
                f = _pushed(jax, f, v)
            return f(u)

        self._one = jax.jit(whole)
        self._many = jax.jit(jax.vmap(whole, in_axes=(1, -1, 0) if timed else (1, -1), out_axes=1))
        self.jacobian, self.dfdp = jax.jit(jax.jacfwd(still)), jax.jit(jax.jacfwd(still, argnums=1))
        self.second = self.third = jax.jit(along)

    def f(self, u: Array, p: Mapping[str, Any], *t: Any) -> Any:
        """Return f, (n,) or (n, m)."""
        if u.ndim == 1:
            return self._one(u, dict(p), *t)
        m = u.shape[1]
        width = max(_FEWEST, 1 << (m - 1).bit_length())  # it is compiled for every number of columns
        columns = np.minimum(np.arange(width), m - 1)
        each = {name: np.broadcast_to(v, (*np.shape(v)[:-1], m))[..., columns] for name, v in p.items()}
        times = [np.broadcast_to(v, m)[columns] for v in t]
        return np.asarray(self._many(u[:, columns], each, *times))[:, :m]


def _pushed(jax: Any, f: Callable[[Any], Any], v: Any) -> Callable[[Any], Any]:
    """Return the derivative of f along v as a function."""
    return lambda x: jax.jvp(f, (x,), (v,))[1]


def _column(value: Any, ndim: int) -> Any:
    """Return an input as CasADi takes it: a column, or, for many states at once, a column for each."""
    found = np.asarray(value, dtype=float)
    if ndim == 1 or found.ndim == 0:
        return found.reshape(-1, 1)
    return found if found.ndim == 2 else found[None]


def _every(names: Sequence[str], arrays: Arrays) -> Callable[[Mapping[str, Any], Any], Array]:
    """Return what reads all parameters in their order, (k, 1), or (k, m) for many states at once."""
    places = {entry: (name, i) for name, entries in arrays.entries.items() for i, entry in enumerate(entries)}

    def read(p: Mapping[str, Any], t: Any) -> Array:
        del t
        each = [p[name] if name in p else p[places[name][0]][places[name][1]] for name in names]
        return np.stack(np.broadcast_arrays(*(np.atleast_1d(value) for value in each)))

    return read
