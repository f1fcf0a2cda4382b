"""The kinds of special points, one record each: every list of them elsewhere is read off this table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mjcont.numerics.equations.system import Condition, Local, System

Conditions = Callable[["Local", "System", float], "Sequence[Condition]"]


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of special point.

    Attributes
    ----------
    code, name : such as "LP" and "fold".
    marker : shape and size with which it is drawn, None where any other will do; shapes differ, so that a diagram can
        be read in greyscale.
    on : "branch", "locus" or both, "cycles" or "cycle locus": the curves on which it is found.
    codimension : number of parameters that its defining system solves for; 0 where it has none of its own.
    crosses : whether eigenvalues pass the axis there.
    holds : by its definition, how many eigenvalues it holds at zero, and how many pairs on the axis.
    conditions : from an evaluation at the point, the plain system and omega^2 to its conditions beside f = 0, with
        borders from the point itself; None where there are none.
    coefficients : names of its normal-form coefficients.
    continues_as : what its curve is called, empty where it has none.
    """

    code: str
    name: str
    marker: tuple[str, float] | None = None
    on: tuple[str, ...] = ()
    codimension: int = 0
    crosses: bool = False
    holds: tuple[int, int] = (0, 0)
    conditions: Conditions | None = None
    coefficients: tuple[str, ...] = ()
    continues_as: str = ""


# what defines a point is imported where a curve of such points begins: reading a table needs no linear algebra


def _fold(local: Local, system: System, square: float) -> Sequence[Condition]:
    from mjcont.numerics.equations.defining import Fold

    return [Fold(local)]


def _hopf(local: Local, system: System, square: float) -> Sequence[Condition]:
    from mjcont.numerics.equations.defining import Hopf

    return [Hopf(local, square)]


def _branch_point(local: Local, system: System, square: float) -> Sequence[Condition]:
    from mjcont.numerics.equations.defining import BranchPoint

    return [BranchPoint(local, system.free[0])]


def _cusp(local: Local, system: System, square: float) -> Sequence[Condition]:
    from mjcont.numerics.equations.defining import Fold
    from mjcont.numerics.equations.onfolds import FoldCoefficient

    fold = Fold(local)
    return [fold, FoldCoefficient(fold, local)]


def _double_zero(local: Local, system: System, square: float) -> Sequence[Condition]:
    from mjcont.numerics.equations.defining import Fold
    from mjcont.numerics.equations.onfolds import DoubleZero

    fold = Fold(local)
    return [fold, DoubleZero(fold, local)]


def _zero_hopf(local: Local, system: System, square: float) -> Sequence[Condition]:
    return [*_fold(local, system, square), *_hopf(local, system, square)]


_CYCLES, _ON_CYCLES = ("cycles",), ("cycle locus",)
_BRANCH, _LOCUS, _BOTH = ("branch",), ("locus",), ("branch", "locus")
KINDS = {
    k.code: k
    for k in (
        Kind("LP", "fold", ("o", 5.5), _BRANCH, 1, True, (1, 0), _fold, ("a",), "fold"),
        Kind("HB", "Hopf point", ("s", 5.5), _BRANCH, 1, True, (0, 1), _hopf, ("omega", "l1", "type"), "Hopf"),
        Kind("BP", "branch point", ("D", 5.0), _BOTH, 1, True, (1, 0), _branch_point, ("type", "c"), "branch-point"),
        Kind("CP", "cusp", ("*", 10.0), _LOCUS, 2, False, (1, 0), _cusp, ("c",), "cusp"),
        Kind("BT", "Bogdanov-Takens point", ("^", 6.5), _LOCUS, 2, False, (2, 0), _double_zero, (), "Bogdanov-Takens"),
        Kind("GH", "generalised Hopf point", ("v", 6.5), _LOCUS, holds=(0, 1), coefficients=("omega", "l1")),
        Kind(
            "ZH", "zero-Hopf point", ("P", 6.5), _LOCUS, 2, False, (1, 1), _zero_hopf,
            ("omega", "s", "theta"), "zero-Hopf",
        ),
        Kind(
            "HH", "double Hopf point", ("X", 6.5), _LOCUS, holds=(0, 2),
            coefficients=("omega", "omega2", "theta", "delta"),
        ),
        Kind("LPC", "fold of cycles", ("h", 6.5), _CYCLES),
        Kind("PD", "period doubling", ("d", 5.5), _CYCLES, coefficients=("type",)),
        Kind("NS", "Neimark-Sacker point", ("p", 7.0), _CYCLES, coefficients=("type", "theta", "rotation")),
        Kind("BPC", "branch point of cycles", ("8", 6.0), _CYCLES),
        Kind("IR", "internal resonance", ("|", 9.0), _CYCLES, coefficients=("order",)),
        *(
            Kind(code, name, None if marker is None else (marker, 6.5), _ON_CYCLES)
            for code, name, marker in (
                ("CPC", "cusp of cycles", "<"), ("GPD", "generalised period doubling", ">"),
                ("CH", "Chenciner point", "H"), ("R1", "1:1 resonance", "1"), ("R2", "1:2 resonance", "2"),
                ("R3", "1:3 resonance", "3"), ("R4", "1:4 resonance", "4"), ("LPPD", "fold-flip", "+"),
                ("LPNS", "fold-Neimark-Sacker point", None), ("PDNS", "flip-Neimark-Sacker point", None),
                ("NSNS", "double Neimark-Sacker point", None),
            )
        ),
        Kind("UZ", "user zero", ("x", 5.5), _BOTH),
        Kind("CO", "corner", None, _BOTH),
        Kind("EP", "end"),
    )
}
CONTINUABLE = tuple(k.code for k in KINDS.values() if k.continues_as)


def name_of(code: str) -> str:
    """Return the name of a kind, or the code itself where there is no such kind."""
    return KINDS[code].name if code in KINDS else code


def holds_eigenvalues(code: str) -> bool:
    """Whether a special point of a kind holds eigenvalues on the axis."""
    return code in KINDS and any(KINDS[code].holds)


def found_on(curve: str) -> tuple[str, ...]:
    """Return the codes of the kinds that are found on a "branch" or a "locus"."""
    return tuple(k.code for k in KINDS.values() if curve in k.on)


def conditions_of(code: str, local: Local, system: System, square: float | None) -> Sequence[Condition]:
    """Return the conditions of a special point, with borders from the point itself; omega^2 where it oscillates."""
    conditions = KINDS[code].conditions
    assert conditions is not None
    return conditions(local, system, 0.0 if square is None else square)
