"""The sole owner of MjModel and MjData: parameters, forces, derivatives, readings.

Near an equilibrium M dq'' + C dq' + K dq = 0 with K = -d tau/dq, C = -d tau/dv. Parameter values are arguments of every
method, never remembered.
"""
