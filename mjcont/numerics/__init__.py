"""Continuation of f(x, p) = 0: knows nothing of MuJoCo, files or plots.

Rooms from the ground up: `equations`, `step`, `spectra`, `points`, `walk`; `search` beside them. Each imports only from
those before it.
"""
