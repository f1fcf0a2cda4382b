"""Every immutable result and its file; knows nothing of how it was made.

A result and the verb that makes it share a file's name: `results.maps` has what `influence.maps` returns. Methods that
draw or compute import what they need inside, upwards; the import contract in pyproject.toml lists these calls.
"""
