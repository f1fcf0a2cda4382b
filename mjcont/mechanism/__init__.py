"""The sole owner of MjModel and MjData: parameters, forces, derivatives, readings."""
