"""Models whose equality constraints open, one of each kind."""

from __future__ import annotations

# two free bodies side by side; two hinges and two slides on the ground, with tendons
MODEL = """
<mujoco><compiler angle="radian"/><option timestep="0.005" gravity="0 0 0"><flag contact="disable" {flag}/></option>
<worldbody>
  <body name="a"><freejoint/><geom size="0.1" mass="2"/></body>
  <body name="b" pos="0.3 0 0"><freejoint/><geom type="box" size="0.1 0.2 0.3" mass="5"/></body>
  <body name="c" pos="3 0 0"><joint name="h1" axis="0 1 0"/><geom size="0.1" pos="0.5 0 0" mass="2"/></body>
  <body name="d" pos="5 0 0"><joint name="h2" axis="0 1 0"/><geom size="0.2" pos="0.4 0 0" mass="3"/></body>
  <body name="e" pos="7 0 0"><joint name="s1" type="slide" axis="1 0 0"/><geom size="0.1" mass="4"/>
    <site name="e"/></body>
  <body name="f" pos="8 0 0"><joint name="s2" type="slide" axis="1 0 0"/><geom size="0.1" mass="1"/>
    <site name="f"/></body>
  <site name="left" pos="6 0 0"/><site name="right" pos="9 0 0"/>
</worldbody>
<tendon>
  <fixed name="turn"><joint joint="h1" coef="0.5"/></fixed>
  <fixed name="turn_2"><joint joint="h2" coef="0.8"/></fixed>
  <spatial name="rope"><site site="left"/><site site="e"/></spatial>
  <spatial name="rope_2"><site site="f"/><site site="right"/></spatial>
</tendon>
<equality>{equality}</equality></mujoco>"""
CONNECT = '<connect name="eq" body1="a" body2="b" anchor="0 0 0" {s}/>'
WELD = '<weld name="eq" body1="a" body2="b" torquescale="0.7" {s}/>'
HINGES = '<joint name="eq" joint1="h1" joint2="h2" polycoef="0 2 0.5 0 0" {s}/>'
SLIDE = '<joint name="eq" joint1="s1" {s}/>'
ROPES = '<tendon name="eq" tendon1="rope" tendon2="rope_2" {s}/>'
TURNS = '<tendon name="eq" tendon1="turn" tendon2="turn_2" {s}/>'
# what is moved: the coordinate of qpos and of qvel, and how far the constraint opens per unit of it
CASES = {
    "connect": (CONNECT, 1, 1, 1.0, "connect", "N/m"),
    "weld": (WELD, 1, 1, 1.0, "weld", "N/m"),
    "two hinges": (HINGES, 14, 12, 1.0, "joint", "N*m/rad"),
    "a slide": (SLIDE, 16, 14, 1.0, "joint", "N/m"),
    "ropes": (ROPES, 16, 14, 1.0, "tendon", "N/m"),
    "tendons on hinges": (TURNS, 14, 12, 0.5, "tendon", "N*m/rad"),
}
SOLVERS = {
    "direct, constant impedance": 'solref="-2e4 -100" solimp="0.9 0.9 0.001"',
    "direct, growing impedance": 'solref="-2e4 -100" solimp="0.5 0.8 0.02 0.3 3"',
    "direct, falling impedance": 'solref="-2e4 -100" solimp="0.9 0.6 0.02 0.5 1"',
    "direct, impedance of no width": 'solref="-2e4 -100" solimp="0.5 0.8 0 0.5 2"',
    "direct, impedance beyond its range": 'solref="-2e4 -100" solimp="-1 2 0.02"',
    "standard": 'solref="0.05 0.7" solimp="0.9 0.95 0.02"',
    "standard, clamped by the timestep": 'solref="0.001 1" solimp="0.9 0.95 0.001"',
    "of mixed signs": 'solref="0.05 -1"',
    "MuJoCo's own": "",
}


def text_of(equality, solver="", flag=""):
    return MODEL.format(equality=equality.format(s=solver), flag=flag)
