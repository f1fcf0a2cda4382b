"""Linear transfer functions of an equilibrium: columns of gain and phase, as a summary, as CSV and as Bode plots."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.results.points import Point
from mjcont.results.text import Cells, Shown, Tabular, to_xarray
from mjcont.results.units import per


@dataclass(frozen=True, slots=True, repr=False)
class Transfer(Tabular, Shown):
    """What observables do per unit of a parameter that swings: p + cos(w t) gives y + Re H exp(i w t), to first order.

    Attributes
    ----------
    point : the equilibrium.
    input : name of the parameter that swings.
    outputs : names of the observables.
    frequencies : (m,) in Hz, rising.
    responses : (m, number of outputs) complex, SI and radians.
    stable : whether the equilibrium is stable; if not, no motion of the model shows these numbers unless it is held.
    units : mapping of the input and every output to its unit.
    notes : sentences.
    """

    point: Point
    input: str
    outputs: tuple[str, ...]
    frequencies: Array
    responses: Array = field(repr=False)
    stable: bool
    units: Mapping[str, str] = field(repr=False)
    notes: Sequence[str] = ()

    def __getitem__(self, name: str) -> Array:
        """Return the complex transfer function of an output, (m,)."""
        if name not in self.outputs:
            raise unknown_name("output", name, self.outputs)
        return np.asarray(self.responses[:, self.outputs.index(name)])

    def gain(self, name: str) -> Array:
        """Return |H| of an output, (m,), in its unit per unit of the input."""
        return np.abs(self[name])

    def phase(self, name: str) -> Array:
        """Return the phase of an output in rad, (m,), without jumps by full turns."""
        return np.unwrap(np.angle(self[name]))

    def peak(self, name: str) -> tuple[float, float]:
        """Return the frequency in Hz, of those here, at which an output's gain is largest, and that gain."""
        gain = self.gain(name)
        k = int(np.nanargmax(gain)) if np.isfinite(gain).any() else 0
        return float(self.frequencies[k]), float(gain[k])

    def to_xarray(self) -> Any:
        """Return the complex responses over frequency as an xarray Dataset, SI and radians, units in `attrs`.

        Raises
        ------
        MjcontError
            If xarray is not installed.
        """
        units = {n: per(self.units[n], self.units[self.input], False)[0] for n in self.outputs}
        return to_xarray({"frequency": ("Hz", self.frequencies)}, {n: (units[n], self[n]) for n in self.outputs})

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield "frequency", "Hz", self.frequencies
        for name in self.outputs:
            unit, factor = per(self.units[name], self.units[self.input], degrees)
            yield f"gain of {name}", unit, factor * self.gain(name)
            yield f"phase of {name}", "rad", self.phase(name)

    def save(self, path: str | Path) -> Path:
        """Write all of it to an HDF5 file (replacing it whole or not at all) and return the path."""
        from mjcont.results.linear.files import save

        return save(self, path)

    def plot(self, *, decibels: bool = False, degrees: bool = True) -> Any:
        """Draw gain and phase against frequency, dashed where the equilibrium is unstable; return the figure."""
        from mjcont.drawing.linear import draw_transfer

        return draw_transfer(self, decibels, degrees)

    def __str__(self) -> str:
        """Return the largest gain of each output."""
        kind = "stable" if self.stable else "not stable"
        lines = [f"{self.point.model.name}: {len(self.frequencies)} frequencies from {self.frequencies[0]:.6g} to "
                 f"{self.frequencies[-1]:.6g} Hz, {self.input} swings; the equilibrium is {kind}"]
        for name in self.outputs:
            at, gain = self.peak(name)
            unit, factor = per(self.units[name], self.units[self.input])
            lines.append(f"  {name}: largest {f'{factor * gain:.6g} {unit}'.rstrip()} at {at:.6g} Hz")
        return "\n".join([*lines, *(f"  note: {n}" for n in self.notes)])
