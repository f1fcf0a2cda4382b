"""Mechanisms in other processes and in files: as their MJCF, with what was declared beside it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any

from mjcont.quantities import Observable


def packed(mechanism: Any) -> tuple[Any, ...]:
    """Return what pickle makes the mechanism from again; Python functions travel as pickle takes them, by name."""
    m = mechanism
    functions = {n: m.parameters[n].edit for n, given in m.declared.items() if "function" in given}
    observed = {n: o for n, o in m.observables.items() if o.source is None}
    model = m.mjcf if m.mjcf is not None else m._loaded
    return unpacked, (type(m), model, m._friction, dict(m.declared), functions, observed, m.held)


def unpacked(
    kind: Any, model: Any, friction: str, declared: Mapping[str, Mapping[str, Any]],
    functions: Mapping[str, Callable[[Any, float], None]], observed: Mapping[str, Observable], held: tuple[str, ...],
) -> Any:
    """Return the mechanism of `packed` again."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # said when it was made first
        make = kind.from_xml if isinstance(model, str) else kind.from_model
        mechanism = make(model, friction=friction)
    declare_again(mechanism, declared, functions)
    mechanism.observables.update(observed)
    return mechanism.holding(held) if held else mechanism


def declare_again(
    mechanism: Any, declared: Mapping[str, Mapping[str, Any]],
    functions: Mapping[str, Callable[[Any, float], None]] | None = None,
) -> None:
    """Declare on a mechanism what `Mechanism.declared` of another says; functions are given beside it."""
    for name, given in declared.items():
        if name in mechanism.parameters:
            continue
        how = {"unit": given["unit"], "bounds": tuple(given["bounds"])}
        if "function" in given:
            mechanism.declare(name, function=(functions or {})[name], value=given["value"], **how)
        else:
            mechanism.declare(name, *given["paths"], **how)
