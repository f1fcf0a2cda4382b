"""
Two rods that flutter
=====================

A follower load at the tip of two rods (Ziegler's column) has no potential: the straight rods do not buckle, they
begin to swing. The Hopf point, the limit cycles that begin there, and one of them as a phase portrait.
"""

import matplotlib.pyplot as plt

import mjcont as mc

rods = mc.Mechanism.from_xml("ziegler_rods")
rest = mc.continue_equilibria(rods, "P", bounds=(1.4, 2.2), start={"P": 1.4})
hopf = rest.point("HB1")
print(hopf)
cycles = mc.continue_cycles(hopf)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
mc.plot(rest, cycles, x="P", y="q1", ax=left)
mc.plot_orbits(cycles, x="q1", y="q2", n=6, ax=right)

# %%
# Is it right? Motions beside five of these orbits, held against their Floquet multipliers:

print(mc.verify_stability(cycles, n=5).certificate)
