"""Random mechanisms of seven kinds, and what MuJoCo itself says of a rest of theirs.

`mechanism(seed)` is the same model in every process. `eigenvalues` asks nothing of mjcont: it differentiates MuJoCo's
accelerations.
"""

from __future__ import annotations

import mujoco
import numpy as np

KINDS = ("tree", "loop", "ball", "contact", "limit", "muscle", "follower")
# steps of positions and velocities, two of each: what both tell is known
STEPS = ((1e-6, 1e-5), (2.5e-7, 2.5e-6))


def kind_of(seed: int) -> str:
    """Return the kind of a seed's mechanism."""
    return KINDS[seed % len(KINDS)]


def bounds_of(seed: int) -> tuple[float, float]:
    """Return the range of its load."""
    return (0.0, 1.0) if kind_of(seed) == "muscle" else (-12.0, 12.0)


def mechanism(seed: int) -> str:
    """Return two to four rods on springs and dampers under a load of the kind of the seed."""
    rng, kind = np.random.default_rng(seed), kind_of(seed)
    count = int(rng.integers(3, 5)) if kind == "loop" else int(rng.integers(2, 5))
    parents = [i - 1 if kind != "tree" or i < 2 or rng.random() < 0.6 else int(rng.integers(i)) for i in range(count)]
    planar = kind in ("loop", "contact", "follower") or rng.random() < 0.4
    rods = [_rod(rng, planar) for _ in range(count)]
    tip = sum(rods, np.zeros(3))
    joints = [_joint(rng, kind, planar, i) for i in range(count)]
    body = _bodies(0, parents, rods, joints, rng.uniform(0.1, 1.0, count), kind)
    upright = kind != "contact" and rng.random() < 0.5  # what stands on its springs buckles
    return f"""<mujoco model="{kind}_{seed}"><compiler angle="radian"/>
      <option gravity="0 0 {9.81 if upright else -9.81}"/>
      <default><geom contype="0" conaffinity="0"/></default>
      <worldbody>{body}{_floor(rng, tip) if kind == "contact" else ""}</worldbody>
      {_closure(rng, count, rods[-1]) if kind == "loop" else ""}
      <actuator>{_load(rng, kind)}</actuator></mujoco>"""


def _text(vector) -> str:
    return " ".join(f"{c:.17g}" for c in np.atleast_1d(vector))


def _rod(rng, planar: bool) -> np.ndarray:
    angle = rng.uniform(-1.2, 1.2)
    return rng.uniform(0.3, 0.8) * np.array([np.sin(angle), 0.0 if planar else rng.uniform(-0.5, 0.5), -np.cos(angle)])


def _joint(rng, kind: str, planar: bool, index: int) -> str:
    spring = f'stiffness="{rng.uniform(0.5, 6.0):.17g}" damping="{10.0 ** rng.uniform(-2, 0):.17g}"'
    if kind == "ball" and index:
        bare = rng.random() < 0.2  # such a rod may spin about itself: a motion that is held
        return f'<joint name="q{index}" type="ball" {"" if bare else spring}/>'
    axis = np.array([0.0, -1.0, 0.0]) if planar else rng.normal(size=3)
    if index and kind in ("tree", "limit") and rng.random() < 0.2:
        firm = f'stiffness="{rng.uniform(50, 300):.17g}" damping="1"'
        return f'<joint name="q{index}" type="slide" axis="{_text(axis)}" {firm}/>'
    limited = f'limited="true" range="{-rng.uniform(0.1, 0.5):.17g} {rng.uniform(0.1, 0.5):.17g}"'
    return f'<joint name="q{index}" axis="{_text(axis)}" {spring} {limited if kind == "limit" else ""}/>'


def _bodies(index: int, parents, rods, joints, masses, kind: str) -> str:
    place = np.zeros(3) if parents[index] < 0 else rods[parents[index]]
    children = "".join(
        _bodies(i, parents, rods, joints, masses, kind) for i, parent in enumerate(parents) if parent == index
    )
    last = index == len(rods) - 1
    end = _text(rods[index])
    foot = f'<geom name="foot" type="sphere" size="0.05" pos="{end}" mass="0.05" conaffinity="1" condim="1"/>'
    return (
        f'<body name="b{index}" pos="{_text(place)}">{joints[index]}'
        f'<geom type="capsule" fromto="0 0 0 {end}" size="0.02" mass="{masses[index]:.17g}"/>'
        f'{foot if last and kind == "contact" else ""}{_site(rods[index]) if last else ""}{children}</body>'
    )


def _site(place: np.ndarray) -> str:
    return f'<site name="tip" pos="{_text(place)}"/>'


def _floor(rng, tip: np.ndarray) -> str:
    height = tip[2] - 0.05 - rng.uniform(-0.02, 0.05)
    stiffness = 10.0 ** rng.uniform(3.0, 6.0)
    return (
        f'<geom name="floor" type="plane" size="5 5 1" pos="0 0 {height:.17g}" contype="1" condim="1" '
        f'solref="{-stiffness:.17g} {-0.1 * np.sqrt(stiffness):.17g}"/>'
    )


def _closure(rng, count: int, rod: np.ndarray) -> str:
    stiffness = 10.0 ** rng.uniform(3.0, 6.0)
    return (
        f'<equality><connect body1="b{count - 1}" anchor="{_text(rod)}" '
        f'solref="{-stiffness:.17g} {-0.1 * np.sqrt(stiffness):.17g}" solimp="0.9 0.9 0.001"/></equality>'
    )


def _load(rng, kind: str) -> str:
    if kind == "muscle":
        other = f'<muscle name="other" joint="q1" force="{rng.uniform(2, 8):.17g}" lengthrange="-1.5 1.5"/>'
        return f'<muscle name="load" joint="q0" force="{rng.uniform(5, 25):.17g}" lengthrange="-2 2"/>{other}'
    if kind == "follower":
        angle = rng.uniform(-np.pi, np.pi)
        return f'<motor name="load" site="tip" gear="{np.cos(angle):.17g} 0 {np.sin(angle):.17g} 0 0 0"/>'
    return '<motor name="load" joint="q0"/>'


class Judge:
    """MuJoCo's own accelerations at rests of one mechanism, differentiated."""

    def __init__(self, seed: int) -> None:
        self.model = mujoco.MjModel.from_xml_string(mechanism(seed))
        self.model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        self.model.opt.iterations, self.model.opt.tolerance = 200, 0.0
        self.data = mujoco.MjData(self.model)

    def eigenvalues(self, state: np.ndarray, load: float) -> tuple[np.ndarray, float]:
        """Return the eigenvalues of motion near a rest, 1/s, and how far two sizes of steps leave them apart."""
        found = [_sorted(np.linalg.eigvals(self._matrix(state, load, *steps))) for steps in STEPS]
        return found[0], float(np.abs(found[0] - found[1]).max())

    def _matrix(self, state: np.ndarray, load: float, h: float, speed: float) -> np.ndarray:
        n = self.model.nv
        zero, columns = np.zeros(n), []
        for step in np.eye(n):
            columns.append((self._acceleration(state, load, h * step, zero)
                            - self._acceleration(state, load, -h * step, zero)) / (2.0 * h))
        for step in np.eye(n):
            columns.append((self._acceleration(state, load, zero, speed * step)
                            - self._acceleration(state, load, zero, -speed * step)) / (2.0 * speed))
        return np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), np.array(columns).T])

    def _acceleration(self, state: np.ndarray, load: float, step: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        data, model = self.data, self.model
        mujoco.mj_resetData(model, data)
        data.ctrl[0] = load
        if model.na:
            data.act[:] = data.ctrl  # at rest a muscle's activation is its control
        data.qpos[:] = state
        mujoco.mj_integratePos(model, data.qpos, step, 1.0)
        data.qvel[:] = velocity
        mujoco.mj_forward(model, data)
        return data.qacc.copy()


def _sorted(values: np.ndarray) -> np.ndarray:
    return values[np.lexsort((np.round(values.imag, 6), np.round(values.real, 6)))]
