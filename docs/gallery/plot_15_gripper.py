"""
A gripper that others modelled
==============================

The Robotiq 2F-85 on a Panda arm, from MuJoCo Playground (Apache-2.0): thirteen degrees of freedom, a linkage in
each finger, closed by constraints. ``make thirdparty`` downloads it; it does not ship with mjcont. Where do the
fingers go as their command grows?
"""

from pathlib import Path

import mjcont as mc

found = sorted(Path.cwd().resolve().glob("../../.thirdparty/playground-*/**/panda_updated_robotiq_2f85.xml"))
if not found:
    print("The model is not here: run `make thirdparty` in a checkout, which downloads it.")

# %%
# Its meshes are left out where they are not there, never the mass of a body without a note. Springs hold the arm, which
# nothing else keeps in place.

if found:
    gripper = mc.Mechanism.from_xml(found[0])
    gripper.declare("k_arm", "joint:joint*.stiffness", unit="N m/rad")
    start = {"k_arm": 100.0, "fingers_actuator": 0.4}
    reach = [0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.4, 0.4, -0.4, 0.4, 0.4, -0.4]
    branch = mc.continue_equilibria(gripper, "fingers_actuator", bounds=(0.0, 0.8), start=start, state=reach)
    print(branch)
    ax = mc.plot(branch, x="fingers_actuator", y="left_driver_joint")
