"""
A toggle clamp and its margin
=============================

A clamp closes past its dead centre onto a stop and holds by itself. Which moment opens it, and how much energy does it
take to knock it open?
"""

import mjcont as mc

clamp = mc.Mechanism.from_xml("toggle_clamp")
branch = mc.continue_equilibria(clamp, "M", bounds=(-40, 40), keyframe="closed")
cycle = mc.load_path(branch, "M", [-40, 30, -40], landing="creep")
ax = mc.plot(branch, cycle, x="M", y="theta")

# %%
# How the moment that opens it depends on the spring of the strut:

opens = [p for p in branch.special_points if p.kind in ("LP", "CO")]
for point in opens:
    print(f"{point.label}: M = {point['M']:.3f} N m at theta = {point['theta']:.4f} rad")
figure = mc.draw_poses(clamp, {"closed": "closed", "open": "open"}, cols=2)
