"""Influence and choice: points followed to other parameters, sensitivities, maps, worst cases.

With g(u, p) = 0 the defining system of a point and q(u, p) a quantity, dq/dp = q_p - w . g_p, where g_u' w = q_u.
"""
