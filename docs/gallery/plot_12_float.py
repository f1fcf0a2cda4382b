"""
A float that capsizes
=====================

A top-heavy float is held down by four tethers. As it loses buoyancy they lose tension, and it capsizes: a free body
with six degrees of freedom, and a closed form to compare with, B = 155.25 N.
"""

import mjcont as mc

body = mc.Mechanism.from_xml("tethered_body")
upright = mc.continue_equilibria(body, "B", bounds=(120, 300), start={"B": 250.0}, keyframe="upright")
print([f"{p.label}: B = {p['B']:.6f} N" for p in upright.special_points])

tilted = mc.switch_branches(upright.of_kind("BP")[0])
ax = mc.plot(upright, *tilted, x="B", y="mast[1]", legend=False)
