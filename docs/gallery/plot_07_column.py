"""
A column buckles
================

Eight links with springs between them, pressed from above. At the critical load the straight column has company: two
mirror images branch off. A small sideways force shows what is left of that in a real column.
"""

import mjcont as mc

column = mc.Mechanism.from_xml("buckling_column")
diagram = mc.bifurcation_diagram(column, "P", bounds=(0, 6), starts={"P": 0.0}, max_branches=4)
print(diagram)

# %%
# The closed form is 4 (k / l) sin²(π / (4 N)) = 2.459484 N.

print([f"{p.label}: {p['P']:.6f} N" for branch in diagram for p in branch.of_kind("BP")])
pushed = mc.continue_equilibria(column, "P", bounds=(0, 6), start={"P": 0.0, "H": 0.02})
ax = mc.plot(*diagram, pushed, x="P", y="tip_x", legend=False)
