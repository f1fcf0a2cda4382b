"""
A nose landing gear: the force that unlocks it
==============================================

A gear that is held by its locklinks is unlocked by an actuator. How large must its force be, so that the gear never
snaps? Following the fold at which it lets go, in two parameters, gives the answer: the cusp.
"""

import mjcont as mc

gear = mc.Mechanism.from_xml("nose_gear")
branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")
ax = mc.plot(branch, x="F_ret", y="theta_ov", units="kN", key=True)

# %%
# The fold, followed as an unlock force acts, too:

locus = mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1000, 0))
cusp = locus.point("CP1")
print(cusp)
ax = mc.plot(locus, x="F_ul", y="F_ret", units="kN")

# %%
# Between the two arms of the curve the gear has several rests. An unlock force beyond the cusp's, 412 N,
# leads past all of them: the gear passes overcentre without a jump. (BP1, beside the cusp, is where the locus turns in
# the unlock force without a cusp.)
#
# What does that force depend on? All parameters at once, by adjoints:

found = mc.sensitivities(cusp)
axes = found.plot("F_ul")

# %%
# The gear at its special points:

figure = mc.draw_poses(gear, {"retracted": "uplock_above", "fold": branch.point("LP1"), "cusp": cusp}, cols=3)
