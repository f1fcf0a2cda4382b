"""Units as people write them, and how large they are: the one table for study files, messages, plots and CSV.

A unit is a product of words with powers, "N*m/rad", "kN/mm", "m/s²"; each word has a size in SI and dimensions in
metre, kilogram, second and radian. The radian counts as a dimension, so that a torque is no stiffness about an axis.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache

from mjcont.errors import ParameterError, did_you_mean

Dimensions = tuple[int, int, int, int]
_LENGTH, _MASS, _TIME, _ANGLE, _NONE = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0, 0, 0, 0)
_FORCE, _ENERGY, _RATE, _PRESSURE = (1, 1, -2, 0), (2, 1, -2, 0), (0, 0, -1, 0), (-1, 1, -2, 0)
_POUND, _INCH, _GRAVITY = 0.45359237, 0.0254, 9.80665
# words for one unit: its size in SI and its dimensions
_ATOMS: tuple[tuple[str, float, Dimensions], ...] = (
    ("1", 1.0, _NONE), ("% percent", 0.01, _NONE),
    ("rad rads radian radians", 1.0, _ANGLE), ("deg degs degree degrees °", math.pi / 180.0, _ANGLE),
    ("mrad", 1e-3, _ANGLE), ("rev turn turns", 2.0 * math.pi, _ANGLE),
    ("m meter meters metre metres", 1.0, _LENGTH), ("cm", 1e-2, _LENGTH),
    ("mm millimeter millimeters millimetre millimetres", 1e-3, _LENGTH), ("um µm μm", 1e-6, _LENGTH),
    ("km", 1e3, _LENGTH), ("in inch inches", _INCH, _LENGTH), ("ft foot feet", 12.0 * _INCH, _LENGTH),
    ("kg kilogram kilograms", 1.0, _MASS), ("g gram grams", 1e-3, _MASS), ("t tonne tonnes", 1e3, _MASS),
    ("lb lbs lbm pound pounds", _POUND, _MASS),
    ("s sec second seconds", 1.0, _TIME), ("ms", 1e-3, _TIME), ("min minute minutes", 60.0, _TIME),
    ("h hour hours", 3600.0, _TIME), ("Hz hertz", 1.0, _RATE),
    ("N newton newtons", 1.0, _FORCE), ("mN", 1e-3, _FORCE), ("kN", 1e3, _FORCE), ("MN", 1e6, _FORCE),
    ("daN", 10.0, _FORCE), ("lbf", _POUND * _GRAVITY, _FORCE), ("kip kips", 1e3 * _POUND * _GRAVITY, _FORCE),
    ("kgf kp", _GRAVITY, _FORCE),
    ("Nm", 1.0, _ENERGY), ("Nmm", 1e-3, _ENERGY), ("kNm", 1e3, _ENERGY), ("J joule joules", 1.0, _ENERGY),
    ("mJ", 1e-3, _ENERGY), ("kJ", 1e3, _ENERGY),
    ("Pa", 1.0, _PRESSURE), ("kPa", 1e3, _PRESSURE), ("MPa", 1e6, _PRESSURE), ("GPa", 1e9, _PRESSURE),
)
_WORDS = {word: (size, dimensions) for words, size, dimensions in _ATOMS for word in words.split()}
# what messages list
COMMON = (
    "1", "rad", "deg", "m", "cm", "mm", "in", "ft", "kg", "g", "t", "lb", "s", "ms", "Hz", "N", "kN", "MN", "lbf",
    "N*m", "kN*m", "lbf*in", "lbf*ft", "N/m", "kN/m", "MN/m", "N/mm", "kN/mm", "lbf/in", "N*s/m", "kN*s/m", "N*m/rad",
    "kN*m/rad", "N*m/deg", "N*m*s/rad", "m/s^2", "rad/s", "deg/s", "J", "kJ",
)
_FACTOR = re.compile(r"(?P<word>[^\d\s*·/^²³]+|1)(?:\^?(?P<power>-?\d+)|(?P<raised>[²³]))?")
_JOINT = re.compile(r"\s*([*·/])\s*|\s+")
_RAISED = {"²": 2, "³": 3}


@cache
def measured(unit: str) -> tuple[float, Dimensions] | None:
    """Return the size of a unit in SI and its dimensions; None if it is none that is known.

    The sign of a power belongs to the factor: "m/s^2" is m s^-2. Words differ in case ("mN" is no "MN"); a word that is
    unknown as written is looked up without case where only one fits, "Deg" or "KG".
    """
    size, powers, sign = 1.0, [0, 0, 0, 0], 1
    for part in _parts(unit.strip()):
        if part in ("*", "·", "/"):
            sign = -1 if part == "/" else 1
            continue
        found = _FACTOR.fullmatch(part)
        atom = _atom(found["word"]) if found is not None else None
        if found is None or atom is None:
            return None
        power = sign * int(found["power"] or _RAISED.get(found["raised"], 1))
        size *= atom[0] ** power
        powers = [p + power * d for p, d in zip(powers, atom[1], strict=True)]
        sign = 1
    return size, (powers[0], powers[1], powers[2], powers[3])


def _parts(unit: str) -> list[str]:
    """Return the factors of a unit and what joins them."""
    return [p for p in _JOINT.split(unit) if p]


def _atom(word: str) -> tuple[float, Dimensions] | None:
    if word in _WORDS or len(word) == 1:
        return _WORDS.get(word)
    alike = {entry for known, entry in _WORDS.items() if known.casefold() == word.casefold()}
    return alike.pop() if len(alike) == 1 else None


def conversion(given: str, own: str) -> float:
    """Return how large the unit `given` is in `own`; in SI where `own` is empty.

    Raises
    ------
    ParameterError
        If it is unknown, or does not measure the same thing; the message lists what will do.
    """
    if not given or given == own:
        return 1.0
    found = measured(given)
    if found is None:
        raise ParameterError(f"unknown unit '{given}'.{did_you_mean(given, COMMON)} Valid: {', '.join(COMMON)}.")
    if not own:
        return found[0]
    target = measured(own)
    if target is None or target[1] != found[1]:
        raise ParameterError(f"'{given}' does not measure what '{own}' does. Valid units: {', '.join(fitting(own))}.")
    return found[0] / target[0]


def fitting(own: str) -> list[str]:
    """Return the common units that measure the same as one."""
    target = measured(own)
    return [u for u in COMMON if target is not None and (m := measured(u)) is not None and m[1] == target[1]] or [own]


def displayed(unit: str, wished: Sequence[str] = (), degrees: bool = True) -> tuple[str, float]:
    """Return the unit in which numbers in `unit` are shown, and the factor that brings them there.

    That is the first of `wished` that measures the same; degrees for radians; otherwise the unit itself.
    """
    own = measured(unit) if unit not in ("", "1") else None
    if own is not None:
        for wish in wished:
            found = measured(wish)
            if found is not None and found[1] == own[1]:
                return wish, own[0] / found[0]
    return ("deg", 180.0 / math.pi) if unit == "rad" and degrees else (unit, 1.0)


def sized(unit: str, largest: float) -> tuple[str, float]:
    """Return the unit in which numbers up to `largest` read well, and the factor that brings them there.

    Forces, torques, energies, stiffnesses and pressures have k from 1e4 on, M from 1e6 on; lengths below 0.1 m are in
    mm.
    """
    if unit == "m" and 0.0 < largest < 0.1:
        return "mm", 1e3
    if largest >= 1e4 and re.match(r"(N|J|Pa)(?![A-Za-z])", unit) and math.isfinite(largest):
        return (f"M{unit}", 1e-6) if largest >= 1e6 else (f"k{unit}", 1e-3)
    return unit, 1.0


def per(top: str, bottom: str, degrees: bool = True) -> tuple[str, float]:
    """Return the unit in which something in `top` per `bottom` is shown, and the factor: "N/kg", "deg/(N/m)", "1/m"."""
    (top, upper), (bottom, lower) = displayed(top, (), degrees), displayed(bottom, (), degrees)
    if bottom in ("", "1"):
        return "" if top == "1" else top, upper
    return f"{top or '1'}/{f'({bottom})' if any(c in bottom for c in '/* ') else bottom}", upper / lower


def check_wished(wished: Sequence[str]) -> None:
    """Raise a ParameterError unless all units are known."""
    for unit in wished:
        conversion(unit, "")


def mistaken(value: float, unit: str, low: float, high: float) -> str:
    """Return the quantity, such as "20 deg", that was meant by a number outside its range; empty if none is likely."""
    others = {"rad": ("deg",), "m": ("mm",), "N": ("kN",), "kg": ("g",)}
    for word in others.get(unit, ()):
        if low <= value * conversion(word, unit) <= high:
            return f"{value:g} {word}"
    return ""
