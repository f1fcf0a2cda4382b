"""
A lock that rests on a stop
===========================

Real gears do not hang in a spring: a few degrees beyond dead centre their locklinks rest on a stop. Where does the stop
begin to carry load, and when does it let go? At corners of the curve, which are located like folds.
"""

import mjcont as mc

gear = mc.Mechanism.from_xml("nose_gear_stop")
branch = mc.continue_equilibria(gear, "F_ret", bounds=(3.5e5, 5.6e5), start={"F_ret": 5.5e5}, keyframe="uplock_below")
for point in branch.special_points:
    print(point)

ax = mc.plot(branch, x="F_ret", y="theta_ov", units="kN", key=True)

# %%
# What the locklinks press against the stop with is an observable, as every sensor of the model:

ax = mc.plot(branch, x="F_ret", y="stop_load", units="kN")
