"""Motion in time where no stepping of MuJoCo's is asked for: u' = f(u, t) by methods of SciPy that choose their step.

The step's error is told relative to each component. What was reached is kept where a motion diverges, takes too many
steps, or the user stops it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import DOP853, LSODA

from mjcont.numerics.equations.problem import Array
from mjcont.results.quantities import LARGEST

# over which time speeds must stay small for a motion to be at rest, s
_CALM = 1.0
# a step that is a shorter part of the time stands still: the motion has no further one
_SHORTEST = 1e-14


@dataclass(slots=True)
class Followed:
    """A motion as far as it was followed.

    Attributes
    ----------
    times, states : (m,) of those asked for that were reached, (m, n).
    ended : "done", "at rest", "stalled", "diverged" or "interrupted".
    steps : that were taken.
    """

    times: Array
    states: Array
    ended: str
    steps: int


def follow(
    field: Callable[[float, Array], Array],
    state: Array,
    times: Array,
    rtol: float,
    atol: Array,
    max_steps: int,
    *,
    stiff: bool = True,
    calm: Callable[[float, Array], bool] | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> Followed:
    """Follow a motion from a state (n,) through increasing times, the first of which is where it begins.

    `calm` tells whether speeds are so small that the motion ends once they have stayed so; `progress(time, end)` hears
    of every step.
    """
    method = LSODA if stiff else DOP853
    solver = method(field, float(times[0]), state, float(times[-1]), rtol=rtol, atol=atol)
    states, done, steps, since = [state], 1, 0, math.nan
    ended = "done"
    try:
        while solver.status == "running":
            if steps >= max_steps:
                ended = "stalled"
                break
            solver.step()
            steps += 1
            stuck = solver.t - solver.t_old <= _SHORTEST * max(abs(float(times[-1])), abs(solver.t))
            if solver.status == "failed" or not (np.abs(solver.y) < LARGEST).all() or stuck:
                ended = "diverged"
                break
            if progress is not None:
                progress(float(solver.t), float(times[-1]))
            last = int(np.searchsorted(times, solver.t, side="right"))
            if last > done:
                states += list(np.atleast_2d(solver.dense_output()(times[done:last]).T))
                done = last
            if calm is not None:
                since = (solver.t if math.isnan(since) else since) if calm(solver.t, solver.y) else math.nan
                if solver.t - since >= _CALM:
                    ended = "at rest"
                    break
    except KeyboardInterrupt:
        ended = "interrupted"
    return Followed(times[:done], np.array(states), ended, steps)
