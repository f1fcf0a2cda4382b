"""
A gear that is to lock at 450 kN
================================

The other way round: which dimensions move the fold to where it is wanted, changed least? A target for the fold and
a limit for the cusp, three parameters within their bounds.
"""

import mjcont as mc

gear = mc.Mechanism.from_xml("nose_gear")
branch = mc.continue_equilibria(gear, "F_ret", bounds=(3e5, 8e5), start={"F_ret": 4e5}, keyframe="uplock_above")
cusp = mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1000, 0)).point("CP1")
change = {"k_sp": (1e3, 4e3), "l_us": (0.7, 1.1), "r_ret": (0.03, 0.1)}
found = mc.design({"FP1": branch.point("LP1"), "CP1": cusp}, change, ["FP1.F_ret == 450 kN", "|CP1.F_ul| <= 400"])
print(found)

# %%
# What it takes, in parts of each parameter's size, and the diagrams before and after:

axes = found.plot()

# %%

axes = found.plot("FP1", "theta_ov")
