"""What CasADi's functions and JAX offer, by differences: for machines that have neither."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

_STEP = 1e-3


def pushed(function, x, v):
    """The derivative of a function of an array along v, fourth order."""
    near, far = (function(x + s * _STEP * v) - function(x - s * _STEP * v) for s in (1.0, 2.0))
    return (8.0 * near - far) / (12.0 * _STEP)


class Matrix:
    """What a CasADi function returns."""

    def __init__(self, value):
        self._value = value

    def full(self):
        return self._value


class Casadi:
    """A function of column vectors with names, as `casadi.Function`: `compute` takes columns and returns columns."""

    def __init__(self, compute, inputs, outputs):
        self._compute, self._inputs, self._outputs = compute, inputs, outputs

    def __call__(self, *given):
        raise AssertionError("it is called by `call`")

    def name_in(self):
        return list(self._inputs)

    def name_out(self):
        return list(self._outputs)

    def n_in(self):
        return len(self._inputs)

    def n_out(self):
        return len(self._outputs)

    def size_in(self, i):
        return (list(self._inputs.values())[i], 1)

    def size_out(self, i):
        return (list(self._outputs.values())[i], 1)

    def numel_in(self, i):
        return self.size_in(i)[0]

    def numel_out(self, i):
        return self.size_out(i)[0]

    def nnz_out(self, i):
        return self.numel_out(i)

    def call(self, given):
        given = [np.asarray(g, dtype=float) for g in given]
        for g, (name, size) in zip(given, self._inputs.items(), strict=True):
            assert g.ndim == 2 and len(g) == size, (name, g.shape)  # as CasADi insists
        return [Matrix(found) for found in self._compute(*given)]

    def factory(self, name, inputs, outputs):
        assert inputs == self.name_in()
        wanted = [out.split(":") for out in outputs]

        def compute(*given):
            found = []
            for jac, out, of in wanted:
                assert jac == "jac"
                i, o = self.name_in().index(of), self.name_out().index(out)
                columns = [self._pushed(given, i, e[:, None])[o][:, 0] for e in np.eye(self.numel_in(i))]
                found.append(np.column_stack(columns))
            return found

        return Casadi(compute, self._inputs, {":".join(w): 0 for w in wanted})

    def _pushed(self, given, i, v):
        def at(x):
            return np.concatenate(self._compute(*given[:i], x, *given[i + 1 :]))

        return np.split(pushed(at, given[i], v), np.cumsum(list(self._outputs.values()))[:-1])

    def forward(self, count):
        assert count == 1
        n, m = self.n_in(), self.n_out()
        inputs = {**self._inputs, **{f"out{n}_{k}": v for k, v in self._outputs.items()},
                  **{f"fwd{n}_{k}": v for k, v in self._inputs.items()}}

        def compute(*given):
            own, seeds = given[:n], given[n + m :]
            parts = [self._pushed(own, i, seed) for i, seed in enumerate(seeds) if np.any(seed)]
            return [np.sum([part[o] for part in parts], axis=0) if parts else np.zeros(self.size_out(o))
                    for o in range(m)]

        return Casadi(compute, inputs, {f"fwd_{k}": v for k, v in self._outputs.items()})


class Compiled:
    """What `jax.jit` returns: a function with what else JAX offers of it."""

    def __init__(self, function):
        self.function = self.__wrapped__ = function

    def __call__(self, *args):
        return self.function(*args)

    def lower(self):
        """Only its presence counts."""

    def eval_shape(self):
        """Only its presence counts."""


def jax(wide=True):
    """The parts of JAX that a field uses."""

    def jacfwd(function, argnums=0):
        def derivative(u, p):
            if argnums == 0:
                return np.column_stack([pushed(lambda x: function(x, p), u, e) for e in np.eye(len(u))])
            found = {}
            for name, value in p.items():
                unit = np.eye(np.size(value)) if np.ndim(value) else [1.0]
                columns = [pushed(lambda x, n=name: function(u, {**p, n: x}), value, e) for e in unit]
                found[name] = np.column_stack(columns) if np.ndim(value) else columns[0]
            return found

        return derivative

    def vmap(function, in_axes, out_axes):
        assert in_axes[:2] == (1, -1) and out_axes == 1

        def mapped(u, p, *t):
            every = range(u.shape[1])
            return np.column_stack([function(u[:, i], {k: v[..., i] for k, v in p.items()}, *(s[i] for s in t))
                                    for i in every])

        return mapped

    def jvp(function, at, along):
        return function(*at), pushed(function, *at, *along)

    return SimpleNamespace(jit=Compiled, jacfwd=jacfwd, vmap=vmap, jvp=jvp, numpy=np,
                           config=SimpleNamespace(jax_enable_x64=wide))
