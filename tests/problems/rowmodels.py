"""Models of the tests on rows between points: a ball joint, springs that cross."""

from __future__ import annotations

# a rod on a ball joint, turned up by a force at its tip: positions carry a quaternion
BALL = (
    '<mujoco><option gravity="0 0 0"><flag contact="disable"/></option><worldbody><site name="ground"/>'
    '<body><joint type="ball" stiffness="1" damping="0.1"/><geom type="capsule" fromto="0 0 0 0 0 1" size="0.05"/>'
    '<site name="tip" pos="0 0 1"/></body></worldbody>'
    '<actuator><general name="P" site="tip" refsite="ground" gear="1 0.3 0 0 0 0"/></actuator></mujoco>'
)
# a rod on two crossed hinges buckles both ways at P = 1 N; a slide and an oblique spring bend the straight branch
CROSSED = (
    '<mujoco><option gravity="0 0 0"><flag contact="disable"/></option><worldbody><site name="ground"/>'
    '<site name="post" pos="0 1 0"/><body><joint type="slide" axis="1 0 0" stiffness="0.1" damping="1"/>'
    '<geom size="0.05"/><site name="hook"/><body><joint axis="0 1 0" stiffness="1" damping="0.1"/>'
    '<joint axis="0 0 1" stiffness="1" damping="0.1"/><geom type="capsule" fromto="0 0 0 1 0 0" size="0.01"/>'
    '<site name="tip" pos="1 0 0"/></body></body></worldbody><tendon><spatial stiffness="2" springlength="0.9">'
    '<site site="post"/><site site="hook"/></spatial></tendon>'
    '<actuator><general name="P" site="tip" refsite="ground" gear="-1 0 0 0 0 0"/></actuator></mujoco>'
)
