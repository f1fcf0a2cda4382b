"""What a design is to meet: statements about special points, the points as the design moves, and the optimiser.

Among designs v (parameters less today's, in units of their scales) the one with the least objective f(v), subject to
c_i(v) = 0 for targets and c_i(v) >= 0 for limits. The c_i are quantities of special points, G(X; p) = 0; their
gradients are those of `numerics/equations/adjoint`.
"""
