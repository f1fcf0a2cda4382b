"""Derivatives of f that the user gives: how they are called, and the shapes that they must have.

- `jacobian(u, p)`: df/du, (n, n), an array, scipy.sparse, or an operator with a shape and `matvec(v)`
- `dfdp(u, p)`: df/dp, a mapping of names to (n,), or (n, number of parameters) in their order
- `second(u, p, v, w)`: D2f[v, w], (n,)
- `third(u, p, v, w, z)`: D3f[v, w, z], (n,)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.errors import FunctionError, MjcontError, did_you_mean, leaves_domain
from mjcont.fields.functions import numbers, raised
from mjcont.fields.parameters import Arrays
from mjcont.numerics.equations.problem import Array, Matrix

# unknowns up to which an operator, or one without a value, is made into a dense matrix
_MOST_PRODUCTS = 2000
_FORMS = {2: "second", 3: "third"}


@dataclass(frozen=True, slots=True)
class Derivatives:
    """The derivatives that a user gives; those that are None are not given.

    Where f overflows or leaves its domain they are NaN. `p` is what functions see (`Arrays.seen`).

    Attributes
    ----------
    owner : what messages call the field.
    n : number of unknowns.
    names : of all parameters, entries of arrays among them.
    """

    owner: str
    n: int
    names: tuple[str, ...]
    arrays: Arrays
    jacobian: Callable[..., Any] | None = None
    dfdp: Callable[..., Any] | None = None
    second: Callable[..., Any] | None = None
    third: Callable[..., Any] | None = None

    def _called(self, what: str, *args: Any) -> Any:
        """Return what a function returns, None where it has no value."""
        try:
            found = getattr(self, what)(*args)
        except MjcontError:
            raise
        except Exception as error:
            if leaves_domain(error):
                return None
            raise raised(f"the {what} of {self.owner}", error) from error
        if found is None:
            raise FunctionError(f"the {what} of {self.owner} returned nothing: a `return` may be missing")
        return found

    def _shaped(self, what: str, found: Any, shape: tuple[int, ...], more: str = "") -> Array:
        """Return numbers of a shape as floats."""
        try:
            own = numbers(f"the {what} of {self.owner}", found)
        except (TypeError, ValueError) as error:
            raise FunctionError(f"the {what} of {self.owner} returned no array of numbers: {error}") from error
        if own.shape != shape:
            raise self._misshapen(what, own.shape, shape, more)
        return own

    def _misshapen(self, what: str, found: tuple[int, ...], shape: tuple[int, ...], more: str = "") -> FunctionError:
        return FunctionError(f"the {what} of {self.owner} returned shape {found} for {self.n} unknowns{more}: expected "
                             f"{shape}")

    def matrix(self, x: Array, p: Mapping[str, Any]) -> Matrix:
        """Return df/du, (n, n), dense or scipy.sparse; an operator by its n products."""
        found = self._called("jacobian", x, p)
        square = (self.n, self.n)
        if found is None:  # of many unknowns the diagonal says as much
            many = self.n > _MOST_PRODUCTS
            return sparse.diags(np.full(self.n, np.nan), format="csc") if many else np.full(square, np.nan)
        if sparse.issparse(found):
            if found.shape != square:
                raise self._misshapen("jacobian", found.shape, square)
            entries = sparse.csc_matrix(found)
            numbers(f"the jacobian of {self.owner}", entries.data)
            return entries.astype(float)
        if not _operator(found):
            return self._shaped("jacobian", found, square)
        self._check_operator(found)
        if self.n > _MOST_PRODUCTS:
            raise FunctionError(f"the jacobian of {self.owner} is an operator for {self.n} unknowns: up to "
                                f"{_MOST_PRODUCTS} its products are put into a matrix; return scipy.sparse instead")
        return np.column_stack([self._applied(found, e) for e in np.eye(self.n)])

    def product(self, x: Array, p: Mapping[str, Any], v: Array) -> Array:
        """Return (df/du) v, (n,); of an operator no matrix is made."""
        found = self._called("jacobian", x, p)
        if found is not None and _operator(found):
            self._check_operator(found)
            return self._applied(found, v)
        own: Array = self.matrix(x, p) @ v
        return own

    def _check_operator(self, found: Any) -> None:
        shape = tuple(getattr(found, "shape", ()))
        if shape != (self.n, self.n):
            raise self._misshapen("jacobian", shape, (self.n, self.n))

    def _applied(self, operator: Any, v: Array) -> Array:
        return self._shaped("product with the jacobian", operator.matvec(v.copy()), (self.n,))

    def slopes(self, x: Array, p: Mapping[str, Any]) -> dict[str, Array]:
        """Return df/dp by names of parameters, (n,) each; those that are not given are not there."""
        found, n, names = self._called("dfdp", x, p), self.n, self.names
        if found is None:
            return dict.fromkeys(names, np.full(n, np.nan))
        if not isinstance(found, Mapping):
            more = f" and {len(names)} parameters ({', '.join(names)}), or a mapping of names to ({n},)"
            return dict(zip(names, self._shaped("dfdp", found, (n, len(names)), more).T, strict=True))
        slopes = dict[str, Array]()
        for name, value in found.items():
            if name in self.arrays.entries:
                entries = self.arrays.entries[name]
                columns = self._shaped(f"dfdp['{name}']", value, (n, len(entries))).T
                slopes.update(zip(entries, columns, strict=True))
            elif name in names:
                slopes[name] = self._shaped(f"dfdp['{name}']", value, (n,))
            else:
                valid = (*names, *self.arrays.entries)
                raise FunctionError(f"the dfdp of {self.owner} has '{name}', which is no parameter."
                                    f"{did_you_mean(str(name), valid)} Valid: {', '.join(sorted(valid))}.")
        return slopes

    def form(self, x: Array, p: Mapping[str, Any], *along: Array) -> Array | None:
        """Return D2f or D3f along two or three vectors, (n,), None if it is not given."""
        what = _FORMS[len(along)]
        if getattr(self, what) is None:
            return None
        found = self._called(what, x, p, *(v.copy() for v in along))
        return np.full(self.n, np.nan) if found is None else self._shaped(what, found, (self.n,))


def _operator(found: Any) -> bool:
    """Whether something only has products with vectors."""
    return not isinstance(found, np.ndarray) and not sparse.issparse(found) and callable(getattr(found, "matvec", None))
