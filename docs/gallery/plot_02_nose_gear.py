"""
A nose landing gear: the force that unlocks it
==============================================

A gear that is held by its locklinks is unlocked by an actuator. How large must its force be, so that the gear never
snaps? Following the fold at which it lets go, in two parameters, gives the answer: the cusp.
"""

import matplotlib.pyplot as plt

import mjcont as mc

gear = mc.Mechanism.from_xml("nose_gear")
branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")
locus = mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1000, 0))
cusp = locus.point("CP1")
print(cusp)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
mc.plot(branch, x="F_ret", y="theta_ov", ax=left, units="kN")
mc.plot(locus, x="F_ul", y="F_ret", ax=right, units="kN")

# %%
# Between the two arms of the curve on the right the gear has several rests. An unlock force beyond the cusp's, 412 N,
# leads past all of them: the gear passes overcentre without a jump.
#
# What does that force depend on? All parameters at once, by adjoints:

found = mc.sensitivities(cusp)
axes = found.plot("F_ul")

# %%
# The gear at its special points:

figure = mc.draw_poses(gear, {"retracted": "uplock_above", "fold": branch.point("LP1"), "cusp": cusp}, cols=3)
