"""The nose gears as planar links on linear springs, written out by hand: no MuJoCo, no mjcont.

Positions of pins and centres of gravity as functions of the joint coordinates; energies of weights, bushes and
spring, differentiated by complex steps (exact to rounding); virtual work for the retraction force, which follows
the strut.
"""

from dataclasses import dataclass

import numpy as np

A = np.array([-1.540, 0.007])
L1, L2, L3, L4, L5 = 2.5, 0.843, 1.114, 0.439, 0.439
D_C, D_H = 1.200, 0.645
G = 9.81


def turned(angle, along, across=0.0):
    """The planar vector (along, across), (x, z), turned counter-clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([along * c - across * s, along * s + across * c])


def angle_of(v):
    return np.arctan2(v[1], v[0])


def assembled(pose):
    """The five joint angles of an assembled pose, from the triangles B-E-H, B-C-H and D-A-B."""
    side, lock = pose.split("_")
    theta_ov = np.deg2rad(30.0 if lock == "above" else -30.0)
    length_bh = np.sqrt(L4**2 + L5**2 + 2 * L4 * L5 * np.cos(theta_ov))
    # B in the strut's frame: a distance down the strut, and one to its left
    down = (length_bh**2 - L3**2 + D_C**2 - D_H**2) / (2 * (D_C - D_H))
    left = np.sqrt(length_bh**2 - (down - D_H) ** 2)
    length_db, length_da = np.hypot(down, left), np.hypot(*A)
    at_d = np.arccos((length_db**2 + length_da**2 - L2**2) / (2 * length_db * length_da))
    to_b = angle_of(A) + (at_d if side == "downlock" else -at_d)
    theta_1 = to_b - np.arctan2(-down, -left)
    theta_1 = (theta_1 + np.pi) % (2 * np.pi) - np.pi
    b = length_db * np.array([np.cos(to_b), np.sin(to_b)])
    c, h = turned(theta_1, 0.0, -D_C), turned(theta_1, 0.0, -D_H)
    theta_2, theta_3 = angle_of(b - A), angle_of(c - b)
    theta_4 = angle_of(h - b) - np.arctan2(L5 * np.sin(theta_ov), L4 + L5 * np.cos(theta_ov))
    return np.array([theta_1, theta_2, theta_3 - theta_2, theta_4 - theta_3, theta_ov])


AT_QPOS0 = assembled("downlock_above")


def all_coordinates(q):
    """Rows x, z, angle for the pins D, A, B, Bb, E; hinges have no x and z."""
    q = np.asarray(q)
    if q.size == 15:
        return q.reshape(5, 3)
    return np.column_stack([np.zeros((5, 2)), q])


@dataclass
class Links:
    """What a state means in the plane: angles of the links, their centres of gravity, wheel, and pins."""

    angles: list
    cg: list
    wheel: np.ndarray
    gap_c: np.ndarray
    gap_h: np.ndarray
    slides: np.ndarray

    @property
    def spring_length(self):
        d = self.cg[0] - self.cg[4]
        return np.sqrt(d @ d)


def links(q):
    q = all_coordinates(q)

    def pin(i, origin, parent_angle):
        """Where the link's end lies: its slides' axes lie along the link at qpos0 and turn with the parent."""
        return origin + turned(parent_angle + AT_QPOS0[i], q[i, 0], q[i, 1])

    theta_1, theta_2 = q[0, 2], q[1, 2]
    theta_3 = theta_2 + q[2, 2]
    theta_4 = theta_3 + q[3, 2]
    theta_5 = theta_4 + q[4, 2]
    d = pin(0, np.zeros(2), 0.0)
    a = pin(1, A, 0.0)
    b = pin(2, a + turned(theta_2, L2), theta_2)
    bb = pin(3, b, theta_3)
    e = pin(4, bb + turned(theta_4, L4), theta_4)
    return Links(
        angles=[theta_1, theta_2, theta_3, theta_4, theta_5],
        cg=[
            d + turned(theta_1, 0.0, -L1 / 2),
            a + turned(theta_2, L2 / 2),
            b + turned(theta_3, L3 / 2),
            bb + turned(theta_4, L4 / 2),
            e + turned(theta_5, L5 / 2),
        ],
        wheel=d + turned(theta_1, 0.0, -L1),
        gap_c=b + turned(theta_3, L3) - d - turned(theta_1, 0.0, -D_C),
        gap_h=e + turned(theta_5, L5) - d - turned(theta_1, 0.0, -D_H),
        slides=q[:, :2],
    )


def potential(q, p):
    """Weights, bushes, spring, and the unlock actuator's dead force along the spring."""
    m = links(q)
    gamma = p["gravity_angle"]
    up = p["load_factor"] * G * np.array([np.sin(gamma), np.cos(gamma)])
    weights = sum(p[f"m_{i + 1}"] * (up @ m.cg[i]) for i in range(5)) + p["m_6"] * (up @ m.wheel)
    bushes = 0.5 * p["k_j"] * (m.gap_c @ m.gap_c + m.gap_h @ m.gap_h + np.sum(m.slides * m.slides))
    spring = 0.5 * p["k_sp"] * (m.spring_length - p["l_us"]) ** 2
    return weights + bushes + spring - p["F_ul"] * m.spring_length


def dissipation(q, v, p):
    """Rayleigh's function: half the power lost in the dampers at the velocity v."""
    rate = derivative_along(lambda at: pack(links(at)), q, v)
    length_rate = derivative_along(lambda at: links(at).spring_length, q, v)
    spring = 0.5 * p["c_sp"] * length_rate**2
    if "c_D" in p:
        return spring + 0.5 * p["c_D"] * v[0] ** 2 + 0.5 * p["c_j"] * rate[-4:] @ rate[-4:]
    slides = all_coordinates(v)[:, :2]
    return spring + 0.5 * p["c_j"] * np.sum(slides * slides)


def pack(m):
    """Centres of gravity, angles, wheel and gaps as one vector."""
    return np.concatenate([*m.cg, np.array(m.angles), m.wheel, m.gap_c, m.gap_h])


def derivative_along(function, q, v):
    """d/dt function(q + v t) at t = 0, by a complex step: exact to rounding."""
    return np.imag(function(q + 1e-30j * np.asarray(v))) / 1e-30


def gradient(function, q):
    return np.array([derivative_along(function, q, e) for e in np.eye(q.size)])


def retraction_work(q, p):
    """F_ret's generalised force: a moment r_ret F_ret about D, or the force at the strut's centre of gravity."""
    if "r_ret" in p:
        work = np.zeros(q.size)
        work[0] = -p["r_ret"] * p["F_ret"]
        return work
    towards_retraction = turned(q[2], -1.0)
    return p["F_ret"] * gradient(lambda at: links(at).cg[0], q) @ towards_retraction


def forces_at_rest(q, p):
    return retraction_work(q, p) - gradient(lambda at: potential(at, p), q)


def inertial_forces(q, v, a, p):
    """Generalised forces that the motion q, v = dq/dt, a = d2q/dt2 needs (d'Alembert)."""
    masses = [p[f"m_{i}"] for i in range(1, 6)]
    inertias = [m * length**2 / 12 for m, length in zip(masses, (L1, L2, L3, L4, L5), strict=True)]
    weight = np.concatenate([np.repeat(masses, 2), inertias, np.repeat(p["m_6"], 2), np.zeros(4)])

    def velocity(t):
        return derivative_along(lambda at: pack(links(at)), q + v * t, v)

    h = 1e-3
    centripetal = (8 * (velocity(h) - velocity(-h)) - (velocity(2 * h) - velocity(-2 * h))) / (12 * h)
    acceleration = centripetal + derivative_along(lambda at: pack(links(at)), q, a)
    return gradient(lambda at: pack(links(at)), q) @ (weight * acceleration)


def damping_forces(q, v, p):
    """The slope of Rayleigh's function in v; it is quadratic, so that a centred difference is exact."""
    return np.array([dissipation(q, v - e, p) - dissipation(q, v + e, p) for e in np.eye(v.size)]) / 2
