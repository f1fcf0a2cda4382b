"""The nose gears as planar links on linear springs, written out by hand: no MuJoCo, no mjcont.

Source: Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Sections III and IV. Pins
and centres of gravity are functions of the joint coordinates; energies of weights, bushes and spring are differentiated
by complex steps (exact to rounding), and the retraction force, which may follow the strut, enters by virtual work.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

G = 9.81
POSES = ("downlock_above", "downlock_below", "uplock_above", "uplock_below")
COORDINATES = ("theta_1", "theta_2", "angle_B", "angle_Bb", "theta_ov")
PINS = ("D", "A", "B", "Bb", "E")


def turned(angle, along, across=0.0):
    """The planar vector (along, across), (x, z), turned counter-clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([along * c - across * s, along * s + across * c])


def angle_of(v):
    return np.arctan2(v[1], v[0])


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def meetings(p, r, q, s):
    """The two points at the distance r from p and s from q."""
    away = q - p
    length = np.hypot(*away)
    along = (length**2 + r**2 - s**2) / (2 * length)
    across = np.sqrt(r**2 - along**2)
    return [p + turned(angle_of(away), along, side) for side in (across, -across)]


@dataclass(frozen=True)
class Gear:
    """Lengths in m; A from the trunnion D, C and H in the strut's frame, which hangs from D along -z at theta_1 = 0.

    `strut` has theta_1 in deg at the assembled poses of downlock and uplock with theta_ov = +-30 deg, as published.
    """

    a: np.ndarray
    lengths: tuple[float, ...]
    c: np.ndarray
    h: np.ndarray
    strut: dict[str, float]

    def assembled(self, pose):
        """The five joint angles of an assembled pose, from the triangles B-C-H, D-A-B and B-E-H."""
        side, lock = pose.split("_")
        _, upper, lower, l4, l5 = self.lengths
        theta_ov = np.deg2rad(30.0 if lock == "above" else -30.0)
        length_bh = np.sqrt(l4**2 + l5**2 + 2 * l4 * l5 * np.cos(theta_ov))
        found = []
        for in_strut, turn in product(meetings(self.h, length_bh, self.c, lower), (0, 1)):
            b = meetings(np.zeros(2), np.hypot(*in_strut), self.a, upper)[turn]
            theta_1 = wrapped(angle_of(b) - angle_of(in_strut))
            c, h = turned(theta_1, *self.c), turned(theta_1, *self.h)
            theta_2, theta_3 = angle_of(b - self.a), angle_of(c - b)
            theta_4 = angle_of(h - b) - np.arctan2(l5 * np.sin(theta_ov), l4 + l5 * np.cos(theta_ov))
            if abs(np.rad2deg(theta_1) - self.strut[side]) < 0.005:
                found.append([theta_1, theta_2, wrapped(theta_3 - theta_2), wrapped(theta_4 - theta_3), theta_ov])
        (only,) = found
        return np.array(only)

    def links(self, q):
        """What a state means in the plane; of 15 coordinates, two are slides before each hinge, along its link."""
        q = all_coordinates(q)
        l1, l2, l3, l4, l5 = self.lengths
        rest = self.assembled("downlock_above")

        def pin(i, origin, parent_angle):
            return origin + turned(parent_angle + rest[i], q[i, 0], q[i, 1])

        theta_1, theta_2 = q[0, 2], q[1, 2]
        theta_3 = theta_2 + q[2, 2]
        theta_4 = theta_3 + q[3, 2]
        theta_5 = theta_4 + q[4, 2]
        d = pin(0, np.zeros(2), 0.0)
        a = pin(1, self.a, 0.0)
        b = pin(2, a + turned(theta_2, l2), theta_2)
        bb = pin(3, b, theta_3)
        e = pin(4, bb + turned(theta_4, l4), theta_4)
        return Links(
            angles=[theta_1, theta_2, theta_3, theta_4, theta_5],
            cg=[
                d + turned(theta_1, 0.0, -l1 / 2),
                a + turned(theta_2, l2 / 2),
                b + turned(theta_3, l3 / 2),
                bb + turned(theta_4, l4 / 2),
                e + turned(theta_5, l5 / 2),
            ],
            b=b,
            e=e,
            wheel=d + turned(theta_1, 0.0, -l1),
            gap_c=b + turned(theta_3, l3) - d - turned(theta_1, *self.c),
            gap_h=e + turned(theta_5, l5) - d - turned(theta_1, *self.h),
            slides=q[:, :2],
        )

    def potential(self, q, p):
        """Weights, bushes, spring, and the unlock actuator's dead force along the spring."""
        m = self.links(q)
        gamma = p["gravity_angle"]
        up = p["load_factor"] * G * np.array([np.sin(gamma), np.cos(gamma)])
        weights = sum(p[f"m_{i + 1}"] * (up @ m.cg[i]) for i in range(5)) + p["m_6"] * (up @ m.wheel)
        bushes = 0.5 * p["k_j"] * (m.gap_c @ m.gap_c + m.gap_h @ m.gap_h + np.sum(m.slides * m.slides))
        spring = 0.5 * p["k_sp"] * (m.spring_length - p["l_us"]) ** 2
        return weights + bushes + spring - p["F_ul"] * m.spring_length

    def dissipation(self, q, v, p):
        """Rayleigh's function: half the power lost in the dampers at the velocity v."""
        rate = derivative_along(lambda at: pack(self.links(at)), q, v)
        length_rate = derivative_along(lambda at: self.links(at).spring_length, q, v)
        spring = 0.5 * p["c_sp"] * length_rate**2
        if "c_D" in p:
            return spring + 0.5 * p["c_D"] * v[0] ** 2 + 0.5 * p["c_j"] * rate[-4:] @ rate[-4:]
        slides = all_coordinates(v)[:, :2]
        return spring + 0.5 * p["c_j"] * np.sum(slides * slides)

    def retraction_work(self, q, p):
        """F_ret's generalised force: a moment r_ret F_ret about D, or the force at the strut's centre of gravity."""
        if "r_ret" in p:
            work = np.zeros(q.size)
            work[0] = -p["r_ret"] * p["F_ret"]
            return work
        towards_retraction = turned(q[2], -1.0)
        return p["F_ret"] * gradient(lambda at: self.links(at).cg[0], q) @ towards_retraction

    def forces_at_rest(self, q, p):
        return self.retraction_work(q, p) - gradient(lambda at: self.potential(at, p), q)

    def inertial_forces(self, q, v, a, p):
        """Generalised forces that the motion q, v = dq/dt, a = d2q/dt2 needs (d'Alembert)."""
        masses = [p[f"m_{i}"] for i in range(1, 6)]
        inertias = [m * length**2 / 12 for m, length in zip(masses, self.lengths, strict=True)]
        weight = np.concatenate([np.repeat(masses, 2), inertias, np.repeat(p["m_6"], 2), np.zeros(4)])

        def velocity(t):
            return derivative_along(lambda at: pack(self.links(at)), q + v * t, v)

        h = 1e-3
        centripetal = (8 * (velocity(h) - velocity(-h)) - (velocity(2 * h) - velocity(-2 * h))) / (12 * h)
        acceleration = centripetal + derivative_along(lambda at: pack(self.links(at)), q, a)
        return gradient(lambda at: pack(self.links(at)), q) @ (weight * acceleration)

    def damping_forces(self, q, v, p):
        """The slope of Rayleigh's function in v; it is quadratic, so that a centred difference is exact."""
        return np.array([self.dissipation(q, v - e, p) - self.dissipation(q, v + e, p) for e in np.eye(v.size)]) / 2


@dataclass
class Links:
    """Angles of the links, their centres of gravity, pins B and E, the wheel, and the gaps of pins."""

    angles: list
    cg: list
    b: np.ndarray
    e: np.ndarray
    wheel: np.ndarray
    gap_c: np.ndarray
    gap_h: np.ndarray
    slides: np.ndarray

    @property
    def spring_length(self):
        d = self.cg[0] - self.cg[4]
        return np.sqrt(d @ d)


FIRST = Gear(
    a=np.array([-1.540, 0.007]),
    lengths=(2.5, 0.843, 1.114, 0.439, 0.439),
    c=np.array([0.0, -1.200]),
    h=np.array([0.0, -0.645]),
    strut={"downlock": -0.42, "uplock": -57.53},
)
LOCKING = Gear(
    a=np.array([-1.342294, -0.168787]),
    lengths=(4.599535, 0.701254, 0.631281, 0.660182, 0.380312),
    c=np.array([-0.418197, -1.124772]),
    h=np.array([-0.079517, -1.358129]),
    strut={"downlock": -4.277, "uplock": -59.185},
)
BY_HAND = {"nose_gear": FIRST, "nose_gear_full": FIRST, "nose_gear_locking": LOCKING}


def all_coordinates(q):
    """Rows x, z, angle for the pins D, A, B, Bb, E; hinges have no x and z."""
    q = np.asarray(q)
    if q.size == 15:
        return q.reshape(5, 3)
    return np.column_stack([np.zeros((5, 2)), q])


def pack(m):
    """Centres of gravity, angles, wheel and gaps as one vector."""
    return np.concatenate([*m.cg, np.array(m.angles), m.wheel, m.gap_c, m.gap_h])


def derivative_along(function, q, v):
    """d/dt function(q + v t) at t = 0, by a complex step: exact to rounding."""
    return np.imag(function(q + 1e-30j * np.asarray(v))) / 1e-30


def gradient(function, q):
    return np.array([derivative_along(function, q, e) for e in np.eye(q.size)])
