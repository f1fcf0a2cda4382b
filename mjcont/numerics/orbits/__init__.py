"""Periodic orbits: u' = T f(u, tau, p), u(1) = u(0) + turns, by orthogonal collocation.

`scheme` has the points, `flow` what a problem answers, `collocation` the equations, `mesh` the error and where the
intervals lie, `floquet` the multipliers, `defining` and `detectors` the special points. A curve of orbits is a `System`
like any other and is walked by the same stepper.
"""
