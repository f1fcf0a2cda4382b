"""What the overcentre mechanism must do, from its energies written out by hand: no MuJoCo, no mjcont.

Source: Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section II.
Coordinates q = (x_1, z_1, theta_1, x_2, z_2, theta_2): centres of gravity and angles of two uniform rods of one
length, 1 m unless stated. The potential energy is

    V = k_j/2 sum(gap^2) + k_sp/2 (x_2 - x_1 - l_us)^2 - F z_1 - sum(m r . g),

whose negative gradient and Hessian give forces and stiffness. The gaps are those of the bushes A (x, z),
B (x, z) and C (z). The paper prints no values of the parameters: those below are mjcont's. `p` holds the model's
parameters by name, and "length" of the links in m where it is not 1.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

BOUNDS = (-50.0, 60.0)
START = 50.0
GRAVITY = 9.81
PARAMETERS = {
    "k_j": 1000.0,
    "c_j": 0.0,
    "k_sp": 10.0,
    "c_sp": 10.0,
    "l_us": 0.5,
    "m_1": 1.0,
    "m_2": 1.0,
    "F": 0.0,
    "gravity_angle": 0.0,
    "load_factor": 1.0,
}

# The second set, of figures 2 to 5: the model overcentre_paper.
PAPER = PARAMETERS | {"k_sp": 9.0, "l_us": 2.25, "length": 3.0}

# Folds (F in N, theta_1 in deg), upper and lower, for k_j in N/m: extended systems of the energies above,
# solved to residuals below 1e-12 apart from any MuJoCo model. All digits shown are good.
ELASTIC_FOLDS = {
    8.0: ((17.514812330, 12.0076556), (21.786417513, -76.6976994)),
    100.0: ((15.526677444, 36.0123215), (23.714159250, -39.7084109)),
    200.0: ((15.332260602, 36.7618177), (23.907959914, -38.5719055)),
    1000.0: ((15.162603207, 37.3299335), (24.077406008, -37.6856327)),
    1e6: ((15.118080375, 37.4671748), (24.121919625, -37.4675289)),
}
PAPER_FOLDS = {
    8.0: ((17.805636246, 18.0598057), (21.417087917, -31.9705638)),
    10.0: ((17.574079990, 19.5449997), (21.652292317, -30.5900072)),
    100.0: ((16.008492183, 24.2654216), (23.231142254, -25.3088103)),
    200.0: ((15.852711406, 24.4828537), (23.387190412, -25.0015824)),
    1000.0: ((15.718215661, 24.6514817), (23.521780172, -24.7547201)),
    1e6: ((15.683131642, 24.6928115), (23.556868358, -24.6929147)),
}


def length_of(p):
    """Return the links' length in m."""
    return p.get("length", 1.0)


def rigid_force(theta_1, p=PARAMETERS):
    """Return the force that holds the mechanism with rigid pins at an angle in rad.

    Equation (5) of the paper with the sign that equation (4) implies, for equal links (theta_2 = -theta_1).
    """
    spring = p["k_sp"] * (length_of(p) * np.cos(theta_1) - p["l_us"])
    return (p["m_1"] + p["m_2"]) * GRAVITY - 2.0 * spring * np.tan(theta_1)


def rigid_folds(p=PARAMETERS):
    """Return (F, theta_1 in rad) of the upper and lower fold with rigid pins: cos^3 theta_1 = l_us / L_1."""
    angle = math.acos((p["l_us"] / length_of(p)) ** (1.0 / 3.0))
    return (rigid_force(angle, p), angle), (rigid_force(-angle, p), -angle)


def gravity_vector(p):
    """Return the components (x, z) of gravity: positive angles tilt it towards -x."""
    size = p["load_factor"] * GRAVITY
    return np.array([-size * math.sin(p["gravity_angle"]), -size * math.cos(p["gravity_angle"])])


def gaps(q, length=1.0):
    """Return the gaps of the bushes A_x, A_z, B_x, B_z, C_z, (5,)."""
    x1, z1, a, x2, z2, b = q
    ca, sa, cb, sb = 0.5 * length * np.cos([a, a - np.pi / 2, b, b - np.pi / 2])
    return np.array([x1 - ca, z1 - sa, x2 - cb - x1 - ca, z2 - sb - z1 - sa, z2 + sb])


def gap_jacobian(q, length=1.0):
    """Return d gaps / dq, (5, 6)."""
    _, _, a, _, _, b = q
    half = 0.5 * length
    ca, sa, cb, sb = half * math.cos(a), half * math.sin(a), half * math.cos(b), half * math.sin(b)
    return np.array(
        [
            [1.0, 0.0, sa, 0.0, 0.0, 0.0],
            [0.0, 1.0, -ca, 0.0, 0.0, 0.0],
            [-1.0, 0.0, sa, 1.0, 0.0, sb],
            [0.0, -1.0, -ca, 0.0, 1.0, -cb],
            [0.0, 0.0, 0.0, 0.0, 1.0, cb],
        ]
    )


SPRING = np.array([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0])


def forces(q, p):
    """Return -dV/dq, (6,)."""
    gx, gz = gravity_vector(p)
    dead = np.array([p["m_1"] * gx, p["m_1"] * gz + p["F"], 0.0, p["m_2"] * gx, p["m_2"] * gz, 0.0])
    size = length_of(p)
    return dead - p["k_j"] * gap_jacobian(q, size).T @ gaps(q, size) - p["k_sp"] * (SPRING @ q - p["l_us"]) * SPRING


def stiffness(q, p):
    """Return the Hessian of V, (6, 6)."""
    jac, gap, half = gap_jacobian(q, length_of(p)), gaps(q, length_of(p)), 0.5 * length_of(p)
    k = p["k_j"] * jac.T @ jac + p["k_sp"] * np.outer(SPRING, SPRING)
    a, b = q[2], q[5]
    k[2, 2] += p["k_j"] * half * (math.cos(a) * (gap[0] + gap[2]) + math.sin(a) * (gap[1] + gap[3]))
    k[5, 5] += p["k_j"] * half * (math.cos(b) * gap[2] + math.sin(b) * (gap[3] - gap[4]))
    return k


def damping(q, p):
    """Return the matrix of the dampers, (6, 6)."""
    jac = gap_jacobian(q, length_of(p))
    return p["c_j"] * jac.T @ jac + p["c_sp"] * np.outer(SPRING, SPRING)


def mass(p):
    """Return the mass matrix of two uniform rods, (6, 6)."""
    turning = length_of(p) ** 2 / 12.0
    return np.diag([p["m_1"], p["m_1"], p["m_1"] * turning, p["m_2"], p["m_2"], p["m_2"] * turning])


def assembled_pose(theta_1, length=1.0):
    """Return q with closed pins at theta_1 in rad, C on the right, (6,)."""
    c, s = math.cos(theta_1), math.sin(theta_1)
    x, z = 0.5 * length * c, 0.5 * length * s
    return np.array([x, z, theta_1, 3.0 * x, z, -theta_1])


def equilibrium_at(theta_1, p, near=None):
    """Return (q, F, dF/dtheta_1) of the equilibrium at theta_1 in rad, by Newton from (q, F) `near` it."""
    free = [0, 1, 3, 4, 5]
    up = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])
    q, force = near or (assembled_pose(theta_1, length_of(p)), float(rigid_force(theta_1, p)))
    q = q.copy()
    q[2] = theta_1
    for _ in range(50):
        matrix = np.column_stack([-stiffness(q, p)[:, free], up])
        step = np.linalg.solve(matrix, -forces(q, {**p, "F": force}))
        q[free] += step[:5]
        force += step[5]
        if np.abs(step).max() < 1e-13:
            break
    slope = np.linalg.solve(np.column_stack([-stiffness(q, p)[:, free], up]), stiffness(q, p)[:, 2])[5]
    return q, force, slope


def fold_near(theta_1, p):
    """Return (F, theta_1 in rad) of the fold, dF/dtheta_1 = 0, within 1 deg of an angle, walking from 0."""
    near = None
    for angle in np.linspace(0.0, theta_1, 60):
        near = equilibrium_at(angle, p, near)[:2]

    def slope(angle):
        return equilibrium_at(angle, p, near)[2]

    reach = math.radians(1.0)
    angle = brentq(slope, theta_1 - reach, theta_1 + reach, xtol=1e-13, rtol=1e-14)
    return equilibrium_at(angle, p, near)[1], angle
