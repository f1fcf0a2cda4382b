"""Eigenvalues of a pencil, verdicts along a curve."""
