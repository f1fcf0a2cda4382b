"""
A latch that is pulled open
===========================

The roller of a pawl meets an inclined face and is lifted, against a spring, until its stop lets go: there the force
is at its largest, and the door flies open. A contact, a stop and a spring, for two stiffnesses.
"""

import mjcont as mc

latch = mc.Mechanism.from_xml("latch")
stiff = mc.continue_equilibria(latch, "F", bounds=(0, 60), direction=1)
soft = mc.continue_equilibria(latch, "F", bounds=(0, 60), direction=1, start={"k_t": 0.5})
for branch in (stiff, soft):
    print([f"{p.label}: F = {p['F']:.2f} N, x = {1e3 * p['x']:.2f} mm" for p in branch.special_points])

ax = mc.plot(stiff, soft, x="F", y="x", units="mm", key=True)

# %%
# The corner at which the curve turns is a non-smooth fold: no eigenvalue warns of it. A load path jumps there like at
# any other fold.

path = mc.load_path(latch, "F", [0, 45], landing="creep", max_jumps=1)
print(path)
