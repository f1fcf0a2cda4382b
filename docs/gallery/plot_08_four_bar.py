"""
A four-bar linkage: how stiff must a pin be?
============================================

A closed linkage with rigid pins becomes an ordinary differential equation when one pin is a stiff spring, a bush. Its
folds tend to those of the rigid linkage as 1/k: from which stiffness on is the difference below one in a thousand?
"""

import mjcont as mc

linkage = mc.Mechanism.from_spec(mc.add_bushes("four_bar", stiffness=1e5))
branch = mc.continue_equilibria(linkage, "M", bounds=(-12, 12))
fold = branch.point("LP1")
study = mc.stiffness_study(linkage, fold, "k_bush", tol=1e-3)
print(study)

ax = mc.plot(branch, x="M", y="crank")

# %%
# The linkage at its folds:

figure = mc.draw_poses(linkage, {p.label: p for p in branch.special_points if p.kind == "LP"}, cols=4)
