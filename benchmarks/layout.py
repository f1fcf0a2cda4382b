"""The table of the benchmarks as text, row by row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from benchmarks.book import FAILED, MISSING

POINTS, CHAIN, DIAGRAM, MEMORY, JOBS = "points [us]", "chain [us]", "diagram [ms]", "memory [MB]", "jobs [s]"
ORBITS, SWEEPS, ROWS = "orbits [ms]", "cases of sweeps, CPU [ms]", "a row of a long chain, CPU [ms]"
DENSE = "a row of a dense field, CPU [LU factors of its size]"


class Table:
    """Columns for a point's cost and for diagrams; names and numbers for the rest."""

    def head(self, section: str) -> Sequence[str]:
        """Return the lines above a section."""
        if section in (POINTS, CHAIN):
            kind = "a point [us]" if section == POINTS else "a chain's point [us]"
            peers = f"{'mjcont':>9}{'floor':>9}{'ratio':>7}{'AUTO':>9}{'ratio':>7}"
            return [f"{kind:<18}{peers}   mujoco/algebra/python   all eigenvalues   no rows between"]
        if section == DIAGRAM:
            return [f"{'a diagram, chord [ms]':<26}{'mjcont':>9}{'AUTO':>9}{'ratio':>7}   points   chord error"]
        if section == ORBITS:
            return [f"{'an orbit, CPU [ms]':<26}{'mjcont':>9}{'AUTO':>9}{'ratio':>7}   evaluations"]
        return [section]

    def row(self, section: str, name: str, row: Any) -> Sequence[str]:
        """Return the lines of a row."""
        if section in (POINTS, CHAIN):
            lines = [_point(name, row)] if isinstance(row, dict) else [f"{name} {row}"]
        elif section == DIAGRAM:
            lines = [_diagram(name, row)]
        elif section == ORBITS:
            lines = [_orbit(name, row)]
        else:
            lines = [f"  {name:<20}{row:9.3f}"]
        if isinstance(row, dict):
            for reason in (FAILED, MISSING):
                lines += [f"{'':<18}{peer} not measured: {why}" for peer, why in row.get(reason, {}).items()]
        return lines


def _point(name: str, row: dict[str, Any]) -> str:
    ours, cells = row.get("mjcont"), []
    for peer in ("floor", "AUTO"):
        ratio = f"{ours / row[peer]:7.2f}" if ours is not None and peer in row else f"{'-':>7}"
        cells.append(f"{_number(row.get(peer))}{ratio}")
    shares = "/".join(f"{100 * v:.0f} %" for v in row.get("split", {}).values())
    every = "".join(f"{row[k]:18.1f}" for k in ("all eigenvalues", "no rows between") if k in row)
    line = f"{name:<18}{_number(ours)}{''.join(cells)}   {shares:<21}{every}".rstrip()
    others = (f"\n{'':<18}{peer}: {row[peer]:.1f}" for peer in ("root", "PyCont-Lite") if peer in row)
    return line + "".join(others)


def _number(value: float | None) -> str:
    return f"{'-':>9}" if value is None else f"{value:9.1f}"


def _diagram(name: str, row: dict[str, Any]) -> str:
    points, error = row["points"], row["chord error"]
    return (
        f"{name:<26}{row['mjcont']:9.2f}{row['AUTO']:9.2f}{row['mjcont'] / row['AUTO']:7.2f}   "
        f"{points['mjcont']}/{points['AUTO']}   {error['mjcont']:.1e}/{error['AUTO']:.1e}"
    )


def _orbit(name: str, row: dict[str, Any]) -> str:
    counts, times = row["evaluations"], f"{row['mjcont']:9.2f}{row['AUTO']:9.2f}{row['mjcont'] / row['AUTO']:7.2f}"
    return f"{name:<26}{times}   {counts['mjcont']:.0f}/{counts['AUTO']:.0f}"
