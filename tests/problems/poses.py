"""Random poses of the overcentre mechanism."""

from __future__ import annotations

import numpy as np

from problems import reference


def random_rest(count, seed=7):
    """Yield states and parameters at rest: any angles, pins open by about 5 cm, bushes from soft to stiff."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        angle = rng.uniform(-np.pi, np.pi)
        q = reference.assembled_pose(angle) + rng.normal(0.0, 0.05, 6)
        p = {
            "k_j": 10.0 ** rng.uniform(1.0, 7.0),
            "c_j": rng.uniform(0.0, 5.0),
            "k_sp": rng.uniform(1.0, 50.0),
            "c_sp": rng.uniform(0.0, 20.0),
            "l_us": rng.uniform(0.0, 2.0),
            "m_1": rng.uniform(0.2, 5.0),
            "m_2": rng.uniform(0.2, 5.0),
            "F": rng.uniform(-50.0, 50.0),
            "gravity_angle": rng.uniform(-1.0, 1.0),
            "load_factor": rng.uniform(0.5, 2.5),
        }
        yield q, p
