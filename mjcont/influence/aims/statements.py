"""Statements about points, as an engineer writes them: "LP1.F == 14 N", "|CP1.F_ul| <= 400 over gusts"."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mjcont.errors import ParameterError, unknown_name
from mjcont.results.points import Point, show
from mjcont.results.quantities import column_of, finite
from mjcont.results.units import conversion

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

    @property
    def name(self) -> str:
        """The quantity with its point."""
        return f"{self.point}.{self.quantity}"

    def __str__(self) -> str:
        """Return it with its value as shown."""
        over = f" over {self.over}" if self.over else ""
        return f"{self.name} {self.relation} {show(self.value, self.unit)}{over}"


def quantity_of(written: str, points: Mapping[str, Point]) -> tuple[str, str, str]:
    """Return the point, the quantity and its unit that "LP1.F" means.

    Raises
    ------
    ParameterError, NameLookupError
        If it is not written so, or there is no such point or quantity.
    """
    name, dot, quantity = written.strip().partition(".")
    if not dot:
        raise ParameterError(f'"{written}": name a point and a quantity of it, such as "{next(iter(points))}.F"')
    if name not in points:
        raise unknown_name("point", name, points)
    point = points[name]
    if quantity == BARRIER:
        return name, quantity, "J"
    known = [*point.parameters, *point.observables]
    known += ["omega"] if "omega" in getattr(point, "coefficients", {}) else []
    own = quantity if quantity in known else column_of(quantity, known)
    if own is None:
        raise unknown_name(f"quantity of {name}", quantity, [*known, BARRIER])
    unit = "rad/s" if own == "omega" else point.units.get(own, "")
    return name, own, unit


def read_statements(
    given: Sequence[str], points: Mapping[str, Point], cases: Mapping[str, Any]
) -> list[Statement]:
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
        point, quantity, unit = quantity_of(left.strip("| ") if bars else left, points)
        value = finite(f'"{text}": the value', float(match["value"]) * conversion(match["unit"].strip(), unit))
        if over and over not in cases:
            raise unknown_name("set of load cases", over, cases)
        if not bars:
            found.append(Statement(text, point, quantity, relation, value, unit, over))
            continue
        if relation != "<=" or value < 0.0:
            raise ParameterError(f'"{text}": a limit on |...| is written with <= and a positive number')
        found.append(Statement(text, point, quantity, "<=", value, unit, over))
        found.append(Statement(text, point, quantity, ">=", -value, unit, over))
    return found
