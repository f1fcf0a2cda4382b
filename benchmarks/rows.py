"""A branch of 100,000 rows: how long it takes to save, to load and to plot."""

from __future__ import annotations

import dataclasses
import tempfile
from pathlib import Path

import numpy as np

import mjcont as mc
from benchmarks.measure import seconds
from mjcont.drawing.plotting import save_figure
from mjcont.results.spectra import Spectra

ROWS = 100_000


def long_branch(rows: int = ROWS) -> mc.Branch:
    """Return a branch of that many rows: those of a short one, over and over, each a little further on."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    short = mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 60.0), start={"F": 50.0})
    take = np.arange(rows) % len(short)
    take = np.where((np.arange(rows) // len(short)) % 2, len(short) - 1 - take, take)  # to and fro: no jumps
    columns = {n: dataclasses.replace(c, values=c.values[take]) for n, c in short.columns.items()}
    arrays = {n: getattr(short, n)[take] for n in ("states", "stability", "n_unstable", "residuals")}
    return dataclasses.replace(short, columns=columns, spectra=Spectra.of(short.eigenvalues[take]), **arrays)


def many_rows() -> dict[str, float]:
    """Return the seconds that saving, loading and plotting take, the best of three."""
    branch = long_branch()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "long.h5"

        def plot() -> None:
            save_figure(mc.plot(branch, x="F", y="theta_1").figure, Path(folder) / "long.png")

        steps = {"save": lambda: branch.save(file), "load": lambda: mc.load(file), "plot": plot}
        return {name: min(seconds(step) for _ in range(3)) for name, step in steps.items()}
