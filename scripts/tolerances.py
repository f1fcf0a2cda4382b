"""Unlock and retraction force of the nose gear under tolerances: Monte Carlo against the linear estimate.

Twelve masses, stiffnesses, lengths and pin positions scatter about the nominal gear, each by a normal distribution
cut at three standard deviations; a sweep finds the cusp of each gear drawn. The linear estimate takes the cusp's
derivatives alone. All widths together are multiplied by a factor; the random numbers stay the same. (a, b)
Distribution of the forces, in standard deviations of the linear estimate. (c) Error of the linear estimate by case
against the factor. (d) Share of each parameter in the variance by the linear estimate.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from _loci import Case
from scipy import stats

import mjcont as mc
from mjcont.drawing.plotting import COLORS, GREY, new_figure, save_figure, set_panel_title
from mjcont.numerics.equations.problem import Array
from mjcont.paper.reproduce import Finding, run_script

# Standard deviations at factor 1: shares of the nominal value, or m.
RELATIVE = {"k_j": 0.01, "k_sp": 0.01, "m_1": 0.01, "m_2": 0.01, "m_3": 0.01, "m_4": 0.01, "m_5": 0.01, "m_6": 0.01}
ABSOLUTE = {"l_us": 1e-3, "r_ret": 2.5e-4, "site:C_1.pos[2]": 5e-4, "site:H_1.pos[2]": 5e-4}
NAMES = (*RELATIVE, *ABSOLUTE)
FORCES = ("F_ul", "F_ret")
CUT = 3.0  # standard deviations: at factor 32 a normal tail would have negative masses
CUT_WIDTH = float(stats.truncnorm.std(-CUT, CUT))
SMALL = 4.0  # factors up to here are small: nothing scatters by more than 4 %
COARSE = 0.05  # error of the linear estimate, in standard deviations, from which it no longer tells cases apart


@dataclass(frozen=True, slots=True)
class Draws:
    """The gears drawn at one factor: forces found (NaN where the cusp was not), and predicted to first order."""

    factor: float
    found: dict[str, Array]
    predicted: dict[str, Array]
    deviation: dict[str, float]
    failures: tuple[str, ...]

    def error(self, force: str) -> float:
        """Return the linear estimate's root mean square error over the cases."""
        return float(np.sqrt(np.nanmean((self.found[force] - self.predicted[force]) ** 2)))

    def count(self, force: str) -> int:
        """Return how many cases have their cusp."""
        return int(np.isfinite(self.found[force]).sum())

    def spread(self, force: str) -> float:
        """Return the standard deviation found."""
        return float(np.nanstd(self.found[force], ddof=1))


@dataclass(frozen=True, slots=True)
class Study:
    """All that was computed, draws by rising factor."""

    sensitivities: mc.Sensitivities
    draws: tuple[Draws, ...]
    cases: int

    @property
    def factors(self) -> Array:
        """The factors."""
        return np.array([d.factor for d in self.draws])

    def shares(self, force: str) -> dict[str, float]:
        """Return each parameter's share in the variance by the linear estimate, the largest first."""
        parts = {n: (self.sensitivities[force, n] * width) ** 2 for n, width in widths(self.sensitivities).items()}
        total = sum(parts.values())
        return {n: v / total for n, v in sorted(parts.items(), key=lambda item: -item[1])}


def main(out: Path) -> list[Finding]:
    """Run the study, draw it and return its findings."""
    study = compute()
    _draw(study, out / "tolerances.png")
    return [_agrees(study), _centred(study), _quadratic(study), _stops(study), _tail(study), _contributes(study)]


def compute(factors: Sequence[float] = (1.0, 4.0, 16.0, 32.0), cases: int = 400, workers: int = 2) -> Study:
    """Draw so many gears at each factor and find their cusps."""
    cusp = Case.of(mc.Mechanism.from_xml("nose_gear"), 1.0, 0.0).cusp
    found = mc.sensitivities(cusp, list(NAMES), quantities=list(FORCES))
    return Study(found, tuple(_draw_gears(cusp, found, f, cases, workers) for f in factors), cases)


def widths(found: mc.Sensitivities) -> dict[str, float]:
    """Return the standard deviation of each parameter at factor 1, before the cut."""
    return {n: abs(found.values[n]) * RELATIVE[n] if n in RELATIVE else ABSOLUTE[n] for n in NAMES}


def _draw_gears(cusp: mc.SpecialPoint, found: mc.Sensitivities, factor: float, cases: int, workers: int) -> Draws:
    width = widths(found)
    vary = {n: mc.Spread("truncated normal", factor * width[n], cut=CUT) for n in NAMES}
    with tempfile.TemporaryDirectory() as folder:
        table = mc.sweep({"cusp": cusp}, vary, out=folder, design="monte carlo", cases=cases, seed=1, workers=workers)
    change = np.column_stack([table[n] - found.values[n] for n in NAMES])
    slopes = {q: np.array([found[q, n] for n in NAMES]) for q in FORCES}
    size = CUT_WIDTH * factor * np.array([width[n] for n in NAMES])
    return Draws(
        factor,
        {q: table[f"cusp.{q}"] for q in FORCES},
        {q: found.values[q] + change @ slopes[q] for q in FORCES},
        {q: float(np.linalg.norm(size * slopes[q])) for q in FORCES},
        tuple(message for _, message in table.failed),
    )


# --- drawing


def _draw(study: Study, path: Path) -> None:
    figure, axes = new_figure(2, 2, (9.4, 7.4))
    for ax, panel, force in zip(axes[0], "ab", FORCES, strict=True):
        _draw_histograms(ax, study, force)
        set_panel_title(ax, f"({panel})  {force} at the cusp, {study.cases} gears a factor")
    _draw_errors(axes[1, 0], study)
    _draw_shares(axes[1, 1], study)
    save_figure(figure, path)


def _draw_histograms(ax: Any, study: Study, force: str) -> None:
    nominal = study.sensitivities.values[force]
    edges = np.linspace(-4.5, 4.5, 25)
    for draws, color in zip(study.draws, COLORS, strict=False):
        changes = (draws.found[force] - nominal) / draws.deviation[force]
        density = np.histogram(changes[np.isfinite(changes)], edges)[0] / draws.count(force) / (edges[1] - edges[0])
        ax.stairs(density, edges, color=color, linewidth=1.2, label=f"factor {draws.factor:g}")
    x = np.linspace(edges[0], edges[-1], 301)
    ax.plot(x, stats.norm.pdf(x), color="#333333", linewidth=1.6, label="normal")
    ax.set(xlabel=f"({force} - nominal) / linear standard deviation", ylabel="density", xlim=(edges[0], edges[-1]))
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8, loc="upper left")


def _draw_errors(ax: Any, study: Study) -> None:
    x = study.factors
    for force, color, marker in zip(FORCES, COLORS, "os", strict=False):
        y = np.array([d.error(force) / d.deviation[force] for d in study.draws])
        ax.loglog(x, y, marker + "-", color=color, markersize=5.0, label=force)
        ax.loglog(x, y[0] * x / x[0], ":", color=color, linewidth=1.2)
    ax.loglog([], [], ":", color=GREY, label="in proportion to the factor")
    ax.axhline(COARSE, color="#333333", linestyle="--", linewidth=0.9)
    ax.set(xlabel="factor on all tolerances", ylabel="rms error / standard deviation")
    ax.set_xticks(x, [f"{f:g}" for f in x])
    ax.minorticks_off()
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8)
    set_panel_title(ax, "(c)  error of the linear estimate, by case")


def _draw_shares(ax: Any, study: Study) -> None:
    shares = {q: study.shares(q) for q in FORCES}
    names = sorted(NAMES, key=lambda n: max(shares[q][n] for q in FORCES))
    at = np.arange(len(names))
    for force, color, shift in zip(FORCES, COLORS, (0.2, -0.2), strict=False):
        ax.barh(at + shift, [100.0 * shares[force][n] for n in names], height=0.38, color=color, label=force)
    ax.set_yticks(at, names)
    ax.grid(visible=False, axis="y")
    ax.set(xlabel="share of the variance [%]")
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", fontsize=8, loc="lower right")
    set_panel_title(ax, "(d)  what contributes")


# --- findings


def _agrees(study: Study) -> Finding:
    small = [(d, q) for d in study.draws if d.factor <= SMALL for q in FORCES]
    off = [abs(d.spread(q) / d.deviation[q] - 1.0) * np.sqrt(2.0 * (d.count(q) - 1)) for d, q in small]
    shown = [f"{q} at factor {d.factor:g}: {d.spread(q):.4g} N, linear {d.deviation[q]:.4g} N ({s:.1f} standard errors)"
             for (d, q), s in zip(small, off, strict=True)]
    error = 100.0 / np.sqrt(2.0 * (study.cases - 1))
    return Finding(
        "At small tolerances the scatter found is that of the linear estimate, within two standard errors of its own.",
        f"{'; '.join(shown)}; a standard error is 1/sqrt(2(N-1)) = {error:.1f} %",
        max(off) < 2.0,
    )


def _centred(study: Study) -> Finding:
    small = [(d, q) for d in study.draws if d.factor <= SMALL for q in FORCES]
    nominal = study.sensitivities.values
    off = [abs(float(np.nanmean(d.found[q])) - nominal[q]) / d.deviation[q] * np.sqrt(d.count(q)) for d, q in small]
    return Finding(
        "At small tolerances the mean is the nominal force, within two standard errors.",
        ", ".join(f"{q} at factor {d.factor:g}: {s:.1f}" for (d, q), s in zip(small, off, strict=True)),
        max(off) < 2.0,
    )


def _quadratic(study: Study) -> Finding:
    used = [i for i, d in enumerate(study.draws) if d.factor <= 4.0 * SMALL]
    factors = study.factors[used]
    powers = {q: float(np.polyfit(np.log(factors), np.log([study.draws[i].error(q) for i in used]), 1)[0])
              for q in FORCES}
    shown = [f"{q}: " + ", ".join(f"{d.error(q):.2g} N at {d.factor:g}" for d in study.draws) for q in FORCES]
    return Finding(
        "The error of the linear prediction of a single gear grows as the square of the tolerances.",
        f"root mean square over the gears: {'; '.join(shown)}. Power of the factor up to {factors[-1]:g}: "
        f"{', '.join(f'{q} {p:.3f}' for q, p in powers.items())}",
        all(abs(p - 2.0) < 0.1 for p in powers.values()),
    )


def _stops(study: Study) -> Finding:
    shown, holds = [], []
    for q in FORCES:
        shares = np.array([d.error(q) / d.deviation[q] for d in study.draws])
        power, start = np.polyfit(np.log(study.factors), np.log(shares), 1)
        at = float(np.exp((np.log(COARSE) - start) / power))
        off = np.array([d.spread(q) / float(np.nanstd(d.predicted[q][np.isfinite(d.found[q])], ddof=1)) - 1.0
                        for d in study.draws])
        shown.append(f"{q}: single gears {', '.join(f'{100 * s:.2g} %' for s in shares)} of a standard deviation, "
                     f"{100 * COARSE:g} % at a factor of about {at:.0f}; standard deviation "
                     f"{', '.join(f'{100 * o + 0.0:.1f} %' for o in off)}")
        first = int(np.argmax(shares > COARSE))
        holds.append(shares[0] < COARSE < shares[-1] and abs(off[first]) < COARSE)
    lost = ", ".join(str(len(d.failures)) for d in study.draws)
    why = next((f" ({d.failures[0]})" for d in study.draws if d.failures), "")
    return Finding(
        "The linear estimate stops telling single gears apart before its standard deviation is wrong.",
        f"errors at factors {', '.join(f'{f:g}' for f in study.factors)}, against the same gears: {'; '.join(shown)}. "
        f"Gears without a cusp: {lost}{why}",
        all(holds),
    )


def _tail(study: Study) -> Finding:
    shown, off = [], []
    for d in study.draws:
        good = np.isfinite(d.found["F_ul"])
        found, linear = (-float(np.quantile(v["F_ul"][good], 0.01)) for v in (d.found, d.predicted))
        off.append(abs(found - linear) / d.deviation["F_ul"])
        shown.append(f"{found:.1f} N at factor {d.factor:g} (linear {linear:.1f} N)")
    return Finding(
        "One gear in a hundred needs an unlock force that the linear estimate tells at small tolerances.",
        f"{', '.join(shown)}; nominal {-study.sensitivities.values['F_ul']:.1f} N",
        all(o < COARSE for o, d in zip(off, study.draws, strict=True) if d.factor <= SMALL),
    )


def _contributes(study: Study) -> Finding:
    unlock, retract = (study.shares(q) for q in FORCES)
    shown = [f"{q}: " + ", ".join(f"{n} {100 * s:.2g} %" for n, s in list(shares.items())[:4])
             for q, shares in zip(FORCES, (unlock, retract), strict=True)]
    heavy = sum(unlock[n] for n in ("m_1", "m_2", "m_3", "m_6", "r_ret", "k_j"))
    return Finding(
        "The unlock force scatters with the spring on the locklinks, the retraction force with the weights of strut "
        "and wheels and its own lever, which hardly move the unlock force.",
        f"shares of the variance, linear: {'; '.join(shown)}. Of F_ul, {100 * heavy:.0e} % is due to strut, wheels, "
        "stays, lever and bushes. Tolerances are an assumption of this study, and independent; cusps in level flight",
        unlock["k_sp"] + unlock["l_us"] > 0.9 and retract["m_1"] + retract["m_6"] + retract["r_ret"] > 0.9
        and heavy < 1e-3,
    )


if __name__ == "__main__":
    run_script(main)
