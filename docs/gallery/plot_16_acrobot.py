"""
An acrobot that others modelled
===============================

The acrobot of the DeepMind control suite (Apache-2.0), as MuJoCo Playground carries it: two links, one motor at the
elbow. ``make thirdparty`` downloads it; it does not ship with mjcont. Where can it stand under a steady torque?
"""

from pathlib import Path

import mjcont as mc

found = sorted(Path.cwd().resolve().glob("../../.thirdparty/playground-*/**/dm_control_suite/xmls/acrobot.xml"))
if not found:
    print("The model is not here: run `make thirdparty` in a checkout, which downloads it.")

# %%
# All rests without torque are found first, then followed as the torque grows.

if found:
    acrobot = mc.Mechanism.from_xml(found[0])
    rests = mc.find_equilibria(acrobot, {"elbow": 0.0}, starts=50)
    print(rests)
    diagram = mc.bifurcation_diagram(acrobot, "elbow", bounds=(-1, 1), starts=rests)
    ax = mc.plot(*diagram, x="elbow", y="joint:elbow", legend=False)
