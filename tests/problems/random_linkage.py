"""Random planar linkages."""

import numpy as np


def linkage(seed: int) -> str:
    """Return two to five bars with random masses and springs, pulled by a spring, often closed by a stiff bush."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    lengths, angles = rng.uniform(0.3, 1.0, count), np.cumsum(rng.uniform(-1.0, 1.0, count))
    bars = np.column_stack([lengths * np.cos(angles), lengths * np.sin(angles)])
    bodies = ""
    for i, (x, z) in enumerate(bars):
        place = "0 0 0" if i == 0 else f"{bars[i - 1, 0]} 0 {bars[i - 1, 1]}"
        stiffness = rng.uniform(0.0, 20.0) * (rng.random() < 0.7)
        bodies += (
            f'<body pos="{place}"><joint name="q{i}" axis="0 -1 0" stiffness="{stiffness}" '
            f'damping="{rng.uniform(0.01, 1.0)}"/>'
            f'<geom type="capsule" fromto="0 0 0 {x} 0 {z}" size="0.02" mass="{rng.uniform(0.1, 3.0)}"/>'
        )
    end, anchor = bars.sum(axis=0), rng.uniform(-1.0, 1.0, 2)
    bush = ""
    if rng.random() < 0.6:
        k = 10.0 ** rng.uniform(3.0, 6.0)
        bush = "".join(
            f'<general name="bush_{a}" site="tip" refsite="ground" gear="{g} 0 0 0" gainprm="0" biastype="affine" '
            f'biasprm="0 {-k} {-1e-3 * k}"/>'
            for a, g in (("x", "1 0 0"), ("z", "0 0 1"))
        )
    return f"""<mujoco model="linkage_{seed}"><compiler angle="radian"/>
      <option gravity="0 0 -9.81"><flag contact="disable"/></option>
      <worldbody>{bodies}<site name="tip" pos="{bars[-1, 0]} 0 {bars[-1, 1]}"/>{"</body>" * count}
      <site name="ground" pos="{end[0]} 0 {end[1]}"/><site name="anchor" pos="{anchor[0]} 0 {anchor[1]}"/></worldbody>
      <tendon><spatial stiffness="{rng.uniform(0.0, 200.0)}" springlength="{rng.uniform(0.1, 1.0)}">
      <site site="anchor"/><site site="tip"/></spatial></tendon>
      <actuator><general name="M" joint="q0"/>{bush}</actuator></mujoco>"""
