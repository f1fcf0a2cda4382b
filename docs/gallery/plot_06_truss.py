"""
A truss that snaps through
==========================

The truss of von Mises: two elastic bars and a loaded apex. The closed form of its snap-through load is compared
with the fold, and the energy barrier tells how hard a knock it stands before.
"""

import matplotlib.pyplot as plt

import mjcont as mc

truss = mc.Mechanism.from_xml("von_mises_truss")
branch = mc.continue_equilibria(truss, "P", bounds=(-200, 200), start={"P": 0.0}, keyframe="unloaded")
k, length, a = 1000.0, 1.25, 1.0
closed = 2 * k * length * (1 - (a / length) ** (2 / 3)) ** 1.5
fold = max(p["P"] for p in branch.of_kind("LP"))
print(f"fold {fold:.9f} N, 2 k L0 (1 - (a / L0)^(2/3))^(3/2) = {closed:.9f} N")

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
mc.plot(branch, mc.load_path(branch, "P", [-200, 200, -200]), x="P", y="z", ax=left)
barriers = mc.barrier_along(branch, search=False)
barriers.plot(right)
