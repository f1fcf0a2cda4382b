"""Rods on ball joints, a body on springs, and motions of them written out by hand."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

import mjcont as mc
from problems.rotations import cross, right_jacobian

GRAVITY = 9.81
TIP_FORCES = """
    <general name="F" site="tip" refsite="base" gear="1 0 0 0 0 0"/>
    <general name="G" site="tip" refsite="base" gear="0 1 0 0 0 0"/>"""


def rod(
    ball, *, axis="0 1 0", joint="", inertia=(0.11, 0.12, 0.02), gravity=GRAVITY, world="", body="", tendon="",
    actuator=TIP_FORCES,
):
    """A rod of 1.3 kg that hangs on a ball joint, or on a hinge about an axis, its tip 1 m below."""
    kind = 'type="ball"' if ball else f'axis="{axis}"'
    return mc.Mechanism.from_xml(f"""
    <mujoco model="rod">
      <option gravity="0 0 {-gravity}"/>
      <worldbody>
        <site name="base"/>{world}
        <body name="rod">
          <joint name="hip" {kind} {joint}/>
          <inertial pos="0 0 -0.5" mass="1.3" diaginertia="{' '.join(map(str, inertia))}"/>
          <site name="tip" pos="0 0 -1"/>{body}
        </body>
      </worldbody>
      <tendon>{tendon}</tendon>
      <actuator>{actuator}</actuator>
      <sensor><framepos name="tip" objtype="site" objname="tip"/></sensor>
    </mujoco>""")


def turned(ball, joint):
    """A rod that a torque about x turns, held by cables from either side that oppose every other rotation."""
    sides = [("a", "c", 1.0), ("b", "d", -1.0)]
    gear = "1 0 0 0 0 0" if ball else "1"
    return rod(
        ball, axis="1 0 0", joint=joint, inertia=(0.3, 0.2, 0.1), gravity=2.0,
        world="".join(f'<site name="{a}" pos="{2 * s} 0 0"/>' for a, _, s in sides),
        body="".join(f'<site name="{c}" pos="{s} 0 0"/>' for _, c, s in sides),
        tendon="".join(f'<spatial stiffness="30" damping="2" springlength="0.5"><site site="{a}"/><site site="{c}"/>'
                       "</spatial>" for a, c, _ in sides),
        actuator=f'<motor name="torque" joint="hip" gear="{gear}"/>',
    )


def lively(ball):
    """A rod that its motor drives about x, `push` against its damping; a damper below it grows with the angle."""
    gear = "1 0 0 0 0 0" if ball else "1"
    found = rod(
        ball, axis="1 0 0", joint='damping="0.2" stiffness="1"', inertia=(0.1, 0.15, 0.05),
        world='<site name="floor" pos="0 0 -1.5"/>',
        tendon='<spatial damping="4"><site site="floor"/><site site="tip"/></spatial>',
        actuator=f'<general name="drive" joint="hip" gear="{gear}" biastype="affine" biasprm="0 0 0.01"/>',
    )
    found.declare("push", "actuator:drive.biasprm[2]", bounds=(0.01, 1.0))
    return found


def floating(kind="free"):
    """A body that six springs hold, shaken by a torque and by a force."""
    outside = [(1.5, 0, 0.3), (-1.5, 0.2, 0), (0, 1.6, -0.2), (0.1, -1.4, 0.4), (0.3, 0.2, 1.7), (0, -0.3, -1.5)]
    inside = [(0.4, 0, 0.1), (-0.4, 0.1, 0), (0, 0.4, -0.1), (0.1, -0.4, 0), (0.1, 0, 0.4), (0, -0.1, -0.4)]

    def sites(name, places):
        return "".join(f'<site name="{name}{i}" pos="{x} {y} {z}"/>' for i, (x, y, z) in enumerate(places))

    springs = "".join(f'<spatial stiffness="{20 + 5 * i}" damping="0.4" springlength="{0.6 + 0.05 * i}">'
                      f'<site site="out{i}"/><site site="in{i}"/></spatial>' for i in range(6))
    return mc.Mechanism.from_xml(f"""
    <mujoco model="floating">
      <option gravity="0 0 -1"/>
      <worldbody>
        <site name="base"/>{sites("out", outside)}
        <body name="body">
          <joint name="place" type="{kind}" damping="0.15"/>
          <inertial pos="0.05 0.02 -0.03" mass="1.5" diaginertia="0.2 0.3 0.25"/>
          {sites("in", inside)}<site name="mark" pos="0.3 0.2 0.1"/>
        </body>
      </worldbody>
      <tendon>{springs}</tendon>
      <actuator>
        <motor name="torque" site="mark" gear="0 0 0 1 0.5 0.3"/>
        <general name="force" site="mark" refsite="base" gear="1 0 0 0 0 0"/>
      </actuator>
      <sensor><framepos name="mark" objtype="site" objname="mark"/><gyro name="gyro" site="mark"/></sensor>
    </mujoco>""")


# -- motions written out ----------------------------------------------------------------------------------------------


def moved(mechanism, orbit, pose, velocity, method="DOP853", tol=1e-11):
    """Return pose and velocity a period of an orbit's forcing later, by SciPy, quaternions of a rod as they are."""
    constants, nq = orbit.constants(), len(pose)
    ball = nq - 4  # where the quaternion of a single ball or free joint begins

    def field(t, y):
        q, v = y[:nq], y[nq:]
        inputs = {name: float(value[0]) for name, value in orbit.inputs(np.array([t])).items()}
        unit = np.concatenate([q[:ball], q[ball:] / np.linalg.norm(q[ball:])])
        s, r, w = q[ball], q[ball + 1 :], v[ball:]
        turning = 0.5 * np.concatenate([[-r @ w], s * w + np.cross(r, w)])
        return np.concatenate([v[:ball], turning, mechanism.acceleration(unit, v, {**constants, **inputs})])

    run = solve_ivp(field, (0.0, orbit.period), np.concatenate([pose, velocity]), method, rtol=tol, atol=1e-2 * tol)
    return run.y[:nq, -1], run.y[nq:, -1]


class Cone:
    """A rod with stiffness k and damping c in its ball joint, whose tip a force F drives round at w rad/s.

    In axes that turn with the force its pose exp(x) is at rest: I (w e x W) + W x I W = M with W = w (R^T e - e), e
    vertical and R = exp(x); M are the moments of weight, force, spring and damper about the joint.
    """

    def __init__(self, w, force, *, inertia=0.11, spin=0.02, stiffness=2.0, damping=0.3, mass=1.3, arm=0.5):
        self.w, self.force, self.k, self.c, self.weight = w, force, stiffness, damping, mass * GRAVITY
        self.inertia, self.arm = np.diag([inertia + mass * arm**2] * 2 + [spin]), arm
        self.e = np.array([0.0, 0.0, 1.0])

    def spinning(self, x, speed):
        """Return x' and W' in the turning axes."""
        r = rotation(x)
        down = r.T @ self.e
        moment = np.cross([0.0, 0.0, -self.arm], -self.weight * down) - self.k * x - self.c * speed
        moment = moment + np.cross([0.0, 0.0, -1.0], r.T @ np.array([self.force, 0.0, 0.0]))
        i = self.inertia
        turning = moment - np.cross(speed, i @ speed) - self.w * np.cross(self.e, i @ speed)
        return np.linalg.solve(right_jacobian(x), speed - self.w * (down - self.e)), np.linalg.solve(i, turning)

    def _carried(self, x):
        return self.w * (rotation(x).T @ self.e - self.e)

    def rest(self, near):
        """Return the rotation vector x at rest in the turning axes, (3,)."""
        found = root(lambda x: self.spinning(x, self._carried(x))[1], near, tol=1e-13)
        return found.x

    def folding(self, near):
        """Return where rests fold as the speed w changes: w (rad/s), from x and w near by."""

        def equations(z):
            self.w, h = z[3], 1e-4
            def rest(x):
                return self.spinning(x, self._carried(x))[1]

            steps = h * np.eye(3)
            slopes = [(8.0 * (rest(z[:3] + e) - rest(z[:3] - e)) - rest(z[:3] + 2 * e) + rest(z[:3] - 2 * e)) / (12 * h)
                      for e in steps]
            return np.append(rest(z[:3]), np.linalg.det(np.array(slopes)) / self.w**4)

        return float(root(equations, near, tol=1e-13).x[3])

    def exponents(self, x):
        """Return the six exponents of small motions about x, 1/s."""
        at, h, columns = np.concatenate([x, self._carried(x)]), 1e-5, []
        for step in h * np.eye(6):
            ends = [np.concatenate(self.spinning(y[:3], y[3:])) for y in (at + step, at - step)]
            columns.append((ends[0] - ends[1]) / (2.0 * h))
        return np.linalg.eigvals(np.array(columns).T)


def rotation(x):
    """Return the matrix exp([x]x) by Rodrigues' formula."""
    angle, k = math.sqrt(float(x @ x)), cross(x)
    return np.eye(3) + np.sinc(angle / np.pi) * k + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * k @ k


def matrix(q):
    """Return the rotation matrix of a unit quaternion."""
    s, v = q[0], q[1:]
    return np.eye(3) + 2.0 * s * cross(v) + 2.0 * cross(v) @ cross(v)
