"""What verbs are given, held against their own annotations: a wrong kind of thing is named, with what to write instead.

Only kinds are looked at, and the names and numbers in mappings and lists; whether numbers fit is for the verb to say,
since it knows of what they are.
"""

from __future__ import annotations

import builtins
import functools
import inspect
import os
import types
import typing
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, fields
from numbers import Integral, Real
from typing import Any, ParamSpec, TypeVar, Union

import numpy as np

from mjcont.errors import ParameterError

P = ParamSpec("P")
R = TypeVar("R")
# what to write, by the kind that is wanted
_ADVICE = {
    "Model": 'such as mc.Mechanism.from_xml("overcentre") or mc.VectorField(f, u0, parameters)',
    "Mechanism": 'such as mc.Mechanism.from_xml("overcentre")',
    "Branch": "such as mc.continue_equilibria(...) or mc.load(path) return",
    "SpecialPoint": 'take one of a branch: branch.point("LP1")',
    "Point": 'take one of a branch: branch.point("LP1"), or branch.at(...)[0]',
    "Sweepable": 'such as mc.load_study(path) returns, or {"fold": branch.point("LP1")}',
    "Study": "such as mc.load_study(path) returns",
    "MjSpec": "Mechanism.from_xml takes paths and text, from_model compiled models",
    "MjModel": "Mechanism.from_xml takes paths and text, from_spec an MjSpec",
}
_CALLED = {"Model": "a Mechanism or a VectorField", "Sweepable": "a Study"}
# entries of a list or a mapping that are looked at, and what a message shows of a value
_LOOKED_AT, _LONGEST = 50, 40


def checked(verb: Callable[P, R]) -> Callable[P, R]:
    """Let a function or a method raise a ParameterError for arguments of a kind that its annotations exclude."""
    signature = inspect.signature(verb)

    @functools.cache
    def wanted() -> dict[str, list[_Kind]]:
        known = _Known({**vars(builtins), **verb.__globals__})
        return {name: _kinds(hint) for name, hint in typing.get_type_hints(verb, localns=known).items()}

    @functools.wraps(verb)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            given = signature.bind(*args, **kwargs).arguments
        except TypeError:
            return verb(*args, **kwargs)  # Python says itself what is missing, or one too many
        owner = type(args[0]).__name__ if "self" in signature.parameters else ""
        short = {"__init__": owner, "__getitem__": f"{owner}[...]"}
        called = short.get(verb.__name__, f"{owner}.{verb.__name__}".removeprefix("."))
        for name, value in given.items():
            kind, named = signature.parameters[name].kind, [(name, value)]
            if kind is inspect.Parameter.VAR_POSITIONAL:
                named = [(name, each) for each in value]
            elif kind is inspect.Parameter.VAR_KEYWORD:
                named = list(value.items())
            for own, each in named:
                _refuse_other(called, own, each, wanted().get(name, [_ANYTHING]))
        return verb(*args, **kwargs)

    return call


def check_fields(settings: Any) -> None:
    """Raise a ParameterError for fields of a dataclass of a kind that its annotations exclude."""
    hints = typing.get_type_hints(type(settings))
    for f in fields(settings):
        _refuse_other(type(settings).__name__, f.name, getattr(settings, f.name), _kinds(hints[f.name]))


class _Known(dict[str, Any]):
    """Names that annotations use; those that only type checkers know stand for anything."""

    def __missing__(self, name: str) -> Any:
        return Any


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of value: what it is called, whether a value is of it, and what to write."""

    called: str
    holds: Callable[[Any], bool]
    advice: str = ""


def _refuse_other(verb: str, name: str, value: Any, kinds: Sequence[_Kind]) -> None:
    if any(k.holds(value) for k in kinds):
        return
    called = list(dict.fromkeys(k.called for k in kinds if k.called != "None")) or ["None"]
    advice = f": {kinds[0].advice}" if kinds[0].advice else ""
    raise ParameterError(f"{verb}: {name} must be {_either(called)}, got {_shown(value)}{advice}")


def _shown(value: Any) -> str:
    """Return a value as a message shows it: its kind, and itself where that is short."""
    if value is None or isinstance(value, type):
        return "None" if value is None else f"the class {value.__name__}"
    plain = isinstance(value, str | bytes | int | float | complex | list | tuple | dict)
    text = " ".join(repr(value).split()) if plain else ""
    return f"the {type(value).__name__} {text if len(text) <= _LONGEST else ''}".rstrip()


def _kinds(hint: Any) -> list[_Kind]:
    """Return the kinds of values that an annotation allows."""
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if origin in (Union, types.UnionType):
        return [kind for h in inner for kind in _kinds(h)]
    if hint in _PLAIN:
        return [_PLAIN[hint]]
    if origin is Callable:
        return [_Kind("a function", callable)]
    if origin is np.ndarray:
        return [_Kind("an array of numbers", _numbers)]
    if isinstance(origin, type) and issubclass(origin, Mapping):
        advice = 'such as {"F": 20.0}' if inner[1] is float else ""
        return [_Kind("a dict", functools.partial(_mapping, keys=_kinds(inner[0])), advice)]
    if origin in (Collection, Sequence, list):
        entries = _kinds(inner[0]) if inner else [_ANYTHING]
        of = "" if entries == [_ANYTHING] else f" of {_either([_several(k.called) for k in entries])}"
        return [_Kind(f"a list{of}", functools.partial(_listed, entries=entries))]
    opaque = getattr(hint, "_is_protocol", False) and not getattr(hint, "_is_runtime_protocol", False)
    if origin is not None or opaque or not isinstance(hint, type) or hint in (Any, object, tuple, np.ndarray):
        return [_ANYTHING]
    if issubclass(hint, os.PathLike):
        return [_Kind("a path", lambda value: isinstance(value, os.PathLike))]
    word = hint.__name__
    called = _CALLED.get(word, f"{'an' if word[0] in 'AEIO' or word.startswith('Mj') else 'a'} {word}")
    return [_Kind(called, lambda value: isinstance(value, hint), _ADVICE.get(word, ""))]


def _either(words: Sequence[str]) -> str:
    *most, last = " or ".join(words).split(" or ")
    return ", ".join(most) + (" or " if most else "") + last


def _several(called: str) -> str:
    """Return what many of a kind are called."""
    word = called.partition(" ")[2]
    return word + ("es" if word.endswith(("h", "s")) else "s")


def _number(value: Any) -> bool:
    single = isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "iuf"
    return single or (isinstance(value, Real) and not isinstance(value, bool))


def _numbers(value: Any) -> bool:
    try:
        return np.asarray(value, dtype=float).ndim > 0
    except (TypeError, ValueError):
        return False


def _fit(values: Collection[Any], kinds: Sequence[_Kind]) -> bool:
    return all(any(k.holds(v) for k in kinds) for v in list(values)[:_LOOKED_AT])


def _mapping(value: Any, keys: Sequence[_Kind]) -> bool:
    return isinstance(value, Mapping) and _fit(value, keys)


def _listed(value: Any, entries: Sequence[_Kind]) -> bool:
    if isinstance(value, str | bytes | Mapping) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return False
    return isinstance(value, Collection | np.ndarray) and _fit(value, entries)


_ANYTHING = _Kind("anything", lambda value: True)
_PLAIN = {
    None: _Kind("None", lambda value: value is None),
    type(None): _Kind("None", lambda value: value is None),
    str: _Kind("a string", lambda value: isinstance(value, str)),
    bool: _Kind("True or False", lambda value: isinstance(value, bool | np.bool_)),
    int: _Kind("a whole number", lambda value: isinstance(value, Integral) and not isinstance(value, bool)),
    float: _Kind("a number", _number),
}
