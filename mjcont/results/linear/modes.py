"""Modes of an equilibrium: frequencies, damping and shapes, as a table, as CSV and as motions to look at."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.results.histories import History
from mjcont.results.model import Model, provenance
from mjcont.results.points import Column, Point
from mjcont.results.text import Cells, Shown, Tabular, table

OSCILLATES, DECAYS, GROWS, FLUTTERS, NEUTRAL = "oscillates", "decays", "grows", "flutters", "neutral"
# of a model's scale, the largest entry of a shape where it is shown
_SHOWN = 0.2
_REST = 1e-300
# modes that are drawn without being named
_DRAWN = 6


@dataclass(frozen=True, slots=True, repr=False)
class Mode(Shown):
    """One mode: x(t) = x0 + a Re(shape exp(s t)).

    Attributes
    ----------
    number : counted from 1, by rising size of the eigenvalue.
    eigenvalue : s in 1/s; of a conjugate pair the one with positive imaginary part.
    shape : (nv,) complex, in the state's own coordinates; shape^H M shape = 1.
    growing : whether it grows beyond what the noise of the derivatives explains.
    neutral : whether it neither grows nor decays nor returns, as far as that noise tells.
    point : the equilibrium.
    """

    number: int
    eigenvalue: complex
    shape: Array = field(repr=False)
    growing: bool
    neutral: bool
    point: Point = field(repr=False)

    @property
    def omega(self) -> float:
        """Frequency of the motion in rad/s, with its damping; 0 without oscillation."""
        return float(self.eigenvalue.imag)

    @property
    def frequency(self) -> float:
        """The same in Hz."""
        return self.omega / (2.0 * math.pi)

    @property
    def natural_omega(self) -> float:
        """|s| in rad/s: the frequency it would have without damping, where damping does not couple modes."""
        return abs(self.eigenvalue)

    @property
    def damping_ratio(self) -> float:
        """-Re s / |s|: 1 where it decays without oscillation, negative where it grows; NaN at s = 0."""
        size = abs(self.eigenvalue)
        return -self.eigenvalue.real / size if size > _REST else math.nan

    @property
    def growth(self) -> float:
        """Re s in 1/s: positive where it grows."""
        return float(self.eigenvalue.real)

    @property
    def kind(self) -> str:
        """Whether it "oscillates" (and decays or lasts), "decays", "grows", "flutters" (and grows) or is "neutral"."""
        if self.neutral:
            return NEUTRAL
        if self.growing:
            return FLUTTERS if self.omega > 0 else GROWS
        return OSCILLATES if self.omega > 0 else DECAYS

    def __str__(self) -> str:
        """Return what the table says of it."""
        rate = f"{self.frequency:.6g} Hz, damping ratio {self.damping_ratio:.4g}" if self.omega else \
            f"{self.growth:.4g} 1/s"
        return f"mode {self.number}: {rate}, {self.kind}; moves most: {', '.join(_largest(self))}"

    def plot(self, *, plane: str | None = None) -> Any:
        """Draw both ends of its swing over rest and return the figure; `animate` shows it moving."""
        from mjcont.drawing.linear import draw_modes

        return draw_modes([self], 1, plane)

    @checked
    def displaced(self, phase: float = 0.0, amplitude: float | None = None) -> Array:
        """Return the state (nq,) at a phase in rad of the motion, the growth or decay left out.

        `amplitude` is the largest entry of the shape, in its coordinate's unit; by default a fifth of its scale.
        """
        moved = self._size(amplitude) * np.real(self.shape * np.exp(1j * phase))
        return self.point.model.retract(self.point.state, moved)

    def _size(self, amplitude: float | None) -> float:
        """Return the factor of the shape at which it has an amplitude."""
        size = np.abs(self.shape)
        if amplitude is None:
            return float(_SHOWN / max(np.max(size / self.point.model.typical), _REST))
        return amplitude / max(float(np.max(size)), _REST)

    @checked
    def history(self, samples: int = 65, amplitude: float | None = None) -> History:
        """Return one cycle as a time history: what a linear motion shows, its growth or decay left out.

        A mode that does not oscillate swings to and fro once in 2 pi / |s|. `amplitude` as for `displaced`.
        """
        model, values = self.point.model, dict(self.point.parameters)
        rate = self.omega or self.natural_omega or 2.0 * math.pi
        phases = np.linspace(0.0, 2.0 * math.pi, max(int(samples), 2))
        states = np.array([self.displaced(p, amplitude) for p in phases])
        times = phases / rate
        columns = {"time": Column("time", "s", "time", times)}
        measured = model.measure(states, values)
        for i, o in enumerate(model.observables.values()):
            columns[o.name] = Column(o.name, o.unit, "observable", np.asarray(measured)[:, i])
        turning = np.imag(np.exp(1j * phases)[:, None] * self.shape)
        settings = {"integrator": "linear mode", "duration": float(times[-1]), "error": None,
                    "timestep": float(times[1]), "steps": len(times) - 1, "tol": None, "control_step": None}
        velocities = -rate * self._size(amplitude) * turning
        return History(columns, states, velocities, "done", f"one cycle of mode {self.number}", settings,
                       model.name, model, provenance(model), values)


@dataclass(frozen=True, slots=True, repr=False)
class Modes(Tabular, Shown):
    """The modes of an equilibrium, slowest first.

    Attributes
    ----------
    point : Point
    modes : the modes; `len`, index and iteration are theirs, counted from 0.
    mass, damping, stiffness : (nv, nv), of s^2 M + s C + K.
    notes : sentences.
    """

    point: Point
    modes: tuple[Mode, ...]
    mass: Array = field(repr=False)
    damping: Array = field(repr=False)
    stiffness: Array = field(repr=False)
    notes: Sequence[str] = ()

    def __len__(self) -> int:
        """Return the number of modes; a conjugate pair of eigenvalues is one."""
        return len(self.modes)

    def __iter__(self) -> Iterator[Mode]:
        """Iterate over the modes."""
        return iter(self.modes)

    @checked
    def __getitem__(self, index: int) -> Mode:
        """Return a mode, the slowest at index 0."""
        return self.modes[index]

    @checked
    def mode(self, number: int) -> Mode:
        """Return a mode by its number, counted from 1.

        Raises
        ------
        MjcontError
            If there is none of that number.
        """
        if not 1 <= number <= len(self.modes):
            raise MjcontError(f"there is no mode {number}: the modes of this equilibrium are 1 to {len(self.modes)}")
        return self.modes[number - 1]

    @property
    def frequencies(self) -> Array:
        """Frequencies in Hz, (m,)."""
        return np.array([m.frequency for m in self.modes])

    @property
    def damping_ratios(self) -> Array:
        """Damping ratios, (m,)."""
        return np.array([m.damping_ratio for m in self.modes])

    @property
    def shapes(self) -> Array:
        """Shapes as rows, (m, nv) complex."""
        return np.array([m.shape for m in self.modes]).reshape(len(self.modes), -1)

    @property
    def eigenvalues(self) -> Array:
        """Eigenvalues in 1/s, (m,) complex."""
        return np.array([m.eigenvalue for m in self.modes])

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield "mode", "", [m.number for m in self]
        yield "kind", "", [m.kind for m in self]
        yield "frequency", "Hz", self.frequencies
        yield "omega", "rad/s", [m.omega for m in self]
        yield "natural omega", "rad/s", [m.natural_omega for m in self]
        yield "damping ratio", "", self.damping_ratios
        yield "growth", "1/s", [m.growth for m in self]
        for name, entries in zip(coordinates(self.point.model), self.shapes.T, strict=True):
            yield f"re {name}", "", entries.real
            yield f"im {name}", "", entries.imag

    def save(self, path: str | Path) -> Path:
        """Write all of it to an HDF5 file (replacing it whole or not at all) and return the path."""
        from mjcont.results.linear.files import save

        return save(self, path)

    @checked
    def plot(self, numbers: Sequence[int] | None = None, *, cols: int = 4, plane: str | None = None) -> Any:
        """Draw poses of some modes (default the first six) at both ends of their swing over rest; return the figure.

        Raises
        ------
        MjcontError
            If a mode does not exist or the mechanism does not move in a plane.
        """
        from mjcont.drawing.linear import draw_modes

        return draw_modes([self.mode(n) for n in numbers] if numbers is not None else self.modes[:_DRAWN], cols, plane)

    def table(self, most: int | None = None) -> list[str]:
        """Return the table's lines, of the `most` slowest modes."""
        rows = [["mode", "frequency", "omega", "damping ratio", "", "moves most"]]
        for m in self.modes[:most]:
            damping = f"{m.damping_ratio:.4g}" if math.isfinite(m.damping_ratio) else "-"
            swings = m.omega > 0.0
            rate = f" at {m.growth:.4g} 1/s" if m.growing or not swings else ""
            often = [f"{m.frequency:.6g} Hz", f"{m.omega:.6g} rad/s", damping] if swings else ["-", "-", "-"]
            rows.append([str(m.number), *often, m.kind + rate, ", ".join(_largest(m))])
        rest = len(self.modes) - len(rows) + 1
        return [*table(rows), *([f"  and {rest} faster"] if rest else [])]

    def __str__(self) -> str:
        """Return a table, the slowest mode first."""
        growing = sum(m.growing for m in self.modes)
        said = f"{growing} of them grow{'s' if growing == 1 else ''}" if growing else "none grows"
        head = f"{self.point.model.name}: {len(self.modes)} modes, {said}; the equilibrium is {self.point.stability}"
        return "\n".join([head, *self.table(), *(f"  note: {n}" for n in self.notes)])


def coordinates(model: Model) -> list[str]:
    """Return names of the tangent coordinates: the state's own, numbers where quaternions make them differ."""
    names = [name for name, _ in model.state_labels]
    return names if len(names) == model.n else [f"dof {i}" for i in range(model.n)]


def _largest(mode: Mode, most: int = 2) -> list[str]:
    """Return the coordinates that move most against their scales."""
    model = mode.point.model
    size = np.abs(mode.shape) / model.typical
    names = coordinates(model)
    order = np.lexsort((np.arange(len(size)), -np.round(size / max(size.max(), _REST), 6)))
    return [names[i] for i in order[:most] if size[i] > 0.1 * size.max()]
