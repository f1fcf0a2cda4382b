"""
All the ways in which a six-bar linkage can rest
================================================

A Watt linkage has two loops and can be assembled in several ways. Under its weight and a spring: where can it rest,
and which of these rests does it keep?
"""

import mjcont as mc

linkage = mc.Mechanism.from_xml("watt_six_bar")
rests = mc.find_equilibria(linkage, {"M": 0.0}, starts=60, seed=1)
print(str(rests).splitlines()[0])

# %%
# The pins that close the loops are stiff springs in MuJoCo, and so a search also finds poses with a pin pulled open to
# its far side: unstable ones, which no linkage has. What it can keep are the stable ones, in order of energy:

stable = [rest for rest in rests if rest.stability == "stable"]
for number, rest in enumerate(stable, 1):
    print(f"{number}: {rest.energy:7.3f} J, crank {rest['crank']:7.4f} rad, rocker {rest['rocker']:7.4f} rad")

# %%

figure = mc.draw_poses(linkage, {f"{n}, {r.energy:.1f} J": r for n, r in enumerate(stable[:6], 1)}, cols=3)
