"""The verbs for periodic motion: limit cycles (`cycles`) and forced response (`responses`), u(t + T) = u(t).

A problem is seen through a `Flow` (`fields`, `mechanisms`), its orbits through `numerics.orbits`.
"""
