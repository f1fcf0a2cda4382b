"""Ziegler's column of two rods under a follower load: its equations stand in `test_problems_mjcf.py`."""

from __future__ import annotations

import mjcont as mc


def ziegler(b):
    """Return the column as a Mechanism; the point masses have the least inertia that counts for nothing."""
    hinge = f'type="hinge" axis="0 -1 0" stiffness="1" damping="{b}"'
    return mc.Mechanism.from_xml(f"""
    <mujoco model="ziegler">
      <option gravity="0 0 0"/>
      <worldbody>
        <body name="lower">
          <joint name="lower" {hinge}/>
          <inertial pos="1 0 0" mass="2" diaginertia="1e-13 1e-13 1e-13"/>
          <body name="upper" pos="1 0 0">
            <joint name="upper" {hinge}/>
            <inertial pos="1 0 0" mass="1" diaginertia="1e-13 1e-13 1e-13"/>
            <site name="tip" pos="1 0 0"/>
          </body>
        </body>
      </worldbody>
      <actuator><general name="P" site="tip" gear="-1 0 0 0 0 0"/></actuator>
    </mujoco>""")


def column_branch(b):
    return mc.continue_equilibria(ziegler(b), "P", bounds=(0.0, 3.0), start={"P": 0.0})
