"""The tables of a study on small motions about a rest: `[[modes]]` and `[[transfers]]`."""

from __future__ import annotations

from typing import Any

from mjcont.errors import unknown_name
from mjcont.oscillation.forced import Harmonic, check_forcing
from mjcont.studies import forms as f
from mjcont.studies import keys as k
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.keys import Context, Key, Kind, takes
from mjcont.studies.schema import Table

_NAME = Key(v.result_name, "Names its files, and the result elsewhere in the study.", needed=True)
_POINT = Key(r.reference("search", "branch", "locus", "path"),
             "The equilibrium, such as `\"equilibria:start\"`, `\"equilibria:LP1\"`, `\"found:E1\"`.", needed=True)


@takes(f.TEXT)
def _input(table: Table, key: str, context: Context) -> str:
    name = table.text(key)
    with k.about(table, key):
        check_forcing(context.mechanism, {name: Harmonic(1.0)})
    return name


@takes({**f.TEXTS, "minItems": 1})
def _outputs(table: Table, key: str, context: Context) -> tuple[str, ...]:
    names, valid = table.texts(key), context.mechanism.observables
    for i, name in enumerate(names):
        with context.noting():
            if name not in valid:
                raise table.error(f"{key}[{i}]", unknown_name("observable", name, valid))
    if not names:
        raise table.error(key, "expected at least one observable; leave the key out for all of them")
    return names


@takes(f.PAIR)
def _frequencies(table: Table, key: str, context: Context) -> tuple[float, float]:
    low, high = v.pair(table, key, "Hz")
    if low <= 0:
        raise table.error(key, f"frequencies must be positive, got {low:g} Hz")
    return low, high


def _check(found: dict[str, Any], table: Table, context: Context) -> None:
    if found["frequencies"] is None and "count" in table.data:
        raise table.error("count", "goes with frequencies = [low, high]")


MODES = Kind("modes", "Frequencies, damping and shapes of the modes at an equilibrium (`modes`), stored in NAME.h5.", {
    "name": _NAME, "point": _POINT,
    "csv": Key(v.flag, "Whether to write NAME.csv: a row a mode, with its shape.", True),
    "png": Key(v.flag, "Whether to draw NAME.png: the slowest modes of a mechanism that moves in a plane.", False),
})

TRANSFER = Kind("transfers", "Linear transfer functions at an equilibrium (`transfer`), stored in NAME.h5.", {
    "name": _NAME, "point": _POINT,
    "input": Key(_input, "The parameter that swings.", needed=True),
    "output": Key(_outputs, "Observables, such as `[\"theta_1\"]`.", (), otherwise="all"),
    "frequencies": Key(_frequencies, "`[low, high]`, in Hz.", otherwise="around the modes that swing"),
    "count": Key(v.whole(2), "How many, evenly spaced in their logarithm.", 400),
    "csv": Key(v.flag, "Whether to write NAME.csv: a row a frequency, gain and phase of each output.", True),
    "png": Key(v.flag, "Whether to draw NAME.png: gain and phase against frequency.", True),
}, _check)
