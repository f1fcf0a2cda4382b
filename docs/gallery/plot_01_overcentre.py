"""
An overcentre lock, opened and closed
=====================================

Two links pass through their dead centre and are held there by their weight; a force F lifts them. At which force
does the lock open, at which does it close again, and why are these two different forces?
"""

import mjcont as mc

mechanism = mc.Mechanism.from_xml("overcentre")
branch = mc.continue_equilibria(mechanism, "F", bounds=(0, 40), start={"F": 40.0})
print(branch)

# %%
# The two folds are where it opens and closes: beyond a fold there is nothing near to rest at, and the links snap. A
# load path follows the stable parts as the force falls and rises again, and lands where the motion after a snap
# comes to rest.
#
# (Labels of jumps count along the path, those of folds along the branch.)

cycle = mc.load_path(branch, "F", [40, 0, 40])
for jump in cycle.jumps:
    print(f"{jump.label}: at {jump.before['F']:.3f} N, {jump.energy:.3f} J set free")

ax = mc.plot(branch, cycle, x="F", y="theta_1", key=True)

# %%
# Three poses: at both folds, and at the unstable rest between them, where the links are in line.

poses = {"LP2": branch.point("LP2"), "dead centre": branch.at(theta_1=0.0)[0], "LP1": branch.point("LP1")}
figure = mc.draw_poses(mechanism, poses, cols=3)
