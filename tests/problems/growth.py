"""How a deviation from a forced orbit grows in MuJoCo's own stepping, period by period."""

from __future__ import annotations

import numpy as np

import mjcont as mc

# |s| h of the fastest mode: RK4 then takes less than a tenth of it in ten thousands of steps
_STEP = 0.25
_SMALL = 1e-6


def grown(mechanism, orbit, fastest, periods=10, first=4):
    """Return by how much a deviation grows in a period, the mean over the last of several: about the largest |mu|.

    `fastest` is the largest |eigenvalue|. The deviation is made small again at every period.
    """
    period, n, values = orbit.period, mechanism.n, dict(orbit.parameters)
    times = np.linspace(0.0, period, 4001)
    force = values["F"] + values["F.amplitude"] * np.cos(2.0 * np.pi * times / period * 1.0 + values["F.phase"])
    start = {k: v for k, v in values.items() if k in mechanism.parameters}
    begin = orbit.at(0.0)
    sizes = np.ptp(orbit.path.s, axis=0)

    def after(state):
        run = mc.simulate(
            mechanism, {"F": (times, force)}, period, start, state=state[:n], velocity=state[n:],
            timestep=_STEP / fastest, integrator="RK4", samples=4,
        )
        assert run.status == "done"
        return np.concatenate([run.states[-1], run.velocities[-1]])

    end = after(begin)
    deviation = _SMALL * sizes * np.cos(1.0 + np.arange(2 * n))
    logs = []
    for _ in range(periods):
        came = after(begin + deviation) - end
        logs.append(np.log(np.linalg.norm(came / sizes) / np.linalg.norm(deviation / sizes)))
        deviation = came * (_SMALL / np.linalg.norm(came / sizes))
    return float(np.exp(np.mean(logs[first:])))


def fastest_mode(orbit):
    """Return the largest |eigenvalue| of the motion's Jacobian along an orbit."""
    from mjcont.numerics.orbits.linger import first_order
    from mjcont.oscillation.onward import flow_at

    flow = flow_at(orbit)
    return max(np.abs(np.linalg.eigvals(first_order(flow, s, orbit.parameters))).max() for s in orbit.path.s[::5])
