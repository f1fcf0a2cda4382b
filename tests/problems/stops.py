"""Mechanisms that meet stops."""

import mjcont as mc

STIFFNESS, DAMPING, IMPEDANCE = 1e5, 100.0, 0.9
LOWER, UPPER = -1.0, 0.5


def pendulum_with_stops(gravity: float) -> mc.Mechanism:
    """An inverted pendulum, m = l = k = 1, turned by a moment M between two stops."""
    soft = f'solreflimit="{-STIFFNESS} {-DAMPING}" solimplimit="{IMPEDANCE} {IMPEDANCE} 0.001 0.5 2"'
    return mc.Mechanism.from_xml(
        f"""<mujoco model="stops"><compiler angle="radian"/><option gravity="0 0 {-gravity}"/>
        <worldbody><body><joint name="q" axis="0 1 0" stiffness="1" damping="0.1" range="{LOWER} {UPPER}" {soft}/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-6 1e-6 1e-6"/></body></worldbody>
        <actuator><general name="M" joint="q"/></actuator></mujoco>"""
    )
