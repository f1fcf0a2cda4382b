"""
A linkage in space
==================

A crank turns about one axis, a rocker about another, and a coupler on two spherical joints runs between them
(RSSR). The moment that holds the crank, over a whole turn, has extrema: beyond them the crank turns over.
"""

import mjcont as mc

linkage = mc.Mechanism.from_xml("rssr")
branch = mc.continue_equilibria(linkage, "M", bounds=(-3, 3))
print(branch)
ax = mc.plot(branch, x="M", y="crank", key=True)
