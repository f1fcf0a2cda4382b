"""Statements about points, as an engineer writes them: "LP1.F == 14 N", "|CP1.F_ul| <= 400 over gusts"."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from mjcont.errors import ParameterError, unknown_name
from mjcont.results.points import Point
from mjcont.results.quantities import column_of, finite
from mjcont.results.units import conversion

# the quantities of each point, with their units
Known = Mapping[str, Mapping[str, str]]
BARRIER = "barrier"
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_FORM = re.compile(
    rf"(?P<left>[^<>=]+?)\s*(?P<relation>==|<=|>=)\s*(?P<value>{_NUMBER})\s*(?P<unit>(?!over\b).*?)\s*(?:\bover\s+(?P<over>\S+))?"
)
_EXPECTED = 'expected a statement such as "LP1.F == 14 N", "CP1.F_ul >= -400" or "|CP1.F_ul| <= 400 over gusts"'


@dataclass(frozen=True, slots=True)
class Statement:
    """A target or a limit on a quantity of a point.

    Attributes
    ----------
    text : as it was written.
    point, quantity : whose quantity it is.
    relation : "==", "<=" or ">=".
    value : SI and radians.
    unit : of the quantity.
    over : name of the load cases at which it must hold; empty for those of the point itself.
    """

    text: str
    point: str
    quantity: str
    relation: str
    value: float
    unit: str
    over: str = ""


def quantities_of(point: Point) -> dict[str, str]:
    """Return the quantities of a point, with their units."""
    own = {n: point.units.get(n, "") for n in (*point.parameters, *point.observables)}
    omega = {"omega": "rad/s"} if "omega" in getattr(point, "coefficients", {}) else {}
    return {**own, **omega, BARRIER: "J"}


def quantity_of(written: str, known: Known) -> tuple[str, str, str]:
    """Return the point, the quantity and its unit that "LP1.F" means.

    Raises
    ------
    ParameterError, NameLookupError
        If it is not written so, or there is no such point or quantity.
    """
    name, dot, quantity = written.strip().partition(".")
    if not dot:
        raise ParameterError(f'"{written}": name a point and a quantity of it, such as "{next(iter(known))}.F"')
    if name not in known:
        raise unknown_name("point", name, known)
    own = column_of(quantity, known[name])
    if own is None:
        raise unknown_name(f"quantity of {name}", quantity, known[name])
    return name, own, known[name][own]


def read_statements(given: Sequence[str], known: Known, cases: Collection[str]) -> list[Statement]:
    """Return what texts say; a limit on |q| is two.

    Raises
    ------
    ParameterError, NameLookupError
        If a text does not read so, or a point, quantity, unit or set of load cases is unknown.
    """
    found: list[Statement] = []
    for text in given:
        match = _FORM.fullmatch(" ".join(text.split()))
        if match is None:
            raise ParameterError(f'"{text}": {_EXPECTED}')
        left, relation, over = match["left"].strip(), match["relation"], match["over"] or ""
        bars = left.startswith("|") and left.endswith("|") and len(left) > 2
        point, quantity, unit = quantity_of(left.strip("| ") if bars else left, known)
        value = finite(f'"{text}": the value', float(match["value"]) * conversion(match["unit"].strip(), unit))
        if over and over not in cases:
            raise unknown_name("set of load cases", over, list(cases))
        if not bars:
            found.append(Statement(text, point, quantity, relation, value, unit, over))
            continue
        if relation != "<=" or value < 0.0:
            raise ParameterError(f'"{text}": a limit on |...| is written with <= and a positive number')
        found.append(Statement(text, point, quantity, "<=", value, unit, over))
        found.append(Statement(text, point, quantity, ">=", -value, unit, over))
    return found
