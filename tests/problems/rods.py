"""A rod on a spring whose geometry is a parameter, in closed form."""

import math

import mjcont as mc

GRAVITY, DENSITY, STIFFNESS, DAMPING = 9.81, 1000.0, 1.0, 0.002
RADIUS, LENGTH, REST = 0.02, 0.3, math.radians(3.0)
ROD = f"""
<mujoco model="rod">
  <compiler angle="degree"/>
  <option gravity="0 0 -{GRAVITY}"/>
  <custom>{{declarations}}</custom>
  <worldbody>
    <body name="rod">
      <joint name="hip" type="hinge" axis="0 1 0" stiffness="{STIFFNESS}" damping="{DAMPING}" springref="{{rest}}"/>
      <geom name="rod" type="cylinder" size="{RADIUS}" fromto="0 0 0 0 0 {LENGTH}" density="{DENSITY}"/>
      <site name="tip" pos="0 0 {LENGTH}"/>
    </body>
  </worldbody>
  <actuator><motor name="torque" joint="hip"/></actuator>
  <sensor><framepos name="tip" objtype="site" objname="tip"/></sensor>
  <keyframe><key name="leaning" qpos="0.4"/></keyframe>
</mujoco>
"""
DECLARED = '<text name="mjcont/length" data="unit=m bounds=0.1,0.6 : spec:geom:rod.fromto[5] spec:site:tip.pos[2]"/>'


def rod(declarations: str = DECLARED, rest: float = 3.0) -> mc.Mechanism:
    """An upright uniform rod on a torsion spring, whose length changes mass, inertia and centre of mass."""
    return mc.Mechanism.from_xml(ROD.format(declarations=declarations, rest=rest))


def mass(length, radius=RADIUS):
    return DENSITY * math.pi * radius**2 * length


def weight_moment(length, radius=RADIUS):
    return mass(length, radius) * GRAVITY * length / 2.0


def inertia(length, radius=RADIUS):
    return mass(length, radius) * (radius**2 / 4.0 + length**2 / 3.0)


def set_length(spec, value):
    spec.geom("rod").fromto[5] = value
    spec.site("tip").pos[2] = value


def with_function(**options):
    mechanism = rod("")
    mechanism.declare("length", function=set_length, value=LENGTH, unit="m", bounds=(0.1, 0.6), **options)
    return mechanism
