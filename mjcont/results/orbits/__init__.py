"""Periodic orbits u(t + T) = u(t), what is read along them, and curves of them. Immutable once made.

An orbit is stable where every Floquet multiplier, the 1 of a free period aside, lies inside the unit circle.
"""

from mjcont.results.orbits.charts import Chart
from mjcont.results.orbits.curve import (
    BACKBONE,
    CYCLES,
    MODES,
    RESPONSES,
    CycleBranch,
    OrbitPoint,
    SpecialOrbit,
    point_of,
)
from mjcont.results.orbits.orbit import Orbit, orbit_of
from mjcont.results.orbits.readings import Reading, extremes, readings

__all__ = [
    "BACKBONE", "CYCLES", "MODES", "RESPONSES", "Chart", "CycleBranch", "Orbit", "OrbitPoint", "Reading",
    "SpecialOrbit", "extremes", "orbit_of", "point_of", "readings",
]
