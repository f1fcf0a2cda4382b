"""Special points: monitors along a curve, location, verification, normal forms, corners.

A point counts when its monitor changes sign between two points of the curve, and vanishes at the solution of its
own defining system. A new kind of point is a condition (`equations.defining`) and a detector
with its monitor (`on_equilibria`, `on_loci`).
"""
