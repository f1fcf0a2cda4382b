"""Eigenvalues of a pencil, and verdicts on stability along a curve.

The pencil is s^2 M + s C + K; a first-order system x' = f has M = 0, C = I, K = -df/dx.
"""
