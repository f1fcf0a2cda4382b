"""Problems as equations: what a problem must answer, systems, bordered solves, Newton, differences.

A curve or a point is a `System`: f(x, p) = 0 with conditions g_i(x, p, aux) = 0, in (state, free parameters, auxiliary
unknowns), scaled. One unknown more than equations is a curve, as many a point.
"""
