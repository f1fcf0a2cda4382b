"""A point of a curve, one step along it, interpolation between its points.

A step is (u - u_0) . t = ds with the tangent t from the bordered system, or longer on Hermite's polynomial.
"""
